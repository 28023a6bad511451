"""The cells of one parameter: between real roots of the border, each with a rational sample.

Source: real roots as in `varieties.real.points.roots`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count, pairwise

import sympy
from flint import fmpz, fmpz_poly

from singsym.polynomials import Polynomial
from singsym.varieties.real.points.roots import halved, real_roots

_HIGHEST = 8
"""A root of a higher degree is not calculated with."""


@dataclass(frozen=True)
class Root:
    """A real root of a border: the only one of the polynomial in an interval, or both ends of it."""

    polynomial: Polynomial
    low: Fraction
    high: Fraction

    @property
    def value(self) -> sympy.Expr | None:
        """The root by rationals and square roots, or as a root of its polynomial; None for a high degree.

        >>> from singsym.polynomials import Ring
        >>> a = Ring(("a",)).gens[0]
        >>> Root(a**2 - 2, Fraction(1), Fraction(2)).value
        sqrt(2)
        >>> Root(a**5 - a - 1, Fraction(1), Fraction(2)).value
        CRootOf(x**5 - x - 1, 0)
        """
        if self.degree > _HIGHEST:
            return None
        low, high = map(sympy.Rational, (self.low, self.high))
        own = sympy.Poly(self.polynomial.to_sympy()).replace(sympy.Symbol("x"))
        if self.degree > 2:
            return next(root for root in own.real_roots() if low <= root <= high)
        return next(root for root in sympy.roots(own, filter="R") if low <= root <= high)

    @property
    def degree(self) -> int:
        """That of the polynomial, which is irreducible."""
        return self.polynomial.total_degree

    def __float__(self) -> float:
        low, high = self.narrow(40)
        return float((low + high) / 2)

    def narrow(self, halvings: int) -> tuple[Fraction, Fraction]:
        """The interval, halved so many times."""
        (name,), low, high = self.polynomial.variables, self.low, self.high
        own = univariate(self.polynomial, name)
        for _ in range(halvings if low < high else 0):
            low, high = halved(own, low, high)
        return low, high


def at(polynomial: Polynomial, values: dict[str, Fraction]) -> Fraction:
    """The value of a polynomial at rationals for all of its variables."""
    number = polynomial.substitute(values).constant
    return Fraction(int(number.p), int(number.q))


def univariate(polynomial: Polynomial, name: str) -> fmpz_poly:
    """A polynomial in one variable over Z, up to a factor."""
    i = polynomial.ring.index(name)
    terms = {m[i]: int(c.p) for m, c in polynomial.primitive().terms()}
    return fmpz_poly([fmpz(terms.get(k, 0)) for k in range(max(terms, default=0) + 1)])


def roots(polynomials: Iterable[Polynomial], name: str) -> tuple[Root, ...]:
    """The real roots of polynomials in one variable, each once, in order, in disjoint intervals.

    >>> from singsym.polynomials import Ring
    >>> a = Ring(("a",)).gens[0]
    >>> [float(root) for root in roots([a**2 - 4, a - 2, 2 * a - 1], "a")]
    [-2.0, 0.5, 2.0]
    """
    factors = list(dict.fromkeys(f for p in polynomials for f, _ in p.factors()))
    product = fmpz_poly([1])
    for f in factors:
        product *= univariate(f, name)
    if product.degree() < 1:
        return ()
    return tuple(Root(_own(factors, name, low, high), low, high) for low, high in real_roots(product))


def _own(factors: Sequence[Polynomial], name: str, low: Fraction, high: Fraction) -> Polynomial:
    """The factor whose root an interval holds."""
    signs = ((f, at(f, {name: low}), at(f, {name: high})) for f in factors)
    return next(f for f, a, b in signs if (a == 0 == b) or a * b < 0)


def samples(found: Sequence[Root]) -> tuple[Fraction, ...]:
    """A rational in each of the open intervals between roots, and beyond the first and the last.

    >>> from singsym.polynomials import Ring
    >>> a = Ring(("a",)).gens[0]
    >>> samples(roots([a**2 - 2], "a"))
    (Fraction(-2, 1), Fraction(0, 1), Fraction(2, 1))
    """
    if not found:
        return (Fraction(1),)
    narrow = [root.narrow(20) for root in found]
    inner = [simple_between(left[1], right[0]) for left, right in pairwise(narrow)]
    first, last = narrow[0][0], narrow[-1][1]
    return (Fraction(first.__ceil__() - 1), *inner, Fraction(last.__floor__() + 1))


def simple_between(low: Fraction, high: Fraction) -> Fraction:
    """A rational with a small denominator near the middle of an interval, and inside it.

    >>> simple_between(Fraction(1, 3), Fraction(3, 4))
    Fraction(1, 2)
    """
    middle, quarter = (low + high) / 2, (high - low) / 4
    if not quarter:
        return middle
    return next(x for k in count() if abs((x := Fraction(round(middle * 2**k), 2**k)) - middle) <= quarter)
