"""The cheap steps of splitting: factor, drop what is known not to vanish, substitute, and order the work.

Source: the factorising Buchberger and characteristic-set algorithms (Czapor 1989; Wang 1993); the order is
the block structure of equations against variables, as in the Dulmage-Mendelsohn decomposition.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from singsym.polynomials import Polynomial, Ring

Factored = tuple[Polynomial, ...]


def irreducible_factors(polynomials: Iterable[Polynomial]) -> frozenset[Polynomial] | None:
    """All irreducible factors of polynomials that are not to vanish; None where one of them is zero.

    >>> x, y = Ring(("x", "y")).gens
    >>> sorted(map(str, irreducible_factors([x * y, 2 * x**2])))
    ['x', 'y']
    """
    found: set[Polynomial] = set()
    for p in polynomials:
        if p.is_zero:
            return None
        found.update(f for f, _ in p.factors())
    return frozenset(found)


def factor_equations(
    equations: Iterable[Polynomial], nonzero: frozenset[Polynomial]
) -> tuple[Factored, ...] | None:
    """Each equation as its distinct irreducible factors outside `nonzero`; None where one cannot vanish.

    >>> x, y = Ring(("x", "y")).gens
    >>> factor_equations([x**2 * y, y * (y - 1)], frozenset([y]))
    ((x,), (y - 1,))
    """
    found: set[Factored] = set()
    for p in equations:
        if p.is_zero:
            continue
        factors = tuple(f for f, _ in p.factors() if f not in nonzero)
        if not factors:
            return None
        found.add(factors)
    single = {f[0] for f in found if len(f) == 1}
    kept = [f for f in found if len(f) == 1 or single.isdisjoint(f)]
    return tuple(sorted(kept, key=lambda f: (len(f) > 1, sum(map(len, f)), str(f))))


@dataclass(frozen=True)
class Level:
    """A step of the work: the equations to add, and the variables that occur from here on."""

    names: tuple[str, ...]
    equations: tuple[Polynomial, ...]


def levels(equations: Sequence[Polynomial]) -> tuple[Level, ...]:
    """Equations in the order of growing sets of variables, cut where dimension is expected to drop.

    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> [level.names for level in levels([x**2 + y**2 - z, x - y, x * y - 1])]
    [('x', 'y'), ('x', 'y', 'z')]
    """
    if not equations:
        return ()
    measured = [(frozenset(p.variables), (p.total_degree, len(p)), p) for p in equations]
    best = min((_grow(seed, measured) for seed in measured), key=_cost)
    order = equations[0].ring.names
    cut: list[Level] = []
    pending: list[Polynomial] = []
    for i, (variables, p) in enumerate(best):
        pending.append(p)
        excess = len(variables) - (i + 1)
        if i + 1 == len(best) or (len(best[i + 1][0]) > len(variables) and excess <= _next_minimum(best, i)):
            cut.append(Level(tuple(n for n in order if n in variables), tuple(pending)))
            pending = []
    return tuple(cut)


def _cost(steps: Sequence[tuple[frozenset[str], Polynomial]]) -> tuple[int, list[int], list[int]]:
    """Few variables early; among equals, the equations that connect most variables early."""
    counts = [len(v) for v, _ in steps]
    return sum(counts), counts, [-len(p.variables) for _, p in steps]


_Measured = tuple[frozenset[str], tuple[int, int], Polynomial]
"""An equation with its variables, its degree and its number of terms."""


def _grow(seed: _Measured, equations: Sequence[_Measured]) -> list[tuple[frozenset[str], Polynomial]]:
    """The variables seen so far beside each equation, taking next what adds fewest variables."""
    seen = seed[0]
    rest = [p for p in equations if p is not seed]
    steps = [(seen, seed[2])]
    while rest:
        chosen = min(rest, key=lambda p: (len(p[0] - seen), p[1]))
        rest.remove(chosen)
        seen |= chosen[0]
        steps.append((seen, chosen[2]))
    return steps


def _next_minimum(steps: Sequence[tuple[frozenset[str], Polynomial]], i: int) -> int:
    """The excess of variables over equations just after the next new variables enter."""
    return len(steps[i + 1][0]) - (i + 2)


def used_ring(ring: Ring, polynomials: Iterable[Polynomial]) -> Ring:
    """The ring in those variables that occur."""
    return ring.subring({name for p in polynomials for name in p.variables})
