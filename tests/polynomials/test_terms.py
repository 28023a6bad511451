"""Terms in doubles: as many as there are, each as exact arithmetic has it."""

from __future__ import annotations

from fractions import Fraction

from singsym.polynomials import Ring
from singsym.polynomials.terms import MANY, largest_coefficient, terms_at, value_at

R = Ring(("x", "y", "z"))
x, y, z = R.gens


def test_long_polynomials_have_the_values_that_exact_arithmetic_gives() -> None:
    """By Fractions, term by term; z occurs nowhere, and the point has a negative and a zero coordinate."""
    p = (x - 2 * y + 3) ** 11 / 7
    assert len(p) >= MANY
    for point in ((0.5, -1.25, 0.0), (0.0, 2.0, 9.0)):
        exact = p.evaluate([Fraction(a) for a in point])
        terms = terms_at(p, point)
        assert len(terms) == len(p)
        assert abs(value_at(p, point) - float(exact)) <= 1e-12 * abs(terms).max()


def test_no_terms() -> None:
    assert terms_at(R.zero, (1.0, 2.0, 3.0)).size == 0
    assert value_at(R.zero, (1.0, 2.0, 3.0)) == 0
    assert largest_coefficient(R.zero) == 0
