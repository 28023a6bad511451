"""The one place where answers of engines are checked, before anybody sees them.

Source: Buchberger's criterion; E. A. Arnold, Modular algorithms for computing Gröbner bases, J. Symb.
Comput. 35 (2003) 403-419, for the comparison modulo a prime.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Sequence
from itertools import combinations

from flint import fmpq_mpoly, fmpz, fmpz_mpoly, fmpz_mpoly_vec

from singsym.elimination.engines.base import EngineAnswer, EngineFailure, Task
from singsym.elimination.engines.division import remainder, s_polynomial
from singsym.elimination.verdict import Certainty
from singsym.polynomials import Polynomial, Ring

Exponents = tuple[int, ...]
ModularBasis = frozenset[tuple[tuple[Exponents, int], ...]]

_PAIR_SECONDS = 1.0


def check_inputs(task: Task, answer: EngineAnswer) -> None:
    """Raise `EngineFailure` unless the basis generates no less than the inputs."""
    if any(reduced_by(answer.ideals[0], p) for p in task.generators):
        raise EngineFailure(answer.engine, "returned a wrong basis: an input does not reduce to 0 by it")


def reduced_by(basis: Sequence[Polynomial], polynomial: Polynomial) -> bool:
    """Whether something is left of the polynomial after division by the basis."""
    return bool(polynomial) and bool(_remainder(basis, polynomial))


def check_pairs(task: Task, answer: EngineAnswer) -> bool:
    """Raise `EngineFailure` unless it is a Groebner basis; False where not all S-pairs were reduced."""
    integers = [p.integer() for p in answer.ideals[0]]
    if len(integers) < 2:
        return True
    vector = fmpz_mpoly_vec(integers, task.ring.integer_context)
    return _pairs_reduce(integers, vector, answer.engine)


def _pairs_reduce(basis: list[fmpz_mpoly], vector: fmpz_mpoly_vec, engine: str) -> bool:
    """Reduce the S-pairs that Buchberger's two criteria leave, in random order for a second at most.

    Where that would not be enough for all of them, a fifth of a second is.
    """
    leading = [p.monomial(0) for p in basis]
    pairs = list(combinations(range(len(basis)), 2))
    random.Random(len(pairs)).shuffle(pairs)
    start = time.monotonic()
    for done, (i, j) in enumerate(pairs):
        passed = time.monotonic() - start
        if passed > _PAIR_SECONDS / 5 and passed * len(pairs) > _PAIR_SECONDS * done:
            return False
        if not any(map(min, leading[i], leading[j])) or _chained(leading, i, j):
            continue
        if remainder(s_polynomial(basis[i], basis[j]), vector):
            raise EngineFailure(engine, "returned no Groebner basis: an S-pair does not reduce to 0")
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


def check_ideals(task: Task, answer: EngineAnswer, solve: Callable[[Task], EngineAnswer]) -> Certainty:
    """Check an elimination, a saturation or a decomposition; `solve` gives checked Groebner bases.

    Raises `EngineFailure` where it is wrong; "modular" where equality rests on a random choice.
    """
    ring, engine = task.ring, answer.engine
    if task.kind == "eliminate":
        free = all(p.degree(v.variables[0]) <= 0 for p in answer.ideals[0] for v in task.others)
        basis = solve(Task("groebner", ring, task.generators)).ideals[0]
        if not free or any(reduced_by(basis, p) for p in answer.ideals[0]):
            raise EngineFailure(engine, "returned a wrong elimination ideal")
        return "modular"
    pieces = [solve(Task("groebner", ring, piece)).ideals[0] for piece in answer.ideals]
    if any(reduced_by(piece, p) for piece in pieces for p in task.generators):
        raise EngineFailure(engine, f"returned a wrong answer to {task.kind!r}: an input is not in it")
    if task.kind == "saturate":
        return "modular"
    basis = solve(Task("groebner", ring, task.generators)).ideals[0]
    _check_complete(ring, basis, pieces, engine, solve)
    return "proven"


def _check_complete(
    ring: Ring,
    basis: Sequence[Polynomial],
    pieces: Sequence[Sequence[Polynomial]],
    engine: str,
    solve: Callable[[Task], EngineAnswer],
) -> None:
    """Raise where the pieces leave out a component.

    Lemma: a generic element of a piece vanishes on no component that lies outside that piece; so the product
    of such elements is in the radical exactly when every component lies in a piece.
    """
    rng = random.Random(len(basis))
    product = ring.one
    for piece in pieces:
        useful = [p for p in piece if reduced_by(basis, p)]
        if not useful:
            return
        element = sum((p * rng.randint(1, 9) for p in useful), start=ring.zero)
        product = _remainder(basis, product * element)
        if not product:
            return
    larger = ring.with_names((next(f"t{k}" for k in range(99) if f"t{k}" not in ring.names), *ring.names))
    system = [larger.convert(p) for p in basis]
    system.append(1 - larger.gens[0] * larger.convert(product.squarefree_part()))
    if solve(Task("groebner", larger, tuple(system))).ideals[0] != (larger.one,):
        raise EngineFailure(engine, "returned an incomplete decomposition: a component is missing")


def _remainder(basis: Sequence[Polynomial], polynomial: Polynomial) -> Polynomial:
    if not basis:
        return polynomial
    vector = fmpz_mpoly_vec([p.integer() for p in basis], polynomial.ring.integer_context)
    return Polynomial(polynomial.ring, fmpq_mpoly(remainder(polynomial.integer(), vector)))
