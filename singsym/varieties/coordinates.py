"""Coordinates in which as many variables as an ideal's dimension are independent, the others lying over them.

Lemma.  The forms of highest degree in a Groebner basis of a degree order generate those of all elements.
Where these have only the origin in common with u = 0, for as many linear forms u as the dimension, Q[x]/I is
a finite module over Q[u] (the graded form of Nakayama's lemma).
Source: G.-M. Greuel, G. Pfister, "A Singular Introduction to Commutative Algebra", 3.4 (normalization).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random

from flint import fmpq

from singsym.effort.verdict import Known, Premises
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Exponents, Polynomial, Ring


def leading_exponents(basis: Sequence[Polynomial]) -> list[Exponents]:
    """The exponents of the leading terms."""
    return [p.leading_term[0] for p in basis]


def independent_variables(leads: Sequence[Exponents], count: int) -> tuple[int, ...]:
    """Largest set of variables (indices) with no power product among the leading monomials' multiples.

    Their number is the dimension of the ideal; variables without a pure power are preferred.

    >>> independent_variables([(2, 0, 0), (1, 1, 0)], 3)
    (1, 2)
    """
    supports = {frozenset(i for i, e in enumerate(m) if e) for m in leads}
    minimal = [s for s in supports if not any(t < s for t in supports)]
    pure = {i for s in minimal if len(s) == 1 for i in s}
    free = [i for i in range(count) if i not in pure]
    left_out = _smallest_cover([s - pure for s in minimal if len(s) > 1 and s.isdisjoint(pure)])
    return tuple(i for i in free if i not in left_out)


def _smallest_cover(supports: list[frozenset[int]]) -> frozenset[int]:
    """A smallest set of indices that meets all supports, by branch and bound."""
    best = frozenset[int]().union(*supports)

    def search(left: list[frozenset[int]], chosen: frozenset[int]) -> None:
        nonlocal best
        if not left:
            best = chosen if len(chosen) < len(best) else best
        elif len(chosen) + 1 < len(best):
            for i in sorted(sorted(left, key=len)[0]):
                search([s for s in left if i not in s], chosen | {i})

    search(supports, frozenset())
    return best


@dataclass(frozen=True)
class Coordinates:
    """An ideal with independent linear forms u: variables, each less a linear form in the other variables.

    basis: a Groebner basis in a degree order; last: those variables; shifts: what is taken from each, if any.
    """

    ring: Ring
    basis: tuple[Polynomial, ...]
    last: tuple[str, ...]
    shifts: tuple[tuple[str, Polynomial], ...] = ()

    @property
    def dimension(self) -> int:
        """The number of independent forms."""
        return len(self.last)

    @cached_property
    def inner(self) -> Ring:
        """The ring of the other variables."""
        return self.ring.subring(frozenset(self.ring.names).difference(self.last))

    @cached_property
    def forms(self) -> tuple[Polynomial, ...]:
        """The independent forms, in the order of `last`."""
        shifts = dict(self.shifts)
        return tuple(self.ring.gen(name) - shifts.get(name, self.ring.zero) for name in self.last)

    def fibre(self, values: Mapping[str, fmpq]) -> tuple[Polynomial, ...]:
        """Equations in the other variables where the forms of the variables `last` have these values."""
        return self._over(self.basis, values)

    def is_finite(self) -> Known[bool]:
        """Whether Q[x]/I is seen to be a finite module over Q[u]."""
        tops = [_of_highest_degree(p) for p in self.basis]
        far = self._over(tops, dict.fromkeys(self.last, fmpq(0)))
        return Ideal(self.inner, far).dimension.map(lambda dimension: dimension == 0)

    def _over(self, polynomials: Sequence[Polynomial], values: Mapping[str, fmpq]) -> tuple[Polynomial, ...]:
        shifts = dict(self.shifts)
        there = {u: self.ring.constant(v) + shifts.get(u, self.ring.zero) for u, v in values.items()}
        return tuple(self.inner.convert(q) for p in polynomials if (q := p.substitute(there)))

    def turned(self) -> Known[Turned]:
        """The same with the forms as the last variables, and a Groebner basis there."""
        ring = Ring(self.inner.names + self.last, "degrevlex", self.ring.constants)
        there = {u: self.ring.gen(u) + shift for u, shift in self.shifts}
        moved = tuple(ring.convert(p.substitute(there)) for p in self.basis)
        basis = Ideal(ring, moved).groebner_basis()
        return basis.map(
            lambda own: Turned(ring, own, self.ring, tuple(zip(self.last, self.forms, strict=True)))
        )


@dataclass(frozen=True)
class Turned:
    """An ideal in coordinates of which the last are independent; images: these in the given variables."""

    ring: Ring
    basis: tuple[Polynomial, ...]
    original: Ring
    images: tuple[tuple[str, Polynomial], ...]

    def back(self, p: Polynomial) -> Polynomial:
        """A polynomial of these coordinates in the given variables."""
        return self.original.convert(p).substitute(dict(self.images))

    @property
    def split(self) -> int:
        """The number of dependent variables, which come first."""
        return len(self.ring.names) - len(self.images)

    @property
    def is_free(self) -> bool:
        """Whether no leading monomial involves u; with finiteness the module is free, hence I unmixed."""
        return not any(any(m[self.split :]) for m in leading_exponents(self.basis))


def _of_highest_degree(p: Polynomial) -> Polynomial:
    degree = p.total_degree
    return p.ring.from_dict({m: c for m, c in p.terms() if sum(m) == degree})


def coordinates(ideal: Ideal, rng: Random) -> Iterator[Known[Coordinates]]:
    """An ideal with some of its variables as independent ones, then after small linear changes.

    >>> x, y = Ring(("x", "y")).gens
    >>> [place.value.is_finite().value for place in coordinates(Ideal(x.ring, (x * y - 1,)), Random(1))]
    [False, True, True]
    """
    premises = Premises()
    if ideal.ring.order != "degrevlex":
        ring = ideal.ring.with_names(ideal.ring.names, "degrevlex")
        ideal = Ideal(ring, map(ring.convert, ideal.generators))
    ring, basis = ideal.ring, premises.take(ideal.groebner_basis())
    chosen = independent_variables(leading_exponents(basis), len(ring.names))
    last = tuple(ring.names[i] for i in chosen)
    yield premises.conclude(Coordinates(ring, basis, last))
    constants = {c.name for c in ring.constants}
    movable = [n for n in ring.names if n not in last and n not in constants]
    for _ in range(2 if last else 0):
        shifts = tuple(
            (u, sum((ring.gen(n) * rng.choice((-1, 1, 2)) for n in movable), start=ring.zero)) for u in last
        )
        yield premises.conclude(Coordinates(ring, basis, last, shifts))
