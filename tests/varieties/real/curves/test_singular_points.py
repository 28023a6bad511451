"""Double points that are told at sight: a crossing, an isolated point, and what is neither."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.arithmetic import Balls, System
from singsym.varieties.real.curves.critical_points import as_balls
from singsym.varieties.real.curves.singular_points import Star, node
from singsym.varieties.real.points.finite_sets import real_points

R = Ring(("x", "y"))
x, y = R.gens
S = Ring(("x", "y", "z"))
X, Y, Z = S.gens


def star_at_zero(*equations: Polynomial) -> Star | None:
    """What `node` says of the origin."""
    ring = equations[0].ring
    (origin,) = real_points(ring.gens).value
    system = System(ring, equations)
    return node(system, origin, as_balls([origin.refine(80)], len(ring.names)))


def at(*points: tuple[float, ...]) -> Balls:
    return Balls(np.array(points), np.full((len(points), len(points[0])), 1e-12))


def test_two_lines_that_cross() -> None:
    """x y = 0: one half-branch along each half-axis."""
    star = star_at_zero(x * y)
    assert star is not None
    assert (star.kind, star.degree) == ("node", 4)
    ways = {tuple(np.round(way).astype(int)) for way in star.outward}
    assert ways == {(1, 0), (-1, 0), (0, 1), (0, -1)}
    for gate, way in zip(star.gates.mid, star.outward, strict=True):
        assert abs(gate[0] * gate[1]) < 1e-9
        assert gate @ way > 0


def test_an_isolated_point() -> None:
    """x^2 + 2 y^2 - x^3 is positive near the origin but there."""
    star = star_at_zero(x**2 + 2 * y**2 - x**3)
    assert star is not None
    assert (star.kind, star.degree) == ("isolated", 0)


def test_a_crossing_on_a_surface() -> None:
    """z = x y and z = 0: the two axes again, in space."""
    star = star_at_zero(Z - X * Y, Z)
    assert star is not None
    assert (star.kind, star.degree) == ("node", 4)


@pytest.mark.parametrize(
    "equations",
    [(y**2 - x**3,), (y**2 - x**4,), (x * y * (x - y),), (x**4 + y**4,), (X * Y, Y * Z, Z * X)],
    ids=["cusp", "tacnode", "triple point", "isolated, of order 4", "three axes"],
)
def test_no_other_point_is_taken_for_one(equations: tuple[Polynomial, ...]) -> None:
    """Their quadratic forms are degenerate, or there are more equations than n - 1."""
    assert star_at_zero(*equations) is None


def test_a_chart_holds_what_is_near_and_tells_the_quadrants() -> None:
    """The chart of x y = 0 is about the origin; its half-branches are in different quadrants."""
    star = star_at_zero(x * y)
    assert star is not None
    assert star.chart is not None
    assert star.chart.holds(at((0.0, 0.0))).all()
    assert not star.chart.holds(at((10.0, 0.0), (0.0, -10.0))).any()
    signs = star.chart.signs(star.gates)
    assert len({tuple(s) for s in signs}) == 4
    for k in range(4):
        inside = star.chart.in_quadrants(star.gates, np.repeat(signs[k : k + 1], 4, axis=0))
        assert inside.tolist() == [j == k for j in range(4)]


def test_the_centre_is_in_no_open_quadrant() -> None:
    star = star_at_zero(x**2 - y**2)
    assert star is not None
    assert star.chart is not None
    for signs in ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)):
        assert not star.chart.in_quadrants(at((0.0, 0.0)), np.array([signs])).any()
