"""Whether all points of a finite system are there: multiple points, missing points, none at all."""

from collections.abc import Sequence

import pytest
from flint import fmpz_poly

from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.points.completeness import is_complete
from singsym.varieties.real.points.parametrization import Parametrization

R = Ring(("x", "y"))
x, y = R.gens


def points(minimal: Sequence[int], x_of_t: Sequence[int], y_of_t: Sequence[int]) -> Parametrization:
    """The points (x(t), y(t)) at the roots of a polynomial, constant coefficients first."""
    coordinates = (fmpz_poly(list(x_of_t)), fmpz_poly(list(y_of_t)))
    return Parametrization(R, fmpz_poly(list(minimal)), fmpz_poly([1]), coordinates)


ROOTS_OF_2 = points((-2, 0, 1), (0,), (0, 1))


@pytest.mark.parametrize(
    ("found", "basis"),
    [
        (ROOTS_OF_2, (x, y**2 - 2)),
        # both points have the multiplicity 2, 4, 3, and 4 by both variables
        (ROOTS_OF_2, (x**2, y**2 - 2)),
        (ROOTS_OF_2, (x**4, y**2 - 2)),
        (ROOTS_OF_2, (x**3, y**2 - 2)),
        (ROOTS_OF_2, (x**2, (y**2 - 2) ** 2)),
        (points((0, 1), (0,), (1,)), (y - 1, x**3)),
        (points((1,), (), ()), (R.one,)),
    ],
)
def test_multiple_points_are_recognised(found: Parametrization, basis: tuple[Polynomial, ...]) -> None:
    assert is_complete(found, basis)


@pytest.mark.parametrize(
    "basis",
    [
        # beside x = 0 there is x = 1, also where x = 0 is double or 1 is
        (x**2 - x, y**2 - 2),
        (x**3 - x**2, y**2 - 2),
        (x**3 - 2 * x**2 + x, y**2 - 2),
        # beside y^2 = 2 there is y = 3
        (x, y**3 - 3 * y**2 - 2 * y + 6),
    ],
)
def test_a_missing_point_is_noticed(basis: tuple[Polynomial, ...]) -> None:
    assert not is_complete(ROOTS_OF_2, basis)


def test_more_multiplicity_than_is_looked_at_is_not_called_complete() -> None:
    assert not is_complete(ROOTS_OF_2, (x**30, y**2 - 2))
