"""Held joints: the tool is where the whole arm has it with these values."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import sympy

from singsym.mechanism import Choice, Mechanism, MechanismError, check, define, load
from singsym.mechanism.locking import locked
from tests.mechanism import arms


def planar(**changes: object) -> Mechanism:
    keys = {
        "inputs": ["A", "B", "C"],
        "output": {"twist": "CT", "at": "T"},
        "links": {"ground": {"points": {"A": [0, 0]}}, "AB": 2, "BC": "3/2", "CT": 1},
        "joints": {"A": "R", "B": "R", "C": "R"},
        **changes,
    }
    return define(**keys)


def test_a_planar_arm_with_its_elbow_at_a_right_angle() -> None:
    """B at 90 degrees: C is at (2, 3/2) in the frame of AB, and CT, at zero, goes on along BC."""
    arm = locked(planar(), {"B": "pi/2"})
    assert arm.inputs == ("A", "C")
    assert arm.link("AB").points == {"A": (0, 0), "B": (2, 0), "C": (2, sympy.Rational(3, 2))}
    # the frame of CT is turned along, so that its angle in C is what it was
    assert arm.link("CT").points["T"] == (0, 1)
    last = locked(planar(), {"C": "-pi/2"})
    assert last.link("BC").points["T"] == (sympy.Rational(3, 2), -1)
    assert last.outputs[0].link == "BC"


def test_a_joint_that_is_written_towards_the_ground() -> None:
    """The angle of A is that of the ground in AB: 90 degrees turn AB by -90."""
    arm = locked(planar(joints={"A": {"links": ["AB", "ground"]}, "B": "R", "C": "R"}), {"A": "90 deg"})
    assert arm.ground == "ground"
    assert arm.link("ground").points == {"A": (0, 0), "B": (0, -2)}
    assert arm.link("BC").points["C"] == (0, sympy.Rational(-3, 2))


@pytest.mark.parametrize("name", ["J1", "J2", "J3", "J4", "J5"])
def test_an_arm_in_space(name: str) -> None:
    """The PUMA's DH table, by forward kinematics of the data alone: positions of the tool from zero on."""
    whole = load("puma560")
    held = locked(whole, {name: "pi/3"})
    values = {f"J{i}": 0.3 * i - 0.8 for i in range(1, 7)} | {name: math.pi / 3}
    assert np.allclose(arms.tool(whole, values)[0], arms.tool(held, values)[0])
    assert len(held.joints) == 5


def test_a_slide() -> None:
    keys = {
        "rows": [
            {"joint": "P", "alpha": 90},
            {"joint": "R", "a": 1, "alpha": 30, "theta": 20},
            {"a": 2, "d": 3},
        ]
    }
    whole = define(dh=keys, output={"twist": "link3", "components": ["vx", "vy", "vz"]})
    values = {"J1": 0.75, "J2": 0.4, "J3": -1.0}
    place = arms.tool(whole, values)[0]
    held = locked(whole, {"J1": "3/4"})
    assert np.allclose(place, arms.tool(held, values)[0])


def test_limits_of_what_is_held() -> None:
    limited = planar(limits={"angle(B)": ["-30", "60"], "cos(A)": {"max": "1/2"}, "T.y": {"min": 0}})
    assert [str(t.expression) for t in locked(limited, {"B": "pi/3"}).limits] == ["cos(A)", "T.y"]
    for name, value in (("B", "pi/2"), ("A", 0), ("B", "1.05")):
        with pytest.raises(MechanismError, match="within the joint's limits"):
            locked(limited, {name: value})


def test_decimals_are_rational_points_or_multiples_of_pi() -> None:
    arm = locked(planar(), {"B": "1.5708"})
    assert arm.link("AB").points["C"] == (2, sympy.Rational(3, 2))
    near = locked(planar(), {"B": "0.3"})
    x, y = near.link("AB").points["C"]
    assert (x - 2) ** 2 + y**2 == sympy.Rational(9, 4)
    assert math.atan2(y, x - 2) == pytest.approx(0.3, abs=1e-6)
    assert "Locked: B at 3/10, to 1e-6." in near.description


def test_parameters_stay() -> None:
    arm = load("2r", Choice(lock={"B": "0"}, components=("x",))).with_parameters(l1=3)
    assert arm.resolved.link("AB").points["C"] == (4, 0)


def test_refused() -> None:
    with pytest.raises(MechanismError, match="a joint of a closed loop"):
        locked(load("fourbar"), {"A": 0})
    with pytest.raises(MechanismError, match="an input joint R or P among A"):
        locked(load("fourbar"), {"B": 0})
    with pytest.raises(MechanismError, match="unknown name 'x'"):
        locked(planar(), {"B": "x"})
    against = {"ground": {"points": {"A": [0, 0, 0]}, "axes": {"u": [0, 0, 1]}}}
    against["link"] = {"points": {"A": [0, 0, 0]}, "axes": {"u": [0, 0, -1]}}
    arm = define(
        space="spatial",
        inputs=["A"],
        output={"twist": "link", "components": ["wz"]},
        links=against,
        joints={"A": {"axis": "u"}},
    )
    with pytest.raises(MechanismError, match="point against each other"):
        locked(arm, {"A": 0})


def test_components_and_joints_of_a_file() -> None:
    whole = planar()
    two = load("puma560", Choice(joints=("J2", "J3"), components=("vx", "vz")))
    assert (two.inputs, two.outputs[0].components) == (("J2", "J3"), ("vx", "vz"))
    assert check(replace(whole, outputs=Choice(components=("vx", "vy", "w")).applied(whole).outputs)) == ()
    for choice, words in (
        (Choice(tip="link3"), "expected a URDF file"),
        (Choice(components=("vx", "v")), "'v'"),
        (Choice(lock={"J7": 0}), "did you mean 'J6'|input joints among"),
        (Choice(joints=("J1",), components=("vx", "vy")), "--components vx"),
        (
            Choice(components=("vx", "vy")),
            "hold 4 inputs, as --lock J3=0 --lock J4=0 --lock J5=0 --lock J6=0",
        ),
    ):
        with pytest.raises(MechanismError, match=words):
            load("puma560", choice)
    with pytest.raises(MechanismError, match="outputs without components"):
        load("fourbar", Choice(components=("x",)))
