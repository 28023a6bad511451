"""A mechanism in another unit of length, and a unit of its own.

Source: dimensional analysis (textbook); the choice of the unit is singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from math import gcd, lcm, prod
from statistics import median_low

import sympy

from singsym.mechanism.couplings import is_sliding, turning_terms
from singsym.mechanism.model import Coupling, Exclusion, Joint, Limit, Link, Mechanism, Vector

USUAL = 10
"""In its own unit half of a mechanism's lengths at least are below this."""
_MULTIPLES = (1, 2, 3, 4, 5, 6, 8, 9, 10, 12, 15, 16, 18, 20, 24, 25, 30, 36, 40, 45, 48, 50, 60)
"""Of the greatest common divisor of all lengths."""


def own_unit(mechanism: Mechanism) -> Fraction:
    """A length that grows with the mechanism, and in which its lengths are short numbers.

    It is the multiple of their greatest common divisor with the least product of all numerators and
    denominators, then times the least power of 10 for which half of the lengths are below `USUAL` units.
    Of a length such as 3*sqrt(2)/2 or 3*a/2 the rational coefficients count, 3/2: parameters without a value
    are numbers.  A mechanism without lengths has the unit 1.

    >>> from singsym.mechanism import load
    >>> own_unit(load("fourbar")), own_unit(scaled(load("fourbar"), Fraction(700, 3)))
    (Fraction(1, 1), Fraction(700, 3))
    >>> own_unit(load("spherical-fourbar"))
    Fraction(1, 1)
    """
    sizes = [abs(c) for length in _lengths(mechanism.resolved) for c in _coefficients(length)]
    if not sizes:
        return Fraction(1)
    divisor = Fraction(gcd(*(s.numerator for s in sizes)), lcm(*(s.denominator for s in sizes)))
    unit = min((divisor * k for k in _MULTIPLES), key=lambda unit: _height([s / unit for s in sizes]))
    while median_low(sizes) >= USUAL * unit:
        unit *= 10
    return unit


def _height(numbers: list[Fraction]) -> int:
    """The product of all numerators and denominators."""
    return prod(n.numerator * n.denominator for n in numbers)


def scaled(mechanism: Mechanism, factor: Fraction) -> Mechanism:
    """The mechanism with all its lengths times a positive factor, its parameters put in.

    Axes, angles and the ranges of parameters stay.

    >>> from singsym.mechanism import load
    >>> scaled(load("fourbar"), Fraction(1000)).link("AB").points["B"]
    (1000, 0)
    """
    factor = sympy.Rational(factor.numerator, factor.denominator)
    mechanism = mechanism.resolved
    return replace(
        mechanism,
        links=tuple(_scaled_link(link, factor) for link in mechanism.links),
        joints=tuple(_scaled_joint(joint, factor) for joint in mechanism.joints),
        limits=tuple(_scaled_limit(limit, factor) for limit in mechanism.limits),
        exclusions=tuple(_scaled_exclusion(exclusion, factor) for exclusion in mechanism.exclusions),
        couplings=tuple(_scaled_coupling(c, mechanism, factor) for c in mechanism.couplings),
    )


def _lengths(mechanism: Mechanism) -> Iterator[sympy.Expr]:
    """The lengths in a mechanism: coordinates of points, pitches, sums and bounds of lengths, radii."""
    for link in mechanism.links:
        for point in link.points.values():
            yield from point
    yield from (joint.pitch for joint in mechanism.joints if joint.pitch is not None)
    for coupling in mechanism.couplings:
        if coupling.lift is not None:
            yield coupling.lift.xreplace(dict.fromkeys(_length_symbols(coupling.lift), sympy.S.Zero))
        elif coupling.constant is None:
            turns = turning_terms(mechanism, coupling)
            yield from (number for column, number in coupling.terms if column in turns)
        elif is_sliding(mechanism, coupling):
            yield coupling.constant
    for limit in mechanism.limits:
        if _degree(limit.expression) == 1:
            yield from (bound for bound in (limit.low, limit.high) if bound is not None)


def _coefficients(length: sympy.Expr) -> Iterator[Fraction]:
    """The rational coefficients other than zero of a sum."""
    for term in sympy.Add.make_args(sympy.expand(length)):
        coefficient = term.as_coeff_Mul(rational=True)[0]
        if coefficient:
            yield Fraction(int(coefficient.p), int(coefficient.q))


def _scaled_link(link: Link, factor: sympy.Rational) -> Link:
    points: dict[str, Vector] = {name: tuple(factor * x for x in p) for name, p in link.points.items()}
    return replace(link, points=points)


def _scaled_joint(joint: Joint, factor: sympy.Rational) -> Joint:
    return joint if joint.pitch is None else replace(joint, pitch=factor * joint.pitch)


def _scaled_limit(limit: Limit, factor: sympy.Rational) -> Limit:
    power = factor ** _degree(limit.expression)
    low, high = (None if bound is None else bound * power for bound in (limit.low, limit.high))
    expression = _scaled_expression(limit.expression, factor)
    return replace(limit, expression=expression, low=low, high=high)


def _scaled_exclusion(exclusion: Exclusion, factor: sympy.Rational) -> Exclusion:
    if exclusion.expression is None:
        return exclusion
    return replace(exclusion, expression=_scaled_expression(exclusion.expression, factor))


def _scaled_coupling(coupling: Coupling, mechanism: Mechanism, factor: sympy.Rational) -> Coupling:
    if coupling.lift is not None:
        (follower, _), (driver, _) = coupling.terms
        old = coupling.lift.xreplace({s: s / factor for s in _length_symbols(coupling.lift)})
        return Coupling.cam(coupling.name, follower, driver, sympy.expand(factor * old))
    if coupling.constant is None:
        turns = turning_terms(mechanism, coupling)
        return replace(coupling, terms=tuple((c, factor * x if c in turns else x) for c, x in coupling.terms))
    return (
        replace(coupling, constant=factor * coupling.constant)
        if is_sliding(mechanism, coupling)
        else coupling
    )


def _scaled_expression(expression: sympy.Expr, factor: sympy.Rational) -> sympy.Expr:
    """f^d E(x/f) for the lengths x in an expression of degree d in them: E itself where it is homogeneous."""
    old = expression.xreplace({s: s / factor for s in _length_symbols(expression)})
    return factor ** _degree(expression) * old


def _length_symbols(expression: sympy.Expr) -> list[sympy.Symbol]:
    """The symbols of a limit that are lengths: `A.x` of a point, `length(P)` of a slide."""
    symbols = sorted(expression.free_symbols, key=str)
    return [s for s in symbols if s.name.startswith("length(") or ("." in s.name and "(" not in s.name)]


def _degree(expression: sympy.Expr) -> int:
    """The degree of an expression in lengths."""
    symbols = _length_symbols(expression)
    return int(sympy.Poly(expression, *symbols).total_degree()) if symbols else 0
