"""The one place where answers of engines are checked, before anybody sees them.

Source: Buchberger's criterion; E. A. Arnold, Modular algorithms for computing Gröbner bases, J. Symb.
Comput. 35 (2003) 403-419, for the comparison modulo a prime.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import fmpq_mpoly, fmpz_mpoly, fmpz_mpoly_vec

from singsym.effort import chance
from singsym.effort.chance import PRIMES, numbers_in, random_primes
from singsym.effort.verdict import Certainty, Premises
from singsym.elimination.engines.base import EngineAnswer, EngineFailure, Task
from singsym.elimination.engines.division import remainder, s_polynomial
from singsym.polynomials import Exponents, Polynomial, Ring

ModularBasis = frozenset[tuple[tuple[Exponents, int], ...]]

_PAIR_BITS = 1e9
"""So many operations with bits, a second or two, may take the S-pairs of a basis together."""
_DIVISOR_BITS = 500
"""So many operations it takes to see whether one leading monomial divides another, with all around it."""
_MOST_PRODUCTS = 50
"""So many polynomials are looked at, each by a basis, to prove that a decomposition is complete."""


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
    """Reduce the S-pairs that Buchberger's two criteria leave: all, or some at random where that is too dear.

    A reduction takes about as many operations as the S-polynomial has terms times the bits of a polynomial,
    and looks for divisors in all of the basis.
    """
    pairs = _pairs([p.monomial(0) for p in basis])
    bits = sum(int(c).bit_length() for p in basis for c in p.coeffs())
    each = 2 * sum(map(len, basis)) * bits / len(basis) ** 2 + _DIVISOR_BITS * len(basis)
    affordable = int(_PAIR_BITS / each)
    complete = len(pairs) <= affordable
    if not complete:
        pairs = chance.random("S-pairs", len(pairs), bits).sample(pairs, max(1, affordable // 5))
    for i, j in pairs:
        if remainder(s_polynomial(basis[i], basis[j]), vector):
            raise EngineFailure(engine, "returned no Groebner basis: an S-pair does not reduce to 0")
    return complete


def _pairs(leading: Sequence[Exponents]) -> list[tuple[int, int]]:
    """Pairs of leading monomials that are not coprime and have no third one strictly inside their lcm."""
    import numpy as np

    monomials = np.array(leading, dtype=np.int32)
    first, second = np.triu_indices(len(monomials), 1)
    kept = np.minimum(monomials[first], monomials[second]).any(axis=1)
    first, second = first[kept], second[kept]
    for k, other in enumerate(monomials):
        lcm = np.maximum(monomials[first], monomials[second])
        inside = np.flatnonzero((other <= lcm).all(axis=1) & (first != k) & (second != k))
        for side in (first, second):
            shorter = np.maximum(monomials[side[inside]], other) != lcm[inside]
            inside = inside[shorter.any(axis=1)]
        left = np.ones(len(first), bool)
        left[inside] = False
        first, second = first[left], second[left]
    return list(zip(first.tolist(), second.tolist(), strict=True))


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


def compare_modulo_primes(
    task: Task, answer: EngineAnswer, ask: Callable[[Task, bool], EngineAnswer | None]
) -> bool:
    """Compare the basis with those that engines compute modulo random primes, another one at the first.

    `ask` runs a task, by another engine if that is wanted, or returns `None` where it cannot.  Raises
    `EngineFailure` after two primes at which the bases differ; False where nothing could be compared.
    """
    opponents: list[str] = []
    agreed = 0
    primes = random_primes("bases", *task.generators, avoiding=numbers_in(task.generators))
    while len(opponents) < 2:
        prime = next(primes)
        mine = modular_basis(answer.ideals[0], prime)
        if mine is None:
            continue
        other = ask(Task("groebner", task.ring, task.generators, (), prime), agreed == 0)
        if other is None:
            return False
        if modular_basis(other.ideals[0], prime) != mine:
            opponents.append(other.engine)
            continue
        agreed += 1
        if agreed == PRIMES:
            return True
    raise EngineFailure(
        answer.engine, f"returned a wrong basis: it differs from that of {opponents[0]} modulo a prime"
    )


def check_ideals(task: Task, answer: EngineAnswer, solve: Callable[[Task], EngineAnswer]) -> Certainty:
    """Check an elimination, a saturation or a decomposition; `solve` gives checked Groebner bases.

    Raises `EngineFailure` where it is wrong; "modular" where equality is the engine's word, or a basis is not
    proven.
    """
    ring, engine = task.ring, answer.engine
    premises = Premises()

    def basis_of(ring: Ring, generators: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
        return premises.take(solve(Task("groebner", ring, tuple(generators))).known)[0]

    if task.kind == "eliminate":
        free = all(p.degree(v.variables[0]) <= 0 for p in answer.ideals[0] for v in task.others)
        basis = basis_of(ring, task.generators)
        if not free or any(reduced_by(basis, p) for p in answer.ideals[0]):
            raise EngineFailure(engine, "returned a wrong elimination ideal")
        return "modular"
    pieces = [basis_of(ring, piece) for piece in answer.ideals]
    if any(reduced_by(piece, p) for piece in pieces for p in task.generators):
        raise EngineFailure(engine, f"returned a wrong answer to {task.kind!r}: an input is not in it")
    if task.kind == "saturate":
        return "modular"
    premises.rest_on(_check_complete(ring, basis_of(ring, task.generators), pieces, engine, basis_of))
    return premises.certainty


def _check_complete(
    ring: Ring,
    basis: Sequence[Polynomial],
    pieces: Sequence[Sequence[Polynomial]],
    engine: str,
    basis_of: Callable[[Ring, Sequence[Polynomial]], tuple[Polynomial, ...]],
) -> Certainty:
    """Raise where the pieces leave out a component; "modular" where that rests on random numbers.

    Lemma: let a piece have generators g_0, ..., g_m and e(t) = g_0 + g_1 t + ... + g_m t^m.  On a component
    that lies outside the piece, e(t) is not the zero polynomial in t over the functions there, which have no
    zero divisors: e(t) vanishes there for m numbers t at most.  So for one of any 1 + (the sum of the m of
    all pieces) numbers t no e(t) vanishes on a component outside all pieces, nor does their product; while
    on a component inside a piece all products vanish.
    """
    useful = [[p for p in piece if reduced_by(basis, p)] for piece in pieces]
    if not all(useful):
        return "proven"
    enough = 1 + sum(len(generators) - 1 for generators in useful)
    proven = enough <= _MOST_PRODUCTS
    drawn = chance.random("pieces", *basis).sample(range(1, 10**6), chance.PRIMES)
    for t in range(1, enough + 1) if proven else drawn:
        product = ring.one
        for generators in useful:
            element = sum((p * t**k for k, p in enumerate(generators)), start=ring.zero)
            product = _remainder(basis, product * element)
        if product and not _vanishes(ring, basis, product, basis_of):
            raise EngineFailure(engine, "returned an incomplete decomposition: a component is missing")
    return "proven" if proven else "modular"


def _vanishes(
    ring: Ring,
    basis: Sequence[Polynomial],
    polynomial: Polynomial,
    basis_of: Callable[[Ring, Sequence[Polynomial]], tuple[Polynomial, ...]],
) -> bool:
    """Whether a polynomial vanishes on all zeros of a basis (Rabinowitsch)."""
    larger = ring.with_names((next(f"t{k}" for k in range(99) if f"t{k}" not in ring.names), *ring.names))
    system = [larger.convert(p) for p in basis]
    system.append(1 - larger.gens[0] * larger.convert(polynomial.squarefree_part()))
    return basis_of(larger, system) == (larger.one,)


def _remainder(basis: Sequence[Polynomial], polynomial: Polynomial) -> Polynomial:
    if not basis:
        return polynomial
    vector = fmpz_mpoly_vec([p.integer() for p in basis], polynomial.ring.integer_context)
    return Polynomial(polynomial.ring, fmpq_mpoly(remainder(polynomial.integer(), vector)))
