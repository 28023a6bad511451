"""Remainders and S-polynomials over Z, by hand in the order degrevlex with x > y."""

from __future__ import annotations

from flint import fmpq_mpoly, fmpz_mpoly_vec

from singsym.elimination.engines.division import remainder, s_polynomial
from singsym.polynomials import Polynomial, Ring

R = Ring(("x", "y"))
x, y = R.gens


def remainder_of(p: Polynomial, *divisors: Polynomial) -> Polynomial:
    vector = fmpz_mpoly_vec([d.integer() for d in divisors], R.integer_context)
    return Polynomial(R, fmpq_mpoly(remainder(p.integer(), vector)))


def test_the_remainder_up_to_a_factor() -> None:
    """x^2 y + y - x (x y - 1) = x + y; 2 x^2 - x (2 x - 1) = x, and 2 x - (2 x - 1) = 1."""
    assert remainder_of(x**2 * y + y, x * y - 1) == x + y
    assert remainder_of(x**2, 2 * x - 1) == 1
    assert remainder_of(x**2 - y, x**2 - y).is_zero


def test_no_term_of_a_remainder_is_divisible() -> None:
    """y^3 + x is reduced by y^2 - 1 to y + x, which is not zero: it is not in the ideal."""
    assert remainder_of(y**3 + x, y**2 - 1) == x + y
    assert remainder_of(x + y, x**2, y**2) == x + y


def test_leading_terms_cancel_in_an_s_polynomial() -> None:
    """The lcm of 2 x^2 and 3 x y is 6 x^2 y: 3 y (2 x^2 + y) - 2 x (3 x y + 1) = 3 y^2 - 2 x."""
    found = Polynomial(R, fmpq_mpoly(s_polynomial((2 * x**2 + y).integer(), (3 * x * y + 1).integer())))
    assert found.primitive() == 3 * y**2 - 2 * x
