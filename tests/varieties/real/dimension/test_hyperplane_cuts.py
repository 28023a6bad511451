"""Dimensions by cuts with hyperplanes, on sets whose components are known by hand."""

from __future__ import annotations

import pytest

from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.dimension.hyperplane_cuts import dimension_by_cuts, seems_at_most
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y", "z"))
x, y, z = R.gens
SPHERE = x**2 + y**2 + z**2 - 1


@pytest.mark.parametrize(
    ("equations", "exclusions", "dimension"),
    [
        ((SPHERE, x * SPHERE), (), 2),
        # a circle, written with an equation too many
        ((SPHERE, z, z * x), (), 1),
        # a plane, which is excluded, and a line through it
        ((x * y, x * z), ((x,),), 1),
        ((x * y, x * z), (), 2),
        # two points of the line z = 0, y = 0
        ((y, z, x**2 - 1, x * y), (), 0),
        ((x * (x - 1), x), ((x,),), -1),
    ],
)
def test_dimension(
    equations: tuple[Polynomial, ...], exclusions: tuple[tuple[Polynomial, ...], ...], dimension: int
) -> None:
    cut = dimension_by_cuts(RealSystem(R, equations, exclusions=exclusions)).value
    assert cut.dimension == dimension
    assert (cut.point is not None) == (dimension >= 0)
    if cut.point is not None:
        assert not any(map(cut.point.sign, equations))


def test_no_point_where_only_smaller_components_are_real() -> None:
    """x^2 + y^2 = 0 is two complex planes, and real on the line x = y = 0 alone, where they meet."""
    cut = dimension_by_cuts(RealSystem(R, (x**2 + y**2,))).value
    assert cut.dimension == 2
    assert cut.point is None


def test_an_isolated_point_beside_a_curve_is_no_point_of_the_curve() -> None:
    """The curve y^2 = x^2 (x - 1) has an isolated real point at the origin, of tangent dimension 2."""
    cut = dimension_by_cuts(RealSystem(R, (y**2 - x**2 * (x - 1), z, z * x), positive=(1 - x,))).value
    assert cut.dimension == 1
    assert cut.point is None


@pytest.mark.engines
@pytest.mark.parametrize(
    ("equations", "dimension"),
    [
        ((SPHERE,), 2),
        # a line and a plane; the line alone; two points; nothing, in a space of three dimensions
        ((x * y, x * z), 2),
        ((y, z * (y + 1)), 1),
        ((y, z, x**2 - 1), 0),
        ((y, z, y * x - 1), -1),
        # x is free
        ((y**2 + z**2 - 1,), 2),
    ],
)
def test_hyperplanes_bound_the_dimension(equations: tuple[Polynomial, ...], dimension: int) -> None:
    assert [seems_at_most(R, equations, d).is_yes for d in range(4)] == [d >= dimension for d in range(4)]
