"""The velocity equation L m = 0 of a mechanism, and its submatrices L_I, L_O, L_p.

Source: Zlatanov, Fenton, Benhabib (1998), (1)-(3); an example is (6).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from singsym.kinematics.formulations import place
from singsym.kinematics.loops import loops, path
from singsym.kinematics.placement import ConfigurationSpace, Coordinates, JointValue, Placement
from singsym.mechanism.model import JointRate, Mechanism, Output, PointVelocity, Space
from singsym.polynomials import Polynomial, PolynomialMatrix

Role = Literal["output", "input", "passive"]

_AXES = {
    Space.PLANAR: ("w", "vx", "vy"),
    Space.SPHERICAL: ("wx", "wy", "wz"),
    Space.SPATIAL: ("wx", "wy", "wz", "vx", "vy", "vz"),
}


@dataclass(frozen=True)
class Column:
    """A column of L: the velocity that it multiplies, and what the velocity is to the mechanism."""

    label: str
    role: Role


@dataclass(frozen=True)
class VelocityEquation:
    """L(q) m = 0 with m = [T, Omega^a, Omega^p] on a configuration space.

    matrix: L, one row for each entry of `rows`, one column for each of `columns`.
    N: the number of 1-DOF joints; n: the mobility.  L has N rows, more where over-constrained.
    values: what the formulation knows of the joints' values, by column label.
    """

    space: ConfigurationSpace
    matrix: PolynomialMatrix
    columns: tuple[Column, ...]
    rows: tuple[str, ...]
    N: int
    n: int
    values: Mapping[str, JointValue] = field(default_factory=dict, compare=False)

    def _without(self, *roles: Role) -> PolynomialMatrix:
        return self.matrix.select(columns=[j for j, c in enumerate(self.columns) if c.role not in roles])

    @property
    def L(self) -> PolynomialMatrix:
        """The whole matrix of (1)."""
        return self.matrix

    @property
    def L_I(self) -> PolynomialMatrix:
        """L without the input columns, (2)."""
        return self._without("input")

    @property
    def L_O(self) -> PolynomialMatrix:
        """L without the output columns, (3)."""
        return self._without("output")

    @property
    def L_p(self) -> PolynomialMatrix:
        """L without input and output columns."""
        return self._without("input", "output")

    def __repr__(self) -> str:
        rows, columns = self.matrix.shape
        return f"VelocityEquation({rows}x{columns}, N={self.N}, n={self.n})"

    def _repr_latex_(self) -> str:
        return self.matrix._repr_latex_()


def loop_closure(mechanism: Mechanism, formulation: str = "auto") -> ConfigurationSpace:
    """The configuration variables, the loop equations I(q) = 0 and the feasible set Omega.

    >>> from singsym.mechanism import load
    >>> loop_closure(load("fourbar")).variables
    ('Bx', 'By', 'Cx', 'Cy')
    """
    return place(mechanism, formulation).space


def velocity_equation(mechanism: Mechanism, formulation: str = "auto") -> VelocityEquation:
    """L with its output rows first, then the twist equations of the loops; columns T, then the joints.

    formulation: "auto", or one of `formulations.FORMULATIONS`.
    Raises `MechanismError` for a mechanism that cannot be placed.

    >>> from singsym.mechanism import load
    >>> velocity_equation(load("zlatanov-2dof"))
    VelocityEquation(8x10, N=8, n=2)
    """
    placed = place(mechanism, formulation)
    ring = placed.space.ring
    joint_columns = list(mechanism.columns)
    labels = [f"T.{c}" for output in mechanism.outputs for c in _components(output)]
    if len(mechanism.outputs) > 1:
        labels = [f"T{i}.{c}" for i, output in enumerate(mechanism.outputs, 1) for c in _components(output)]
    width = len(labels) + len(joint_columns)
    place_of = {column: len(labels) + j for j, column in enumerate(joint_columns)}
    rows: list[list[Polynomial]] = []
    names: list[str] = []
    for output in mechanism.outputs:
        for component, entries in _output_rows(mechanism, placed, output):
            row = [ring.zero] * width
            row[len(rows)] = ring.one
            for column, entry in entries.items():
                row[place_of[column]] = row[place_of[column]] - entry
            rows.append(row)
            names.append(f"output {component}")
    for number, loop in enumerate(loops(mechanism), 1):
        block = [[ring.zero] * width for _ in _AXES[mechanism.space]]
        for joint, sign in loop:
            for column in joint.columns:
                for i, entry in enumerate(placed.screws[column]):
                    block[i][place_of[column]] = block[i][place_of[column]] + entry * sign
        rows += block
        names += [f"loop {number} {axis}" for axis in _AXES[mechanism.space]]
    for name, direction in placed.idle_spins:
        row = [ring.zero] * width
        for column, entry in zip(mechanism.joint(name).columns, direction, strict=True):
            row[place_of[column]] = entry
        rows.append(row)
        names.append(f"no idle spin at {name}")
    inputs = set(mechanism.inputs)
    columns = [Column(label, "output") for label in labels]
    columns += [Column(c, "input" if c in inputs else "passive") for c in joint_columns]
    matrix = PolynomialMatrix.of(ring, rows, width)
    return VelocityEquation(
        placed.space, matrix, tuple(columns), tuple(names), mechanism.N, mechanism.n, placed.values
    )


def _components(output: Output) -> tuple[str, ...]:
    return (output.column,) if isinstance(output, JointRate) else output.components


def _output_rows(
    mechanism: Mechanism, placed: Placement, output: Output
) -> list[tuple[str, dict[str, Polynomial]]]:
    """For each component of an output, what every joint rate contributes to it."""
    ring = placed.space.ring
    if isinstance(output, JointRate):
        return [(output.column, {output.column: ring.one})]
    twist = {}
    for joint, sign in path(mechanism, output.link):
        for column in joint.columns:
            twist[column] = tuple(e * sign for e in placed.screws[column])
    if mechanism.space is Space.SPHERICAL and not isinstance(output, PointVelocity):
        moved = twist
    else:
        moved = {c: _at(s, placed.link_points[output.link, output.point]) for c, s in twist.items()}
    if isinstance(output, PointVelocity):
        places = {axis: i - len(next(iter(moved.values()))) for i, axis in enumerate("xyz")}
        if mechanism.space is Space.PLANAR:
            places = {"x": 1, "y": 2}
        elif mechanism.space is Space.SPATIAL:
            places = {"x": 3, "y": 4, "z": 5}
        else:
            places = {"x": 0, "y": 1, "z": 2}
            point = placed.link_points[output.link, output.point]
            moved = {c: _cross(s, point) for c, s in twist.items()}
    else:
        places = {axis: i for i, axis in enumerate(_AXES[mechanism.space])}
    return [(name, {c: s[places[name]] for c, s in moved.items()}) for name in output.components]


def _cross(a: Sequence[Polynomial], b: Sequence[Polynomial]) -> Coordinates:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _at(screw: Coordinates, point: Coordinates) -> Coordinates:
    """The twist with its velocity at a point: v + w x r."""
    if len(screw) == 3:
        w, vx, vy = screw
        return (w, vx - w * point[1], vy + w * point[0])
    turned = _cross(screw[:3], point)
    return (*screw[:3], *(v + t for v, t in zip(screw[3:], turned, strict=True)))
