"""Polynomials that multiply others into an ideal.

Source: normal forms are linear (Cox, Little, O'Shea, *Ideals, Varieties, and Algorithms*, 2.6 and 5.3), so
that multipliers of bounded degree solve linear equations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations_with_replacement

from flint import fmpq, fmpq_mat, fmpq_mpoly

from singsym.certificates.checker.polynomials import Rejected, primitive, remainder
from singsym.effort.budget import Undecided, current
from singsym.elimination.ideal import Ideal
from singsym.elimination.monomial_ideals import divides
from singsym.polynomials import Polynomial, Ring

HIGHEST_DEGREE = 3

Exponents = tuple[int, ...]


def multipliers(ideal: Sequence[fmpq_mpoly], others: Sequence[fmpq_mpoly]) -> Iterator[fmpq_mpoly]:
    """The f of low degree with f g in an ideal for each g of the others, up to sums, multiples and the ideal.

    Raises `Undecided` where products become too long.

    >>> x, y = Ring(("x", "y")).gens
    >>> list(multipliers([(x**2 * y).value], [y.value]))
    [x^2]
    """
    ring = Ring(others[0].context().names())
    basis = [f.value for f in Ideal(ring, [Polynomial(ring, f) for f in ideal]).groebner_basis().value]
    leading = [f.monomial(0) for f in basis]
    products = dict[Exponents, list[fmpq_mpoly]]()
    for degree in range(HIGHEST_DEGREE + 1):
        known = len(products)
        for places in combinations_with_replacement(range(len(ring.names)), degree):
            current().check("a quotient of ideals")
            monomial = tuple(map(places.count, range(len(ring.names))))
            if any(divides(m, monomial) for m in leading):
                continue
            less = tuple(e - (i == places[0]) for i, e in enumerate(monomial)) if places else monomial
            factor = ring.gens[places[0]].value if places else ring.one.value
            try:
                products[monomial] = [remainder(f * factor, basis) for f in products.get(less, others)]
            except Rejected as error:
                raise Undecided(f"a quotient of ideals: {error}") from None
        monomials = list(products)
        for relation in _relations(list(products.values()), known):
            f = others[0].context().from_dict(dict(zip(monomials, relation, strict=True)))
            leading.append(f.monomial(0))
            yield primitive(f)


def _relations(products: Sequence[Sequence[fmpq_mpoly]], known: int) -> Iterator[list[fmpq]]:
    """Coefficients of sums of columns that are zero, one for each column that depends on those before.

    known: so many of the columns are dealt with.
    """
    keys = {(k, m): None for column in products for k, f in enumerate(column) for m in f.monoms()}
    places = {key: i for i, key in enumerate(keys)}
    table = [[fmpq(0)] * len(products) for _ in places]
    for j, column in enumerate(products):
        for k, f in enumerate(column):
            for m, c in f.terms():
                table[places[k, m]][j] = c
    reduced, rank = (fmpq_mat(table) if table else fmpq_mat(0, len(products))).rref()
    pivots = [next(j for j in range(len(products)) if reduced[i, j]) for i in range(rank)]
    for j in range(known, len(products)):
        if j not in pivots:
            relation = [fmpq(int(i == j)) for i in range(len(products))]
            for i, pivot in enumerate(pivots):
                relation[pivot] = -reduced[i, j]
            yield relation
