"""A worker process for Groebner bases in Python libraries: it can be killed, they cannot be interrupted.

Source: `worker_main.py`, which describes the messages.
"""

from __future__ import annotations

import pickle
import sys
import threading
from pathlib import Path

from flint import fmpq, fmpz

from singsym.effort.budget import Budget
from singsym.elimination.engines.base import EngineFailure, Task
from singsym.elimination.engines.process import Child
from singsym.polynomials import Polynomial


class PythonWorker:
    """Keeps one process for one library, and starts another when it was killed."""

    def __init__(self, library: str) -> None:
        self.library = library
        self.start_afresh()

    def start_afresh(self) -> None:
        """Know of no process."""
        self._child: Child | None = None
        self._lock = threading.Lock()

    def groebner(self, task: Task, budget: Budget) -> tuple[Polynomial, ...]:
        """The reduced Groebner basis in the ring's own order."""
        budget.check(f"a Groebner basis by {self.library}")
        polynomials = [[(m, str(c)) for m, c in p.integer().terms()] for p in task.generators if p]
        if not polynomials:
            return ()
        request = pickle.dumps((task.ring.names, task.ring.order, polynomials))
        with self._lock:
            child = self._running_child()
            child.send(len(request).to_bytes(8, "big") + request)
            reply = child.read_until(_message_end, budget)
        basis = pickle.loads(reply[8:])
        return tuple(task.ring.from_dict({m: fmpq(fmpz(c)) for m, c in p}).primitive() for p in basis)

    def _running_child(self) -> Child:
        if self._child is None or not self._child.running:
            script = Path(__file__).with_name("worker_main.py")
            if not sys.executable or not script.exists():
                raise EngineFailure(self.library, "no Python interpreter to start a worker process with")
            self._child = Child(self.library, [sys.executable, "-P", str(script), self.library])
        return self._child

    @property
    def process_id(self) -> int | None:
        """The process kept at the moment."""
        return self._child.process.pid if self._child is not None and self._child.running else None

    def close(self) -> None:
        """End the process."""
        if self._child is not None:
            self._child.kill()
        self._child = None


def _message_end(buffer: bytearray) -> int:
    if len(buffer) < 8:
        return -1
    end = 8 + int.from_bytes(buffer[:8], "big")
    return end if len(buffer) >= end else -1
