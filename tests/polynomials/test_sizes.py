"""Sizes of variables: those of circles are their radii, in every unit."""

from __future__ import annotations

from fractions import Fraction

import pytest

from singsym.polynomials import AlgebraicConstant, Ring
from singsym.polynomials.sizes import largest_term, variable_sizes

R = Ring(("x", "y", "c"))
x, y, c = R.gens


@pytest.mark.parametrize("k", [Fraction(1, 1000), Fraction(7, 3), Fraction(10**6)])
def test_sizes_grow_with_the_unit(k: Fraction) -> None:
    """x = k x' makes of x'^2 + y'^2 = 4, x' = 2 c'^3 + 1 the same sizes times k; that of c stays."""
    here = variable_sizes(R, [x**2 + y**2 - 4, x - 2 * c**3 - 1])
    there = variable_sizes(R, [x**2 + y**2 - 4 * k**2, x - 2 * k * c**3 - k])
    assert there == pytest.approx((k * here[0], k * here[1], here[2]))


def test_what_is_not_determined_has_size_one() -> None:
    assert variable_sizes(R, [x**2 + y**2]) == pytest.approx((1, 1, 1))
    assert variable_sizes(R, []) == (1, 1, 1)


def test_a_constant_has_its_value() -> None:
    """The relation s^2 = 4264957983 says nothing of lengths: x = s y / 65306 has x and y of one size."""
    root = AlgebraicConstant("s", (-4264957983, 0, 1), Fraction(65306), Fraction(65307))
    ring = Ring(("x", "y", "s"), constants=(root,))
    x, y, s = ring.gens
    found = variable_sizes(ring, [*ring.relations, 65306 * x - s * y, x**2 + y**2 - 1])
    assert found == pytest.approx((1, 1, 65306.5), rel=1e-4)


def test_the_largest_term() -> None:
    assert largest_term(3 * x**2 - 100 * y, (10.0, 1.0, 1.0)) == 300
    assert largest_term(R.zero, (1.0, 1.0, 1.0)) == 0
