"""Whether an ideal has smaller or embedded components beside its main part, and over which values they lie.

Source: presentation of Q[x]/I as a module over Q[u] by its standard monomials (Cox, Little, O'Shea, "Using
Algebraic Geometry", ch. 5); over the principal ideal domain Q[u] of a curve, torsion-free means free.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from random import Random

from flint import fmpq, fmpq_mat, fmpz_mpoly_vec, nmod_mat, nmod_poly

from singsym.effort.budget import current
from singsym.effort.chance import random_primes
from singsym.elimination.engines.division import remainder
from singsym.minors.determinant import TooManyTerms, block_determinants
from singsym.polynomials import Exponents, Polynomial, PolynomialMatrix, Ring

_LARGEST = 80
_LARGEST_DETERMINANT, _MOST_TERMS = 40, 20_000


class NormalForms:
    """Exact normal forms modulo a Groebner basis.

    >>> x, y = Ring(("x", "y")).gens
    >>> NormalForms(x.ring, (2 * x - 1,)).reduce(4 * x * y + y)
    3*y
    """

    def __init__(self, ring: Ring, basis: Sequence[Polynomial]) -> None:
        name = next(n for k in range(len(ring.names) + 1) if (n := f"tag{k}") not in ring.names)
        self.ring = ring
        self._tagged = Ring((*ring.names, name), ring.order)
        self._tag = self._tagged.gen(name)
        self._vector = fmpz_mpoly_vec(
            [self._tagged.convert(p).integer() for p in basis], self._tagged.integer_context
        )

    def reduce(self, p: Polynomial) -> Polynomial:
        """The remainder; the tag, which nothing reduces, carries the scalar of the division."""
        if not p:
            return p
        terms = remainder((self._tagged.convert(p) + self._tag).integer(), self._vector).to_dict()
        scalar = terms.pop((*(0,) * len(self.ring.names), 1))
        return self.ring.from_dict({m[:-1]: c for m, c in terms.items()}) / scalar


@dataclass(frozen=True)
class Presentation:
    """The module as F + Q[u]^E with relations u e_i = sum_j action[i][j] e_j + rest[i], rest in the free F.

    F is spanned by the standard monomials on infinite strips x^a u^b (all b), E by those on finite strips.
    """

    action: tuple[tuple[fmpq, ...], ...]
    rest: tuple[dict[tuple[Exponents, int], fmpq], ...]


def presentation(ring: Ring, basis: Sequence[Polynomial], within: Sequence[Exponents]) -> Presentation | None:
    """The presentation for u the last variable; None where it is too large.

    within: the exponents in the other variables of all standard monomials.
    """
    leads = [p.leading_term[0] for p in basis]
    heights: dict[Exponents, int] = {}
    for a in within:
        tops = [m[-1] for m in leads if all(i >= j for i, j in zip(a, m[:-1], strict=True))]
        if tops:
            heights[a] = min(tops)
    finite = [(a, b) for a, top in heights.items() for b in range(top)]
    if len(finite) > _LARGEST:
        return None
    position = {key: i for i, key in enumerate(finite)}
    forms = NormalForms(ring, basis)
    action, rest = [], []
    for a, b in finite:
        row, outside = [fmpq(0)] * len(finite), {}
        if (a, b + 1) in position:
            row[position[a, b + 1]] = fmpq(1)
        else:
            current().check("torsion")
            for m, c in forms.reduce(ring.from_dict({(*a, b + 1): 1})).terms():
                key = (m[:-1], m[-1])
                if key in position:
                    row[position[key]] = c
                else:
                    outside[key] = c
        action.append(tuple(row))
        rest.append(outside)
    return Presentation(tuple(action), tuple(rest))


def off_free(ring: Ring, basis: Sequence[Polynomial], within: Sequence[Exponents]) -> Polynomial | None:
    """A polynomial in the last variables u off whose zeros Q[x]/I is a free module over Q[u]; None if large.

    within: the exponents in the other variables of all standard monomials; their x^a span the module.
    Lemma: take one relation u^b x^a = its normal form for each a for which a multiple u^b x^a is not
    standard.  Its leading term is u^b x^a, and these x^a are all different; so the determinant of the
    relations in these x^a has the product of the u^b as leading term: it is not zero.  Where it is
    invertible, the relations give these x^a by the others, and the others are independent over Q[u], as all
    their multiples by powers of u are standard.

    >>> x, u, v = Ring(("x", "u", "v")).gens
    >>> off_free(x.ring, (x**2, x * u, x * v), [(0,), (1,)])
    v
    """
    size = len(within[0])
    leads = [p.leading_term[0] for p in basis]
    corners: dict[Exponents, Exponents] = {}
    for a in within:
        tops = [m[size:] for m in leads if all(i >= j for i, j in zip(a, m[:size], strict=True))]
        if tops:
            corners[a] = min(tops, key=lambda b: (sum(b), b))
    if len(corners) > _LARGEST_DETERMINANT:
        return None
    forms, place = NormalForms(ring, basis), {a: i for i, a in enumerate(corners)}
    rows = []
    for a, b in corners.items():
        current().check("torsion")
        row = [ring.zero] * len(place)
        monomial = ring.from_dict({(*a, *b): 1})
        for m, c in (monomial - forms.reduce(monomial)).terms():
            if (k := place.get(m[:size])) is not None:
                row[k] += ring.from_dict({(*(0,) * size, *m[size:]): c})
        rows.append(row)
    try:
        factors = block_determinants(PolynomialMatrix.of(ring, rows), _MOST_TERMS)
    except TooManyTerms:
        return None
    product = ring.one
    for factor in factors:
        product = product * factor.squarefree_part()
    return product.squarefree_part()


def torsion_support(module: Presentation, rng: Random) -> list[list[fmpq]]:
    """Polynomials in u (coefficients, constant first) over whose zeros there may be torsion; [] proves none.

    Lemma: there is torsion over c exactly where [c - action | -rest(c)] drops rank, and then every
    det(u - action - rest(u) Z), Z constant, vanishes at c.  c is integral over the prime's local ring, so
    coprime determinants modulo the prime exclude it.
    """
    size = len(module.action)
    if not size:
        return []
    characteristic = fmpq_mat([list(row) for row in module.action]).charpoly()
    entries = [c for row in module.action for c in row] + [c for r in module.rest for c in r.values()]
    prime = next(random_primes("torsion", bits=62, avoiding=(int(c.q) for c in entries)))
    common = nmod_poly([_residue(c, prime) for c in characteristic.coeffs()], prime)
    for _ in range(2):
        common = common.gcd(_determinant(module, rng, prime))
        if common.degree() == 0:
            return []
    coefficients = (f.coeffs() for f, _ in characteristic.factor()[1])
    return [c for c in coefficients if _may_share_root(c, common, prime)]


def _may_share_root(coefficients: Sequence[fmpq], common: nmod_poly, prime: int) -> bool:
    if any(int(c.q) % prime == 0 for c in coefficients):
        return True
    return bool(nmod_poly([_residue(c, prime) for c in coefficients], prime).gcd(common).degree() > 0)


def _residue(c: fmpq, prime: int) -> int:
    return int(c.p) * pow(int(c.q), -1, prime) % prime


def _determinant(module: Presentation, rng: Random, prime: int) -> nmod_poly:
    """det(u - action - rest(u) Z) modulo the prime, for a random Z, by interpolation."""
    size = len(module.action)
    strips = sorted({a for r in module.rest for a, _ in r})
    place = {a: k for k, a in enumerate(strips)}
    mix = nmod_mat(len(strips), size, [rng.randrange(prime) for _ in range(len(strips) * size)], prime)
    action = nmod_mat(size, size, [_residue(c, prime) for row in module.action for c in row], prime)
    rest = [[(place[a], b, _residue(c, prime)) for (a, b), c in r.items()] for r in module.rest]
    degree = size + sum(max((b for _, b, _ in r), default=0) for r in rest)
    values = []
    for point in range(degree + 1):
        current().check("torsion")
        matrix = (
            nmod_mat(size, size, [point * (i == j) for i in range(size) for j in range(size)], prime) - action
        )
        outside = [[0] * len(strips) for _ in rest]
        for row, terms in zip(outside, rest, strict=True):
            for k, b, c in terms:
                row[k] += c * pow(point, b, prime)
        shares = nmod_mat(size, len(strips), [e % prime for row in outside for e in row], prime)
        values.append((matrix - shares * mix).det())
    return _interpolated([int(v) for v in values], prime)


def _interpolated(values: Sequence[int], prime: int) -> nmod_poly:
    """The polynomial with these values at 0, 1, 2, ... by Newton's divided differences."""
    table = list(values)
    for k in range(1, len(table)):
        inverse = pow(k, -1, prime)
        for i in range(len(table) - 1, k - 1, -1):
            table[i] = (table[i] - table[i - 1]) * inverse % prime
    result = nmod_poly([table[-1]], prime)
    for k in range(len(table) - 2, -1, -1):
        result = result * nmod_poly([-k % prime, 1], prime) + table[k]
    return result
