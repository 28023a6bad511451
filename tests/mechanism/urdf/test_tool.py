"""Which output an arm has, and what is offered where it is not clear."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from singsym.mechanism import Choice, MechanismError, PointVelocity, Twist
from singsym.mechanism.urdf import from_urdf
from tests.mechanism.urdf.files import arm, joint, write


def offered(path: Path, choice: Choice | None = None) -> Choice:
    """The first options that a refusal offers, as a choice."""
    with pytest.raises(MechanismError) as caught:
        from_urdf(path, choice)
    text = str(caught.value)
    locks = dict(re.findall(r"--lock (\S+)=([^\s;]+)", text))
    components = re.findall(r"--components ([a-z,]+)", text)
    return Choice(lock=locks, components=tuple(components[0].split(",")) if components else ())


def test_outputs_that_are_clear(tmp_path: Path) -> None:
    assert from_urdf(write(tmp_path, *arm(6))).outputs[0].components == ("wx", "wy", "wz", "vx", "vy", "vz")
    tip = [*arm(3), joint("fixed", "l3", "tip", xyz="0.5 0 0")]
    assert isinstance(from_urdf(write(tmp_path, *tip)).outputs[0], PointVelocity)


def test_a_scara_turns_about_one_axis_only(tmp_path: Path) -> None:
    """Three vertical axes and a vertical slide: vx, vy, vz and wz are all that its tip can do."""
    axis = "0 0 1"
    turns = [joint("revolute", f"s{i}", f"s{i + 1}", xyz="0.3 0 0", axis=axis) for i in range(3)]
    path = write(tmp_path, *turns, joint("prismatic", "s3", "s4", axis=axis, limit="0 1"))
    output = from_urdf(path).outputs[0]
    assert isinstance(output, Twist)
    assert output.components == ("wz", "vx", "vy", "vz")
    # three parallel axes: in their plane, not the velocity in space, of which vz would always be zero
    assert from_urdf(path, Choice(tip="s3")).outputs[0].components == ("wz", "vx", "vy")


@pytest.mark.parametrize("count", [2, 4, 5])
def test_components_are_offered_that_work(tmp_path: Path, count: int) -> None:
    path = write(tmp_path, *arm(count))
    choice = offered(path)
    assert len(choice.components) == count
    assert from_urdf(path, choice).outputs[0].components == choice.components


def test_joints_are_offered_to_be_held(tmp_path: Path) -> None:
    """Of seven joints the third; of five parallel ones two, with the plane's components."""
    path = write(tmp_path, *arm(7))
    choice = offered(path)
    assert choice == Choice(lock={"to_l3": "0"})
    assert len(from_urdf(path, choice).inputs) == 6
    snake = [joint("continuous", f"s{i}", f"s{i + 1}", xyz="0.3 0 0", axis="0 0 1") for i in range(5)]
    path = write(tmp_path, *snake)
    choice = offered(path)
    assert (len(choice.lock), choice.components) == (2, ("vx", "vy", "wz"))
    assert len(from_urdf(path, choice).inputs) == 3
    # a joint whose limits leave zero out is held near their middle
    limited = joint("revolute", "l2", "l3", xyz="0.3 0 0.4", axis="0 1 0", limit="-2.5 -0.5")
    rows = arm(7)
    path = write(tmp_path, *rows[:2], limited, *rows[3:])
    assert offered(path) == Choice(lock={"to_l3": "-2"})
    assert len(from_urdf(path, offered(path)).inputs) == 6


def test_joints_that_move(tmp_path: Path) -> None:
    path = write(tmp_path, *arm(7))
    names = tuple(f"to_l{i}" for i in (1, 2, 3, 5, 6, 7))
    held = from_urdf(path, Choice(joints=names))
    assert held.inputs == names
    assert "Locked: to_l4 at 0." in held.description
    limited = joint("revolute", "l2", "l3", xyz="0.3 0 0.4", axis="0 1 0", limit="-2.5 -0.5")
    rows = arm(3)
    bent = from_urdf(
        write(tmp_path, *rows[:2], limited), Choice(joints=("to_l1", "to_l2"), components=("vx", "vz"))
    )
    assert "Locked: to_l3 at -2, to 1e-6." in bent.description
    with pytest.raises(MechanismError, match="no joint that moves"):
        from_urdf(write(tmp_path, *arm(1)), Choice(lock={"to_l1": "0"}))


def test_a_redundant_arm_is_let_through_where_that_is_meant(tmp_path: Path) -> None:
    arm7 = from_urdf(write(tmp_path, *arm(7)), Choice(redundant=True))
    assert (len(arm7.inputs), arm7.output_size) == (7, 6)
