"""Conditions in the names of a mechanism's lengths, also where these have values.

Source: singsym's own.  The conditions are worked out once more with the lengths as variables.  A factor is
written in names where a factor of these becomes it, up to a number, when the values are put in; so what is
printed is the same polynomial.  Where none does, as it factors further for these values, its numbers stay.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction

import sympy

from singsym.conditions.conditions import conditions
from singsym.conditions.factor import Factor
from singsym.conditions.named_quantities import GeometricName, PointNames
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import Mechanism, MechanismError
from singsym.polynomials import Polynomial, Ring

FEW_TERMS = 5000
"""Determinants in names are given up where they have more terms on the way: they only say the same."""

_WRITTEN_OUT = ("4", "5", "iii", "vi")


@dataclass(frozen=True)
class NamedLengths:
    """values: of the lengths that have names; written: primitive polynomials with what they are in names.

    names: of quantities in names of lengths.
    """

    values: Mapping[str, Fraction] = field(default_factory=dict)
    written: Mapping[Polynomial, Polynomial] = field(default_factory=dict)
    names: PointNames | None = field(default=None, repr=False, compare=False)

    def of(self, polynomial: Polynomial) -> Polynomial | None:
        """A multiple of the polynomial in names, by a number; None where it has no such form."""
        return self.written.get(polynomial.primitive())

    def shown(self, polynomial: Polynomial) -> Polynomial:
        """The polynomial in names where a length is in it, else as it is."""
        named = self.of(polynomial)
        return polynomial if named is None or self.values.keys().isdisjoint(named.variables) else named

    def factor(self, factor: Factor) -> Factor:
        """The factor in names, and what it is called in these."""
        named = self.of(factor.polynomial)
        if named is None or (factor.is_plain and self.values.keys().isdisjoint(named.variables)):
            return factor
        return factor.written_as(named, self._called(factor, named))

    def _called(self, factor: Factor, named: Polynomial) -> GeometricName | None:
        """The quantity that a factor is called by, as a multiple of what the factor is in names."""
        if factor.name is None or self.names is None:
            return None
        ring = self.names.certifier.space.ring
        found = self.names.called(ring.convert(named), factor.name.quantity)
        return None if found is None else replace(found, scale=named.ring.convert(found.scale))

    def occurring_in(self, some: Iterable[Polynomial]) -> dict[str, Fraction]:
        """The values of those lengths whose names are in some polynomials, as they are shown."""
        return self._among(map(self.shown, some))

    def occurring_in_factors(self, some: Iterable[Factor]) -> dict[str, Fraction]:
        """The same for factors, with what they are called."""
        shown = [self.factor(factor) for factor in some]
        return self._among(p for f in shown for p in (f.polynomial, *([f.name.scale] if f.name else [])))

    def _among(self, shown: Iterable[Polynomial]) -> dict[str, Fraction]:
        names = {name for polynomial in shown for name in polynomial.variables}
        return {name: value for name, value in self.values.items() if name in names}


def named_lengths(
    mechanism: Mechanism, equation: VelocityEquation, labels: Iterable[str] = _WRITTEN_OUT
) -> NamedLengths:
    """The factors of a mechanism's conditions in the names of its lengths that are rational.

    equation: the mechanism's, with the values; labels: of the conditions whose factors are looked at.

    >>> from singsym.mechanism import load
    >>> puma = load("puma560")
    >>> equation = velocity_equation(puma)
    >>> named_lengths(puma, equation).of(conditions(equation)["5"].factors[1].polynomial)
    a3*s3 + d4*c3
    """
    space = equation.space
    values = {
        str(name): Fraction(int(value.p), int(value.q))
        for name, value in mechanism.values.items()
        if isinstance(value, sympy.Rational) and str(name) not in space.ring.names
    }
    if not values:
        return NamedLengths()
    try:
        symbolic = velocity_equation(mechanism.with_parameters(**dict.fromkeys(values)), space.formulation)
    except (MechanismError, sympy.PolynomialError, ValueError):
        # a length that decides what the mechanism is, or that is in more than polynomials
        return NamedLengths()
    own = symbolic.space.ring
    ring = own.with_names([*values, *(name for name in own.names if name not in values)], "lex")
    in_names = conditions(symbolic, most_terms=FEW_TERMS, naming=False)
    written: dict[Polynomial, Polynomial] = {}
    for label in labels:
        for factor in in_names[label].all_factors:
            try:
                image = _put_in(factor.polynomial, values, space.ring)
            except KeyError:
                # other variables are chosen where lengths have no values
                return NamedLengths()
            if not image.is_constant:
                written.setdefault(image.primitive(), ring.convert(factor.polynomial).primitive())
    return NamedLengths(values, written, in_names.names)


def _put_in(named: Polynomial, values: Mapping[str, Fraction], ring: Ring) -> Polynomial:
    """A polynomial with the values of lengths, in a ring that has all other variables and constants.

    Raises `KeyError` where the ring has not.
    """
    if missing := set(named.ring.constants).difference(ring.constants):
        raise KeyError(f"constants {missing} not in {ring!r}")
    return ring.convert(named.substitute({n: v for n, v in values.items() if named.degree(n) > 0}))


def values_text(values: Mapping[str, Fraction]) -> str:
    """Lengths by name, each with its value.

    >>> values_text({"a3": Fraction(203, 10000), "l": Fraction(1, 3)})
    'a3 = 0.0203, l = 1/3'
    """
    return ", ".join(f"{name} = {in_decimals(value)}" for name, value in values.items())


def in_decimals(value: Fraction) -> str:
    """A length: in decimals where these end, else as a fraction.

    >>> [in_decimals(Fraction(text)) for text in ("0.0203", "1/3", "4")]
    ['0.0203', '1/3', '4']
    """
    places = next((k for k in range(10) if (value * 10**k).denominator == 1), 0)
    return f"{float(value):.{places}f}" if places else str(value)
