"""What an engine is: a task goes in, an answer comes out within a budget, or a failure with its reason.

Source: the engine protocol of qpsolvers and Macaulay2's hooks, with budgets.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Certainty, Known
from singsym.polynomials import Polynomial, Ring


class EngineFailure(Undecided):
    """An engine hung, died, printed rubbish or gave a wrong answer; `engine` names it."""

    def __init__(self, engine: str, reason: str) -> None:
        super().__init__(f"{engine}: {reason}")
        self.engine = engine
        self.reason = reason

    def __reduce__(self) -> tuple[type[EngineFailure], tuple[str, str]]:
        return EngineFailure, (self.engine, self.reason)


class EngineUnavailable(Undecided):
    """No engine that is present and allowed can do this; the message says how to get one."""


class NotZeroDimensional(ValueError):
    """Finitely many complex points are expected, and there are infinitely many."""


@dataclass(frozen=True)
class Task:
    """A computation with polynomials of one ring.

    kind: "groebner" (reduced basis), "slim" (the same by way of short polynomials), "eliminate" (the
    variables `others`), "saturate" (by the product of `others`), "minimal_primes", or "facstd" (pieces with
    the same union of zero sets, not proven prime).
    characteristic: 0, or a prime below 2^31 to compute modulo it.
    """

    kind: str
    ring: Ring
    generators: tuple[Polynomial, ...]
    others: tuple[Polynomial, ...] = ()
    characteristic: int = 0


@dataclass(frozen=True)
class EngineAnswer:
    """The ideals that an engine returned, each as generators; one for most tasks."""

    ideals: tuple[tuple[Polynomial, ...], ...]
    engine: str
    certainty: Certainty = "proven"

    @property
    def known(self) -> Known[tuple[tuple[Polynomial, ...], ...]]:
        """The ideals with how they are known."""
        return Known(self.ideals, self.certainty)


class Engine(Protocol):
    """A program or library that answers tasks."""

    name: str

    def available(self) -> bool:
        """Whether it is installed here."""
        ...

    def can(self, task: Task) -> bool:
        """Whether it knows this kind of task, in this ring."""
        ...

    def run(self, task: Task, budget: Budget) -> EngineAnswer:
        """The unchecked answer; raises `EngineFailure` or `BudgetExceeded`."""
        ...

    def version(self) -> str:
        """Its version, or "" where it is not found."""
        ...

    def path(self) -> str:
        """Where it is, or "" where it is not found."""
        ...

    def cite(self) -> str:
        """The reference to cite for results computed with it."""
        ...

    def close(self) -> None:
        """End its processes, if it keeps any."""
        ...
