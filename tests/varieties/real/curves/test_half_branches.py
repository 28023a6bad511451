"""How many half-branches leave a singular point, counted by fibres of a distance."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.arithmetic import System
from singsym.varieties.real.curves.critical_points import distance_samples, singular_points
from singsym.varieties.real.curves.half_branches import branch_star
from singsym.varieties.real.curves.singular_points import Star

R = Ring(("x", "y"))
x, y = R.gens


def star_at_zero(curve: Polynomial) -> Star:
    """The star at the one singular point, by the distance from a random point."""
    (origin,) = singular_points([curve], Budget(20)).value
    samples = distance_samples([curve], origin.floats, Random(3), Budget(20)).value
    system = System(R, (curve,))
    return branch_star(system, [curve], samples.objective, origin, samples.points, Budget(20)).value


@pytest.mark.parametrize(
    ("curve", "degree"),
    [
        (y**2 - x**3, 2),
        ((y - x**2) * (y + x**2), 4),
        (x * y * (x - y), 6),
        (x**3 - y**3 + x**4 + y**4, 2),
        (x**4 + y**6, 0),
    ],
    ids=["cusp", "tacnode", "triple point", "one smooth branch", "isolated"],
)
def test_half_branches(curve: Polynomial, degree: int) -> None:
    """A cusp t -> (t^2, t^3) has two, two parabolas four, three lines six.

    x^3 - y^3 has the one real line x = y as tangent cone, so its curve is one arc through the point.
    """
    star = star_at_zero(curve)
    assert star.degree == degree
    assert star.kind == ("branched" if degree else "isolated")
    for gate, way in zip(star.gates.mid, star.outward, strict=True):
        assert abs(curve.evaluate([float(v) for v in gate])) < 1e-9
        assert np.isclose(np.linalg.norm(way), 1.0)


def test_gates_of_a_cusp_are_on_both_sides() -> None:
    """Both half-branches of y^2 = x^3 go to the right, one up and one down."""
    star = star_at_zero(y**2 - x**3)
    assert sorted(np.sign(star.gates.mid[:, 1])) == [-1, 1]
    assert (star.gates.mid[:, 0] > 0).all()


def test_two_points_at_one_level_are_not_told_apart() -> None:
    """(x^2 - 1)^3 = y^2 has cusps at (1, 0) and (-1, 0), at one distance from the origin."""
    curve = (x**2 - 1) ** 3 - y**2
    system = System(R, (curve,))
    cusps = singular_points([curve], Budget(20)).value
    assert len(cusps) == 2
    with pytest.raises(Undecided, match="same level"):
        branch_star(system, [curve], x**2 + y**2, cusps[0], cusps, Budget(20))
