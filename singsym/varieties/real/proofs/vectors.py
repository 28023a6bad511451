"""One vector in place of a unit vector and its length.

Source: singsym's own; (c, s, q) -> (q c, q s) is a quotient by the reflection (c, s, q) -> (-c, -s, -q).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import lru_cache

from singsym.elimination.linear_substitution import shortest_substitution
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.polynomials.remainders import remainder
from singsym.polynomials.unit_circles import Pair, circle, unit_circles
from singsym.varieties.real.system import RealSystem


@dataclass(frozen=True)
class Vector:
    """New meanings: of `length`, that of the vector; of `pair`, the unit vector times the length.

    put: the former variable in terms of the length; relation: length^2 + w^2 - 1 where the length is left
    out by it.
    """

    pair: Pair
    length: str
    put: Polynomial
    relation: Polynomial | None = None

    @classmethod
    def of(cls, pair: Pair, length: Polynomial, system: RealSystem) -> Vector | None:
        """That of a unit vector and a length that is not zero; None where it cannot be solved for."""
        if set(pair) & set(length.variables) or (solved := shortest_substitution((length,))) is None:
            return None
        lead = length.coefficient(solved.name, 1).constant
        vector = cls(pair, solved.name, solved.value + length.ring.gen(solved.name) / lead)
        changed = [vector._changed(p) for p in system.equations if len(p) == 3 or not vector._renames(p)]
        for other in (other for other in unit_circles(changed) if vector.length in other):
            short = replace(vector, relation=circle(*map(length.ring.gen, other)))
            signs = (vector._changed(p, even=True) for p in (*system.positive, *system.nonnegative))
            if all(len(short.parts(p)) <= 1 for p in system.equations) and not any(
                vector.length in short._reduced(p).variables for p in signs
            ):
                return short
        return vector

    def applied(self, system: RealSystem) -> RealSystem:
        """The image of a set; its points may be more than those of the set where `keeps` fails."""
        groups = list(map(self.all_parts, system.exclusions))
        length = system.ring.gen(self.length)
        square = length if self.relation is None else 1 - (self.relation + 1 - length**2)
        groups += [(factor,) for factor, _ in square.factors()]
        positive, nonnegative = (
            tuple(self._reduced(self._changed(p, even=True)) for p in signs)
            for signs in (system.positive, system.nonnegative)
        )
        return RealSystem(
            system.ring,
            self.all_parts(system.equations),
            open_exclusions(groups, system.ring),
            positive,
            nonnegative,
        )

    def keeps(self, groups: Iterable[Equations]) -> bool:
        """Whether exclusions are the same for both vectors of a length that is left out."""
        return all(len(self.parts(g)) <= 1 for group in groups for g in group)

    def size(self, p: Polynomial) -> int:
        """The sum of the degrees of the terms of the parts of a polynomial."""
        if self.relation is None and self._renames(p):
            return _size_in_vector(p, self.pair, self.length)
        return sum(map(size_of, self.parts(p)))

    def all_parts(self, group: Equations) -> Equations:
        """The parts of several polynomials."""
        return tuple(q for p in group for q in self.parts(p))

    def parts(self, p: Polynomial) -> Equations:
        """The polynomial in the new variables; two parts where it holds odd powers of a length left out."""
        changed = self._reduced(self._changed(p))
        if not changed:
            return ()
        if self.relation is None:
            return (changed,)
        even, odd = (changed.coefficient(self.length, k) for k in (0, 1))
        return tuple(q for q in (even, odd) if q)

    def _renames(self, p: Polynomial) -> bool:
        """Whether each term of a polynomial becomes one: nothing is put in for the length there."""
        k = p.ring.index(self.length)
        return p.degrees[k] <= 0 or self.put == p.ring.gens[k]

    def _reduced(self, p: Polynomial) -> Polynomial:
        return p if self.relation is None else remainder(p, self.relation, self.length)

    def _changed(self, p: Polynomial, even: bool = False) -> Polynomial:
        return _in_vector(p, self.pair, self.length, self.put, even)


@lru_cache(maxsize=2**15)
def _size_in_vector(p: Polynomial, pair: Pair, length: str) -> int:
    """The sum of the degrees of the terms of `_in_vector` where nothing is put in for the length."""
    k, i, j = map(p.ring.index, (length, *pair))
    monomials = p.value.monoms()
    shift = max((m[i] + m[j] - m[k] for m in monomials), default=0)
    return sum(sum(m) - m[i] - m[j] + shift for m in monomials)


@lru_cache(maxsize=2**15)
def _in_vector(p: Polynomial, pair: Pair, length: str, put: Polynomial, even: bool) -> Polynomial:
    """A polynomial times a power of a length, in the variables of a vector; an even power where asked for."""
    ring = p.ring
    k, places = ring.index(length), tuple(map(ring.index, pair))
    degrees = p.degrees
    if all(degrees[i] <= 0 for i in (k, *places)):
        return p
    if degrees[k] > 0 and put != ring.gens[k]:
        p = p.substitute({length: put})
        if p.is_zero:
            return p
    terms = p.terms()
    powers = [m[k] - sum(m[i] for i in places) for m, _ in terms]
    shift = -min(powers)
    shift += shift % 2 if even else 0
    moved = {(*m[:k], power + shift, *m[k + 1 :]): c for (m, c), power in zip(terms, powers, strict=True)}
    return ring.from_dict(moved)


def size_of(p: Polynomial) -> int:
    """The sum of the degrees of its terms."""
    return sum(map(sum, p.value.monoms()))


def open_exclusions(groups: Iterable[Equations], ring: Ring) -> tuple[Equations, ...]:
    """Exclusions without those of nothing; (0,) where everything is excluded."""
    kept = (tuple(g for g in group if g) or (ring.zero,) for group in groups)
    return tuple(dict.fromkeys(g for g in kept if not any(p.is_constant and p for p in g)))
