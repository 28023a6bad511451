"""The serial chains of a robot's tree, and which of them is meant where nothing is said.

Source: singsym's own. Links that fixed joints hold together are one body.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cached_property
from itertools import takewhile

from singsym.mechanism.problems import MechanismError
from singsym.mechanism.urdf.robot_file import Robot, RobotJoint

SHORTEST_TRUNK = 3
"""Moving joints of an arm that branches at its end: fewer are a torso, whose branches are the arms."""

_JAW = re.compile(r"finger|jaw|claw|knuckle|thumb", re.IGNORECASE)
"""In names of a gripper's joints and of the links that they move; a wrist moves a gripper as a whole."""
_GRIPPER = re.compile(rf"grip|{_JAW.pattern}", re.IGNORECASE)
_SHOWN = 8


@dataclass(frozen=True)
class Chain:
    """Joints from the link `base` to the link `tip`, fixed ones too; why this one, and what is not in it."""

    base: str
    tip: str
    joints: tuple[RobotJoint, ...]
    why: str
    aside: tuple[str, ...] = ()

    @property
    def moving(self) -> tuple[RobotJoint, ...]:
        """Its joints with a freedom."""
        return tuple(joint for joint in self.joints if joint.moves)

    def __str__(self) -> str:
        count = len(self.moving)
        joints = "1 moving joint" if count == 1 else f"{count} moving joints"
        said = f"Chain from {self.base} to {self.tip}, {joints}: {self.why}."
        return f"{said} Left aside: {', '.join(self.aside)}." if self.aside else said


@dataclass(frozen=True)
class Tip:
    """A link at which a chain may end, and the moving joints that lead there."""

    link: str
    joints: tuple[RobotJoint, ...]


@dataclass(frozen=True)
class Tree:
    """A robot's links with the ways up and down; joints of three and more freedoms part it into trees."""

    robot: Robot

    @cached_property
    def _above(self) -> dict[str, RobotJoint]:
        return {joint.child: joint for joint in self.robot.joints}

    @cached_property
    def _below(self) -> dict[str, list[RobotJoint]]:
        below: dict[str, list[RobotJoint]] = {}
        for joint in self.robot.joints:
            below.setdefault(joint.parent, []).append(joint)
        return below

    def path(self, link: str) -> tuple[RobotJoint, ...]:
        """The joints that lead to a link from its root, or from the last floating or planar joint."""
        found: list[RobotJoint] = []
        while (joint := self._above.get(link)) is not None and joint.kind not in ("floating", "planar"):
            found.append(joint)
            link = joint.parent
        return tuple(reversed(found))

    def _moving(self, link: str) -> tuple[RobotJoint, ...]:
        return tuple(joint for joint in self.path(link) if joint.moves)

    def _body(self, link: str) -> str:
        """The uppermost link that fixed joints hold together with a link."""
        while (joint := self._above.get(link)) is not None and joint.kind == "fixed":
            link = joint.parent
        return link

    def _frame(self, body: str) -> str:
        """The last frame of a body: the one behind most fixed joints, of these the first in the file."""
        level, last = [body], body
        while level:
            last = level[0]
            level = [j.child for link in level for j in self._below.get(link, ()) if j.kind == "fixed"]
        return last

    @cached_property
    def tips(self) -> tuple[Tip, ...]:
        """The ends of all chains, longest chain first: the last frames of bodies that carry no others."""
        carrying = {self._body(joint.parent) for joint in self.robot.joints if joint.moves}
        bodies = dict.fromkeys(joint.child for joint in self.robot.joints if joint.moves)
        ends = [Tip(self._frame(body), self._moving(body)) for body in bodies if body not in carrying]
        return tuple(sorted(ends, key=lambda tip: -len(tip.joints)))

    def chain(self, base: str | None = None, tip: str | None = None) -> Chain:
        """The chain between two links; without a tip the only one that can be meant.

        Raises `MechanismError` where there is none, or where several can be.
        """
        if tip is None:
            end, why, dropped = self._usual(base)
        else:
            end, why, dropped = self._known(tip, "tip"), "as asked for", ()
        joints = self.path(end)
        first = joints[0].parent if joints else end
        start = first if base is None else self._known(base, "base")
        on_the_way = [first, *(joint.child for joint in joints)]
        if start not in on_the_way:
            found = f"{start!r}, which is not above {end!r}"
            raise self.robot.fault(
                "base", found, f"one of {', '.join(on_the_way)}", "or choose another --tip"
            )
        joints = joints[on_the_way.index(start) :]
        if not any(joint.moves for joint in joints):
            raise self._no_moving(start, end)
        aside = list(dropped)
        top = self._above.get(first)
        if top is not None and start == first:
            why += f"; it starts below the {top.kind} joint {top.name}"
        return Chain(start, end, joints, why, tuple(aside))

    def _usual(self, base: str | None) -> tuple[str, str, tuple[str, ...]]:
        """The tip that is meant where none is named, why, and the joints that are left aside."""
        if base is not None:
            self._known(base, "base")
        ends = [end for tip in self.tips if (end := self._from(tip, base)).joints]
        if not ends:
            raise self._no_moving(base, None)
        trunk = list(ends[0].joints)
        for end in ends[1:]:
            trunk = [a for a, b in zip(trunk, end.joints, strict=False) if a is b]
        longest = len(ends[0].joints) - len(trunk)
        if len(ends) > 1 and (len(trunk) < SHORTEST_TRUNK or longest >= len(trunk)):
            raise self._several(ends)
        why = "its tip is the only end behind moving joints"
        if len(ends) > 1:
            shown = ", ".join(end.link for end in ends[:_SHOWN])
            why = f"behind its tip the robot branches to {shown}{', ...' if len(ends) > _SHOWN else ''}"
        jaws = list(takewhile(lambda j: _GRIPPER.search(j.name) or _JAW.search(j.child), reversed(trunk)))
        if jaws and len(trunk) - len(jaws) >= SHORTEST_TRUNK:
            jaws.reverse()
            trunk = trunk[: -len(jaws)]
            names = ", ".join(joint.name for joint in jaws)
            why += f", and {names} by name belongs to a gripper (--tip {jaws[-1].child} takes it in)"
        aside = dict.fromkeys(j.name for end in ends for j in end.joints if j not in trunk)
        return self._frame(trunk[-1].child), why, tuple(aside)

    def _from(self, tip: Tip, base: str | None) -> Tip:
        """The tip with its moving joints below a base; with none where it is not below it."""
        if base is None:
            return tip
        joints = self.path(tip.link)
        place = next((i for i, joint in enumerate(joints) if joint.parent == base), len(joints))
        return Tip(tip.link, tuple(joint for joint in joints[place:] if joint.moves))

    def _known(self, link: str, option: str) -> str:
        if link in self.robot.links:
            return link
        close = get_close_matches(link, self.robot.links, 1)
        advice = f"did you mean {close[0]!r}?" if close else f"singsym show {self.robot.file} lists them"
        raise self.robot.fault(option, repr(link), "a link of the robot", advice)

    def _several(self, ends: Sequence[Tip]) -> MechanismError:
        shown = ", ".join(f"{end.link} ({len(end.joints)})" for end in ends[:_SHOWN])
        more = f" and {len(ends) - _SHOWN} more" if len(ends) > _SHOWN else ""
        found = f"{len(ends)} chains, with so many moving joints each: {shown}{more}"
        advice = f"choose one, as --tip {ends[0].link}; singsym show {self.robot.file} lists them"
        return self.robot.fault("tip", found, "the end of one serial chain", advice)

    def _no_moving(self, base: str | None, tip: str | None) -> MechanismError:
        kinds = dict.fromkeys(joint.kind for joint in self.robot.joints)
        between = f" between {base} and {tip}" if base and tip else f" below {base}" if base else ""
        found = f"no moving joint{between}"
        if not between and kinds:
            found += f", only {' and '.join(kinds)} ones"
        return self.robot.fault("robot", found, "revolute, continuous or prismatic joints")
