"""Ideals modulo a prime: what is not true there is hardly true over Q.  They spare work; they prove nothing.

Source: E. A. Arnold, J. Symb. Comput. 35 (2003) 403-419: all but finitely many primes are lucky.
"""

from __future__ import annotations

from collections.abc import Sequence

from singsym.elimination import engines
from singsym.elimination.budget import current
from singsym.elimination.ideal import Ideal
from singsym.elimination.monomials import divides
from singsym.polynomials import Polynomial, Ring

_PRIME = 2**31 - 1
_SECONDS = 3.0
Basis = tuple[Polynomial, ...]


def residue_basis(ideal: Ideal, seconds: float | None = _SECONDS) -> Basis | None:
    """The Groebner basis modulo a prime; None where there is no engine for it.

    Raises `Undecided` where it takes longer, by default so long that one over Q need not be tried.
    """
    return _basis(ideal.ring, ideal.generators, seconds)


def seems_to_contain(basis: Basis, polynomials: Sequence[Polynomial]) -> bool:
    """Whether polynomials are in the ideal of a basis, all modulo a prime; True where no engine says.

    >>> x, y = Ring(("x", "y")).gens
    >>> basis = residue_basis(Ideal(x.ring, (x**2, x * y - 1)))
    >>> basis is None or seems_to_contain(basis, (x.ring.one,))
    True
    """
    more = tuple(p for p in polynomials if p)
    leading = [p.value.monomial(0) for p in basis]
    if any(not any(divides(m, p.value.monomial(0)) for m in leading) for p in more):
        return False
    return not more or _basis(basis[0].ring, (*basis, *more)) in (basis, None)


def _basis(ring: Ring, generators: Sequence[Polynomial], seconds: float | None = _SECONDS) -> Basis | None:
    task = engines.Task("groebner", ring, tuple(generators), (), _PRIME)
    try:
        return engines.solve(task, current().part(seconds)).ideals[0]
    except engines.EngineUnavailable:
        return None
