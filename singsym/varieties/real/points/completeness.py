"""Whether a parametrisation has all points of a system: by counting in the system's algebra.

Source: the number of points is the dimension of the algebra without its nilpotents (Cox, Little, O'Shea,
Using Algebraic Geometry, section 2.2, theorem 2.10); singsym's own is how the nilpotents are guessed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from flint import fmpz_mpoly_vec, nmod_mat, nmod_poly

from singsym.effort.chance import random_primes
from singsym.elimination.engines.division import remainder
from singsym.polynomials import Exponents, Polynomial
from singsym.varieties.real.points.parametrization import Parametrization, reconstruct
from singsym.varieties.real.points.quotient_algebra import Check, standard_monomials

_MOST = 40
"""More nilpotents are not looked for."""
_PRIMES = 400
"""Nor such as these primes of 62 bits do not determine."""
_SQUARINGS = 4
"""An element is seen to be nilpotent where so many squarings make it zero."""


def is_complete(found: Parametrization, basis: Sequence[Polynomial], check: Check = lambda: None) -> bool:
    """Whether a parametrisation has all zeros of a degrevlex Groebner basis; False where that is not seen.

    Its points are distinct zeros.  The algebra of the basis has one dimension for each zero, and others for
    nilpotents: there are no more zeros where as many independent nilpotents as dimensions are left are found,
    among the elements that vanish at all these points.  `check` may raise to end the work.
    """
    ring = found.ring
    standard = standard_monomials([p.value.monomial(0) for p in basis], len(ring.names))
    missing = len(standard) - found.minimal.degree()
    if not 0 < missing <= _MOST:
        return missing == 0
    vector = fmpz_mpoly_vec([p.integer() for p in basis], ring.integer_context)

    def is_nilpotent(element: Polynomial) -> bool:
        value = element.integer()
        for _ in range(_SQUARINGS):
            check()
            value = remainder(value * value, vector)
            if not value:
                return True
        return False

    for rows in _vanishing(found, standard, missing, check):
        elements = [ring.from_dict(dict(zip(standard, row, strict=True))) for row in rows]
        if is_nilpotent(elements[0]):
            return all(map(is_nilpotent, elements[1:]))
    return False


def _vanishing(
    found: Parametrization, standard: Sequence[Exponents], count: int, check: Check
) -> Iterator[list[list[int]]]:
    """Guesses at independent combinations, in echelon form, of monomials that vanish at all points."""
    modulus, residues = 1, [0] * (count * len(standard))
    pivots: list[int] | None = None
    previous: list[int] | None = None
    for used, prime in enumerate(random_primes("nilpotents", bits=62)):
        check()
        if used == _PRIMES:
            return
        reduced = _vanishing_modulo(found, standard, prime)
        if reduced is None or len(reduced) != count:
            continue
        leading = [next(j for j, c in enumerate(row) if c) for row in reduced]
        pivots = pivots or leading
        if leading != pivots:
            continue
        inverse = pow(modulus, -1, prime)
        flat = [c for row in reduced for c in row]
        residues = [r + modulus * ((f - r) * inverse % prime) for r, f in zip(residues, flat, strict=True)]
        modulus *= prime
        guess = reconstruct(residues, modulus)
        if guess is not None and guess[0] == previous:
            width = len(standard)
            yield [guess[0][k : k + width] for k in range(0, len(guess[0]), width)]
        previous = guess and guess[0]


def _vanishing_modulo(
    found: Parametrization, standard: Sequence[Exponents], prime: int
) -> list[list[int]] | None:
    """The same modulo a prime; None where the prime does not suit the parametrisation."""
    coordinates = found.modulo(prime)
    if coordinates is None:
        return None
    minimal, values = coordinates
    images = {standard[0]: nmod_poly([1], prime)}
    for m in standard[1:]:
        i = next(i for i, e in enumerate(m) if e)
        images[m] = images[(*m[:i], m[i] - 1, *m[i + 1 :])] * values[i] % minimal
    degree = minimal.degree()
    table = [int(images[m][k]) for k in range(degree) for m in standard]
    null, nullity = nmod_mat(degree, len(standard), table, prime).nullspace()
    rows = [[int(null[i, j]) for i in range(len(standard))] for j in range(nullity)]
    echelon, _ = nmod_mat(nullity, len(standard), [c for row in rows for c in row], prime).rref()
    return [[int(echelon[i, j]) for j in range(len(standard))] for i in range(nullity)]
