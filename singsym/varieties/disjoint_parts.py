"""Sets that come apart because a few of their equations do: a dyad in line is stretched, or folded.

Source: V(I + J) is the disjoint union of all V(I_k + J) where V(I) is that of all V(I_k).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import combinations

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import remember
from singsym.polynomials import Equations
from singsym.varieties.decomposition import Component, decompose

MOST_VARIABLES = 6
"""Equations in more variables than two points that move and one more are not taken apart."""


def disjoint_parts(equations: Equations) -> tuple[Equations, ...]:
    """The same zeros as a disjoint union; `equations` alone where they are not seen to come apart.

    >>> from singsym.polynomials import Ring
    >>> x, y, u, v, w = Ring(("x", "y", "u", "v", "w")).gens
    >>> dyad = ((u - x) ** 2 + (v - y) ** 2 - 49, (u - 3) ** 2 + (v + 1) ** 2 - 25)
    >>> in_line = (x - 3) * (v + 1) - (y + 1) * (u - 3)
    >>> for part in disjoint_parts((*dyad, in_line, w + u)):
    ...     part[:3]
    (u + w, 5*y + 2*v + 7, 5*x + 2*u - 21)
    (u + w, 5*y - 12*v - 7, 5*x - 12*u + 21)
    """
    if not equations:
        return (equations,)
    return remember("disjoint parts", (equations[0].ring, equations), lambda: tuple(_parts(equations)))


def _parts(equations: Equations) -> Iterator[Equations]:
    for group in _groups(equations):
        own = remember("a few equations apart", (group[0].ring, frozenset(group)), partial(_apart, group))
        if own is not None:
            taken = set(group) - set(equations[0].ring.relations)
            others = tuple(p for p in equations if p not in taken)
            for part in own:
                yield from _parts((*others, *part))
            return
    yield equations


def _groups(equations: Equations) -> Iterator[Equations]:
    """Some of the equations: all in the variables of one of them, that are more than a dyad.

    Lengths and points in line are of second degree.  First without those in fewer than half of these, which
    say where one of three moving points is; then with those that a length was shortened by.
    """
    quadrics = [p for p in equations if p.total_degree <= 2]
    for last in reversed(quadrics):
        names = set(last.variables)
        group = tuple(p for p in quadrics if names.issuperset(p.variables))
        between = tuple(p for p in group if 2 * len(p.variables) >= len(names))
        for own in dict.fromkeys((between, _with_squares(between, group), group)):
            if 2 < len(own) < len(equations) and len(names) <= MOST_VARIABLES:
                yield own


def _with_squares(between: Equations, group: Equations) -> Equations:
    """With those of a group that have the squares of unknowns of which lengths have none.

    One of them was taken away where |PA| = |PC| makes P C of both.
    """
    bare = {name for p in between for name in p.variables if len(p.variables) <= 4 and p.degree(name) == 1}
    return tuple(p for p in group if p in between or any(p.degree(name) == 2 for name in bare))


def _apart(group: Equations) -> tuple[Equations, ...] | None:
    """Disjoint parts of a few equations, each given by as many as it has codimensions; `None` if not seen."""
    names = {name for p in group for name in p.variables}
    constants = {c.name for c in group[0].ring.constants} & names
    ring = group[0].ring.subring(names)
    with attempt("equations that come apart", patience.APART.work):
        found = decompose(tuple(map(ring.convert, group)), ring=ring)
        free = len(ring.names) - len(constants)
        if found.certainty == "proven" and len(found.value) > 1 and _are_disjoint(found.value):
            known = {p.primitive() for p in ring.relations}
            own = tuple(map(ring.convert, group))
            parts = [
                _shortly(
                    tuple(p for p in c.generators if p.primitive() not in known), own, free - c.dimension
                )
                for c in found.value
            ]
            if all(len(p) == free - c.dimension for p, c in zip(parts, found.value, strict=True)):
                whole = group[0].ring
                return tuple(tuple(map(whole.convert, part)) for part in parts)
    return None


def _shortly(part: Equations, group: Equations, codimension: int) -> Equations:
    """The part by its linear equations and one or two of the group's, in few variables, where these will do.

    What is known of these variables by other equations is seen there again.
    """
    linear = tuple(p for p in part if p.total_degree == 1)
    rest, left = [p for p in part if p not in linear], codimension - len(linear)
    if not rest or left not in (1, 2):
        return part
    others = sorted((p for p in group if p.total_degree > 1), key=lambda p: (len(p.variables), len(p)))
    for known in combinations(others, left):
        ideal = Ideal(part[0].ring, (*linear, *known))
        inside = [ideal.contains(p) for p in rest]
        if all(found.value and found.is_proven for found in inside):
            return (*linear, *known)
    return part


def _are_disjoint(components: tuple[Component, ...]) -> bool:
    for one, other in combinations(components, 2):
        empty = Ideal(one.ideal.ring, (*one.generators, *other.generators)).is_unit()
        if not empty.value or empty.certainty != "proven":
            return False
    return True
