"""The modules of a mechanism driven from its inputs, or from its outputs: what is solved after what.

Source: Servatius, Shai, Whiteley, Combinatorial characterization of the Assur graphs from engineering,
European J. Combin. 31 (2010) 1091-1104, where Assur groups are strongly connected components.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from singsym.kinematics.formulations import place
from singsym.kinematics.modules.places import Drive, Meeting, Places
from singsym.kinematics.modules.words import Part, words
from singsym.kinematics.placement import Placement
from singsym.mechanism.model import Mechanism
from singsym.polynomials import Equations
from singsym.polynomials.block_form import square_blocks


@dataclass(frozen=True)
class DrivenModule:
    """A small square system: as many equations as variables, once those of its parents are known.

    words: what it is in terms of kinematics, as "dyad C from B and D".
    variables: what it determines, among it coordinates `B.x` of pins that are none of the formulation's
        variables; unknowns: their number, where cosine and sine of an angle are one.
    equations, driven, meets: its loop equations; the velocities whose integrals are given to it; the pins'
        coordinates that its parents give and that have to be those by its own variables.
    links: those that are placed when it is solved; parents: the places of other modules in the order.
    """

    words: str
    variables: tuple[str, ...]
    unknowns: int
    equations: Equations
    driven: tuple[str, ...]
    meets: tuple[str, ...]
    links: tuple[str, ...]
    parents: tuple[int, ...]


@dataclass(frozen=True)
class DrivenModules:
    """The modules of a mechanism in an order in which they can be solved.

    undetermined: the variables that are still free; left_over: loop equations beyond the square systems.
    """

    modules: tuple[DrivenModule, ...]
    undetermined: tuple[str, ...]
    left_over: Equations


def driven_modules(mechanism: Mechanism, formulation: str = "auto") -> dict[str, DrivenModules]:
    """The modules driven from the `inputs`, and from the `outputs`.

    >>> from singsym.mechanism import load
    >>> {end: len(found.modules) for end, found in driven_modules(load("3rrr")).items()}
    {'inputs': 4, 'outputs': 4}
    """
    placed = place(mechanism, formulation)
    return {
        "inputs": modules_from_inputs(mechanism, placed),
        "outputs": modules_from_outputs(mechanism, placed),
    }


def modules_from_inputs(mechanism: Mechanism, placed: Placement) -> DrivenModules:
    """The modules where the values of the input joints are given: forward kinematics.

    >>> from singsym.mechanism import load
    >>> fourbar = load("fourbar")
    >>> [m.words for m in modules_from_inputs(fourbar, place(fourbar)).modules]
    ['crank AB at A', 'dyad C from B and D']
    """
    places = Places(mechanism, placed)
    drives = [Drive(c, "", places.joint_value(c)) for c in mechanism.inputs]
    return _Driving(places, drives, "crank").result()


def modules_from_outputs(mechanism: Mechanism, placed: Placement) -> DrivenModules:
    """The modules where what the output velocities are rates of is given: inverse kinematics.

    >>> from singsym.mechanism import load
    >>> robot = load("3rrr")
    >>> [m.words for m in modules_from_outputs(robot, place(robot)).modules][1]
    'leg 1: dyad B1 from A1 and C1'
    """
    places = Places(mechanism, placed)
    drives = [drive for output in mechanism.outputs for drive in places.drives(output)]
    return _Driving(places, drives, "follower").result()


class _Driving:
    """The incidence of what is given, loop equations and pins' coordinates with the variables, in blocks."""

    def __init__(self, places: Places, drives: Sequence[Drive], driven_link: str) -> None:
        self.places = places
        self.driven_link = driven_link
        space = places.placed.space
        equations = [e for e in space.equations if places.variables(e.variables)]
        self.names = (*space.variables, *places.coordinates)
        definitions = [(name, *p.variables) for name, p in places.coordinates.items()]
        given = [drive.variables for drive in drives]
        loops = [places.equation(e) for e in equations]
        self.rows = [places.variables(row) for row in (*definitions, *given, *loops)]
        self.definition_of = {name: k for k, name in enumerate(places.coordinates)}
        self.drive_of = dict(enumerate(drives, len(definitions)))
        self.equation_of = dict(enumerate(equations, len(definitions) + len(drives)))
        self.blocks = self._merged(square_blocks(dict(enumerate(self.rows))))
        self.home = {name: k for k, block in enumerate(self.blocks) for name in block.values()}

    def _merged(self, blocks: Sequence[dict[int, str]]) -> list[dict[int, str]]:
        """Blocks that can be solved; what an output tells of a body at once is one of them.

        Those that only work out a pin's coordinate are left out.
        """
        determined: set[str] = set()
        kept: list[dict[int, str]] = []
        told: dict[str, dict[int, str]] = {}
        for block in blocks:
            needed = {name for k in block for name in self.rows[k]}
            if not needed <= determined | {*block.values()}:
                continue
            determined |= {*block.values()}
            if all(k == self.definition_of.get(name) for k, name in block.items()):
                continue
            body = self._told(block)
            if body and body in told:
                told[body] |= block
                continue
            kept.append(block)
            if body:
                told[body] = block
        return kept

    def _told(self, block: Mapping[int, str]) -> str:
        """The body or point whose own coordinates the output gives here, else ""."""
        bodies = {self.drive_of[k].body for k in block if k in self.drive_of}
        body = min(bodies, default="")
        own = self.places.own.get(body, frozenset())
        needed = {name for k in block for name in self.rows[k]}
        return body if len(bodies) == 1 and own.issuperset(needed) else ""

    @cached_property
    def _sources(self) -> dict[str, frozenset[int]]:
        """The modules that have to be solved for a variable or coordinate; without those that stay free."""
        found = {name: frozenset([k]) for name, k in self.home.items()}
        for name, polynomial in self.places.coordinates.items():
            names = self.places.variables(polynomial.variables)
            if name not in found and all(n in self.home for n in names):
                found[name] = frozenset(self.home[n] for n in names)
        return found

    def _last(self, names: Iterable[str] | None) -> int | None:
        """The module after which all these are known: -1 for nothing, None if some stay free."""
        sources = [self._sources.get(name) for name in names or ()]
        if names is None or None in sources:
            return None
        return max((k for source in sources if source for k in source), default=-1)

    def result(self) -> DrivenModules:
        """The modules, and what is in none of them."""
        matched = {k for block in self.blocks for k in block}
        free = tuple(name for name in self.places.placed.space.variables if name not in self.home)
        left = []
        for k, equation in self.equation_of.items():
            if k not in matched and not {*free} & {*self.rows[k]}:
                left.append(equation)
        return DrivenModules(tuple(map(self._module, range(len(self.blocks)))), free, tuple(left))

    def _module(self, number: int) -> DrivenModule:
        block = self.blocks[number]
        defined = {name for name, k in self.definition_of.items() if k in block}
        worked_out = defined & {*block.values()}
        variables = sorted({*block.values()} - worked_out, key=self.names.index)
        needed = {name for k in block for name in self.rows[k]}
        parents = {k for name in needed for k in self._sources[name]} - {number}
        part = self._part(number, variables)
        return DrivenModule(
            words(part, self.places, self.driven_link),
            tuple(variables),
            part.unknowns,
            tuple(self.equation_of[k] for k in block if k in self.equation_of),
            part.driven,
            tuple(sorted(defined - worked_out, key=self.names.index)),
            part.links,
            tuple(sorted(parents)),
        )

    def _part(self, number: int, variables: Sequence[str]) -> Part:
        driven = [self.drive_of[k] for k in self.blocks[number] if k in self.drive_of]
        told = self._told(self.blocks[number])
        outer, inner = self._meetings(number)
        return Part(
            self._links(number),
            len(variables) - sum({*pair} <= {*variables} for pair in self.places.angles),
            tuple(drive.label for drive in driven),
            told,
            len(driven) == sum(drive.body == told for drive in self.drive_of.values()),
            outer,
            inner,
        )

    @cached_property
    def _placed_in(self) -> dict[str, int | None]:
        return {link: self._last(names) for link, names in self.places.poses.items()}

    def _links(self, number: int) -> tuple[str, ...]:
        return tuple(link for link, last in self._placed_in.items() if last == number)

    def _meetings(self, number: int) -> tuple[tuple[Meeting, ...], tuple[Meeting, ...]]:
        """Where a module's links meet what is placed before, and where only each other."""
        outer, inner = [], []
        links = {*self._links(number)}
        for meeting in self.places.meetings:
            own = replace(meeting, links=tuple(link for link in meeting.links if link in links))
            if own.links and self._is_before(meeting, number):
                outer.append(own)
            elif len(own.links) > 1:
                inner.append(own)
        return tuple(outer), tuple(inner)

    def _is_before(self, meeting: Meeting, number: int) -> bool:
        if meeting.variables is not None:
            last = self._last(meeting.variables)
            return last is not None and last < number
        ends = (self._placed_in[link] for link in meeting.links)
        return any(last is not None and last < number for last in ends)
