"""Ranges hold all values: compared with values at random points."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from singsym.polynomials import Ring, as_fmpq
from singsym.polynomials.ranges import fraction, meet, polynomial_range, root_above, rounded_out

R = Ring(("x", "y"))
x, y = R.gens
NUMBERS = st.fractions(min_value=-4, max_value=4, max_denominator=9)
COEFFICIENTS = st.lists(st.integers(-5, 5), min_size=6, max_size=6)


@given(COEFFICIENTS, NUMBERS, NUMBERS, st.fractions(0, 1), st.fractions(0, 1))
def test_a_range_holds_all_values(c: list[int], a: Fraction, b: Fraction, s: Fraction, t: Fraction) -> None:
    p = R.constant(c[0]) + c[1] * x + c[2] * y + c[3] * x * y + c[4] * x**2 + c[5] * x * y**3
    low, high = min(a, b), max(a, b)
    point = {"x": low + s * (high - low), "y": low + t * (high - low)}
    lowest, highest = polynomial_range(p, {"x": (low, high), "y": (low, high)})
    assert lowest <= fraction(as_fmpq(p.evaluate([point["x"], point["y"]]))) <= highest


@given(st.fractions(min_value=0, max_value=10**6))
def test_a_root_from_above(square: Fraction) -> None:
    root = root_above(square)
    assert root**2 >= square
    assert root == 0 or (root - Fraction(1, 10**6)) ** 2 <= square or root < Fraction(1, 10**6)


@given(NUMBERS, NUMBERS)
def test_rounding_outwards_and_meeting(a: Fraction, b: Fraction) -> None:
    low, high = min(a, b), max(a, b)
    wider = rounded_out((low, high))
    assert wider[0] <= low <= high <= wider[1]
    assert meet((low, high), wider) == (low, high)
