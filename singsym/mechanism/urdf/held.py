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

    What is held because others alone are to move is at zero, or within limits that leave zero out.

    Raises `MechanismError` for names that the chain does not have, for a chain with no joint left to move,
    and for mimic joints that follow one that moves in the chain, or are asked for by themselves: no coupling
    is known here.
    """
    names = [joint.name for joint in chain.moving]
    held = choice.held(names, robot.file)
    for joint in chain.moving:
        leader = None if joint.mimic is None or joint.mimic.joint not in names else joint.mimic.joint
        if leader and (joint.name in choice.lock or joint.name in choice.joints):
            found, expected = (
                f"{joint.name!r}, which follows {leader}",
                "joints that follow none of the chain",
            )
            raise robot.fault(
                "lock" if joint.name in choice.lock else "joints", found, expected, f"name {leader}"
            )
        if leader:
            held.pop(joint.name, None)
        elif joint.name in held and joint.name not in choice.lock:
            held[joint.name] = joint.resting
    for _ in names:
        for joint in chain.moving:
            mimic = joint.mimic
            if mimic is None or joint.name in held or (mimic.joint not in held and mimic.multiplier):
                continue
            led = expression(held.get(mimic.joint, 0), place=f"lock {mimic.joint}", file=robot.file)
            held[joint.name] = expression(mimic.multiplier) * led + expression(mimic.offset)
    for joint in chain.moving:
        if joint.name not in held and joint.mimic is not None and joint.mimic.joint in names:
            raise _coupled(robot, chain, joint, held)
    if len(held) == len(names):
        raise robot.fault("joints", "no joint that moves", f"one or more among {', '.join(names)}")
    return held


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
