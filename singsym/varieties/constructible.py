"""Constructible sets: finite unions of cells, their algebra, and answers that say how they are known.

Source: Chevalley's theorem and the algorithms of Cox, Little, O'Shea, "Ideals, Varieties, and Algorithms",
3.2 (extension theorem), 4.4 and 4.7.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.verdict import Known, Premises, Verdict, weakest
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Rational, Ring
from singsym.varieties.cells import Cell, Field
from singsym.varieties.decomposition import Component, prune

if TYPE_CHECKING:
    from singsym.varieties.projection import Projection
    from singsym.varieties.real.points.certified_point import Witness


@dataclass(frozen=True)
class ConstructibleSet:
    """A finite union of cells in the affine space of a ring.

    `==` compares how sets are written; `equals` compares sets.  There is no truth value and no length: ask
    `is_empty`.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> cross, axis = ConstructibleSet.zeros(R, x * y), ConstructibleSet.zeros(R, y)
    >>> (cross - axis).is_subset(ConstructibleSet.zeros(R, x)).answer
    <Answer.YES: 'yes'>
    >>> (cross - axis).closure().value
    {x = 0}
    """

    ring: Ring
    cells: tuple[Cell, ...] = ()

    def __post_init__(self) -> None:
        for cell in self.cells:
            if cell.ring != self.ring:
                raise ValueError(
                    f"a cell of {cell.ring!r} in a set of {self.ring!r}: convert it to that ring"
                )

    # -- making ----------------------------------------------------------------------------------

    @classmethod
    def zeros(cls, ring: Ring, *polynomials: Polynomial) -> ConstructibleSet:
        """The common zeros of polynomials; the whole space without any."""
        return cls(ring, (Cell(Ideal(ring, polynomials)),))

    @classmethod
    def nonzeros(cls, ring: Ring, polynomial: Polynomial) -> ConstructibleSet:
        """Where a polynomial is not zero."""
        return cls(ring, (Cell(Ideal(ring), ((polynomial,),)),))

    @classmethod
    def where(
        cls, ring: Ring, positive: Sequence[Polynomial] = (), nonnegative: Sequence[Polynomial] = ()
    ) -> ConstructibleSet:
        """The real points with all of `positive` > 0 and all of `nonnegative` >= 0."""
        return cls(ring, (Cell(Ideal(ring), (), tuple(positive), tuple(nonnegative)),))

    @classmethod
    def from_components(cls, ring: Ring, components: Iterable[Component]) -> ConstructibleSet:
        """The union of the zero sets of components."""
        return cls(ring, tuple(Cell(c.ideal) for c in components))

    # -- algebra ---------------------------------------------------------------------------------

    def __or__(self, other: ConstructibleSet) -> ConstructibleSet:
        self._same_ring(other)
        return ConstructibleSet(self.ring, tuple(dict.fromkeys(self.cells + other.cells)))

    def __and__(self, other: ConstructibleSet) -> ConstructibleSet:
        self._same_ring(other)
        cells = dict.fromkeys(a & b for a in self.cells for b in other.cells)
        return ConstructibleSet(self.ring, tuple(cells))

    def __sub__(self, other: ConstructibleSet) -> ConstructibleSet:
        self._same_ring(other)
        cells = self.cells
        for b in other.cells:
            cells = tuple(c for a in cells for c in a.minus(b))
        return ConstructibleSet(self.ring, cells)

    def union(self, other: ConstructibleSet) -> ConstructibleSet:
        """The points of either set; the same as `|`."""
        return self | other

    def intersection(self, other: ConstructibleSet) -> ConstructibleSet:
        """The points of both sets; the same as `&`."""
        return self & other

    def difference(self, other: ConstructibleSet) -> ConstructibleSet:
        """The points of this set outside the other; the same as `-`."""
        return self - other

    def __bool__(self) -> bool:
        raise TypeError("a ConstructibleSet has no truth value: ask .is_empty()")

    def _same_ring(self, other: ConstructibleSet) -> None:
        if other.ring != self.ring:
            raise ValueError(
                f"sets of different rings, {self.ring!r} and {other.ring!r}: build both in one ring"
            )

    # -- questions -------------------------------------------------------------------------------

    def contains(self, point: Mapping[str, Rational]) -> bool:
        """Whether a rational point, a value for each of the ring's names, is in the set (exact)."""
        return any(cell.contains(point) for cell in self.cells)

    def is_empty(self, field: Field = "complex", budget: Budget | None = None) -> Verdict:
        """Whether there is no complex (real) point; the witness of "no" comes from the first cell found.

        >>> R = Ring(("x",))
        >>> x, = R.gens
        >>> imaginary = ConstructibleSet.zeros(R, x**2 + 1)
        >>> imaginary.is_empty().answer, imaginary.is_empty("real").answer
        (<Answer.NO: 'no'>, <Answer.YES: 'yes'>)
        """
        with current(budget).part():
            verdicts = []
            for cell in self.cells:
                verdicts.append(cell.is_empty(field))
                if verdicts[-1].is_no:
                    return verdicts[-1]
        reasons = [v.reason for v in verdicts if v.is_undecided]
        if reasons:
            return Verdict.undecided("; ".join(dict.fromkeys(reasons)))
        certainty = weakest(*(v.certainty for v in verdicts))
        return Verdict.yes(certainty, reason="every cell is empty")

    def is_subset(
        self, other: ConstructibleSet, field: Field = "complex", budget: Budget | None = None
    ) -> Verdict:
        """Whether every point of this set is in the other; the witness of "no" is of a point outside."""
        self._same_ring(other)
        with current(budget).part():
            return self._outside(other, field).is_empty(field)

    def _outside(self, other: ConstructibleSet, field: Field) -> ConstructibleSet:
        """The difference, without the cells proven empty on the way."""
        rest = ConstructibleSet(self.ring, self.cells)
        for b in other.cells:
            rest = (rest - ConstructibleSet(self.ring, (b,))).tidy()
        return rest

    def equals(
        self, other: ConstructibleSet, field: Field = "complex", budget: Budget | None = None
    ) -> Verdict:
        """Whether the two sets have the same points.

        >>> R = Ring(("x",))
        >>> x, = R.gens
        >>> ConstructibleSet.zeros(R, x**2).equals(ConstructibleSet.zeros(R, x)).answer
        <Answer.YES: 'yes'>
        """
        with current(budget).part():
            there = self.is_subset(other, field)
            return there if there.is_no else _both(there, other.is_subset(self, field))

    def tidy(self, budget: Budget | None = None) -> ConstructibleSet:
        """Without the cells proven empty over the complex numbers; the undecided ones stay, marked."""
        kept = []
        with current(budget).part():
            for cell in dict.fromkeys(self.cells):
                verdict = cell.is_empty()
                if verdict.is_no or (cell.is_real and verdict.is_undecided):
                    kept.append(cell)
                elif verdict.certainty != "proven":
                    reason = verdict.reason if verdict.is_undecided else "it is empty modulo random primes"
                    kept.append(replace(cell, undecided=reason))
        return ConstructibleSet(self.ring, tuple(kept))

    # -- geometry --------------------------------------------------------------------------------

    def components(self, budget: Budget | None = None) -> Known[tuple[Component, ...]]:
        """The components of the Zariski closure over Q, inequalities left out; raises `Undecided`."""
        with current(budget).part():
            premises = Premises()
            pieces = [piece for cell in self.cells for piece in premises.take(_closed_pieces(cell))]
            return premises.pass_on(prune(pieces))

    @property
    def dimension(self) -> Known[int]:
        """The dimension of the complex points, inequalities left out; -1 for none; raises `Undecided`."""
        return self.components().map(lambda found: max((c.dimension for c in found), default=-1))

    def closure(self, budget: Budget | None = None) -> Known[ConstructibleSet]:
        """The Zariski closure over Q of the complex points, inequalities left out; raises `Undecided`."""
        return self.components(budget).map(partial(ConstructibleSet.from_components, self.ring))

    def sample(self, n: int = 1, *, seed: int = 0, budget: Budget | None = None) -> tuple[Witness, ...]:
        """Up to n certified real points, found by numerical search; none found proves nothing.

        >>> R = Ring(("x", "y"))
        >>> x, y = R.gens
        >>> point, = ConstructibleSet.zeros(R, x**2 + y**2 - 1).sample()
        """
        from singsym.varieties.real.points.certified_point import find_witness

        found: list[Witness] = []
        with current(budget).part():
            for turn in range(n):
                for cell in self.cells if len(found) < n else ():
                    try:
                        witness = find_witness(cell.system, seed=seed + turn)
                    except Undecided:
                        continue
                    if witness is not None and witness not in found:
                        found.append(witness)
        return tuple(found[:n])

    def project(self, names: Iterable[str], budget: Budget | None = None) -> Projection:
        """The image in the space of the variables `names`, with whether it is exact (see `projection`)."""
        from singsym.varieties.projection import project

        with current(budget).part():
            return project(self, tuple(names))

    # -- display ---------------------------------------------------------------------------------

    def __repr__(self) -> str:
        shown = " | ".join(map(repr, self.cells[:4])) or "{}"
        return shown + (f" | ... {len(self.cells) - 4} more cells" if len(self.cells) > 4 else "")

    def _repr_latex_(self) -> str:
        union = r" \cup ".join(cell.latex() for cell in self.cells)
        return f"${union or chr(92) + 'emptyset'}$"


def _closed_pieces(cell: Cell) -> Known[tuple[Component, ...]]:
    """The pieces of a cell's Zariski closure: those not proven prime are saturated by the exclusions."""
    premises, found = Premises(), list[Component]()
    for piece in premises.take(cell.pieces()):
        if piece.prime or not cell.exclusions:
            found.append(piece)
            continue
        ideal = piece.ideal
        for group in cell.exclusions:
            ideal = premises.take(ideal.saturate(Ideal(cell.ring, group)))
        found.append(Component(ideal, False, premises.take(ideal.dimension)))
    return premises.conclude(tuple(found))


def _both(first: Verdict, second: Verdict) -> Verdict:
    """The conjunction of two verdicts."""
    if first.is_yes and second.is_yes:
        return first if first.certainty != "proven" else second
    return second if first.is_yes or second.is_no else first
