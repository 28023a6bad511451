"""Exact numbers for the floats of a URDF file: lengths without noise, angles, axes.

Source: singsym's own; rational points of the sphere by stereographic projection, of the circle by the tangent
of half the angle.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from fractions import Fraction

import sympy

from singsym.mechanism.arcs import decimal_arc, multiple_of_pi, rational_point, simplest
from singsym.mechanism.expressions import RESERVED, expression
from singsym.mechanism.model import Limit
from singsym.mechanism.reader import LONGEST_NAME
from singsym.mechanism.serial import rotation

NOISE = 1e-9
"""Metres; lengths this near to a decimal of `PLACES` places are that decimal."""
PLACES = 7
QUARTER = 1e-4
"""Radians; angles this near to a multiple of pi/2, and axes this near to a coordinate axis, are that."""
TWELFTH = 1e-6
"""Radians; angles this near to another multiple of pi/4 or pi/6 are that, if they have as many places."""
NEAR = 1e-6
"""Radians; other angles and axes are rational points of the circle and the sphere within this."""

_SHOWN = 4


class Names:
    """Turns names of other formats into the file format's alphabet, each once.

    >>> name = Names()
    >>> name("left arm"), name("left/arm"), name("1st")
    ('left_arm', 'left_arm_', '_1st')
    """

    def __init__(self) -> None:
        self._used: set[str] = set()

    def __call__(self, text: str) -> str:
        """A name not yet used."""
        clean = re.sub(r"[^A-Za-z0-9_]", "_", text)[: LONGEST_NAME - 10] or "_"
        clean = f"_{clean}" if not (clean[0].isalpha() or clean[0] == "_") or clean in RESERVED else clean
        while clean in self._used:
            clean += "_"
        self._used.add(clean)
        return clean


class Reading:
    """Turns floats into exact numbers, and keeps note of what was changed for that."""

    def __init__(self) -> None:
        self.limited: dict[str, list[str]] = {}
        self.lengths: dict[str, str] = {}
        self.angles: dict[str, str] = {}
        self.rough: dict[str, None] = {}

    def length(self, value: float) -> sympy.Expr:
        """The decimal that a float is printed as, without noise in its last digits."""
        exact, near = expression(value), expression(round(value, PLACES))
        if exact == near or abs(value - float(near)) > NOISE:
            return exact
        self.lengths[f"{value:g}" if near == 0 else repr(value)] = f"{float(near):g}"
        return near

    def angle(self, value: float, name: str) -> tuple[sympy.Expr, sympy.Expr]:
        """Cosine and sine: of a multiple of pi that was meant, else of a rational point of the circle near.

        name: of the joint that it belongs to, for the notes.
        """
        turn = self.multiple(value)
        if turn is not None:
            return sympy.cos(turn), sympy.sin(turn)
        self.rough[name] = None
        return rational_point(Fraction(repr(value)), up=value > 0)

    def multiple(self, value: float) -> sympy.Expr | None:
        """The multiple of pi that a float in radians means; None where it means none."""
        quarters, twelfths = round(value * 2 / math.pi), round(value * 12 / math.pi)
        exact = sympy.Rational(quarters, 2) * sympy.pi
        if abs(value - quarters * math.pi / 2) > QUARTER:
            spelled = multiple_of_pi(value)
            if (
                spelled is None
                and abs(value - twelfths * math.pi / 12) <= TWELFTH
                and math.gcd(twelfths, 12) > 1
            ):
                spelled = sympy.Rational(twelfths, 12) * sympy.pi
            if spelled is None:
                return None
            exact = spelled
        if exact != 0 or value != 0:
            self.angles[f"{value:g}" if exact == 0 else repr(value)] = str(exact)
        return exact

    def rotation(self, rpy: Sequence[float], name: str) -> sympy.Matrix:
        """The rotation of a joint's origin: about x, then y, then z, each exact."""
        turn = sympy.eye(3)
        for axis, value in zip("xyz", rpy, strict=True):
            c, s = self.angle(value, name)
            turn = _about(axis, c, s) * turn
        return turn.applyfunc(sympy.expand)

    def quaternion(self, given: Sequence[float], name: str) -> sympy.Matrix:
        """The rotation of a unit quaternion (w, x, y, z): exact about a simple axis, else a rational one."""
        w, *vector = given
        turn = self.multiple(2 * math.atan2(math.hypot(*vector), w))
        if turn is not None and (turn / (2 * sympy.pi)).is_Integer:
            return sympy.eye(3)
        axis = None if turn is None else _simple_axis(vector)
        if axis is not None:
            x, y, z = axis
            cross = sympy.Matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
            exact = sympy.eye(3) + sympy.sin(turn) * cross + (1 - sympy.cos(turn)) * cross * cross
            return exact.applyfunc(sympy.expand)
        self.rough[name] = None
        a, b, c, d = map(_rational, given)
        rows = [
            [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
        ]
        return sympy.Matrix(rows) / (a * a + b * b + c * c + d * d)

    def axis(self, given: Sequence[float], name: str) -> sympy.Matrix:
        """The unit vector of a joint's axis.

        A coordinate axis where one is near; the given direction where the root of its squared length is
        simple, as of 0.6 0.8 0 and of 1 1 1; else a rational point of the sphere near.
        """
        simple = _simple_axis(given)
        if simple is not None:
            return simple
        norm = math.hypot(*given)
        unit = [x / norm for x in given]
        self.rough[name] = None
        pole = max(range(3), key=lambda i: abs(unit[i]))
        sign = 1 if unit[pole] > 0 else -1
        flat = [_rational(x / (1 + abs(unit[pole]))) for i, x in enumerate(unit) if i != pole]
        square = sum((x * x for x in flat), sympy.Integer(0))
        point = [2 * x / (1 + square) for x in flat]
        point.insert(pole, sign * (1 - square) / (1 + square))
        return sympy.Matrix(point)

    def limits(self, name: str, turning: bool, low: float, high: float) -> list[Limit]:
        """A joint's range, low <= high: a length's as spelled, an angle's with ends rounded outwards."""
        if low == high:
            self.limited.setdefault(f"left out, as both are {low:g}", []).append(name)
            return []
        if not turning:
            ends = (self.length(end) if math.isfinite(end) else None for end in (low, high))
            bounds = Limit(sympy.Symbol(f"length({name})"), *ends)
            return [] if bounds.low is None and bounds.high is None else [bounds]
        if not (math.isfinite(low) and math.isfinite(high)):
            return []
        arc, words = decimal_arc(name, low, high)
        for part in words.split(", ") if words else ():
            what = "rounded outwards by at most 1e-6" if " is rounded" in part else part
            if name not in (names := self.limited.setdefault(what, [])):
                names.append(name)
        return [] if arc is None else [arc]

    @property
    def notes(self) -> tuple[str, ...]:
        """What was changed, in sentences."""
        said = []
        if self.lengths:
            said.append(f"Lengths without noise: {_pairs(self.lengths)}.")
        if self.angles:
            said.append(f"Angles as multiples of pi: {_pairs(self.angles)}.")
        if self.rough:
            said.append(f"Rotated by rational numbers within {NEAR:g} of the file's: {_listed(self.rough)}.")
        said += [f"Limits of {', '.join(names)}: {words}." for words, names in self.limited.items()]
        return tuple(said)


def across(axis: sympy.Matrix) -> sympy.Matrix:
    """A unit vector at right angles to a unit vector: a coordinate axis where one is, no new roots.

    >>> across(sympy.Matrix([sympy.Rational(2, 3), sympy.Rational(1, 3), sympy.Rational(2, 3)])).T
    Matrix([[11/15, -2/15, -2/3]])
    """
    zero = next((i for i in range(3) if axis[i] == 0), None)
    if zero is not None:
        return sympy.Matrix([int(i == zero) for i in range(3)])
    x, y, z = axis
    below = 1 + abs(z)
    return sympy.Matrix([1 - x * x / below, -x * y / below, -x * sympy.sign(z)]).applyfunc(sympy.radsimp)


def _simple_axis(given: Sequence[float]) -> sympy.Matrix | None:
    """The unit vector of a coordinate axis that is near, or of a direction of small whole ratios."""
    norm = math.hypot(*given)
    unit = [x / norm for x in given]
    near = [round(x) for x in unit]
    if max(abs(x - r) for x, r in zip(unit, near, strict=True)) <= QUARTER:
        return sympy.Matrix(near)
    largest = max(map(abs, given))
    ratios = [Fraction(x / largest).limit_denominator(20) for x in given]
    if all(abs(float(r) - x / largest) < TWELFTH for r, x in zip(ratios, given, strict=True)):
        exact = sympy.Matrix([sympy.Rational(r.numerator, r.denominator) for r in ratios])
        return exact / sympy.sqrt(exact.dot(exact))
    return None


def _about(axis: str, c: sympy.Expr, s: sympy.Expr) -> sympy.Matrix:
    """A rotation about a coordinate axis by the angle of this cosine and sine."""
    angle = sympy.Symbol("angle")
    return rotation(axis, angle).subs({sympy.cos(angle): c, sympy.sin(angle): s})


def _rational(value: float) -> sympy.Rational:
    """The fraction of least denominator within a quarter of `NEAR`."""
    exact, spare = Fraction(value), Fraction(NEAR) / 4
    found = simplest(exact - spare, exact + spare)
    return sympy.Rational(found.numerator, found.denominator)


def _pairs(changed: dict[str, str]) -> str:
    return _listed(f"{given} is {meant}" for given, meant in changed.items())


def _listed(parts: Iterable[str]) -> str:
    every = list(parts)
    more = len(every) - _SHOWN
    return ", ".join(every[:_SHOWN]) + (f" and {more} more" if more > 0 else "")
