"""Division in one variable, and by several polynomials one after another."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.remainders import Division, remainder

R = Ring(("c", "s", "d", "t", "x", "a"))
c, s, d, t, x, a = R.gens


@given(st.integers(0, 5), st.integers(0, 3))
def test_remainder_keeps_values_on_the_circle(i: int, j: int) -> None:
    p = s**i * c**j + 2 * s
    point = [R.constant(0)] * 6
    point[0], point[1] = R.constant(3) / 5, R.constant(4) / 5
    r = remainder(p, c**2 + s**2 - 1, "s")
    assert r.degree("s") <= 1
    assert r.evaluate(point) == p.evaluate(point)


@pytest.mark.parametrize(
    ("divisor", "name"), [(c**2 + s**2 - 1, "c"), (c**2 + s**2 - 1, "s"), (2 * t**3 - x * d - 5, "t")]
)
def test_a_remainder_has_a_lower_degree_and_differs_by_a_multiple(divisor: Polynomial, name: str) -> None:
    polynomial = (c + 2 * s * t - x) ** 4 + a * t**5 * c**2 - s**3
    found = remainder(polynomial, divisor, name)
    assert found.degree(name) < divisor.degree(name)
    assert divisor.divides(polynomial - found)
    assert remainder(found, divisor, name) == found


@pytest.mark.parametrize(
    "divisors",
    [
        (),
        ((c**2 + s**2 - 1, "s"), (d**2 + t**2 - 1, "t")),
        ((c**2 + s**2 + x**2 - 1, "x"), (x**2 + t**2 - 1, "t")),
        ((x**2 + t**2 - 1, "t"), (c**2 + s**2 + x**2 - 1, "x")),
        ((2 * t**3 - x * d - 5, "t"), (x**2 - a * t, "x")),
    ],
)
def test_several_divisions_are_single_ones_in_their_order(
    divisors: tuple[tuple[Polynomial, str], ...],
) -> None:
    """Also where no common order has a power of each variable in front, as for spheres that share one."""
    polynomial = (c + 2 * s * t - x) ** 4 + a * t**5 * c**2 - s**3 * x**3
    expected = polynomial
    for divisor, name in divisors:
        expected = remainder(expected, divisor, name)
    assert Division(divisors).remainder(polynomial) == expected
