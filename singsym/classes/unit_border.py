"""The border between a mechanism in a unit of length of its own, inside, and in the user's, outside.

Source: dimensional analysis: a mechanism times k has the same configurations, their lengths times k, and the
same ranks, so the same classes.  If u is the unit, x = u x' for the variables that are lengths, and zeros of
p'(x') are those of p(x) = p'(x/u).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, TypeVar

from flint import fmpq

from singsym.classes.conclusions import conditions_latex
from singsym.classes.result import (
    Classification,
    ClassResult,
    Configuration,
    Locus,
    Piece,
    SpacePiece,
)
from singsym.conditions.conditions import Conditions, conditions
from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism.model import Mechanism
from singsym.mechanism.units import own_unit, scaled
from singsym.polynomials import Equations, Polynomial

if TYPE_CHECKING:
    from singsym.classes.solve import SolutionPiece

    Part = TypeVar("Part", Piece, SolutionPiece)

DIGITS = 15
"""Of the numbers that are reported."""


@dataclass(frozen=True)
class Border:
    """A velocity equation in a unit of its own, `inside`, and the same in the user's, `outside`.

    unit: the former in the latter.
    """

    unit: Fraction
    inside: VelocityEquation
    outside: VelocityEquation

    @classmethod
    def of(cls, mechanism: Mechanism, formulation: str = "auto") -> Border:
        """That of a mechanism, which is taken as it is where its equations are not seen to be the same.

        Raises `MechanismError` for a mechanism that cannot be placed.

        >>> from singsym.mechanism import load
        >>> border = Border.of(load("3rrr"))
        >>> border.unit, border.inside.space.points["A2"], border.outside.space.points["A2"]
        (Fraction(2, 1), (3, 0), (6, 0))
        """
        outside = velocity_equation(mechanism, formulation)
        unit = own_unit(mechanism)
        if unit == 1:
            return cls.around(outside)
        found = cls(unit, velocity_equation(scaled(mechanism, 1 / unit), formulation), outside)
        return found if found.agrees else cls.around(outside)

    @classmethod
    def around(cls, equation: VelocityEquation) -> Border:
        """That of an equation in which nothing is known to be a length."""
        return cls(Fraction(1), equation, equation)

    @property
    def agrees(self) -> bool:
        """Whether both sides have the same configurations, conditions and named points, up to the unit."""
        inside, outside = self.inside.space, self.outside.space
        place = {name: [p * self.unit for p in xs] for name, xs in inside.points.items()}
        return (
            inside.ring == outside.ring
            and inside.lengths == outside.lengths
            and [self.equations(group) for group in _conditions(inside)]
            == [tuple(map(_coprime, group)) for group in _conditions(outside)]
            and all(
                [self._in_user_unit(p) for p in xs] == list(outside.points[name])
                for name, xs in place.items()
            )
        )

    # -- polynomials -----------------------------------------------------------------------------------

    def _in_user_unit(self, polynomial: Polynomial) -> Polynomial:
        """p'(x/u)."""
        places = [polynomial.ring.index(name) for name in self.inside.space.lengths]
        unit = fmpq(self.unit.numerator, self.unit.denominator)
        return polynomial.ring.from_dict(
            {m: c / unit ** int(sum(m[i] for i in places)) for m, c in polynomial.terms()}
        )

    def polynomial(self, polynomial: Polynomial) -> Polynomial:
        """A polynomial with the same zeros and signs, in the user's unit."""
        return polynomial if self.unit == 1 else _coprime(self._in_user_unit(polynomial))

    def equations(self, equations: Equations) -> Equations:
        """Several of them."""
        return tuple(map(self.polynomial, equations))

    # -- configurations --------------------------------------------------------------------------------

    def configuration(self, found: Configuration) -> Configuration:
        """A configuration in the user's unit, rounded to 15 digits, with a bound on all errors."""
        values = self.inside.values
        slides = {label for label, value in values.items() if value.cosine is None}
        lengths = (set(self.inside.space.lengths), set(found.points), slides)
        radius = Fraction(found.radius)
        tables, errors = [], [Fraction(0)]
        for table, own in zip((found.coordinates, found.points, found.joints), lengths, strict=True):
            rounded = {}
            for name, text in table.items():
                unit = self.unit if name in own else Fraction(1)
                exact = Fraction(text) * unit
                rounded[name] = f"{float(exact):.{DIGITS}g}"
                errors.append(radius * unit + abs(exact - Fraction(rounded[name])))
            tables.append(rounded)
        return Configuration(tables[0], tables[1], tables[2], f"{float(max(errors)) * 1.05:.1e}")

    # -- results ---------------------------------------------------------------------------------------

    def part(self, piece: Part) -> Part:
        """A piece of a class or of a solution set."""
        return replace(
            piece,
            path=self.equations(piece.path),
            basis=self.equations(piece.basis),
            exclusions=tuple(map(self.equations, piece.exclusions)),
            witnesses=tuple(map(self.configuration, piece.witnesses)),
        )

    def classification(self, found: Classification) -> Classification:
        """All that was found out about the mechanism inside, as the user sees it."""
        outside = conditions(self.outside, found.reduction if self.unit == 1 else None)
        return replace(
            found,
            equation=self.outside,
            reduction=outside.reduction,
            configuration_space=tuple(map(self._space_piece, found.configuration_space)),
            loci=tuple(self._locus(locus, outside) for locus in found.loci),
            classes=tuple(map(self._class, found.classes)),
        )

    def _space_piece(self, piece: SpacePiece) -> SpacePiece:
        return replace(piece, basis=self.equations(piece.basis))

    def _locus(self, locus: Locus, outside: Conditions) -> Locus:
        """The locus with its factor, and what that is called, in the user's unit."""
        if self.unit == 1:
            return locus
        polynomial = self.polynomial(locus.factor)
        factor = outside.factor(polynomial)
        words = factor.words or locus.words
        return replace(locus, factor=polynomial, words=words, latex=factor.latex())

    def _class(self, result: ClassResult) -> ClassResult:
        pieces = tuple(map(self.part, result.pieces))
        unsure = tuple(map(self.part, result.unsure))
        return replace(result, pieces=pieces, unsure=unsure, conditions=conditions_latex(pieces))


def _conditions(space: ConfigurationSpace) -> tuple[Equations, ...]:
    """What a configuration obeys."""
    return (space.equations, *space.exclusions, space.positive, space.nonnegative)


def _coprime(polynomial: Polynomial) -> Polynomial:
    """The positive multiple with coprime integer coefficients."""
    found = polynomial.primitive()
    return found if not polynomial or polynomial.leading_term[1] > 0 else -found
