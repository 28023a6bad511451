"""Unit vectors among the variables of a system: pairs whose squares have the sum 1.

Source: the formulation by cosine and sine, see `kinematics.placement`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from singsym.polynomials import Polynomial, Ring

Pair = tuple[str, str]


def circle(ring: Ring, names: Pair) -> Polynomial:
    """The equation x^2 + y^2 - 1 of two variables."""
    x, y = map(ring.gen, names)
    return x * x + y * y - 1


def unit_circles(equations: Iterable[Polynomial]) -> Iterator[Pair]:
    """The pairs that some equation makes a unit vector, in the order of the equations.

    >>> c, s, x = Ring(("c", "s", "x")).gens
    >>> list(unit_circles([2 * c**2 + 2 * s**2 - 2, x**2 - 1]))
    [('c', 's')]
    """
    for p in equations:
        if len(p) == 3 and p.total_degree == 2 and len(p.variables) == 2:
            pair = (p.variables[0], p.variables[1])
            if p.primitive() == circle(p.ring, pair):
                yield pair
