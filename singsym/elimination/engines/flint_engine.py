"""FLINT, in process for tiny ideals and in a worker process that can be killed for the rest.

Source: FLINT's `fmpz_mpoly_buchberger_naive` and `fmpz_mpoly_vec_autoreduction`, through python-flint.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import flint
from flint import fmpq_mpoly, fmpz_mpoly_vec

from singsym.effort.budget import Budget
from singsym.elimination.engines.base import EngineAnswer, Task
from singsym.elimination.engines.python_worker import PythonWorker
from singsym.polynomials import Polynomial

# (polynomials, terms of each, bits of a coefficient): what stays below takes milliseconds
_TINY = (40, 120, 256)


class FlintEngine:
    """Groebner bases by FLINT's Buchberger algorithm: the default for small ideals."""

    name = "flint"

    def __init__(self) -> None:
        self.worker = PythonWorker(self.name)

    def available(self) -> bool:
        return True

    def can(self, task: Task) -> bool:
        return task.kind == "groebner" and task.characteristic == 0

    def run(self, task: Task, budget: Budget) -> EngineAnswer:
        """The reduced Groebner basis in the ring's own order."""
        budget.ask("FLINT")
        basis = self.tiny(task)
        return EngineAnswer((self.worker.groebner(task, budget) if basis is None else basis,), self.name)

    def tiny(self, task: Task) -> tuple[Polynomial, ...] | None:
        """The basis, if it takes no more than milliseconds in this process, else `None`."""
        integers = [p.integer() for p in task.generators if p]
        if not integers:
            return ()
        if max(map(len, integers)) > _TINY[1] or len(integers) > _TINY[0]:
            return None
        vector: Any = fmpz_mpoly_vec(integers, task.ring.integer_context)
        basis, done = vector.buchberger_naive(limits=_TINY)
        if not done:
            return None
        reduced: fmpz_mpoly_vec = basis.autoreduction()
        return tuple(Polynomial(task.ring, fmpq_mpoly(p)).primitive() for p in reduced)

    def version(self) -> str:
        return f"{flint.__FLINT_VERSION__} (python-flint {flint.__version__})"

    def path(self) -> str:
        return str(Path(flint.__file__).parent)

    def cite(self) -> str:
        return "The FLINT team, FLINT: Fast Library for Number Theory, https://flintlib.org"

    def close(self) -> None:
        self.worker.close()
