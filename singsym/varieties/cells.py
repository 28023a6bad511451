"""Cells: the zeros of an ideal outside finitely many closed sets, under inequalities.

Source: constructible and semi-algebraic sets as in D. Cox, J. Little, D. O'Shea, "Ideals, Varieties, and
Algorithms", 4.7, and Bochnak, Coste, Roy, "Real Algebraic Geometry", ch. 2.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import sympy

from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.verdict import Known, Premises, Verdict
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Rational, Ring, as_fmpq
from singsym.varieties.decomposition import Component, decompose

if TYPE_CHECKING:
    from singsym.varieties.real.system import RealSystem

Field = Literal["complex", "real"]


@dataclass(frozen=True)
class Cell:
    """V(ideal) minus the union of the V(exclusions[k]), where all of `positive` > 0 and `nonnegative` >= 0.

    undecided: why it is not known whether the cell is empty, or "".  The relations of the ring's constants
    hold without being among the generators.

    >>> x, y = Ring(("x", "y")).gens
    >>> Cell(Ideal(x.ring, (x * y,)), ((x,),))
    {x*y = 0} \\ {x = 0}
    """

    ideal: Ideal
    exclusions: tuple[tuple[Polynomial, ...], ...] = ()
    positive: tuple[Polynomial, ...] = ()
    nonnegative: tuple[Polynomial, ...] = ()
    undecided: str = field(default="", compare=False)

    @property
    def ring(self) -> Ring:
        """The ring of the ideal."""
        return self.ideal.ring

    @property
    def is_real(self) -> bool:
        """Whether the cell has inequalities, so that only its real points count."""
        return bool(self.positive or self.nonnegative)

    def __repr__(self) -> str:
        text = _shown(self.ideal.generators, " = 0")
        conditions = [f"{p} > 0" for p in self.positive] + [f"{p} >= 0" for p in self.nonnegative]
        if conditions:
            text = f"{text[:-1]}, {', '.join(conditions)}}}"
        text += "".join(f" \\ {_shown(group, ' = 0')}" for group in self.exclusions[:3])
        if len(self.exclusions) > 3:
            text += f" \\ ... {len(self.exclusions) - 3} more"
        return f"{text} (undecided)" if self.undecided else text

    def latex(self) -> str:
        """The cell as LaTeX, without dollars."""

        def zeros(group: tuple[Polynomial, ...]) -> str:
            inside = ", ".join(sympy.latex(p.to_sympy()) for p in group) or "0"
            return rf"V\left({inside}\right)"

        text = zeros(self.ideal.generators)
        if self.exclusions:
            text += r" \setminus " + r" \setminus ".join(map(zeros, self.exclusions))
        conditions = [sympy.latex(p.to_sympy()) + " > 0" for p in self.positive]
        conditions += [sympy.latex(p.to_sympy()) + r" \ge 0" for p in self.nonnegative]
        if conditions:
            text += r" \cap \left\{" + ", ".join(conditions) + r"\right\}"
        return text

    # -- algebra ---------------------------------------------------------------------------------

    def __and__(self, other: Cell) -> Cell:
        return Cell(
            Ideal(self.ring, dict.fromkeys((*self.ideal.generators, *other.ideal.generators))),
            tuple(dict.fromkeys(self.exclusions + other.exclusions)),
            tuple(dict.fromkeys(self.positive + other.positive)),
            tuple(dict.fromkeys(self.nonnegative + other.nonnegative)),
        )

    def minus(self, other: Cell) -> Iterator[Cell]:
        """Disjoint cells whose union is the difference: each fails one condition of `other`, the first."""
        if any(other.ideal.generators):
            yield replace(
                self, exclusions=_with(self.exclusions, tuple(filter(None, other.ideal.generators)))
            )
        met = replace(self, ideal=self.ideal + other.ideal)
        for group in other.exclusions:
            yield replace(met, ideal=met.ideal + Ideal(self.ring, group))
            met = replace(met, exclusions=_with(met.exclusions, group))
        for p in other.positive:
            yield replace(met, nonnegative=_with(met.nonnegative, -p))
            met = replace(met, positive=_with(met.positive, p))
        for p in other.nonnegative:
            yield replace(met, positive=_with(met.positive, -p))
            met = replace(met, nonnegative=_with(met.nonnegative, p))

    # -- questions -------------------------------------------------------------------------------

    def contains(self, point: Mapping[str, Rational]) -> bool:
        """Whether a rational point, a value for each of the ring's names, is in the cell."""
        values = [as_fmpq(point[name]) for name in self.ring.names]

        def at(p: Polynomial) -> Rational:
            return as_fmpq(p.evaluate(values))

        return (
            not any(at(p) for p in (*self.ideal.generators, *self.ring.relations))
            and all(any(at(p) for p in group) for group in self.exclusions)
            and all(at(p) > 0 for p in self.positive)
            and all(at(p) >= 0 for p in self.nonnegative)
        )

    def pieces(self, budget: Budget | None = None) -> Known[tuple[Component, ...]]:
        """The components of the Zariski closure of the complex points, inequalities left out.

        A component that is not proven prime may be larger than the closure.  Raises `Undecided`.
        """
        single = [group[0] for group in self.exclusions if len(group) == 1]
        if any(not any(group) for group in self.exclusions):
            return Known(())
        premises = Premises()
        found = premises.take(decompose(self.ideal.generators, single, ring=self.ring, budget=budget))

        def is_in(piece: Component, group: tuple[Polynomial, ...]) -> bool:
            return all(premises.take(piece.vanishes(p)) for p in group)

        return premises.conclude(tuple(c for c in found if not any(is_in(c, g) for g in self.exclusions)))

    def is_empty(self, field: Field = "complex", budget: Budget | None = None) -> Verdict:
        """Whether the cell has no complex (real) point; "no" over the complex numbers names a component.

        With inequalities the cell is a real set, and `field="complex"` can only prove it empty.
        """
        with current(budget).part():
            try:
                verdict = self._is_empty()
                if verdict.is_yes or (field == "complex" and not self.is_real):
                    return verdict
                if field == "complex":
                    return Verdict.undecided("the cell has inequalities: ask with field='real'")
                from singsym.varieties.real.proofs.emptiness import is_empty_over_reals

                return is_empty_over_reals(self.system)
            except Undecided as reason:
                return Verdict.undecided(str(reason))

    def _is_empty(self) -> Verdict:
        pieces = self.pieces()
        whole, doubtful = Premises(pieces.certainty), False
        for piece in pieces.value:
            if piece.prime:
                # V(P) irreducible is not the union of smaller closed sets.
                reason = "a component lies in no exclusion"
                return Verdict.no(whole.certainty, witness=piece, reason=reason)
            own, rest = Premises(pieces.certainty), piece.ideal
            for group in self.exclusions:
                rest = own.take(rest.saturate(Ideal(self.ring, group)))
            is_unit = own.take(rest.is_unit())
            if own.certainty != "proven":
                doubtful = True
            elif not is_unit:
                return Verdict.no(witness=piece, reason="the saturated ideal is not 1")
            whole.rest_on(own.certainty)
        if doubtful:
            return Verdict.undecided("a Groebner basis rests on random primes")
        return Verdict.yes(whole.certainty, reason="every component lies in an exclusion")

    @property
    def system(self) -> RealSystem:
        """The cell as a system for the solvers over the real numbers."""
        from singsym.varieties.real.system import RealSystem

        return RealSystem(self.ring, self.ideal.generators, self.exclusions, self.positive, self.nonnegative)


def _with(known: tuple, item: object) -> tuple:  # type: ignore[type-arg]
    return known if item in known else (*known, item)


def _shown(polynomials: tuple[Polynomial, ...], relation: str) -> str:
    if not polynomials:
        return "{everything}"
    shown = ", ".join(f"{p}{relation}" for p in polynomials[:3])
    return "{" + shown + (f", ... {len(polynomials) - 3} more" if len(polynomials) > 3 else "") + "}"
