"""Common zeros over almost all values of some coordinates, against sets that are products of lines."""

from __future__ import annotations

import pytest

from singsym.effort.chance import use_seed
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.dimension.triangular_fibres import Triangular, miss_almost_all

R = Ring(("x", "y", "z"))
x, y, z = R.gens
TWO_LINES = ((y**2 - x**2, "y"),)
"""The lines y = x and y = -x."""


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(
    ("tower", "polynomials", "missed"),
    [
        (TWO_LINES, (y - 2 * x,), True),
        (TWO_LINES, (y - x,), False),
        # each of them vanishes on one of the lines, and both only at the origin
        (TWO_LINES, (y - x, y + x), True),
        (TWO_LINES, (), False),
        # z = 1 / (y - 2 x) is -1/x or -1/(3 x)
        ((((y - 2 * x) * z - 1, "z"), *TWO_LINES), (x * z + 2,), True),
        ((((y - 2 * x) * z - 1, "z"), *TWO_LINES), (x * z + 1,), False),
        # its leading coefficient is zero on one of the lines, where anything may be true
        ((((y - x) * z - 1, "z"), *TWO_LINES), (z - 2,), False),
        ((((y - x) * z, "z"), *TWO_LINES), (z - 2,), False),
        # a line twice
        ((((y - x) ** 2, "y"),), (y - x,), False),
        ((((y - x) ** 2, "y"),), (y - x - 1,), True),
        # a prime number is no zero, and a third of x is one as much as x
        ((((y - x / 3), "y"),), (y / 7 - x / 21,), False),
        ((((y - x / 3), "y"),), (y / 7 - x / 22,), True),
    ],
)
def test_what_misses_the_points_over_almost_all_values(
    tower: Triangular, polynomials: tuple[Polynomial, ...], missed: bool, seed: int
) -> None:
    with use_seed(seed):
        assert miss_almost_all(tower, "x", polynomials) == missed


def test_too_many_points_are_not_looked_at() -> None:
    assert not miss_almost_all(((y**40 - x, "y"), (z**10 - x, "z")), "x", (y - z,))
