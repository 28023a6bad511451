"""SymPy, the slow reference that shares no code with the others; it works only where it is named.

Source: `sympy.groebner` (https://sympy.org).
"""

from __future__ import annotations

from pathlib import Path

import sympy

from singsym.effort.budget import Budget
from singsym.elimination.engines.base import EngineAnswer, Task
from singsym.elimination.engines.python_worker import PythonWorker


class SympyEngine:
    """Groebner bases by SymPy, in a process that can be killed."""

    name = "sympy"

    def __init__(self) -> None:
        self.worker = PythonWorker(self.name)

    def available(self) -> bool:
        return True

    def can(self, task: Task) -> bool:
        return task.kind == "groebner" and task.characteristic == 0

    def run(self, task: Task, budget: Budget) -> EngineAnswer:
        """The reduced Groebner basis in the ring's own order."""
        budget.ask("SymPy")
        return EngineAnswer((self.worker.groebner(task, budget),), self.name)

    def version(self) -> str:
        return str(sympy.__version__)

    def path(self) -> str:
        return str(Path(sympy.__file__).parent)

    def cite(self) -> str:
        return "A. Meurer et al., SymPy: symbolic computing in Python, PeerJ Computer Science 3 (2017) e103"

    def close(self) -> None:
        self.worker.close()
