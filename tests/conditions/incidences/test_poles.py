"""Three lines of force through a point, and dyads on two moving links, in six-bar linkages."""

import pytest

from singsym.conditions.conditions import conditions
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load


def said(name: str, label: str) -> list[str]:
    """What the factors of a determinant say."""
    (found,) = (c for c in conditions(velocity_equation(load(name))) if c.label == label)
    return [factor.words for factor in found.factors]


# The pole of a coupler BC between AB and CD is where these lines meet (A, B and C, D are on lines with it).
# A point E of it moves across the line to the pole; on a rod EF with F at rest, across EF: E is on the line
# from F to the pole.  So the output rests where AB, CD and EF meet.
@pytest.mark.parametrize("name", ["stephenson-six-bar", "atkinson-engine", "drawing-press"])
def test_the_output_of_a_dyad_on_a_coupler_rests_where_its_rod_points_at_the_pole(name: str) -> None:
    assert "lines AB, CD and EF through a point or parallel" in said(name, "5")


def test_a_dyad_on_two_moving_links_is_singular_in_line() -> None:
    # E is on the coupler, F on the rocker: G moves with both at rest only where it is on the line EF
    assert said("watt-one-six-bar", "4") == ["B, C, D collinear", "E, F, G collinear"]
