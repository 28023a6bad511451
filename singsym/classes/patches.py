"""Quick decomposition of equations by factoring and substituting alone, without Groebner bases.

Source: the first steps of decomposition by splitting, see `varieties.decomposition`; here they are all.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from flint import fmpq

from singsym.elimination.budget import current
from singsym.elimination.substitution import substitute_solved
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.circles import unit_circles
from singsym.varieties.splitting import factor_equations, irreducible_factors, linear_substitution

MOST_PATCHES = 64
LONGEST = 60
"""Longer equations are not compared with each other."""


@dataclass(frozen=True)
class Patch:
    """The common zeros of variable = value for each of `solved` and of `rest`, in the other variables."""

    ring: Ring
    solved: Mapping[str, Polynomial]
    rest: tuple[Polynomial, ...]

    @property
    def generators(self) -> tuple[Polynomial, ...]:
        """All equations, in a fixed order."""
        equations = [self.ring.gen(name) - value for name, value in self.solved.items()]
        return tuple(sorted((*equations, *self.rest), key=lambda p: (len(p), str(p))))

    def restrict(self, polynomial: Polynomial) -> Polynomial:
        """The polynomial with the solved variables put in."""
        present = {n: v for n, v in self.solved.items() if n in polynomial.variables}
        return polynomial.substitute(present) if present else polynomial


def unsplit(equations: Sequence[Polynomial], ring: Ring) -> Patch:
    """All zeros as one patch: solved for what equations give at once, but not for the ring's constants.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> unsplit([x - y, x * y - 1], R).generators
    (x - y, y^2 - 1)
    """
    constants = {constant.name for constant in ring.constants}
    rest, made = substitute_solved(equations, [name for name in ring.names if name not in constants])
    solved: dict[str, Polynomial] = {}
    for name, value, _ in made:
        solved = {n: v.substitute({name: value}) for n, v in solved.items()} | {name: value}
    return Patch(ring, solved, tuple(rest))


def patches(equations: Iterable[Polynomial], nonzero: Sequence[Polynomial], ring: Ring) -> tuple[Patch, ...]:
    """Patches that together hold all zeros of the equations off those of `nonzero`; none where that is seen.

    >>> R = Ring(("x", "y", "z"))
    >>> x, y, z = R.gens
    >>> [p.generators for p in patches([x * y, x + z**2, z**2 - 1], [], R)]
    [(y, x + 1, z + 1), (y, x + 1, z - 1)]
    """
    away = irreducible_factors(nonzero) or frozenset()
    waiting: list[tuple[tuple[Polynomial, ...], dict[str, Polynomial]]] = [(tuple(equations), {})]
    found: dict[frozenset[Polynomial], Patch] = {}
    budget = current()
    while waiting and len(waiting) + len(found) <= MOST_PATCHES:
        budget.check("splitting equations")
        equations, solved = waiting.pop()
        factored = factor_equations(equations, away)
        if factored is None:
            continue
        products = [f for f in factored if len(f) > 1]
        single = [f[0] for f in factored if len(f) == 1]
        if products:
            chosen = min(products, key=lambda f: (len(f), sum(len(p) for p in f), str(f)))
            others = [_product(f, ring) for f in products if f is not chosen]
            waiting += [((*single, *others, p), solved) for p in reversed(chosen)]
            continue
        single = _shortened(single)
        if len(set(single)) < len(factored) or any(p.factors() != [(p, 1)] for p in single):
            waiting.append((tuple(single), solved))
            continue
        step = linear_substitution(single)
        if step is None:
            halves = _parallel(single)
            if halves:
                waiting += [((*single, *half), solved) for half in halves]
                continue
            patch = Patch(ring, solved, tuple(single))
            found[frozenset(patch.generators)] = patch
            continue
        put = {step.name: step.value}
        known = {n: v.substitute(put) for n, v in solved.items()} | {step.name: step.value}
        waiting.append((tuple(p.substitute(put) for p in single), known))
    left = [Patch(ring, solved, equations) for equations, solved in waiting]
    return tuple(sorted((*found.values(), *left), key=lambda p: str(p.generators)))


def _product(factors: Sequence[Polynomial], ring: Ring) -> Polynomial:
    total = ring.one
    for factor in factors:
        total = total * factor
    return total


def _shortened(equations: Sequence[Polynomial]) -> list[Polynomial]:
    """Equations with multiples of each other taken away wherever that leaves fewer terms."""
    work = list(equations)
    changed = True
    while changed:
        changed = False
        for i, p in enumerate(work):
            for q in work:
                if q is p or not q or len(q) > LONGEST or len(p) > LONGEST:
                    continue
                candidate = _without(p, q)
                if candidate is not None:
                    work[i] = candidate
                    changed = True
                    break
    return [p for p in work if p]


@lru_cache(maxsize=100_000)
def _without(p: Polynomial, q: Polynomial) -> Polynomial | None:
    """p minus the multiple of q that leaves fewest terms, None where that is no gain."""
    terms, other = _terms(p), _terms(q)
    ratios = Counter(terms[m] / c for m, c in other.items() if m in terms)
    if not ratios:
        return None
    # a term of q is lost where p has none, and gained where both cancel
    ratio, cancelled = max(ratios.items(), key=lambda item: item[1])
    if cancelled <= len(other) - ratios.total():
        return None
    candidate = p - q * ratio
    return candidate.primitive() if candidate else candidate


@lru_cache(maxsize=10_000)
def _terms(p: Polynomial) -> dict[tuple[int, ...], fmpq]:
    return dict(p.terms())


def _parallel(equations: Sequence[Polynomial]) -> list[tuple[Polynomial, Polynomial]]:
    """Two unit vectors, equal or opposite by an equation such as s1 c2 - c1 s2 = 0: both cases, linear.

    On the circles c1 = c2 u - s2 v, s1 = s2 u + c2 v with u = c1 c2 + s1 s2, v = s1 c2 - c1 s2,
    and u^2 + v^2 = 1.
    """
    circles = [(p.ring.gen(x), p.ring.gen(y)) for p in equations for x, y in unit_circles([p])]
    for p in equations:
        if len(p) != 2 or p.total_degree != 2:
            continue
        for x1, y1 in circles:
            for x2, y2 in circles:
                if x1.variables == x2.variables:
                    continue
                for u, v in ((x2, y2), (x2, -y2), (y2, x2), (y2, -x2)):
                    if (x1 * v - y1 * u).primitive() == p.primitive():
                        return [(x1 - u, y1 - v), (x1 + u, y1 + v)]
    return []
