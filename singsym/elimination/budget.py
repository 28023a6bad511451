"""Budgets of time and memory, passed down to whatever does the work.

Source: a deadline on the monotonic clock, as in Go's contexts and trio's cancel scopes.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextvars import ContextVar, Token

from singsym.elimination.chaos import strikes


class Undecided(Exception):
    """A computation ended without an answer; the message is the reason to report."""


class BudgetExceeded(Undecided):
    """The time or memory given to a computation is used up."""


class Cancelled(Undecided):
    """The work was called off from outside."""


class Budget:
    """So many seconds from now, and so much memory for each helper process; `None` is without limit.

    Memory is watched on Linux; without a limit a helper ends at 70 % of the machine's.

    As a context manager it is the budget of everything inside that is not given another one.

    >>> Budget(60).part(seconds=5).remaining() <= 5
    True
    >>> Budget(0).check("a Groebner basis")
    Traceback (most recent call last):
    ...
    singsym.elimination.budget.BudgetExceeded: no time is left in the budget (a Groebner basis)
    """

    __slots__ = ("_is_attempt", "_token", "cancelled", "deadline", "memory_mb", "seconds")

    def __init__(
        self,
        seconds: float | None = None,
        memory_mb: int | None = None,
        cancelled: Callable[[], bool] | None = None,
    ) -> None:
        self.seconds = seconds
        self.memory_mb = memory_mb
        self.cancelled = cancelled
        self.deadline = None if seconds is None else time.monotonic() + seconds
        self._is_attempt = False
        self._token: Token[Budget] | None = None

    def remaining(self) -> float | None:
        """Seconds left (never negative), or `None` where time is not limited."""
        return None if self.deadline is None else max(0.0, self.deadline - time.monotonic())

    def check(self, what: str = "") -> None:
        """Raise `BudgetExceeded` or `Cancelled` where the work should end; `what` names it."""
        if self.cancelled is not None and self.cancelled():
            raise Cancelled(f"called off{f' ({what})' if what else ''}")
        if self.deadline is not None and time.monotonic() >= self.deadline:
            used = f"the budget of {self.seconds:.3g} s is used up"
            spent = used if self.seconds else "no time is left in the budget"
            raise BudgetExceeded(spent + (f" ({what})" if what else ""))

    def ask(self, what: str) -> None:
        """`check` at the door of an engine or of a proof; what `chaos` withholds looks the same."""
        self.check(what)
        if strikes():
            raise BudgetExceeded(f"the budget of {self.seconds or 0:.3g} s is used up ({what})")

    def part(self, seconds: float | None = None, memory_mb: int | None = None) -> Budget:
        """A budget that ends with this one and has no more than so many seconds or megabytes."""
        left = self.remaining()
        limits = [s for s in (left, seconds) if s is not None]
        memory = [m for m in (self.memory_mb, memory_mb) if m is not None]
        found = Budget(min(limits, default=None), min(memory, default=None), self.cancelled)
        found._is_attempt = seconds is not None
        return found

    def __enter__(self) -> Budget:
        if self._is_attempt and strikes():
            raise BudgetExceeded(f"the budget of {self.seconds or 0:.3g} s is used up")
        self._token = _current.set(self)
        return self

    def __exit__(self, *error: object) -> None:
        if self._token is not None:
            _current.reset(self._token)
            self._token = None

    def __reduce__(self) -> tuple[type[Budget], tuple[float | None, int | None]]:
        return Budget, (self.remaining(), self.memory_mb)

    def __repr__(self) -> str:
        left = self.remaining()
        time_left = "no limit" if left is None else f"{left:.3g} s left"
        return f"Budget({time_left}{f', {self.memory_mb} MB' if self.memory_mb else ''})"


_current: ContextVar[Budget] = ContextVar("budget")


def current(budget: Budget | None = None) -> Budget:
    """The budget given, else that of the enclosing `with Budget(...)`, else one without limits."""
    return budget or _current.get(None) or Budget()
