"""Quick decomposition of equations by factoring and substituting alone, without Groebner bases.

Source: the first steps of decomposition by splitting, see `varieties.decomposition`; here they are all.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from operator import itemgetter

from flint import fmpq

from singsym.effort.budget import current
from singsym.elimination.linear_substitution import (
    Substitution,
    shortest_substitution,
    substitute_solved,
)
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.ranges import fraction, root_above
from singsym.polynomials.unit_circles import unit_circles
from singsym.varieties.splitting import factor_equations, irreducible_factors

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
        return self.ring.reduced(polynomial.substitute(present)) if present else polynomial


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
    for step in made:
        solved = _solved_also(solved, step)
    return Patch(ring, solved, _all_reduced(rest))


def patches(
    equations: Iterable[Polynomial], nonzero: Sequence[Polynomial], ring: Ring, *, thorough: bool = False
) -> tuple[Patch, ...]:
    """Patches that together hold all zeros of the equations off those of `nonzero`; none where that is seen.

    thorough: also subtract multiples of equations by terms, not only by numbers, where that makes others
    shorter: more products are seen, and there may be many more patches.

    >>> R = Ring(("x", "y", "z"))
    >>> x, y, z = R.gens
    >>> [p.generators for p in patches([x * y, x + z**2, z**2 - 1], [], R)]
    [(y, x + 1, z + 1), (y, x + 1, z - 1)]
    """
    nonzero_factors = irreducible_factors(nonzero) or frozenset()
    waiting: list[tuple[tuple[Polynomial, ...], dict[str, Polynomial]]] = [(tuple(equations), {})]
    found: dict[frozenset[Polynomial], Patch] = {}
    budget = current()
    while waiting and len(waiting) + len(found) <= MOST_PATCHES:
        budget.check("splitting equations")
        equations, solved = waiting.pop()
        factored = factor_equations(equations, nonzero_factors)
        if factored is None:
            continue
        products = [f for f in factored if len(f) > 1]
        single = [f[0] for f in factored if len(f) == 1]
        if products:
            chosen = min(products, key=lambda f: (len(f), sum(len(p) for p in f), str(f)))
            others = [_product(f, ring) for f in products if f is not chosen]
            waiting += [((*single, *others, p), solved) for p in reversed(chosen)]
            continue
        single = _shortened(single, thorough)
        if len(set(single)) < len(factored) or any(p.factors() != [(p, 1)] for p in single):
            waiting.append((tuple(single), solved))
            continue
        step = shortest_substitution(single)
        if step is None:
            halves = _parallel(single)
            if halves:
                waiting += [((*single, *half), solved) for half in halves]
                continue
            patch = Patch(ring, solved, tuple(single))
            found[frozenset(patch.generators)] = patch
            continue
        waiting.append((_all_reduced(step.apply(single)), _solved_also(solved, step)))
    left = [Patch(ring, solved, equations) for equations, solved in waiting]
    return tuple(sorted((*found.values(), *left), key=lambda p: str(p.generators)))


def is_combination(polynomial: Polynomial, equations: Sequence[Polynomial]) -> bool:
    """Whether nothing is left of a polynomial that multiples of equations by terms make shorter and shorter.

    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> is_combination(x * y * z - z**2 + x - y, [x * y - z, x - y])
    True
    """
    usable = [q for q in equations if len(q) <= LONGEST]
    left: Polynomial | None = polynomial
    while left and len(left) <= LONGEST:
        left = next((p for q in usable if (p := _without(left, q, True)) is not None), None)
    return left is not None and not left


def _solved_also(solved: Mapping[str, Polynomial], step: Substitution) -> dict[str, Polynomial]:
    """The values of solved variables with one more put in, and that one."""
    values = step.apply((*solved.values(), step.value))
    return dict(zip((*solved, step.name), map(step.value.ring.reduced, values), strict=True))


def _product(factors: Sequence[Polynomial], ring: Ring) -> Polynomial:
    total = ring.one
    for factor in factors:
        total = total * factor
    return total


def _shortened(equations: Sequence[Polynomial], thorough: bool) -> list[Polynomial]:
    """Equations with multiples of each other taken away wherever that leaves fewer terms."""
    work = list(equations)
    changed = True
    while changed:
        changed = False
        for i, p in enumerate(work):
            for q in work:
                if q is p or not q or len(q) > LONGEST or len(p) > LONGEST:
                    continue
                candidate = _without(p, q, thorough)
                if candidate is not None:
                    work[i] = candidate
                    changed = True
                    break
    return [p for p in work if p]


@lru_cache(maxsize=100_000)
def _without(p: Polynomial, q: Polynomial, thorough: bool) -> Polynomial | None:
    """p minus the multiple of q, by a number or a term, that leaves fewest terms; None without a gain.

    Terms of the multiple are lost where they cancel one of p, and gained where they meet none: more than half
    of them have to meet some.
    """
    terms, other = _terms(p), _terms(q)
    names = len(p.ring.names)
    guard = sum(_GUARD << _BITS * i for i in range(names))
    met: Counter[int] = Counter()
    if thorough:
        guarded = [m | guard for m in terms]
        met.update(d for m in guarded for n in other if (d := m - n) & guard == guard)
    else:
        met[guard] = sum(m in terms for m in other)
    best, chosen = (len(other), 0, 0), (0, fmpq(0))
    places = {n: i for i, n in enumerate(other)}
    for quotient, count in met.items():
        if 2 * count <= len(other):
            continue
        cancelled: Counter[fmpq] = Counter()
        first: dict[fmpq, tuple[int, int]] = {}
        for i, m in enumerate(terms):
            if (n := m - quotient + guard) in other:
                ratio = terms[m] / other[n]
                cancelled[ratio] += 1
                first.setdefault(ratio, (-i, -places[n]))
        gain, ratio = max(((count + k, r) for r, k in cancelled.items()), key=itemgetter(0))
        if gain > len(other) and (gain, *first[ratio]) > best:
            best, chosen = (gain, *first[ratio]), (quotient - guard, ratio)
    if best[0] == len(other):
        return None
    quotient, ratio = chosen
    exponents = tuple(quotient >> _BITS * i & _GUARD - 1 for i in range(names))
    candidate = p - q * p.ring.from_dict({exponents: ratio})
    return candidate.primitive() if candidate else candidate


_BITS = 16
_GUARD = 1 << _BITS - 1
"""Exponents are packed in one number, with a bit above each that shows where a difference is not negative."""


@lru_cache(maxsize=10_000)
def _terms(p: Polynomial) -> dict[int, fmpq]:
    """The coefficients of a polynomial by packed exponents."""
    return {sum(int(e) << _BITS * i for i, e in enumerate(m) if e): c for m, c in p.terms()}


def _parallel(equations: Sequence[Polynomial]) -> list[tuple[Polynomial, Polynomial]]:
    """Two unit vectors that an equation makes parallel up to a turn or a mirror image: both cases, linear.

    Such is a c1 c2 + b c1 s2 + c s1 c2 + d s1 s2 = 0 with (c, d) = (-b, a) or (b, -a) and constants: it says
    that (c2, s2) is orthogonal to (a c1 + c s1, b c1 + d s1), whose length r is the root of a^2 + b^2.
    """
    circles = [(p.ring.gen(x), p.ring.gen(y)) for p in equations for x, y in unit_circles([p])]
    for p in equations:
        # two coordinates, and at most a square of constants
        if len(p) > LONGEST or {sum(m) for m, _ in p.terms()} - {2, 3, 4}:
            continue
        for one in circles:
            for other in circles:
                halves = _halves(p, one, other) if one != other else None
                if halves:
                    return halves
    return []


def _halves(
    p: Polynomial, one: tuple[Polynomial, Polynomial], other: tuple[Polynomial, Polynomial]
) -> list[tuple[Polynomial, Polynomial]] | None:
    ring = p.ring
    x2, y2 = other
    constants = {constant.name for constant in ring.constants}
    if not {*x2.variables, *y2.variables} <= {*p.variables} <= {*constants, *_names(one), *_names(other)}:
        return None
    along, across = (p.coefficient(name, 1) for name in _names(other))
    if p != x2 * along + y2 * across:
        return None
    (a, c), (b, d) = ([side.coefficient(name, 1) for name in _names(one)] for side in (along, across))
    if along != a * one[0] + c * one[1] or across != b * one[0] + d * one[1]:
        return None
    if (c, d) not in ((-b, a), (b, -a)):
        return None
    length = _root(ring.reduced(a * a + b * b))
    if length is None:
        return None
    return [(x2 * length - across, y2 * length + along), (x2 * length + across, y2 * length - along)]


def _names(vector: tuple[Polynomial, Polynomial]) -> tuple[str, ...]:
    return tuple(name for part in vector for name in part.variables)


def _all_reduced(equations: Iterable[Polynomial]) -> tuple[Polynomial, ...]:
    """Equations of low degree in the ring's constants; the minimal polynomials of these stay as they are."""
    return tuple(q for p in equations if (q := p if p in p.ring.relations else p.ring.reduced(p)))


def _root(square: Polynomial) -> Fraction | None:
    """The square root of a positive rational where it is rational."""
    if not square.is_constant or square.constant <= 0:
        return None
    root = root_above(fraction(square.constant))
    return root if root * root == fraction(square.constant) else None
