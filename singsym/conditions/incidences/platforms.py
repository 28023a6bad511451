"""The determinant of L_I of a platform on legs as a bracket of the lines that its legs withstand.

Source: J.-P. Merlet, "Singular configurations of parallel manipulators and Grassmann geometry" (1989);
P. Ben-Horin, M. Shoham (2006), whose six lines, two and two through a point, are dependent where four planes
meet in a point.

A velocity m with L_I m = 0 is one of the platform and the passive joints with which all legs agree.  So
det L_I is, up to its sign, that of a matrix with the rows of all legs, a column for each component of the
platform's twist and one for each passive velocity; by the lemma of `wrenches` it is det[lines] times the
scales of the legs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod

from singsym.conditions.incidences.grassmann_cayley import Vector, determinant, plane
from singsym.conditions.incidences.legs import legs
from singsym.conditions.incidences.quantities import Quantity, arrow, bracket, symbol
from singsym.conditions.incidences.wrenches import Line, Support, support
from singsym.kinematics.modules.words import listed
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import dot
from singsym.kinematics.velocity import VelocityEquation
from singsym.minors.determinant import TooManyTerms, block_determinants
from singsym.minors.determinant import determinant as matrix_determinant
from singsym.polynomials import Polynomial, PolynomialMatrix

MOST_TERMS = 5000
"""Brackets with more terms on the way are left as they are."""


@dataclass(frozen=True, eq=False)
class Platform:
    """A link on legs; together these withstand as many wrenches as it has freedoms."""

    certifier: Certifier
    supports: tuple[Support, ...]

    @cached_property
    def lines(self) -> tuple[Line, ...]:
        """The lines of all legs, their points by one name for each place."""
        return tuple(self._renamed(line) for own in self.supports for line in own.lines)

    @cached_property
    def polynomials(self) -> tuple[Polynomial, ...] | None:
        """Polynomials whose product is det L_I up to a sign; None where the bracket has too many terms."""
        if self._parts is None:
            return None
        return (*self._parts, *(own.scale for own in self.supports))

    @cached_property
    def _parts(self) -> tuple[Polynomial, ...] | None:
        rows = [line.coordinates for line in self.lines]
        try:
            return block_determinants(PolynomialMatrix.of(self.certifier.space.ring, rows), MOST_TERMS)
        except TooManyTerms:
            return None

    @cached_property
    def bracket(self) -> Quantity:
        """The bracket in the lines' names."""
        lines, single = self._free
        names = [_text(line) for line in lines]
        if single:
            words = f"lines {listed(names)} parallel to a plane"
            return bracket([arrow(*line.names) for line in lines], names, words)
        if len(lines) == 3 and lines[0].kind == "plane":
            latex = [r" \times ".join(map(symbol, line.names)) for line in lines]
            text = ["x".join(line.names) for line in lines]
            planes = listed([f"{u}, {v}" for u, v in (line.names for line in lines)])
            return bracket(latex, text, f"planes of the axes {planes} with a line in common")
        relation = "in a linear complex" if len(lines) == 6 else "through a point or parallel"
        return bracket([_latex(line) for line in lines], names, f"lines {listed(names)} {relation}")

    @property
    def stays_unexpanded(self) -> bool:
        """Whether det L_I vanishes exactly where the bracket does, which has too many terms."""
        scales = (own.scale for own in self.supports)
        return (
            self._parts is None
            and not self._free[1]
            and all(self.certifier.reason(scale) is not None for scale in scales)
        )

    def values(self) -> Iterator[tuple[Polynomial, Quantity]]:
        """Quantities of the lines that determinants have as factors, with their polynomials."""
        for own in self.supports:
            for line in own.lines:
                for u in own.leg.axes if line.kind == "line" and len(line.coordinates) == 6 else ():
                    name = "".join(line.names)
                    value = dot(line.coordinates[:3], self.certifier.space.directions[u])
                    latex = rf"{arrow(*line.names)} \cdot {symbol(u)}"
                    yield value, Quantity(latex, f"{name}.{u}", f"{name} perpendicular to axis {u}")
        if self._parts is None:
            return
        lines, single = self._free
        value = prod(self._parts, start=self.certifier.space.ring.one)
        for meet, quantity in self._planes():
            if not all(self.certifier.normal_form(meet - value * sign) for sign in (1, -1)):
                yield meet, quantity
        if single:
            value = determinant([line.coordinates[:3] for line in lines])
        yield value, self.bracket

    @property
    def _free(self) -> tuple[tuple[Line, ...], bool]:
        """The lines beside couples, and whether three couples make these a matter of directions."""
        forces = tuple(line for line in self.lines if line.kind != "couple")
        vectors = all(line.kind == "line" and line.names[1] in self._points for line in forces)
        single = len(self.lines) == 6 and len(forces) == 3 and vectors
        return (forces, True) if single else (self.lines, False)

    @cached_property
    def _points(self) -> dict[str, Vector]:
        return {name: tuple(place) for name, place in self.certifier.space.points.items()}

    def _renamed(self, line: Line) -> Line:
        """A line whose points bear the first of the names of their places."""
        first = {place: name for name, place in self.certifier.space.places.items()}
        p, q = (
            first[self._points[n]] if n in self._points and line.kind == "line" else n for n in line.names
        )
        return Line(line.kind, (p, q), line.coordinates)

    def _planes(self) -> Iterator[tuple[Polynomial, Quantity]]:
        """Of six lines, two and two through a point, the meet of their planes and of that of the points."""
        if len(self.lines) != 6 or any({*line.names} - self._points.keys() for line in self.lines):
            return
        for pairs in _pairings(self.lines):
            shared = [({*a.names} & {*b.names}) for a, b in pairs]
            if any(len(points) != 1 for points in shared):
                continue
            apexes = [points.pop() for points in shared]
            if len({*apexes}) < 3:
                continue
            ends = [
                [next(n for n in line.names if n != apex) for line in pair]
                for pair, apex in zip(pairs, apexes, strict=True)
            ]
            named = [(*two, apex) for two, apex in zip(ends, apexes, strict=True)]
            yield self._meet([*named, (apexes[0], apexes[1], apexes[2])])

    def _meet(self, planes: Sequence[Sequence[str]]) -> tuple[Polynomial, Quantity]:
        """The meet of four planes, each by three of its points."""
        rows = [plane(*(self._points[name] for name in names)) for names in planes]
        value = matrix_determinant(PolynomialMatrix.of(self.certifier.space.ring, rows))
        text = ["".join(names) for names in planes]
        latex = ["".join(map(symbol, names)) for names in planes]
        return value, bracket(latex, text, f"planes {listed(text)} through a point or parallel to a line")


def platform(equation: VelocityEquation, certifier: Certifier) -> Platform | None:
    """The moved link on its legs; None where lines through their points do not say all of L_I.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> equation = velocity_equation(load("3rrr"))
    >>> platform(equation, Certifier(equation.space)).bracket.text
    'det[B1C1 B2C2 B3C3]'
    """
    inputs = frozenset(column.label for column in equation.columns if column.role == "input")
    found = []
    for leg in legs(equation):
        own = support(leg, inputs, certifier)
        if own is None:
            return None
        found.append(own)
    lines = [line for own in found for line in own.lines]
    if not lines or len(lines) != len(lines[0].coordinates):
        return None
    return Platform(certifier, tuple(found))


def _pairings(lines: Sequence[Line]) -> Iterator[tuple[tuple[Line, Line], ...]]:
    """Six lines in three pairs, in all 15 ways."""
    first, *others = lines
    for second in others:
        rest = [line for line in others if line is not second]
        for third in rest[1:]:
            last = [line for line in rest[1:] if line is not third]
            yield (first, second), (rest[0], third), (last[0], last[1])


def _text(line: Line) -> str:
    """A line by its points; a point and an axis, and a couple's axis, with a colon between."""
    return ("" if line.kind == "line" else ":").join(line.names)


def _latex(line: Line) -> str:
    return ("" if line.kind == "line" else "{:}").join(map(symbol, line.names))
