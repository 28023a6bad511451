"""Which pins, directions and slides become variables in the planar formulation.

Source: Garcia de Jalon, Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), ch. 2.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import networkx
import sympy

from singsym.kinematics.formulations.local import is_zero, tidy
from singsym.mechanism.model import Joint, JointKind, JointRate, Mechanism, Vector
from singsym.mechanism.problems import MechanismError, Problem


@dataclass(frozen=True)
class Pin:
    """A point of the plane where links are pinned together; named after the first joint's point."""

    name: str
    members: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Step:
    """A link with a direction, placed from one of its pins, along a slide, or by coordinates of its own."""

    link: str
    pin: str | None = None
    slide: Joint | None = None


@dataclass(frozen=True)
class Plan:
    """The variables and the order in which links are placed.

    directed: links with a direction of their own: the names of cosine and sine, None for the ground's.
    turns: cosine and sine of the angle by which slides hold such a link turned from the named direction.
    pairs: two-pin links, which need none; struts: slides along the line through two pins.
    free_pins, free_links: coordinates by name; placing_slides: slide variables by joint.
    """

    variables: tuple[str, ...]
    pin_of: Mapping[tuple[str, str], Pin]
    directed: Mapping[str, tuple[str, str] | None]
    turns: Mapping[str, Vector]
    pairs: Mapping[str, tuple[str, str]]
    struts: frozenset[str]
    steps: tuple[Step, ...]
    free_pins: Mapping[Pin, tuple[str, str]]
    free_links: Mapping[str, tuple[str, str]]
    placing_slides: Mapping[str, str]

    @property
    def lengths(self) -> tuple[str, ...]:
        """The variables that are lengths: all but directions."""
        directions = {name for group in self.directed.values() for name in group or ()}
        return tuple(name for name in self.variables if name not in directions)


def plan(mechanism: Mechanism) -> Plan:
    """Choose the variables of a planar mechanism.

    Raises `MechanismError` where slides in a loop cannot be parallel all at once.

    >>> from singsym.mechanism import load
    >>> plan(load("slider-crank").resolved).placing_slides != {}
    True
    """
    pin_of = _pins(mechanism)
    struts = _struts(mechanism, pin_of)
    rods = {link for joint in struts for link in (joint.first, joint.second)}
    groups = _parallel_groups(mechanism, {j.name for j in struts})
    pairs = _pairs(mechanism, pin_of, groups, rods)
    directed: dict[str, tuple[str, str] | None] = {}
    for link in mechanism.links:
        if link.name not in pairs and link.name not in rods:
            head = groups[link.name]
            directed[link.name] = None if head == mechanism.ground else (f"c_{head}", f"s_{head}")
    order = [n for n in _breadth_first(mechanism) if n in directed and n != mechanism.ground]
    placing = _Placement(mechanism, pin_of, directed)
    placing.run(order)
    known = placing.known
    rest = [(link, end) for link, ends in pairs.items() for end in ends]
    rest += [end for j in struts for end in ((j.first, j.at[0]), (j.second, j.at[1]))]
    for end in rest:
        if pin_of[end] not in known:
            placing.free(pin_of[end])
    pins = sorted(placing.free_pins, key=list(dict.fromkeys(pin_of.values())).index)
    free_pins = {pin: (f"{pin.name}x", f"{pin.name}y") for pin in pins}
    names: dict[str, None] = {}
    for pair in (*free_pins.values(), *placing.free_links.values()):
        names |= dict.fromkeys(pair)
    names |= dict.fromkeys(placing.slides.values())
    for headings in directed.values():
        names |= dict.fromkeys(headings or ())
    return Plan(
        tuple(names),
        pin_of,
        directed,
        _turns(mechanism, groups, {j.name for j in struts}),
        pairs,
        frozenset(j.name for j in struts),
        tuple(placing.steps),
        free_pins,
        placing.free_links,
        placing.slides,
    )


def _pins(mechanism: Mechanism) -> dict[tuple[str, str], Pin]:
    """The pin of every pinned (link, point)."""
    graph = networkx.Graph()
    for joint in mechanism.joints:
        if joint.kind is JointKind.R:
            graph.add_edge((joint.first, joint.at[0]), (joint.second, joint.at[1]))
    order = {m: i for i, m in enumerate(graph.nodes)}
    found: dict[tuple[str, str], Pin] = {}
    used: set[str] = set()
    for members in networkx.connected_components(graph):
        ordered = tuple(sorted(members, key=order.__getitem__))
        link, name = ordered[0]
        free = name if name not in used else f"{link}_{name}"
        used.add(free)
        found |= dict.fromkeys(ordered, Pin(free, ordered))
    return found


def _struts(mechanism: Mechanism, pin_of: Mapping[tuple[str, str], Pin]) -> list[Joint]:
    """Slides of two rods with one pin each, on the line through the pins, which may not coincide.

    None with a coupling, which needs the length, or the direction at a pin; none of the ground, whose
    direction is that of the axes.
    """
    coupled = {column for coupling in mechanism.couplings for column, _ in coupling.terms}
    apart = [set(e.points) for e in mechanism.exclusions if e.kind == "coincide"]
    found = []
    for joint in mechanism.joints:
        if joint.kind is not JointKind.P:
            continue
        ends = ((joint.first, joint.at[0]), (joint.second, joint.at[1]))
        if not all(end in pin_of for end in ends):
            continue
        lone = all(link != mechanism.ground and mechanism.graph.degree(link) == 2 for link, _ in ends)
        rods = {joint.first, joint.second}
        free = not any(j.name in coupled and rods & {j.first, j.second} for j in mechanism.joints)
        positive = any(
            limit.low is not None
            and limit.low.is_positive
            and str(limit.expression) == f"length({joint.name})"
            for limit in mechanism.limits
        )
        if lone and free and (positive or {pin_of[end].name for end in ends} in apart):
            found.append(joint)
    return found


def _parallel_groups(mechanism: Mechanism, struts: set[str]) -> dict[str, str]:
    """For each link the first link of those that slides keep parallel to it, the ground first of all."""
    graph = networkx.Graph()
    graph.add_nodes_from(link.name for link in mechanism.links)
    for joint in mechanism.joints:
        if joint.kind is JointKind.P and joint.name not in struts:
            graph.add_edge(joint.first, joint.second)
    order = {link.name: i for i, link in enumerate(mechanism.links)}
    order[mechanism.ground] = -1
    heads: dict[str, str] = {}
    for members in networkx.connected_components(graph):
        heads |= dict.fromkeys(members, min(members, key=order.__getitem__))
    return heads


def _turns(mechanism: Mechanism, groups: Mapping[str, str], struts: set[str]) -> dict[str, Vector]:
    """Cosine and sine of each link's angle from its group's head, since a slide has one axis in both links.

    With directions as complex numbers, axis a in one link and b in the other: the other is turned by a/b.
    """
    slides = [j for j in mechanism.joints if j.kind is JointKind.P and j.name not in struts]
    graph = networkx.MultiGraph()
    graph.add_nodes_from(groups)
    for joint in slides:
        graph.add_edge(joint.first, joint.second, joint=joint)
    turns: dict[str, Vector] = {head: (sympy.Integer(1), sympy.Integer(0)) for head in groups.values()}
    for head in list(turns):
        for known, link in networkx.bfs_edges(graph, head):
            joint = next(data["joint"] for data in graph[known][link].values())
            turns[link] = _turned(mechanism, joint, turns[known], known)
    for joint in slides:
        expected = _turned(mechanism, joint, turns[joint.first], joint.first)
        if not all(is_zero(x - y) for x, y in zip(expected, turns[joint.second], strict=True)):
            found = "slides in a loop whose axes cannot be parallel in both links of each"
            place = f"joints.{joint.name}.axis"
            raise MechanismError([Problem(place, found, "axes that agree around it", file=mechanism.origin)])
    return turns


def _turned(mechanism: Mechanism, joint: Joint, turn: Vector, known: str) -> Vector:
    """The turn of the other link of a slide."""
    assert joint.axes is not None
    a, b = (mechanism.link(n).axes[x] for n, x in zip((joint.first, joint.second), joint.axes, strict=True))
    if known != joint.first:
        a, b = b, a
    c, s = a[0] * b[0] + a[1] * b[1], a[1] * b[0] - a[0] * b[1]
    return (tidy(turn[0] * c - turn[1] * s), tidy(turn[0] * s + turn[1] * c))


def _pairs(
    mechanism: Mechanism,
    pin_of: Mapping[tuple[str, str], Pin],
    groups: Mapping[str, str],
    rods: set[str],
) -> dict[str, tuple[str, str]]:
    """Links that two pins place: no slides, and no further point that is needed and not rational in them."""
    sizes = list(groups.values())
    found = {}
    for link in mechanism.links:
        pins = [name for name in link.points if (link.name, name) in pin_of]
        alone = sizes.count(groups[link.name]) == 1 and link.name not in rods
        if link.name == mechanism.ground or not alone or len(pins) != 2:
            continue
        p, q = (link.points[name] for name in pins)
        square = (q[0] - p[0]) ** 2 + (q[1] - p[1]) ** 2
        traced = _traced(mechanism, link.name) - set(pins)
        if square != 0 and (square.expand().is_Rational or not traced):
            found[link.name] = (pins[0], pins[1])
    return found


def _traced(mechanism: Mechanism, link: str) -> set[str]:
    """The points of a link whose velocity is an output, and those where joints other than pins sit."""
    found = {o.point for o in mechanism.outputs if not isinstance(o, JointRate) and o.link == link}
    for joint in mechanism.joints:
        if joint.kind is not JointKind.R:
            found |= {
                name for end, name in zip((joint.first, joint.second), joint.at, strict=True) if end == link
            }
    return found


def _breadth_first(mechanism: Mechanism) -> list[str]:
    return [mechanism.ground, *(b for _, b in networkx.bfs_edges(mechanism.graph, mechanism.ground))]


class _Placement:
    """How each directed link is placed: from a known pin, along a slide from a placed link, or freely."""

    def __init__(
        self,
        mechanism: Mechanism,
        pin_of: Mapping[tuple[str, str], Pin],
        directed: Mapping[str, tuple[str, str] | None],
    ) -> None:
        self.mechanism = mechanism
        self.pin_of = pin_of
        self.directed = directed
        self.placed = {mechanism.ground}
        self.known = {pin for (link, _), pin in pin_of.items() if link == mechanism.ground}
        self.steps: list[Step] = []
        self.free_pins: list[Pin] = []
        self.free_links: dict[str, tuple[str, str]] = {}
        self.slides: dict[str, str] = {}

    def free(self, pin: Pin) -> None:
        """Give a pin coordinates of its own."""
        self.free_pins.append(pin)
        self.known.add(pin)

    def run(self, order: list[str]) -> None:
        waiting = list(order)
        while waiting:
            link = next((n for n in waiting if self._start(n)), waiting[0])
            step = self._start(link) or self._freely(link)
            self.steps.append(step)
            waiting.remove(link)
            self.placed.add(link)
            self.known |= {pin for (owner, _), pin in self.pin_of.items() if owner == link}

    def _start(self, link: str) -> Step | None:
        for name in self.mechanism.link(link).points:
            if self.pin_of.get((link, name)) in self.known:
                return Step(link, pin=name)
        for joint in self.mechanism.joints:
            if joint.kind is JointKind.P and link in (joint.first, joint.second):
                other = joint.second if joint.first == link else joint.first
                if other in self.placed and other in self.directed:
                    self.slides[joint.name] = f"d_{joint.name}"
                    return Step(link, slide=joint)
        return None

    def _freely(self, link: str) -> Step:
        for name in self.mechanism.link(link).points:
            pin = self.pin_of.get((link, name))
            if pin is not None:
                self.free(pin)
                return Step(link, pin=name)
        self.free_links[link] = (f"x_{link}", f"y_{link}")
        return Step(link)
