"""The connected components of a curve, counted in its smallest ring and lifted by the modules that come last.

Source: coverings of curves: over circles as graphs, see coverings.py; over others see lifted_curve.py and
real_curve.py.
"""

from __future__ import annotations

from collections.abc import Sequence

import networkx as nx

from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, Undecided
from singsym.elimination.linear_substitution import Substitution
from singsym.elimination.memo import remember
from singsym.polynomials import Equations
from singsym.polynomials.block_form import with_last_modules
from singsym.varieties.disjoint_parts import disjoint_parts
from singsym.varieties.real.curves.arithmetic import System
from singsym.varieties.real.curves.real_curve import real_curve
from singsym.varieties.real.modules.assemblies import is_round
from singsym.varieties.real.modules.coverings import Covering, coverings, is_arc_in, vanishes
from singsym.varieties.real.modules.crossing_curves import components_of_crossing, crossing_parts
from singsym.varieties.real.modules.curve_point import CurvePoint
from singsym.varieties.real.modules.lifted_curve import LiftedCurve
from singsym.varieties.real.modules.module_points import points_of, without_given
from singsym.varieties.real.modules.no_assembly import has_no_assembly
from singsym.varieties.real.modules.towers import Tower, towers
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.intervals import sign_on_box
from singsym.varieties.splitting import used_ring


def components_off(equations: Equations, exclusions: Sequence[Equations], budget: Budget) -> int:
    """How many components of a curve of dyads over circles or over a smooth core are in no exclusion.

    Raises `Undecided` where the equations are not of such a curve, or this is not proven.

    >>> from singsym.polynomials import Ring
    >>> ring = Ring(("c", "s", "x", "y"))
    >>> c, s, x, y = ring.gens
    >>> four_bar = (c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 9, (x - 3) ** 2 + y**2 - 4)
    >>> components_off(four_bar, (), Budget()), components_off(four_bar, ((y,), (c, s)), Budget())
    (2, 2)
    """
    if (parts := parts_of_curve(equations)) is not None:
        return sum(components_off(part, exclusions, budget) for part in parts)
    left, given = without_given(equations)
    groups = [_with_given(group, given, left) for group in exclusions] if left else []
    for over in towers(left):
        with attempt("the components of a curve of dyads over circles", share=1 / 2):
            return _over_circles(over, left, groups, budget)
    for over in towers(left):
        with attempt("the components of curves of dyads that cross", share=1 / 2):
            return components_of_crossing(crossing_parts(over), groups, budget)
    key = (equations[0].ring, frozenset(p.primitive() for p in equations))
    points = remember("components by modules", key, lambda: _points(equations, budget), budget)
    return sum(not any(_lies_in(p, group, equations) for group in exclusions) for p in points)


def parts_of_curve(equations: Equations) -> tuple[Equations, ...] | None:
    """Disjoint parts of a curve, without those that are seen to have no point; None where it is one part."""
    parts = disjoint_parts(equations)
    return None if len(parts) == 1 else tuple(part for part in parts if not _is_no_curve(part))


def _is_no_curve(part: Equations) -> bool:
    """Whether as many equations as unknowns are seen to have no real solution."""
    unknowns = {name for p in part for name in p.variables}
    return len(part) >= len(unknowns) and has_no_assembly(part).is_yes


def _with_given(group: Equations, given: Sequence[Substitution], left: Equations) -> Equations:
    """Polynomials on the curve in the variables that are left."""
    for step in given:
        group = step.apply(group)
    return tuple(map(left[0].ring.convert, group))


def _over_circles(over: Tower, equations: Equations, exclusions: Sequence[Equations], budget: Budget) -> int:
    """Those of a tower: of the graphs of its coverings, for each point of what its circle does not need."""
    key = (equations[0].ring, equations)
    curves, others = remember("coverings", key, lambda: _coverings(over, equations, budget), budget)
    return sum(_components(curve, other, exclusions, equations) for curve in curves for other in others)


def _coverings(
    over: Tower, equations: Equations, budget: Budget
) -> tuple[tuple[Covering, ...], tuple[CurvePoint | None, ...]]:
    """The curves over the circle of a tower, and the points of the modules that it does not need."""
    own = over.needed
    apart = [p for p in equations if p not in own]
    ring = used_ring(equations[0].ring, own)
    others = towers([ring.convert(p) for p in equations if p in own])
    tower = over if not apart else next(t for t in others if t.base == over.base)
    curves = coverings(tower, points_of, budget).value
    if not apart:
        return curves, (None,)
    beside = used_ring(equations[0].ring, apart)
    system = tuple(map(beside.convert, apart))
    points = points_of(system)
    return curves, tuple(CurvePoint.of(p, system) for p in points.value)


def _components(
    curve: Covering, other: CurvePoint | None, exclusions: Sequence[Equations], equations: Equations
) -> int:
    """Those of a curve, with a point in further coordinates, that are in no exclusion.

    Arcs in one are left out; a point where no arc ends is a component of its own.
    """

    def whole(point: CurvePoint) -> CurvePoint:
        return point.beside(other, equations[0].ring)

    graph = nx.Graph()
    for arc in curve.arcs:
        middle = whole(curve.middle(arc))
        if not any(is_arc_in(middle, group, equations) for group in exclusions):
            graph.add_edge(*arc.ends)
    ends = {k for arc in curve.arcs for k in arc.ends}
    alone = (whole(point) for k, point in enumerate(curve.points) if k not in ends)
    kept = sum(not any(all(p.sign(q) == 0 for q in group) for group in exclusions) for p in alone)
    return int(nx.number_connected_components(graph)) + kept


def _points(equations: Equations, budget: Budget) -> tuple[BoxPoint, ...]:
    """One of each component."""
    core, dyads = with_last_modules(equations, 2)
    if not core or not dyads or not all(map(is_round, dyads)):
        raise Undecided("the curve has no dyads that come last")
    ring = equations[0].ring
    below = used_ring(ring, core)
    if len(core) != len(below.names) - 1:
        raise Undecided("the core of the curve is not given by one equation less than unknowns")
    own = tuple(map(below.convert, core))
    found = real_curve(own, budget=budget)
    if found.verdict.is_undecided or found.singular_points or found.isolated_points:
        raise Undecided(f"the core of the curve is not proven to be smooth: {found.verdict}")
    if not all(component.closed for component in found.components):
        raise Undecided("the core of the curve is not bounded")
    curve = LiftedCurve(System(below, own), found.loops)
    for module in dyads:
        curve = curve.lifted(module, ring, budget)
    return tuple(curve.point_on(loop) for loop in curve.loops)


def _lies_in(point: BoxPoint, group: Equations, equations: Equations) -> bool:
    """Whether the component of a point lies in an exclusion; `Undecided` where this is not seen.

    It does where all polynomials vanish on the curve, and not where the point is outside.
    """
    if any(sign_on_box(p, point.box) for p in group):
        return False
    others = [p for p in group if not vanishes(p, equations).value]
    if any(point.sign(p) for p in others):
        return False
    if others:
        raise Undecided("whether a component lies in an exclusion is not seen")
    return True
