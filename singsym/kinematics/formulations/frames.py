"""Bodies in space as polynomials: where a link's points and directions are.

Source: textbook rigid-body kinematics; natural coordinates as in Garcia de Jalon, Bayo (1994), chapter 2.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import sympy

from singsym.kinematics.formulations import local
from singsym.kinematics.placement import Coordinates
from singsym.polynomials import Polynomial, Ring


class Unplaced(ValueError):
    """A point or direction that the chosen variables don't determine."""


@dataclass(frozen=True)
class Algebra:
    """Vectors of polynomials over one ring, kept reduced modulo its constants' minimal polynomials.

    convert: exact SymPy number to polynomial.
    """

    ring: Ring
    convert: Callable[[sympy.Expr], Polynomial]
    _known: dict[sympy.Expr, Polynomial] = field(default_factory=dict, compare=False, repr=False)

    def number(self, expression: sympy.Expr) -> Polynomial:
        """A dimension as a polynomial of the ring."""
        found = self._known.get(expression)
        if found is None:
            found = self._known[expression] = self.convert(expression)
        return found

    def vector(self, components: Sequence[sympy.Expr]) -> Coordinates:
        """Components as constant polynomials."""
        return tuple(self.number(x) for x in components)

    @cached_property
    def axes(self) -> tuple[Coordinates, ...]:
        """The fixed frame's unit vectors."""
        return tuple(self.vector(e) for e in local.UNITS)

    @property
    def origin(self) -> Coordinates:
        """The zero vector."""
        return (self.ring.zero,) * 3

    def variables(self, names: Sequence[str]) -> Coordinates:
        """Variables of the ring as a vector."""
        return tuple(self.ring.gen(name) for name in names)

    def dot(self, a: Coordinates, b: Coordinates) -> Polynomial:
        """The scalar product, reduced."""
        total = self.ring.zero
        for x, y in zip(a, b, strict=True):
            if x and y:
                total = total + x * y
        return self.ring.reduced(total)

    def cross(self, a: Coordinates, b: Coordinates) -> Coordinates:
        """The vector product, reduced."""
        return tuple(self.ring.reduced(a[i] * b[j] - a[j] * b[i]) for i, j in ((1, 2), (2, 0), (0, 1)))

    def combination(self, factors: Sequence[Polynomial], vectors: Sequence[Coordinates]) -> Coordinates:
        """sum of factors[i] * vectors[i]."""
        total = self.origin
        for factor, vector in zip(factors, vectors, strict=True):
            if factor:
                total = tuple(t + factor * v for t, v in zip(total, vector, strict=True))
        return tuple(self.ring.reduced(t) for t in total)


def plus(a: Coordinates, b: Coordinates) -> Coordinates:
    """The sum of two vectors."""
    return tuple(x + y for x, y in zip(a, b, strict=True))


def minus(a: Coordinates, b: Coordinates) -> Coordinates:
    """The difference of two vectors."""
    return tuple(x - y for x, y in zip(a, b, strict=True))


@dataclass(frozen=True)
class Body:
    """A placed link: the position of one of its points, and 0, 1 or 3 of its vectors.

    anchor, place: that point in space, and in the link's frame.
    basis, inner: those vectors in space, and in the link's frame.  One vector: a link of which
        only the line through the anchor is placed.
    """

    algebra: Algebra
    anchor: Coordinates
    place: local.Vector
    basis: tuple[Coordinates, ...]
    inner: tuple[local.Vector, ...]

    def direction(self, vector: local.Vector) -> Coordinates:
        """A vector of the link in the fixed frame; raises `Unplaced`."""
        if local.vanishes(vector):
            return self.algebra.origin
        if self.inner is local.IDENTITY:
            return self.algebra.combination(self.algebra.vector(vector), self.basis)
        factors = local.coordinates(self.inner, vector) if self.inner else None
        if factors is None:
            raise Unplaced(f"the link is placed along a line only: {vector} is not on it")
        return self.algebra.combination(self.algebra.vector(factors), self.basis)

    def point(self, position: local.Vector) -> Coordinates:
        """A point of the link in the fixed frame; raises `Unplaced`."""
        return plus(self.anchor, self.direction(local.minus(position, self.place)))

    @cached_property
    def frame(self) -> tuple[Coordinates, ...]:
        """The unit vectors of the link's frame."""
        if self.inner is local.IDENTITY:
            return self.basis
        return tuple(self.direction(e) for e in local.UNITS)


def rigid(algebra: Algebra, origin: Coordinates, frame: tuple[Coordinates, ...]) -> Body:
    """A body by its frame's origin and unit vectors."""
    return Body(algebra, origin, (sympy.Integer(0),) * 3, frame, local.IDENTITY)


def composed(algebra: Algebra, frame: Sequence[Coordinates], matrix: local.Matrix) -> tuple[Coordinates, ...]:
    """The frame turned by a constant rotation given in it."""
    if matrix is local.IDENTITY:
        return tuple(frame)
    return tuple(algebra.combination(algebra.vector(column), frame) for column in local.transpose(matrix))


def turned(
    algebra: Algebra, frame: Sequence[Coordinates], axis: local.Vector, cosine: Polynomial, sine: Polynomial
) -> tuple[Coordinates, ...]:
    """The frame turned about a unit axis given in it: c (1 - u u^T) + s [u] + u u^T."""
    u = algebra.vector(axis)
    columns = []
    for j in range(3):
        e = algebra.axes[j]
        skew = algebra.cross(u, e)
        rotated = (cosine * (e[i] - u[i] * u[j]) + sine * skew[i] + u[i] * u[j] for i in range(3))
        columns.append(algebra.combination(tuple(map(algebra.ring.reduced, rotated)), frame))
    return tuple(columns)
