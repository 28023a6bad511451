"""Links that hang on spherical joints alone: platforms, rods and struts, placed by points.

Source: natural coordinates, Garcia de Jalon, Bayo (1994), chapter 2; the three distances of a platform on
three spherical joints as in Zlatanov, Fenton, Benhabib (1998), section 5.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

import networkx
import sympy

from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.assembly import Assembly
from singsym.kinematics.formulations.closure import distance
from singsym.kinematics.formulations.frames import Algebra, Body, minus, rigid
from singsym.kinematics.placement import Coordinates, JointValue
from singsym.mechanism.model import Joint, JointKind, JointRate, Mechanism, Twist
from singsym.polynomials import Polynomial


@dataclass(frozen=True)
class Hanger:
    """A spherical joint as one link sees it: its point there, and the link and point on the other side."""

    joint: Joint
    link: str
    inner: local.Vector
    other: str
    outer: local.Vector


@dataclass(frozen=True)
class Platform:
    """A link on at least three spherical joints not in line.

    corners: three of them, not in line.  names: the variables, 9 for the corners, 7 for a position and a
    quaternion, none where the corners' places are known from the other side.
    """

    link: str
    hangers: tuple[Hanger, ...]
    corners: tuple[Hanger, ...]
    names: tuple[str, ...]


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


def loose_parts(
    mechanism: Mechanism,
    geometry: local.Geometry,
    reached: Iterable[str],
    quaternion: bool,
    sure: Iterable[str],
) -> tuple[list[Platform], list[Strut]]:
    """The links outside the tree, as platforms and struts.

    quaternion: place platforms by a position and a quaternion.  sure: slides whose length cannot vanish.
    Raises `ValueError` for a part that is neither.
    """
    placed = set(reached)
    graph = networkx.Graph(
        (joint.first, joint.second) for joint in mechanism.joints if joint.kind is not JointKind.S
    )
    rest = [link.name for link in mechanism.links if link.name not in placed]
    graph.add_nodes_from(rest)
    parts = sorted(
        (sorted(part, key=rest.index) for part in networkx.connected_components(graph.subgraph(rest))),
        key=lambda part: rest.index(part[0]),
    )
    platforms, struts = [], []
    for part in parts:
        ends = [hanger for link in part for hanger in hangers(mechanism, geometry, link)]
        if len(part) == 1 and not local.is_collinear([hanger.inner for hanger in ends]):
            platforms.append(_platform(part[0], ends, placed, quaternion))
        else:
            struts.append(_strut(mechanism, geometry, part, ends, set(sure)))
    return platforms, struts


def _platform(link: str, ends: Sequence[Hanger], placed: set[str], quaternion: bool) -> Platform:
    """A platform; held by its hangers where three of them, not in line, hang on placed links."""
    known = [hanger for hanger in ends if hanger.other in placed]
    for corners in (*combinations(known, 3), *combinations(ends, 3)):
        if not local.is_collinear([corner.inner for corner in corners]):
            break
    if not quaternion and all(corner.other in placed for corner in corners):
        return Platform(link, tuple(ends), corners, ())
    stem = re.sub(r"\W", "_", link)
    if quaternion:
        return Platform(link, tuple(ends), corners, ("x", "y", "z", "q0", "q1", "q2", "q3"))
    labels = [re.sub(r"\W", "_", _own_point(corner)) for corner in corners]
    if len(set(labels)) < 3:
        labels = [f"{stem}{i}" for i in (1, 2, 3)]
    return Platform(link, tuple(ends), corners, tuple(f"{x}_{label}" for label in labels for x in "xyz"))


def _own_point(hanger: Hanger) -> str:
    return hanger.joint.at[0 if hanger.joint.first == hanger.link else 1]


def _strut(
    mechanism: Mechanism, geometry: local.Geometry, part: list[str], ends: list[Hanger], sure: set[str]
) -> Strut:
    inside = [j for j in mechanism.joints if j.first in part and j.second in part]
    slide = inside[0] if inside else None
    straight = len(ends) == 2 and len(part) == 1 + len(inside) <= 2
    if straight and slide is not None:
        ends.sort(key=lambda hanger: hanger.link != slide.first)
        straight = slide.kind is JointKind.P and all(
            local.vanishes(local.cross(local.minus(hanger.inner, point), axis))
            for hanger, point, axis in zip(ends, geometry.points(slide), geometry.axes(slide), strict=True)
        )
    if not straight:
        raise ValueError(
            f"{', '.join(part)}: links reached through spherical joints only must be one link on three or "
            "more of them, a rod between two, or two links with a slide along the line of two; fix a link's "
            "place by another joint"
        )
    names: tuple[str, ...] = ()
    if slide is not None:
        stem = re.sub(r"\W", "_", slide.name)
        spoken = any(length_symbol(slide) in limit.expression.free_symbols for limit in mechanism.limits)
        if slide.name not in sure:
            names = (f"d_{stem}", *(f"{x}_{stem}" for x in ("ux", "uy", "uz")))
        elif spoken:
            names = (f"d_{stem}",)
    links = tuple(part) if slide is None else (slide.first, slide.second)
    return Strut(links, (ends[0], ends[1]), slide, names)


def place_platform(
    algebra: Algebra, platform: Platform, bodies: dict[str, Body], reference: local.Vector
) -> tuple[Body, list[Polynomial]]:
    """The platform's body and the equations of its variables or corners.

    reference: the point of the platform that x, y, z locate (quaternions only).
    """
    if len(platform.names) == 7:
        x, y, z, *q = algebra.variables(platform.names)
        norm = sum((c * c for c in q), start=algebra.ring.zero) - 1
        zero = algebra.ring.zero
        body = rigid(algebra, (zero,) * 3, quaternion_frame(q))
        offset = body.direction(reference)
        return rigid(algebra, minus((x, y, z), offset), body.frame), [norm]
    if platform.names:
        values = algebra.variables(platform.names)
        corners: list[Coordinates] = [values[i : i + 3] for i in (0, 3, 6)]
    else:
        corners = [bodies[corner.other].point(corner.outer) for corner in platform.corners]
    inner = [corner.inner for corner in platform.corners]
    equations = [
        distance(algebra, corners[i], corners[j], inner[i], inner[j]) for i, j in ((0, 1), (0, 2), (1, 2))
    ]
    return body_on_points(algebra, corners, inner), equations


def body_on_points(algebra: Algebra, corners: Sequence[Coordinates], inner: Sequence[local.Vector]) -> Body:
    """The body whose points `inner` are at `corners`; its third direction is their cross product."""
    a, b = (minus(corner, corners[0]) for corner in corners[1:])
    u, v = (local.minus(point, inner[0]) for point in inner[1:])
    return Body(algebra, corners[0], inner[0], (a, b, algebra.cross(a, b)), (u, v, local.cross(u, v)))


def quaternion_frame(q: Sequence[Polynomial]) -> tuple[Coordinates, ...]:
    """The columns of the rotation matrix of a quaternion (q0, q1, q2, q3), |q| = 1.

    Both q and -q give every rotation, so that sets in these variables are double covers.
    """
    a, b, c, d = q
    return (
        (a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)),
        (2 * (b * c - a * d), a * a - b * b + c * c - d * d, 2 * (c * d + a * b)),
        (2 * (b * d + a * c), 2 * (c * d - a * b), a * a - b * b - c * c + d * d),
    )


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


def hang(assembly: Assembly, platforms: Sequence[Platform], struts: Sequence[Strut]) -> None:
    """Place platforms and struts among the bodies, with their equations, values and idle spins."""
    mechanism, algebra, geometry = assembly.mechanism, assembly.algebra, assembly.geometry
    for platform in platforms:
        body, found = place_platform(
            algebra, platform, assembly.bodies, _reference(mechanism, geometry, platform)
        )
        assembly.bodies[platform.link] = body
        assembly.equations += found
    loose = {link for strut in struts for link in strut.links}
    for platform in platforms:
        on_corners = set() if platform.names else {corner.joint.name for corner in platform.corners}
        assembly.close(
            h.joint for h in platform.hangers if h.joint.name not in on_corners and h.other not in loose
        )
    turning = {output.link for output in mechanism.outputs if isinstance(output, Twist)}
    for strut in struts:
        for hanger in strut.ends:
            if hanger.other not in assembly.bodies or hanger.other in loose:
                raise ValueError(
                    f"joint {hanger.joint.name!r} joins two links that both hang on spherical joints"
                )
        axes = geometry.axes(strut.slide) if strut.slide else ()
        parts, found, direction = place_strut(algebra, strut, axes, assembly.bodies)
        assembly.bodies |= parts
        assembly.equations += found
        if not turning & set(strut.links):
            assembly.idle_spins.append((strut.ends[0].joint.name, direction))
        if strut.slide is not None:
            assembly.scaled[strut.slide.name] = (*algebra.origin, *direction)
            if strut.names:
                length = algebra.ring.gen(strut.names[0]) - algebra.number(
                    _offset(geometry, strut, strut.slide)
                )
                assembly.values[strut.slide.name] = JointValue(length=length)


def _offset(geometry: local.Geometry, strut: Strut, slide: Joint) -> sympy.Expr:
    """How much longer the strut is than its slide."""
    extra = [
        local.dot(local.minus(hanger.inner, point), axis)
        for hanger, point, axis in zip(strut.ends, geometry.points(slide), geometry.axes(slide), strict=True)
    ]
    return local.tidy(extra[1] - extra[0])


def _reference(mechanism: Mechanism, geometry: local.Geometry, platform: Platform) -> local.Vector:
    """The point of an output on the platform, else the platform's first corner."""
    for output in mechanism.outputs:
        if not isinstance(output, JointRate) and output.link == platform.link:
            return geometry.point(platform.link, output.point)
    return platform.corners[0].inner


def positive_lengths(mechanism: Mechanism) -> set[str]:
    """P joints between spherical ones whose legs cannot have length zero.

    By a positive lower limit on length(P), or an exclusion of the two ends' coinciding.
    """
    sure = {
        joint.name
        for joint in mechanism.joints
        for limit in mechanism.limits
        if limit.expression == length_symbol(joint) and limit.low is not None and limit.low.is_positive
    }
    apart = [set(exclusion.points) for exclusion in mechanism.exclusions if exclusion.kind == "coincide"]
    for joint in mechanism.joints:
        if joint.kind is JointKind.P:
            ends = [
                {
                    name
                    for other in mechanism.joints
                    if link in (other.first, other.second)
                    for name in other.at
                }
                for link in (joint.first, joint.second)
            ]
            if any(len(pair) == 2 and all(pair & end for end in ends) for pair in apart):
                sure.add(joint.name)
    return sure


def length_symbol(joint: Joint) -> sympy.Symbol:
    """The symbol that stands for a slide's length in limits."""
    return sympy.Symbol(f"length({joint.name})")
