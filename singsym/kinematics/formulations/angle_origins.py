"""From which direction an angle is counted inside: one with which few irrational numbers come in.

A joint's own angle phi is counted from `Geometry.zero`.  For each constant gamma Rot(u, phi) is
Rot(u, phi - gamma) Rot(u, gamma), so cosine and sine of phi - gamma may be the variables as well.
Source: singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import sympy

from singsym.kinematics.formulations import local


@dataclass(frozen=True)
class Origin:
    """The angle between a joint's own zero and where its variables are counted from: its cosine and sine.

    after: the constant rotation that follows the one by the variable angle.
    """

    after: local.Matrix
    cosine: sympy.Expr = sympy.S.One
    sine: sympy.Expr = sympy.S.Zero

    @property
    def is_own(self) -> bool:
        """Whether the variables are those of the joint's own angle."""
        return bool(self.cosine == 1)


def simplest_origin(
    axis: local.Vector, after: local.Matrix, before: Sequence[local.Vector], behind: Sequence[local.Vector]
) -> Origin:
    """The origin with which the fewest irrational numbers say where the directions `behind` a joint are.

    axis: of the joint, a unit vector; after: the rotation at the joint's own zero; before: directions of the
    link before the joint.  The candidates bring one direction behind it into a plane with one before it, as
    far as no other square roots come in; the joint's own zero is kept where none is better.

    >>> x, _, z = local.UNITS
    >>> aslant = (sympy.Rational(1, 2), sympy.sqrt(3) / 2, sympy.S.Zero)
    >>> found = simplest_origin(z, local.IDENTITY, [x], [aslant])
    >>> found.cosine, found.sine
    (1/2, -sqrt(3)/2)
    """
    best = Origin(after)
    fewest = _irrational(axis, after, behind)
    if not fewest:
        return best
    known = _roots(x for v in (axis, *after, *before, *behind) for x in v)
    for start in _across(axis, [local.apply(after, w) for w in behind], known):
        for end in _across(axis, [*before, *local.UNITS], known):
            cosine, sine = local.dot(start, end), local.dot(axis, local.cross(start, end))
            turned = local.product(local.rotation(axis, cosine, sine), after)
            count = _irrational(axis, turned, behind)
            if count < fewest and _roots((cosine, sine)) <= known:
                best, fewest = Origin(turned, cosine, sine), count
    return best


def _across(
    axis: local.Vector, directions: Iterable[local.Vector], known: set[sympy.Expr]
) -> Iterator[local.Vector]:
    """Unit vectors along the parts of directions across an axis, without other roots than those known."""
    for direction in directions:
        across = local.minus(direction, local.times(local.dot(direction, axis), axis))
        if not local.vanishes(across):
            found = local.unit(tuple(map(local.tidy, across)))
            if _roots(found) <= known:
                yield found


def _irrational(axis: local.Vector, after: local.Matrix, behind: Iterable[local.Vector]) -> int:
    """How many irrational numbers say where directions are, as they turn."""
    turned = [local.apply(after, w) for w in behind]
    return sum(bool(_roots((x,))) for v in turned for x in (*v, *local.cross(axis, v)))


def _roots(numbers: Iterable[sympy.Expr]) -> set[sympy.Expr]:
    """The square roots and the like in some numbers."""
    powers = (power for x in numbers for power in sympy.sympify(x).atoms(sympy.Pow, sympy.Function))
    return {p for p in powers if not (p.is_Pow and p.exp.is_Integer)}
