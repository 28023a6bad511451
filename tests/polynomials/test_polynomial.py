"""Arithmetic, division, factors and values of polynomials over Q."""

from __future__ import annotations

import pickle
from fractions import Fraction

import pytest
from flint import arb, fmpq

from singsym.polynomials import Polynomial, Ring, polynomial

R = Ring(("x", "y"))
x, y = R.gens


def test_rings_do_not_mix() -> None:
    """An x of another ring is neither equal to x nor added to it."""
    (other,) = Ring(("x",)).gens
    assert x != other
    with pytest.raises(ValueError, match="different rings"):
        x + other
    assert R.convert(other) == x


def test_equal_values_are_equal_and_hash_alike() -> None:
    p, q = (x + y) ** 2, x**2 + 2 * x * y + y**2
    assert p == q
    assert hash(p) == hash(q)
    assert p != p * 2
    assert (x - x + 3) == 3
    assert pickle.loads(pickle.dumps(p / 7)) == p / 7
    with pytest.raises(AttributeError, match="immutable"):
        p.ring = R  # type: ignore[misc]


def test_division_with_and_without_remainder() -> None:
    """x^3 - y^3 = (x - y) (x^2 + x y + y^2), and x = -y gives -2 y^3, not 0."""
    cubes = x**3 - y**3
    assert cubes.exact_quotient(x - y) == x**2 + x * y + y**2
    assert (x - y).divides(cubes)
    assert not (x + y).divides(cubes)
    assert (x + y).divides(R.zero)
    with pytest.raises(ArithmeticError, match="does not divide"):
        cubes.exact_quotient(x + y)


def test_factors_are_those_over_the_rationals() -> None:
    """x^4 + 4 y^4 = (x^2 + 2 x y + 2 y^2)(x^2 - 2 x y + 2 y^2) (Sophie Germain); x^2 - 2 y^2 has none."""
    assert {f for f, _ in (x**4 + 4 * y**4).factors()} == {
        x**2 + 2 * x * y + 2 * y**2,
        x**2 - 2 * x * y + 2 * y**2,
    }
    assert (x**2 - 2 * y**2).factors() == [(x**2 - 2 * y**2, 1)]
    assert dict((-6 * x**2 * (y - 1) ** 3).factors()) == {x: 2, y - 1: 3}
    assert R.constant(5).factors() == []


def test_a_long_polynomial_is_factored_by_a_variable_of_first_degree(monkeypatch: pytest.MonkeyPatch) -> None:
    """z a + b is irreducible where a, b have no common divisor: here both are powers of different planes."""
    x, y, z = Ring(("x", "y", "z")).gens
    irreducible = z * (x + y + 1) ** 9 + (x - y + 2) ** 10
    common = {x**2 + y**2 + 1: 1, x - 3: 2}
    product = irreducible * (x**2 + y**2 + 1) * (x - 3) ** 2
    asked: list[int] = []
    original = polynomial.first_degree_parts

    def noted(p: Polynomial, place: int) -> tuple[Polynomial, Polynomial]:
        asked.append(place)
        return original(p, place)

    monkeypatch.setattr(polynomial, "first_degree_parts", noted)
    assert dict((product * -6).factors()) == {irreducible.primitive(): 1, **common}
    assert dict(irreducible.factors()) == {irreducible.primitive(): 1}
    assert asked == [2, 2]


def test_squarefree_part_and_gcd() -> None:
    p = 4 * x**3 * (x + y) ** 2
    assert p.squarefree_part() == x**2 + x * y
    assert p.gcd(x * (x + y) ** 5) == x * (x + y) ** 2
    assert x.gcd(y) == 1


def test_primitive_has_coprime_integers_and_a_positive_head() -> None:
    """-2/3 x + 4/9 = -2/9 (3 x - 2)."""
    p = -2 * x / 3 + R.constant(Fraction(4, 9))
    assert p.primitive() == 3 * x - 2
    assert p.integer() == (3 * x - 2).integer()
    assert (x - 2).primitive() == x - 2
    assert R.zero.primitive().is_zero


def test_degrees_variables_and_coefficients() -> None:
    p = 3 * x**2 * y + x * y**4 - 5
    assert (p.total_degree, p.degrees, p.degree("y"), p.constant) == (5, (2, 4), 4, -5)
    assert p.coefficient("x", 1) == y**4
    assert p.coefficient("x", 0) == -5
    assert p.coefficient("x", 3).is_zero
    assert p.derivative("x") == 6 * x * y + y**4
    assert (R.zero.total_degree, R.zero.degrees) == (-1, (-1, -1))
    assert (x - x + y).variables == ("y",)


def test_substitution_is_of_all_variables_at_once() -> None:
    """Exchanging x and y one after the other would make both the same."""
    assert (x - y**2).substitute({"x": y, "y": x}) == y - x**2
    assert (x * y).substitute({"x": Fraction(1, 2)}) == y / 2


def test_values_in_each_arithmetic() -> None:
    """x^2/2 - y at (3, 1/3) is 9/2 - 1/3 = 25/6."""
    p = x**2 / 2 - y
    assert p.evaluate([Fraction(3), Fraction(1, 3)]) == Fraction(25, 6)
    assert p.evaluate([fmpq(3), fmpq(1, 3)]) == fmpq(25, 6)
    enclosed = p.evaluate([arb(3), arb(1) / 3])
    assert enclosed.contains(fmpq(25, 6))
    assert not enclosed.contains(fmpq(25, 6) + fmpq(1, 10**6))
    assert R.constant(7).evaluate([arb(1), arb(2)]) == 7


def test_reflection_changes_odd_terms_only() -> None:
    p = x**2 + x * y + y
    assert p.reflect(["x"]) == x**2 - x * y + y
    assert p.reflect(["x", "y"]) == x**2 + x * y - y
    assert p.reflect([]) == p
