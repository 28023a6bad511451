"""Unit vectors among the variables of a system: pairs whose squares have the sum 1.

Source: the formulation by cosine and sine, see `kinematics.placement`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

from singsym.polynomials.polynomial import Polynomial

Pair = tuple[str, str]


def circle(cosine: Polynomial, sine: Polynomial) -> Polynomial:
    """c^2 + s^2 - 1."""
    return cosine * cosine + sine * sine - 1


def unit_circles(equations: Iterable[Polynomial]) -> Iterator[Pair]:
    """The pairs that some equation makes a unit vector, in the order of the equations.

    >>> from singsym.polynomials import Ring
    >>> c, s, x = Ring(("c", "s", "x")).gens
    >>> list(unit_circles([2 * c**2 + 2 * s**2 - 2, x**2 - 1]))
    [('c', 's')]
    """
    for p in equations:
        if len(p) == 3 and p.total_degree == 2 and len(p.variables) == 2:
            pair = (p.variables[0], p.variables[1])
            if p.primitive() == circle(*map(p.ring.gen, pair)):
                yield pair


def separate_circles(equations: Iterable[Polynomial]) -> tuple[Pair, ...]:
    """Those of them that share no variable with one before.

    >>> from singsym.polynomials import Ring
    >>> c, s, t = Ring(("c", "s", "t")).gens
    >>> separate_circles([c**2 + s**2 - 1, s**2 + t**2 - 1])
    (('c', 's'),)
    """
    found: list[Pair] = []
    for pair in unit_circles(equations):
        if not any({*pair} & {*other} for other in found):
            found.append(pair)
    return tuple(found)


def half_angle_point(tangent: Fraction) -> tuple[Fraction, Fraction]:
    """Cosine and sine of the angle whose half has this tangent: all rational points but (-1, 0).

    >>> half_angle_point(Fraction(1, 2))
    (Fraction(3, 5), Fraction(4, 5))
    """
    square = tangent * tangent
    return (1 - square) / (1 + square), 2 * tangent / (1 + square)
