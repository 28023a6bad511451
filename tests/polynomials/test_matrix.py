"""Submatrices, transposes and values of matrices of polynomials."""

from __future__ import annotations

from fractions import Fraction

from singsym.polynomials import PolynomialMatrix, Ring

R = Ring(("x", "y"))
x, y = R.gens
M = PolynomialMatrix.of(R, [[x, 1, y], [0, x * y, 2]])


def test_submatrices_come_in_the_order_asked_for() -> None:
    assert M.select(rows=[1], columns=[2, 0]).rows == ((R.constant(2), R.zero),)
    assert M.select(columns=[2, 0]).rows == ((y, x), (R.constant(2), R.zero))
    assert M.select(rows=[1, 0, 1]).shape == (3, 3)


def test_a_matrix_without_rows_or_columns_keeps_its_shape() -> None:
    assert M.select(rows=[]).shape == (0, 3)
    assert M.select(columns=[]).shape == (2, 0)
    assert M.select(columns=[]).T.shape == (0, 2)
    assert M.select(rows=[]).to_sympy().shape == (0, 3)


def test_transpose() -> None:
    assert M.T.rows == ((x, R.zero), (R.one, x * y), (y, R.constant(2)))
    assert M.T.T == M
    assert M.T[2, 0] == M[0, 2]


def test_values_and_images() -> None:
    assert M.evaluate([Fraction(2), Fraction(1, 2)]) == [[2, 1, Fraction(1, 2)], [0, 1, 2]]
    S = Ring(("y",))
    at_zero = M.map(lambda p: S.convert(p.substitute({"x": 0})), S)
    assert at_zero.ring == S
    assert at_zero.rows == ((S.zero, S.one, S.gen("y")), (S.zero, S.zero, S.constant(2)))


def test_the_same_matrix_in_sympy() -> None:
    """The first two columns have the determinant x * x y - 1 * 0."""
    determinant = M.select(columns=[0, 1]).to_sympy().det()
    assert R.from_sympy(determinant) == x**2 * y
