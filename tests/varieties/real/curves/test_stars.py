"""Which points are proven regular, and the stars of those that are not."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.effort.budget import Budget
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.arithmetic import Balls, System
from singsym.varieties.real.curves.critical_points import points_on_components
from singsym.varieties.real.curves.stars import find_stars, is_regular

R = Ring(("x", "y"))
x, y = R.gens


def regular(curve: Polynomial, point: tuple[float, float], radius: float = 1e-12) -> bool:
    ball = Balls(np.array([point]), np.full((1, 2), radius))
    return bool(is_regular(System(R, (curve,)), ball)[0])


def test_regular_where_the_gradient_is_surely_not_zero() -> None:
    """The gradient of x y is (y, x): zero at the origin alone, so no ball that holds it is regular."""
    assert regular(x**2 + y**2 - 1, (1.0, 0.0))
    assert regular(x * y, (1.0, 0.0))
    assert not regular(x * y, (0.0, 0.0))
    assert not regular(x * y, (0.1, 0.0), radius=0.2)
    assert not regular(y**2 - x**3, (0.0, 0.0))


def test_a_double_line_is_regular_nowhere() -> None:
    assert not regular(y**2, (1.0, 0.0))


@pytest.mark.parametrize(
    ("curve", "degrees"),
    [
        (x**2 + y**2 - 1, []),
        (y**2 - x**2 * (x + 1), [4]),
        (y**2 - x**2 * (x - 1), [0]),
        (y**2 - x**3, [2]),
        ((y - x**2) * (x - 1), [4]),
    ],
    ids=["circle", "node", "isolated point", "cusp", "line and parabola"],
)
def test_the_stars_of_a_curve(curve: Polynomial, degrees: list[int]) -> None:
    """y^2 = x^2 (x + 1) crosses itself; x^2 (x - 1) is negative near 0; x = 1 meets the parabola once."""
    samples = points_on_components([curve], 0, Budget(20))
    assert samples is not None
    stars, found = find_stars(System(R, (curve,)), [curve], samples.value, 0, Budget(20)).value
    assert sorted(star.degree for star in stars) == degrees
    for star in stars:
        assert any(star.point.coincides(p) for p in found.points)
