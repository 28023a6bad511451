"""Conditions in the names of lengths: published formulas, and the identity with the polynomial in numbers."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

from singsym.conditions.conditions import conditions
from singsym.conditions.named_lengths import named_lengths
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import define, load

ARMS = ["puma560", "orthogonal-3r", "wrist-offset", "7r-locked", "ur5"]


def written(name: str) -> list[str]:
    """The factors of (5), as they are printed."""
    mechanism = load(name)
    found = conditions(velocity_equation(mechanism))
    lengths = named_lengths(mechanism, found.equation)
    return [lengths.factor(f).text() for f in found["5"].factors]


def test_the_puma_in_the_letters_of_its_table() -> None:
    """The library's source: det J = -a2 s5 (a3 s3 + d4 c3) (a2 c2 + a3 c23 - d4 s23)."""
    wrist, elbow, shoulder = written("puma560")
    assert (wrist, elbow) == ("s5", "a3*s3 + d4*c3")
    a2, a3, d4, c2, s2, c3, s3 = sympy.symbols("a2 a3 d4 c2 s2 c3 s3")
    c23, s23 = c2 * c3 - s2 * s3, s2 * c3 + c2 * s3
    name, _, polynomial = shoulder.partition(" = ")
    assert name == "O0O4.r2"
    assert sympy.expand(sympy.sympify(polynomial) - (a2 * c2 + a3 * c23 - d4 * s23)) == 0


def test_a_three_revolute_arm_in_the_letters_of_its_source() -> None:
    """The library's source: the factor s3 d2 + c2 (s3 d3 - c3 r2); d3 + d4 c3 = 2 + 3/2 c3 has no zero."""
    (factor,) = written("orthogonal-3r")
    d2, d3, r2, c2, c3, s3 = sympy.symbols("d2 d3 r2 c2 c3 s3")
    assert sympy.expand(sympy.sympify(factor) - (s3 * d2 + c2 * (s3 * d3 - c3 * r2))) == 0


@pytest.mark.parametrize("name", [*ARMS, "fourbar", "five-bar", "crank-slotted-lever", "zlatanov-hybrid-3-2"])
def test_with_the_values_put_in_it_is_a_multiple_of_the_polynomial_in_numbers(name: str) -> None:
    """By SymPy, from text: what is printed in names, and the values beside it, make the same equation."""
    mechanism = load(name)
    found = conditions(velocity_equation(mechanism))
    lengths = named_lengths(mechanism, found.equation)
    factors = [f for label in ("4", "5") for f in found[label].all_factors]
    assert factors
    for factor in factors:
        named = lengths.of(factor.polynomial)
        assert named is not None
        values = {sympy.Symbol(n): sympy.Rational(str(v)) for n, v in lengths.values.items()}
        own = factor.polynomial.to_sympy()
        ratio = sympy.cancel(named.to_sympy().subs(values) / own)
        assert ratio.is_Rational
        assert ratio != 0


def arm(**values: str) -> list[str]:
    """Factors of (5) of a planar arm of three links whose tool is its third joint's end, output the point."""
    mechanism = define(
        name="arm",
        inputs=["A", "B"],
        output={"velocity": "C"},
        parameters={name: {"value": value, "above": 0} for name, value in values.items()},
        links={"ground": {"points": {"A": [0, 0]}}, "AB": "a", "BC": "b"},
        joints={"A": "R", "B": "R"},
    )
    found = conditions(velocity_equation(mechanism))
    lengths = named_lengths(mechanism, found.equation)
    assert set(lengths.values) <= {"a", "b"}
    return [lengths.factor(f).text() for f in found["5"].factors]


def test_lengths_that_are_no_rationals_keep_their_values() -> None:
    assert arm(a="2", b="3") == ["s_B"]
    assert len(arm(a="sqrt(2)", b="3")) == 1


def test_without_named_lengths_nothing_is_renamed() -> None:
    mechanism = load("zlatanov-2dof")
    found = conditions(velocity_equation(mechanism))
    lengths = named_lengths(mechanism, found.equation)
    assert lengths.values == {}
    assert all(lengths.factor(f) is f for f in found["5"].factors)


def test_values_are_those_of_the_file() -> None:
    mechanism = load("puma560")
    found = conditions(velocity_equation(mechanism))
    occurring = named_lengths(mechanism, found.equation).occurring_in(
        f.polynomial for f in found["5"].factors
    )
    assert occurring == {"a2": Fraction("0.4318"), "a3": Fraction("0.0203"), "d4": Fraction("0.4318")}
