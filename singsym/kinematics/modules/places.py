"""By which variables the links, pins and joints of a placed mechanism are told.

Source: Garcia de Jalon, Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), ch. 2 (natural
coordinates: points shared by links).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import networkx

from singsym.kinematics.placement import Coordinates, Placement, variables_of
from singsym.mechanism.model import JointKind, JointRate, Mechanism, Output, PointVelocity, Space, Twist
from singsym.polynomials import Polynomial
from singsym.polynomials.short_forms import short_forms
from singsym.polynomials.unit_circles import Pair, unit_circles

Names = tuple[str, ...]


@dataclass(frozen=True)
class Meeting:
    """A pin with all its links, another joint with its two, or an output point with its link.

    variables: those that place it; None where its place is not all, as a slide's.
    """

    name: str
    kind: JointKind
    links: Names
    variables: Names | None


@dataclass(frozen=True)
class Drive:
    """A given value: of which velocity, of which link's twist or point, and the variables it is told by."""

    label: str
    body: str
    variables: Names


@dataclass(frozen=True)
class Places:
    """A placed mechanism: its variables, and coordinates of pins that are not variables themselves."""

    mechanism: Mechanism
    placed: Placement

    def variables(self, names: Iterable[str]) -> Names:
        """The variables and coordinates among names, with the others of their angles, once each."""
        known = {*self.placed.space.variables, *self.coordinates}
        found = dict.fromkeys(name for name in names if name in known)
        for group in self._groups:
            if {*group} & {*found}:
                found |= dict.fromkeys(group)
        return tuple(found)

    @cached_property
    def angles(self) -> tuple[Pair, ...]:
        """The names of cosine and sine of each angle among the variables."""
        space = self.placed.space
        return tuple(p for p in unit_circles(space.equations) if not {*p} & {*space.lengths})

    @cached_property
    def _groups(self) -> tuple[Names, ...]:
        """Variables that are found together: those of an angle, the components of a unit vector."""
        known = self.placed.space.variables
        axes = self.placed.space.directions.values()
        vectors = (variables_of(u) for u in axes if all(_is_variable(x) for x in u))
        return (*self.angles, *(v for v in vectors if {*v} <= {*known}))

    # -- points ---------------------------------------------------------------------------------------

    @cached_property
    def _pins(self) -> dict[tuple[str, str], str]:
        """The pins of the plane, and output points that are none: the name of each by link and point."""
        if self.mechanism.space is not Space.PLANAR:
            return {}
        graph = networkx.Graph()
        for joint in self.mechanism.joints:
            if joint.kind is JointKind.R:
                graph.add_edge((joint.first, joint.at[0]), (joint.second, joint.at[1]))
        graph.add_nodes_from(
            (o.link, o.point) for o in self.mechanism.outputs if isinstance(o, PointVelocity)
        )
        order = {end: k for k, end in enumerate(graph)}
        found: dict[tuple[str, str], str] = {}
        for members in networkx.connected_components(graph):
            link, point = min(members, key=order.__getitem__)
            name = point if point not in found.values() else f"{link}.{point}"
            found |= dict.fromkeys(sorted(members, key=order.__getitem__), name)
        return found

    @cached_property
    def _pin_places(self) -> dict[str, Coordinates]:
        placed = self.placed.link_points
        return {name: placed[end] for end, name in reversed(self._pins.items()) if end in placed}

    @cached_property
    def coordinates(self) -> dict[str, Polynomial]:
        """The coordinates of moving pins that are not variables themselves, by the names `B.x` and `B.y`."""
        found = {}
        for name, place in self._pin_places.items():
            for axis, x in zip("xy", place, strict=True):
                if not _is_variable(x) and {*x.variables} & {*self.placed.space.variables}:
                    found[f"{name}.{axis}"] = x
        return found

    def _pin(self, name: str) -> Names:
        """What tells where a pin is."""
        return tuple(n for axis in self._axes(name, self._pin_places.get(name, ())) for n in axis)

    def point(self, link: str, point: str) -> tuple[Names, ...] | None:
        """What tells each coordinate of a link's point; None where it is not placed."""
        place = self.placed.link_points.get((link, point))
        return None if place is None else self._axes(self._pins.get((link, point), ""), place)

    def _axes(self, pin: str, place: Coordinates) -> tuple[Names, ...]:
        named = ((f"{pin}.{axis}", x) for axis, x in zip("xyz", place, strict=False))
        return tuple((key,) if key in self.coordinates else x.variables for key, x in named)

    # -- links ----------------------------------------------------------------------------------------

    @cached_property
    def _bars(self) -> dict[str, tuple[str, str]]:
        """Links whose direction is that of a line through two pins, and the pins."""
        found = {}
        for link in self.mechanism.links:
            ends = [name for (owner, _), name in self._pins.items() if owner == link.name]
            own = {*self.placed.headings.get(link.name, ())}
            if len(ends) == 2 and own and not any(own == {*pair} for pair in self.angles):
                found[link.name] = (ends[0], ends[1])
        return found

    def heading(self, link: str) -> Names:
        """What tells the direction of a link."""
        bar = self._bars.get(link)
        if bar is not None:
            return (*self._pin(bar[0]), *self._pin(bar[1]))
        return self.placed.headings.get(link, ())

    @cached_property
    def poses(self) -> dict[str, Names | None]:
        """What tells place and direction of each link; None for one that is not placed."""
        found: dict[str, Names | None] = {}
        for link in (link.name for link in self.mechanism.links):
            points = [place for (owner, _), place in self.placed.link_points.items() if owner == link]
            if link in self._bars:
                found[link] = self.variables(self.heading(link))
            elif points or link in self.placed.headings:
                names = (n for place in points for n in variables_of(place))
                found[link] = self.variables((*self.heading(link), *names))
            else:
                found[link] = None
        return found

    def joint_value(self, column: str) -> Names:
        """What tells the value of a joint's freedom."""
        joint = next(j for j in self.mechanism.joints if column in j.columns)
        value = self.placed.values.get(column)
        if value is None:
            return tuple(name for link in (joint.first, joint.second) for name in self.poses[link] or ())
        if value.cosine is not None and {joint.first, joint.second} & {*self._bars}:
            return (*self.heading(joint.first), *self.heading(joint.second))
        parts = (value.cosine, value.sine, value.length, value.square)
        return variables_of(p for p in parts if p is not None)

    def equation(self, equation: Polynomial) -> Names:
        """What stands in a loop equation: two pins, where it holds their distance, else its variables."""
        return self._distances.get(equation, equation.variables)

    @cached_property
    def _distances(self) -> dict[Polynomial, Names]:
        ring = self.placed.space.ring
        circles = tuple(e for e in self.placed.space.equations if self._is_circle(e))
        short = short_forms(ring, circles).shorten
        found = {}
        for p, q in self._bars.values():
            gaps = (a - b for a, b in zip(self._pin_places[p], self._pin_places[q], strict=True))
            square = ring.zero
            for gap in gaps:
                square = square + gap * gap
            square = short(ring.reduced(square))
            for equation in self.placed.space.equations:
                if not self.variables((equation - square).variables):
                    found[equation] = (*self._pin(p), *self._pin(q))
        return found

    def _is_circle(self, equation: Polynomial) -> bool:
        return any(pair in self.angles for pair in unit_circles([equation]))

    # -- joints and outputs ---------------------------------------------------------------------------

    @cached_property
    def meetings(self) -> tuple[Meeting, ...]:
        """Pins of the plane with all links on them, the other joints one by one, output points."""
        names = list(dict.fromkeys(name for j in self.mechanism.joints for name in (j.name, j.at[0])))
        found = []
        for joint in self.mechanism.joints:
            if (joint.first, joint.at[0]) not in self._pins or joint.kind is not JointKind.R:
                found.append(Meeting(joint.name, joint.kind, (joint.first, joint.second), None))
        for name in dict.fromkeys(self._pins.values()):
            links = dict.fromkeys(link for (link, _), pin in self._pins.items() if pin == name)
            found.append(Meeting(name, JointKind.R, tuple(links), self.variables(self._pin(name))))
        return tuple(sorted(found, key=lambda m: names.index(m.name) if m.name in names else len(names)))

    def drives(self, output: Output) -> list[Drive]:
        """What is given where an output is."""
        if isinstance(output, JointRate):
            return [Drive(output.column, "", self.joint_value(output.column))]
        point = self.point(output.link, output.point)
        found = []
        for component in output.components:
            told = self.poses[output.link] or ()
            if component.startswith("w"):
                told = self.heading(output.link) or told
            elif point is not None:
                told = point["xyz".index(component[-1])]
            body = output_body(output)
            found.append(Drive(f"{body}.{component}", body, told))
        return found

    @cached_property
    def own(self) -> dict[str, frozenset[str]]:
        """The variables that are coordinates of an output link or an output point themselves."""
        found: dict[str, frozenset[str]] = {}
        for output in self.mechanism.outputs:
            if isinstance(output, JointRate):
                continue
            points = [p for (link, p) in self.placed.link_points if link == output.link]
            turning = {*self.placed.headings.get(output.link, ())}
            if isinstance(output, PointVelocity):
                points, turning = [output.point], set()
            places = (self.point(output.link, p) or () for p in points)
            alone = {names[0] for place in places for names in place if len(names) == 1}
            angle = turning if any(turning == {*pair} for pair in self.angles) else set()
            found[output_body(output)] = frozenset(alone | angle)
        return found

    @property
    def is_closed(self) -> bool:
        """Whether there are loops."""
        return len(self.mechanism.joints) >= len(self.mechanism.links)

    @cached_property
    def platforms(self) -> Names:
        """The output links of a parallel robot: of which the twist, or of three joints a point's velocity."""
        graph, outputs = self.mechanism.graph, self.mechanism.outputs
        turning = [o.link for o in outputs if isinstance(o, Twist)]
        moving = [o.link for o in outputs if isinstance(o, PointVelocity) and graph.degree(o.link) > 2]
        return tuple(turning if self.mechanism.n == 1 else (*turning, *moving))

    @cached_property
    def legs(self) -> tuple[frozenset[str], ...]:
        """What connects a platform with the ground, in the order of the links; none of a serial arm."""
        if not self.platforms:
            return ()
        rest = self.mechanism.graph.copy()
        rest.remove_nodes_from({*self.platforms, self.mechanism.ground})
        order = [link.name for link in self.mechanism.links]
        legs = sorted(networkx.connected_components(rest), key=lambda leg: min(map(order.index, leg)))
        return tuple(map(frozenset, legs)) if len(legs) > 1 else ()


def output_body(output: Twist | PointVelocity) -> str:
    """The link of a twist, the point of a velocity."""
    return output.link if isinstance(output, Twist) else output.point


def _is_variable(polynomial: Polynomial) -> bool:
    """Whether it is a variable by itself."""
    names = polynomial.variables
    return len(names) == 1 and polynomial == polynomial.ring.gen(names[0])
