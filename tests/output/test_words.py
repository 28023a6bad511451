"""Conditions in words against the paper's own statements and textbook geometry."""

from __future__ import annotations

import pytest

from singsym.conditions.conditions import conditions
from singsym.kinematics.reduction import reduce
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load


def words(name: str, label: str) -> list[str]:
    equation = velocity_equation(load(name))
    return sorted(factor.words for factor in conditions(equation, reduce(equation))[label].factors)


def test_the_hybrid_chain_in_the_papers_words() -> None:
    """Section 5.3, steps 2, 4, 5: points on first axes, legs extended, C0 in ABC, A in the plane of B."""
    on_axis = [f"{leg} on the axis up through {leg}0" for leg in "ABC"]
    extended = [f"{leg}, {leg}0, K{leg} collinear" for leg in "ABC"]
    assert words("zlatanov-hybrid", "5") == sorted([*on_axis, *extended])
    others = ["A, B, C, C0 coplanar", "AB perpendicular to axis hB"]
    assert words("zlatanov-hybrid", "4") == sorted([*on_axis[1:], *others])


@pytest.mark.parametrize(
    ("name", "label", "expected"),
    [
        ("spherical-fourbar", "5", "axes A, B and C parallel to a plane"),
        ("2r", "5", "A, B, C collinear"),
        ("slider-crank", "5", "AB parallel to slide P"),
        ("ur5", "5", "elbow: arm stretched or folded, O4 on J4 and J5 in the plane of the axes J2 and J3"),
        ("spherical-3rrr", "4", "planes of the axes B1, C1, B2, C2 and B3, C3 with a line in common"),
    ],
)
def test_textbook_statements(name: str, label: str, expected: str) -> None:
    assert expected in words(name, label)
