"""A curve of dyads over a circle as a graph: its sheets, and the points where they meet; nothing is traced.

Source: branched coverings, Forster, Lectures on Riemann Surfaces (1981), section 4, for real points.
Lemma: over an arc of a curve on which a dyad's discriminant is not zero stand two sheets, told by the sign of
the tangency, or none.  At an end of the arc each sheet has one limit: the assembly with the same sign, and
where the discriminant is zero the only one.  Its line is one there: where the discriminant is positive, as
that is a form of second degree in the line's coefficients, and where it is zero by the balls of the point.
Where the discriminant is zero on all of a curve, and the line always one, there is one sheet.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from flint import arb

from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Known, Premises
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.polynomials.block_form import Module
from singsym.varieties.real.modules.assemblies import Dyad, assemblies, dyad, value_at
from singsym.varieties.real.modules.base_circle import BaseCircle
from singsym.varieties.real.modules.curve_point import BITS, Balls, CurvePoint
from singsym.varieties.real.modules.towers import Tower
from singsym.varieties.real.points.enclosed_point import EnclosedPoint
from singsym.varieties.real.points.intervals import at_precision
from singsym.varieties.splitting import used_ring

Solver = Callable[[Equations], Known[tuple[EnclosedPoint, ...]]]
"""Finds all real points of finitely many."""


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

    circle: BaseCircle
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
        start, end = self._span(arc, BITS[0])
        point = self.circle.at((float(start.mid()) + float(end.mid())) / 2)
        if not start < self.circle.turn(point, BITS[0]) < end:
            raise Undecided("the ends of an arc of a curve are too near")
        for module, sign in zip(self.dyads, arc.signs, strict=True):
            ring = self.ring.subring((*point.ring.names, *module.unknowns))
            point = point.over(module, ring, _assembly(module, sign))
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
        everywhere = vanishes(discriminant, self.equations)
        if everywhere.value:
            premises.take(everywhere)
            return self._touched(module, form, premises)
        below = self.cut(discriminant, solve, premises)
        ring = self.circle.whole.subring((*self.ring.names, *module.unknowns))
        equations = tuple(map(ring.convert, (*self.equations, *module.equations)))
        points, origins, number = list[CurvePoint](), set[int](), dict[tuple[int, int], int]()
        for k, point in enumerate(below.points):
            sign = _sign(point, discriminant)
            for label in () if sign < 0 else (0,) if sign == 0 else (1, -1):
                number[k, label] = len(points)
                if k in below.origins:
                    origins.add(len(points))
                points.append(point.over(module, ring, _assembly(module, label)).located())
        arcs = [
            Arc((*arc.signs, label), (_limit(number, arc.ends[0], label), _limit(number, arc.ends[1], label)))
            for arc in below.arcs
            if below.middle(arc).sign(discriminant) > 0
            for label in (1, -1)
        ]
        dyads = (*self.dyads, module)
        return Covering(self.circle, equations, dyads, tuple(points), frozenset(origins), tuple(arcs))

    def _touched(self, module: Module, form: Dyad, premises: Premises) -> Covering:
        """The covering by a dyad that is in line everywhere: one sheet, where its line touches its conic."""
        if not premises.take(_has_no_zero(tuple(form.line.values()), self.equations)):
            raise Undecided("a dyad that is in line on all of a curve may turn freely")
        ring = self.circle.whole.subring((*self.ring.names, *module.unknowns))
        linear = replace(module, equations=(form.line_equation, form.tangency))
        equations = tuple(map(ring.convert, (*self.equations, *linear.equations)))
        points = tuple(point.over(linear, ring, form.touching).located() for point in self.points)
        arcs = tuple(Arc((*arc.signs, 0), arc.ends) for arc in self.arcs)
        return replace(self, equations=equations, dyads=(*self.dyads, module), points=points, arcs=arcs)

    def cut(self, polynomial: Polynomial, solve: Solver, premises: Premises) -> Covering:
        """With all zeros of a polynomial among the points where arcs end, found factor by factor."""
        cuts: dict[Arc, list[CurvePoint]] = {arc: [] for arc in self.arcs}
        tangencies = [self.ring.convert(_form(module).tangency) for module in self.dyads]
        earlier = list[Polynomial]()
        for factor, _ in polynomial.factors():
            system = (*self.equations, factor)
            for zero in premises.take(solve(system)):
                point = CurvePoint.of(zero, system, premises)
                if not self.circle.holds(point) or not all(map(point.sign, earlier)):
                    continue
                if (arc := self._arc_of(point, tangencies)) is not None:
                    cuts[arc].append(point)
            earlier.append(factor)
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
        sheet = [arc for arc in self.arcs if arc.signs == signs]
        if 0 in signs and not sheet:
            return None
        for bits in BITS:
            turn = self.circle.turn(point, bits)
            for arc in sheet:
                start, end = self._span(arc, bits)
                if start < turn < end:
                    return arc
        raise Undecided("on which arc of a curve a point is, is not seen")


def vanishes(polynomial: Polynomial, equations: Equations) -> Known[bool]:
    """Whether it is seen to be a combination of the equations in its variables."""
    if polynomial.is_zero:
        return Known(True)
    ring = used_ring(polynomial.ring, (polynomial,))
    own = _inside(ring, equations)
    return Ideal(ring, own).contains(ring.convert(polynomial)) if any(own) else Known(False)


def _has_no_zero(polynomials: Equations, equations: Equations) -> Known[bool]:
    """Whether they are seen to have no common zero on that of the equations in their variables."""
    ring = used_ring(polynomials[0].ring, polynomials)
    return Ideal(ring, (*map(ring.convert, polynomials), *_inside(ring, equations))).is_unit()


def _inside(ring: Ring, equations: Equations) -> Equations:
    return tuple(ring.convert(p) for p in equations if {*ring.names} >= {*p.variables})


def _sign(point: CurvePoint, polynomial: Polynomial) -> int:
    """The sign at a point, by the factors, of which one may be an equation of the point."""
    sign = 1 if polynomial.terms()[0][1] > 0 else -1
    for factor, power in polynomial.factors():
        sign *= point.sign(factor) if power % 2 else abs(point.sign(factor))
    return sign


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
    if sign == 0:
        return _form(module).touching
    tangency = _form(module).tangency

    def values(known: Balls) -> Balls:
        for found in assemblies(module, known):
            value = value_at(tangency, {**known, **found})
            if (value > 0 and sign > 0) or (value < 0 and sign < 0):
                return found
        raise Undecided("which assembly of a dyad is on a sheet is not seen")

    return values


def coverings(
    found: Tower, solve: Solver, budget: Budget, mark: Polynomial | None = None
) -> Known[tuple[Covering, ...]]:
    """The curves of a tower, one over each point of its foundation where its circle has real points.

    mark: a polynomial with finitely many zeros on the circle, at which arcs are to end.
    Raises `Undecided` where a dyad turns freely over a point, a discriminant is zero on a whole sheet but not
    on all of the curve, or something is not seen.

    >>> from singsym.polynomials import Ring
    >>> from singsym.varieties.real.modules.towers import towers
    >>> from singsym.varieties.real.points.finite_sets import real_points
    >>> ring = Ring(("c", "s", "x", "y"))
    >>> c, s, x, y = ring.gens
    >>> parallelogram = (c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 4, (x - 2) ** 2 + y**2 - 1)
    >>> (curve,) = coverings(next(towers(parallelogram)), real_points, Budget()).value
    >>> len(curve.arcs), len(curve.points) - len(curve.origins)
    (6, 2)
    """
    premises, given, own = Premises(), found.standing, found.base_ring
    standing: tuple[EnclosedPoint | None, ...] = premises.take(solve(given)) if given else (None,)
    equations = tuple(map(own.convert, (*given, found.circle)))
    curves = []
    for point in standing:
        others = tuple(p for p in standing if p is not None and p is not point)
        circle = BaseCircle(found.circle.ring, equations, found.base, point, others, premises)
        curve = _circle_alone(circle)
        if curve is None:
            continue
        if mark is not None:
            curve = curve.cut(own.convert(mark), solve, premises)
        for module in found.dyads:
            curve = curve.lifted(module, solve, premises, budget)
        curves.append(curve)
    return premises.conclude(tuple(curves))


def _circle_alone(circle: BaseCircle) -> Covering | None:
    """The curve that is only the circle; none where it has no real points."""
    with at_precision(BITS[1]):
        *_, square = circle.shape(BITS[1])
        if square < 0:
            return None
        if not square > 0:
            raise Undecided("whether a circle has real points is not seen")
    return Covering(circle, circle.equations, (), (circle.origin,), frozenset((0,)), (Arc((), (0, 0)),))


def is_arc_in(middle: CurvePoint, group: Equations, equations: Equations) -> bool:
    """Whether an arc lies in an exclusion, by a point inside of it; `Undecided` where this is not seen.

    Lemma: the curve is in the zeros of the group or in those of its saturation by it, and an analytic arc
    that is in the first near a point off the second is there as a whole.
    """
    if any(map(middle.seen_sign, group)):
        return False
    others = tuple(p for p in group if not vanishes(p, equations).value)
    if not others:
        return True
    if any(map(middle.sign, others)):
        return False
    ideal = Ideal(equations[0].ring, equations)
    if any(map(middle.sign, ideal.saturate(Ideal(ideal.ring, others)).value.generators)):
        return True
    raise Undecided("whether an arc of a curve lies in an exclusion is not seen")
