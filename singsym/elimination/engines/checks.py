"""The one place where answers of engines are checked, before anybody sees them.

Source: Buchberger's criterion; E. A. Arnold, Modular algorithms for computing Gröbner bases, J. Symb.
Comput. 35 (2003) 403-419, for the comparison modulo a prime.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Sequence
from itertools import combinations

from flint import fmpz, fmpz_mpoly, fmpz_mpoly_vec

from singsym.elimination.engines.base import EngineAnswer, EngineFailure, Task
from singsym.elimination.engines.division import remainder, s_polynomial
from singsym.polynomials import Polynomial

Exponents = tuple[int, ...]
ModularBasis = frozenset[tuple[tuple[Exponents, int], ...]]

_PAIR_SECONDS = 1.0


def check_basis(task: Task, answer: EngineAnswer) -> bool:
    """Check that the basis generates no less than the inputs and that it is a Groebner basis.

    Raises `EngineFailure` where it is wrong; False where there were too many S-pairs to reduce them all.
    """
    basis = answer.ideals[0]
    if not basis:
        if any(task.generators):
            raise EngineFailure(answer.engine, "returned the zero ideal for an ideal that is not")
        return True
    if any(p.is_constant for p in basis):
        return True
    vector = fmpz_mpoly_vec([p.integer() for p in basis], task.ring.integer_context)
    if any(remainder(p.integer(), vector) for p in task.generators if p):
        raise EngineFailure(answer.engine, "returned a wrong basis: an input does not reduce to 0 by it")
    return _pairs_reduce(list(vector), vector, answer.engine)


def _pairs_reduce(basis: list[fmpz_mpoly], vector: fmpz_mpoly_vec, engine: str) -> bool:
    """Reduce the S-pairs that Buchberger's two criteria leave, in random order for a second at most."""
    leading = [p.monomial(0) for p in basis]
    pairs = [
        (i, j)
        for i, j in combinations(range(len(basis)), 2)
        if any(map(min, leading[i], leading[j])) and not _chained(leading, i, j)
    ]
    random.Random(len(pairs)).shuffle(pairs)
    end = time.monotonic() + _PAIR_SECONDS
    for i, j in pairs:
        if remainder(s_polynomial(basis[i], basis[j]), vector):
            raise EngineFailure(engine, "returned no Groebner basis: an S-pair does not reduce to 0")
        if time.monotonic() > end:
            return False
    return True


def _chained(leading: Sequence[Exponents], i: int, j: int) -> bool:
    """Whether a third leading monomial strictly inside lcm(i, j) makes the pair superfluous."""
    lcm = tuple(map(max, leading[i], leading[j]))
    for k, other in enumerate(leading):
        if k in (i, j) or any(a > b for a, b in zip(other, lcm, strict=True)):
            continue
        if tuple(map(max, leading[i], other)) != lcm and tuple(map(max, leading[j], other)) != lcm:
            return True
    return False


def modular_basis(basis: Sequence[Polynomial], prime: int) -> ModularBasis | None:
    """The basis modulo a prime, made monic; `None` where the prime divides a leading coefficient."""
    found = set()
    for polynomial in basis:
        terms = [(m, int(c) % prime) for m, c in polynomial.integer().terms()]
        if not terms[0][1]:
            return None
        inverse = pow(terms[0][1], -1, prime)
        found.add(tuple((m, c * inverse % prime) for m, c in terms if c))
    return frozenset(found)


def random_prime() -> int:
    """A random prime of 31 bits, which is what all engines take."""
    while not fmpz(candidate := random.SystemRandom().randrange(2**30, 2**31 - 1) | 1).is_prime():
        pass
    return candidate


def compare_modulo_prime(
    task: Task, answer: EngineAnswer, ask: Callable[[Task], EngineAnswer | None]
) -> bool:
    """Compare the basis with one that another engine computes modulo a random prime.

    `ask` runs a task, or returns `None` where it cannot.  Raises `EngineFailure` after two primes at which
    the bases differ; False where nothing could be compared.
    """
    opponents: list[str] = []
    while len(opponents) < 2:
        prime = random_prime()
        mine = modular_basis(answer.ideals[0], prime)
        if mine is None:
            continue
        other = ask(Task("groebner", task.ring, task.generators, (), prime))
        if other is None:
            return False
        if modular_basis(other.ideals[0], prime) == mine:
            return True
        opponents.append(other.engine)
    raise EngineFailure(
        answer.engine, f"returned a wrong basis: it differs from that of {opponents[0]} modulo a prime"
    )
