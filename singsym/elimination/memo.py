"""Results remembered by content: the same question about the same polynomials is answered once.

What more time might have made better is kept with the time that there was, and looked for again with more.
Source: content-addressed caches; the keys are values, never identities.
"""

from __future__ import annotations

import os
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from math import inf
from threading import Lock
from typing import Any, TypeVar

from singsym.effort import chance, chaos, patience
from singsym.effort.attempts import cut_short, hurries
from singsym.effort.budget import Budget, current
from singsym.elimination import engines

Value = TypeVar("Value")

_LIMIT = 20_000
_AS_LONG = 1.05
"""So many times as much time as there was before will hardly make an answer better."""


@dataclass(frozen=True)
class _Entry:
    """A value, what was cut short on the way to it, and the time that there was for it then."""

    value: Any
    cuts: tuple[str, ...] = ()
    time: float = inf

    def will_do(self, budget: Budget | None) -> bool:
        """Whether it is what would be found in that budget as well."""
        return not self.cuts or _time_left(budget) <= _AS_LONG * self.time


_known: OrderedDict[Hashable, _Entry] = OrderedDict()
_lock = Lock()


def _after_fork() -> None:
    """In a forked child: the lock may be held by a thread that is not there."""
    global _lock
    _lock = Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


def _full(question: str, key: Hashable) -> Hashable:
    return question, key, engines.allowed(), patience.in_force(), chance.seed()


def _time_left(budget: Budget | None) -> float:
    left = current(budget).remaining()
    return inf if left is None else left


def remember(
    question: str, key: Hashable, compute: Callable[[], Value], budget: Budget | None = None
) -> Value:
    """The value computed before for this question and key with the engines allowed now, or a new one.

    budget: that of the computation, where it is not the current one.

    >>> remember("a doctest", 2, lambda: 4), remember("a doctest", 2, lambda: 5)
    (4, 4)
    """
    full = _full(question, key)
    with _lock:
        known = _known.get(full)
        if known is not None:
            _known.move_to_end(full)
    if known is None or not known.will_do(budget):
        known = _computed(compute, budget)
        if not (known.cuts and chaos.reigns()):
            with _lock:
                _known[full] = known
                if len(_known) > _LIMIT:
                    _known.popitem(last=False)
    else:
        for what in known.cuts:
            cut_short(what)
    value: Value = known.value
    return value


def _computed(compute: Callable[[], Any], budget: Budget | None) -> _Entry:
    time = _time_left(budget)
    with hurries() as cuts:
        value = compute()
    return _Entry(value, tuple(cuts), time)


def is_known(question: str, key: Hashable, budget: Budget | None = None) -> bool:
    """Whether `remember` would answer at once."""
    known = _known.get(_full(question, key))
    return known is not None and known.will_do(budget)


def forget() -> None:
    """Drop everything remembered."""
    with _lock:
        _known.clear()
