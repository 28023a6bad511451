"""The twists of loops in frames of their links, where rows of zeros show that a loop asks for less.

Source: the adjoint of a rigid motion (Selig, Geometric Fundamentals of Robotics (2005), ch. 4): it is
invertible, so that the rank of no set of columns changes.  A planar loop of a spatial mechanism, such as a
parallelogram that is carried along, has three rows of zeros in a frame of any of its links.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from singsym.kinematics.placement import Coordinates, PlacedJoint, cross, dot
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial, PolynomialMatrix
from singsym.polynomials.short_forms import ShortForms, short_forms
from singsym.polynomials.unit_circles import circle, unit_circles

Row = tuple[Polynomial, ...]
_AXES = ("wx", "wy", "wz", "vx", "vy", "vz")


def in_link_frames(equation: VelocityEquation) -> VelocityEquation:
    """The same with the rows of each loop in that frame of a link where most of them are zero.

    Rows stay as they are where no frame has more zeros, and where there are no more of them than N.
    """
    if len(equation.rows) <= equation.N or equation.architecture is None:
        return equation
    space, labels = equation.space, [column.label for column in equation.columns]
    circles = tuple(circle(*map(space.ring.gen, pair)) for pair in unit_circles(space.equations))
    forms = short_forms(space.ring, circles)
    frames = tuple(_frames(equation.architecture.joints, space.points, forms))
    matrix, names = list(equation.matrix.rows), list(equation.rows)
    for places in equation.loop_rows:
        if len(places) != len(_AXES):
            continue
        block = [matrix[i] for i in places]
        passed = {label for j, label in enumerate(labels) if any(row[j] for row in block)}
        best, where = block, ""
        for frame in frames:
            if passed.issuperset(frame.joint.columns):
                turned = frame.of(block, forms)
                if _zeros(turned) > _zeros(best):
                    best, where = turned, frame.joint.name
        if where:
            for i, row, axis in zip(places, best, _AXES, strict=True):
                matrix[i], names[i] = row, f"{names[i].rpartition(' ')[0]} at {where} {axis}"
    changed = PolynomialMatrix(space.ring, tuple(matrix), equation.matrix.width)
    return replace(equation, matrix=changed, rows=tuple(names))


@dataclass(frozen=True)
class _Frame:
    """Axes of a frame of a link at one of its joints; their lengths are constant and not zero."""

    joint: PlacedJoint
    origin: Coordinates
    axes: tuple[Coordinates, ...]

    def of(self, rows: Sequence[Row], forms: ShortForms) -> list[Row]:
        """Twists, one in each column, in this frame: first what turns, then the velocities at the origin."""
        columns = []
        for screw in zip(*rows, strict=True):
            turn, shift = screw[:3], cross(screw[:3], self.origin)
            velocity = tuple(v + w for v, w in zip(screw[3:], shift, strict=True))
            parts = (dot(axis, vector) for vector in (turn, velocity) for axis in self.axes)
            columns.append(tuple(map(forms.normal_form, parts)) if any(screw) else screw)
        return list(zip(*columns, strict=True))


def _frames(
    joints: Sequence[PlacedJoint], points: Mapping[str, Coordinates], forms: ShortForms
) -> Iterator[_Frame]:
    """At each pin u, u x v and u x (u x v), where v is the axis of another joint of one of its links."""
    for joint in joints:
        u, origin = joint.screws[0][:3], points.get(joint.points[0], ()) if joint.points else ()
        if not any(u) or len(joint.screws) > 1 or len(origin) != 3:
            continue
        links = {joint.first, joint.second}
        beside = (other for other in joints if links & {other.first, other.second})
        for v in (screw[:3] for other in beside for screw in other.screws):
            across = tuple(map(forms.normal_form, cross(u, v)))
            square = forms.normal_form(dot(across, across))
            if square and square.is_constant:
                yield _Frame(joint, origin, (u, across, tuple(map(forms.normal_form, cross(u, across)))))
                break


def _zeros(rows: Sequence[Row]) -> int:
    """How many rows are zero."""
    return sum(not any(row) for row in rows)
