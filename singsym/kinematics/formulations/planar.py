"""The planar formulation: coordinates of the pins, directions of links that need one, slides of sliders.

Source: Garcia de Jalon, Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), ch. 2.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from singsym.kinematics.dimensions import Sized, dimensions
from singsym.kinematics.formulations.planar_plan import Pin, Plan, plan
from singsym.kinematics.placement import ConfigurationSpace, Coordinates, JointValue, Placement, variables_of
from singsym.mechanism.model import Joint, JointKind, Mechanism
from singsym.polynomials import Polynomial
from singsym.polynomials.short_forms import short_forms
from singsym.polynomials.unit_circles import Pair, circle


@dataclass(frozen=True)
class Heading:
    """The direction of a link's x axis times `scale`, a positive number."""

    x: Polynomial
    y: Polynomial
    scale: Polynomial

    def turn(self, local: Coordinates) -> Coordinates:
        """`scale` times a vector given in the link's frame."""
        u, v = local
        return (self.x * u - self.y * v, self.y * u + self.x * v)


def place(mechanism: Mechanism) -> Placement:
    """Pins as points, two-pin links as distances, other links by a direction (c, s) and one of their pins.

    A slider's pin is written with its slide; a link of two parts that slide along the line through their
    pins needs no direction where the pins are excluded from coinciding.  Raises `MechanismError`.

    >>> from singsym.mechanism import load
    >>> place(load("zlatanov-2dof")).space.variables
    ('Bx', 'By', 'Cx', 'Cy', 'Fx', 'Fy', 'Gx', 'Gy')
    """
    mechanism = mechanism.resolved
    planned = plan(mechanism)
    return _Placing(mechanism, planned, dimensions(mechanism, planned.variables)).placement()


class _Placing:
    """Pins and headings as polynomials, found in the order of the plan."""

    def __init__(self, mechanism: Mechanism, planned: Plan, sized: Sized) -> None:
        self.mechanism = mechanism
        self.plan = planned
        self.sized = sized
        self.ring = sized.ring
        self.pins: dict[Pin, Coordinates] = {}
        self.headings: dict[str, Heading] = {}
        self.equations: list[Polynomial] = []
        self.points: dict[tuple[str, str], Coordinates] = {}

    def placement(self) -> Placement:
        self._declare()
        for step in self.plan.steps:
            self._place_link(step.link, step.pin, step.slide)
        self._connect_pairs()
        for joint in self.mechanism.joints:
            if joint.kind is JointKind.P and joint.name not in self.plan.placing_slides:
                self.equations += self._guide(joint)
        for link in self.mechanism.links:
            self._fill_points(link.name)
        circles = tuple(circle(*map(self.ring.gen, pair)) for pair in self._directions())
        short = short_forms(self.ring, circles).shorten
        closing = (e if e in circles else short(self.ring.reduced(e)) for e in self.equations)
        space = ConfigurationSpace(
            self.ring,
            tuple(dict.fromkeys(e for e in (*self.sized.relations, *closing) if e)),
            positive=self.sized.positive,
            parameters=self.sized.parameters,
            lengths=self.plan.lengths,
            points=self._named_points(),
            formulation="planar",
        )
        screws: dict[str, Coordinates] = {}
        values: dict[str, JointValue] = {}
        for joint in self.mechanism.joints:
            screws |= self._screws(joint)
            values |= self._value(joint)
        headings = {link: variables_of((h.x, h.y)) for link, h in self.headings.items()}
        for joint in self.mechanism.joints:
            if joint.name in self.plan.struts:
                line = variables_of(screws[joint.name])
                headings |= {joint.first: line, joint.second: line}
        return Placement(space, screws, self.points, (), values, headings)

    def _directions(self) -> tuple[Pair, ...]:
        """The names of each heading's cosine and sine."""
        return tuple(dict.fromkeys(filter(None, self.plan.directed.values())))

    # -- pins and links ---------------------------------------------------------------------------

    def _local(self, link: str, point: str) -> Coordinates:
        x, y = self.mechanism.link(link).points[point]
        return (self.sized.number(x), self.sized.number(y))

    def _axis(self, link: str, axis: str) -> Coordinates:
        x, y = self.mechanism.link(link).axes[axis]
        return (self.sized.number(x), self.sized.number(y))

    def _declare(self) -> None:
        one, zero = self.ring.one, self.ring.zero
        for link, group in self.plan.directed.items():
            c, s = (one, zero) if group is None else (self.ring.gen(name) for name in group)
            x, y = Heading(c, s, one).turn(tuple(map(self.sized.number, self.plan.turns[link])))
            self.headings[link] = Heading(self.ring.reduced(x), self.ring.reduced(y), one)
            if group is not None:
                self.equations.append(circle(c, s))
        for pin, names in self.plan.free_pins.items():
            self.pins[pin] = (self.ring.gen(names[0]), self.ring.gen(names[1]))
        for name in self.mechanism.link(self.mechanism.ground).points:
            self._set(self.mechanism.ground, name, self._local(self.mechanism.ground, name))

    def _set(self, link: str, point: str, place: Coordinates) -> None:
        """A link's point is here: a new place for its pin, or an equation with the known one."""
        self.points[link, point] = place
        pin = self.plan.pin_of.get((link, point))
        if pin is None:
            return
        if pin in self.pins:
            self.equations += [a - b for a, b in zip(place, self.pins[pin], strict=True)]
        else:
            self.pins[pin] = place

    def _place_link(self, link: str, pin: str | None, slide: Joint | None) -> None:
        """All points of a link with a heading, from one of its points or along a slide."""
        heading = self.headings[link]
        known: Coordinates
        if slide is not None:
            other, here = slide.first, slide.at[1]
            there, sign = slide.at[0], 1
            if slide.first == link:
                other, here, there, sign = slide.second, slide.at[0], slide.at[1], -1
            axis = slide.axes[0] if slide.axes else ""
            along = self.headings[slide.first].turn(self._axis(slide.first, axis))
            length = self.ring.gen(self.plan.placing_slides[slide.name]) * sign
            start = self.points[other, there]
            anchor, known = here, (start[0] + along[0] * length, start[1] + along[1] * length)
        elif pin is not None:
            anchor, known = pin, self.pins[self.plan.pin_of[link, pin]]
        else:
            x, y = (self.ring.gen(name) for name in self.plan.free_links[link])
            anchor, known = "", (x, y)
        base = self._local(link, anchor) if anchor else (self.ring.zero, self.ring.zero)
        for name in self.mechanism.link(link).points:
            here_local = self._local(link, name)
            moved = heading.turn((here_local[0] - base[0], here_local[1] - base[1]))
            self._set(link, name, (known[0] + moved[0], known[1] + moved[1]))

    def _connect_pairs(self) -> None:
        """Two-pin links: the distance of the pins, and the heading that they give."""
        for link, (p, q) in self.plan.pairs.items():
            a, b = self._local(link, p), self._local(link, q)
            d = (b[0] - a[0], b[1] - a[1])
            P, Q = self.pins[self.plan.pin_of[link, p]], self.pins[self.plan.pin_of[link, q]]
            D = (Q[0] - P[0], Q[1] - P[1])
            square = self.ring.reduced(d[0] ** 2 + d[1] ** 2)
            self.equations.append(D[0] ** 2 + D[1] ** 2 - square)
            self.headings[link] = Heading(d[0] * D[0] + d[1] * D[1], d[0] * D[1] - d[1] * D[0], square)
            self.points[link, p], self.points[link, q] = P, Q

    def _fill_points(self, link: str) -> None:
        """Further points of a two-pin link, where its length squared is rational; pins of struts."""
        for name in self.mechanism.link(link).points:
            if (link, name) in self.points:
                continue
            if (link, name) in self.plan.pin_of:
                self.points[link, name] = self.pins[self.plan.pin_of[link, name]]
            elif link in self.plan.pairs and self.headings[link].scale.is_constant:
                start = self.plan.pairs[link][0]
                a, b = self._local(link, start), self._local(link, name)
                moved = self.headings[link].turn((b[0] - a[0], b[1] - a[1]))
                scale = self.headings[link].scale.constant
                base = self.points[link, start]
                self.points[link, name] = (base[0] + moved[0] / scale, base[1] + moved[1] / scale)

    def _named_points(self) -> dict[str, Coordinates]:
        found: dict[str, Coordinates] = {pin.name: place for pin, place in self.pins.items()}
        for (link, name), place in self.points.items():
            if (link, name) not in self.plan.pin_of:
                found[name if name not in found else f"{link}.{name}"] = place
        return found

    # -- joints -----------------------------------------------------------------------------------

    def _guide(self, joint: Joint) -> Iterator[Polynomial]:
        """A slide that places nothing: the second link's point lies on the line of the first."""
        if joint.name in self.plan.struts:
            return
        assert joint.axes is not None
        u = self.headings[joint.first].turn(self._axis(joint.first, joint.axes[0]))
        a, b = self.points[joint.first, joint.at[0]], self.points[joint.second, joint.at[1]]
        yield u[0] * (b[1] - a[1]) - u[1] * (b[0] - a[0])

    def _screws(self, joint: Joint) -> dict[str, Coordinates]:
        zero, one = self.ring.zero, self.ring.one
        if joint.kind is JointKind.P:
            if joint.name in self.plan.struts:
                a, b = self.points[joint.first, joint.at[0]], self.points[joint.second, joint.at[1]]
                return {joint.name: (zero, b[0] - a[0], b[1] - a[1])}
            assert joint.axes is not None
            return {
                joint.name: (zero, *self.headings[joint.first].turn(self._axis(joint.first, joint.axes[0])))
            }
        x, y = self.points[joint.second, joint.at[1]]
        turn = (one, y, -x)
        if joint.kind is JointKind.R:
            return {joint.name: turn}
        heading = self.headings.get(joint.first, Heading(one, zero, one))
        slides = ((zero, heading.x, heading.y), (zero, -heading.y, heading.x))
        return dict(zip(joint.columns, (*slides, turn), strict=True))

    def _value(self, joint: Joint) -> dict[str, JointValue]:
        if joint.name in self.plan.placing_slides:
            return {joint.name: JointValue(length=self.ring.gen(self.plan.placing_slides[joint.name]))}
        if joint.kind is JointKind.P:
            a, b = self.points[joint.first, joint.at[0]], self.points[joint.second, joint.at[1]]
            gap = (b[0] - a[0], b[1] - a[1])
            if joint.name in self.plan.struts:
                return {joint.name: JointValue(square=gap[0] ** 2 + gap[1] ** 2)}
            assert joint.axes is not None
            u = self.headings[joint.first].turn(self._axis(joint.first, joint.axes[0]))
            return {joint.name: JointValue(length=u[0] * gap[0] + u[1] * gap[1])}
        if joint.kind is not JointKind.R or not {joint.first, joint.second} <= self.headings.keys():
            return {}
        one, two = self.headings[joint.first], self.headings[joint.second]
        a, b = (one.x, one.y), (two.x, two.y)
        if joint.reference is not None:
            a = one.turn(self._axis(joint.first, joint.reference[0]))
            b = two.turn(self._axis(joint.second, joint.reference[1]))
        cosine, sine = a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0]
        return {
            joint.name: JointValue(self.ring.reduced(cosine), self.ring.reduced(sine), one.scale * two.scale)
        }
