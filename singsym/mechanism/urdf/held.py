"""Which joints of a chain are held, those that follow held ones too.

Source: the URDF specification (https://wiki.ros.org/urdf/XML), <mimic>.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from singsym.mechanism.choices import Choice
from singsym.mechanism.expressions import expression
from singsym.mechanism.urdf.chains import Chain
from singsym.mechanism.urdf.robot_file import Robot, RobotJoint


def held_joints(robot: Robot, chain: Chain, choice: Choice) -> dict[str, Any]:
    """Values by the file's names: those asked for, and of mimic joints whose leaders are held.

    Raises `MechanismError` for names that the chain does not have, for a chain with no joint left to move,
    and for mimic joints that follow one that moves in the chain: no coupling of joints is known here.
    """
    names = [joint.name for joint in chain.moving]
    held = choice.held(names, robot.file)
    if choice.joints:
        held = {
            name: value for name, value in held.items() if name in choice.lock or not _follows(chain, name)
        }
    for _ in names:
        for joint in chain.moving:
            mimic = joint.mimic
            if mimic is None or joint.name in choice.lock or (mimic.joint not in held and mimic.multiplier):
                continue
            led = expression(held.get(mimic.joint, 0), place=f"lock {mimic.joint}", file=robot.file)
            held[joint.name] = expression(mimic.multiplier) * led + expression(mimic.offset)
    for joint in chain.moving:
        if joint.name not in held and joint.mimic is not None and joint.mimic.joint in names:
            raise _coupled(robot, chain, joint, held)
    if len(held) == len(names):
        raise robot.fault("joints", "no joint that moves", f"one or more among {', '.join(names)}")
    return held


def _follows(chain: Chain, name: str) -> bool:
    """Whether a joint follows another of the chain."""
    joint = next(joint for joint in chain.moving if joint.name == name)
    return joint.mimic is not None and any(other.name == joint.mimic.joint for other in chain.moving)


def _led(joint: RobotJoint, leader: RobotJoint) -> bool:
    return joint.mimic is not None and joint.mimic.joint == leader.name


def _coupled(robot: Robot, chain: Chain, joint: RobotJoint, held: Mapping[str, Any]) -> Exception:
    """A joint that follows one that moves: the leader may be held, or the chain end before."""
    mimic = joint.mimic
    assert mimic is not None
    plus = f" + {mimic.offset:g}" if mimic.offset else ""
    found = f"a mimic joint, {mimic.multiplier:g} * {mimic.joint}{plus}"
    leader = next(other for other in chain.moving if other.name == mimic.joint)
    still = [j for j in chain.moving if j.name not in held and j is not leader and not _led(j, leader)]
    ways = [f"hold its leader, as --lock {leader.name}={leader.resting}"] if still else []
    if joint is not chain.moving[0]:
        ways.append(f"end the chain before it, as --tip {joint.parent}")
    advice = ", or ".join(ways)
    return robot.fault(f"joint {joint.name}", found, "joints of which each moves on its own", advice)
