"""Ranges of polynomials where their variables have ranges: exact rationals, or infinite.

Source: Moore, Interval Analysis (1966), ch. 3 (natural interval extensions).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from math import ceil, inf, isqrt

from flint import fmpq

from singsym.polynomials.polynomial import Polynomial

Bound = Fraction | float
Interval = tuple[Bound, Bound]
EVERYTHING: Interval = (-inf, inf)
_FINENESS = 2**32


def fraction(number: fmpq) -> Fraction:
    """FLINT's rational number as Python's."""
    return Fraction(int(number.p), int(number.q))


def polynomial_range(polynomial: Polynomial, bounds: Mapping[str, Interval]) -> Interval:
    """An interval that holds all values; variables without bounds may have any value.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> polynomial_range(x * y - x**2, {"x": (Fraction(0), Fraction(1)), "y": (Fraction(2), Fraction(3))})
    (Fraction(-1, 1), Fraction(3, 1))
    """
    low: Bound = Fraction(0)
    high: Bound = Fraction(0)
    for _, term in term_ranges(polynomial, bounds):
        low, high = low + term[0], high + term[1]
    return low, high


def term_ranges(
    polynomial: Polynomial, bounds: Mapping[str, Interval]
) -> Iterator[tuple[Sequence[int], Interval]]:
    """The exponents of each term and its range, which is exact: it takes both ends."""
    intervals = [bounds.get(name, EVERYTHING) for name in polynomial.ring.names]
    for exponents, c in polynomial.terms():
        term: Interval = (fraction(c), fraction(c))
        for interval, e in zip(intervals, exponents, strict=True):
            if e:
                term = _product(term, _power(interval, int(e)))
        yield exponents, term


def meet(a: Interval, b: Interval) -> Interval:
    """The intersection of two intervals."""
    return max(a[0], b[0]), min(a[1], b[1])


def root_above(square: Fraction) -> Fraction:
    """A rational not below the square root, equal to it where it is rational.

    >>> root_above(Fraction(9, 4)), 0 < root_above(Fraction(2)) ** 2 - 2 < Fraction(1, 10**9)
    (Fraction(3, 2), True)
    """
    p, q = square.numerator, square.denominator
    if isqrt(p) ** 2 == p and isqrt(q) ** 2 == q:
        return Fraction(isqrt(p), isqrt(q))
    return Fraction(isqrt(p * _FINENESS**2 // q) + 1, _FINENESS)


def rounded_out(interval: Interval) -> Interval:
    """A little larger interval with ends of small denominators; ends that have such stay."""
    low, high = interval
    return -_rounded_up(-low), _rounded_up(high)


def _rounded_up(bound: Bound) -> Bound:
    if isinstance(bound, float) or bound.denominator <= _FINENESS:
        return bound
    return Fraction(ceil(bound * _FINENESS), _FINENESS)


def _times(a: Bound, b: Bound) -> Bound:
    return Fraction(0) if a == 0 or b == 0 else a * b


def _product(a: Interval, b: Interval) -> Interval:
    products = [_times(x, y) for x in a for y in b]
    return min(products), max(products)


def _power(interval: Interval, exponent: int) -> Interval:
    low, high = interval
    if exponent % 2 or low >= 0:
        return low**exponent, high**exponent
    top = max(low**exponent, high**exponent)
    return (min(low**exponent, high**exponent), top) if high < 0 else (Fraction(0), top)
