"""Points, lines and planes as vectors of polynomials, and their joins, meets and brackets.

Source: N. L. White, "The bracket of 2-extensors" (1983); P. Ben-Horin, M. Shoham, "Singularity condition of
six-degree-of-freedom three-legged parallel robots based on Grassmann-Cayley algebra" (2006).  A twist
is (w, v) with v at the origin, in the plane (w, vx, vy); a wrench is a force and its moment about the origin,
in Plücker's order, so that a line is the wrench of a force along it.
"""

from __future__ import annotations

from collections.abc import Sequence

from singsym.kinematics.placement import cross, dot
from singsym.polynomials import Polynomial

Vector = tuple[Polynomial, ...]


def minus(a: Vector, b: Vector) -> Vector:
    """a - b."""
    return tuple(p - q for p, q in zip(a, b, strict=True))


def along(point: Vector, direction: Vector) -> Vector:
    """The Plücker vector of a line through a point: its direction, and its moment about the origin."""
    if len(point) == 2:
        return (*direction, point[0] * direction[1] - point[1] * direction[0])
    return (*direction, *cross(point, direction))


def join(p: Vector, q: Vector) -> Vector:
    """The Plücker vector of the line through two points, p v q: (q - p, p x q).

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> join((x, y), (x + 1, y))
    (1, 0, -y)
    """
    return along(p, minus(q, p))


def plane(p: Vector, q: Vector, r: Vector) -> Vector:
    """The plane p v q v r through three points: its normal (q - p) x (r - p), and that times -p."""
    normal = cross(minus(q, p), minus(r, p))
    return (*normal, -dot(normal, p))


def felt(twist: Vector, planar: bool) -> Vector:
    """The vector whose scalar product with a wrench is its power on a twist: zero where they are reciprocal.

    In spherical motion a wrench is a moment, and this the twist itself.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> one = x.ring.one
    >>> dot(along((x, y), (one, y)), felt((one, y, -x), planar=True))
    0
    """
    if len(twist) == 3 and not planar:
        return twist
    turns = 1 if planar else 3
    return (*twist[turns:], *twist[:turns])


def determinant(rows: Sequence[Vector]) -> Polynomial:
    """The bracket of three vectors: their determinant."""
    return dot(rows[0], cross(rows[1], rows[2]))
