"""Attempts that may come to nothing, and whether more time would have changed what was made of them.

Source: the rule that less time may make an answer less decided, never different, and never for good.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.chaos import strikes

log = logging.getLogger("singsym")

_hurries: ContextVar[list[str] | None] = ContextVar("hurries", default=None)


@contextmanager
def hurries() -> Iterator[list[str]]:
    """A list of what is cut short inside: what comes out might be more decided with more time.

    >>> with hurries() as cut, Budget(0), attempt("a proof", part_of=Budget()):
    ...     cut_short("a proof")
    >>> cut
    ['a proof']
    """
    outer, seen = _hurries.get(), list[str]()
    token = _hurries.set(seen)
    try:
        yield seen
    finally:
        _hurries.reset(token)
        if outer is not None:
            outer.extend(what for what in seen if what not in outer)


def cut_short(what: str) -> None:
    """Say that the work goes on without an answer that more time might have given."""
    seen = _hurries.get()
    if seen is not None and what not in seen:
        seen.append(what)


@contextmanager
def attempt(
    what: str,
    work: float | None = None,
    *,
    share: float = 1.0,
    part_of: Budget | None = None,
    failures: list[Undecided] | None = None,
) -> Iterator[Budget]:
    """So much work, or that share of what is left, for an answer that can be gone without.

    What is undecided inside leaves the block; the end of the whole budget is raised.  Where the block's own
    allowance is used up the same happens again with more time around; all else is noted as `cut_short`.
    failures: a list that what is undecided is added to.

    >>> with attempt("a proof", 5):
    ...     raise Undecided("no")
    >>> with Budget(0), attempt("a proof", 5):
    ...     pass
    Traceback (most recent call last):
    ...
    singsym.effort.budget.BudgetExceeded: no time is left in the budget (a proof)
    """
    whole = current(part_of)
    whole.check(what)
    left = whole.remaining()
    shared = None if left is None else left * share
    struck = strikes()
    is_own = not struck and work is not None and (shared is None or work < shared)
    own = whole.part(0.0 if struck else work if is_own else shared)
    try:
        with own:
            yield own
    except Undecided as failure:
        log.debug("%s: %s", what, failure)
        if failures is not None:
            failures.append(failure)
        whole.check(what)
        if not (is_own and own.is_worked_off()):
            cut_short(what)
