"""Numerical points and witnesses are found alike in every unit."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.sizes import largest_term
from singsym.varieties.real.numerical import sampling
from singsym.varieties.real.numerical.sampling import numerical_codimension, numerical_points
from singsym.varieties.real.points.certified_point import find_witness
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y", "z"))
x, y, z = R.gens
UNITS = [Fraction(1, 10**6), Fraction(7, 3), Fraction(10**6)]


def torus_knot(k: Fraction) -> RealSystem:
    """A sphere and a plane of lengths times k, off x = 0 and with y > k/10."""
    equations = (x**2 + y**2 + z**2 - 9 * k**2, x + 2 * y - z - k)
    return RealSystem(R, equations, exclusions=((x,),), positive=(10 * y - k,))


@pytest.mark.parametrize("k", UNITS)
def test_numerical_points_in_every_unit(k: Fraction) -> None:
    here, there = numerical_points(torus_knot(Fraction(1))), numerical_points(torus_knot(k))
    assert len(here) == len(there) == 3
    assert np.allclose(np.array(there) / float(k), here, rtol=1e-6, atol=1e-6)
    found = numerical_codimension(torus_knot(k))
    assert found is not None
    assert found[0] == 2


def test_a_regular_point_of_a_set_with_parts_of_two_dimensions() -> None:
    """x y = x z = 0 is a plane and a line: on the line both gradients are independent."""
    x, y, z = Ring(("x", "y", "z")).gens
    found = numerical_codimension(RealSystem(x.ring, (x * y, x * z)))
    assert found is not None
    codimension, (a, b, c) = found
    assert codimension == 2
    assert abs(b) + abs(c) < 1e-6 < abs(a)


@pytest.mark.parametrize("k", UNITS)
def test_witnesses_in_every_unit(k: Fraction) -> None:
    system = torus_knot(k)
    found = find_witness(system)
    assert found is not None
    assert all(found.sign(p) == 0 for p in system.equations)
    assert found.sign(10 * y - k) == 1


def test_what_is_large_is_seen_without_all_terms_at_a_point(monkeypatch: pytest.MonkeyPatch) -> None:
    """x^2 y - 3 is -1 at (1, 2): more than rounding, whatever its terms are, which are 4 at most.

    At x = 10^6 it is rounding alone that may leave 1 of terms of 10^12.
    """
    p = x**2 * y - 3
    asked: list[tuple[float, ...]] = []

    def noted(polynomial: Polynomial, sizes: tuple[float, ...]) -> float:
        asked.append(sizes)
        return largest_term(polynomial, sizes)

    monkeypatch.setattr(sampling, "largest_term", noted)
    assert sampling.is_large(p, ((1.0, 2.0, 0.0),))
    assert not asked
    assert not sampling.is_large(x**2 - y**2 + 1, ((1e6, 1e6, 0.0),))
    assert asked == [(1e6, 1e6, 0.0)]
