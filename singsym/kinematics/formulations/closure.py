"""What a joint asks of the two bodies it connects, and its screws.

Source: the lower pairs as constraints between bodies (textbook); screws as in Zlatanov, Fenton, Benhabib
(1998), section 2.1, in the order (omega, v).  Directions are equated as vectors, never by their angle alone,
so that no mirror image enters.
"""

from __future__ import annotations

from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.frames import Algebra, Body, Unplaced, minus
from singsym.kinematics.placement import Coordinates, JointValue
from singsym.mechanism.model import Joint, JointKind
from singsym.polynomials import Polynomial


def equations(
    joint: Joint, geometry: local.Geometry, first: Body, second: Body, length: Polynomial | None = None
) -> list[Polynomial]:
    """Polynomials that vanish exactly where the joint's constraint holds.

    length: of a slide, as a variable; without it two equations of higher degree take its place.
    """
    algebra, kind = first.algebra, joint.kind
    a, b = geometry.points(joint)
    gap = minus(second.point(b), first.point(a))
    if kind is JointKind.S:
        return list(gap)
    u, v = geometry.axes(joint)
    if kind is JointKind.U:
        return [*gap, algebra.dot(first.direction(u), second.direction(v))]
    found = list(minus(second.direction(v), first.direction(u)))
    n1, n2 = local.perpendiculars(u)
    if kind is JointKind.P:
        back = local.transpose(geometry.zero(joint))
        found += minus(second.direction(local.apply(back, n1)), first.direction(n1))
    if kind is JointKind.R:
        return found + list(gap)
    if length is not None:
        return [*found, *minus(gap, algebra.combination((length,), (first.direction(u),)))]
    normals = (u,) if kind is JointKind.E else (n1, n2)
    return found + [algebra.dot(gap, first.direction(n)) for n in normals]


def screws(joint: Joint, geometry: local.Geometry, first: Body, second: Body) -> dict[str, Coordinates]:
    """Column label -> screw (w, v at the origin) of `second` relative to `first`.

    E: translations along two directions of `first` (coordinate axes of its frame where it has one in the
    plane), then the rotation about the normal through the
    point of `second`.
    """
    algebra, kind = first.algebra, joint.kind
    inner = geometry.points(joint)
    if kind is JointKind.S:
        p = _placed_point(first, inner[0], second, inner[1])
        return {label: rotation(algebra, e, p) for label, e in zip(joint.columns, algebra.axes, strict=True)}
    u, v = geometry.axes(joint)
    if kind is JointKind.U:
        p = _placed_point(first, inner[0], second, inner[1])
        directions = (first.direction(u), second.direction(v))
        return {label: rotation(algebra, d, p) for label, d in zip(joint.columns, directions, strict=True)}
    w = placed_direction(first, u, second, v)
    slide = (*algebra.origin, *w)
    if kind is JointKind.P:
        return {joint.name: slide}
    if kind is JointKind.E:
        turn = rotation(algebra, w, second.point(inner[1]))
        plane = [(*algebra.origin, *first.direction(n)) for n in local.perpendiculars(u)]
        return dict(zip(joint.columns, (*plane, turn), strict=True))
    turn = rotation(algebra, w, _placed_point(first, inner[0], second, inner[1]))
    if kind is JointKind.C:
        return dict(zip(joint.columns, (turn, slide), strict=True))
    if kind is JointKind.H and joint.pitch is not None:
        pitch = algebra.number(joint.pitch)
        turn = (*turn[:3], *(algebra.ring.reduced(m + pitch * x) for m, x in zip(turn[3:], w, strict=True)))
    return {joint.name: turn}


def value(
    joint: Joint, geometry: local.Geometry, first: Body, second: Body, length: Polynomial | None = None
) -> dict[str, JointValue]:
    """Column label -> value of an R, H, P or C joint, read off the two bodies or its length variable."""
    algebra, kind = first.algebra, joint.kind
    if kind not in (JointKind.R, JointKind.H, JointKind.P, JointKind.C):
        return {}
    a, b = geometry.points(joint)
    u, _ = geometry.axes(joint)
    found: list[JointValue] = []
    if kind is not JointKind.P:
        n1, n2 = local.perpendiculars(u)
        there = second.direction(local.apply(local.transpose(geometry.zero(joint)), n1))
        cosine, sine = (algebra.dot(first.direction(n), there) for n in (n1, n2))
        found.append(JointValue(cosine, sine, algebra.number(local.dot(n1, n1))))
    if kind in (JointKind.P, JointKind.C):
        if length is None:
            length = algebra.dot(minus(second.point(b), first.point(a)), first.direction(u))
        found.append(JointValue(length=length))
    return dict(zip(joint.columns, found, strict=True))


def rotation(algebra: Algebra, direction: Coordinates, point: Coordinates) -> Coordinates:
    """The screw (w, p x w) of a rotation about an axis through p."""
    return (*direction, *algebra.cross(point, direction))


def distance(
    algebra: Algebra, p: Coordinates, q: Coordinates, a: local.Vector, b: local.Vector
) -> Polynomial:
    """|p - q|^2 minus the same of a and b, the two points in their link's frame."""
    gap, inner = minus(p, q), local.minus(a, b)
    return algebra.dot(gap, gap) - algebra.number(local.dot(inner, inner))


def placed_direction(first: Body, u: local.Vector, second: Body, v: local.Vector) -> Coordinates:
    """A direction that the two bodies share, from the one that is placed in full."""
    try:
        return first.direction(u)
    except Unplaced:
        return second.direction(v)


def _placed_point(first: Body, a: local.Vector, second: Body, b: local.Vector) -> Coordinates:
    try:
        return first.point(a)
    except Unplaced:
        return second.point(b)
