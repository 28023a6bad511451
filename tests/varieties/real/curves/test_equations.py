"""What is offered for tracking: sets that are curves, with their isolated points, and nothing else."""

from __future__ import annotations

import pytest

from singsym.effort.budget import Budget
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.equations import CurveEquations, NotACurve, candidates

R = Ring(("x", "y", "z"))
x, y, z = R.gens
SPHERE = x**2 + y**2 + z**2 - 1


def offered(*equations: Polynomial) -> list[CurveEquations]:
    return [found.value for found in candidates(equations[0].ring, equations, Budget(20))]


def test_a_complete_intersection_is_tried_as_it_is() -> None:
    first = offered(SPHERE, (x + y + z) ** 2)[0]
    assert set(first.equations) == {SPHERE, x + y + z}
    assert first.points == ()


@pytest.mark.parametrize(
    ("equations", "dimension"),
    [((SPHERE,), 2), ((x, y, z - 1), 0), ((x * y, x * z), 2), ((SPHERE, SPHERE * x), 2)],
    ids=["a surface", "a point", "a plane and a line", "two equations of a surface"],
)
def test_what_is_no_curve_is_refused(equations: tuple[Polynomial, ...], dimension: int) -> None:
    with pytest.raises(NotACurve, match=f"dimension {dimension}"):
        offered(*equations)


def test_an_isolated_point_is_kept_apart() -> None:
    """The z axis, and (1, 0, 0) beside it: on the axis x = 0."""
    last = offered(x * (x - 1), x * z, y)[-1]
    assert [p.floats for p in last.points] == [(1.0, 0.0, 0.0)]
    assert Ideal(R, last.equations).equals(Ideal(R, (x, y))).value


def test_a_point_on_the_curve_is_no_isolated_one() -> None:
    """x y = x^2 = z = 0 is the y axis with a point embedded in it at the origin."""
    assert all(found.points == () for found in offered(x * y, x**2, z))


def test_twisted_cubic_with_an_equation_too_many() -> None:
    """Three equations of a curve in space: its union of components has the same ideal, which is prime."""
    cubic = (y - x**2, z - x**3, x * z - y**2)
    last = offered(*cubic)[-1]
    assert Ideal(R, last.equations).equals(Ideal(R, cubic)).value
    assert last.points == ()


def test_nothing_at_all() -> None:
    """1 = 0, and x = 0 with x = 1."""
    assert offered(R.one, x) == [CurveEquations(())]
    assert offered(x, x - 1, y)[-1] == CurveEquations(())
    plane = Ring(("x", "y", "z", "w"))
    a, b = plane.gens[:2]
    assert offered(a * b - 1, a) == [CurveEquations(())]
