"""Which chain of a robot is meant, and what is said where it is not clear."""

from __future__ import annotations

from pathlib import Path

import pytest

from singsym.mechanism import Choice, MechanismError
from singsym.mechanism.urdf import from_urdf
from singsym.mechanism.urdf.chains import Tree
from singsym.mechanism.urdf.robot_file import read_robot
from tests.mechanism.urdf.files import arm, joint, write

SIX = arm(6)
FRAMES = [
    joint("fixed", "world", "l0"),
    joint("fixed", "l0", "base"),
    joint("fixed", "l6", "flange"),
    joint("fixed", "flange", "tool0", xyz="0 0 0.1"),
    joint("fixed", "l3", "camera"),
]


def test_fixed_frames_are_no_ends(tmp_path: Path) -> None:
    """`base` and `camera` hang on fixed joints alone; the last frame behind the sixth joint is `tool0`."""
    tree = Tree(read_robot(write(tmp_path, *SIX, *FRAMES)))
    assert [(tip.link, len(tip.joints)) for tip in tree.tips] == [("tool0", 6)]
    chain = tree.chain()
    assert (chain.base, chain.tip) == ("world", "tool0")
    assert (
        str(chain)
        == "Chain from world to tool0, 6 moving joints: its tip is the only end behind moving joints."
    )
    mechanism = from_urdf(write(tmp_path, *SIX, *FRAMES))
    assert mechanism.description.startswith(str(chain))
    assert len(mechanism.inputs) == 6


def test_a_jaw_is_not_the_sixth_joint_of_an_arm(tmp_path: Path) -> None:
    """Five joints and a gripper with one jaw; a wrist that moves the link `gripper` is no jaw."""
    five = [
        *arm(4),
        joint("revolute", "l4", "gripper_link", name="wrist_roll", xyz="0.1 0 0.2", axis="0 1 0"),
    ]
    path = write(
        tmp_path, *five, joint("revolute", "gripper_link", "moving_jaw", name="gripper", axis="0 0 1")
    )
    chain = Tree(read_robot(path)).chain()
    assert (chain.tip, len(chain.moving), chain.aside) == ("gripper_link", 5, ("gripper",))
    assert "gripper by name belongs to a gripper (--tip moving_jaw takes it in)" in str(chain)
    assert len(from_urdf(path, Choice(tip="moving_jaw")).inputs) == 6
    # all joints of a robot's finger are called fingers, and are not left aside
    finger = [joint("revolute", f"f{i}", f"f{i + 1}", name=f"finger_{i}", axis="0 1 0") for i in range(4)]
    assert len(Tree(read_robot(write(tmp_path, *finger))).chain().moving) == 4


def test_an_arm_ends_where_its_gripper_branches(tmp_path: Path) -> None:
    fingers = [joint("prismatic", "l6", side, axis="0 1 0", limit="0 1") for side in ("left", "right")]
    chain = Tree(read_robot(write(tmp_path, *SIX, *fingers))).chain()
    assert (chain.tip, chain.aside) == ("l6", ("to_left", "to_right"))
    assert "behind its tip the robot branches to left, right" in str(chain)
    # a torso with two arms is no arm with a gripper of two fingers
    torso = [joint("revolute", "l0", "torso", axis="0 0 1")]
    arms = [joint("revolute", "torso", side, axis="0 1 0") for side in ("left", "right")]
    path = write(tmp_path, *torso, *arms)
    with pytest.raises(MechanismError, match=r"2 chains.*left \(2\), right \(2\).*--tip left"):
        Tree(read_robot(path)).chain()
    assert Tree(read_robot(path)).chain(tip="right").tip == "right"
    assert Tree(read_robot(path)).chain(base="torso", tip="right").moving[0].name == "to_right"


def test_bases(tmp_path: Path) -> None:
    path = write(tmp_path, *SIX, *FRAMES)
    tree = Tree(read_robot(path))
    assert [j.name for j in tree.chain(base="l3").moving] == ["to_l4", "to_l5", "to_l6"]
    with pytest.raises(MechanismError, match="'camera', which is not above 'l6'"):
        tree.chain(base="camera", tip="l6")
    with pytest.raises(MechanismError, match="no moving joint below camera"):
        tree.chain(base="camera")
    with pytest.raises(MechanismError, match="no moving joint between l6 and tool0"):
        tree.chain(base="l6", tip="tool0")
    with pytest.raises(MechanismError, match=r"'flanges'.*did you mean 'flange'"):
        tree.chain(tip="flanges")


@pytest.mark.parametrize("kind", ["floating", "planar"])
def test_a_chain_starts_below_a_joint_of_more_freedoms(tmp_path: Path, kind: str) -> None:
    chain = Tree(read_robot(write(tmp_path, joint(kind, "world", "l0"), *SIX))).chain()
    assert (chain.base, chain.tip) == ("l0", "l6")
    assert f"starts below the {kind} joint to_l0" in str(chain)


def test_mimic_joints(tmp_path: Path) -> None:
    """A joint that follows a held one is held too, at multiplier * value + offset; 0.5 is no angle of pi."""
    three = arm(3)
    relation = 'joint="to_l2" multiplier="-2" offset="0.5"'
    follower = joint("revolute", "l3", "l4", axis="0 1 0", mimic=relation)
    path = write(tmp_path, *three, follower)
    with pytest.raises(MechanismError, match=r"-2 \* to_l2 \+ 0.5.*--lock to_l2=0, .*--tip l3"):
        from_urdf(path)
    assert len(from_urdf(path, Choice(tip="l3", components=("vx", "vz", "wx"))).joints) == 3
    held = from_urdf(path, Choice(lock={"to_l2": "0.25"}, components=("vx", "vz")))
    assert [j.name for j in held.joints] == ["to_l1", "to_l3"]
    assert "Locked: to_l2 at 1/4, to 1e-6." in held.description
    assert "Locked: to_l4 at 0." in held.description
    for choice in (Choice(lock={"to_l4": 0}), Choice(joints=("to_l1", "to_l4"))):
        with pytest.raises(MechanismError, match=r"'to_l4', which follows to_l2.*name to_l2"):
            from_urdf(path, choice)
    assert from_urdf(path, Choice(joints=("to_l1", "to_l3"), components=("vx", "vz"))).inputs == (
        "to_l1",
        "to_l3",
    )
    # one that follows a joint of another branch has a rate of its own
    jaw = joint("revolute", "l0", "jaw", axis="0 0 1")
    other = joint("revolute", "l3", "l4", axis="0 1 0", mimic='joint="to_jaw"')
    alone = from_urdf(
        write(tmp_path, *three, other, jaw), Choice(tip="l4", components=("vx", "vy", "vz", "wy"))
    )
    assert "Joint to_l4 follows to_jaw, which is not in the chain: an input." in alone.description
