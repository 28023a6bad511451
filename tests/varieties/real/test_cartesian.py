"""Vectors instead of unit vectors and lengths: the new system has the images of the old one's points."""

from __future__ import annotations

from math import cos, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from singsym.polynomials import Ring
from singsym.varieties.real.cartesian import Cartesian
from singsym.varieties.real.emptiness import is_empty_over_reals
from singsym.varieties.real.witness import RealSystem

R = Ring(("c", "s", "q", "w", "z"))
c, s, q, w, z = R.gens
LEG = (c**2 + s**2 - 1, q**2 + w**2 - 1)
ANGLES = st.floats(-3, 3)


@given(ANGLES, ANGLES)
def test_points_of_a_leg_go_to_points_of_a_sphere(turn: float, lift: float) -> None:
    """The end of a leg of length 1, turned and lifted: (q c, q s, w); z stands in a condition on it."""
    system = RealSystem(R, (*LEG, q * c + 2 * q * s - 3 * z), exclusions=((q,),))
    chart = Cartesian.of(system)
    point = {"c": cos(turn) * cos(lift), "s": sin(turn) * cos(lift), "q": 0.0, "w": sin(lift)}
    point["z"] = (point["c"] + 2 * point["s"]) / 3
    image = [point[name] for name in R.names]
    assert "q" not in {n for p in chart.system.equations for n in p.variables}
    assert all(abs(p.evaluate(image)) < 1e-9 for p in chart.system.equations)


def test_a_length_that_is_needed_stays() -> None:
    """z - q changes with the sign of the length, so both signs are different conditions."""
    chart = Cartesian.of(RealSystem(R, (*LEG, q * c + q * s - z - q), exclusions=((q,),)))
    assert any("q" in p.variables for p in chart.system.equations)


def test_an_exclusion_that_knows_the_sign_is_not_the_same_for_both() -> None:
    equations = (*LEG, q * c + 2 * q * s - 3 * z)
    assert Cartesian.of(RealSystem(R, equations, exclusions=((q,), (z,)))).faithful
    assert not Cartesian.of(RealSystem(R, equations, exclusions=((q,), (z - q, w)))).faithful


@pytest.mark.parametrize(("height", "empty"), [(2, True), (1, False)])
def test_the_trimmed_system_has_a_point_if_the_given_one_has(height: int, empty: bool) -> None:
    """w = height / 2 on the unit sphere without its poles: no point for height 2, a circle for 1."""
    chart = Cartesian.of(RealSystem(R, (*LEG, 2 * w - height), exclusions=((q,),)))
    assert chart.is_empty() == empty
    assert is_empty_over_reals(chart.trimmed).is_yes == empty


def test_an_exclusion_of_several_polynomials_is_kept_where_only_it_leaves_out_points() -> None:
    """x = 0 and y = z are a line, all of which is excluded, though not by one polynomial."""
    x, y, z = Ring(("x", "y", "z")).gens
    line = (x, y - z)
    group = tuple(f * (z**4 + k * z**2 + 1) for f in line for k in (1, 2, 3))
    system = RealSystem(x.ring, (x + x * z**2, y - z + x * y), exclusions=((z**2 + 5,), group))
    trimmed = Cartesian.of(system).trimmed
    assert trimmed.exclusions == (group,)
    assert is_empty_over_reals(trimmed, tries=0).is_yes
