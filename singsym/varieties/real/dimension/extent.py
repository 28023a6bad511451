"""A real dimension between two bounds, each with how it is known.

Source: the lemmas of `dimension_bounds`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from singsym.effort.verdict import Certainty, weakest


@dataclass(frozen=True)
class Extent:
    """The real dimension of a set: what a certified point says from below, and a bound from above.

    at_least: -1 where no point is known; at_most: -1 where the set is empty, None without a bound;
    bounded: how the bound from above is known; open: why the two may differ.

    >>> str(Extent(1, 1)), str(Extent(1, None)), str(Extent(-1, -1)), str(Extent())
    ('1', 'at least 1', 'empty', '?')
    """

    at_least: int = -1
    at_most: int | None = None
    bounded: Certainty = "proven"
    open: str = ""

    @property
    def dimension(self) -> int | None:
        """The dimension, -1 when empty, None where it is not known."""
        return self.at_least if self.at_least == self.at_most else None

    def __str__(self) -> str:
        if self.at_most == -1:
            return "empty"
        if self.dimension is not None:
            return str(self.dimension)
        return f"at least {self.at_least}" if self.at_least >= 0 else "?"

    @property
    def resting(self) -> str:
        """That a bound from above is not proven, in words; "" where it is."""
        return "" if self.bounded == "proven" else "that it is no larger rests on random primes"


UNKNOWN = Extent()
EMPTY = Extent(-1, -1)


def union(extents: Iterable[Extent], doubts: Iterable[str] = ()) -> Extent:
    """What is known of the union of some sets and, where there are doubts, of further ones.

    >>> str(union([Extent(2, 2), Extent(1, None, open="out of time")]))
    'at least 2'
    >>> str(union([Extent(2, 2), Extent(1, 2)]))
    '2'
    """
    parts = tuple(extents)
    at_least = max((e.at_least for e in parts), default=-1)
    reasons = list(doubts)
    reasons += [e.open or "no bound was found" for e in parts if e.at_most is None or e.at_most > at_least]
    if reasons:
        bounds = [e.at_most for e in parts]
        known = [b for b in bounds if b is not None]
        at_most = max(known, default=None) if len(known) == len(bounds) and not tuple(doubts) else None
        return Extent(at_least, at_most, open="; ".join(dict.fromkeys(reasons)))
    return Extent(at_least, at_least, weakest(*(e.bounded for e in parts if e.at_most == at_least)))
