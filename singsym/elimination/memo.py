"""Results remembered by content: the same question about the same polynomials is answered once.

Source: content-addressed caches; the keys are values, never identities.
"""

from __future__ import annotations

import os
from collections import OrderedDict
from collections.abc import Callable, Hashable
from threading import Lock
from typing import Any, TypeVar

from singsym.elimination import engines
from singsym.elimination.verdict import Certainty, certainties, note, weakest

Value = TypeVar("Value")

_LIMIT = 20_000
_known: OrderedDict[Hashable, tuple[Any, Certainty]] = OrderedDict()
_lock = Lock()


def _after_fork() -> None:
    """In a forked child: the lock may be held by a thread that is not there."""
    global _lock
    _lock = Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


def _full(question: str, key: Hashable) -> Hashable:
    return question, key, engines.allowed(), engines.proof_patience()


def remember(question: str, key: Hashable, compute: Callable[[], Value]) -> Value:
    """The value computed before for this question and key with the engines allowed now, or a new one.

    How the value is known is remembered with it, see `verdict.certainties`.

    >>> remember("a doctest", 2, lambda: 4), remember("a doctest", 2, lambda: 5)
    (4, 4)
    """
    full = _full(question, key)
    with _lock:
        known = _known.get(full)
        if known is not None:
            _known.move_to_end(full)
    if known is None:
        with certainties() as seen:
            known = compute(), weakest(*seen)
        with _lock:
            _known[full] = known
            if len(_known) > _LIMIT:
                _known.popitem(last=False)
    else:
        note(known[1])
    value: Value = known[0]
    return value


def is_known(question: str, key: Hashable) -> bool:
    """Whether `remember` would answer at once."""
    return _full(question, key) in _known


def forget() -> None:
    """Drop everything remembered."""
    with _lock:
        _known.clear()
