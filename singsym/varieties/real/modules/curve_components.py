"""The connected components of a curve, counted in its smallest ring and lifted by the modules that come last.

Source: coverings of curves, see lifted_curve.py; the curve below by real_curve.py.
"""

from __future__ import annotations

from collections.abc import Sequence

from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, Undecided
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import remember
from singsym.polynomials import Equations, Polynomial
from singsym.polynomials.block_form import with_last_modules
from singsym.varieties.real.curves.arithmetic import System
from singsym.varieties.real.curves.real_curve import real_curve
from singsym.varieties.real.modules.assemblies import is_round
from singsym.varieties.real.modules.lifted_curve import LiftedCurve, lifted_curves, towers
from singsym.varieties.real.modules.module_points import module_points, with_values, without_given
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.splitting import used_ring


def components_off(equations: Equations, exclusions: Sequence[Equations], budget: Budget) -> int:
    """How many components of a smooth bounded curve of a core and dyads do not lie in any exclusion.

    Raises `Undecided` where the equations are not of such a curve, or this is not proven.

    >>> from singsym.polynomials import Ring
    >>> ring = Ring(("c", "s", "x", "y"))
    >>> c, s, x, y = ring.gens
    >>> four_bar = (c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 9, (x - 3) ** 2 + y**2 - 4)
    >>> components_off(four_bar, (), Budget()), components_off(four_bar, ((y,), (c, s)), Budget())
    (2, 2)
    """
    key = (equations[0].ring, frozenset(p.primitive() for p in equations))
    points = remember("components by modules", key, lambda: _points(equations, budget), budget)
    return sum(not any(_lies_in(p, group, equations) for group in exclusions) for p in points)


def _points(equations: Equations, budget: Budget) -> tuple[BoxPoint, ...]:
    """One of each component."""
    left, given = without_given(equations)
    over = next(towers(left), None) if left else None
    if over is not None:
        with attempt("the components of a curve of dyads over circles", share=1 / 2):
            curves = lifted_curves(over, module_points, budget).value
            tops = (curve.point_on(loop) for curve in curves for loop in curve.loops)
            return tuple(with_values(point, given, equations[0].ring) for point in tops)
    core, dyads = with_last_modules(equations, 2)
    if not core or not dyads or not all(map(is_round, dyads)):
        raise Undecided("the curve has no dyads that come last")
    ring = equations[0].ring
    below = ring.with_names(tuple(n for n in ring.names if any(n in p.variables for p in core)))
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
    others = [p for p in group if not _vanishes(p, equations)]
    if any(point.sign(p) for p in others):
        return False
    if others:
        raise Undecided("whether a component lies in an exclusion is not seen")
    return True


def _vanishes(polynomial: Polynomial, equations: Equations) -> bool:
    """Whether it is seen to be a combination of the equations in its variables."""
    ring = used_ring(polynomial.ring, (polynomial,))
    own = tuple(ring.convert(p) for p in equations if {*ring.names} >= {*p.variables})
    return any(own) and Ideal(ring, own).contains(ring.convert(polynomial)).value
