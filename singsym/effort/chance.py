"""Chance: random numbers and primes, all of one seed of the process, so that every draw can be repeated.

Source: J. T. Schwartz, J. ACM 27 (1980) 701-717; E. A. Arnold, J. Symb. Comput. 35 (2003) 403-419: all but
finitely many numbers and primes are lucky, so those drawn anew, of many, hardly ever are not.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from random import Random, SystemRandom

from flint import fmpz

from singsym.polynomials import Polynomial

VARIABLE = "SINGSYM_SEED"
"""The environment variable with the seed; without it the operating system draws one."""
PRIMES = 3
"""An answer called modular rests on so many primes, drawn for it."""
BY_PRIMES = f"modulo {PRIMES} random primes"
"""What such an answer says of itself."""


def _drawn() -> int:
    named = os.environ.get(VARIABLE, "")
    try:
        return int(named) if named else SystemRandom().randrange(10**12)
    except ValueError:
        raise ValueError(f"{VARIABLE} is a whole number, not {named!r}") from None


_of_process = _drawn()
_chosen: ContextVar[int | None] = ContextVar("seed", default=None)


def seed() -> int:
    """The seed of all that is drawn here: results name it, workers are given it."""
    chosen = _chosen.get()
    return _of_process if chosen is None else chosen


@contextmanager
def use_seed(number: int) -> Iterator[None]:
    """Draw from another seed for the work inside.

    >>> with use_seed(7):
    ...     seed(), random("a doctest").random() == random("a doctest").random()
    (7, True)
    """
    token = _chosen.set(number)
    try:
        yield
    finally:
        _chosen.reset(token)


def random(purpose: str, *about: object) -> Random:
    """Random numbers for a purpose and a question: the same in every process with the same seed."""
    return Random(" ".join(map(str, (seed(), purpose, *about))))


def random_primes(
    purpose: str, *about: object, bits: int = 31, avoiding: Iterable[int] = ()
) -> Iterator[int]:
    """Different random primes of so many bits that divide none of some numbers, but zero; without end.

    >>> p, q = (p for p, _ in zip(random_primes("a doctest"), range(2)))
    >>> p != q, 2**30 < p < 2**31
    (True, True)
    """
    drawing = random(purpose, *about)
    numbers = {abs(n) for n in avoiding} - {0, 1}
    drawn: set[int] = set()
    while True:
        candidate = drawing.randrange(2 ** (bits - 1), 2**bits) | 1
        if candidate in drawn or not fmpz(candidate).is_prime() or any(n % candidate == 0 for n in numbers):
            continue
        drawn.add(candidate)
        yield candidate


def sparing_prime(bits: int = 62) -> int:
    """One random prime for the process, where a "no" is proven by it and a "yes" is not used.

    Who asks makes sure that it divides no denominator and no leading coefficient.
    """
    return _sparing(seed(), bits)


@lru_cache(maxsize=16)
def _sparing(number: int, bits: int) -> int:
    with use_seed(number):
        return next(random_primes("sparing work", bits=bits))


def numbers_in(polynomials: Iterable[Polynomial]) -> set[int]:
    """The numerators and denominators of all coefficients: primes that divide one are not lucky.

    >>> from singsym.polynomials import Ring
    >>> (x,) = Ring(("x",)).gens
    >>> sorted(numbers_in([3 * x / 2 - 5]))
    [-5, 1, 2, 3]
    """
    return {int(n) for p in polynomials for c in p.value.coeffs() for n in (c.p, c.q)}
