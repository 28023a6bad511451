"""An MJCF scene as a mechanism: trees of links, joints between them, and ball joints that close loops.

Source: the MJCF reference (https://mujoco.readthedocs.io).  Joints are counted from the file's own pose.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import sympy

from singsym.mechanism.expressions import expression
from singsym.mechanism.mjcf.model_file import Body, BodyJoint, Connection, Scene
from singsym.mechanism.model import Coupling, Joint, JointKind, Limit, Link, Mechanism, Space, Vector
from singsym.mechanism.urdf.led import Led, composed, groups, shared_limits
from singsym.mechanism.urdf.numbers import Names, Reading, across

TOOL = "tool"
"""The point of the output."""


@dataclass
class _Link:
    """Bodies that no joint parts; `turn`, `shift`: the link's pose in the world at the start."""

    name: str
    turn: Any
    shift: Any
    points: dict[str, Vector] = field(default_factory=dict)
    axes: dict[str, Vector] = field(default_factory=dict)


@dataclass(frozen=True)
class _Pose:
    """Where a body is in its link."""

    link: _Link
    turn: Any
    shift: Any

    def point(self, inner: Any) -> Any:
        """A point of the body in its link."""
        return (self.shift + self.turn * inner).applyfunc(sympy.expand)


def assembled(scene: Scene, tip: str) -> tuple[Mechanism, str]:
    """The mechanism of a scene, without outputs, and the name of the link that has the point `TOOL`.

    tip: a site or a body.  Raises `MechanismError` for what no mechanism has.
    """
    built = _Assembly(scene)
    for body in scene.bodies[1:]:
        built.add(body)
    for connection in scene.connections:
        built.close(connection)
    couplings = built.couplings()
    limits = built.limits
    aside = [f"Left aside: {', '.join(scene.aside)}."] if scene.aside else []
    place, point = scene.sites.get(tip) or ([b.name for b in scene.bodies].index(tip), (0.0, 0.0, 0.0))
    pose = built.poses[place]
    pose.link.points[TOOL] = _tuple(pose.point(built.vector(point)))
    mechanism = Mechanism(
        name=scene.name,
        space=Space.SPATIAL,
        ground=built.poses[0].link.name,
        links=tuple(Link(k.name, k.points, k.axes) for k in built.links),
        joints=tuple(built.joints),
        inputs=tuple(built.names[name] for name in scene.inputs),
        outputs=(),
        limits=limits,
        couplings=couplings,
        description="\n".join((*built.reading.notes, *aside)),
        source=f"MJCF file of {scene.name}",
        origin=scene.file,
    )
    return mechanism, pose.link.name


class _Assembly:
    """Links and joints as they are found, body by body, parents first."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.reading, self.name = Reading(), Names()
        self.joints: list[Joint] = []
        self.ranges: dict[str, tuple[float, float]] = {}
        self.names: dict[str, str] = {}
        unmoved = sympy.eye(3), sympy.zeros(3, 1)
        self.links = [_Link(self.name(scene.bodies[0].name), *unmoved)]
        self.poses = [_Pose(self.links[0], *unmoved)]

    def vector(self, numbers: Sequence[float]) -> Any:
        """A point in exact lengths."""
        return sympy.Matrix([self.reading.length(x) for x in numbers])

    def add(self, body: Body) -> None:
        """A body in its parent's link, or behind its joints, the first nearest to the parent."""
        parent = self.poses[body.parent]
        shift = parent.point(self.vector(body.position))
        turn = (parent.turn * self.reading.quaternion(body.quaternion, body.name)).applyfunc(sympy.expand)
        pose = _Pose(parent.link, turn, shift)
        for number, joint in enumerate(body.joints, 1):
            last = number == len(body.joints)
            pose = self._behind(joint, pose, body.name if last else f"{body.name}_{number}")
        self.poses.append(pose)

    def _behind(self, joint: BodyJoint, before: _Pose, name: str) -> _Pose:
        """The body in a new link across a joint: in its own frame, or for a slide parallel to the other."""
        old, sliding = before.link, joint.kind == "slide"
        world = (old.turn * before.turn).applyfunc(sympy.expand), old.turn * before.shift + old.shift
        own = before.turn if sliding else sympy.eye(3)
        new = _Link(self.name(name), old.turn if sliding else world[0], world[1].applyfunc(sympy.expand))
        after = _Pose(new, own, sympy.zeros(3, 1))
        self.links.append(new)
        label = self.names[joint.name] = self.name(joint.name)
        at = (f"o_{label}", f"s_{label}" if sliding else f"o_{label}")
        inner = self.vector(joint.point)
        old.points[at[0]], new.points[at[1]] = _tuple(before.point(inner)), _tuple(after.point(inner))
        axes = reference = None
        if joint.kind != "ball":
            axis = self.reading.axis(joint.axis, joint.name)
            axes = (f"z_{label}", f"z_{label}")
            old.axes[axes[0]], new.axes[axes[1]] = _tuple(before.turn * axis), _tuple(own * axis)
            if not sliding and before.turn != sympy.eye(3):
                aside = across(axis)
                reference = (f"x_{label}", f"x_{label}")
                old.axes[reference[0]], new.axes[reference[1]] = _tuple(before.turn * aside), _tuple(aside)
        kind = {"hinge": JointKind.R, "slide": JointKind.P, "ball": JointKind.S}[joint.kind]
        self.joints.append(Joint(label, kind, old.name, new.name, at, axes, reference=reference))
        if joint.limits is not None:
            self.ranges[label] = joint.limits
        return after

    def close(self, connection: Connection) -> None:
        """A ball joint between two points; the second, if not said, is where the first is at the start."""
        first, second = (self.poses[b] for b in connection.bodies)
        if first.link is second.link:
            found, expected = "points of bodies that no joint parts", "a loop through joints"
            raise self.scene.fault(f"equality {connection.name}", found, expected, "leave it out")
        label = self.name(connection.name)
        here = first.point(self.vector(connection.points[0]))
        if connection.points[1] is not None:
            there = second.point(self.vector(connection.points[1]))
        else:
            world = first.link.turn * here + first.link.shift - second.link.shift
            there = (second.link.turn.T * world).applyfunc(sympy.expand)
        at = (f"o_{label}", f"o_{label}")
        first.link.points[at[0]], second.link.points[at[1]] = _tuple(here), _tuple(there)
        self.joints.append(Joint(label, JointKind.S, first.link.name, second.link.name, at))

    def couplings(self) -> tuple[Coupling, ...]:
        """Joints with their leaders; the limits of turns that follow others go on one of them."""
        relations = {
            self.names[f.name]: Led(
                self.names[f.leader], Fraction(repr(f.multiplier)), Fraction(repr(f.offset))
            )
            for f in self.scene.followings
        }
        kinds = {joint.name: joint.kind for joint in self.joints}
        led = {}
        for name in relations:
            one = composed(name, relations)
            if one is None:
                found, expected = "joints that follow each other", "one that moves on its own"
                raise self.scene.fault(f"equality of {name}", found, expected)
            led[name] = one
        turns = {n: one for n, one in led.items() if {kinds[n], kinds[one.leader]} == {JointKind.R}}
        for leader, group in groups(turns).items():
            known = {name: self.ranges.pop(name) for name in group if name in self.ranges}
            try:
                shared = shared_limits(group, known)
            except ValueError as fault:
                expected = "limits that one of them can have for all"
                raise self.scene.fault(f"joint {leader}", str(fault), expected) from None
            if shared is not None:
                self.ranges[shared[0]] = shared[1]
        return tuple(self._coupling(name, one, kinds) for name, one in led.items())

    def _coupling(self, name: str, led: Led, kinds: Mapping[str, JointKind]) -> Coupling:
        offset, turning = float(led.offset), kinds[name] is JointKind.R
        constant = self.reading.multiple(offset) if turning else self.reading.length(offset)
        if kinds[name] != kinds[led.leader]:
            found, expected = (
                f"a coupling of a turn and a slide, {name} and {led.leader}",
                "two turns or slides",
            )
            raise self.scene.fault(f"equality of {name}", found, expected, "write a rack in a TOML file")
        if constant is None:
            expected = "a multiple of pi, as 0, 0.7854 or 1.5708"
            raise self.scene.fault(f"equality of {name}", f"the offset {offset:g}", expected)
        return Coupling(name, ((name, sympy.Integer(1)), (led.leader, -expression(led.multiplier))), constant)

    @property
    def limits(self) -> tuple[Limit, ...]:
        """All ranges, as conditions."""
        kinds = {joint.name: joint.kind for joint in self.joints}
        found: list[Limit] = []
        for name, ends in self.ranges.items():
            found += self.reading.limits(name, kinds[name] is JointKind.R, *ends)
        return tuple(found)


def _tuple(vector: Sequence[Any]) -> Vector:
    return tuple(sympy.expand(v) for v in vector)
