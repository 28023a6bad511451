"""Budgets of time, work and memory, passed down to whatever does the work.

Source: a deadline on the monotonic clock, as in Go's contexts and trio's cancel scopes.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextvars import ContextVar, Token

from singsym.effort import progress
from singsym.effort.chaos import strikes
from singsym.effort.processor_time import worked

WAITING = 20.0
"""A budget of work ends after so many times as many seconds in any case."""


class Undecided(Exception):
    """A computation ended without an answer; the message is the reason to report."""


class BudgetExceeded(Undecided):
    """The time, work or memory given to a computation is used up."""


class Cancelled(Undecided):
    """The work was called off from outside."""


class Budget:
    """So many seconds from now, and so much memory for each helper process; `None` is without limit.

    work: so many seconds of processor time, of this thread and of the engines that it waits for (see
    `processor_time`).
    What a proof is given is work, so that other programs on the machine do not change its answer.
    Memory is watched on Linux; without a limit a helper ends at 70 % of the machine's.

    As a context manager it is the budget of everything inside that is not given another one.

    >>> Budget(60).part(work=5).remaining() <= 5
    True
    >>> Budget(0).check("a Groebner basis")
    Traceback (most recent call last):
    ...
    singsym.effort.budget.BudgetExceeded: no time is left in the budget (a Groebner basis)
    """

    __slots__ = ("_deadline", "_token", "_work_ends", "cancelled", "memory_mb", "seconds")

    def __init__(
        self,
        seconds: float | None = None,
        memory_mb: int | None = None,
        cancelled: Callable[[], bool] | None = None,
        work: float | None = None,
    ) -> None:
        self.seconds = _least(seconds, work)
        self.memory_mb = memory_mb
        self.cancelled = cancelled
        longest = _least(seconds, None if work is None else WAITING * work)
        self._deadline = None if longest is None else time.monotonic() + longest
        self._work_ends = None if work is None else worked() + work
        self._token: Token[Budget] | None = None

    def remaining(self) -> float | None:
        """Seconds left, of time or of work (never negative), or `None` where neither is limited."""
        return _least(self.time_left(), self._work_left())

    def time_left(self) -> float | None:
        """Seconds left on the clock."""
        return None if self._deadline is None else max(0.0, self._deadline - time.monotonic())

    def _work_left(self) -> float | None:
        return None if self._work_ends is None else max(0.0, self._work_ends - worked())

    def is_worked_off(self) -> bool:
        """Whether its work is used up, whatever time is left."""
        return self._work_left() == 0.0

    def check(self, what: str = "") -> None:
        """Raise `BudgetExceeded` or `Cancelled` where the work should end; `what` names it."""
        progress.beat()
        if self.cancelled is not None and self.cancelled():
            raise Cancelled(f"called off{f' ({what})' if what else ''}")
        if self.remaining() == 0.0:
            raise self._exceeded(what)

    def ask(self, what: str) -> None:
        """`check` at the door of an engine or of a proof; what `chaos` withholds looks the same."""
        self.check(what)
        if strikes():
            raise self._exceeded(what)

    def _exceeded(self, what: str) -> BudgetExceeded:
        used = f"the budget of {self.seconds or 0:.3g} s is used up"
        spent = used if self.seconds else "no time is left in the budget"
        return BudgetExceeded(spent + (f" ({what})" if what else ""))

    def part(self, work: float | None = None, memory_mb: int | None = None) -> Budget:
        """A budget that ends with this one and has no more than so much work or so many megabytes."""
        memory = min((m for m in (self.memory_mb, memory_mb) if m is not None), default=None)
        found = Budget(None, memory, self.cancelled, _least(self._work_left(), work))
        found._deadline = _least(self._deadline, found._deadline)
        found.seconds = _least(self.remaining(), work)
        return found

    def __enter__(self) -> Budget:
        self._token = _current.set(self)
        return self

    def __exit__(self, *error: object) -> None:
        if self._token is not None:
            _current.reset(self._token)
            self._token = None

    def __reduce__(self) -> tuple[type[Budget], tuple[float | None, int | None, None, float | None]]:
        return Budget, (self.time_left(), self.memory_mb, None, self._work_left())

    def __repr__(self) -> str:
        left = self.remaining()
        time_left = "no limit" if left is None else f"{left:.3g} s left"
        return f"Budget({time_left}{f', {self.memory_mb} MB' if self.memory_mb else ''})"


def _least(*limits: float | None) -> float | None:
    return min((limit for limit in limits if limit is not None), default=None)


_current: ContextVar[Budget] = ContextVar("budget")


def current(budget: Budget | None = None) -> Budget:
    """The budget given, else that of the enclosing `with Budget(...)`, else one without limits."""
    return budget or _current.get(None) or Budget()
