"""Rods that meet the axes of hinges.

Source: statics: a rod between two ball joints carries a force along its line, which drives a hinge unless it
meets the hinge's axis or is parallel to it; the crank's hinge in (5), the follower's in (4).
"""

from singsym.conditions.conditions import conditions
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load


def test_the_rod_of_rssr_meets_one_axis_in_each_condition() -> None:
    found = conditions(velocity_equation(load("rssr")))
    (four,), (five,) = (condition.factors for condition in (found["4"], found["5"]))
    assert four.name is not None
    assert five.name is not None
    assert four.name.quantity.text == "det[DB DC d]"
    assert four.incidence == "line BC meets the axis d through D, or is parallel to it"
    assert five.name.quantity.text == "det[AB AC a]"
    assert five.incidence == "line BC meets the axis a through A, or is parallel to it"
