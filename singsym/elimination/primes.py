"""Minimal primes: by factoring where that is enough, else by Singular, with a check of the answer.

Source: G.-M. Greuel, G. Pfister, A Singular Introduction to Commutative Algebra, chapter 4.
"""

from __future__ import annotations

import random
from collections.abc import Sequence

from singsym.elimination import engines
from singsym.elimination.basis import groebner_basis
from singsym.elimination.budget import Budget
from singsym.elimination.eliminate import without_zeros_of
from singsym.elimination.memo import remember
from singsym.elimination.substitution import substitute_solved
from singsym.polynomials import Polynomial, Ring

Generators = tuple[Polynomial, ...]


def minimal_primes(ring: Ring, generators: Generators, budget: Budget) -> tuple[Generators, ...]:
    """Generators of each minimal prime; () for the unit ideal.

    Raises `engines.EngineUnavailable` where it takes an engine that is not there.
    """
    key = (ring, frozenset(generators))
    return remember("minimal primes", key, lambda: _minimal_primes(ring, generators, budget))


def _minimal_primes(ring: Ring, generators: Generators, budget: Budget) -> tuple[Generators, ...]:
    rest, made = substitute_solved(generators)
    solved = tuple(source for _, _, source in made)
    if not rest:
        return (solved,)
    if len(rest) == 1:
        return tuple((*solved, f) for f, _ in rest[0].factors())
    basis = groebner_basis(ring, rest, budget)
    if basis.is_unit:
        return ()
    task = engines.Task("minimal_primes", ring, basis.polynomials)
    answer = engines.solve(task, budget)
    found = [groebner_basis(ring, prime, budget) for prime in answer.ideals]
    found = [prime for prime in found if not prime.is_unit]
    if any(prime.reduce(g) for prime in found for g in rest):
        raise engines.EngineFailure(answer.engine, "returned primes that do not contain the ideal")
    _check_complete(ring, basis.polynomials, [prime.polynomials for prime in found], answer.engine, budget)
    return tuple((*solved, *prime.polynomials) for prime in found)


def _check_complete(
    ring: Ring, generators: Generators, primes: Sequence[Generators], engine: str, budget: Budget
) -> None:
    """Raise where a component is missing.

    Lemma: a generic element of each prime vanishes on no component that the prime does not cut out; so the
    ideal has no zero at which none of them vanishes exactly when all components are there.
    """
    rng = random.Random(len(generators))
    larger, system = ring, generators
    for prime in primes:
        element = sum((p * rng.randint(1, 1000) for p in prime), start=ring.zero)
        if not element:
            return
        larger, system = without_zeros_of(larger, system, larger.convert(element))
    rest, _ = substitute_solved(system)
    if not groebner_basis(larger, rest, budget).is_unit:
        raise engines.EngineFailure(engine, "returned too few primes: a component is missing")
