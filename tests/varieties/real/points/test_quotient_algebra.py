"""Quotient algebras against what is known of them: Bezout's number, the equations, multiplicities."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from flint import fmpq_mat

from singsym.elimination.engines.base import NotZeroDimensional
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.points.quotient_algebra import (
    Algebra,
    commuting,
    quotient_algebra,
    reduced,
    standard_monomials,
)

R = Ring(("x", "y"))
x, y = R.gens


def algebra(*equations: Polynomial) -> Algebra:
    return quotient_algebra(R, Ideal(R, equations).groebner_basis().value)


def value(polynomial: Polynomial, matrices: Sequence[fmpq_mat]) -> fmpq_mat:
    """The polynomial in commuting matrices."""
    size = matrices[0].nrows()
    total = fmpq_mat(size, size)
    for exponents, c in polynomial.terms():
        power = fmpq_mat(size, size, [int(i == j) for i in range(size) for j in range(size)]) * c
        for matrix, e in zip(matrices, exponents, strict=True):
            for _ in range(int(e)):
                power = power * matrix
        total += power
    return total


def test_the_matrices_satisfy_the_equations_and_are_as_many_as_bezout_says() -> None:
    """A conic and a cubic without common points at infinity meet in 6."""
    equations = (x**2 + y**2 - 5, y**3 - x * y + 1)
    found = algebra(*equations)
    assert found.dimension == 6
    assert commuting(found)
    for p in equations:
        assert value(p, found.matrices) == fmpq_mat(6, 6)


def test_multiplicities_are_dropped_in_the_reduced_algebra() -> None:
    """A line that touches a circle meets it in one point, twice; x^3 = y = 0 is one point, three times."""
    for equations, multiplicity in (((x**2 + y**2 - 1, y - 1), 2), ((x**3, y), 3)):
        found = algebra(*equations)
        assert (found.dimension, reduced(found).dimension) == (multiplicity, 1)


def test_infinitely_many_points_are_refused() -> None:
    with pytest.raises(NotZeroDimensional):
        standard_monomials([(1, 1)], 2)
