"""The velocity equation L m = 0 of a mechanism, and its submatrices L_I, L_O, L_p.

Source: Zlatanov, Fenton, Benhabib (1998), (1)-(3); an example is (6).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal

from singsym.kinematics.couplings import coupling_rows
from singsym.kinematics.formulations import place
from singsym.kinematics.loops import loops, path, point_path
from singsym.kinematics.placement import (
    Architecture,
    ConfigurationSpace,
    Coordinates,
    JointValue,
    PlacedJoint,
    Placement,
    cross,
)
from singsym.mechanism.model import Joint, JointRate, Mechanism, Output, PointVelocity, Space
from singsym.polynomials import Polynomial, PolynomialMatrix

if TYPE_CHECKING:
    from singsym.conditions.conditions import Conditions
    from singsym.polynomials.compiled_map import CompiledMap

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
    outputs: for each output column a name, as `C.x` or that of a joint, and the value whose rate it is; None
        where the formulation has no such coordinate, as of rotations of a link.
    architecture: which joints are between which links; None where only L is given.
    """

    space: ConfigurationSpace
    matrix: PolynomialMatrix
    columns: tuple[Column, ...]
    rows: tuple[str, ...]
    N: int
    n: int
    values: Mapping[str, JointValue] = field(default_factory=dict, compare=False)
    outputs: tuple[tuple[str, JointValue | None], ...] = field(default=(), compare=False)
    architecture: Architecture | None = field(default=None, compare=False)

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

    @cached_property
    def loop_rows(self) -> tuple[tuple[int, ...], ...]:
        """The places of the rows of each loop."""
        found: dict[str, list[int]] = {}
        for i, row in enumerate(self.rows):
            if row.startswith("loop "):
                found.setdefault(row.rpartition(" ")[0], []).append(i)
        return tuple(map(tuple, found.values()))

    @cached_property
    def compiled(self) -> CompiledMap:
        """The entries of L, row by row, as a map in doubles."""
        from singsym.polynomials.compiled_map import CompiledMap

        return CompiledMap([e for row in self.matrix.rows for e in row], self.space.ring)

    @cached_property
    def compiled_points(self) -> CompiledMap:
        """The coordinates of the named points, one point after the other, as a map in doubles."""
        from singsym.polynomials.compiled_map import CompiledMap

        return CompiledMap([p for place in self.space.points.values() for p in place], self.space.ring)

    @cached_property
    def compiled_loops(self) -> CompiledMap:
        """The loop equations and the relations of the ring's constants, as a map in doubles."""
        from singsym.polynomials.compiled_map import CompiledMap

        return CompiledMap((*self.space.equations, *self.space.ring.relations), self.space.ring)

    @cached_property
    def conditions(self) -> Conditions:
        """Conditions (4), (5) and (i)-(viii), factored: see `singsym.conditions`."""
        from singsym.conditions.conditions import conditions

        return conditions(self)

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
    """L with its output rows first, then the twists of the loops, then couplings; columns T, then the joints.

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
    for name, coefficients in coupling_rows(mechanism, placed):
        row = [ring.zero] * width
        for column, entry in coefficients.items():
            row[place_of[column]] = entry
        rows.append(row)
        names.append(name)
    inputs = set(mechanism.inputs)
    columns = [Column(label, "output") for label in labels]
    columns += [Column(c, "input" if c in inputs else "passive") for c in joint_columns]
    matrix = PolynomialMatrix.of(ring, [[ring.reduced(e) for e in row] for row in rows], width)
    return VelocityEquation(
        placed.space,
        matrix,
        tuple(columns),
        tuple(names),
        mechanism.N,
        mechanism.n,
        placed.values,
        tuple(_output_values(mechanism, placed)),
        _architecture(mechanism, placed),
    )


def _architecture(mechanism: Mechanism, placed: Placement) -> Architecture:
    """The joints between the links, and what is moved where that is one link."""
    space, idle = placed.space, dict(placed.idle_spins)
    joints = tuple(
        PlacedJoint(
            joint.name,
            joint.first,
            joint.second,
            tuple(dict.fromkeys(name for name in joint.at if name in space.points)),
            tuple(dict.fromkeys(name for name in joint.axes or () if name in space.directions)),
            joint.columns,
            tuple(placed.screws[column] for column in joint.columns),
            idle.get(joint.name),
        )
        for joint in mechanism.joints
    )
    moved, point = "", ""
    if len(mechanism.outputs) == 1 and not isinstance(output := mechanism.outputs[0], JointRate):
        moved, point = output.link, output.point if output.point in space.points else ""
    return Architecture(mechanism.ground, joints, moved, point, bool(mechanism.couplings))


def _components(output: Output) -> tuple[str, ...]:
    return (output.column,) if isinstance(output, JointRate) else output.components


def _output_values(mechanism: Mechanism, placed: Placement) -> Iterator[tuple[str, JointValue | None]]:
    """What each component of an output is the rate of."""
    for output in mechanism.outputs:
        if isinstance(output, JointRate):
            yield output.column, placed.values.get(output.column)
            continue
        own = dict(zip("xyz", placed.link_points.get((output.link, output.point), ()), strict=False))
        for component in output.components:
            axis = component.removeprefix("v")
            value = JointValue(length=own[axis]) if axis in own else None
            yield f"{output.point}.{axis}" if value else f"{output.link}.{component}", value


def _output_rows(
    mechanism: Mechanism, placed: Placement, output: Output
) -> list[tuple[str, dict[str, Polynomial]]]:
    """For each component of an output, what every joint rate contributes to it."""
    ring = placed.space.ring
    if isinstance(output, JointRate):
        return [(output.column, {output.column: ring.one})]
    twist = {
        column: tuple(e * sign for e in placed.screws[column])
        for joint, sign in output_path(mechanism, output)
        for column in joint.columns
    }
    names = _AXES[mechanism.space]
    wanted = [f"v{c}" if isinstance(output, PointVelocity) else c for c in output.components]
    if any(c.startswith("v") for c in wanted):
        arm = _arm(mechanism, placed, output.link, output.point)
        names = names if "vx" in names else (*names, "vx", "vy", "vz")
        twist = {column: _at(screw, arm, mechanism.space) for column, screw in twist.items()}
    places = [names.index(c) for c in wanted]
    return [
        (component, {column: screw[i] for column, screw in twist.items()})
        for component, i in zip(output.components, places, strict=True)
    ]


def output_path(mechanism: Mechanism, output: Output) -> tuple[tuple[Joint, int], ...]:
    """The joints from the ground to what an output moves, with the sign of each; none for a joint's rate."""
    if isinstance(output, JointRate):
        return ()
    if isinstance(output, PointVelocity) and mechanism.space is not Space.SPHERICAL:
        return tuple(point_path(mechanism, output.link, output.point))
    return tuple(path(mechanism, output.link))


def _arm(mechanism: Mechanism, placed: Placement, link: str, point: str) -> Coordinates:
    """The output's point, seen from the fixed origin; in a spherical mechanism from where the axes meet."""
    if (link, point) not in placed.link_points:
        known = ", ".join(sorted(name for owner, name in placed.link_points if owner == link))
        raise ValueError(
            f"output: point {point!r} of link {link!r} is not placed; placed are: {known or 'none'}"
        )
    place = placed.link_points[link, point]
    if mechanism.space is not Space.SPHERICAL:
        return place
    ends = ((j.first, j.at[0], j.second, j.at[1]) for j in mechanism.joints)
    centre = next(
        (
            placed.link_points[end]
            for a, p, b, q in ends
            for end in ((a, p), (b, q))
            if end in placed.link_points
        ),
        (placed.space.ring.zero,) * 3,
    )
    return tuple(x - c for x, c in zip(place, centre, strict=True))


def _at(screw: Coordinates, point: Coordinates, space: Space) -> Coordinates:
    """The twist with its velocity at a point: v + w x r."""
    if space is Space.PLANAR:
        w, vx, vy = screw
        return (w, vx - w * point[1], vy + w * point[0])
    turned = cross(screw[:3], point)
    if space is Space.SPHERICAL:
        return (*screw, *turned)
    return (*screw[:3], *(v + t for v, t in zip(screw[3:], turned, strict=True)))
