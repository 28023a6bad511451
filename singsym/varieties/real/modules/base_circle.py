"""The circle that a curve of dyads stands on: its points by the angle of a turn.

Source: Freudenstein, the input angle of a crank; real points in balls, see curve_point.py.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import cos, sin

from flint import arb

from singsym.effort.budget import Undecided
from singsym.effort.verdict import Premises
from singsym.polynomials import Equations, Ring
from singsym.varieties.real.modules.assemblies import value_at
from singsym.varieties.real.modules.curve_point import BITS, Balls, CurvePoint, balls_of
from singsym.varieties.real.points.enclosed_point import EnclosedPoint
from singsym.varieties.real.points.intervals import at_precision, ball

_HEIGHT = Fraction(1, 4)
"""Where a circle's arcs begin: in radii above its centre."""


@dataclass(frozen=True, eq=False)
class BaseCircle:
    """The circle that a curve stands on, over one point of what determines it.

    whole: the ring of the curve; equations: of the circle and of what it stands on; standing: that point, if
    there is something, and the others.
    """

    whole: Ring
    equations: Equations
    base: tuple[str, str]
    standing: EnclosedPoint | None
    others: tuple[EnclosedPoint, ...]
    premises: Premises
    _shapes: dict[int, tuple[arb, arb, arb]] = field(default_factory=dict)

    @property
    def ring(self) -> Ring:
        """The ring of the circle and of what it stands on."""
        return self.equations[0].ring

    def known(self, bits: int) -> dict[str, arb]:
        """Balls of what it stands on, for so many bits."""
        return {} if self.standing is None else dict(balls_of(self.standing)(bits))

    def shape(self, bits: int) -> tuple[arb, arb, arb]:
        """Centre and square of the radius."""
        if bits not in self._shapes:
            circle, (x, y), known = self.equations[-1], self.base, self.known(bits)
            parts = (circle.coefficient(x, i).coefficient(y, j) for i, j in ((2, 0), (1, 0), (0, 1), (0, 0)))
            with at_precision(bits + 64):
                a, b, c, d = (value_at(p, known) for p in parts)
                self._shapes[bits] = -b / (2 * a), -c / (2 * a), (b * b + c * c) / (4 * a * a) - d / a
        return self._shapes[bits]

    def holds(self, point: CurvePoint) -> bool:
        """Whether a point is over this circle, and not over one of the others."""
        for bits in BITS:
            near = [p for p in (self.standing, *self.others) if p is None or _meets(point, p, bits)]
            if len(near) <= 1:
                return near == [self.standing]
        raise Undecided("what a point of a curve stands on is not seen")

    def at(self, turn: float) -> CurvePoint:
        """The point at about this turn, one coordinate at a rational."""
        with at_precision(BITS[0]):
            _, _, square = self.shape(BITS[0])
            start = float((square.sqrt()).mid())
            u, v = (float(x.mid()) / start for x in self._from_centre(self.origin, BITS[0]))
        across, along = cos(turn) * u - sin(turn) * v, cos(turn) * v + sin(turn) * u
        k = 0 if abs(along) > abs(across) else 1
        with at_precision(BITS[0]):
            middle = float(self.shape(BITS[0])[k].mid())
        level = Fraction(middle + start * (across, along)[k]).limit_denominator(10**6)
        return self._held(k, level, (along, across)[k] > 0)

    @cached_property
    def origin(self) -> CurvePoint:
        """Where its arcs begin."""
        with at_precision(BITS[0]):
            _, across, square = self.shape(BITS[0])
            level = float(across.mid()) + float(_HEIGHT) * float(square.sqrt().mid())
        return self._held(1, Fraction(level).limit_denominator(1000), True)

    def _held(self, k: int, level: Fraction, positive: bool) -> CurvePoint:
        """The point with coordinate k at a rational, the other one larger or smaller than the centre's."""
        held, other = self.base[k], self.base[1 - k]

        def locate(bits: int) -> Balls:
            *centre, square = self.shape(bits)
            half = (square - (ball(level) - centre[k]) ** 2).sqrt()
            return {
                **self.known(bits),
                held: ball(level),
                other: centre[1 - k] + (half if positive else -half),
            }

        equations = (*self.equations, self.ring.gen(held) - level)
        return CurvePoint(self.ring, equations, locate, self.premises)

    def _from_centre(self, point: CurvePoint, bits: int) -> tuple[arb, arb]:
        centre, known = self.shape(bits), point.balls(bits)
        return known[self.base[0]] - centre[0], known[self.base[1]] - centre[1]

    def turn(self, point: CurvePoint, bits: int) -> arb:
        """The angle from the origin to a point, between 0 and a whole turn."""
        with at_precision(bits + 64):
            (a, b), (u, v) = self._from_centre(self.origin, bits), self._from_centre(point, bits)
            along, across = a * u + b * v, a * v - b * u
            if across > 0:
                return arb.atan2(across, along)
            if across < 0:
                return arb.atan2(across, along) + 2 * arb.pi()
            if along < 0:
                return arb.atan2(-across, -along) + arb.pi()
            return arb("nan")

    def sorted(self, points: Sequence[CurvePoint]) -> Iterator[CurvePoint]:
        """Points of one sheet in the order in which the circle turns."""
        for bits in BITS:
            turns = sorted(((self.turn(p, bits), p) for p in points), key=lambda pair: float(pair[0].mid()))
            if all(one[0] < two[0] for one, two in itertools.pairwise(turns)):
                yield from (p for _, p in turns)
                return
        raise Undecided("the order of two points of a curve is not seen")


def _meets(point: CurvePoint, other: EnclosedPoint, bits: int) -> bool:
    known = point.balls(bits)
    return all(known[n].overlaps(b) for n, b in balls_of(other)(bits).items())
