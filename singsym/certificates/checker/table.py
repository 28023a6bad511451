"""The table that the leaves of a certificate prove together, and what of the claims it does not.

Source: Zlatanov, Fenton, Benhabib (1998), Table 1; singsym's own for what leaves leave open.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, combinations, product
from typing import Any

from flint import fmpq_mpoly

from singsym.certificates.checker.curves import Loops
from singsym.certificates.checker.polynomials import Rejected
from singsym.certificates.checker.sets import RealSet, listed

Groups = tuple[tuple[int, ...], ...]


@dataclass(frozen=True, eq=False)
class Finding:
    """What a leaf shows of its set.

    types: those that its points can have; points: their number, None where it is not known; low, high: bounds
    of its dimension, -1 for the empty set; components: those of a smooth curve, all zeros of its equations,
    that is its closure, in tubes; zero: whether a polynomial vanishes at its points, where that is known;
    line: of the leaf, 0 for an open set; joins: by lines of other curves, which loops of both meet.
    """

    at: RealSet
    types: frozenset[str]
    points: int | None
    low: int
    high: int
    components: Loops | None = None
    zero: Callable[[fmpq_mpoly], bool] | None = None
    line: int = 0
    joins: Mapping[int, Sequence[tuple[int, int]]] = field(default_factory=dict)

    def overlaps(self, other: Finding) -> bool:
        """Whether a tube of one curve and one of another may have a point in common."""
        tubes = (chain(*(f.components or ())) for f in (self, other))
        return any(a.overlaps(b) for a, b in product(*tubes))

    def holds(self, other: Finding) -> bool:
        """Whether finitely many points lie on the curve."""
        return other.zero is not None and all(map(other.zero, self.at.generators))


@dataclass(frozen=True)
class Row:
    """What is known of the configurations of exactly some types; None: not proven.

    components: connected ones, curves closed up; together: lists of lines of curves, of which those of one
    list are counted together, where they may meet, and all others by themselves.
    """

    types: str
    occurs: bool | None
    dimension: int | None = None
    points: int | None = None
    components: int | None = None
    together: Groups = ()

    def text(self) -> str:
        """The row in words."""
        if not self.occurs:
            return f"{self.types}: {'not proven' if self.occurs is None else 'empty'}"
        numbers = ((self.points, "points"), (self.components, "components"))
        sizes = [f"{k} {word}" for k, word in numbers if k is not None]
        groups = [f"curves of lines {', '.join(map(str, own))} together" for own in self.together]
        dimension = "dimension not proven" if self.dimension is None else f"dimension {self.dimension}"
        return f"{self.types}: occurs, {', '.join((dimension, *sizes, *groups))}"


def proven_row(types: str, findings: Iterable[Finding], together: Groups = ()) -> Row:
    """The row that all leaves of a certificate prove; raises `Rejected` where `together` is not of curves."""
    own = [f for f in findings if types in f.types and f.high >= 0]
    if not own:
        return Row(types, False, -1, 0, 0)
    sure = [f for f in own if f.low >= 0 and len(f.types) == 1]
    if not sure:
        return Row(types, None)
    low, high = max(f.low for f in sure), max(f.high for f in own)
    points = _sum(f.points for f in own)
    # points that lie on a curve of the row are no components of their own
    curves = [f for f in own if f.components is not None and len(f.types) == 1]
    apart = [f.points for f in own if f not in curves and not any(c.holds(f) for c in curves)]
    by_line = {f.line: f for f in curves}
    if wrong := {*chain(*together)} - {*by_line}:
        raise Rejected(f"claims: {types}: there are no curves of it in lines {sorted(wrong)}")
    counted = [[by_line[k] for k in sorted(own)] for own in together]
    counted += [[f] for f in curves if f.line not in chain(*together)]
    components = _sum([*apart, *map(_pieces, counted)])
    return Row(types, True, low if low == high else None, points, components, together)


def _sum(numbers: Iterable[int | None]) -> int | None:
    known = [*numbers]
    return None if None in known else sum(k for k in known if k is not None)


def _pieces(curves: Sequence[Finding]) -> int | None:
    """How many connected components curves have together; None where it is not known which loops meet."""
    piece = {(f.line, k): (f.line, k) for f in curves for k in range(len(f.components or ()))}
    for one, two in combinations(curves, 2):
        if one.line not in two.joins and one.overlaps(two):
            return None
        for k, i in two.joins.get(one.line, ()):
            old, new = piece[two.line, k], piece[one.line, i]
            piece = {key: new if of == old else of for key, of in piece.items()}
    return len({*piece.values()})


def claimed_rows(data: Any) -> tuple[Row, ...]:
    """The rows that a certificate says it proves; raises `Rejected`."""
    if not isinstance(data, list) or not data:
        raise Rejected("claims: expected a list of rows")
    return tuple(map(_claimed, data))


def _claimed(entry: Any) -> Row:
    if not isinstance(entry, Mapping) or not isinstance(entry.get("types"), str):
        raise Rejected(f"claims: expected rows with types, got {str(entry)[:80]}")
    occurs = entry.get("occurs")
    dimension, points, components = numbers = [
        entry.get(key) for key in ("dimension", "points", "components")
    ]
    if occurs not in (True, False, None) or not all(k is None or type(k) is int for k in numbers):
        raise Rejected(f"claims: expected true or false, and numbers, got {str(entry)[:80]}")
    together = tuple(map(tuple, listed(entry, "together", list, [])))
    lines = [*chain(*together)]
    if not all(type(k) is int for k in lines) or len({*lines}) < len(lines):
        raise Rejected(f"claims: expected each curve once, got {str(together)[:80]}")
    return Row(entry["types"], occurs, dimension, points, components, together)


def contradicted(claim: Row, proven: Row) -> bool:
    """Whether what is claimed of a row is proven to be wrong."""
    pairs = _pairs(claim, proven)
    return any(a is not None and b is not None and a != b for _, a, b in pairs)


def unproven(claim: Row, proven: Row) -> list[str]:
    """What of a claimed row is not proven, and what it does not claim though a table has it."""
    found = [what for what, a, b in _pairs(claim, proven) if a is not None and b is None]
    if claim.occurs is None:
        found.append("occurrence is not claimed")
    elif claim.occurs and claim.dimension is None:
        found.append("dimension is not claimed")
    elif claim.occurs and claim.dimension == 0 and claim.points is None:
        found.append("number of points is not claimed")
    return found


def _pairs(claim: Row, proven: Row) -> tuple[tuple[str, Any, Any], ...]:
    whether = ("occurrence", claim.occurs, proven.occurs)
    if claim.occurs is False:
        return (whether,)
    return (
        whether,
        ("dimension", claim.dimension, proven.dimension),
        ("number of points", claim.points, proven.points),
        ("number of components", claim.components, proven.components),
    )
