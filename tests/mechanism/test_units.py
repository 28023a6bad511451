"""Units of length: what is a length in a mechanism, and the unit that grows with it."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

from singsym.mechanism import Exclusion, Limit, Mechanism, load, loads
from singsym.mechanism.units import own_unit, scaled

RATIONALS = (Fraction(1, 1000), Fraction(7, 3), Fraction(1000))


def slider(points: str, more: str = "") -> Mechanism:
    return loads(f"""
name = "slider"
space = "spatial"
inputs = ["P"]
output = {{ rate = "P" }}
{more}
[links]
ground = {{ points = {{ A = {points} }}, axes = {{ u = [0.6, 0.8, 0] }} }}
block = {{ points = {{ B = [0, 0, 0] }}, axes = {{ u = [0.6, 0.8, 0] }} }}
[joints.P]
type = "P"
links = ["ground", "block"]
at = ["A", "B"]
axis = "u"
[limits]
"length(P)" = [0, 6]
"A.x * length(P) + 2" = {{ max = 10 }}
""")


@pytest.mark.parametrize(
    ("point", "unit"),
    [
        ("[6, 9, 0]", Fraction(6)),  # gcd(6, 9, 6) = 3: 2, 3, 2, but 1, 3/2, 1 are shorter
        ("[6, 10, 0]", Fraction(6)),  # 1, 5/3, 1: shorter than 3, 5, 3
        ("[7, 11, 0]", Fraction(1)),  # no multiple is shorter
        ('["3/2", 0, 0]', Fraction(3, 2)),  # gcd(3/2, 6)
        ('["0.6", 0, 0]', Fraction(3, 5)),
        ('["2*sqrt(3)", 0, 0]', Fraction(2)),  # the coefficient of an irrational length counts
        ('["sqrt(12)", "4*sqrt(2)/2", 0]', Fraction(2)),
        ("[6000, 2002, 2006]", Fraction(2000)),  # gcd 2, median 2006, below 10 units
    ],
)
def test_lengths_are_short_numbers_of_units(point: str, unit: Fraction) -> None:
    """Lengths are the point's coordinates and the slide's upper limit 6; axes are none."""
    mechanism = slider(point)
    assert own_unit(mechanism) == unit
    for k in RATIONALS:
        assert own_unit(scaled(mechanism, k)) == k * unit


def test_a_parameter_without_a_value_is_a_number() -> None:
    mechanism = slider('["1000*a", "a/2", 0]', "parameters = { a = { above = 0 } }")
    assert own_unit(mechanism) == Fraction(2)  # 500, 1/4, 3: 6000, and 12000 of 1, 24000 of the gcd 1/2
    again = scaled(mechanism, Fraction(1, 5))
    a = sympy.Symbol("a")
    assert again.link("ground").points["A"] == (200 * a, a / 10, 0)
    assert again.parameters == mechanism.resolved.parameters


def test_limits_and_exclusions_are_scaled_by_their_degree() -> None:
    """length <= 6 is length <= 42; x l + 2 <= 10 is x l + 2 * 7^2 <= 10 * 7^2; angles and axes stay."""
    mechanism = slider("[6, 9, 0]")
    wide = scaled(mechanism, Fraction(7))
    x, length = sympy.Symbol("A.x"), sympy.Symbol("length(P)")
    assert wide.limits == (Limit(length, 0, 42), Limit(x * length + 98, None, 490))
    assert wide.link("ground").axes == mechanism.link("ground").axes
    assert scaled(wide, Fraction(1, 7)) == mechanism.resolved


def test_a_pitch_is_a_length() -> None:
    screw = loads("""
name = "screw"
space = "spatial"
inputs = ["H"]
output = { rate = "H" }
[links]
ground = { points = { A = [0, 0, 0] }, axes = { z = [0, 0, 1] } }
nut = { points = { B = [0, 0, 0] }, axes = { z = [0, 0, 1] } }
[joints.H]
type = "H"
links = ["ground", "nut"]
at = ["A", "B"]
axis = "z"
pitch = "3/4"
""")
    assert own_unit(screw) == Fraction(3, 4)
    assert scaled(screw, Fraction(4)).joint("H").pitch == 3


def test_coinciding_points_need_no_unit() -> None:
    (first, *_) = scaled(load("3rpr"), Fraction(2)).exclusions
    assert first == Exclusion("coincide", ("A1", "B1"), words="leg 1 of length zero")


def test_without_lengths_the_unit_is_one() -> None:
    assert own_unit(load("spherical-fourbar")) == 1
