"""The spanning tree of a mechanism's links from the ground, with the variables of its joints.

Source: singsym's own; absolute angles along runs of parallel axes keep the degrees of closed chains low.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.angle_origins import Origin, simplest_origin
from singsym.kinematics.formulations.frames import Algebra, Body, composed, minus, plus, rigid, turned
from singsym.kinematics.placement import Coordinates, JointValue
from singsym.mechanism.model import Joint, JointKind, Mechanism
from singsym.polynomials import Polynomial
from singsym.polynomials.unit_circles import circle

_ROTATIONS = {JointKind.R: 1, JointKind.H: 1, JointKind.C: 1, JointKind.U: 2, JointKind.E: 1}
_LENGTHS = {JointKind.P: 1, JointKind.H: 1, JointKind.C: 1, JointKind.E: 2}
_SINGLE = (JointKind.R, JointKind.C)
_COUNTED_ELSEWHERE = "o"
"""Ends the names of variables of angles that are not counted from the joint's own zero."""


@dataclass(frozen=True)
class Turn:
    """A rotation by a variable angle about `axis`, then by the constant `after`.

    name: of its angle (variables c_name, s_name).  sense: 0 for an angle relative to the parent; 1 or -1
    where the angle is counted from the start of a run of parallel axes, to which the joint adds or subtracts.
    """

    axis: local.Vector
    origin: Origin
    name: str
    sense: int

    @property
    def after(self) -> local.Matrix:
        """The constant rotation that follows."""
        return self.origin.after

    @property
    def variables(self) -> tuple[str, str]:
        """Names of the cosine and sine: c1, s1 for a numbered angle, else c_A, s_A."""
        joiner = "" if self.name[0].isdigit() else "_"
        return f"c{joiner}{self.name}", f"s{joiner}{self.name}"


@dataclass(frozen=True)
class Step:
    """A joint of the tree, from `parent` to `child`; `forward` if parent is the joint's `first`."""

    joint: Joint
    parent: str
    child: str
    forward: bool
    turns: tuple[Turn, ...]
    lengths: tuple[str, ...]

    @property
    def variables(self) -> tuple[str, ...]:
        """The names of the variables of the joint."""
        return (*(v for turn in self.turns for v in turn.variables), *self.lengths)


@dataclass(frozen=True)
class Run:
    """A run of parallel axes that ends in a link: its axis there, and the joints it has added up."""

    axis: local.Vector
    terms: tuple[tuple[int, str], ...]


def spanning_steps(mechanism: Mechanism) -> list[tuple[Joint, str, str]]:
    """(joint, parent, child), breadth first from the ground and never across a spherical joint.

    Breadth first cuts every loop in its middle; of joints that reach a link equally early the one with fewest
    freedoms is taken.  Links that only translate have their own place, from which what is left is reached.
    """
    reached, level = {mechanism.ground, *mechanism.translating}, [mechanism.ground]
    later = list(mechanism.translating)
    rank = {joint.name: i for i, joint in enumerate(mechanism.joints)}
    steps: list[tuple[Joint, str, str]] = []
    while level:
        edges = [
            (joint, link, other)
            for link in level
            for _, other, joint in mechanism.graph.edges(link, data="joint")
            if joint.kind is not JointKind.S and other not in reached
        ]
        edges.sort(key=lambda edge: (len(edge[0].kind.freedoms), rank[edge[0].name]))
        level = []
        for joint, link, other in edges:
            if other not in reached:
                reached.add(other)
                level.append(other)
                steps.append((joint, link, other))
        if not level:
            level, later = later, []
    return steps


def by_branch(steps: Iterable[Step]) -> list[Step]:
    """The tree's steps, each branch from the ground (a leg) in one piece."""
    branch: dict[str, int] = {}
    ordered = list(steps)
    for step in ordered:
        branch[step.child] = branch.get(step.parent, len(branch))
    return sorted(ordered, key=lambda step: branch[step.child])


def plan(
    mechanism: Mechanism, geometry: local.Geometry, tree: Iterable[tuple[Joint, str, str]], absolute: bool
) -> list[Step]:
    """The tree's joints with their turns and variables.

    absolute: count the angles of parallel axes from the start of their run.
    """
    stems = _stems(mechanism)
    runs: dict[str, Run] = {}
    used: set[str] = set()
    steps = []
    for joint, parent, child in tree:
        forward = joint.first == parent
        run = runs.get(parent)
        turns = []
        after = local.IDENTITY
        for axis, constant, suffix in _rotations(joint, geometry, forward):
            origin = Origin(constant)
            sense = local.parallel(run.axis, axis) if run is not None and absolute else 0
            if run is None or sense == 0:
                if joint.kind in _SINGLE:
                    sides = (geometry.directions(link, joint) for link in (parent, child))
                    origin = simplest_origin(axis, constant, *sides)
                own = suffix if origin.is_own else suffix + _COUNTED_ELSEWHERE
                terms: tuple[tuple[int, str], ...] = ((1, stems[joint.name] + own),)
                run = Run(axis, terms)
            else:
                terms = (*run.terms, (sense, stems[joint.name] + suffix))
                run = Run(run.axis, terms)
            name = _sum_name(terms, child)
            while name in used:
                name += "_"
            used.add(name)
            turns.append(Turn(axis, origin, name, sense))
            run = Run(local.apply(local.transpose(origin.after), run.axis), run.terms)
        if not turns and run is not None:
            after = slide_frame(joint, geometry, forward)
            run = Run(local.apply(local.transpose(after), run.axis), run.terms)
        if run is not None:
            runs[child] = run
        lengths = _lengths(joint, stems[joint.name])
        steps.append(Step(joint, parent, child, forward, tuple(turns), lengths))
    return steps


def slide_frame(joint: Joint, geometry: local.Geometry, forward: bool) -> local.Matrix:
    """The constant rotation from parent to child across a P joint."""
    zero = geometry.zero(joint)
    return zero if forward else local.transpose(zero)


def _rotations(
    joint: Joint, geometry: local.Geometry, forward: bool
) -> list[tuple[local.Vector, local.Matrix, str]]:
    """(axis before the turn, constant rotation after it, suffix of the name) for each angle."""
    if joint.kind not in _ROTATIONS:
        return []
    u, v = geometry.axes(joint)
    zero = geometry.zero(joint)
    if joint.kind is JointKind.U:
        if forward:
            return [(u, zero, "a"), (v, local.IDENTITY, "b")]
        return [(local.times(-1, v), local.transpose(zero), "b"), (local.times(-1, u), local.IDENTITY, "a")]
    if forward:
        return [(u, zero, "")]
    return [(local.times(-1, v), local.transpose(zero), "")]


def _lengths(joint: Joint, stem: str) -> tuple[str, ...]:
    count = _LENGTHS.get(joint.kind, 0)
    if count == 2:
        return (f"x_{stem}", f"y_{stem}")
    joiner = "" if stem[0].isdigit() else "_"
    return (f"d{joiner}{stem}",) * count


def _stems(mechanism: Mechanism) -> dict[str, str]:
    """What follows c and s in the names: the joint's name, or its number where all are J1, J2, ..."""
    names = [joint.name for joint in mechanism.joints]
    numbered = [re.fullmatch(r"(?:[A-Za-z]+_?)?([0-9]+)", name) for name in names]
    if all(numbered) and len({name.rstrip("0123456789") for name in names}) == 1:
        return {match[0]: match[1] for match in numbered if match}
    return {name: re.sub(r"\W", "_", name) for name in names}


def _sum_name(terms: tuple[tuple[int, str], ...], child: str) -> str:
    """A name for a sum of angles: 23 for 2 + 3, A23 for A2 + A3; else after the link."""
    if len(terms) == 1:
        return terms[0][1]
    parts = [re.fullmatch(r"([A-Za-z_]*)([0-9]+)", stem) for _, stem in terms]
    prefixes = {part[1] for part in parts if part}
    if all(parts) and len(prefixes) == 1:
        digits = [
            ("" if i == 0 or sign > 0 else "m") + part[2]
            for i, ((sign, _), part) in enumerate(zip(terms, parts, strict=True))
            if part
        ]
        return prefixes.pop() + "".join(digits)
    return re.sub(r"\W", "_", child)


@dataclass(frozen=True)
class Grown:
    """The bodies that the tree places, with the circles of its angles and its joints' values."""

    bodies: dict[str, Body]
    circles: tuple[Polynomial, ...]
    values: dict[str, JointValue]


@dataclass(frozen=True)
class _Base:
    """Where a run of parallel axes starts: R = frame * Rot(axis, angle) * after."""

    frame: tuple[Coordinates, ...]
    axis: local.Vector
    cosine: Polynomial
    sine: Polynomial
    after: local.Matrix


def grow(geometry: local.Geometry, algebra: Algebra, roots: dict[str, Body], steps: Iterable[Step]) -> Grown:
    """Place every link of the tree, starting from placed roots."""
    bodies = dict(roots)
    bases: dict[str, _Base] = {}
    circles: list[Polynomial] = []
    values: dict[str, JointValue] = {}
    for step in steps:
        parent = bodies[step.parent]
        frame, base = parent.frame, bases.get(step.parent)
        angles = []
        for turn in step.turns:
            c, s = algebra.variables(turn.variables)
            circles.append(circle(c, s))
            if turn.sense and base is not None:
                angles.append(_difference(c, s, base, turn.sense))
                base = _Base(base.frame, base.axis, c, s, local.product(base.after, turn.after))
            else:
                angles.append(_own_angle(algebra, c, s, turn.origin))
                base = _Base(frame, turn.axis, c, s, turn.after)
            frame = composed(algebra, turned(algebra, base.frame, base.axis, c, s), base.after)
        if not step.turns:
            after = slide_frame(step.joint, geometry, step.forward)
            frame = composed(algebra, frame, after)
            if base is not None:
                base = _Base(base.frame, base.axis, base.cosine, base.sine, local.product(base.after, after))
        lengths = algebra.variables(step.lengths)
        bodies[step.child] = _child(geometry, step, parent, frame, lengths)
        if base is not None:
            bases[step.child] = base
        order = angles if step.forward else angles[::-1]
        values |= _values(step.joint, order, lengths)
    return Grown(bodies, tuple(circles), values)


def _child(
    geometry: local.Geometry,
    step: Step,
    parent: Body,
    frame: tuple[Coordinates, ...],
    lengths: Coordinates,
) -> Body:
    """The child with this frame, placed so that the joint's points are where they belong."""
    algebra, joint = parent.algebra, step.joint
    inner = geometry.points(joint)
    here, there = inner if step.forward else inner[::-1]
    position = parent.point(here)
    turned_child = rigid(algebra, algebra.origin, frame)
    if lengths:
        first = parent if step.forward else turned_child
        u = geometry.axes(joint)[0]
        along = local.perpendiculars(u) if joint.kind is JointKind.E else (u,)
        shift = algebra.combination(lengths, [first.direction(d) for d in along])
        sign = 1 if step.forward else -1
        position = plus(position, tuple(sign * x for x in shift))
    offset = turned_child.direction(there)
    return rigid(algebra, tuple(map(algebra.ring.reduced, minus(position, offset))), frame)


def _own_angle(algebra: Algebra, cosine: Polynomial, sine: Polynomial, origin: Origin) -> JointValue:
    """The joint's own angle from one that is counted elsewhere."""
    if origin.is_own:
        return JointValue(cosine, sine, algebra.ring.one)
    c, s = algebra.number(origin.cosine), algebra.number(origin.sine)
    own = (cosine * c - sine * s, sine * c + cosine * s)
    return JointValue(algebra.ring.reduced(own[0]), algebra.ring.reduced(own[1]), algebra.ring.one)


def _difference(cosine: Polynomial, sine: Polynomial, base: _Base, sense: int) -> JointValue:
    """The joint's own angle from the absolute ones after and before it."""
    c = cosine * base.cosine + sine * base.sine
    s = sine * base.cosine - cosine * base.sine
    return JointValue(c, sense * s, cosine.ring.one)


def _values(joint: Joint, angles: list[JointValue], lengths: Coordinates) -> dict[str, JointValue]:
    slides = [JointValue(length=length) for length in lengths]
    if joint.kind is JointKind.H:
        return {joint.name: angles[0]}
    ordered = slides + angles if joint.kind is JointKind.E else angles + slides
    return dict(zip(joint.columns, ordered, strict=True))
