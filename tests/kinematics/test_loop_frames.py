"""Loops in frames of their links: a parallelogram on an arm asks for three conditions, not for six."""

import pytest

from singsym import classify
from singsym.classes.taxonomy.types import SingularityType
from singsym.kinematics import sample_configurations
from singsym.kinematics.loop_frames import in_link_frames
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import loads
from tests.kinematics.test_velocity import ranks

CARRIED = """
name = "carried-parallelogram"
space = "spatial"
inputs = ["A", "U"]
output = { velocity = "M", link = "bottom", components = ["y", "z"] }

[links]
ground = { points = { A = [0, 0, 0] }, axes = { t = [0, "3/5", "4/5"] } }
rodU = { points = { U = [0, 0, 0], W = [0, 3, 0] }, axes = { n = [1, 0, 0] } }
rodV = { points = { V = [0, 0, 0], X = [0, 3, 0] }, axes = { n = [1, 0, 0] } }
bottom = { points = { W = [0, 0, "1/2"], X = [0, 0, "-1/2"], M = [0, 0, 0] }, axes = { n = [1, 0, 0] } }

[links.top]
points = { A = [0, 0, 0], U = [2, 0, "1/2"], V = [2, 0, "-1/2"] }
axes = { t = [0, 1, 0], n = [1, 0, 0] }

[joints]
A = { axis = "t" }
U = { axis = "n" }
V = { axis = "n" }
W = { axis = "n" }
X = { axis = "n" }
"""


@pytest.fixture
def carried():
    return velocity_equation(loads(CARRIED))


def test_three_rows_of_a_planar_loop_are_zero_and_no_rank_changes(carried) -> None:
    turned = in_link_frames(carried)
    assert sum(not any(row) for row in carried.matrix.rows) == 0
    assert sum(not any(row) for row in turned.matrix.rows) == 3
    points = sample_configurations(carried.space, 5, seed=3)
    assert len(points) == 5
    for point in points:
        assert ranks(turned, point) == ranks(carried, point)


def test_the_loop_of_the_parallelogram_is_closed_without_the_angle_of_the_arm(carried) -> None:
    """Rods of 3 and sides of 1, in the plane of the arm: 3 e^iU + e^i bottom = 1 + 3 e^iV, up to a turn."""
    closing = [p for p in carried.space.equations if len(p.variables) > 2]
    assert len(closing) == 2
    assert {name for p in closing for name in p.variables}.isdisjoint({"c_A", "s_A"})


def test_a_carried_parallelogram_is_loose_where_it_is_flat() -> None:
    """By hand: its four pins are on a line at two angles of its rods, whatever the angle of the arm."""
    increased = [
        c
        for c in classify(loads(CARRIED), cache=False).classes
        if c.verdict.is_yes and SingularityType.IIM in c.types
    ]
    assert [c.dimension for c in increased] == [1, 0]
    assert increased[0].components == 2
