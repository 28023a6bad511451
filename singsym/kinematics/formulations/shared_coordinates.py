"""The plan of natural coordinates: what links share, and what each needs of its own.

Source: Garcia de Jalon, Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), chapter 2.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field

from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.platforms import POSE, output_points
from singsym.mechanism.model import Joint, JointKind, Mechanism

_AXIAL = (JointKind.R, JointKind.P, JointKind.H, JointKind.C, JointKind.E)
_MEETING = (JointKind.R, JointKind.U, JointKind.S)
_SLIDES = {JointKind.P: 1, JointKind.H: 1, JointKind.C: 1, JointKind.E: 2}


@dataclass(frozen=True)
class Origin:
    """Where a point or vector of a link, `inner` in its frame, comes from.

    joint: the joint to a placed link that knows it; None for variables of its own.
    names: its own variables, or the lengths by which a slide moves the point.
    """

    inner: local.Vector
    joint: Joint | None
    names: tuple[str, ...] = ()
    is_point: bool = False


@dataclass(frozen=True)
class LinkPlan:
    """How a link is placed: an anchor point, and two vectors, a P joint's frame, or a quaternion.

    vectors: two of them; a point stands for its difference from the anchor.
    parallel: the P joint whose other link has a parallel frame.  pose: x, y, z, q0, ..., q3.
    """

    link: str
    anchor: Origin
    vectors: tuple[Origin, ...] = ()
    parallel: Joint | None = None
    pose: tuple[str, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """The variables that the link brings in."""
        if self.pose:
            return self.pose
        own = [name for vector in self.vectors for name in vector.names]
        return (*self.anchor.names, *own)

    @property
    def lengths(self) -> tuple[str, ...]:
        """Those of them that are lengths: coordinates of points, and slides."""
        if self.pose:
            return self.pose[:3]
        own = [name for vector in self.vectors if vector.is_point for name in vector.names]
        return (*self.anchor.names, *own)


def plan_links(
    mechanism: Mechanism, geometry: local.Geometry, rods: Collection[str], quaternion: bool
) -> tuple[list[LinkPlan], dict[str, str]]:
    """The links other than the ground and `rods` in the order of placing, best known first.

    Also the name of a length variable for each slide that closes a loop, by joint.
    quaternion: the first output's link is placed first, by its pose.
    """
    planner = _Planner(mechanism, geometry, {mechanism.ground})
    waiting = [
        link.name for link in mechanism.links if link.name != mechanism.ground and link.name not in rods
    ]
    plans = []
    if quaternion:
        posed = next((link for link in waiting if output_points(mechanism, link)), None)
        if posed is not None:
            point = geometry.point(posed, output_points(mechanism, posed)[0])
            plans.append(LinkPlan(posed, Origin(point, None, (), True), pose=POSE))
            planner.placed.add(posed)
            waiting.remove(posed)
    while waiting:
        best = max(waiting, key=planner.knowledge)
        plans.append(planner.plan(best))
        planner.placed.add(best)
        waiting.remove(best)
    moved = {plan.anchor.joint.name for plan in plans if plan.anchor.joint is not None and plan.anchor.names}
    closing = {
        joint.name: planner.fresh(joint.name, ("d",))[0]
        for joint in mechanism.joints
        if _SLIDES.get(joint.kind) == 1
        and joint.name not in moved
        and not {joint.first, joint.second} & set(rods)
    }
    return plans, closing


@dataclass
class _Planner:
    mechanism: Mechanism
    geometry: local.Geometry
    placed: set[str]
    used: set[str] = field(default_factory=set)

    def knowledge(self, link: str) -> tuple[int, int]:
        """How many constraints tie a link to placed ones; then how many joints it has."""
        count = sum(6 - len(joint.kind.freedoms) for joint, _ in self._joints(link, placed=True))
        return count, len(list(self._joints(link, placed=False)))

    def plan(self, link: str) -> LinkPlan:
        """What the link knows from placed links, completed by variables of its own."""
        parallel = next((j for j, _ in self._joints(link, True) if j.kind is JointKind.P), None)
        anchor = self._anchor(link)
        if parallel is not None:
            return LinkPlan(link, anchor, parallel=parallel)
        chosen: list[Origin] = []
        directions: list[local.Vector] = []
        for origin in self._candidates(link, anchor):
            vector = local.minus(origin.inner, anchor.inner) if origin.is_point else origin.inner
            if any(local.vanishes(local.cross(vector, d)) for d in directions) or local.vanishes(vector):
                continue
            if origin.joint is None:
                names = self.fresh(origin.names[0], "xyz")
                origin = Origin(origin.inner, None, names, origin.is_point)
            chosen.append(origin)
            directions.append(vector)
            if len(chosen) == 2:
                break
        return LinkPlan(link, anchor, tuple(chosen))

    def _joints(self, link: str, placed: bool) -> Iterator[tuple[Joint, int]]:
        """The joints of a link with its side; `placed`: only those to placed links."""
        for joint in self.mechanism.joints:
            if link in (joint.first, joint.second):
                side = 0 if joint.first == link else 1
                other = joint.second if side == 0 else joint.first
                if not placed or other in self.placed:
                    yield joint, side

    def _anchor(self, link: str) -> Origin:
        """A known point; else one across a slide, moved along it; else a point of its own."""
        known = list(self._joints(link, placed=True))
        for joint, side in known:
            if joint.kind in _MEETING:
                return Origin(self.geometry.points(joint)[side], joint, (), True)
        for joint, side in known:
            if joint.kind in _SLIDES and (joint.kind is not JointKind.E or side == 1):
                names = self.fresh(joint.name, ("d",) if _SLIDES[joint.kind] == 1 else ("dx", "dy"))
                return Origin(self.geometry.points(joint)[side], joint, names, True)
        joint, side = next(iter(self._joints(link, placed=False)))
        return Origin(self.geometry.points(joint)[side], None, self.fresh(joint.at[side], "xyz"), True)

    def _candidates(self, link: str, anchor: Origin) -> Iterator[Origin]:
        """Vectors that could place the link: shared ones first, then joint axes, joint points, its frame."""
        for joint, side in self._joints(link, placed=True):
            if joint.kind in _AXIAL:
                yield Origin(self.geometry.axes(joint)[side], joint)
        for joint, side in self._joints(link, placed=True):
            if joint.kind in _MEETING and joint is not anchor.joint:
                yield Origin(self.geometry.points(joint)[side], joint, (), True)
        for joint, side in self._joints(link, placed=False):
            if joint.kind is not JointKind.S:
                name = joint.axes[side] if joint.axes else joint.name
                yield Origin(self.geometry.axes(joint)[side], None, (name,))
        for joint, side in self._joints(link, placed=False):
            if joint.kind in _MEETING:
                yield Origin(self.geometry.points(joint)[side], None, (joint.at[side],), True)
        for letter, direction in zip("xyz", local.UNITS, strict=True):
            yield Origin(direction, None, (f"{letter}{link}",))

    def fresh(self, stem: str, letters: Collection[str]) -> tuple[str, ...]:
        """Fresh variables, one for each letter."""
        clean = re.sub(r"\W", "_", stem)
        while any(f"{letter}_{clean}" in self.used for letter in letters):
            clean += "_"
        names = tuple(f"{letter}_{clean}" for letter in letters)
        self.used.update(names)
        return names
