"""Equations that say of a unit vector times a polynomial that it is zero: so is the polynomial.

Source: textbook; (c f, s f) and f generate the same ideal where c^2 + s^2 = 1, as f = c (c f) + s (s f).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from flint import fmpq_mat

from singsym.polynomials.polynomial import Polynomial
from singsym.polynomials.unit_circles import Pair


def without_unit_multiples(equations: Sequence[Polynomial], circles: Iterable[Pair]) -> list[Polynomial]:
    """Equations with f in place of c f and s f, these also as sums of multiples of the equations by numbers.

    circles: the pairs (c, s) of which c^2 + s^2 = 1 is known beside the equations.  The same equations where
    there is no such f; else an echelon form of others that generate the same ideal.

    >>> from singsym.polynomials import Ring
    >>> c, s, x, y = Ring(("c", "s", "x", "y")).gens
    >>> without_unit_multiples([c * x + y - 1, c * x - y + 1, s * x], [("c", "s")])
    [x, y - 1]
    """
    pairs = tuple(circles)
    given = [p for p in equations if p]
    while given and (shorter := _with_one_less(echelon_form(given), pairs)):
        given = echelon_form(shorter)
        equations = given
    return list(equations)


def echelon_form(equations: Sequence[Polynomial]) -> list[Polynomial]:
    """A basis of the sums of rational multiples of equations, each with a leading term that no other has.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> echelon_form([x**2 + y, x**2 - y, y])
    [x^2, y]
    """
    ring = equations[0].ring
    together = ring.from_dict({m: 1 for p in equations for m, _ in p.terms()})
    monomials = [m for m, _ in together.terms()]
    coefficients = (dict(p.terms()) for p in equations)
    rows = [[known.get(m, 0) for m in monomials] for known in coefficients]
    reduced, rank = fmpq_mat(rows).rref()
    found = []
    for i in range(rank):
        row = {m: reduced[i, j] for j, m in enumerate(monomials) if reduced[i, j]}
        found.append(ring.from_dict(row).primitive())
    return found


def _with_one_less(equations: Sequence[Polynomial], circles: Iterable[Pair]) -> list[Polynomial]:
    """f in place of the first two equations c f and s f; nothing where there are none."""
    ring = equations[0].ring
    for cosine, sine in (map(ring.gen, pair) for pair in circles):
        multiples = {p.exact_quotient(cosine).primitive(): p for p in equations if cosine.divides(p)}
        for q in (q for q in equations if sine.divides(q)):
            f = q.exact_quotient(sine).primitive()
            if f in multiples:
                return [f, *(p for p in equations if p not in (q, multiples[f]))]
    return []
