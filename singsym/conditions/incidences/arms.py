"""What is singular of a serial arm, by its axes and points: wrist, elbow, shoulder.

Source: B. Siciliano, L. Sciavicco, L. Villani, G. Oriolo, *Robotics* (2009), section 3.3, for wrist, elbow
and shoulder; K. H. Hunt (1978): an arm is singular where a line reciprocal to all joints exists, through
the point that it moves.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

from singsym.conditions.incidences.grassmann_cayley import Vector, determinant, minus
from singsym.conditions.incidences.quantities import Quantity, arrow, bracket, symbol
from singsym.kinematics.modules.words import listed
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import PlacedJoint, cross, dot
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial

LONGEST = 60
"""Vectors with more terms in all entries are not squared."""


@dataclass(frozen=True)
class Axis:
    """The axis of a revolute joint: its unit direction and a point on it, both by name."""

    joint: str
    direction: str
    along: Vector
    base: str
    at: Vector


@dataclass(frozen=True, eq=False)
class Arm:
    """The revolute axes of a serial chain in space, with the other named points.

    point: that which the arm moves; velocities: of this point, one for each joint, where it is the output.
    """

    certifier: Certifier
    axes: tuple[Axis, ...]
    point: str
    velocities: tuple[Vector, ...]

    def squares(self) -> Iterator[tuple[Polynomial, Quantity]]:
        """Squared sines of the angles between axes, and squared distances of points from the first axis."""
        pairs = combinations(range(len(self.axes)), 2)
        for i, j in sorted(pairs, key=lambda pair: (pair[1] - pair[0], -pair[0])):
            one, two = self.axes[i], self.axes[j]
            cosine = self._normal(dot(one.along, two.along))
            relation = "in line" if self._common(one, two) else "parallel"
            wrist = "wrist: " if (i + 2, j + 1) == (j, len(self.axes)) and i > 0 else ""
            words = f"{wrist}axes {one.joint} and {two.joint} {relation}"
            latex = rf"\pm|{symbol(one.direction)} \times {symbol(two.direction)}|"
            text = f"±|{one.direction} x {two.direction}|"
            yield 1 - cosine * cosine, Quantity(latex, text, words)
        first = self.axes[0]
        for name, place in self._after(first):
            offset = tuple(map(self._normal, cross(minus(place, first.at), first.along)))
            if sum(map(len, offset)) <= LONGEST:
                latex = rf"\pm|{arrow(first.base, name)} \times {symbol(first.direction)}|"
                text = f"±|{first.base}{name} x {first.direction}|"
                words = f"shoulder: {self._called(name)} on the axis {first.joint}"
                yield dot(offset, offset), Quantity(latex, text, words)

    def values(self) -> Iterator[tuple[Polynomial, Quantity]]:
        """Volumes that vanish at the elbow or the shoulder; that of the velocities of all joints."""
        for one, two in zip(self.axes, self.axes[1:], strict=False):
            if not any(map(self._normal, cross(one.along, two.along))):
                for name, place in self._after(two):
                    value = determinant([one.along, minus(two.at, one.at), minus(place, one.at)])
                    where = f"in the plane of the axes {one.joint} and {two.joint}"
                    said = f"elbow: arm stretched or folded, {self._called(name)} {where}"
                    yield value, self._volume([one.direction], [(one.base, two.base), (one.base, name)], said)
        for one, two in zip(self.axes, self.axes[1:], strict=False):
            meet = self._common(one, two)
            for name, place in self._after(two):
                value = determinant([one.along, two.along, minus(place, one.at)])
                where = f"of the axes {one.joint} and {two.joint}"
                if not meet:
                    where = f"through the axis {one.joint} parallel to the axis {two.joint}"
                shoulder = "shoulder: " if one is self.axes[0] else ""
                said = f"{shoulder}{self._called(name)} in the plane {where}"
                yield value, self._volume([one.direction, two.direction], [(one.base, name)], said)
        if len(self.velocities) == 3:
            joints = [axis.joint for axis in self.axes]
            said = f"a line through {self.point} meets, or is parallel to, each of the axes {listed(joints)}"
            latex = [rf"v_{{{symbol(joint)}}}" for joint in joints]
            yield determinant(self.velocities), bracket(latex, [f"v_{joint}" for joint in joints], said)

    # -- points ----------------------------------------------------------------------------------------

    def _after(self, axis: Axis) -> list[tuple[str, Vector]]:
        """The points on axes after one, those on several first, and the point that the arm moves."""
        later = self.axes[self.axes.index(axis) + 1 :]
        names = {name: len(self._through[name]) for name in self.certifier.space.places}
        own = [n for n in names if any(a in self._through[n] for a in later) or n == self.point]
        return [(n, self.certifier.space.places[n]) for n in sorted(own, key=lambda n: -names[n])]

    @cached_property
    def _through(self) -> dict[str, tuple[Axis, ...]]:
        """Which axes a point is on in all configurations."""
        return {
            name: tuple(
                a for a in self.axes if not any(map(self._normal, cross(minus(place, a.at), a.along)))
            )
            for name, place in self.certifier.space.places.items()
        }

    def _common(self, one: Axis, two: Axis) -> bool:
        """Whether two axes have a named point in common."""
        return any(one in axes and two in axes for axes in self._through.values())

    def _called(self, name: str) -> str:
        """A point with what it is to the arm."""
        axes = self._through[name]
        if len(axes) > 2 and axes[-3:] == self.axes[-3:]:
            return f"the wrist centre {name}"
        if len(axes) > 1:
            return f"{name} on {listed([axis.joint for axis in axes])}"
        return name

    # -- polynomials -----------------------------------------------------------------------------------

    def _normal(self, polynomial: Polynomial) -> Polynomial:
        return self.certifier.normal_form(polynomial)

    def _volume(self, axes: list[str], arms: list[tuple[str, str]], words: str) -> Quantity:
        latex = [*map(symbol, axes), *(arrow(*ends) for ends in arms)]
        return bracket(latex, [*axes, *("".join(ends) for ends in arms)], words)


def arm(equation: VelocityEquation, certifier: Certifier) -> Arm | None:
    """The arm that a mechanism is; None where it is no open chain of revolute and
    prismatic joints in space.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> equation = velocity_equation(load("puma560"))
    >>> found = arm(equation, Certifier(equation.space))
    >>> [quantity.words for _, quantity in found.values()][0]
    'elbow: arm stretched or folded, the wrist centre O4 in the plane of the axes J2 and J3'
    """
    architecture = equation.architecture
    if architecture is None or len(equation.columns) != len(equation.rows) + len(architecture.joints):
        return None
    if any(column.role == "passive" for column in equation.columns):
        return None
    axes = []
    for joint in architecture.joints:
        if len(joint.screws) == 1 and not any(joint.screws[0][:3]):
            continue
        axis = _axis(joint, certifier)
        if axis is None:
            return None
        axes.append(axis)
    if not axes:
        return None
    labels = [column.label for column in equation.columns]
    moving = ["output x", "output y", "output z"]
    velocities = tuple(tuple(-row[labels.index(axis.joint)] for row in equation.matrix.rows) for axis in axes)
    whole = len(axes) == len(architecture.joints) and list(equation.rows) == moving
    return Arm(certifier, tuple(axes), architecture.point, velocities if whole else ())


def _axis(joint: PlacedJoint, certifier: Certifier) -> Axis | None:
    """The axis of a revolute joint whose point and unit direction have names; None for others."""
    if len(joint.screws) != 1 or len(joint.screws[0]) != 6 or not joint.points or not joint.axes:
        return None
    space = certifier.space
    base, direction = joint.points[0], joint.axes[0]
    at, along = tuple(space.points[base]), tuple(space.directions[direction])
    screw = joint.screws[0]
    parallel = not any(map(certifier.normal_form, minus(screw[:3], along)))
    through = not any(map(certifier.normal_form, minus(screw[3:], cross(at, along))))
    unit = not certifier.normal_form(dot(along, along) - 1)
    return Axis(joint.name, direction, along, base, at) if parallel and through and unit else None
