"""A mechanism as data: links, joints, inputs, outputs, parameters, exclusions and couplings.

Source: Zlatanov, Fenton, Benhabib (1998), section 2; the data model is singsym's own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from typing import Any

import networkx
import sympy

from singsym.mechanism.expressions import expression, oversize
from singsym.mechanism.problems import MechanismError, Problem

Vector = tuple[sympy.Expr, ...]


class Space(StrEnum):
    """Where a mechanism moves."""

    PLANAR = "planar"
    SPHERICAL = "spherical"
    SPATIAL = "spatial"


class JointKind(StrEnum):
    """The lower pairs and the universal joint, with the names of their freedoms in column order.

    >>> JointKind.C.freedoms
    ('angle', 'slide')
    """

    R = "R"
    P = "P"
    H = "H"
    C = "C"
    U = "U"
    S = "S"
    E = "E"

    @property
    def freedoms(self) -> tuple[str, ...]:
        """R, H: a rotation; P: a slide; C: both; U: about its two axes; S: about x, y, z; E: x, y, angle."""
        return {
            "R": ("angle",),
            "P": ("slide",),
            "H": ("angle",),
            "C": ("angle", "slide"),
            "U": ("angle1", "angle2"),
            "S": ("x", "y", "z"),
            "E": ("x", "y", "angle"),
        }[self.value]


@dataclass(frozen=True)
class Link:
    """A rigid body: points and directions named in its own frame (2 coordinates planar, 3 spatial).

    The ground's frame is the fixed frame.  The same point name in several links is the same point of
    space only where a joint says so.
    """

    name: str
    points: Mapping[str, Vector]
    axes: Mapping[str, Vector]


@dataclass(frozen=True)
class Joint:
    """A joint between two links, `first` nearer the ground where there is a choice.

    at: the name, in each of the two links, of the joint's point.  R, H, C: a point on the axis;
        P: the sliding point of `second`, on the line through `first`'s point along the axis.
    axes: the name, in each link, of the joint's direction: R, P, H, C the axis (the same direction of
        space in both); U the first axis in `first` and the second in `second`, at right angles;
        E the normal; S and planar R none.
    pitch: H only, length per radian.
    reference: R, H, C: an axis of each link, at right angles to the joint's, that coincide at angle zero;
        None: angle zero is where the two links' frames are as parallel as the joint allows.
    Joints P and E keep the rotation that they forbid as it is where the two links' frames are parallel, or as
    near to that as the axis, being one direction of space, allows.
    """

    name: str
    kind: JointKind
    first: str
    second: str
    at: tuple[str, str]
    axes: tuple[str, str] | None = None
    pitch: sympy.Expr | None = None
    reference: tuple[str, str] | None = None

    @property
    def columns(self) -> tuple[str, ...]:
        """Labels of its columns in L: the joint's name, with the freedom where it has several.

        >>> Joint("A", JointKind.R, "ground", "crank", ("A", "A")).columns
        ('A',)
        >>> Joint("B", JointKind.S, "ground", "crank", ("B", "B")).columns
        ('B.x', 'B.y', 'B.z')
        """
        freedoms = self.kind.freedoms
        return (self.name,) if len(freedoms) == 1 else tuple(f"{self.name}.{f}" for f in freedoms)


@dataclass(frozen=True)
class Parameter:
    """A named dimension: a value, or an open range (None: unbounded) in which it is kept symbolic."""

    name: str
    value: sympy.Expr | None = None
    low: sympy.Expr | None = None
    high: sympy.Expr | None = None


@dataclass(frozen=True)
class Twist:
    """Output: components of a link's twist, of `wx wy wz vx vy vz` (planar `w vx vy`).

    The velocity is that of the link's point `point`.  All components are the full twist.
    """

    link: str
    point: str
    components: tuple[str, ...]


@dataclass(frozen=True)
class PointVelocity:
    """Output: components `x y z` of the velocity of a link's point."""

    link: str
    point: str
    components: tuple[str, ...]


@dataclass(frozen=True)
class JointRate:
    """Output: the rate of one freedom, by its column label (`A` or `A.slide`)."""

    column: str


Output = Twist | PointVelocity | JointRate


@dataclass(frozen=True)
class Limit:
    """Joint limits or a bound on a named expression: low <= expression <= high (None: unbounded).

    expression: SymPy, polynomial in the symbols `A.x` (a coordinate of a named point), `cos(A)`, `sin(A)`
        (of a joint's angle), `length(P)` (of its slide) and the parameters, which `kinematics` replaces.
    """

    expression: sympy.Expr
    low: sympy.Expr | None = None
    high: sympy.Expr | None = None


@dataclass(frozen=True)
class Exclusion:
    """A part of configuration space that is taken out: where two named points of space coincide (`kind`
    "coincide", "leg folded"), or where an expression vanishes ("zero")."""

    kind: str
    points: tuple[str, ...] = ()
    expression: sympy.Expr | None = None
    words: str = ""


@dataclass(frozen=True)
class Coupling:
    """Gears, a belt, a differential, a rack, a cam: a sum of multiples of joint rates that is zero.

    terms: column label and rational coefficient; of turns beside slides that of a turn is a length.
    constant: the same sum of the joints' values, an angle in radians, modulo full turns of each, or a length;
        None for turns beside slides, which may be mounted in any way.
    lift: of a cam, the length of its follower, a slide, as a polynomial in the symbols cos(A) and sin(A) of a
        turn A, or length(P) of another slide; the terms then are 1 and minus its derivative.
    """

    name: str
    terms: tuple[tuple[str, sympy.Expr], ...]
    constant: sympy.Expr | None = sympy.S.Zero
    lift: sympy.Expr | None = None

    @classmethod
    def cam(cls, name: str, follower: str, driver: str, lift: sympy.Expr) -> Coupling:
        """The coupling in which a slide has a length that depends on the value of another freedom.

        >>> Coupling.cam("cam", "P", "A", 3 + 2 * sympy.Symbol("cos(A)")).terms
        (('P', 1), ('A', 2*sin(A)))
        """
        cosine, sine, length = (sympy.Symbol(f"{of}({driver})") for of in ("cos", "sin", "length"))
        slope = lift.diff(sine) * cosine - lift.diff(cosine) * sine + lift.diff(length)
        return cls(name, ((follower, sympy.S.One), (driver, -sympy.expand(slope))), lift=lift)

    @property
    def relation(self) -> str:
        """What holds of the joints' values, as text.

        >>> Coupling("gears", (("A", sympy.Rational(3, 2)), ("B.angle", sympy.S.One)), sympy.pi / 6).relation
        '3*A/2 + B.angle = pi/6'
        """
        if self.lift is not None:
            return f"{self.terms[0][0]} = {self.lift}"
        total = sympy.Add(*(number * sympy.Symbol(column) for column, number in self.terms))
        return f"{total} {'constant' if self.constant is None else f'= {self.constant}'}"


@dataclass(frozen=True)
class Mechanism:
    """A mechanism, its dimensions, inputs and outputs; nothing is computed on construction.

    inputs: column labels of the active freedoms (`Joint.columns`).
    mobility: n as stated by the author, or None to take the number of inputs.
    translating: links that keep the ground's orientation in all configurations to be looked at: of a
        mechanism with several modes of motion only that one.
    formulation: "auto", "planar", "joint" or "natural", see `kinematics`.
    source: where it is published; origin: the file it was read from.
    """

    name: str
    space: Space
    ground: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    inputs: tuple[str, ...]
    outputs: tuple[Output, ...]
    parameters: tuple[Parameter, ...] = ()
    limits: tuple[Limit, ...] = ()
    exclusions: tuple[Exclusion, ...] = ()
    couplings: tuple[Coupling, ...] = ()
    mobility: int | None = None
    translating: tuple[str, ...] = ()
    formulation: str = "auto"
    title: str = ""
    description: str = ""
    source: str = ""
    origin: str = ""

    def __repr__(self) -> str:
        return f"Mechanism({self.name!r}, {len(self.links)} links, {len(self.joints)} joints)"

    def link(self, name: str) -> Link:
        """The link of this name; raises `KeyError`."""
        return next(link for link in self.links if link.name == name)

    def joint(self, name: str) -> Joint:
        """The joint of this name; raises `KeyError`."""
        return next(joint for joint in self.joints if joint.name == name)

    @cached_property
    def graph(self) -> networkx.MultiGraph:
        """Links as nodes, joints as edges keyed by joint name, each edge with its `Joint` as data `joint`."""
        graph = networkx.MultiGraph()
        graph.add_nodes_from(link.name for link in self.links)
        for joint in self.joints:
            graph.add_edge(joint.first, joint.second, key=joint.name, joint=joint)
        return graph

    @property
    def columns(self) -> tuple[str, ...]:
        """The labels of all joint freedoms, in order: the columns of L after the output's."""
        return tuple(c for joint in self.joints for c in joint.columns)

    @property
    def N(self) -> int:
        """The number of 1-DOF joints, each freedom counted."""
        return len(self.columns)

    @property
    def output_size(self) -> int:
        """The number of components of all outputs."""
        return sum(1 if isinstance(o, JointRate) else len(o.components) for o in self.outputs)

    @property
    def n(self) -> int:
        """The mobility."""
        return len(self.inputs) if self.mobility is None else self.mobility

    def with_parameters(self, **values: Any) -> Mechanism:
        """The same mechanism with parameters set: numbers, text in the file's grammar, SymPy expressions.

        None takes a value away, so that the parameter stays symbolic within its range.  A range is kept,
        for `check` to compare.  Raises `MechanismError` for an unknown name.

        >>> from singsym.mechanism import load
        >>> load("2r").with_parameters(l1="3/2", l2=None).resolved.parameters
        (Parameter(name='l2', value=None, low=0, high=None),)
        """
        names = {parameter.name for parameter in self.parameters}
        unknown = [name for name in values if name not in names]
        if unknown:
            none = "nothing, as it has no parameters; a dimension is one by [parameters] a = 2 and AB = 'a'"
            known = f"one of {', '.join(sorted(names))}" if names else none
            raise MechanismError(Problem("parameters", name, known, file=self.origin) for name in unknown)
        read = {
            name: None if v is None else expression(v, names, place=f"parameters.{name}", file=self.origin)
            for name, v in values.items()
        }
        changed = tuple(replace(p, value=read.get(p.name, p.value)) for p in self.parameters)
        return replace(self, parameters=changed)

    @cached_property
    def values(self) -> dict[sympy.Symbol, sympy.Expr]:
        """The parameters' values, each with the others put in.

        Raises `MechanismError` where they are defined by each other in a circle.
        """
        names = {p.name for p in self.parameters}
        given = {
            sympy.Symbol(p.name): expression(p.value, names, place=f"parameters.{p.name}", file=self.origin)
            for p in self.parameters
            if p.value is not None
        }
        order = TopologicalSorter({name: value.free_symbols & given.keys() for name, value in given.items()})
        values: dict[sympy.Symbol, sympy.Expr] = {}
        try:
            for name in order.static_order():
                values[name] = given[name].xreplace(values)
                if fault := oversize(values[name]):
                    raise MechanismError([Problem(f"parameters.{name}", *fault, file=self.origin)])
        except CycleError as error:
            found = ", ".join(sorted({str(name) for name in error.args[1]}))
            expected = "values that do not depend on each other in a circle"
            raise MechanismError([Problem("parameters", found, expected, file=self.origin)]) from None
        return values

    @cached_property
    def resolved(self) -> Mechanism:
        """The same mechanism with every parameter that has a value replaced by it: kinematics starts here.

        Dimensions given as numbers, Fractions or text in the file's grammar are SymPy expressions in it.
        """
        return self._put(self.values)

    def _put(self, values: Mapping[sympy.Symbol, sympy.Expr]) -> Mechanism:
        """Every dimension as a SymPy expression, with these values put in; parameters with a value go."""
        names = {p.name for p in self.parameters}

        def put(value: Any, place: str = "") -> sympy.Expr | None:
            if value is None:
                return None
            return expression(value, names, place=place, file=self.origin).xreplace(values)

        def vectors(named: Mapping[str, Vector], place: str) -> dict[str, Vector]:
            return {name: tuple(put(x, f"{place}.{name}") for x in v) for name, v in named.items()}

        return replace(
            self,
            links=tuple(
                Link(k.name, vectors(k.points, f"links.{k.name}"), vectors(k.axes, f"links.{k.name}"))
                for k in self.links
            ),
            joints=tuple(replace(j, pitch=put(j.pitch, f"joints.{j.name}.pitch")) for j in self.joints),
            parameters=tuple(
                replace(p, low=put(p.low), high=put(p.high)) for p in self.parameters if p.value is None
            ),
            limits=tuple(Limit(t.expression.xreplace(values), put(t.low), put(t.high)) for t in self.limits),
            exclusions=tuple(replace(e, expression=put(e.expression)) for e in self.exclusions),
            couplings=tuple(
                Coupling(
                    c.name,
                    tuple((column, put(x, f"couplings.{c.name}")) for column, x in c.terms),
                    put(c.constant, f"couplings.{c.name}"),
                    put(c.lift),
                )
                for c in self.couplings
            ),
        )
