"""Brackets of platforms: det L_I is the bracket times the legs' scales, by numpy at random configurations.

Source: independent of the algebra: L_I as numbers, lines from the places of the named points.  What is
expected to be named: Merlet (1989) for six lines, Ben-Horin and Shoham (2006) for four planes, and the
library's comments.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from singsym.conditions.conditions import Conditions, conditions
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.polynomials import PolynomialMatrix
from tests.conditions.incidences.gough import SIX_THREE, THREE_THREE, gough
from tests.conditions.test_names_numerically import Pose, check

OWN = {"six-three": SIX_THREE, "three-three": THREE_THREE}
SAID = {
    "3rrr": ("det[B1C1 B2C2 B3C3]", "lines B1C1, B2C2 and B3C3 through a point or parallel"),
    "3rpr": ("det[A1B1 A2B2 A3B3]", "lines A1B1, A2B2 and A3B3 through a point or parallel"),
    "spherical-3rrr": (
        "det[B1xC1 B2xC2 B3xC3]",
        "planes of the axes B1, C1, B2, C2 and B3, C3 with a line in common",
    ),
    "linear-delta": ("det[B1C1 B2C2 B3C3]", "lines B1C1, B2C2 and B3C3 parallel to a plane"),
    "stewart-gough-planar": (
        "det[A1B1 A2B2 A3B3 A4B4 A5B5 A6B6]",
        "lines A1B1, A2B2, A3B3, A4B4, A5B5 and A6B6 in a linear complex",
    ),
    "six-three": (
        "det[A1A2B1 A3A4B3 A5A6B5 B1B3B5]",
        "planes A1A2B1, A3A4B3, A5A6B5 and B1B3B5 through a point or parallel to a line",
    ),
    "three-three": (
        "det[A1A2B1 A2A4B3 A4A1B5 B1B3B5]",
        "planes A1A2B1, A2A4B3, A4A1B5 and B1B3B5 through a point or parallel to a line",
    ),
}


@cache
def found(name: str) -> Conditions:
    mechanism = gough(*OWN[name]) if name in OWN else load(name)
    return conditions(velocity_equation(mechanism))


def number(matrix: PolynomialMatrix, point: list[float]) -> float:
    return float(np.linalg.det(np.array(matrix.evaluate(point), dtype=float)))


@pytest.mark.parametrize("name", SAID)
def test_what_the_only_factor_is_called(name: str) -> None:
    (factor,) = found(name)["4"].factors
    assert factor.name is not None
    assert (factor.name.quantity.text, factor.incidence) == SAID[name]


@pytest.mark.parametrize("name", SAID)
def test_the_printed_equality(name: str) -> None:
    (factor,) = found(name)["4"].factors
    equation = found(name).equation
    for point in sample_configurations(equation.space, 3, seed=5):
        check(factor, list(map(float, point)), equation)


@pytest.mark.parametrize("name", [*SAID, "stewart-gough"])
def test_the_determinant_is_the_bracket_times_the_scales(name: str) -> None:
    """The bracket from the places of points; the sign is that of the order of rows, the same throughout."""
    equation, platform = found(name).equation, found(name).incidences.platform
    assert platform is not None
    ratios = []
    for point in sample_configurations(equation.space, 3, seed=7):
        place = list(map(float, point))
        bracket = Pose.of(equation, place).quantity(platform.bracket.text)
        scales = [float(own.scale.evaluate(place)) for own in platform.supports]
        ratios.append(number(equation.L_I, place) / (bracket * np.prod(scales)))
    assert ratios == pytest.approx([ratios[0]] * 3, rel=1e-7)
    assert abs(ratios[0]) == pytest.approx(1.0, rel=1e-7)


def test_a_bracket_with_too_many_terms_is_the_condition() -> None:
    """The general platform: (4) is left as a rank, and says that it holds for six lines in a complex."""
    condition = found("stewart-gough")["4"]
    assert condition.alternatives is None
    assert condition.bracket is not None
    assert condition.bracket.text == "det[A1B1 A2B2 A3B3 A4B4 A5B5 A6B6]"


def test_four_planes_and_six_lines_are_the_same_number() -> None:
    """White's identity for six lines, two and two through a point, by numpy at configurations."""
    equation, platform = found("six-three").equation, found("six-three").incidences.platform
    assert platform is not None
    for point in sample_configurations(equation.space, 3, seed=3):
        pose = Pose.of(equation, list(map(float, point)))
        lines, planes = (pose.quantity(text) for text in (platform.bracket.text, SAID["six-three"][0]))
        assert abs(lines) == pytest.approx(abs(planes), rel=1e-7)


def test_rods_of_a_delta_by_hand() -> None:
    """The rods are C_i - B_i with the library's places: (x - 2, y, z - p1), (x + 6/5, y - 8/5, z - p2),
    (x + 6/5, y + 8/5, z - p3); the factor is their determinant up to a number."""
    (factor,) = found("linear-delta")["4"].factors
    x, y, z, *p = factor.polynomial.ring.gens
    a, b, c = (
        (x - 2, y, z - p[0]),
        (5 * x + 6, 5 * y - 8, 5 * (z - p[1])),
        (5 * x + 6, 5 * y + 8, 5 * (z - p[2])),
    )
    cross = [b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2] for i in range(3)]
    assert (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]).primitive() == factor.polynomial


@pytest.mark.parametrize("name", ["fourbar", "five-bar", "2r", "zlatanov-2dof", "bennett"])
def test_other_mechanisms_are_no_platform_on_lines(name: str) -> None:
    assert found(name).incidences.platform is None
