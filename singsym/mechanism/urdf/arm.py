"""A robot's chain as a serial mechanism, its links in the frames of the file.

Source: the URDF specification (https://wiki.ros.org/urdf/XML): a joint's frame is that of its child at zero.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import sympy

from singsym.mechanism.expressions import expression
from singsym.mechanism.model import Coupling, Joint, JointKind, Limit, Link, Mechanism, Space, Vector
from singsym.mechanism.urdf.chains import Chain
from singsym.mechanism.urdf.led import Led, with_limits
from singsym.mechanism.urdf.numbers import Names, Reading, across
from singsym.mechanism.urdf.robot_file import Robot, RobotJoint

TOOL = "tool"
"""The point of the last link at the origin of the tip's frame."""


@dataclass
class _Body:
    """Rigidly joined URDF links: one link of the mechanism, being filled."""

    name: str
    points: dict[str, Vector] = field(default_factory=dict)
    axes: dict[str, Vector] = field(default_factory=dict)


def arm(
    robot: Robot, chain: Chain, held: Collection[str], led: Mapping[str, Led]
) -> tuple[Mechanism, Mapping[str, str]]:
    """The mechanism of a chain, without outputs, and its joints' names by those of the file.

    held: the joints that will be locked, which are moving ones here; led: those that follow others.
    Raises `MechanismError` for what the chain has that no serial mechanism has.
    """
    built = _Arm(robot)
    chain, followed = with_limits(robot, chain, led)
    built.bodies.append(_Body(built.name(chain.base)))
    for joint in chain.joints:
        built.add(joint, {*held, *led})
    last = built.bodies[-1]
    last.points[TOOL] = _tuple(built.shift)
    couplings = tuple(built.coupling(name, one) for name, one in led.items())
    notes = (str(chain), *built.reading.notes, *built.notes, *followed)
    mechanism = Mechanism(
        name=robot.name,
        space=Space.SPATIAL,
        ground=built.bodies[0].name,
        links=tuple(Link(b.name, b.points, b.axes) for b in built.bodies),
        joints=tuple(built.joints),
        inputs=tuple(new for old, new in built.names.items() if old not in led),
        outputs=(),
        limits=tuple(built.limits),
        couplings=couplings,
        description="\n".join(notes),
        source=f"URDF file {Path(robot.file).name}",
        origin=robot.file,
    )
    return mechanism, built.names


class _Arm:
    """Builds links and joints along a chain; `turn`, `shift`: pose of the URDF link in its body's frame."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.reading, self.name = Reading(), Names()
        self.notes: list[str] = []
        self.bodies: list[_Body] = []
        self.joints: list[Joint] = []
        self.limits: list[Limit] = []
        self.names: dict[str, str] = {}
        self.turn, self.shift = sympy.eye(3), sympy.zeros(3, 1)

    def coupling(self, name: str, led: Led) -> Coupling:
        """Of a joint to its leader, both there."""
        new, leader = self.names[name], self.names[led.leader]
        turning = next(joint for joint in self.joints if joint.name == new).kind is JointKind.R
        offset = float(led.offset)
        constant = self.reading.multiple(offset) if turning else self.reading.length(offset)
        return Coupling(new, ((new, sympy.Integer(1)), (leader, -expression(led.multiplier))), constant)

    def add(self, joint: RobotJoint, known: Collection[str]) -> None:
        """Append one URDF joint: a fixed one moves the pose on, another starts a new body."""
        here = sympy.Matrix([self.reading.length(x) for x in joint.xyz])
        self.shift = (self.shift + self.turn * here).applyfunc(sympy.expand)
        self.turn = (self.turn * self.reading.rotation(joint.rpy, joint.name)).applyfunc(sympy.expand)
        if joint.kind == "fixed":
            return
        if joint.mimic is not None and joint.name not in known:
            leader = joint.mimic.joint
            self.notes.append(f"Joint {joint.name} follows {leader}, which is not in the chain: an input.")
        name, old = self.name(joint.name), self.bodies[-1]
        self.names[joint.name] = name
        axis = self.reading.axis(joint.axis, joint.name)
        new = _Body(self.name(joint.child))
        turning = joint.kind != "prismatic"
        # The model keeps a slide's two frames parallel; a turning body gets the URDF frame of its child.
        frame = sympy.eye(3) if turning else self.turn
        at = (f"o_{name}", f"o_{name}" if turning else f"s_{name}")
        old.points[at[0]], new.points[at[1]] = _tuple(self.shift), _tuple(sympy.zeros(3, 1))
        old.axes[f"z_{name}"], new.axes[f"z_{name}"] = _tuple(self.turn * axis), _tuple(frame * axis)
        reference = None
        if turning and self.turn != sympy.eye(3):
            aside = across(axis)
            old.axes[f"x_{name}"], new.axes[f"x_{name}"] = _tuple(self.turn * aside), _tuple(aside)
            reference = (f"x_{name}", f"x_{name}")
        pair = (f"z_{name}", f"z_{name}")
        kind = JointKind.R if turning else JointKind.P
        self.joints.append(Joint(name, kind, old.name, new.name, at, pair, reference=reference))
        self.bodies.append(new)
        self.turn, self.shift = frame, sympy.zeros(3, 1)
        if joint.lower is not None and joint.upper is not None:
            if joint.lower > joint.upper:
                found = f"the limits {joint.lower:g} and {joint.upper:g}"
                raise self.robot.fault(f"joint {joint.name}", found, "the lower limit first")
            self.limits += self.reading.limits(name, turning, joint.lower, joint.upper)


def _tuple(vector: Sequence[Any]) -> Vector:
    return tuple(sympy.expand(v) for v in vector)
