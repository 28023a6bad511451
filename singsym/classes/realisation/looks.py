"""What several looks at a stratum say together, and whether a longer one may say more.

Source: singsym's own: only what may change the answer for its class gets much time.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from singsym.classes.realisation.realisation import Realised
from singsym.classes.result import Piece
from singsym.classes.taxonomy.types import SingularityType
from singsym.effort.verdict import weakest
from singsym.varieties.real.dimension.extent import Extent


def bounded_by(piece: Piece, extent: Extent) -> Piece:
    """A part of a set with a bound, which is that of the part as well where no other is known."""
    own = piece.extent
    if own.at_most is None or own.at_most != extent.at_most:
        return piece
    return replace(piece, extent=replace(own, bounded=weakest(own.bounded, extent.bounded)))


def known_dimensions(pieces: Iterable[Piece]) -> dict[SingularityType, int]:
    """The largest dimension of each class that a certified point shows."""
    found: dict[SingularityType, int] = {}
    for piece in pieces:
        if piece.verdict.is_yes:
            types = piece.defects.types
            found[types] = max(piece.extent.at_least, found.get(types, 0))
    return found


def merged(before: Realised, after: Realised) -> Realised:
    """What two looks at a stratum say together: points and bounds of the first stay known."""
    if any(not p.verdict.is_undecided for p in after.pieces):
        return after
    pairs = zip(before.pieces, after.pieces, strict=True)
    return Realised(
        tuple(replace(p if p.verdict.is_yes else q, extent=_with_bound(p.extent, q.extent)) for p, q in pairs)
    )


def _with_bound(extent: Extent, other: Extent) -> Extent:
    """A dimension with the smaller of two bounds from above."""
    known = [e for e in (extent, other) if e.at_most is not None]
    best = min(known, key=lambda e: e.at_most or 0, default=extent)
    return replace(extent, at_most=best.at_most, bounded=best.bounded, open=other.open or extent.open)


def is_open(piece: Piece, known: int | None) -> bool:
    """Whether a longer look may change what is known of the class: parts, dimension, points, components."""
    if piece.verdict.is_no:
        return False
    most = piece.extent.at_most
    if known is None or most is None or most > known:
        return True
    uncounted = known == 0 and piece.points is None
    return uncounted or piece.verdict.is_undecided
