"""Minimal primes: by factoring where that is enough, else by Singular.

Source: G.-M. Greuel, G. Pfister, A Singular Introduction to Commutative Algebra, chapter 4.
"""

from __future__ import annotations

from singsym.effort.budget import Budget
from singsym.effort.verdict import Known, Premises
from singsym.elimination import engines
from singsym.elimination.basis import groebner_basis
from singsym.elimination.linear_substitution import substitute_solved
from singsym.elimination.memo import remember
from singsym.polynomials import Polynomial, Ring

Generators = tuple[Polynomial, ...]


def minimal_primes(ring: Ring, generators: Generators, budget: Budget) -> Known[tuple[Generators, ...]]:
    """Generators of each minimal prime; () for the unit ideal.

    Raises `engines.EngineUnavailable` where it takes an engine that is not there.
    """
    key = (ring, frozenset(generators))
    return remember("minimal primes", key, lambda: _minimal_primes(ring, generators, budget), budget)


def _minimal_primes(ring: Ring, generators: Generators, budget: Budget) -> Known[tuple[Generators, ...]]:
    rest, made = substitute_solved(generators)
    solved = tuple(substitution.equation for substitution in made)
    if not rest:
        return Known((solved,))
    if len(rest) == 1:
        return Known(tuple((*solved, f) for f, _ in rest[0].factors()))
    premises = Premises()
    basis = premises.take(groebner_basis(ring, rest, budget))
    if basis.is_unit:
        return premises.conclude(())
    task = engines.Task("minimal_primes", ring, basis.polynomials)
    primes = premises.take(engines.ask(task, budget).known)
    bases = [premises.take(groebner_basis(ring, prime, budget)).polynomials for prime in primes]
    return premises.conclude(tuple((*solved, *prime) for prime in bases if prime != (ring.one,)))
