"""Ideals modulo primes: what is not true there is hardly true over Q.  They spare work; they prove nothing.

Source: E. A. Arnold, J. Symb. Comput. 35 (2003) 403-419: all but finitely many primes are lucky.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from singsym.effort.budget import current
from singsym.effort.chance import PRIMES, numbers_in, random_primes
from singsym.effort.patience import RESIDUES
from singsym.elimination import engines
from singsym.elimination.ideal import Ideal
from singsym.elimination.monomial_ideals import divides
from singsym.polynomials import Polynomial, Ring

Basis = tuple[Polynomial, ...]


@dataclass(frozen=True)
class Residues:
    """An ideal modulo a prime, by its Groebner basis there."""

    prime: int
    ring: Ring
    basis: Basis

    @property
    def is_unit(self) -> bool:
        """Whether the ideal is the whole ring modulo the prime."""
        return self.basis == (self.ring.one,)

    def contain(self, polynomials: Iterable[Polynomial]) -> bool:
        """Whether polynomials are in the ideal, all modulo the prime; raises what `_basis` raises.

        >>> x, y = Ring(("x", "y")).gens
        >>> Residues(7, x.ring, (x - 2, y - 4)).contain((y,))
        False
        """
        more = tuple(p for p in polynomials if p)
        leading = [p.value.monomial(0) for p in self.basis]
        if any(not any(divides(m, p.value.monomial(0)) for m in leading) for p in more):
            return False
        return not more or _basis(self.ring, (*self.basis, *more), self.prime, RESIDUES.work) == self.basis


def residues(ideal: Ideal, more: Iterable[Polynomial] = (), *, limited: bool = True) -> Iterator[Residues]:
    """The ideal modulo each of a few primes, drawn so that they divide no coefficient of it, nor of `more`.

    limited: whether to end, with `Undecided`, where it takes so long that a basis over Q need not be tried.
    Raises `engines.EngineUnavailable` without an engine for it, at the first of them.
    """
    given = (*ideal.generators, *more)
    primes = random_primes("residues", *given, avoiding=numbers_in(given))
    for prime in islice(primes, PRIMES):
        basis = _basis(ideal.ring, ideal.generators, prime, RESIDUES.work if limited else None)
        yield Residues(prime, ideal.ring, basis)


def _basis(ring: Ring, generators: Sequence[Polynomial], prime: int, work: float | None) -> Basis:
    task = engines.Task("groebner", ring, tuple(generators), (), prime)
    return engines.ask(task, current().part(work)).ideals[0]
