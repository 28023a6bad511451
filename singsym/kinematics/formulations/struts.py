"""Rods, and struts with a slide, between two spherical joints: placed by their two ends.

Source: textbook; a link between two spherical joints spins idly about the line of their centres.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import networkx
import sympy

from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.assembly import Assembly
from singsym.kinematics.formulations.closure import distance
from singsym.kinematics.formulations.frames import Algebra, Body, minus
from singsym.kinematics.placement import Coordinates, JointValue
from singsym.mechanism.model import Joint, JointKind, Mechanism, Twist
from singsym.polynomials import Polynomial

_POINTS_COINCIDE = (JointKind.R, JointKind.U, JointKind.S)
"""Joints that keep their points in the two links together."""


@dataclass(frozen=True)
class Hanger:
    """A spherical joint as one link sees it: its point there, and the link and point on the other side."""

    joint: Joint
    link: str
    inner: local.Vector
    other: str
    outer: local.Vector


@dataclass(frozen=True)
class Strut:
    """A rod, or two links with a slide between them, from one spherical joint to another.

    slide: the P joint, None for a rod.  links: in order from the first end.
    names: length and direction where the length may vanish; the length where limits speak of it; else none.
    """

    links: tuple[str, ...]
    ends: tuple[Hanger, Hanger]
    slide: Joint | None
    names: tuple[str, ...]

    @property
    def lengths(self) -> tuple[str, ...]:
        """The variables that are lengths: not the direction."""
        return self.names[:1]


def hangers(mechanism: Mechanism, geometry: local.Geometry, link: str) -> list[Hanger]:
    """The spherical joints of a link, in the mechanism's order."""
    found = []
    for joint in mechanism.joints:
        if joint.kind is JointKind.S and link in (joint.first, joint.second):
            a, b = geometry.points(joint)
            if link == joint.first:
                found.append(Hanger(joint, link, a, joint.second, b))
            else:
                found.append(Hanger(joint, link, b, joint.first, a))
    return found


def find_struts(mechanism: Mechanism, geometry: local.Geometry) -> list[Strut]:
    """All rods, and straight struts but those with a slide in a coupling, which needs its length."""
    coupled = {column for coupling in mechanism.couplings for column, _ in coupling.terms}
    struts = []
    for link in mechanism.links:
        joints = [joint for joint in mechanism.joints if link.name in (joint.first, joint.second)]
        ends = hangers(mechanism, geometry, link.name)
        if link.name == mechanism.ground or len(joints) != 2:
            continue
        if len(ends) == 2 and not local.vanishes(local.minus(ends[0].inner, ends[1].inner)):
            struts.append(Strut((link.name,), (ends[0], ends[1]), None, ()))
        slide = next((joint for joint in joints if joint.kind is JointKind.P), None)
        if len(ends) == 1 and slide is not None and slide.first == link.name and slide.name not in coupled:
            other = hangers(mechanism, geometry, slide.second)
            if len(other) == 1 and _is_straight(mechanism, geometry, slide, (ends[0], other[0])):
                both = (ends[0], other[0])
                names = _strut_names(mechanism, slide, never_vanishes(mechanism, geometry, slide, both))
                struts.append(Strut((slide.first, slide.second), both, slide, names))
    return struts


def _is_straight(
    mechanism: Mechanism, geometry: local.Geometry, slide: Joint, ends: tuple[Hanger, Hanger]
) -> bool:
    """Whether the slide runs along the line of the two ends, and nothing else is attached."""
    attached = [joint for joint in mechanism.joints if slide.second in (joint.first, joint.second)]
    return (
        slide.second != mechanism.ground
        and len(attached) == 2
        and all(
            local.vanishes(local.cross(local.minus(hanger.inner, point), axis))
            for hanger, point, axis in zip(ends, geometry.points(slide), geometry.axes(slide), strict=True)
        )
    )


def _strut_names(mechanism: Mechanism, slide: Joint, sure: bool) -> tuple[str, ...]:
    stem = re.sub(r"\W", "_", slide.name)
    if not sure:
        return (f"d_{stem}", *(f"{x}_{stem}" for x in ("ux", "uy", "uz")))
    spoken = any(length_symbol(slide) in limit.expression.free_symbols for limit in mechanism.limits)
    return (f"d_{stem}",) if spoken else ()


def place_strut(
    algebra: Algebra, strut: Strut, axes: tuple[local.Vector, ...], bodies: dict[str, Body]
) -> tuple[dict[str, Body], list[Polynomial], Coordinates]:
    """Bodies along the strut's line, its equations, and the direction of that line.

    axes: the slide's axis in its two links.  The direction is the difference of the ends, or a unit variable
    where that may vanish.
    """
    start, end = strut.ends
    p, r = (bodies[hanger.other].point(hanger.outer) for hanger in strut.ends)
    gap = minus(r, p)
    if strut.slide is None:
        body = Body(algebra, p, start.inner, (gap,), (local.minus(end.inner, start.inner),))
        return {start.link: body}, [distance(algebra, p, r, start.inner, end.inner)], gap
    if len(strut.names) < 4:
        parts = {h.link: Body(algebra, x, h.inner, (), ()) for h, x in zip(strut.ends, (p, r), strict=True)}
        lengths = algebra.variables(strut.names)
        return parts, [algebra.dot(gap, gap) - length * length for length in lengths], gap
    length, *direction = algebra.variables(strut.names)
    u = tuple(direction)
    closing = [g - length * x for g, x in zip(gap, u, strict=True)]
    parts = {
        h.link: Body(algebra, x, h.inner, (u,), (axis,))
        for h, x, axis in zip(strut.ends, (p, r), axes, strict=True)
    }
    return parts, [*closing, algebra.dot(u, u) - 1], u


def hang_struts(assembly: Assembly, struts: Sequence[Strut]) -> None:
    """Place struts between bodies, with their equations, values and idle spins."""
    algebra, geometry = assembly.algebra, assembly.geometry
    loose = {link for strut in struts for link in strut.links}
    turning = {output.link for output in assembly.mechanism.outputs if isinstance(output, Twist)}
    for strut in struts:
        for hanger in strut.ends:
            if hanger.other in loose:
                raise ValueError(f"joint {hanger.joint.name!r} joins two struts: neither has its own place")
        axes = geometry.axes(strut.slide) if strut.slide else ()
        parts, found, direction = place_strut(algebra, strut, axes, assembly.bodies)
        assembly.bodies |= parts
        assembly.equations += found
        if not turning & set(strut.links):
            assembly.idle_spins.append((strut.ends[0].joint.name, direction))
        if strut.slide is not None:
            assembly.scaled[strut.slide.name] = (*algebra.origin, *direction)
            offset = _offset(geometry, strut.slide, strut.ends)
            if strut.names:
                length = algebra.ring.gen(strut.names[0])
                assembly.values[strut.slide.name] = JointValue(length=length - algebra.number(offset))
            elif offset.is_zero:
                square = algebra.dot(direction, direction)
                assembly.values[strut.slide.name] = JointValue(square=square)


def _offset(geometry: local.Geometry, slide: Joint, ends: tuple[Hanger, Hanger]) -> sympy.Expr:
    """How much longer a strut is than its slide."""
    extra = [
        local.dot(local.minus(hanger.inner, point), axis)
        for hanger, point, axis in zip(ends, geometry.points(slide), geometry.axes(slide), strict=True)
    ]
    return local.tidy(extra[1] - extra[0])


def never_vanishes(
    mechanism: Mechanism, geometry: local.Geometry, slide: Joint, ends: tuple[Hanger, Hanger]
) -> bool:
    """Whether the two ends of a strut never coincide: by a lower limit of its slide or an exclusion."""
    offset = _offset(geometry, slide, ends)
    lows = (k.low for k in mechanism.limits if k.expression == length_symbol(slide) and k.low is not None)
    if any((low + offset).is_positive for low in lows):
        return True
    first, second = (_names_of_centre(mechanism, hanger.joint) for hanger in ends)
    apart = (e.points for e in mechanism.exclusions if e.kind == "coincide")
    return any((a in first and b in second) or (a in second and b in first) for a, b in apart)


def _names_of_centre(mechanism: Mechanism, joint: Joint) -> set[str]:
    """The names of a spherical joint's centre in all links that have it; a name is one point of space."""
    graph = networkx.Graph()
    for other in mechanism.joints:
        if other.kind in _POINTS_COINCIDE:
            graph.add_edge((other.first, other.at[0]), (other.second, other.at[1]))
    return {name for _, name in networkx.node_connected_component(graph, (joint.first, joint.at[0]))}


def length_symbol(joint: Joint) -> sympy.Symbol:
    """The symbol that stands for a slide's length in limits."""
    return sympy.Symbol(f"length({joint.name})")
