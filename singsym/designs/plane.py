"""The cells of two parameters: connected components off the border curves, each with a rational sample.

The first parameter's axis is divided where curves cross, turn back or go to infinity; over each interval the
curves are graphs one above the other (G. E. Collins, Quantifier elimination for real closed fields by
cylindrical algebraic decomposition, 1975).  Cells of neighbouring stacks are one where a segment between them
meets no curve, by exact interval arithmetic; what is not seen to be one stays apart.
Source: Collins (1975); the joining is singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations, pairwise

import networkx
import numpy as np
import sympy

from singsym.designs.line import Root, roots, samples, simple_between
from singsym.polynomials import Polynomial
from singsym.varieties.real.bounds_of_solutions import sign_within

Place = tuple[int, int]
"""A cell by its stack and its number from below."""


@dataclass(frozen=True)
class Arc:
    """A part of a curve between two walls, or of an upright curve, with an exact point of it.

    point: the values of both parameters, None for a root of a high degree; degree: the largest of theirs;
    sides: the cells on both sides.
    """

    curve: Polynomial
    point: tuple[sympy.Expr | None, sympy.Expr | None]
    degree: int
    sides: tuple[Place, Place]


@dataclass(frozen=True)
class Plane:
    """Stacks of cells over the intervals of the first parameter.

    names: of the two parameters; curves: irreducible polynomials in them, no two with the same zeros.
    """

    names: tuple[str, str]
    curves: tuple[Polynomial, ...]

    @cached_property
    def walls(self) -> tuple[Root, ...]:
        """Values of the first parameter at which stacks end."""
        y = self.names[1]
        found: list[Polynomial] = []
        for f in self.curves:
            degree = f.degree(y)
            found.append(f.coefficient(y, degree))
            if degree > 1:
                found.append(_resultant(f, f.derivative(y), y))
        upright = [f for f in self.curves if f.degree(y)]
        found += [_resultant(f, g, y) for f, g in combinations(upright, 2)]
        return roots((p for p in found if not p.is_constant), self.names[0])

    @cached_property
    def stacks(self) -> tuple[tuple[Fraction, tuple[Fraction, ...]], ...]:
        """For each interval between walls a value inside, and over it a value in each cell, from below."""
        return tuple((x, samples(self._over(x))) for x in samples(self.walls))

    def _over(self, x: Fraction) -> tuple[Root, ...]:
        """Where the curves are over a value of the first parameter."""
        return roots(self._cut(self.names[0], x), self.names[1])

    def arcs(self) -> Iterator[Arc]:
        """All arcs over the intervals between walls, and those of upright curves at rational values.

        >>> from singsym.polynomials import Ring
        >>> a, b = Ring(("a", "b")).gens
        >>> [(str(arc.curve), arc.point) for arc in Plane(("a", "b"), (a - 1, a - 2 * b)).arcs()]
        [('a - 2*b', (0, 0)), ('a - 2*b', (2, 1)), ('a - 1', (1, 0)), ('a - 1', (1, 1))]
        """
        for i, (x, _) in enumerate(self.stacks):
            for j, root in enumerate(self._over(x)):
                curve = next(f for f in self.curves if self._is_on(f, x, root))
                yield Arc(curve, (sympy.Rational(x), root.value), root.degree, ((i, j), (i, j + 1)))
        for i, wall in enumerate(self.walls):
            if wall.polynomial in self.curves and wall.low == wall.high:
                for y in samples(self._over(wall.low)):
                    sides = self._across(i, wall, y, [f for f in self.curves if f != wall.polynomial])
                    if sides is not None:
                        point = (sympy.Rational(wall.low), sympy.Rational(y))
                        yield Arc(wall.polynomial, point, 1, sides)

    def _is_on(self, curve: Polynomial, x: Fraction, root: Root) -> bool:
        """Whether a curve goes through a point over a value of the first parameter."""
        cut = curve.substitute({self.names[0]: x})
        return not cut.is_constant and any(f == root.polynomial for f, _ in cut.factors())

    def _cut(self, name: str, value: Fraction) -> list[Polynomial]:
        return [p for f in self.curves if not (p := f.substitute({name: value})).is_constant]

    def sample(self, place: Place) -> tuple[Fraction, Fraction]:
        """The sample of a cell."""
        x, ordinates = self.stacks[place[0]]
        return x, ordinates[place[1]]

    @cached_property
    def components(self) -> tuple[tuple[Place, ...], ...]:
        """The cells, those together that are seen to be one.

        >>> from singsym.polynomials import Ring
        >>> a, b = Ring(("a", "b")).gens
        >>> len(Plane(("a", "b"), (a - b, a + b)).components)
        4
        """
        graph = networkx.Graph()
        for i, (_, ordinates) in enumerate(self.stacks):
            graph.add_nodes_from((i, j) for j in range(len(ordinates)))
        for i, wall in enumerate(self.walls):
            graph.add_edges_from(self._joined(i, wall))
        return tuple(tuple(sorted(part)) for part in networkx.connected_components(graph))

    def _joined(self, i: int, wall: Root) -> Iterator[tuple[Place, Place]]:
        """Pairs of cells of the stacks to both sides of a wall that are one."""
        for y in self._gaps(float(wall)):
            sides = self._across(i, wall, y, self.curves)
            if sides is not None:
                yield sides

    def _across(
        self, i: int, wall: Root, y: Fraction, curves: Sequence[Polynomial]
    ) -> tuple[Place, Place] | None:
        """The cells at both ends of a segment across a wall that is proven to meet none of some curves."""
        low, high = wall.narrow(50)
        before, after = self.stacks[i][0], self.stacks[i + 1][0]
        for part in (16, 4096, 2**24):
            left, right = low - (low - before) / part, high + (after - high) / part
            bounds = {self.names[0]: (left, right), self.names[1]: (y, y)}
            if all(sign_within(f, bounds) for f in curves):
                return (i, self._number(left, y)), (i + 1, self._number(right, y))
        return None

    def heights(self, x: float) -> list[float]:
        """The second parameter's values on the curves over one of the first, numerically, in order."""
        (own, other), found = self.names, list[float]()
        for f in self.curves:
            i, j = f.ring.index(own), f.ring.index(other)
            coefficients = np.zeros(f.degree(other) + 1)
            for m, c in f.terms():
                coefficients[int(m[j])] += int(c.p) / int(c.q) * x ** int(m[i])
            found += [z.real for z in np.roots(coefficients[::-1]) if abs(z.imag) < 1e-5 * (1 + abs(z))]
        return sorted(found)

    def _gaps(self, x: float) -> list[Fraction]:
        """Values of the second parameter between the curves, numerically: where to try to join."""
        ends = self.heights(x)
        if not ends:
            return [Fraction(0)]
        gaps = [(a, b) for a, b in pairwise(ends) if b - a > 1e-4 * (1 + abs(a))]
        inner = [simple_between(Fraction(a), Fraction(b)) for a, b in gaps]
        return [Fraction(int(ends[0]) - 2), *inner, Fraction(int(ends[-1]) + 2)]

    def _number(self, x: Fraction, y: Fraction) -> int:
        """How many curves are below a point off the walls."""
        name = self.names[1]
        shifted = [p.substitute({name: p.ring.gen(name) + y}) for p in self._cut(self.names[0], x)]
        return sum(root.high <= 0 for root in roots(shifted, name))


def _resultant(f: Polynomial, g: Polynomial, name: str) -> Polynomial:
    return Polynomial(f.ring, f.value.resultant(g.value, name))


def signs(curves: Sequence[Polynomial], values: dict[str, Fraction]) -> tuple[int, ...]:
    """The sign of each curve's polynomial at a point.

    >>> from singsym.polynomials import Ring
    >>> a, b = Ring(("a", "b")).gens
    >>> signs((a - b, a + b), {"a": Fraction(1), "b": Fraction(2)})
    (-1, 1)
    """
    found = (f.substitute(values).constant for f in curves)
    return tuple(int(x > 0) - int(x < 0) for x in found)
