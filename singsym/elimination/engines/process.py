"""Child processes that end with their parent, on time and within memory, whatever they do.

Source: POSIX process groups; prctl(2) PR_SET_PDEATHSIG on Linux.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import queue
import signal
import subprocess
import sys
import threading
import time
import weakref
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

from singsym.effort.budget import Budget, BudgetExceeded
from singsym.effort.processor_time import Meter
from singsym.elimination.engines.base import EngineFailure

_OUTPUT_LIMIT = 1 << 30
_POLL_SECONDS = 0.05
_alive: weakref.WeakSet[Child] = weakref.WeakSet()


def _dies_with_parent() -> Callable[[], None] | None:
    """What the child does first, so that the kernel kills it when its parent is gone (Linux)."""
    if not sys.platform.startswith("linux"):
        return None
    import ctypes

    libc = ctypes.CDLL(None)
    parent = os.getpid()

    def prepare() -> None:
        libc.prctl(1, signal.SIGKILL)
        if os.getppid() != parent:
            os._exit(1)

    return prepare


@lru_cache(maxsize=1)
def _prefix() -> tuple[str, ...]:
    """A program that starts the child so, where there is one: without, a large parent is slow to fork."""
    command = ("setpriv", "--pdeathsig", "KILL")
    try:
        tried = subprocess.run([*command, "true"], capture_output=True, check=False)
    except OSError:
        return ()
    return command if tried.returncode == 0 else ()


def _memory_limit_mb() -> float:
    """What a child may take where no budget says so: most of the machine's memory."""
    try:
        return 0.7 * os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**20
    except (ValueError, OSError, AttributeError):
        return float("inf")


def _resident_mb(pid: int) -> float:
    """Resident memory in MB; 0 where it cannot be read."""
    try:
        with open(f"/proc/{pid}/statm") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20
    except (OSError, ValueError, IndexError):
        return 0.0


class Child:
    """A process with pipes that never block its parent: one thread reads, one writes.

    engine: who to name in errors.  The process has its own group, which ends as a whole.
    """

    def __init__(self, engine: str, command: Sequence[str]) -> None:
        self.engine = engine
        self.owner = os.getpid()
        options: dict[str, Any] = {}
        if os.name == "posix":
            options = {"start_new_session": True}
            if not _prefix():
                options["preexec_fn"] = _dies_with_parent()
        try:
            self.process = subprocess.Popen(
                [*_prefix(), *command],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                bufsize=0,
                **options,
            )
        except OSError as error:
            raise EngineFailure(engine, f"cannot be started: {error}") from None
        self._chunks: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._outbox: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._buffer = bytearray()
        threading.Thread(target=self._read, daemon=True).start()
        threading.Thread(target=self._write, daemon=True).start()
        _alive.add(self)

    def _read(self) -> None:
        assert self.process.stdout is not None
        descriptor = self.process.stdout.fileno()
        while True:
            try:
                chunk = os.read(descriptor, 1 << 16)
            except (OSError, ValueError):
                chunk = b""
            self._chunks.put(chunk)
            if not chunk:
                return

    def _write(self) -> None:
        assert self.process.stdin is not None
        while (data := self._outbox.get()) is not None:
            with contextlib.suppress(OSError, ValueError):
                self.process.stdin.write(data)
        with contextlib.suppress(OSError, ValueError):
            self.process.stdin.close()

    @property
    def running(self) -> bool:
        """Whether it can take work in this process (a fork of the parent must not share it)."""
        return self.owner == os.getpid() and self.process.poll() is None

    def send(self, data: bytes) -> None:
        """Hand over input; returns at once."""
        view = memoryview(data)
        for start in range(0, len(data), 1 << 15):
            self._outbox.put(bytes(view[start : start + (1 << 15)]))

    def end_input(self) -> None:
        """Close the child's standard input after what was sent."""
        self._outbox.put(None)

    def read_until(self, complete: Callable[[bytearray], int], budget: Budget) -> bytes:
        """Output up to the position that `complete` finds (-1: not yet); kills the child on failure.

        Raises `BudgetExceeded` out of time or memory, `EngineFailure` when the child dies first.
        """
        meter = Meter(self.process.pid)
        try:
            while (end := complete(self._buffer)) < 0:
                self._wait(budget, meter)
            meter.charge()
            data = bytes(self._buffer[:end])
            del self._buffer[:end]
            return data
        except BaseException:
            self.kill()
            raise

    def wait_exit(self, budget: Budget) -> bytes:
        """All output, once the child has closed it; its exit status must be 0."""
        meter = Meter(self.process.pid)
        try:
            while self._wait(budget, meter, closing=True):
                pass
            meter.charge()
            while (status := self.process.poll()) is None:
                budget.check(f"waiting for {self.engine}")
                time.sleep(0.001)
                meter.charge()
        except BaseException:
            self.kill()
            raise
        self.kill()
        if status != 0:
            raise EngineFailure(self.engine, f"died with status {status}")
        return bytes(self._buffer)

    def _wait(self, budget: Budget, meter: Meter, closing: bool = False) -> bool:
        """Take one chunk of output into the buffer; False at its end, if that is allowed."""
        meter.charge()
        budget.check(f"waiting for {self.engine}")
        left = budget.remaining()
        pause = _POLL_SECONDS if left is None else min(_POLL_SECONDS, left)
        try:
            chunk = self._chunks.get(timeout=pause)
        except queue.Empty:
            limit = budget.memory_mb or _memory_limit_mb()
            if _resident_mb(self.process.pid) > limit:
                raise BudgetExceeded(f"{self.engine} took more than {limit:.0f} MB") from None
            return True
        if not chunk:
            if closing:
                return False
            raise EngineFailure(self.engine, "died before it answered")
        self._buffer += chunk
        if len(self._buffer) > _OUTPUT_LIMIT:
            raise EngineFailure(self.engine, "printed without end")
        return True

    def kill(self) -> None:
        """End the process and all its children."""
        self._outbox.put(None)
        if self.owner != os.getpid():
            return
        if os.name == "posix":
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(self.process.pid, signal.SIGKILL)
        else:
            with contextlib.suppress(OSError):
                self.process.kill()
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(timeout=5)


@atexit.register
def kill_all() -> None:
    """End every child process."""
    for child in list(_alive):
        child.kill()
