"""A curve of dyads over a circle as a graph: its sheets, and the points where they meet; nothing is traced.

Source: branched coverings, Forster, Lectures on Riemann Surfaces (1981), section 4, for real points.
Lemma: over an arc of a curve on which a dyad's discriminant is not zero stand two sheets, told by the sign of
the tangency, or none.  At an end of the arc each sheet has one limit: the assembly with the same sign, and
where the discriminant is zero the only one.  Its line is one there: where the discriminant is positive, as
that is a form of second degree in the line's coefficients, and where it is zero by the balls of the point.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from math import cos, sin

from flint import arb

from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Known, Premises
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.polynomials.block_form import Module, determining
from singsym.varieties.real.modules.assemblies import Dyad, assemblies, dyad, value_at
from singsym.varieties.real.modules.towers import Tower
from singsym.varieties.real.points.enclosed_point import EnclosedPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.points.intervals import at_precision, ball
from singsym.varieties.splitting import used_ring

_BITS = (64, 256, 1024)
"""Bits of the balls of a point, tried in turn where something is not seen."""
_HEIGHTS = (Fraction(1, 4), Fraction(2, 7), Fraction(3, 11))
"""Where a circle's arcs begin: in radii above its centre."""

Balls = Mapping[str, arb]
Solver = Callable[[Equations], Known[tuple[EnclosedPoint, ...]]]
"""Finds all real points of finitely many."""


@dataclass(frozen=True, eq=False)
class CurvePoint:
    """A point of a curve by balls as small as wanted.

    equations: what it is one of finitely many solutions of; locate: balls of its coordinates, for so many
    bits; premises: what rests on its being one of those that were found.
    """

    ring: Ring
    equations: Equations
    locate: Callable[[int], Balls]
    premises: Premises
    _known: dict[int, Balls] = field(default_factory=dict)

    def balls(self, bits: int) -> Balls:
        """Balls that hold the coordinates, by name."""
        if bits not in self._known:
            with at_precision(bits + 64):
                self._known[bits] = self.locate(bits)
        return self._known[bits]

    def located(self) -> CurvePoint:
        """The same point; raises `Undecided` where there are no balls of it, as where a dyad turns freely."""
        for bits in _BITS[:-1]:
            with suppress(Undecided):
                self.balls(bits)
                return self
        self.balls(_BITS[-1])
        return self

    def sign(self, polynomial: Polynomial) -> int:
        """The sign at the point: exact algebra is asked where balls do not tell it from zero."""
        sign = self.seen_sign(polynomial)
        return self._exact_sign(polynomial) if sign is None else sign

    def seen_sign(self, polynomial: Polynomial) -> int | None:
        """The sign, where balls tell it or the polynomial is one of the point's equations."""
        if polynomial.is_zero or polynomial.primitive() in {p.primitive() for p in self.equations}:
            return 0
        for bits in _BITS:
            known = self.balls(bits)
            with at_precision(bits + 64):
                value = value_at(polynomial, known)
                if value > 0 or value < 0:
                    return 1 if value > 0 else -1
        return None

    def _exact_sign(self, polynomial: Polynomial) -> int:
        equations = determining(
            tuple(dict.fromkeys((*self.ring.relations, *self.equations))), polynomial.variables
        )
        own = used_ring(self.ring, equations)
        found = self.premises.take(real_points(tuple(map(own.convert, equations))))
        for bits in _BITS:
            known = self.balls(bits)
            near = [
                p
                for p in found
                if all(known[n].overlaps(b) for n, b in zip(own.names, p.refine(bits).box, strict=True))
            ]
            if len(near) == 1:
                return near[0].sign(own.convert(polynomial))
        raise Undecided(f"the sign of {polynomial.short_text()} at a point of a curve")

    @staticmethod
    def of(point: EnclosedPoint, equations: Equations, premises: Premises | None = None) -> CurvePoint:
        """A point that was found."""
        return CurvePoint(point.ring, equations, _balls_of(point), premises or Premises())

    def beside(self, other: CurvePoint | None, ring: Ring) -> CurvePoint:
        """The point in more coordinates, those of another point."""
        if other is None:
            return self
        equations = tuple(map(ring.convert, (*self.equations, *other.equations)))
        return CurvePoint(ring, equations, lambda b: {**other.balls(b), **self.balls(b)}, self.premises)

    def over(self, module: Module, ring: Ring, values: Callable[[Balls], Balls]) -> CurvePoint:
        """The point with the values of a module's unknowns."""
        equations = tuple(map(ring.convert, (*self.equations, *module.equations)))
        return CurvePoint(ring, equations, lambda bits: _and(self.balls(bits), values), self.premises)


def _and(known: Balls, values: Callable[[Balls], Balls]) -> Balls:
    return {**known, **values(known)}


@dataclass(frozen=True)
class Arc:
    """A sheet over an arc of the circle: the signs of its dyads' tangencies, and its ends, by number."""

    signs: tuple[int, ...]
    ends: tuple[int, int]


@dataclass(frozen=True, eq=False)
class Covering:
    """All real points of a curve over one circle.

    circle: what turns on; dyads: those lifted so far, in order; points: where arcs end, among them all points
    where a discriminant is zero; origins: the numbers of those over the point of the circle where its arcs
    begin.
    """

    circle: _Circle
    equations: Equations
    dyads: tuple[Module, ...]
    points: tuple[CurvePoint, ...]
    origins: frozenset[int]
    arcs: tuple[Arc, ...]

    @property
    def ring(self) -> Ring:
        """The ring of the curve."""
        return self.equations[0].ring

    def middle(self, arc: Arc) -> CurvePoint:
        """A point inside an arc."""
        start, end = self._span(arc, _BITS[0])
        point = self.circle.at((float(start.mid()) + float(end.mid())) / 2)
        if not start < self.circle.turn(point, _BITS[0]) < end:
            raise Undecided("the ends of an arc of a curve are too near")
        for module, sign in zip(self.dyads, arc.signs, strict=True):
            point = point.over(module, _with(self.ring, point.ring, module), _assembly(module, sign))
        return point

    def _span(self, arc: Arc, bits: int) -> tuple[arb, arb]:
        """The turns between which an arc stands."""
        start, end = arc.ends
        return (
            arb(0) if start in self.origins else self.circle.turn(self.points[start], bits),
            2 * arb.pi() if end in self.origins else self.circle.turn(self.points[end], bits),
        )

    def lifted(self, module: Module, solve: Solver, premises: Premises, budget: Budget) -> Covering:
        """The covering by the assemblies of a dyad."""
        budget.check("sheets of a curve")
        form = dyad(module)
        assert form is not None
        if form.pivot is not None and not form.pivot.is_constant:
            raise Undecided("two circles of a dyad may be one at a point of a curve")
        discriminant = self.ring.convert(form.discriminant)
        below = self._cut(discriminant, solve, premises)
        ring = _with(self.circle.whole, self.ring, module)
        equations = tuple(map(ring.convert, (*self.equations, *module.equations)))
        points, origins, number = list[CurvePoint](), set[int](), dict[tuple[int, int], int]()
        for k, point in enumerate(below.points):
            sign = point.sign(discriminant)
            for label in () if sign < 0 else (0,) if sign == 0 else (1, -1):
                values = form.touching if label == 0 else _assembly(module, label)
                number[k, label] = len(points)
                if k in below.origins:
                    origins.add(len(points))
                points.append(point.over(module, ring, values).located())
        arcs = [
            Arc((*arc.signs, label), (_limit(number, arc.ends[0], label), _limit(number, arc.ends[1], label)))
            for arc in below.arcs
            if below.middle(arc).sign(discriminant) > 0
            for label in (1, -1)
        ]
        dyads = (*self.dyads, module)
        return Covering(self.circle, equations, dyads, tuple(points), frozenset(origins), tuple(arcs))

    def _cut(self, polynomial: Polynomial, solve: Solver, premises: Premises) -> Covering:
        """With all zeros of a polynomial among the points where arcs end."""
        system = (*self.equations, polynomial)
        cuts: dict[Arc, list[CurvePoint]] = {arc: [] for arc in self.arcs}
        tangencies = [self.ring.convert(_form(module).tangency) for module in self.dyads]
        for zero in premises.take(solve(system)):
            point = CurvePoint.of(zero, system, premises)
            if self.circle.holds(point) and (arc := self._arc_of(point, tangencies)) is not None:
                cuts[arc].append(point)
        points, arcs = list(self.points), list[Arc]()
        for arc, inside in cuts.items():
            stops = [arc.ends[0]]
            for point in self.circle.sorted(inside):
                stops.append(len(points))
                points.append(point)
            stops.append(arc.ends[1])
            arcs += [Arc(arc.signs, ends) for ends in itertools.pairwise(stops)]
        return replace(self, points=tuple(points), arcs=tuple(arcs))

    def _arc_of(self, point: CurvePoint, tangencies: Sequence[Polynomial]) -> Arc | None:
        """The arc that a point is inside of; none where it is an end of some."""
        signs = tuple(map(point.sign, tangencies))
        if 0 in signs:
            return None
        for bits in _BITS:
            turn = self.circle.turn(point, bits)
            for arc in self.arcs:
                start, end = self._span(arc, bits)
                if arc.signs == signs and start < turn < end:
                    return arc
        raise Undecided("on which arc of a curve a point is, is not seen")


def _form(module: Module) -> Dyad:
    found = dyad(module)
    assert found is not None
    return found


def _limit(number: Mapping[tuple[int, int], int], end: int, label: int) -> int:
    """The limit of a sheet with this sign at an end of an arc."""
    found = number.get((end, label), number.get((end, 0)))
    if found is None:
        raise Undecided("a sheet of a curve has no limit at an end of its arc")
    return found


def _assembly(module: Module, sign: int) -> Callable[[Balls], Balls]:
    """The assembly of a dyad at which the tangency has this sign."""
    tangency = _form(module).tangency

    def values(known: Balls) -> Balls:
        for found in assemblies(module, known):
            value = value_at(tangency, {**known, **found})
            if (value > 0 and sign > 0) or (value < 0 and sign < 0):
                return found
        raise Undecided("which assembly of a dyad is on a sheet is not seen")

    return values


def _balls_of(point: EnclosedPoint) -> Callable[[int], Balls]:
    return lambda bits: dict(zip(point.ring.names, point.refine(bits).box, strict=True))


def _with(whole: Ring, ring: Ring, module: Module) -> Ring:
    """The ring with the unknowns of a module, in the order of the whole."""
    return whole.with_names(n for n in whole.names if n in ring.names or n in module.unknowns)


@dataclass(frozen=True, eq=False)
class _Circle:
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
    height: Fraction

    @property
    def ring(self) -> Ring:
        return self.equations[0].ring

    def known(self, bits: int) -> dict[str, arb]:
        return {} if self.standing is None else dict(_balls_of(self.standing)(bits))

    def shape(self, bits: int) -> tuple[arb, arb, arb]:
        """Centre and square of the radius."""
        circle, (x, y), known = self.equations[-1], self.base, self.known(bits)
        parts = (circle.coefficient(x, i).coefficient(y, j) for i, j in ((2, 0), (1, 0), (0, 1), (0, 0)))
        a, b, c, d = (value_at(p, known) for p in parts)
        return -b / (2 * a), -c / (2 * a), (b * b + c * c) / (4 * a * a) - d / a

    def holds(self, point: CurvePoint) -> bool:
        """Whether a point is over this circle, and not over one of the others."""
        for bits in _BITS:
            near = [p for p in (self.standing, *self.others) if p is None or _meets(point, p, bits)]
            if len(near) <= 1:
                return near == [self.standing]
        raise Undecided("what a point of a curve stands on is not seen")

    def at(self, turn: float) -> CurvePoint:
        """The point at about this turn, one coordinate at a rational."""
        with at_precision(_BITS[0]):
            _, _, square = self.shape(_BITS[0])
            start = float((square.sqrt()).mid())
            u, v = (float(x.mid()) / start for x in self._from_centre(self.origin, _BITS[0]))
        across, along = cos(turn) * u - sin(turn) * v, cos(turn) * v + sin(turn) * u
        k = 0 if abs(along) > abs(across) else 1
        with at_precision(_BITS[0]):
            middle = float(self.shape(_BITS[0])[k].mid())
        level = Fraction(middle + start * (across, along)[k]).limit_denominator(10**6)
        return self._held(k, level, (along, across)[k] > 0)

    @cached_property
    def origin(self) -> CurvePoint:
        """Where its arcs begin."""
        with at_precision(_BITS[0]):
            _, across, square = self.shape(_BITS[0])
            level = float(across.mid()) + float(self.height) * float(square.sqrt().mid())
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
        for bits in _BITS:
            turns = sorted(((self.turn(p, bits), p) for p in points), key=lambda pair: float(pair[0].mid()))
            if all(one[0] < two[0] for one, two in itertools.pairwise(turns)):
                yield from (p for _, p in turns)
                return
        raise Undecided("the order of two points of a curve is not seen")


def _meets(point: CurvePoint, other: EnclosedPoint, bits: int) -> bool:
    known = point.balls(bits)
    return all(known[n].overlaps(b) for n, b in _balls_of(other)(bits).items())


def coverings(found: Tower, solve: Solver, budget: Budget) -> Known[tuple[Covering, ...]]:
    """The curves of a tower, one over each point of its foundation where its circle has real points.

    Raises `Undecided` where a dyad turns freely over a point, a discriminant is zero on a whole sheet, or
    something is not seen.

    >>> from singsym.polynomials import Ring
    >>> from singsym.varieties.real.modules.towers import towers
    >>> ring = Ring(("c", "s", "x", "y"))
    >>> c, s, x, y = ring.gens
    >>> parallelogram = (c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 4, (x - 2) ** 2 + y**2 - 1)
    >>> (curve,) = coverings(next(towers(parallelogram)), real_points, Budget()).value
    >>> len(curve.arcs), len(curve.points) - len(curve.origins)
    (6, 2)
    """
    ring, premises = found.circle.ring, Premises()
    below = ring.with_names(n for n in ring.names if any(n in m.unknowns for m in found.foundation))
    given = tuple(below.convert(p) for m in found.foundation for p in m.equations)
    standing: tuple[EnclosedPoint | None, ...] = premises.take(solve(given)) if given else (None,)
    own = ring.with_names(n for n in ring.names if n in below.names or n in found.base)
    equations = tuple(map(own.convert, (*given, found.circle)))
    curves = []
    for point in standing:
        others = tuple(p for p in standing if p is not None and p is not point)
        circle = _Circle(ring, equations, found.base, point, others, premises, _HEIGHTS[0])
        curve = _circle_alone(circle)
        if curve is None:
            continue
        for module in found.dyads:
            curve = curve.lifted(module, solve, premises, budget)
        curves.append(curve)
    return premises.conclude(tuple(curves))


def _circle_alone(circle: _Circle) -> Covering | None:
    """The curve that is only the circle; none where it has no real points."""
    with at_precision(_BITS[1]):
        *_, square = circle.shape(_BITS[1])
        if square < 0:
            return None
        if not square > 0:
            raise Undecided("whether a circle has real points is not seen")
    return Covering(circle, circle.equations, (), (circle.origin,), frozenset((0,)), (Arc((), (0, 0)),))
