"""Serial arms from URDF files, with exact dimensions near the floats that such files hold.

Source: the URDF specification (https://wiki.ros.org/urdf/XML).
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from singsym.mechanism.checks import check
from singsym.mechanism.choices import Choice, with_components
from singsym.mechanism.locking import locked
from singsym.mechanism.model import Mechanism
from singsym.mechanism.problems import MechanismError
from singsym.mechanism.urdf.arm import arm
from singsym.mechanism.urdf.chains import Tree
from singsym.mechanism.urdf.held import held_joints
from singsym.mechanism.urdf.led import led_joints
from singsym.mechanism.urdf.robot_file import read_robot
from singsym.mechanism.urdf.tool import tool_output


def from_urdf(path: str | Path, choice: Choice | None = None) -> Mechanism:
    """The serial arm between two links of a URDF file, by default from its root to its only end.

    Links behind fixed joints are frames, and a gripper at the end is left aside; `description` says which
    chain was taken and why, and which numbers were changed.

    choice: its components are of the twist of the tip (wx, wy, wz, vx, vy, vz) or of its velocity (x, y, z);
        by default all for six joints, the velocity for three, else those that can move at all, if these are
        as many as the joints that move.
    Joints that follow others of the chain are coupled to these, and no inputs.
    Lengths are in the file's metres and are the rationals that its decimals spell, without noise below 1e-9;
    angles that spell multiples of pi are these, others are rational rotations within 1e-6.
    Raises `MechanismError` for what the file lacks or has too much of, `OSError` where it cannot be read.
    """
    choice = choice or Choice()
    robot = read_robot(path)
    chain = Tree(robot).chain(choice.base, choice.tip)
    held = held_joints(robot, chain, choice)
    led = led_joints(robot, chain, held)
    mechanism, names = arm(robot, chain, held, led)
    mechanism = locked(mechanism, {names[name]: value for name, value in held.items()})
    output, note = tool_output(robot, chain, held, led, mechanism, choice)
    words = "\n".join(part for part in (mechanism.description, note) if part)
    mechanism = replace(mechanism, outputs=(output,), description=words)
    if choice.components:
        mechanism = with_components(mechanism, choice.components)
    if problems := check(mechanism, choice.redundant):
        raise MechanismError(problems)
    return mechanism
