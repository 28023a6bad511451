"""Which joints of a chain are held, those that follow held ones too.

Source: the URDF specification (https://wiki.ros.org/urdf/XML), <mimic>.
"""

from __future__ import annotations

from typing import Any

from singsym.mechanism.choices import Choice
from singsym.mechanism.expressions import expression
from singsym.mechanism.urdf.chains import Chain
from singsym.mechanism.urdf.robot_file import Robot


def held_joints(robot: Robot, chain: Chain, choice: Choice) -> dict[str, Any]:
    """Values by the file's names: those asked for, and of mimic joints whose leaders are held.

    What is held because others alone are to move is at zero, or within limits that leave zero out.

    Raises `MechanismError` for names that the chain does not have, for a chain with no joint left to move,
    and for mimic joints that follow one of the chain and are asked for by themselves.
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
    if len(held) == len(names):
        raise robot.fault("joints", "no joint that moves", f"one or more among {', '.join(names)}")
    return held
