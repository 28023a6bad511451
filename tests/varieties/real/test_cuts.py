"""Dimensions by cuts with hyperplanes, on sets whose components are known by hand."""

from __future__ import annotations

import pytest

from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.cuts import dimension_by_cuts
from singsym.varieties.real.witness import RealSystem

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
    cut = dimension_by_cuts(RealSystem(R, equations, exclusions=exclusions))
    assert cut.dimension == dimension
    assert (cut.point is not None) == (dimension >= 0)
    if cut.point is not None:
        assert not any(map(cut.point.sign, equations))


def test_no_point_where_only_smaller_components_are_real() -> None:
    """x^2 + y^2 = 0 is two complex planes, and real on the line x = y = 0 alone, where they meet."""
    cut = dimension_by_cuts(RealSystem(R, (x**2 + y**2,)))
    assert cut.dimension == 2
    assert cut.point is None


def test_an_isolated_point_beside_a_curve_is_no_point_of_the_curve() -> None:
    """The curve y^2 = x^2 (x - 1) has an isolated real point at the origin, of tangent dimension 2."""
    cut = dimension_by_cuts(RealSystem(R, (y**2 - x**2 * (x - 1), z, z * x), positive=(1 - x,)))
    assert cut.dimension == 1
    assert cut.point is None
