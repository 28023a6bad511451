"""Ranges of an angle as polynomial conditions on its cosine and sine.

Source: singsym's own: a chord cuts the unit circle in two arcs; rational points of the circle by the tangent
of half the angle.
"""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction

import sympy
from flint import arb, fmpq

from singsym.mechanism.model import Limit
from singsym.polynomials.unit_circles import half_angle_point

OUTWARDS = Fraction(1, 10**6)
"""Ends given as decimals move outwards by at most so many radians, to rational points of the circle."""

_DIGITS = {1: 2, 2: 2, 3: 3, 4: 3, 6: 3}
"""By denominator, how many decimal places a decimal needs to mean that multiple of pi."""

Point = tuple[sympy.Expr, sympy.Expr]


def exact_arc(column: str, low: sympy.Expr, high: sympy.Expr) -> Limit:
    """low <= angle <= high for rational multiples of pi, less than a full turn apart.

    Either by the chord between its ends or by the cosine from its middle, whose numbers are simpler.

    >>> exact_arc("A", -sympy.pi / 3, sympy.pi / 3)
    Limit(expression=cos(A), low=1/2, high=None)
    >>> exact_arc("A", sympy.Integer(0), sympy.pi / 2)
    Limit(expression=cos(A) + sin(A), low=1, high=None)
    """
    middle, half = (low + high) / 2, (high - low) / 2
    if low != high and _order(low, high) < _order(middle, half):
        return chord(column, exact_point(low), exact_point(high))
    cosine, sine = sympy.Symbol(f"cos({column})"), sympy.Symbol(f"sin({column})")
    return Limit(sympy.cos(middle) * cosine + sympy.sin(middle) * sine, low=sympy.cos(half))


def decimal_arc(column: str, low: float, high: float) -> tuple[Limit | None, str]:
    """low <= angle <= high for decimals in radians, low < high, with what was done to them in words.

    Multiples of pi to the digits given are exact, other ends are moved outwards by at most `OUTWARDS`. No
    limit where the angle may take a full turn.

    >>> decimal_arc("A", 0, 1.5708)
    (Limit(expression=cos(A) + sin(A), low=1, high=None), '1.5708 is pi/2')
    """
    ends = [multiple_of_pi(low), multiple_of_pi(high)]
    if ends[0] is not None and ends[0] == ends[1]:
        ends = [None, None]
    first, last = (float(given if end is None else end) for given, end in zip((low, high), ends, strict=True))
    if last - first > 2 * math.pi - 3 * OUTWARDS:
        return None, "a full turn or more"
    said = [
        f"{given} is rounded outwards by at most 1e-6" if end is None else f"{given} is {end}"
        for given, end in zip((low, high), ends, strict=True)
        if end != 0
    ]
    if ends[0] is not None and ends[1] is not None:
        return exact_arc(column, *ends), ", ".join(said)
    points = [
        exact_point(end) if end is not None else rational_point(Fraction(repr(given)), up)
        for given, end, up in ((low, ends[0], False), (high, ends[1], True))
    ]
    return chord(column, *points), ", ".join(said)


def chord(column: str, first: Point, last: Point) -> Limit:
    """The limit that an angle's point on the unit circle is on the arc from `first` to `last`, both included.

    first, last: two points (cosine, sine) of the circle; the arc is the one that angles grow along.

    >>> half = sympy.Rational(3, 5), sympy.Rational(4, 5)
    >>> chord("A", (sympy.Integer(1), sympy.Integer(0)), half)
    Limit(expression=2*cos(A) + sin(A), low=2, high=None)
    """
    across = [sympy.expand(last[1] - first[1]), sympy.expand(first[0] - last[0])]
    across.append(sympy.expand(across[0] * first[0] + across[1] * first[1]))
    if all(number.is_Rational for number in across):
        content = sympy.gcd_list(across[:2])
        across = [number / content for number in across]
    cosine, sine = sympy.Symbol(f"cos({column})"), sympy.Symbol(f"sin({column})")
    return Limit(across[0] * cosine + across[1] * sine, low=across[2])


def multiple_of_pi(number: float) -> sympy.Expr | None:
    """The multiple of pi that a decimal spells, rounded or cut to its digits; None where there is none.

    Multiples of pi/2 are known from two decimal places on, those of pi/3, pi/4 and pi/6 from three on.

    >>> multiple_of_pi(1.5708), multiple_of_pi(-3.14), multiple_of_pi(0.785), multiple_of_pi(2.5)
    (pi/2, -pi, pi/4, None)
    """
    if number == 0:
        return sympy.Integer(0)
    places = -int(Decimal(repr(number)).as_tuple().exponent)
    twelfths = round(number * 12 / math.pi)
    ratio = Fraction(twelfths, 12)
    if not twelfths or places < _DIGITS.get(ratio.denominator, places + 1):
        return None
    beyond = (twelfths * math.pi / 12 - number) * math.copysign(1, number)
    noise = 2 * math.ulp(number)
    unit = 10.0**-places
    near = -unit / 2 - noise <= beyond < max(unit, 2 * noise)
    return sympy.Rational(ratio.numerator, ratio.denominator) * sympy.pi if near else None


def exact_point(angle: sympy.Expr) -> Point:
    """The cosine and sine of a rational multiple of pi."""
    return sympy.cos(angle), sympy.sin(angle)


def rational_point(angle: Fraction, up: bool) -> Point:
    """A rational point of the unit circle at an angle in radians or beyond it by at most `OUTWARDS`.

    up: beyond it means at a larger angle, else at a smaller one.

    >>> rational_point(Fraction("0.643501"), up=True)  # the angle of 3, 4, 5 is 0.6435011...
    (4/5, 3/5)
    """
    quarters = round(2 * angle / Fraction(math.pi))
    rest = arb(fmpq(angle.numerator, angle.denominator)) - quarters * arb.pi() / 2
    tangent = (rest / 2).tan()
    # The angle grows by at most twice as much as the tangent of its half.
    spare = OUTWARDS / 2
    if up:
        edge = _fraction(tangent.upper())
        t = simplest(edge, edge + spare)
    else:
        edge = _fraction(tangent.lower())
        t = simplest(edge - spare, edge)
    cosine, sine = half_angle_point(t)
    for _ in range(quarters % 4):
        cosine, sine = -sine, cosine
    return tuple(sympy.Rational(x.numerator, x.denominator) for x in (cosine, sine))


def simplest(low: Fraction, high: Fraction) -> Fraction:
    """The fraction of least denominator from `low` to `high`, by continued fractions.

    >>> simplest(Fraction("3.14"), Fraction("3.15"))
    Fraction(22, 7)
    """
    if low <= 0 <= high:
        return Fraction(0)
    if high < 0:
        return -simplest(-high, -low)
    whole = math.ceil(low)
    if whole <= high:
        return Fraction(whole)
    below = whole - 1
    return below + 1 / simplest(1 / (high - below), 1 / (low - below))


def _fraction(value: arb) -> Fraction:
    """An exact ball's number."""
    mantissa, exponent = value.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def _order(*angles: sympy.Expr) -> int:
    """The order of the turn of which all these angles are multiples, by which their cosines' field grows."""
    return math.lcm(*(int((angle / (2 * sympy.pi)).q) for angle in angles))
