"""A determinant as a product of factors, without those proved nonzero on the feasible set.

Source: conditions (4) and (5) of Zlatanov, Fenton, Benhabib (1998), section 3.1.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from singsym.kinematics.nonzero import Certifier, short_text
from singsym.minors.determinant import block_determinants
from singsym.minors.trigonometry import circle_pairs, trigonometric_factors
from singsym.polynomials import Polynomial, PolynomialMatrix

LARGEST = 4000
"""Polynomials with more terms are factored as they are, not modulo the equations."""


@dataclass(frozen=True)
class Unit:
    """A factor that was taken away, and why it has no zero on the feasible set."""

    polynomial: Polynomial
    multiplicity: int
    reason: str

    def __str__(self) -> str:
        return f"{short_text(self.polynomial)}: {self.reason}"


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
            elif not factor.is_constant:
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
    pairs = circle_pairs(certifier.space.equations)
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


def determinant_factors(matrix: PolynomialMatrix, certifier: Certifier) -> FactoredDeterminant:
    """The determinant of a square matrix as a product over its diagonal blocks, factored, without units.

    Raises `ValueError` where the matrix is not square.
    """
    return factored(block_determinants(matrix), certifier)
