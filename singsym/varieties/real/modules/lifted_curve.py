"""A curve solved module by module: from a circle upwards, each dyad a covering of two sheets.

Source: coverings of curves, Forster, Lectures on Riemann Surfaces (1981), section 4, for real points: two
sheets where the dyad's discriminant is positive, none where it is negative, joined where it changes sign.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache

import numpy as np
from flint import arb

from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Known
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.polynomials.block_form import Module
from singsym.varieties.real.curves.arithmetic import System
from singsym.varieties.real.curves.assembly import assemble
from singsym.varieties.real.curves.critical_points import Samples, as_balls
from singsym.varieties.real.curves.paths import Chain
from singsym.varieties.real.curves.tracking import kernels
from singsym.varieties.real.curves.tubes import location
from singsym.varieties.real.curves.zeros import zeros_on
from singsym.varieties.real.modules.assemblies import Dyad, assemblies, dyad, value_at
from singsym.varieties.real.modules.towers import Tower, towers
from singsym.varieties.real.points.boxed_point import BoxPoint, box_around, boxed_point
from singsym.varieties.real.points.intervals import at_precision, ball

_BITS = 256


Solver = Callable[[Equations], Known[tuple[BoxPoint, ...]]]
"""Finds all real points of a square system."""


@dataclass(frozen=True, eq=False)
class LiftedCurve:
    """All of a curve, as loops that are proven: its connected components, each once.

    zeros: polynomials that vanish on it besides the system's.
    """

    system: System
    loops: tuple[Chain, ...]
    zeros: Equations = ()

    def where(self, polynomial: Polynomial, budget: Budget) -> Iterator[BoxPoint]:
        """The points where a polynomial is zero."""
        for loop in self.loops:
            for point in zeros_on(self.system, loop, polynomial, budget).zeros:
                yield replace(point, zeros=self.zeros)

    def lifted(self, module: Module, whole: Ring, budget: Budget) -> LiftedCurve:
        """The covering of the curve by the assemblies of a dyad.

        Lemma: over a loop on which the discriminant is positive it has two sheets, on which every component
        has a point over any point of the loop; over an arc where it is positive, between simple zeros, one
        component, which has a point over each end.  The dyad's line is one there, as the discriminant is a
        form of second degree in its coefficients.
        """
        found = dyad(module)
        assert found is not None
        lower = self.system.ring
        ring = whole.subring((*lower.names, *module.unknowns))
        equations = tuple(map(ring.convert, (*self.system.equations, *module.equations)))
        discriminant, tangency = lower.convert(found.discriminant), ring.convert(found.tangency)
        marks: list[BoxPoint] = []
        for loop in self.loops:
            signed = zeros_on(self.system, loop, discriminant, budget)
            if found.pivot is not None and not found.pivot.is_constant:
                self._never_zero(signed.chain, lower.convert(found.pivot), budget)
            marks += [_touching(z, found, (*equations, tangency)) for z in signed.zeros]
            if not signed.zeros and signed.signs[0] > 0:
                marks += _sheets(self.system, signed.chain, discriminant, module, equations)
        return _traced(ring, equations, marks, budget)

    def _never_zero(self, loop: Chain, polynomial: Polynomial, budget: Budget) -> None:
        if zeros_on(self.system, loop, polynomial, budget).zeros:
            raise Undecided("two circles of a dyad are one at a point of a curve")

    def point_on(self, loop: Chain) -> BoxPoint:
        """A certified point of one of the loops."""
        return _point_on(self.system, loop, len(loop.points) // 2)[0]


def points_on_tower(equations: Equations, solve: Solver, budget: Budget) -> Known[tuple[BoxPoint, ...]]:
    """All real points of a square system, of which all equations but one are a circle with dyads over it.

    solve: for what the circle stands on.
    Raises `Undecided` where they are not, or the curve is not smooth, or touched by the equation left out.

    >>> ring = Ring(("c", "s", "x", "y"))
    >>> c, s, x, y = ring.gens
    >>> crank_rocker = (c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 9, (x - 3) ** 2 + y**2 - 4)
    >>> found = points_on_tower((*crank_rocker, c * y - s * x), lambda equations: Known(()), Budget())
    >>> sorted(p.decimals(3)["x"] for p in found.value)
    ['1.50', '1.50', '3.50', '3.50']
    """
    first = _with_one_more(equations)
    if first is None:
        raise Undecided("the equations are not a curve of dyads over a circle, and one more")
    found, last = first
    known = lifted_curves(found, solve, budget)
    return known.map(lambda curves: tuple(p for curve in curves for p in curve.where(last, budget)))


def is_tower(equations: Equations) -> bool:
    """Whether equations are a circle with dyads over it, and one more."""
    return _with_one_more(equations) is not None


@lru_cache(maxsize=256)
def _with_one_more(equations: Equations) -> tuple[Tower, Polynomial] | None:
    """A way to see them so, with the equation that is left out; long ones are left out first."""
    for last in sorted(equations, key=len, reverse=True):
        for found in towers([p for p in equations if p is not last]):
            return found, last
    return None


def lifted_curves(found: Tower, solve: Solver, budget: Budget) -> Known[tuple[LiftedCurve, ...]]:
    """The curves of a tower, one over each point of its foundation.

    Raises `Undecided` where one is not proven to be smooth.
    """
    ring = found.circle.ring
    given, own = found.standing, found.base_ring
    standing: Known[tuple[BoxPoint | None, ...]] = solve(given) if given else Known((None,))

    def over(point: BoxPoint | None) -> LiftedCurve:
        held = () if point is None else point.equations
        equations = tuple(map(own.convert, (*held, found.circle)))
        known = {} if point is None else dict(zip(point.ring.names, point.refine(_BITS).box, strict=True))
        curve = _traced(own, equations, list(_on_circle(equations, found.base, known)), budget)
        for module in found.dyads:
            curve = curve.lifted(module, ring, budget)
        zeros = () if point is None else tuple(map(ring.convert, point.zeros))
        return replace(curve, zeros=zeros)

    return standing.map(lambda points: tuple(map(over, points)))


def _traced(ring: Ring, equations: Equations, marks: Sequence[BoxPoint], budget: Budget) -> LiftedCurve:
    """The components through some points."""
    system = System(ring, equations)
    if not marks:
        return LiftedCurve(system, ())
    samples = Samples(ring.zero, (), boxed=tuple(marks))
    edges = assemble(system, equations, samples, (), budget, prove=True).edges
    return LiftedCurve(system, tuple(edge.chain for edge in edges))


def _on_circle(equations: Equations, base: tuple[str, str], known: dict[str, arb]) -> Iterator[BoxPoint]:
    """A point of a circle, where it is one: at about a quarter of its radius above its centre."""
    circle, (x, y) = equations[-1], base
    parts = (circle.coefficient(x, i).coefficient(y, j) for i, j in ((2, 0), (1, 0), (0, 1), (0, 0)))
    with at_precision(_BITS + 64):
        a, b, c, d = (value_at(p, known) for p in parts)
        square = (b * b + c * c) / (4 * a * a) - d / a
        if square < 0:
            return
        if not square > 0:
            raise Undecided("whether a circle has real points is not seen")
        middle = -c / (2 * a)
        height = Fraction(float((middle + square.sqrt() / 4).mid())).limit_denominator(1000)
        across = -b / (2 * a) + (square - (ball(height) - middle) ** 2).sqrt()
        values = {**known, x: across, y: ball(height)}
    yield box_around((*equations, circle.ring.gen(y) - height), values)


def _touching(base: BoxPoint, found: Dyad, equations: Equations) -> BoxPoint:
    """The point over a zero of the discriminant, where line and conic touch; the tangency comes last."""
    fine = base.refine(_BITS)
    with at_precision(_BITS + 64):
        known = dict(zip(base.ring.names, fine.box, strict=True))
        known |= found.touching(known)
    return box_around(equations, known)


def _sheets(
    system: System, loop: Chain, discriminant: Polynomial, module: Module, equations: Equations
) -> list[BoxPoint]:
    """The two points over one of the loop, at a rational value of a coordinate that changes fast there."""
    values = np.abs(System(system.ring, (discriminant,)).values(loop.points)[:, 0])
    base, held = _point_on(system, loop, int(values.argmax()))
    fine = base.refine(_BITS)
    with at_precision(_BITS + 64):
        known = dict(zip(base.ring.names, fine.box, strict=True))
        over = [{**known, **found} for found in assemblies(module, known)]
    return [box_around((*equations, equations[0].ring.convert(held)), balls) for balls in over]


def _point_on(system: System, loop: Chain, place: int) -> tuple[BoxPoint, Polynomial]:
    """A certified point of a loop near a vertex, and what holds it there: a coordinate at a rational."""
    vertex = loop.points[place]
    along = np.abs(kernels(system, vertex[None])[0])
    fastest = int(along.argmax())
    level = Fraction(float(vertex[fastest])).limit_denominator(10**6)
    held = system.ring.gens[fastest] - level
    point = boxed_point(system.ring, (*system.equations, held), {}, [float(v) for v in vertex])
    if point is None or loop.tubes is None:
        raise Undecided("the Krawczyk test fails at a point of a curve")
    inside, _ = location(loop.tubes, as_balls([point], len(system.ring.names)))
    if not inside.any():
        raise Undecided("a point of a curve is not proven to be on its loop")
    return point, held
