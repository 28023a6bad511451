"""Shorter polynomials with the same values on a set, and what may not be used to shorten them."""

from __future__ import annotations

from fractions import Fraction

import pytest

from singsym.polynomials import AlgebraicConstant, Polynomial, Ring
from singsym.polynomials.short_forms import ShortForms, short_forms

R = Ring(("c", "s", "x", "y"))
c, s, x, y = R.gens
CIRCLE = c**2 + s**2 - 1
FORMS = ShortForms(R, (CIRCLE, x - y**2))


@pytest.mark.parametrize(
    ("equation", "expected"),
    [
        (CIRCLE, (CIRCLE, ("c", "s"))),
        (5 - 2 * c**2 - 3 * s**2, (2 * c**2 + 3 * s**2 - 5, ("c", "s"))),
        (c**2 - s**2 - 1, None),
        (c**2 + s**2, None),
        (c**2 + s**2 + 1, None),
        (c**2 + s - 1, None),
        (c**2 + c * s + s**2 - 1, None),
    ],
    ids=str,
)
def test_sums_of_squares(equation: Polynomial, expected: tuple[Polynomial, tuple[str, ...]] | None) -> None:
    """An ellipse with either sign; no hyperbola, point, empty set, parabola, or inclined ellipse."""
    assert ShortForms(R, (equation,)).squares == (() if expected is None else (expected,))


def test_equal_polynomials_on_circles_have_one_normal_form() -> None:
    """c^3 + c s^2 = c, and c^2 - s^2 = 1 - 2 s^2 = 2 c^2 - 1, which c s is not."""
    assert FORMS.normal_form(c**3 + c * s**2) == FORMS.normal_form(c)
    assert FORMS.normal_form(c**2 - s**2) == FORMS.normal_form(2 * c**2 - 1)
    assert FORMS.normal_form(c**2 - s**2) != FORMS.normal_form(c * s)


def test_shortened_polynomials_keep_their_values() -> None:
    """At (c, s, x, y) = (3/5, 4/5, 9, 3), where both equations hold."""
    point = [Fraction(3, 5), Fraction(4, 5), Fraction(9), Fraction(3)]
    for p in (2 * c**2 + 2 * s**2 + c, c**2 * x + s**2 * x - y**2, (c + s) ** 2, x**2 * c - y**2 * s):
        found = FORMS.shorten(p)
        assert len(found) <= len(p)
        assert found.evaluate(point) == p.evaluate(point)
    assert FORMS.shorten(2 * c**2 + 2 * s**2 + c) == c + 2


def test_multiples_of_an_equation_are_zero_and_others_are_not() -> None:
    """x^2 - y^4 = (x - y^2)(x + y^2) vanishes with x - y^2; x + y^2 does not."""
    assert FORMS.shorten(x**2 - y**4).is_zero
    assert FORMS.shorten((x - y**2) * c).is_zero
    assert not FORMS.shorten(x + y**2).is_zero
    assert not FORMS.shorten(x**2 + y**4).is_zero


def test_the_minimal_polynomial_of_a_constant_is_used() -> None:
    root = AlgebraicConstant("r", (-2, 0, 1), Fraction(1), Fraction(2))
    ring = Ring(("c", "r"), constants=(root,))
    a, r = ring.gens
    forms = short_forms(ring, ())
    assert forms.normal_form(r**3 * a) == 2 * r * a
    assert short_forms(ring, ()) is forms
