"""Isolation of real roots against SymPy's own, and refinement against its root objects."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import sympy
from flint import fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from singsym.varieties.real.points.intervals import at_precision, exact_bounds
from singsym.varieties.real.points.roots import has_real_root, real_roots, refined_root

x = sympy.Symbol("x")


@given(st.lists(st.integers(-200, 200), min_size=2, max_size=9))
def test_intervals_hold_one_root_each(coefficients: list[int]) -> None:
    polynomial = fmpz_poly(coefficients)
    if polynomial.degree() < 1:
        return
    squarefree = polynomial // polynomial.gcd(polynomial.derivative())
    theirs = sympy.Poly([int(c) for c in reversed(squarefree.coeffs())], x)
    found = real_roots(squarefree)
    assert len(found) == theirs.count_roots()
    assert has_real_root(polynomial) is bool(found)
    assert all(theirs.count_roots(*map(sympy.Rational, interval)) == 1 for interval in found)
    assert all(high <= after for (_, high), (after, _) in pairwise(found))


def test_close_roots_are_told_apart_and_refined() -> None:
    """(10^9 x - 1)^2 - 2 and x - 1/10^9: three roots within 3/10^9."""
    big = 10**9
    polynomial = (fmpz_poly([-1, big]) ** 2 - 2) * fmpz_poly([-1, big])
    found = real_roots(polynomial)
    expected = [(1 - sympy.sqrt(2)) / big, sympy.Rational(1, big), (1 + sympy.sqrt(2)) / big]
    assert len(found) == 3
    for (low, high), root in zip(found, expected, strict=True):
        with at_precision(400):
            ends = exact_bounds(refined_root(polynomial, low, high, 200))
        assert sympy.Rational(ends[0]) <= root <= sympy.Rational(ends[1])
        assert ends[1] - ends[0] < Fraction(1, 2**190)
