"""What is said of serial arms: published factors with what their sources call them, and joint values."""

from __future__ import annotations

import pytest

from singsym.conditions.conditions import conditions
from singsym.conditions.named_lengths import named_lengths
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load


def printed(name: str) -> list[str]:
    """The factors of (5) in names of lengths."""
    mechanism = load(name)
    found = conditions(velocity_equation(mechanism))
    lengths = named_lengths(mechanism, found.equation)
    return [str(lengths.factor(factor)) for factor in found["5"].factors]


def test_the_puma() -> None:
    """Its wrist is spherical, axes 2 and 3 are parallel, 1 and 2 meet; atan(4318/203) = 87.3 deg."""
    wrist, elbow, shoulder = printed("puma560")
    assert wrist == "±|z3 x z5| = s5  (wrist: axes J4 and J6 in line; J5 = 0 or 180 deg)"
    assert elbow == (
        "det[z1 O1O2 O1O4] = a2*(a3*s3 + d4*c3)  (elbow: arm stretched or folded, the wrist centre O4 in "
        "the plane of the axes J2 and J3; tan J3 = -d4/a3, J3 ≈ -87.3 or 92.7 deg)"
    )
    assert shoulder.startswith("det[z0 z1 O0O4] = a2*c2 + a3*c2*c3")
    assert shoulder.endswith("(shoulder: the wrist centre O4 in the plane of the axes J1 and J2)")


def test_the_ur5_has_no_wrist_centre() -> None:
    """Axes 2, 3 and 4 are parallel; 5 and 6 meet in O5."""
    elbow, wrist, shoulder = printed("ur5")
    assert elbow.startswith("det[z1 O1O2 O1O4] = a2*a3*s3  (elbow: arm stretched or folded")
    assert elbow.endswith("J3 = 0 or 180 deg)")
    assert wrist == "±|z3 x z5| = s5  (wrist: axes J4 and J6 parallel; J5 = 0 or 180 deg)"
    assert shoulder.endswith("(shoulder: O5 on J5 and J6 in the plane of the axes J1 and J2)")


def test_an_arm_without_offset_has_its_wrist_centre_on_the_first_axis() -> None:
    elbow, wrist, shoulder = printed("7r-locked")
    assert shoulder.startswith("±|O0O4 x z0| = l1*c2")
    assert shoulder.endswith("(shoulder: the wrist centre O4 on the axis J1)")
    assert "arm stretched or folded" in elbow
    assert "axes J4 and J6 in line" in wrist


def test_three_revolutes_in_general() -> None:
    """The library's source: det = d4 (d3 + d4 c3) (s3 d2 + c2 (s3 d3 - c3 r2))."""
    (factor,) = printed("orthogonal-3r")
    left, _, right = factor.partition(" = ")
    assert left == "det[v_J1 v_J2 v_J3]"
    assert right == (
        "d4*(d3 + d4*c3)*(d2*s3 + d3*c2*s3 - r2*c2*c3)  "
        "(a line through tool meets, or is parallel to, each of the axes J1, J2 and J3)"
    )


@pytest.mark.parametrize("name", ["3rrr", "fourbar", "zlatanov-hybrid", "2r"])
def test_other_mechanisms_are_no_arms(name: str) -> None:
    assert conditions(velocity_equation(load(name))).incidences.arm is None
