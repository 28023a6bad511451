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

Groups = tuple[tuple[tuple[int, ...], ...], ...]


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

    components: connected ones, curves closed up; together: lists of loops, each by its line and place, of
    which those of one list are counted together, where they may meet, and all others by themselves.
    """

    types: str
    occurs: bool | None
    dimension: int | None = None
    points: int | None = None
    components: int | None = None
    together: Groups = ()


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
    alone = {(f.line, k) for f in curves for k in range(len(f.components or ()))} - {*chain(*together)}
    components = _sum([*apart, len(alone), *(_pieces(curves, own) for own in together)])
    return Row(types, True, low if low == high else None, points, components, together)


def _sum(numbers: Iterable[int | None]) -> int | None:
    known = [*numbers]
    return None if None in known else sum(k for k in known if k is not None)


def _pieces(curves: Sequence[Finding], own: Sequence[tuple[int, ...]]) -> int | None:
    """How many connected components loops have together; None where it is not known which of them meet."""
    piece = {loop: loop for loop in own}
    known = {(f.line, k) for f in curves for k in range(len(f.components or ()))}
    if not known.issuperset(own):
        raise Rejected(f"claims: there are no curves of these types with the loops {str(own)[:80]}")
    for one, two in combinations([f for f in curves if any(f.line == loop[0] for loop in own)], 2):
        if one.line not in two.joins and one.overlaps(two):
            return None
        for k, i in two.joins.get(one.line, ()):
            if (two.line, k) in piece and (one.line, i) in piece:
                old, new = piece[two.line, k], piece[one.line, i]
                piece = {key: new if of == old else of for key, of in piece.items()}
    return len({*piece.values()})


def claimed_rows(header: Mapping[str, Any]) -> tuple[Row, ...]:
    """The rows that a certificate says it proves; raises `Rejected`."""
    return tuple(map(_claimed, listed(header, "claims", dict)))


def _claimed(entry: Mapping[str, Any]) -> Row:
    types, occurs = entry.get("types"), entry.get("occurs")
    numbers = {key: entry.get(key) for key in ("dimension", "points", "components")}
    known = isinstance(types, str) and (occurs is None or type(occurs) is bool)
    if not known or not all(k is None or type(k) is int for k in numbers.values()):
        raise Rejected(f"claims: expected types, true or false, and numbers, got {str(entry)[:80]}")
    groups = [listed({"together": own}, "together", list) for own in listed(entry, "together", list, [])]
    together = tuple(tuple(map(tuple, own)) for own in groups)
    loops = [*chain(*together)]
    if any(type(k) is not int for k in chain(*loops)) or len({*loops}) < len(loops):
        raise Rejected(f"claims: expected each loop once, [line, place], got {str(together)[:80]}")
    return Row(str(types), occurs, **numbers, together=together)


def unproven(claim: Row, proven: Row) -> list[str]:
    """What of a claimed row is not proven, and what is not claimed; raises `Rejected` if it is wrong."""
    found, finite = [], claim.occurs and claim.dimension == 0
    for key, word, expected in (
        ("occurs", "occurrence", True),
        ("dimension", "dimension", claim.occurs),
        ("points", "number of points", finite),
        ("components", "number of components", False),
    )[: 1 if claim.occurs is False else None]:
        a, b = getattr(claim, key), getattr(proven, key)
        if None not in (a, b) and a != b:
            raise Rejected(f"claims: {word} of {claim.types} is not {a}; proven is {b}")
        if a is None and expected:
            found.append(f"{word} is not claimed")
        elif a is not None and b is None:
            found.append(word)
    return found
