"""A mechanism at one configuration as numbers: where links and joints are, and how fast points move.

Source: twists of links are sums of joint screws, as in (6) of Zlatanov, Fenton, Benhabib (1998).
Numbers here are for drawing; nothing is concluded from them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from singsym.kinematics.formulations import place
from singsym.kinematics.loops import path
from singsym.kinematics.placement import Placement
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism.model import Joint, JointKind, JointRate, Mechanism, Space
from singsym.output.figures.style import Floats
from singsym.polynomials import Polynomial
from singsym.polynomials.compiled_map import CompiledMap


@dataclass(frozen=True, eq=False)
class Body:
    """A link: the places of those of its points that joints and outputs use; `held`: those of joints."""

    name: str
    points: Mapping[str, Floats]
    held: frozenset[str]
    ground: bool
    output: bool

    @property
    def places(self) -> Floats:
        """Its corners: the joints' points that lie apart, or all points where that is one; one a row."""
        corners = distinct(p for name, p in self.points.items() if name in self.held)
        return corners if len(corners) > 1 else distinct(self.points.values())

    @property
    def is_plate(self) -> bool:
        """Whether its corners are not all on a line."""
        places = self.places
        if len(places) < 3:
            return False
        singular = np.linalg.svd(places - places.mean(axis=0), compute_uv=False)
        return bool(singular[1] > 1e-6 * singular[0])

    @property
    def outline(self) -> Floats:
        """Its corners in the order of their angles about the middle, seen along the normal of a plate."""
        places = self.places
        if len(places) < 3:
            return places
        arms = places - places.mean(axis=0)
        u, v = np.linalg.svd(arms)[2][:2]
        ordered: Floats = places[np.argsort(np.arctan2(arms @ v, arms @ u))]
        return ordered


@dataclass(frozen=True, eq=False)
class Mark:
    """A joint: its place, the directions of its axes or slide (none for pins of the plane), its role.

    base: the point of the first link; they differ where something slides.
    """

    joint: Joint
    place: Floats
    base: Floats
    axes: tuple[Floats, ...]
    active: bool
    output: bool
    grounded: bool

    @property
    def links(self) -> tuple[str, str]:
        """The links that it joins."""
        return self.joint.first, self.joint.second

    @property
    def direction(self) -> Floats | None:
        """The first of its axes."""
        return self.axes[0] if self.axes else None


@dataclass(frozen=True, eq=False)
class Scene:
    """What is drawn: bodies, joints, names of points, output points, and the size of it all."""

    space: Space
    bodies: tuple[Body, ...]
    marks: tuple[Mark, ...]
    names: Mapping[str, Floats]
    outputs: tuple[Floats, ...]

    @cached_property
    def all_points(self) -> Floats:
        """Every point, one a row."""
        found = [p for body in self.bodies for p in body.points.values()]
        found += [m.place for m in self.marks] + list(self.names.values())
        return np.array(found)

    @property
    def size(self) -> float:
        """The largest extent, 1 for a single point."""
        extent = float(np.ptp(self.all_points, axis=0).max())
        return extent if extent > 1e-9 else 1.0

    def lines(self) -> list[Floats]:
        """Links and slides as lines through places, closed where a link is a plate; the ground left out."""
        found = [
            np.concatenate([b.outline, b.outline[:1]]) if b.is_plate else b.places
            for b in self.bodies
            if not b.ground and len(b.points) > 1
        ]
        return found + [np.array([m.base, m.place]) for m in self.marks if m.joint.kind is JointKind.P]

    def mapped(self, linear: Callable[[Floats], Floats]) -> Scene:
        """The scene with a linear map applied to every place and direction."""

        def all_of(places: Mapping[str, Floats]) -> dict[str, Floats]:
            return {name: linear(place) for name, place in places.items()}

        return replace(
            self,
            bodies=tuple(replace(body, points=all_of(body.points)) for body in self.bodies),
            marks=tuple(
                replace(m, place=linear(m.place), base=linear(m.base), axes=tuple(map(linear, m.axes)))
                for m in self.marks
            ),
            names=all_of(self.names),
            outputs=tuple(map(linear, self.outputs)),
        )


def openness(points: Floats) -> float:
    """How far points lie from one another, for their extent: the mean logarithm of their distances."""
    extent = float(np.ptp(points, axis=0).max())
    if extent < 1e-9:
        return -np.inf
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)[np.triu_indices(len(points), 1)]
    return float(np.log(np.maximum(apart / extent, 0.02)).mean())


def distinct(places: object, tolerance: float = 1e-7) -> Floats:
    """Points without repetitions, one a row."""
    kept: list[Floats] = []
    for p in list(places):  # type: ignore[call-overload]
        if all(float(np.abs(p - q).max()) > tolerance for q in kept):
            kept.append(p)
    return np.array(kept)


@dataclass(frozen=True, eq=False)
class Stage:
    """A mechanism compiled for drawing at many configurations.

    equation: its velocity equation, which fixes the configuration variables.

    >>> from singsym.mechanism import load
    >>> stage = Stage.of(load("slider-crank"))
    >>> stage.scene(np.zeros(len(stage.equation.space.ring.names))).bodies[0].name
    'ground'
    """

    mechanism: Mechanism
    equation: VelocityEquation = field(repr=False)

    @classmethod
    def of(cls, mechanism: Mechanism, equation: VelocityEquation | None = None) -> Stage:
        """For a mechanism, with its velocity equation where it is known already."""
        return cls(mechanism, velocity_equation(mechanism) if equation is None else equation)

    @cached_property
    def placement(self) -> Placement:
        """The placement in the formulation of the velocity equation."""
        return place(self.mechanism, self.equation.space.formulation or "auto")

    @cached_property
    def _held(self) -> set[tuple[str, str]]:
        """The link points at joints."""
        ends = [((j.first, j.at[0]), (j.second, j.at[1])) for j in self.mechanism.joints]
        return {end for pair in ends for end in pair}

    @cached_property
    def _used(self) -> dict[tuple[str, str], tuple[Polynomial, ...]]:
        """The link points that joints and outputs use."""
        wanted = self._held | {
            (o.link, o.point) for o in self.mechanism.outputs if not isinstance(o, JointRate)
        }
        return {key: place for key, place in self.placement.link_points.items() if key in wanted}

    @cached_property
    def _columns(self) -> tuple[str, ...]:
        return tuple(self.placement.screws)

    @cached_property
    def _places(self) -> CompiledMap:
        entries = [c for place in self._used.values() for c in place]
        entries += [c for place in self.placement.space.points.values() for c in place]
        return CompiledMap(entries, self.placement.space.ring)

    @cached_property
    def _screws(self) -> CompiledMap:
        entries = [c for screw in self.placement.screws.values() for c in screw]
        return CompiledMap(entries, self.placement.space.ring)

    def vector(self, coordinates: Mapping[str, str | float]) -> Floats:
        """Named coordinates in the order of the ring; raises `ValueError` naming those that are missing."""
        names = self.placement.space.ring.names
        missing = [name for name in names if name not in coordinates]
        if missing:
            raise ValueError(f"coordinates of {', '.join(missing)} are missing; expected {', '.join(names)}")
        return np.array([float(coordinates[name]) for name in names])

    # -- places ------------------------------------------------------------------------------------

    def scene(self, point: Floats) -> Scene:
        """Everything at a configuration, given in the order of the ring's names."""
        values = self._places.values(point)
        dimension = 2 if self.mechanism.space is Space.PLANAR else 3
        rows = values.reshape(-1, dimension)
        placed = dict(zip(self._used, rows, strict=False))
        names = dict(zip(self.placement.space.points, rows[len(self._used) :], strict=True))
        screws = self._screw_rows(point)
        moved = {o.link for o in self.mechanism.outputs if not isinstance(o, JointRate)}
        outputs = [
            placed[o.link, o.point]
            for o in self.mechanism.outputs
            if not isinstance(o, JointRate) and (o.link, o.point) in placed
        ]
        marks = tuple(
            m for j in self.mechanism.joints if (m := self._mark(j, placed, screws, dimension)) is not None
        )
        links = [link.name for link in self.mechanism.links]
        held = {name: self._points_of(name, placed, marks) for name in links}
        if len(self.mechanism.joints) < len(links):
            # the points of an arm are only numbered, its joints are what it is spoken of by
            names = {m.joint.name: m.place for m in marks}
        bodies = tuple(
            Body(
                name,
                held[name],
                self._corners(name, held[name]),
                name == self.mechanism.ground,
                name in moved,
            )
            for name in links
        )
        return Scene(self.mechanism.space, bodies, marks, names, tuple(outputs))

    def _points_of(
        self, link: str, placed: Mapping[tuple[str, str], Floats], marks: tuple[Mark, ...]
    ) -> dict[str, Floats]:
        """The points of a link; in a spherical mechanism those where its axes meet the unit sphere."""
        if self.mechanism.space is Space.SPHERICAL:
            joints = [m for m in marks if link in (m.joint.first, m.joint.second)]
            return {m.joint.name: m.direction for m in joints if m.direction is not None}
        return {name: p for (owner, name), p in placed.items() if owner == link}

    def _corners(self, link: str, points: Mapping[str, Floats]) -> frozenset[str]:
        """The names of those of its points that are at joints."""
        if self.mechanism.space is Space.SPHERICAL:
            return frozenset(points)
        return frozenset(name for owner, name in self._held if owner == link)

    def _screw_rows(self, point: Floats) -> dict[str, Floats]:
        rows = self._screws.values(point).reshape(len(self._columns), -1)
        return dict(zip(self._columns, rows, strict=True))

    def _mark(
        self,
        joint: Joint,
        placed: Mapping[tuple[str, str], Floats],
        screws: Mapping[str, Floats],
        dimension: int,
    ) -> Mark | None:
        ends = [
            p
            for e in ((joint.second, joint.at[1]), (joint.first, joint.at[0]))
            if (p := placed.get(e)) is not None
        ]
        if not ends:
            return None
        rates = {o.column for o in self.mechanism.outputs if isinstance(o, JointRate)}
        ground = self.mechanism.ground
        return Mark(
            joint,
            ends[0],
            ends[-1],
            self._axes(joint, screws),
            any(c in self.mechanism.inputs for c in joint.columns),
            any(c in rates for c in joint.columns),
            ground in (joint.first, joint.second),
        )

    def _axes(self, joint: Joint, screws: Mapping[str, Floats]) -> tuple[Floats, ...]:
        """Unit vectors along its axes, or along its slide."""
        planar = self.mechanism.space is Space.PLANAR
        if joint.kind is JointKind.S or (planar and joint.kind is JointKind.R):
            return ()
        chosen = {JointKind.U: slice(2), JointKind.E: slice(2, 3)}.get(joint.kind, slice(1))
        found = []
        for column in joint.columns[chosen]:
            screw = screws[column]
            along = (screw[1:] if planar else screw[-3:]) if joint.kind is JointKind.P else screw[:3]
            length = float(np.linalg.norm(along))
            if length > 1e-9:
                found.append(along / length)
        return tuple(found)

    # -- velocities --------------------------------------------------------------------------------

    def velocities(self, point: Floats, rates: Mapping[str, float]) -> dict[tuple[str, str], Floats]:
        """The velocity of every used point of every link, from the joint rates by column."""
        screws = self._screw_rows(point)
        width = len(next(iter(screws.values())))
        placed = self.scene(point)
        found = {}
        for body in placed.bodies:
            twist = np.zeros(width)
            for joint, sign in () if body.ground else path(self.mechanism, body.name):
                for column in joint.columns:
                    twist = twist + sign * rates.get(column, 0.0) * screws[column]
            for name, p in body.points.items():
                found[body.name, name] = self._at(twist, p)
        return found

    def slopes(self, point: Floats) -> dict[tuple[str, str], Floats]:
        """The slopes of the points of `velocities` by the configuration variables, as far as these tell."""
        if self.mechanism.space is Space.SPHERICAL:
            slopes = self._screws.jacobian(point).reshape(len(self._columns), 3, -1)
            of_axes = dict(zip(self._columns, slopes, strict=True))
            ends = ((link, j) for j in self.mechanism.joints for link in (j.first, j.second))
            return {(link, j.name): of_axes[j.columns[0]] for link, j in ends}
        slopes = self._places.jacobian(point)
        dimension = 2 if self.mechanism.space is Space.PLANAR else 3
        return dict(zip(self._used, slopes.reshape(-1, dimension, slopes.shape[-1]), strict=False))

    @cached_property
    def free(self) -> list[int]:
        """The places of the configuration variables among the ring's names."""
        space = self.placement.space
        return [space.ring.index(name) for name in space.variables]

    def _at(self, twist: Floats, place: Floats) -> Floats:
        """A twist's velocity at a place."""
        if self.mechanism.space is Space.PLANAR:
            w, vx, vy = twist
            return np.array([vx - w * place[1], vy + w * place[0]])
        shift = twist[3:] if len(twist) == 6 else np.zeros(3)
        return np.asarray(shift + np.cross(twist[:3], place), dtype=np.float64)
