"""The joint formulation: joint angles as (cosine, sine) along a spanning tree, closure at the cut joints.

Source: Zlatanov, Fenton, Benhabib (1998), section 5 (angles of the legs, three distances of the platform);
a helical joint's angle and slide are taken as independent, since the helix is Zariski dense in angle x slide:
no polynomial in cosine, sine and slide vanishes on it.
"""

from __future__ import annotations

import re

from singsym.kinematics.dimensions import dimensions
from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.assembly import Assembly, placement
from singsym.kinematics.formulations.frames import Algebra, rigid
from singsym.kinematics.formulations.platforms import find_platforms, hang_platforms
from singsym.kinematics.formulations.struts import find_struts, hang_struts
from singsym.kinematics.formulations.tree import by_branch, grow, plan, spanning_steps
from singsym.kinematics.placement import Placement
from singsym.mechanism.model import Mechanism, Space

_ANGLES = ("auto", "absolute", "relative")


def suits(mechanism: Mechanism) -> bool:
    """Whether every part that hangs on spherical joints alone is a platform, a rod or a strut.

    If not, the natural formulation takes it.
    """
    mechanism = mechanism.resolved
    geometry = local.Geometry(mechanism)
    steps = spanning_steps(mechanism)
    reached = {mechanism.ground, *mechanism.translating, *(child for _, _, child in steps)}
    rods = {link for strut in find_struts(mechanism, geometry) for link in strut.links}
    try:
        find_platforms(mechanism, geometry, reached, rods, False)
    except ValueError:
        return False
    return True


def place(mechanism: Mechanism, *, angles: str = "auto", quaternion: bool = False) -> Placement:
    """Configuration variables, loop equations and screws in joint angles and slides.

    angles: "relative" has each joint's own angle, "absolute" counts the angles of successive parallel axes
    from the first, which keeps closure equations of low degree; "auto" is absolute where there are loops.
    quaternion: a platform on spherical joints is placed by a position and a quaternion, a double cover.
    Raises `ValueError` for an unattached link, and a part on spherical joints that is not one of platform,
    rod, strut.
    """
    if angles not in _ANGLES:
        raise ValueError(f"angles={angles!r}: expected one of {', '.join(_ANGLES)}")
    mechanism = mechanism.resolved
    geometry = local.Geometry(mechanism)
    tree = spanning_steps(mechanism)
    open_chain = len(mechanism.joints) < len(mechanism.links)
    absolute = angles == "absolute" or (angles == "auto" and not open_chain)
    steps = plan(mechanism, geometry, tree, absolute)
    reached = {mechanism.ground, *mechanism.translating, *(step.child for step in steps)}
    struts = find_struts(mechanism, geometry)
    rods = {link for strut in struts for link in strut.links}
    platforms = find_platforms(mechanism, geometry, reached, rods, quaternion)
    names = [v for step in by_branch(steps) for v in step.variables]
    positions = {link: _position(mechanism, link) for link in mechanism.translating}
    names += [v for position in positions.values() for v in position]
    names += [v for platform in platforms for v in platform.names]
    names += [v for strut in struts for v in strut.names]
    sized = dimensions(mechanism, names)
    algebra = Algebra(sized.ring, sized.number)
    origin = rigid(algebra, algebra.origin, algebra.axes)
    moved = {
        link: rigid(algebra, (*algebra.variables(position), *algebra.origin[len(position) :]), algebra.axes)
        for link, position in positions.items()
    }
    grown = grow(geometry, algebra, {mechanism.ground: origin, **moved}, steps)
    assembly = Assembly(mechanism, geometry, algebra, grown.bodies, list(grown.circles), grown.values)
    assembly.circles = grown.circles
    assembly.lengths = (
        *(v for step in steps for v in step.lengths),
        *(v for position in positions.values() for v in position),
        *(v for platform in platforms for v in platform.lengths),
        *(v for strut in struts for v in strut.lengths),
    )
    hang_platforms(assembly, platforms, rods)
    hang_struts(assembly, struts)
    used = {step.joint.name for step in steps}
    assembly.close(
        joint
        for joint in mechanism.joints
        if joint.name not in used and joint.first in reached and joint.second in reached
    )
    return placement(assembly, sized, "joint")


def _position(mechanism: Mechanism, link: str) -> tuple[str, ...]:
    """Variables for where the frame of a link that only translates has its origin."""
    size = 2 if mechanism.space is Space.PLANAR else 3
    stem = re.sub(r"\W", "_", link)
    return tuple(f"{x}_{stem}" for x in "xyz"[:size])
