"""Platforms: links that hang on three or more spherical joints, placed by points or by a quaternion.

Source: natural coordinates, Garcia de Jalon, Bayo (1994), chapter 2; the three distances of a platform on
three spherical joints as in Zlatanov, Fenton, Benhabib (1998), section 5.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.assembly import Assembly
from singsym.kinematics.formulations.closure import distance
from singsym.kinematics.formulations.frames import Algebra, Body, minus, rigid
from singsym.kinematics.formulations.struts import Hanger, hangers
from singsym.kinematics.placement import Coordinates
from singsym.mechanism.model import JointRate, Mechanism
from singsym.polynomials import Polynomial

POSE = ("x", "y", "z", "q0", "q1", "q2", "q3")


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

    @property
    def lengths(self) -> tuple[str, ...]:
        """The variables that are lengths: all but a quaternion."""
        return self.names[:3] if len(self.names) == len(POSE) else self.names


def find_platforms(
    mechanism: Mechanism,
    geometry: local.Geometry,
    reached: Iterable[str],
    struts: Iterable[str],
    quaternion: bool,
) -> list[Platform]:
    """The links that neither the tree has reached nor a strut is made of.

    quaternion: place the output's platform by a position and a quaternion.
    Raises `ValueError` for a part that is no platform.
    """
    placed, rods = set(reached), set(struts)
    platforms = []
    for link in mechanism.links:
        if link.name in placed or link.name in rods:
            continue
        ends = hangers(mechanism, geometry, link.name)
        joints = [joint for joint in mechanism.joints if link.name in (joint.first, joint.second)]
        if len(ends) < len(joints) or local.is_collinear([hanger.inner for hanger in ends]):
            raise ValueError(
                f"link {link.name!r} is reached through spherical joints only, but is not a platform on "
                "three or more of them, a rod between two, nor half of a strut with a slide along the "
                "line of two: use the natural formulation, or attach the link by another joint"
            )
        output = next(iter(output_points(mechanism, link.name)), None)
        platforms.append(_platform(link.name, ends, placed, quaternion and output is not None))
    return platforms


def _platform(link: str, ends: Sequence[Hanger], placed: set[str], quaternion: bool) -> Platform:
    """A platform; held by its hangers where three of them, not in line, hang on placed links."""
    known = [hanger for hanger in ends if hanger.other in placed]
    for corners in (*combinations(known, 3), *combinations(ends, 3)):
        if not local.is_collinear([corner.inner for corner in corners]):
            break
    if quaternion:
        return Platform(link, tuple(ends), corners, POSE)
    if all(corner.other in placed for corner in corners):
        return Platform(link, tuple(ends), corners, ())
    labels = [re.sub(r"\W", "_", _own_point(corner)) for corner in corners]
    return Platform(link, tuple(ends), corners, tuple(f"{x}_{label}" for label in labels for x in "xyz"))


def _own_point(hanger: Hanger) -> str:
    return hanger.joint.at[0 if hanger.joint.first == hanger.link else 1]


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


def hang_platforms(assembly: Assembly, platforms: Sequence[Platform], loose: Iterable[str]) -> None:
    """Place platforms among the bodies, with their equations; `loose` links are struts, placed later."""
    mechanism, algebra, rods = assembly.mechanism, assembly.algebra, set(loose)
    for platform in platforms:
        points = output_points(mechanism, platform.link)
        reference = assembly.geometry.point(platform.link, points[0]) if points else platform.corners[0].inner
        body, found = place_platform(algebra, platform, assembly.bodies, reference)
        assembly.bodies[platform.link] = body
        assembly.equations += found
    for platform in platforms:
        met = set() if platform.names else {corner.joint.name for corner in platform.corners}
        assembly.close(
            hanger.joint
            for hanger in platform.hangers
            if hanger.joint.name not in met and hanger.other not in rods
        )


def output_points(mechanism: Mechanism, link: str) -> list[str]:
    """The points of a link of which an output speaks."""
    return [o.point for o in mechanism.outputs if not isinstance(o, JointRate) and o.link == link]
