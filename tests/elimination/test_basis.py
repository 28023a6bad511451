"""Groebner bases of small lists, by hand; what is taken apart before an engine sees it."""

from __future__ import annotations

from singsym.elimination.basis import canonical, groebner_basis
from singsym.polynomials import Ring

R = Ring(("x", "y", "z", "w"), "lex")
x, y, z, w = R.gens


def test_linear_equations_need_no_engine() -> None:
    """x + y = 1 and x = y: x = y = 1/2."""
    known = groebner_basis(R, [x + y - 1, x - y])
    basis = known.value
    assert set(basis.polynomials) == {2 * x - 1, 2 * y - 1}
    assert (basis.engine, known.certainty) == ("linear algebra", "proven")


def test_a_line_and_a_circle() -> None:
    """In the order x > y: x - y, and y^2 + y^2 - 1; the rank of the line does not matter."""
    basis = groebner_basis(R, [x**2 + y**2 - 1, 3 * y - 3 * x]).value
    assert basis.polynomials == (2 * y**2 - 1, x - y)
    assert basis.leading_monomials() == ((0, 2, 0, 0), (1, 0, 0, 0))
    assert not basis.is_unit


def test_normal_forms_say_what_is_in_the_ideal() -> None:
    """x^2 = y^2 = 1/2, so 2 x y - 1 is in it; x + y = 2 y is not."""
    basis = groebner_basis(R, [x**2 + y**2 - 1, x - y]).value
    assert basis.reduce(2 * x * y - 1).is_zero
    assert basis.reduce(x + y) == y
    assert basis.reduce(R.zero).is_zero


def test_groups_without_a_common_variable() -> None:
    """Each group has its own basis: x^2 = y and x y = 1 give x = y^2, y^3 = 1; the other is z^2 = w."""
    basis = groebner_basis(R, [x**2 - y, x * y - 1, z**2 - w]).value
    assert set(basis.polynomials) == {x - y**2, y**3 - 1, z**2 - w}


def test_no_zeros_at_all() -> None:
    """x = 0 = 1 by linear algebra; x y = 1 with x y = 2 by their difference; x^2 = -1 has complex zeros."""
    assert groebner_basis(R, [x, x - 1]).value.is_unit
    assert groebner_basis(R, [x * y - 1, x * y - 2]).value.is_unit
    assert not groebner_basis(R, [x**2 + 1]).value.is_unit
    assert groebner_basis(R, []).value.polynomials == ()


def test_lists_that_say_the_same() -> None:
    assert canonical(R, [2 * x, R.zero, -x, y]) == (x, y)
    assert canonical(R, [x, R.constant(3)]) == (R.one,)
