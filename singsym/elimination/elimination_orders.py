"""Elimination with orders that every engine has: weights enter as powers of the eliminated variables.

Source: D. Cox, J. Little, D. O'Shea, Ideals, Varieties, and Algorithms, 3.1 and 4.2 (Rabinowitsch).
Lemma: x -> x^w maps Groebner bases to Groebner bases; if every basis element whose leading monomial is free
of x is itself free of x, then these elements generate the elimination ideal, whatever the weight w.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import count, islice

from singsym.effort.budget import Budget
from singsym.effort.verdict import Known, Premises
from singsym.elimination import engines
from singsym.elimination.basis import canonical, groebner_basis
from singsym.elimination.linear_substitution import connected, substitute_solved
from singsym.elimination.memo import remember
from singsym.polynomials import Polynomial, Ring

Generators = tuple[Polynomial, ...]

_LARGEST_WEIGHT = 4000


def without_zeros_of(
    ring: Ring, generators: Sequence[Polynomial], *polynomials: Polynomial
) -> tuple[Ring, tuple[Polynomial, ...]]:
    """The generators and 1 - t p for each p, in a ring with new first variables t.

    >>> x, = Ring(("x",)).gens
    >>> without_zeros_of(x.ring, (x**2 - x,), x)[1]
    (x^2 - x, -t0*x + 1)
    """
    new = (f"t{k}" for k in count() if f"t{k}" not in ring.names)
    names = tuple(islice(new, len(polynomials)))
    larger = ring.with_names((*names, *ring.names))
    excluded = (1 - larger.gen(t) * larger.convert(p) for t, p in zip(names, polynomials, strict=True))
    return larger, (*map(larger.convert, generators), *excluded)


def eliminate(
    ring: Ring, generators: Sequence[Polynomial], names: Collection[str], budget: Budget
) -> Known[Generators]:
    """Generators of the elements free of `names`; the ring's order is degrevlex.

    Raises what `groebner_basis` raises.
    """
    generators = canonical(ring, generators)
    key = (ring, frozenset(generators), frozenset(names))
    return remember("eliminate", key, lambda: _eliminate(ring, generators, names, budget), budget)


def _eliminate(
    ring: Ring, generators: Sequence[Polynomial], names: Collection[str], budget: Budget
) -> Known[Generators]:
    rest, _ = substitute_solved(generators, names)
    kept: list[Polynomial] = []
    premises = Premises()
    for group in connected(rest):
        inside = {n for p in group for n in p.variables}
        if any(p.is_constant for p in group):
            return Known((ring.one,))
        if not inside & set(names):
            kept += group
        elif not inside <= set(names) or len(group) > 1:
            kept += premises.take(_eliminate_group(ring, group, inside & set(names), budget))
    return premises.conclude(canonical(ring, kept))


def _eliminate_group(
    ring: Ring, group: Sequence[Polynomial], names: Collection[str], budget: Budget
) -> Known[Generators]:
    positions = [ring.index(n) for n in names]
    weight = max(2, max(p.total_degree for p in group))
    while weight < _LARGEST_WEIGHT:
        budget.check("elimination")
        premises = Premises()
        try:
            stretched = [_stretched(p, positions, weight) for p in group]
            basis = premises.take(groebner_basis(ring, stretched, budget))
        except engines.EngineFailure:
            break
        free = [p for p in basis.polynomials if not any(p.leading_term[0][i] for i in positions)]
        if all(not p.degrees[i] > 0 for p in free for i in positions):
            return premises.conclude(tuple(free))
        weight *= 4
    variables = tuple(ring.gens[i] for i in positions)
    answer = engines.ask(engines.Task("eliminate", ring, tuple(group), variables), budget)
    return answer.known.map(lambda ideals: ideals[0])


def _stretched(polynomial: Polynomial, positions: Sequence[int], weight: int) -> Polynomial:
    """The polynomial with x^weight for each x at these positions."""
    chosen = set(positions)
    return polynomial.ring.from_dict(
        {tuple(e * weight if i in chosen else e for i, e in enumerate(m)): c for m, c in polynomial.terms()}
    )
