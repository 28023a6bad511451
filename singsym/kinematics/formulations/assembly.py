"""From placed bodies to a Placement: screws, named points and directions, in the dimension of the space.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.1 (screws) and 2.4 (loop equations).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from singsym.kinematics.dimensions import Sized
from singsym.kinematics.formulations import closure, local
from singsym.kinematics.formulations.frames import Algebra, Body, Unplaced
from singsym.kinematics.placement import ConfigurationSpace, Coordinates, JointValue, Placement, variables_of
from singsym.mechanism.model import Joint, Mechanism, Space
from singsym.polynomials import Polynomial
from singsym.polynomials.short_forms import short_forms
from singsym.polynomials.unit_circles import unit_circles
from singsym.polynomials.unit_multiples import without_unit_multiples


@dataclass
class Assembly:
    """Bodies and equations as a formulation finds them.

    scaled: screws that only the formulation can tell, up to a nonzero factor.
    lengths: the variables that are lengths.
    circles: c^2 + s^2 - 1 by which closure equations are shortened.  Screws are not: determinants factor
        as they stand, with units c^2 + s^2, and no longer after c^2 = 1 - s^2 has been used in some entries.
    """

    mechanism: Mechanism
    geometry: local.Geometry
    algebra: Algebra
    bodies: dict[str, Body] = field(default_factory=dict)
    equations: list[Polynomial] = field(default_factory=list)
    values: dict[str, JointValue] = field(default_factory=dict)
    scaled: dict[str, Coordinates] = field(default_factory=dict)
    idle_spins: list[tuple[str, Coordinates]] = field(default_factory=list)
    lengths: tuple[str, ...] = ()
    circles: tuple[Polynomial, ...] = ()

    def close(self, joints: Iterable[Joint], lengths: Mapping[str, str] | None = None) -> None:
        """Add the constraint equations and, where they can be told, the values of these joints.

        lengths: variables for the lengths of slides, by joint.
        """
        names = lengths or {}
        for joint in joints:
            first, second = self.bodies[joint.first], self.bodies[joint.second]
            length = self.algebra.ring.gen(names[joint.name]) if joint.name in names else None
            asked = map(self.shortened, closure.equations(joint, self.geometry, first, second, length))
            self.equations += without_unit_multiples(tuple(asked), unit_circles(self.circles))
            if len(first.basis) == len(second.basis) == 3:
                self.values |= closure.value(joint, self.geometry, first, second, length)

    def shortened(self, equation: Polynomial) -> Polynomial:
        """An equation, shorter by the circles."""
        if equation in self.circles:
            return equation
        return short_forms(self.algebra.ring, self.circles).shorten(equation)


def placement(assembly: Assembly, sized: Sized, formulation: str) -> Placement:
    """The Placement of what a formulation has assembled."""
    mechanism, geometry, bodies = assembly.mechanism, assembly.geometry, assembly.bodies
    screws: dict[str, Coordinates] = {}
    for joint in mechanism.joints:
        if joint.name in assembly.scaled:
            screws[joint.name] = assembly.scaled[joint.name]
        else:
            screws |= closure.screws(joint, geometry, bodies[joint.first], bodies[joint.second])
    link_points = _link_points(mechanism, geometry, bodies)
    closing = map(assembly.shortened, assembly.equations)
    space = ConfigurationSpace(
        ring=assembly.algebra.ring,
        equations=_distinct((*sized.relations, *closing)),
        positive=sized.positive,
        parameters=sized.parameters,
        lengths=assembly.lengths,
        points=_space_points(mechanism, link_points),
        directions=_directions(mechanism, geometry, bodies),
        formulation=formulation,
    )
    return Placement(
        space,
        {label: _in_space(mechanism.space, screw) for label, screw in screws.items()},
        link_points,
        tuple(assembly.idle_spins),
        assembly.values,
        _headings(assembly),
    )


def _headings(assembly: Assembly) -> dict[str, tuple[str, ...]]:
    """The variables of each body's vectors; those of a strut's line where its two bodies have none."""
    found = {
        link: variables_of(x for vector in body.basis for x in vector)
        for link, body in assembly.bodies.items()
    }
    for joint in assembly.mechanism.joints:
        if joint.name in assembly.scaled:
            line = variables_of(assembly.scaled[joint.name])
            found |= {joint.first: line, joint.second: line}
    return found


def _in_space(space: Space, screw: Coordinates) -> Coordinates:
    if space is Space.PLANAR:
        return screw[2], screw[3], screw[4]
    return screw[:3] if space is Space.SPHERICAL else screw


def _distinct(equations: Iterable[Polynomial]) -> tuple[Polynomial, ...]:
    """The equations without zeros and repetitions up to a factor."""
    return tuple({e.primitive(): e for e in equations if e}.values())


def _link_points(
    mechanism: Mechanism, geometry: local.Geometry, bodies: Mapping[str, Body]
) -> dict[tuple[str, str], Coordinates]:
    """All named points of links that are placed, by link and name."""
    found = {}
    size = 2 if mechanism.space is Space.PLANAR else 3
    for link in mechanism.links:
        for name in link.points:
            try:
                found[link.name, name] = bodies[link.name].point(geometry.point(link.name, name))[:size]
            except Unplaced:
                continue
    return found


def _space_points(
    mechanism: Mechanism, link_points: Mapping[tuple[str, str], Coordinates]
) -> dict[str, Coordinates]:
    """Points of space by name, the ground's first; `link.point` where a name is taken by another point."""
    found: dict[str, Coordinates] = {}
    joined = {frozenset(((j.first, j.at[0]), (j.second, j.at[1]))) for j in mechanism.joints}
    owner: dict[str, str] = {}
    for link, name in sorted(link_points, key=lambda key: key[0] != mechanism.ground):
        place = link_points[link, name]
        if name not in found:
            found[name], owner[name] = place, link
        elif found[name] != place and frozenset(((owner[name], name), (link, name))) not in joined:
            found[f"{link}.{name}"] = place
    return found


def _directions(
    mechanism: Mechanism, geometry: local.Geometry, bodies: Mapping[str, Body]
) -> dict[str, Coordinates]:
    found: dict[str, Coordinates] = {}
    size = 2 if mechanism.space is Space.PLANAR else 3
    for link in sorted(mechanism.links, key=lambda link: link.name != mechanism.ground):
        for name in link.axes:
            try:
                found.setdefault(name, bodies[link.name].direction(geometry.axis(link.name, name))[:size])
            except Unplaced:
                continue
    return found
