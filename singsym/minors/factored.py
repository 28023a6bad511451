"""A determinant as a product of factors, without those proved nonzero on the feasible set.

Source: conditions (4) and (5) of Zlatanov, Fenton, Benhabib (1998), section 3.1.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

from singsym.kinematics.nonzero import Certifier
from singsym.minors.blocks import block_triangular
from singsym.minors.determinant import block_determinants, maximal_minors
from singsym.minors.trigonometry import trigonometric_factors
from singsym.polynomials import Polynomial, PolynomialMatrix
from singsym.polynomials.unit_circles import separate_circles

CONDENSED = 7
"""Larger blocks are condensed before they are expanded."""

LARGEST = 4000
"""Polynomials with more terms are factored as they are, not modulo the equations."""


@dataclass(frozen=True)
class Unit:
    """A factor that was taken away, and why it has no zero on the feasible set."""

    polynomial: Polynomial
    multiplicity: int
    reason: str

    def text(self, longest: int | None = 8) -> str:
        """The factor and its reason; longest: terms before the polynomial is cut, None for no cut."""
        return f"{self.polynomial.short_text(longest)}: {self.reason}"

    def __str__(self) -> str:
        return self.text()


@dataclass(frozen=True)
class FactoredDeterminant:
    """Polynomials whose product vanishes, on the feasible set, exactly where the determinant does.

    factors: irreducible as far as known, with multiplicities; none: the determinant has no zero.
    vanishes: whether the determinant is zero on the whole configuration space.
    """

    factors: tuple[tuple[Polynomial, int], ...]
    units: tuple[Unit, ...] = ()
    vanishes: bool = False

    @property
    def polynomials(self) -> tuple[Polynomial, ...]:
        """The distinct factors."""
        return tuple(f for f, _ in self.factors)

    @property
    def size(self) -> tuple[int, int]:
        """Number of terms of all factors, and their total degree: what makes one form better than another."""
        return sum(len(f) for f in self.polynomials), sum(f.total_degree for f in self.polynomials)


def factored(polynomials: Iterable[Polynomial], certifier: Certifier) -> FactoredDeterminant:
    """The product of polynomials, factored modulo the equations, units removed and said.

    >>> from singsym.kinematics.placement import ConfigurationSpace
    >>> from singsym.polynomials import Ring
    >>> R = Ring(("c", "s"))
    >>> c, s = R.gens
    >>> circle = Certifier(ConfigurationSpace(R, (c**2 + s**2 - 1,)))
    >>> found = factored([(c**2 + s**2) * s * (c + 2)], circle)
    >>> found.factors, [str(u) for u in found.units]
    (((s, 1),), ['c + 2: between 1 and 3 on the configuration space'])
    """
    constants = {constant.name for constant in certifier.space.ring.constants}
    multiplicities: dict[Polynomial, int] = {}
    units: dict[Polynomial, Unit] = {}
    for polynomial in polynomials:
        if polynomial.is_zero:
            return FactoredDeterminant((), vanishes=True)
        best = _best(polynomial, certifier)
        if best is None:
            return FactoredDeterminant((), vanishes=True)
        for factor, multiplicity in best:
            reason = certifier.reason(factor)
            if reason is None:
                multiplicities[factor] = multiplicities.get(factor, 0) + multiplicity
            elif not set(factor.variables) <= constants:
                before = units[factor].multiplicity if factor in units else 0
                units[factor] = Unit(factor, before + multiplicity, reason)
    ordered = sorted(
        multiplicities.items(), key=lambda pair: (len(pair[0]), pair[0].total_degree, str(pair[0]))
    )
    return FactoredDeterminant(tuple(ordered), tuple(units.values()))


def _best(polynomial: Polynomial, certifier: Certifier) -> list[tuple[Polynomial, int]] | None:
    """The factorisation with the fewest terms among equal values on the configuration space; None if zero."""
    if len(polynomial) > LARGEST:
        return polynomial.factors()
    pairs = separate_circles(certifier.space.equations)
    result: list[tuple[Polynomial, int]] = []
    for factor, multiplicity in polynomial.factors():
        reduced = certifier.normal_form(factor)
        if reduced.is_zero or certifier.shorten(factor).is_zero:
            return None
        forms = dict.fromkeys((factor, reduced, *certifier.forms(factor), certifier.shorten(factor)))
        choices = [form.factors() for form in forms]
        if pairs:
            choices.append(trigonometric_factors(reduced, pairs))
        best = min(choices, key=lambda found: (_weight(found, certifier), len(found)))
        result.extend((f, k * multiplicity) for f, k in best)
    return result


def _weight(factors: list[tuple[Polynomial, int]], certifier: Certifier) -> tuple[int, int]:
    """Terms and degrees of the factors that are not proved nonzero."""
    left = [f for f, _ in factors if certifier.reason(f) is None]
    return sum(len(f) for f in left), sum(f.total_degree for f in left)


def condense(
    matrix: PolynomialMatrix, certifier: Certifier
) -> tuple[PolynomialMatrix, tuple[Polynomial, ...]]:
    """A smaller matrix and polynomials whose product with its determinant is the determinant, up to sign.

    Lemma (Laplace).  Let k columns of a square matrix be zero outside k + 1 rows, w the vector of the signed
    k-minors of these rows there.  The determinant is, up to sign, that of the other columns with the k + 1
    rows replaced by their combination with w.  Values are kept on the configuration space only.

    >>> from singsym.kinematics.placement import ConfigurationSpace
    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> anywhere = Certifier(ConfigurationSpace(R, ()))
    >>> matrix = PolynomialMatrix.of(R, [[x, 1, 0], [x * y, y, 1], [0, x, y]])
    >>> condense(matrix, anywhere)[1]
    (x, 1)
    """
    contents: list[Polynomial] = []
    while (place := _condensable(matrix)) is not None:
        rows, columns = place
        block = matrix.select(rows, columns)
        signed = [matrix.ring.zero] * len(rows)
        for used, _, minor in maximal_minors(block):
            (left,) = set(range(len(rows))) - set(used)
            signed[left] = certifier.shorten(minor * (-1) ** left)
        common = matrix.ring.zero
        for w in signed:
            common = common.gcd(w) if common else w
        if common.is_zero:
            return PolynomialMatrix.of(matrix.ring, [[matrix.ring.zero]]), tuple(contents)
        contents.append(common.primitive())
        signed = [w.exact_quotient(common) for w in signed]
        others = [j for j in range(matrix.width) if j not in columns]
        combined = [
            certifier.shorten(
                sum((w * matrix[i, j] for w, i in zip(signed, rows, strict=True)), start=matrix.ring.zero)
            )
            for j in others
        ]
        rest = matrix.select([i for i in range(matrix.shape[0]) if i not in rows], others)
        matrix = PolynomialMatrix(matrix.ring, (*rest.rows, tuple(combined)), len(others))
    return matrix, tuple(contents)


def _condensable(matrix: PolynomialMatrix) -> tuple[tuple[int, ...], tuple[int, ...]] | None:
    """Up to three columns with one more row of nonzero entries; None where there are none left."""
    supports = [frozenset(i for i, row in enumerate(matrix.rows) if row[j]) for j in range(matrix.width)]
    for k in (1, 2, 3):
        small = [j for j, support in enumerate(supports) if len(support) <= k + 1]
        for columns in combinations(small, k):
            rows = frozenset().union(*(supports[j] for j in columns))
            if len(rows) == k + 1 <= matrix.width:
                return tuple(sorted(rows)), columns
    return None


def determinant_factors(
    matrix: PolynomialMatrix, certifier: Certifier, limit: int | None = None
) -> FactoredDeterminant:
    """The determinant of a square matrix as a product over its diagonal blocks, factored, without units.

    Large blocks are condensed first.  limit: `TooManyTerms` where more terms would come up on the way.
    Raises `ValueError` where the matrix is not square.
    """
    form = block_triangular(matrix)
    if matrix.shape[0] != matrix.width or not form.is_square:
        return factored(block_determinants(matrix), certifier)
    parts: list[Polynomial] = []
    for rows, columns in form.square:
        block = matrix.select(rows, columns)
        if len(rows) > CONDENSED:
            block, contents = condense(block, certifier)
            parts += contents
        parts += block_determinants(block, limit)
    return factored(parts, certifier)
