"""The legs that carry a link: chains of joints between it and the ground.

Source: J.-P. Merlet, *Parallel Robots* (2006), chapter 2; a leg's joints are crossed in turn on the way.
"""

from __future__ import annotations

from dataclasses import dataclass

import networkx

from singsym.conditions.incidences.grassmann_cayley import Vector
from singsym.kinematics.placement import Architecture, PlacedJoint
from singsym.kinematics.velocity import VelocityEquation


@dataclass(frozen=True)
class Leg:
    """Joints from the ground to the carried link, in order."""

    joints: tuple[PlacedJoint, ...]

    def columns(self, left_out: frozenset[str]) -> tuple[tuple[Vector, Vector], ...]:
        """Of each freedom that is not left out its screw, and its part in the rows against idle spins."""
        rows = [joint for joint in self.joints if joint.idle is not None]
        found: list[tuple[Vector, Vector]] = []
        for joint in self.joints:
            for place, (column, screw) in enumerate(zip(joint.columns, joint.screws, strict=True)):
                if column not in left_out:
                    zero = screw[0] - screw[0]
                    spins = tuple(
                        own.idle[place] if own is joint and own.idle is not None else zero for own in rows
                    )
                    found.append((screw, spins))
        return tuple(found)

    @property
    def points(self) -> tuple[str, ...]:
        """The names of its joints' points, each once, from the ground on."""
        return tuple(dict.fromkeys(name for joint in self.joints for name in joint.points))

    @property
    def axes(self) -> tuple[str, ...]:
        """The names of its joints' axes."""
        return tuple(dict.fromkeys(name for joint in self.joints for name in joint.axes))


def legs(equation: VelocityEquation) -> tuple[Leg, ...]:
    """The legs of the link that a mechanism moves; none where it does not hang on simple chains alone.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> [[joint.name for joint in leg.joints] for leg in legs(velocity_equation(load("3rrr")))]
    [['A1', 'B1', 'C1'], ['A2', 'B2', 'C2'], ['A3', 'B3', 'C3']]
    """
    architecture = equation.architecture
    if architecture is None or architecture.coupled or architecture.moved in ("", architecture.ground):
        return ()
    graph = networkx.MultiGraph()
    for joint in architecture.joints:
        graph.add_edge(joint.first, joint.second, joint=joint)
    between = graph.copy()
    between.remove_nodes_from((architecture.ground, architecture.moved))
    found = [
        Leg((joint,))
        for joint in architecture.joints
        if {joint.first, joint.second} == {architecture.ground, architecture.moved}
    ]
    for links in networkx.connected_components(between):
        leg = _chain(architecture, frozenset(links))
        if leg is None:
            return ()
        found.append(leg)
    order = {joint.name: i for i, joint in enumerate(architecture.joints)}
    return tuple(sorted(found, key=lambda leg: order[leg.joints[0].name]))


def _chain(architecture: Architecture, links: frozenset[str]) -> Leg | None:
    """Links with the joints around them as a chain from the ground to the moved link; else None."""
    left = [joint for joint in architecture.joints if {joint.first, joint.second} & links]
    if len(left) != len(links) + 1:
        return None
    here, joints = architecture.ground, list[PlacedJoint]()
    while left:
        following = [joint for joint in left if here in (joint.first, joint.second)]
        if len(following) != 1:
            return None
        (joint,) = following
        left.remove(joint)
        joints.append(joint)
        here = joint.second if joint.first == here else joint.first
    return Leg(tuple(joints)) if here == architecture.moved else None
