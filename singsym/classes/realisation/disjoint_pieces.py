"""What the disjoint parts of a set come to together.

Source: singsym's own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from singsym.classes.realisation.finite_sets import CertifiedPoints
from singsym.classes.result import Piece
from singsym.effort.verdict import Verdict, weakest
from singsym.varieties.real.dimension.extent import union


def in_parts(found: Sequence[tuple[Piece, CertifiedPoints]]) -> tuple[Piece, CertifiedPoints]:
    """The piece of which these are all parts, with their points, those of a larger dimension first."""
    if len(found) == 1:
        return found[0]
    ordered = sorted(found, key=lambda own: -own[0].extent.at_least)
    pieces = [piece for piece, _ in ordered]
    empty = [piece.verdict for piece in pieces if piece.verdict.is_no]
    certainty = weakest(*(verdict.certainty for verdict in empty), "proven")
    if len(empty) == len(pieces):
        reason = "; ".join(dict.fromkeys(verdict.reason for verdict in empty))
        return replace(pieces[0], verdict=Verdict.no(certainty, reason=reason)), ()
    extent = union(piece.extent for piece in pieces)
    numbers = [0 if piece.verdict.is_no else piece.points for piece in pieces]
    known = [number for number in numbers if number is not None]
    total = sum(known) if len(known) == len(pieces) else None
    whole = replace(
        next((p for p in pieces if p.verdict.is_yes), next(p for p in pieces if not p.verdict.is_no)),
        extent=replace(extent, bounded=weakest(extent.bounded, certainty)),
        points=total,
        components=total,
    )
    return whole, tuple(point for _, points in ordered for point in points)
