"""Limits and exclusions of a mechanism as polynomials, by hand."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
import sympy

from singsym.kinematics.constraints import constrained
from singsym.kinematics.formulations import planar
from singsym.kinematics.placement import ConfigurationSpace
from singsym.mechanism import MechanismError, load
from singsym.mechanism.model import Exclusion, Limit, Mechanism

FOUR = load("fourbar").resolved
LEGS = replace(load("3rpr").resolved, limits=())
HALF = Fraction(1, 2)


def limited(mechanism: Mechanism, *limits: Limit) -> ConfigurationSpace:
    given = replace(mechanism, limits=limits)
    return constrained(given, planar.place(given)).space


def bound(name: str, low: object = None, high: object = None, factor: int = 1) -> Limit:
    exact = [None if b is None else sympy.sympify(b) for b in (low, high)]
    return Limit(factor * sympy.Symbol(name), *exact)


def test_a_coordinate_between_two_numbers() -> None:
    """-1/2 <= B.x <= 3: B.x + 1/2 >= 0 and 3 - B.x >= 0; for 2 B.y <= 1 one side only."""
    space = limited(FOUR, bound("B.x", -HALF, 3), bound("B.y", None, 1, factor=2))
    x, y = space.ring.gen("Bx"), space.ring.gen("By")
    assert space.nonnegative == (x + HALF, 3 - x, 1 - 2 * y)


def test_a_cosine_over_its_positive_scale() -> None:
    """The follower's x axis is from C to D = (4, 0), 3 long: cos(D) = (4 - C.x)/3 = (12 - 3 C.x)/9 >= 1/2."""
    space = limited(FOUR, bound("cos(D)", HALF))
    cosine = 12 - 3 * space.ring.gen("Cx")
    assert space.nonnegative == (cosine - 9 * HALF,)
    squared = limited(FOUR, Limit(sympy.Symbol("cos(D)") ** 2, sympy.Rational(1, 4)))
    assert squared.nonnegative == (cosine**2 - 81 * HALF**2,)


def test_a_length_of_which_only_the_square_is_known() -> None:
    """1/2 <= |B1 - A1| <= 3 by squares; a lower bound of 0 or less says nothing of a positive length."""
    space = limited(LEGS, bound("length(P1)", HALF, 3))
    square = sum(((b - a) ** 2 for a, b in zip(space.points["A1"], space.points["B1"], strict=True)))
    assert set(space.nonnegative) == {square - HALF**2, 9 - square}
    assert limited(LEGS, bound("length(P1)", -2)).nonnegative == ()


def test_exclusions_of_points_and_of_expressions() -> None:
    """B = D where both coordinates agree; what is the same anyway is left out of the group."""
    axis = Exclusion("zero", expression=sympy.Symbol("C.y") * 3)
    given = replace(FOUR, exclusions=(Exclusion("coincide", ("B", "D")), axis))
    space = constrained(given, planar.place(given)).space
    b, d = space.points["B"], space.points["D"]
    assert space.exclusions == ((b[0] - d[0], b[1] - d[1]), (3 * space.points["C"][1],))


@pytest.mark.parametrize("name", ["Q.x", "B.z", "cos(X)", "length(A)", "nothing"])
def test_what_a_formulation_does_not_know_is_refused(name: str) -> None:
    """No point Q, no third coordinate in the plane, no joint X, no length of a pin, no such parameter."""
    with pytest.raises(MechanismError, match="found"):
        limited(FOUR, Limit(sympy.Symbol(name), sympy.Integer(0)))
