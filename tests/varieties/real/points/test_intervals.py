"""Interval proofs: what they prove is true, and they prove nothing where nothing is to be proven."""

from fractions import Fraction

import pytest
from flint import arb

from singsym.polynomials import Ring
from singsym.varieties.real.points.boxed_point import boxed_point
from singsym.varieties.real.points.intervals import ball, evaluate, krawczyk, rank_at_least, regular

R = Ring(("x", "y"))
x, y = R.gens


def test_powers_of_a_ball_around_zero():
    assert evaluate(x**2 + 1, (arb(0, 1), arb(0))).is_finite()


def test_ranks_from_below():
    one, zero = arb(1), arb(0, 1e-10)
    assert rank_at_least([[one, zero, zero], [zero, one, zero]], 2)
    assert not rank_at_least([[one, one], [one, one]], 2)
    assert not rank_at_least([[one, one], [one, one + zero]], 2)
    assert rank_at_least([], 0)
    assert not regular([[zero]])


def test_krawczyk_finds_one_zero_and_no_double_one():
    near = (ball(Fraction(14142, 10000)), ball(0))
    found = krawczyk([x**2 - 2], ["x"], near, Fraction(1, 100))
    assert found is not None
    assert found[0].contains(arb(2).sqrt())
    assert krawczyk([x**2], ["x"], (ball(0), ball(0)), Fraction(1, 100)) is None
    assert krawczyk([x**2 + 1], ["x"], (ball(0), ball(0)), Fraction(1, 2)) is None
    with pytest.raises(ValueError, match="square"):
        krawczyk([x], ["x", "y"], near, Fraction(1))


def test_a_boxed_point_is_refined_and_tells_signs():
    p = boxed_point(R, [x**2 + y**2 - 1], {"x": Fraction(1, 3)}, (1 / 3, 0.94))
    assert p is not None
    assert p.refine(200).radius < 1e-50
    assert p.sign(y) == 1
    assert p.sign(x**2 + y**2 - 1) == 0
    assert p.decimals(8)["y"] == "0.94280904"
    assert boxed_point(R, [x**2 + y**2 - 1], {"x": Fraction(1)}, (1.0, 0.001)) is None
