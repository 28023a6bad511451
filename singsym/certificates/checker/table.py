"""The table that the leaves of a certificate prove together, and what of the claims it does not.

Source: Zlatanov, Fenton, Benhabib (1998), Table 1; singsym's own for what leaves leave open.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from flint import fmpq_mpoly

from singsym.certificates.checker.polynomials import Rejected
from singsym.certificates.checker.sets import RealSet


@dataclass(frozen=True)
class Finding:
    """What a leaf shows of its set.

    types: those that its points can have; points: their number, None where it is not known; low, high: bounds
    of its dimension, -1 for the empty set; components: those of a smooth curve, all zeros of its equations,
    that is its closure; zero: whether a polynomial vanishes at its points, where that is known exactly; line:
    of the leaf, 0 for a set that is left open.
    """

    at: RealSet
    types: frozenset[str]
    points: int | None
    low: int
    high: int
    components: int | None = None
    zero: Callable[[fmpq_mpoly], bool] | None = None
    line: int = 0

    @property
    def closed_components(self) -> int | None:
        """Components of the set, closed up."""
        return self.components if self.points is None else self.points

    def holds(self, other: Finding) -> bool:
        """Whether finitely many points lie on the curve."""
        return (
            self.components is not None
            and other.zero is not None
            and all(map(other.zero, self.at.generators))
        )


@dataclass(frozen=True)
class Row:
    """What is known of the configurations of exactly some types; None: not proven.

    components: connected components, those of a curve closed up.
    """

    types: str
    occurs: bool | None
    dimension: int | None = None
    points: int | None = None
    components: int | None = None

    def text(self) -> str:
        """The row in words."""
        if self.occurs is None:
            return f"{self.types}: not proven"
        if not self.occurs:
            return f"{self.types}: empty"
        numbers = ((self.points, "points"), (self.components, "components"))
        sizes = [f"{k} {word}" for k, word in numbers if k is not None]
        dimension = "dimension not proven" if self.dimension is None else f"dimension {self.dimension}"
        return f"{self.types}: occurs, {', '.join((dimension, *sizes))}"


def proven_row(types: str, findings: Iterable[Finding]) -> Row:
    """The row that all leaves of a certificate prove together."""
    own = [f for f in findings if types in f.types and f.high >= 0]
    if not own:
        return Row(types, False, -1, 0, 0)
    sure = [f for f in own if f.low >= 0 and len(f.types) == 1]
    if not sure:
        return Row(types, None)
    low, high = max(f.low for f in sure), max(f.high for f in own)
    numbers = [f.points for f in own]
    points = None if None in numbers else sum(k for k in numbers if k is not None)
    # points that lie on a curve of the row are no components of their own
    apart = [f for f in own if f.points is None or not any(c.holds(f) for c in own)]
    if points is None and any(f.points is not None for f in apart):
        return Row(types, True, low if low == high else None)
    parts = [f.closed_components for f in apart]
    components = None if None in parts else sum(k for k in parts if k is not None)
    return Row(types, True, low if low == high else None, points, components)


def claimed_rows(data: Any) -> tuple[Row, ...]:
    """The rows that a certificate says it proves; raises `Rejected`."""
    if not isinstance(data, list) or not data:
        raise Rejected("claims: expected a list of rows")
    return tuple(_claimed(entry) for entry in data)


def _claimed(entry: Any) -> Row:
    if not isinstance(entry, Mapping) or not isinstance(entry.get("types"), str):
        raise Rejected(f"claims: expected rows with types, got {str(entry)[:80]}")
    occurs = entry.get("occurs")
    numbers = [entry.get(key) for key in ("dimension", "points", "components")]
    if occurs not in (True, False, None) or not all(k is None or type(k) is int for k in numbers):
        raise Rejected(f"claims: expected true or false, and numbers, got {str(entry)[:80]}")
    return Row(entry["types"], occurs, *numbers)


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
