"""The natural formulation: points and unit vectors of the links as variables, constraints mostly quadratic.

Source: natural coordinates, Garcia de Jalon, Bayo, Kinematic and Dynamic Simulation of Multibody Systems
(1994), chapter 2.  A link is p0 + a e1 + b e2 + c e1 x e2, so that its mirror image never enters.
"""

from __future__ import annotations

from singsym.kinematics.dimensions import dimensions
from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.assembly import Assembly, placement
from singsym.kinematics.formulations.frames import Algebra, Body, composed, minus, plus, rigid
from singsym.kinematics.formulations.platforms import quaternion_frame
from singsym.kinematics.formulations.shared_coordinates import LinkPlan, Origin, plan_links
from singsym.kinematics.formulations.struts import find_struts, hang_struts
from singsym.kinematics.placement import Coordinates, Placement
from singsym.mechanism.model import Joint, JointKind, Mechanism


def place(mechanism: Mechanism, *, quaternion: bool = False) -> Placement:
    """Configuration variables, loop equations and screws in coordinates of points and unit vectors.

    quaternion: the output's link is placed by the position x, y, z of its point and a unit quaternion
    q0, ..., q3, a double cover (q and -q are one configuration).
    Raises `ValueError` for a rod whose ends have no place of their own.
    """
    mechanism = mechanism.resolved
    geometry = local.Geometry(mechanism)
    struts = find_struts(mechanism, geometry)
    rods = {link for strut in struts for link in strut.links}
    plans, closing = plan_links(mechanism, geometry, rods, quaternion)
    names = [name for plan in plans for name in plan.names]
    names += closing.values()
    names += [name for strut in struts for name in strut.names]
    sized = dimensions(mechanism, names)
    algebra = Algebra(sized.ring, sized.number)
    assembly = Assembly(mechanism, geometry, algebra)
    assembly.lengths = (
        *(name for plan in plans for name in plan.lengths),
        *closing.values(),
        *(name for strut in struts for name in strut.lengths),
    )
    assembly.bodies[mechanism.ground] = rigid(algebra, algebra.origin, algebra.axes)
    for plan in plans:
        _place_link(assembly, plan)
    assembly.close((j for j in mechanism.joints if j.first not in rods and j.second not in rods), closing)
    hang_struts(assembly, struts)
    return placement(assembly, sized, "quaternion" if quaternion else "natural")


def _place_link(assembly: Assembly, plan: LinkPlan) -> None:
    """Place a link by what it shares with placed links and by its own variables, with their equations."""
    algebra = assembly.algebra
    if plan.pose:
        x, y, z, *q = algebra.variables(plan.pose)
        assembly.equations.append(sum((c * c for c in q), start=algebra.ring.zero) - 1)
        turned = rigid(algebra, algebra.origin, quaternion_frame(q))
        origin = minus((x, y, z), turned.direction(plan.anchor.inner))
        assembly.bodies[plan.link] = rigid(algebra, origin, turned.frame)
        return
    if plan.parallel is not None:
        frame = _parallel_frame(assembly, plan.parallel, plan.link)
        turned = rigid(algebra, algebra.origin, frame)
        anchor = _anchor(assembly, plan, turned)
        origin = minus(anchor, turned.direction(plan.anchor.inner))
        assembly.bodies[plan.link] = rigid(algebra, origin, frame)
        return
    assembly.bodies[plan.link] = _spanned_body(assembly, plan)


def _spanned_body(assembly: Assembly, plan: LinkPlan) -> Body:
    """A body on two vectors and their cross product, with the equations of their lengths and angle."""
    algebra, place = assembly.algebra, plan.anchor.inner
    free = [origin for origin in plan.vectors if not origin.is_point]
    directions = {origin.inner: _vector(assembly, plan, origin) for origin in free}
    partial = Body(algebra, algebra.origin, place, tuple(directions.values())[:1], tuple(directions)[:1])
    anchor = _anchor(assembly, plan, partial)
    basis: list[Coordinates] = []
    inner: list[local.Vector] = []
    for origin in plan.vectors:
        if origin.is_point:
            basis.append(minus(_point(assembly, plan, origin), anchor))
            inner.append(local.minus(origin.inner, place))
        else:
            basis.append(directions[origin.inner])
            inner.append(origin.inner)
    for i, k in ((0, 0), (0, 1), (1, 1)):
        size = algebra.number(local.dot(inner[i], inner[k]))
        assembly.equations.append(algebra.dot(basis[i], basis[k]) - size)
    third, inner_third = algebra.cross(*basis), local.cross(*inner)
    return Body(algebra, anchor, place, (*basis, third), (*inner, inner_third))


def _other(joint: Joint, link: str) -> tuple[str, int]:
    """The link on the other side, and this link's side of the joint."""
    return (joint.second, 0) if joint.first == link else (joint.first, 1)


def _vector(assembly: Assembly, plan: LinkPlan, origin: Origin) -> Coordinates:
    if origin.joint is None:
        return assembly.algebra.variables(origin.names)
    other, side = _other(origin.joint, plan.link)
    return assembly.bodies[other].direction(assembly.geometry.axes(origin.joint)[1 - side])


def _point(assembly: Assembly, plan: LinkPlan, origin: Origin) -> Coordinates:
    if origin.joint is None:
        return assembly.algebra.variables(origin.names)
    other, side = _other(origin.joint, plan.link)
    return assembly.bodies[other].point(assembly.geometry.points(origin.joint)[1 - side])


def _anchor(assembly: Assembly, plan: LinkPlan, turned: Body) -> Coordinates:
    """The anchor's place; across a slide it is moved by the slide's variables.

    turned: a body that knows at least the slide's direction.
    """
    origin, algebra = plan.anchor, assembly.algebra
    if origin.joint is None or not origin.names:
        return _point(assembly, plan, origin)
    other, side = _other(origin.joint, plan.link)
    neighbour = assembly.bodies[other]
    start = neighbour.point(assembly.geometry.points(origin.joint)[1 - side])
    axis = assembly.geometry.axes(origin.joint)
    along = [neighbour.direction(axis[1 - side])]
    if origin.joint.kind is JointKind.E:
        holder = neighbour if side == 1 else turned
        along = [holder.direction(n) for n in local.perpendiculars(axis[0])]
    shift = algebra.combination(algebra.variables(origin.names), along)
    return plus(start, shift) if side == 1 else minus(start, shift)


def _parallel_frame(assembly: Assembly, joint: Joint, link: str) -> tuple[Coordinates, ...]:
    """The frame of a link across a P joint."""
    other, side = _other(joint, link)
    zero = assembly.geometry.zero(joint)
    return composed(
        assembly.algebra, assembly.bodies[other].frame, zero if side == 1 else local.transpose(zero)
    )
