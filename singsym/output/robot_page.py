"""What a robot's file holds: its chains and its joints, for a person and as plain data.

Source: singsym's own.
"""

from __future__ import annotations

from typing import Any

from singsym.mechanism.urdf.chains import Tree
from singsym.mechanism.urdf.robot_file import RobotJoint
from singsym.output.page import Grid, Page

LONGEST_PATH = 8
"""Joints of a chain that are named in its row."""


def robot_page(tree: Tree) -> Page:
    """The tips, longest chain first, and the joints with their limits."""
    robot = tree.robot
    moving = sum(joint.moves for joint in robot.joints)
    sizes = f"{len(robot.links)} links, {len(robot.joints)} joints, {moving} of them moving"
    head = f"{robot.name}: URDF, {sizes}"
    tips = tuple((tip.link, str(len(tip.joints)), _path([j.name for j in tip.joints])) for tip in tree.tips)
    joints = tuple(
        (j.name, j.kind, j.parent, j.child, limits_text(j), _follows(j))
        for j in robot.joints
        if j.kind != "fixed"
    )
    grids = []
    if tips:
        grids.append(Grid(("tip", "joints", "moved by"), tips, "Ends of chains, for --tip"))
    if joints:
        headers = ("joint", "type", "parent", "child", "limits", "follows")
        grids.append(Grid(headers, joints, "Joints that are not fixed"))
    return (head, *grids)


def robot_data(tree: Tree) -> dict[str, Any]:
    """The same as plain data; limits in radians and metres, null where there is none."""
    robot = tree.robot
    return {
        "name": robot.name,
        "tips": [{"link": tip.link, "joints": [joint.name for joint in tip.joints]} for tip in tree.tips],
        "joints": [
            {
                "name": joint.name,
                "type": joint.kind,
                "parent": joint.parent,
                "child": joint.child,
                "limits": [_end(joint.lower), _end(joint.upper)],
                "follows": None if joint.mimic is None else joint.mimic.joint,
            }
            for joint in robot.joints
        ],
    }


def limits_text(joint: RobotJoint) -> str:
    """A joint's limits in radians or metres, as in the file.

    >>> limits_text(RobotJoint("j", "revolute", "a", "b", lower=-1.5, upper=3.0))
    '-1.5 to 3'
    """
    if joint.lower is None or joint.upper is None:
        return ""
    return f"{joint.lower:.5g} to {joint.upper:.5g}"


def _follows(joint: RobotJoint) -> str:
    if joint.mimic is None:
        return ""
    plus = f" + {joint.mimic.offset:g}" if joint.mimic.offset else ""
    return f"{joint.mimic.multiplier:g} * {joint.mimic.joint}{plus}"


def _path(names: list[str]) -> str:
    if len(names) <= LONGEST_PATH:
        return ", ".join(names)
    return f"{', '.join(names[:LONGEST_PATH])} and {len(names) - LONGEST_PATH} more"


def _end(value: float | None) -> float | None:
    """A number that JSON has."""
    return None if value is None or value - value != 0 else value
