"""Exact geometry within one link's frame: unit vectors, perpendiculars, the zero of a joint angle.

Source: textbook vector algebra; the shortest rotation between two directions is Rodrigues' formula.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy

from singsym.kinematics.dimensions import Dimensions
from singsym.mechanism.model import Joint, JointKind, Mechanism, Space

Vector = tuple[sympy.Expr, ...]
Matrix = tuple[Vector, ...]

IDENTITY: Matrix = tuple(tuple(sympy.Integer(int(i == j)) for j in range(3)) for i in range(3))
UNITS: tuple[Vector, ...] = IDENTITY


def tidy(expression: sympy.Expr) -> sympy.Expr:
    """The same number expanded, common factors of parameters cancelled, no root in a denominator.

    >>> tidy(1 / sympy.sqrt(3))
    sqrt(3)/3
    """
    expanded = sympy.expand(expression)
    if expanded.is_Rational or expanded.has(sympy.sin, sympy.cos, sympy.tan):
        return expanded
    if expanded.free_symbols:
        expanded = sympy.cancel(expanded)
    return sympy.expand(sympy.radsimp(expanded))


def is_zero(expression: sympy.Expr) -> bool:
    """Whether a number or an expression in parameters is identically zero.

    >>> is_zero(sympy.sqrt(2) * sympy.sqrt(3) - sympy.sqrt(6))
    True
    """
    expanded = sympy.expand(expression)
    if expanded.is_Rational:
        return bool(expanded == 0)
    if expanded.free_symbols:
        numerator = sympy.fraction(sympy.together(expanded))[0]
        polynomial = sympy.Poly(numerator, *sorted(expanded.free_symbols, key=str))
        return all(is_zero(coefficient) for coefficient in polynomial.coeffs())
    if abs(expanded.evalf(40)) > sympy.Rational(1, 10**30):
        return False
    return Dimensions.of_expressions((expanded,)).is_zero(expanded)


def plus(a: Vector, b: Vector) -> Vector:
    """The sum of two vectors."""
    return tuple(x + y for x, y in zip(a, b, strict=True))


def minus(a: Vector, b: Vector) -> Vector:
    """The difference of two vectors."""
    return tuple(x - y for x, y in zip(a, b, strict=True))


def times(factor: sympy.Expr | int, a: Vector) -> Vector:
    """A multiple of a vector."""
    return tuple(factor * x for x in a)


def dot(a: Vector, b: Vector) -> sympy.Expr:
    """The scalar product, in a short form."""
    return tidy(sum((x * y for x, y in zip(a, b, strict=True)), start=sympy.Integer(0)))


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product."""
    return (
        tidy(a[1] * b[2] - a[2] * b[1]),
        tidy(a[2] * b[0] - a[0] * b[2]),
        tidy(a[0] * b[1] - a[1] * b[0]),
    )


def vanishes(a: Vector) -> bool:
    """Whether all components are zero, exactly."""
    return all(is_zero(x) for x in a)


def apply(matrix: Matrix, a: Vector) -> Vector:
    """A matrix times a vector."""
    return a if matrix is IDENTITY else tuple(dot(row, a) for row in matrix)


def transpose(matrix: Matrix) -> Matrix:
    """The transposed matrix."""
    return tuple(zip(*matrix, strict=True))


def product(a: Matrix, b: Matrix) -> Matrix:
    """The product of two matrices."""
    if a is IDENTITY or b is IDENTITY:
        return b if a is IDENTITY else a
    columns = transpose(b)
    return tuple(tuple(dot(row, column) for column in columns) for row in a)


def unit(vector: Vector) -> Vector:
    """The unit vector along a vector; raises `ValueError` for the zero vector.

    >>> unit((sympy.Integer(3), sympy.Integer(0), sympy.Integer(4)))
    (3/5, 0, 4/5)
    """
    square = dot(vector, vector)
    if is_zero(square - 1):
        return vector
    if is_zero(square):
        raise ValueError("an axis has the direction (0, 0, 0): give a nonzero vector")
    return tuple(tidy(x / sympy.sqrt(square)) for x in vector)


def parallel(a: Vector, b: Vector) -> int:
    """1 or -1 for equal or opposite unit vectors, else 0.

    >>> parallel((0, 0, 1), (0, 0, -1))
    -1
    """
    if vanishes(minus(a, b)):
        return 1
    return -1 if vanishes(plus(a, b)) else 0


def shortest_rotation(start: Vector, end: Vector) -> Matrix:
    """The rotation by the smallest angle that takes one unit vector to another; rational in them.

    For opposite vectors it goes through a coordinate axis.
    """
    sense = parallel(start, end)
    if sense == 1:
        return IDENTITY
    if sense == -1:
        middle = next(e for e, x in zip(UNITS, end, strict=True) if not is_zero(x**2 - 1))
        return product(shortest_rotation(middle, end), shortest_rotation(start, middle))
    v, cosine = cross(start, end), dot(start, end)
    skew = ((sympy.Integer(0), -v[2], v[1]), (v[2], sympy.Integer(0), -v[0]), (-v[1], v[0], sympy.Integer(0)))
    square = product(skew, skew)
    return tuple(
        tuple(tidy(IDENTITY[i][j] + skew[i][j] + square[i][j] / (1 + cosine)) for j in range(3))
        for i in range(3)
    )


def rotation(axis: Vector, cosine: sympy.Expr, sine: sympy.Expr) -> Matrix:
    """The rotation about a unit vector by an angle of this cosine and sine.

    >>> rotation(UNITS[2], sympy.Integer(0), sympy.Integer(1))
    ((0, -1, 0), (1, 0, 0), (0, 0, 1))
    """
    columns = [
        plus(plus(times(cosine, e), times(sine, cross(axis, e))), times((1 - cosine) * dot(axis, e), axis))
        for e in UNITS
    ]
    return tuple(tuple(map(tidy, row)) for row in transpose(tuple(columns)))


def perpendiculars(axis: Vector) -> tuple[Vector, Vector]:
    """Vectors n1, n2 of one length with (n1, n2, axis) a right-handed right-angled system.

    Rational in the axis; coordinate axes where possible, else not of length 1.

    >>> perpendiculars((0, 0, 1))
    ((1, 0, 0), (0, 1, 0))
    """
    for index in range(3):
        if is_zero(axis[index]):
            return UNITS[index], cross(axis, UNITS[index])
    n1 = cross(UNITS[0], axis)
    return n1, cross(axis, n1)


def coordinates(basis: Sequence[Vector], vector: Vector) -> Vector | None:
    """The coefficients of a vector in 1 or 3 basis vectors; None where one does not suffice."""
    if len(basis) == 1:
        direction = basis[0]
        factor = tidy(dot(vector, direction) / dot(direction, direction))
        return (factor,) if vanishes(minus(vector, times(factor, direction))) else None
    a, b, c = basis
    volume = dot(cross(a, b), c)
    return tuple(tidy(dot(vector, cross(u, v)) / volume) for u, v in ((b, c), (c, a), (a, b)))


def is_collinear(points: Sequence[Vector]) -> bool:
    """Whether points lie on one line (or coincide)."""
    differences = [minus(p, points[0]) for p in points[1:]]
    nonzero = [d for d in differences if not vanishes(d)]
    return all(vanishes(cross(nonzero[0], d)) for d in nonzero[1:])


def in_space(vector: Vector) -> Vector:
    """A planar vector with third component 0, a spatial one as it is."""
    return vector if len(vector) == 3 else (*vector, sympy.Integer(0))


class Geometry:
    """The named points and axes of a resolved mechanism's links as exact vectors of space.

    A planar mechanism lies in the plane z = 0 and its pins point along z; the joints of a spherical one
    have their points at the origin where none is given.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism

    def point(self, link: str, name: str) -> Vector:
        """A point of a link, in its frame; raises `ValueError` naming the link's points."""
        points = self.mechanism.link(link).points
        if name in points:
            return in_space(points[name])
        if self.mechanism.space is Space.SPHERICAL:
            return (sympy.Integer(0),) * 3
        raise ValueError(f"link {link!r} has no point {name!r}; its points are {sorted(points)}")

    def axis(self, link: str, name: str) -> Vector:
        """A unit direction of a link, in its frame; raises `ValueError` naming the link's axes."""
        axes = self.mechanism.link(link).axes
        if name not in axes:
            raise ValueError(f"link {link!r} has no axis {name!r}; its axes are {sorted(axes)}")
        return unit(in_space(axes[name]))

    def points(self, joint: Joint) -> tuple[Vector, Vector]:
        """The joint's point in its two links."""
        return self.point(joint.first, joint.at[0]), self.point(joint.second, joint.at[1])

    def axes(self, joint: Joint) -> tuple[Vector, Vector]:
        """The joint's direction in its two links; the normal of the plane for a planar pin."""
        if joint.axes is None:
            if self.mechanism.space is not Space.PLANAR or joint.kind is JointKind.P:
                raise ValueError(f"joint {joint.name!r} ({joint.kind}) needs an axis in both links")
            return UNITS[2], UNITS[2]
        return self.axis(joint.first, joint.axes[0]), self.axis(joint.second, joint.axes[1])

    def directions(self, link: str, joint: Joint) -> list[Vector]:
        """Vectors from a joint's point to a link's other points, then the link's unit axes, in its frame."""
        own = self.mechanism.link(link)
        here = self.points(joint)[0 if link == joint.first else 1]
        arms = [minus(in_space(p), here) for p in own.points.values()]
        return [*(a for a in arms if not vanishes(a)), *(self.axis(link, name) for name in own.axes)]

    def zero(self, joint: Joint) -> Matrix:
        """The rotation of `second`'s frame in `first`'s where the joint's angle is zero.

        For U: where both its axes are as the two links' frames have them, turned to a right angle.
        """
        a, b = self.axes(joint)
        if joint.kind is JointKind.U:
            if is_zero(dot(a, b)):
                return IDENTITY
            rest = minus(b, times(dot(a, b), a))
            return shortest_rotation(b, unit(perpendiculars(a)[0] if vanishes(rest) else rest))
        if joint.reference is None:
            return shortest_rotation(b, a)
        x = self.axis(joint.first, joint.reference[0])
        y = self.axis(joint.second, joint.reference[1])
        return product(transpose((x, cross(a, x), a)), (y, cross(b, y), b))
