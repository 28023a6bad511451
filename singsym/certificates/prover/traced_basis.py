"""A Groebner basis with the steps that lead to it, of which only those that are needed are kept.

Source: Buchberger's algorithm with the criteria of Gebauer and Moeller (1988); Cox, Little, O'Shea, *Ideals,
Varieties, and Algorithms*, 2.10.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count

from flint import fmpq_mpoly

from singsym.certificates.checker.polynomials import primitive, s_polynomial
from singsym.effort.budget import Budget
from singsym.elimination.monomial_ideals import divides, minimal

Monomial = tuple[int, ...]


@dataclass(frozen=True)
class TracedBasis:
    """steps and equations as the rule `derive` has them; basis: the polynomials of the places `equations`."""

    steps: list[list[list[int]]]
    equations: list[int]
    basis: tuple[fmpq_mpoly, ...]


def traced_basis(
    equations: Sequence[fmpq_mpoly],
    budget: Budget,
    target: Sequence[Monomial] | None = None,
    based: int = 0,
) -> TracedBasis:
    """The reduced Groebner basis of some polynomials; raises `Undecided` at the end of the budget.

    target: the leading monomials of the ideal, where they are known: when all are there no more pairs are
    tried.  based: so many of the first equations hold a Groebner basis, and have no pairs of their own.
    """
    work = _Work(list(equations), budget, None if target is None else set(target))
    work.run(based)
    return work.reduced()


class _Work:
    """Buchberger's algorithm under way: all polynomials by their places, those that lead, and the pairs."""

    def __init__(self, pool: list[fmpq_mpoly], budget: Budget, target: set[Monomial] | None) -> None:
        self.pool, self.budget, self.target = pool, budget, target
        self.given = len(pool)
        self.steps: list[tuple[list[int], list[int]]] = []
        self.leading: dict[int, Monomial] = {}
        self.pairs: list[tuple[int, int, Monomial]] = []

    def run(self, based: int) -> None:
        """All pairs, those with the smallest least common multiple first, until none is left."""
        waiting = sorted((k for k in range(self.given) if self.pool[k]), key=lambda k: _size(self._lead(k)))
        for k in (k for k in waiting if k < based):
            if not any(divides(m, self._lead(k)) for m in self.leading.values()):
                self.leading[k] = self._lead(k)
        for k in (k for k in waiting if k >= based):
            self._reduce([k])
        while self.pairs and not self._reached():
            self.budget.check("a Groebner basis for a certificate")
            best = min(self.pairs, key=lambda pair: (_size(pair[2]), pair[0], pair[1]))
            self.pairs.remove(best)
            self._reduce(list(best[:2]))

    def _lead(self, k: int) -> Monomial:
        return tuple(map(int, self.pool[k].monomial(0)))

    def _reached(self) -> bool:
        leading = list(self.leading.values())
        return self.target is not None and all(any(divides(m, t) for m in leading) for t in self.target)

    def _divided(self, f: fmpq_mpoly, places: Sequence[int]) -> tuple[fmpq_mpoly, list[int]]:
        """The remainder, and the divisors that were used for it."""
        used: set[int] = set()
        changed = True
        while f and changed:
            changed = False
            for k in places:
                quotient, rest = divmod(f, self.pool[k])
                if quotient:
                    f, changed = rest, True
                    used.add(k)
            self.budget.check("a remainder for a certificate")
        return f, [k for k in places if k in used]

    def _reduce(self, of: list[int]) -> None:
        f = s_polynomial(self.pool[of[0]], self.pool[of[1]]) if len(of) == 2 else self.pool[of[0]]
        rest, used = self._divided(f, list(self.leading))
        if not rest:
            return
        if len(of) == 1 and not used:
            self._enter(of[0])
            return
        self.pool.append(primitive(rest))
        self.steps.append((of, used))
        self._enter(len(self.pool) - 1)

    def _enter(self, new: int) -> None:
        """A polynomial more: its pairs, without those that the criteria make superfluous."""
        lead = self._lead(new)
        kept = [
            (i, j, m)
            for i, j, m in self.pairs
            if not divides(lead, m) or m in (_lcm(self.leading[i], lead), _lcm(self.leading[j], lead))
        ]
        candidates = {k: _lcm(m, lead) for k, m in self.leading.items()}
        chosen: dict[Monomial, int] = {}
        least = {*minimal(candidates.values())}
        for k, m in candidates.items():
            if m in least:
                before = chosen.setdefault(m, k)
                if _coprime(self.leading[k], lead) and not _coprime(self.leading[before], lead):
                    chosen[m] = k
        kept += [(k, new, m) for m, k in chosen.items() if not _coprime(self.leading[k], lead)]
        # what the new one divides is needed by pairs only, and reduces nothing any more
        for k in [k for k, m in self.leading.items() if divides(lead, m)]:
            if not any(k in pair[:2] for pair in kept):
                del self.leading[k]
        self.pairs = kept
        self.leading[new] = lead

    def reduced(self) -> TracedBasis:
        """The minimal ones, each reduced by the others, and the steps without those that nothing needs."""
        kept: list[int] = []
        for k in sorted(self.leading, key=lambda k: _size(self.leading[k])):
            if not any(divides(self.leading[other], self.leading[k]) for other in kept):
                kept.append(k)
        for at, k in enumerate(kept):
            others = [other for other in kept if other != k]
            rest, used = self._divided(self.pool[k], others)
            if used:
                self.pool.append(primitive(rest))
                self.steps.append(([k], used))
                kept[at] = len(self.pool) - 1
        needed = set(kept)
        for place in range(len(self.pool) - 1, self.given - 1, -1):
            if place in needed:
                of, used = self.steps[place - self.given]
                needed |= {*of, *used}
        numbers = count(self.given)
        renamed = {
            k: k if k < self.given else next(numbers)
            for k in range(len(self.pool))
            if k < self.given or k in needed
        }
        steps = [
            [[renamed[k] for k in of], [renamed[k] for k in used]]
            for place, (of, used) in enumerate(self.steps, self.given)
            if place in needed
        ]
        return TracedBasis(steps, [renamed[k] for k in kept], tuple(self.pool[k] for k in kept))


def _size(m: Monomial) -> tuple[int, Monomial]:
    """The place of a monomial in the graded reverse lexicographic order."""
    return sum(m), tuple(-e for e in reversed(m))


def _lcm(a: Monomial, b: Monomial) -> Monomial:
    return tuple(map(max, a, b))


def _coprime(a: Monomial, b: Monomial) -> bool:
    return not any(x and y for x, y in zip(a, b, strict=True))
