"""Combinations of quadratic equations that are positive everywhere."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import pytest

from singsym.effort.verdict import Answer
from singsym.polynomials import Ring
from singsym.varieties.real.proofs.emptiness import is_empty_over_reals
from singsym.varieties.real.proofs.positive_combinations import (
    is_positive_combination_seen,
    positive_combination,
)
from singsym.varieties.real.system import RealSystem

RING = Ring(("x", "y", "c", "s"))
X, Y, C, S = RING.gens


@pytest.mark.parametrize(("distance", "is_apart"), [(7, True), (5, False)])
def test_a_point_out_of_reach(distance: int, is_apart: bool) -> None:
    """A crank of 2 and a rod of 4 reach a pivot that is not further away than 6."""
    rod = (X - 2 * C) ** 2 + (Y - 2 * S) ** 2 - 16
    assert is_positive_combination_seen([C**2 + S**2 - 1, rod, X - distance, Y]) is is_apart


def test_a_rod_that_is_too_short_for_its_slides() -> None:
    """(x - 3 s)^2 + (3 c + 9/2)^2 + 27/4 is positive, which is hidden where 9 (s^2 + c^2) = 9 is put in."""
    equation = X**2 - 6 * X * S + 27 * C + 27 + 9 * (S**2 + C**2)
    given = (equation - 9 * (S**2 + C**2 - 1), C**2 + S**2 - 1)
    found = positive_combination(given)
    assert found is not None
    assert is_empty_over_reals(RealSystem(RING, given)).answer is Answer.YES


def test_what_has_a_point_has_no_positive_combination() -> None:
    """Random quadratic equations through a random rational point, and the same with a circle through it."""
    random = Random(7)
    for _ in range(60):
        point = [Fraction(random.randint(-5, 5), random.randint(1, 3)) for _ in range(2)] + [
            Fraction(3, 5),
            Fraction(4, 5),
        ]
        equations = [C**2 + S**2 - 1]
        for _ in range(random.randint(1, 4)):
            f = sum((random.randint(-3, 3) * p * q for p in RING.gens for q in RING.gens), start=RING.zero)
            f += sum((random.randint(-3, 3) * p for p in RING.gens), start=RING.zero)
            value = f.evaluate(point)
            equations.append(f * value.denominator - value.numerator)
        assert not is_positive_combination_seen(equations)


def test_coefficients_beyond_doubles_and_next_to_nothing() -> None:
    """10^400 (x^2 + 1) has no zero; whether x^2 + 10^-400 + y and y have one, floats do not tell."""
    large = 10**400
    assert is_positive_combination_seen([large * (X**2 + 1), Y])
    assert positive_combination([large * (X**2 + Y) + 1, Y]) in (None, large * X**2 + 1)
    assert not is_positive_combination_seen([X**2 + Y, large * Y])
