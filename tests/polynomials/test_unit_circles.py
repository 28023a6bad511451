"""Pairs of variables that equations make unit vectors, and no others."""

from __future__ import annotations

from fractions import Fraction

import pytest

from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.unit_circles import circle, half_angle_point, separate_circles, unit_circles

R = Ring(("c", "s", "d", "x"))
c, s, d, x = R.gens


@pytest.mark.parametrize(
    "equation",
    [
        c**2 + s**2,
        c**2 + s**2 + 1,
        c**2 + s**2 - 4,
        c**2 - s**2 - 1,
        c**2 + 2 * s**2 - 1,
        c**2 + s**2 + x - 1,
    ],
    ids=str,
)
def test_what_is_no_unit_circle(equation: Polynomial) -> None:
    """A point, nothing, a circle of radius 2, a hyperbola, an ellipse, a paraboloid."""
    assert list(unit_circles([equation])) == []


def test_multiples_are_the_same_circle() -> None:
    assert list(unit_circles([1 - c**2 - s**2, 3 * circle(d, x)])) == [("c", "s"), ("d", "x")]


def test_circles_that_share_a_variable_are_not_separate() -> None:
    assert separate_circles([circle(c, s), circle(s, d), circle(d, x)]) == (("c", "s"), ("d", "x"))


@pytest.mark.parametrize("tangent", [Fraction(0), Fraction(1), Fraction(-3, 7), Fraction(100)])
def test_points_by_half_angles_are_on_the_circle(tangent: Fraction) -> None:
    """tan(t / 2) = sin t / (1 + cos t)."""
    cosine, sine = half_angle_point(tangent)
    assert cosine**2 + sine**2 == 1
    assert sine == tangent * (1 + cosine)
