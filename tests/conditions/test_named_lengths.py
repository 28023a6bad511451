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
    assert (wrist, elbow) == ("±|z3 x z5| = s5", "det[z1 O1O2 O1O4] = a2*(a3*s3 + d4*c3)")
    a2, a3, d4, c2, s2, c3, s3 = sympy.symbols("a2 a3 d4 c2 s2 c3 s3")
    c23, s23 = c2 * c3 - s2 * s3, s2 * c3 + c2 * s3
    name, _, polynomial = shoulder.partition(" = ")
    assert name == "det[z0 z1 O0O4]"
    assert sympy.expand(sympy.sympify(polynomial) - (a2 * c2 + a3 * c23 - d4 * s23)) == 0


def test_a_three_revolute_arm_in_the_letters_of_its_source() -> None:
    """Its source: d4 (d3 + d4 c3) (s3 d2 + c2 (s3 d3 - c3 r2)); d3 + d4 c3 = 2 + 3/2 c3 has no zero."""
    (factor,) = written("orthogonal-3r")
    d2, d3, d4, r2, c2, c3, s3 = sympy.symbols("d2 d3 d4 r2 c2 c3 s3")
    name, _, polynomial = factor.partition(" = ")
    assert name == "det[v_J1 v_J2 v_J3]"
    expected = d4 * (d3 + d4 * c3) * (s3 * d2 + c2 * (s3 * d3 - c3 * r2))
    assert sympy.expand(sympy.sympify(polynomial) - expected) == 0


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


@pytest.mark.parametrize("name", [*ARMS, "zlatanov-hybrid-3-2", "2r"])
def test_a_quantity_in_names_is_that_in_numbers(name: str) -> None:
    """By SymPy: with the values put in, the right sides are equal; of lengths, with ±, up to the sign."""
    mechanism = load(name)
    found = conditions(velocity_equation(mechanism))
    lengths = named_lengths(mechanism, found.equation)
    values = {sympy.Symbol(n): sympy.Rational(str(v)) for n, v in lengths.values.items()}
    compared = 0
    for factor in (f for label in ("4", "5") for f in found[label].all_factors):
        named = lengths.factor(factor)
        if factor.name is None or named.name is None:
            continue
        one, other = (
            f.name.scale.to_sympy() * f.polynomial.to_sympy() * sympy.sqrt(f.name.radicand)
            for f in (factor, named)
            if f.name
        )
        ratio = sympy.cancel(other.subs(values) / one)
        assert abs(ratio) == 1 if factor.name.quantity.text.startswith("±") else ratio == 1
        compared += 1
    assert compared > 0


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
    assert arm(a="2", b="3") == ["det[S_A S_B S_C] = a*b*s_B"]
    assert len(arm(a="sqrt(2)", b="3")) == 1


def test_without_named_lengths_nothing_is_renamed() -> None:
    mechanism = load("pentagon")
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
