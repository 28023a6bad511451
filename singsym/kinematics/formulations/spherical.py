"""The spherical formulation: unit vectors along the axes, all through one point.

Source: McCarthy, Soh, Geometric Design of Linkages (2011), spherical linkages; natural coordinates as in
Garcia de Jalon, Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), ch. 2.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import networkx

from singsym.kinematics.dimensions import VariableNames, dimensions
from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.assembly import Assembly, placement
from singsym.kinematics.formulations.frames import Algebra, Body, rigid
from singsym.kinematics.placement import Coordinates, Placement
from singsym.mechanism.model import JointKind, Mechanism, Space

Axis = tuple[str, str]
"""A link and the name of an axis in it; an axis of space is the first of those that a joint makes one."""


@dataclass(frozen=True)
class Step:
    """A link placed by two of its directions: axes of space or (second only) a vector of its own."""

    link: str
    first: str
    second: str | None
    own: local.Vector | None = None


def place(mechanism: Mechanism) -> Placement:
    """Unit vectors of the moving axes as variables; a link holds the dot product of two of them.

    Its further axes are combinations of those two, u and v, and of u x v, so that no mirror image enters.
    Raises `ValueError` for joints other than R, a space that is not spherical, and an unattached link.

    >>> from singsym.mechanism import load
    >>> place(load("spherical-fourbar")).space.variables
    ('Bx', 'By', 'Bz', 'Cx', 'Cy', 'Cz')
    """
    mechanism = mechanism.resolved
    _check(mechanism)
    geometry = local.Geometry(mechanism)
    shared = _shared(mechanism)
    steps, free = _plan(mechanism, geometry, shared)
    given = dimensions(mechanism, ())
    names = VariableNames({*given.ring.names})
    moving = {axis: _three(names, axis[1]) for axis in free}
    own = {step.link: _three(names, f"e_{step.link}") for step in steps if step.own is not None}
    sized = dimensions(mechanism, [n for three in (*moving.values(), *own.values()) for n in three])
    algebra = Algebra(sized.ring, sized.number)
    ground = rigid(algebra, algebra.origin, algebra.axes)
    assembly = Assembly(mechanism, geometry, algebra, {mechanism.ground: ground})
    known: dict[Axis, Coordinates] = {axis: algebra.variables(three) for axis, three in moving.items()}
    vectors = {link: algebra.variables(three) for link, three in own.items()}
    assembly.equations += [algebra.dot(u, u) - 1 for u in (*known.values(), *vectors.values())]
    _learn(known, shared, mechanism.ground, ground, geometry)
    for step in steps:
        body = _body(step, assembly, known, shared, vectors, _centre(mechanism, geometry, ground))
        assembly.bodies[step.link] = body
        _learn(known, shared, step.link, body, geometry)
    assembly.close(mechanism.joints)
    return placement(assembly, sized, "spherical")


def _check(mechanism: Mechanism) -> None:
    if mechanism.space is not Space.SPHERICAL:
        raise ValueError(
            f"a {mechanism.space} mechanism: the spherical formulation expects space = 'spherical'"
        )
    others = sorted({joint.kind.value for joint in mechanism.joints} - {"R"})
    if others:
        raise ValueError(f"joints {', '.join(others)}: a spherical mechanism has R joints only")
    reached = networkx.node_connected_component(mechanism.graph, mechanism.ground)
    loose = [link.name for link in mechanism.links if link.name not in reached]
    if loose:
        raise ValueError(f"links {', '.join(loose)} are not attached: connect them to the ground by joints")


def _three(names: VariableNames, stem: str) -> tuple[str, str, str]:
    return names.new(f"{stem}x"), names.new(f"{stem}y"), names.new(f"{stem}z")


def _shared(mechanism: Mechanism) -> dict[Axis, Axis]:
    """The axis of space of every axis that a joint has in a link."""
    graph = networkx.Graph()
    for joint in mechanism.joints:
        if joint.kind is JointKind.R and joint.axes is not None:
            graph.add_edge((joint.first, joint.axes[0]), (joint.second, joint.axes[1]))
    order = {axis: i for i, axis in enumerate(graph.nodes)}
    return {
        axis: min(members, key=order.__getitem__)
        for members in networkx.connected_components(graph)
        for axis in members
    }


def _plan(
    mechanism: Mechanism, geometry: local.Geometry, shared: Mapping[Axis, Axis]
) -> tuple[list[Step], list[Axis]]:
    """How links are placed, those with three axes or more first, and the axes of space that are variables."""
    held: dict[str, list[str]] = {link.name: [] for link in mechanism.links}
    for link, name in shared:
        held[link].append(name)
    known = {shared[mechanism.ground, name] for name in held[mechanism.ground]}
    reached = [child for _, child in networkx.bfs_edges(mechanism.graph, mechanism.ground)]
    free: list[Axis] = []
    steps: list[Step] = []
    for link in sorted(reached, key=lambda name: len(held[name]) < 3):
        ordered = sorted(held[link], key=lambda name: shared[link, name] not in known)
        u = geometry.axis(link, ordered[0])
        second = next((n for n in ordered[1:] if not local.parallel(u, geometry.axis(link, n))), None)
        own = None if second else next(e for e in local.UNITS if not local.parallel(u, e))
        chosen = [ordered[0]] if second is None else [ordered[0], second]
        fresh = [shared[link, name] for name in chosen if shared[link, name] not in known]
        free += fresh
        known |= {shared[link, name] for name in ordered}
        steps.append(Step(link, ordered[0], second, own))
    return steps, free


def _body(
    step: Step,
    assembly: Assembly,
    known: Mapping[Axis, Coordinates],
    shared: Mapping[Axis, Axis],
    vectors: Mapping[str, Coordinates],
    centre: Coordinates,
) -> Body:
    """The link with frame (u, v, u x v), after noting that u and v keep their dot product."""
    geometry, algebra = assembly.geometry, assembly.algebra
    a = geometry.axis(step.link, step.first)
    b = step.own if step.second is None else geometry.axis(step.link, step.second)
    assert b is not None
    u = known[shared[step.link, step.first]]
    v = vectors[step.link] if step.second is None else known[shared[step.link, step.second]]
    assembly.equations.append(algebra.dot(u, v) - algebra.number(local.dot(a, b)))
    joint = next(j for j in assembly.mechanism.joints if step.link in (j.first, j.second))
    inner = geometry.points(joint)[0 if joint.first == step.link else 1]
    return Body(algebra, centre, inner, (u, v, algebra.cross(u, v)), (a, b, local.cross(a, b)))


def _centre(mechanism: Mechanism, geometry: local.Geometry, ground: Body) -> Coordinates:
    """The point where all axes meet, in the fixed frame."""
    joint = next(j for j in mechanism.joints if mechanism.ground in (j.first, j.second))
    return ground.point(geometry.points(joint)[0 if joint.first == mechanism.ground else 1])


def _learn(
    known: dict[Axis, Coordinates],
    shared: Mapping[Axis, Axis],
    link: str,
    body: Body,
    geometry: local.Geometry,
) -> None:
    """The axes of space that a placed link gives and that have no coordinates yet."""
    for (owner, name), axis in shared.items():
        if owner == link and axis not in known:
            known[axis] = body.direction(geometry.axis(link, name))
