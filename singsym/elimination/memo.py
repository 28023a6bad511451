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

Value = TypeVar("Value")

_LIMIT = 20_000
_known: OrderedDict[Hashable, Any] = OrderedDict()
_lock = Lock()


def _after_fork() -> None:
    """In a forked child: the lock may be held by a thread that is not there."""
    global _lock
    _lock = Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


def remember(question: str, key: Hashable, compute: Callable[[], Value]) -> Value:
    """The value computed before for this question and key with the engines allowed now, or a new one.

    >>> remember("a doctest", 2, lambda: 4), remember("a doctest", 2, lambda: 5)
    (4, 4)
    """
    full = (question, key, engines.allowed())
    with _lock:
        if full in _known:
            _known.move_to_end(full)
            value: Value = _known[full]
            return value
    value = compute()
    store(question, key, value)
    return value


def store(question: str, key: Hashable, value: Any) -> None:
    """Remember a value found on the way to another one."""
    with _lock:
        _known[question, key, engines.allowed()] = value
        if len(_known) > _LIMIT:
            _known.popitem(last=False)


def is_known(question: str, key: Hashable) -> bool:
    """Whether `remember` would answer at once."""
    return (question, key, engines.allowed()) in _known


def forget() -> None:
    """Drop everything remembered."""
    with _lock:
        _known.clear()
