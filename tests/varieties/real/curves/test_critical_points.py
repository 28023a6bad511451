"""Points that meet each component, singular points, and which curves are proven bounded; by hand."""

from __future__ import annotations

from random import Random

import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Known
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.critical_points import (
    as_balls,
    critical_determinant,
    distance_samples,
    gradient_rows,
    is_bounded,
    level_above,
    points_on_components,
    singular_points,
    with_ends,
)
from singsym.varieties.real.points.finite_sets import real_points

R = Ring(("x", "y"))
x, y = R.gens
S = Ring(("x", "y", "z"))
X, Y, Z = S.gens
CIRCLE = x**2 + y**2 - 1


@pytest.mark.parametrize(
    ("equations", "bounded"),
    [
        ([CIRCLE], True),
        ([x**2 + x * y + y**2 - 1], True),
        ([1 - 2 * x**2 - 3 * y**2], True),
        ([x**2 - 1, y**2 - x], True),
        ([X**2 + Y**2 - 1, Z**2 - Y, X - Y], True),
        ([x**2 + 3 * x * y + y**2 - 1], False),
        ([x * y - 1], False),
        ([y - x**2], False),
        ([(x + y) ** 2 - 1], False),
        ([X**2 + Y**2 - 1, Z - X * Y], False),
    ],
    ids=str,
)
def test_boundedness_by_definite_forms(equations: list[Polynomial], bounded: bool) -> None:
    """x^2 + x y + y^2 = (x + y/2)^2 + 3/4 y^2 is definite; x^2 + 3 x y + y^2 is -1 at (1, -1)."""
    assert is_bounded(equations) == bounded


def test_extreme_points_of_a_circle() -> None:
    """A coordinate is critical on the circle in two points; no end, as it is bounded."""
    known = points_on_components([CIRCLE], 0, Budget(20))
    assert known is not None
    found = known.value
    assert {tuple(abs(v) for v in p.floats) for p in found.points} in ({(1.0, 0.0)}, {(0.0, 1.0)})
    assert (len(found.points), found.ends, found.level) == (2, (), None)


def test_each_branch_of_a_hyperbola_has_a_point_and_two_ends() -> None:
    """Each branch has a nearest point to any centre, and meets a circle around all of these twice."""
    known = points_on_components([x * y - 1], 0, Budget(20))
    assert known is not None
    found = known.value
    assert found.level is not None
    assert {p.sign(x) for p in found.points} == {1, -1}
    assert sorted(p.sign(x) for p in found.ends) == [-1, -1, 1, 1]
    assert all(p.sign(found.objective - found.level) == 0 for p in found.ends)
    assert all(p.sign(found.objective - found.level) < 0 for p in found.points)


def test_each_oval_of_a_curve_has_a_point() -> None:
    """Circles of radius 1 around (0, 0) and (4, 0): points with x < 2 and points with x > 2."""
    known = points_on_components([CIRCLE * ((x - 4) ** 2 + y**2 - 1)], 0, Budget(20))
    assert known is not None
    found = known.value
    assert {p.sign(x - 2) for p in found.points} == {1, -1}


def test_a_double_curve_has_no_isolated_critical_points() -> None:
    """On x^2 = 0 the gradient is zero everywhere, so all points are critical for any objective."""
    assert points_on_components([x**2], 0, Budget(20)) is None
    with pytest.raises(Undecided, match="not isolated"):
        distance_samples([x**2], (0.0, 0.0), Random(1), Budget(20))


def test_the_critical_determinant() -> None:
    """det [[2x, 2y], [0, 1]] = 2 x for the circle and y, and the zeros with z = 0 for a great circle."""
    assert critical_determinant(gradient_rows([CIRCLE]), y, Random(1)) == 2 * x
    great = critical_determinant(gradient_rows([X**2 + Y**2 + Z**2 - 1, Z]), Y, Random(1))
    assert great.primitive() == X


def test_singular_points() -> None:
    """The node of y^2 = x^2 (x + 1); the axes in space meet at the origin; a circle has none."""
    assert [p.floats for p in singular_points([y**2 - x**2 * (x + 1)], Budget(20)).value] == [(0.0, 0.0)]
    axes = [X * Y, Y * Z, Z * X]
    assert [p.floats for p in singular_points(axes, Budget(20)).value] == [(0.0, 0.0, 0.0)]
    assert singular_points([CIRCLE], Budget(20)).value == ()


def test_levels_and_balls_are_on_the_safe_side() -> None:
    """At (sqrt 2, 0), (-sqrt 2, 0) the form 5 x + 1 is at most 1 + 5 sqrt 2 < 9; the balls hold the roots."""
    points = real_points((x**2 - 2, y)).value
    assert level_above(5 * x + 1, points) > 9
    assert level_above(5 * x + 1, []) > 1
    balls = as_balls(points, 2)
    for mid, rad in zip(balls.mid, balls.rad, strict=True):
        assert 0 < rad[0] < 1e-12
        assert (abs(mid[0]) - rad[0]) ** 2 <= 2 <= (abs(mid[0]) + rad[0]) ** 2


def test_ends_are_sought_only_where_a_curve_may_be_unbounded() -> None:
    assert with_ends([CIRCLE], x, Known(()), Budget(20)).value.level is None
    parabola = with_ends([y - x**2], y, real_points((x, y)), Budget(20)).value
    assert parabola.level is not None
    assert sorted(p.sign(x) for p in parabola.ends) == [-1, 1]
