"""Remainders on division in one variable, mostly by polynomials with a rational leading coefficient in it.

Source: division with remainder, by FLINT (https://flintlib.org).
"""

from __future__ import annotations

from functools import lru_cache

from singsym.polynomials.polynomial import Polynomial
from singsym.polynomials.ring import Ring

Divisors = tuple[tuple[Polynomial, str], ...]
"""Polynomials, each with the variable in which it is divided by it."""


def remainder(polynomial: Polynomial, divisor: Polynomial, name: str) -> Polynomial:
    """The remainder as polynomials in one variable, where the divisor's leading coefficient is rational.

    >>> c, s = Ring(("c", "s")).gens
    >>> remainder(s**3, c**2 + s**2 - 1, "s")
    -c^2*s + s
    """
    if polynomial.degree(name) < divisor.degree(name):
        return polynomial
    ring = _leading(polynomial.ring, (name,))
    divided = divmod(ring.convert(polynomial).value, ring.convert(divisor).value)[1]
    return polynomial.ring.convert(Polynomial(ring, divided))


def pseudo_remainder(dividend: Polynomial, divisor: Polynomial, name: str) -> Polynomial:
    """The same with any divisor: of a power of its leading coefficient times the dividend, primitive.

    >>> x, y = Ring(("x", "y")).gens
    >>> pseudo_remainder(x**2 + y**2 - 1, x * y - 2, "x")
    y^4 - y^2 + 4
    """
    k, x = divisor.degree(name), divisor.ring.gen(name)
    lead = divisor.coefficient(name, k)
    while (d := dividend.degree(name)) >= k and dividend:
        dividend = dividend * lead - divisor * dividend.coefficient(name, d) * x ** (d - k)
    return dividend.primitive() if dividend else dividend


def _leading(ring: Ring, names: tuple[str, ...]) -> Ring:
    """The ring in whose order powers of the first of these names lead, so that FLINT divides by them."""
    return ring.with_names((*names, *(n for n in ring.names if n not in names)), "lex")


class Division:
    """Division by one polynomial after another; remainders are kept.

    >>> c, s, x = Ring(("c", "s", "x")).gens
    >>> Division(((c**2 + s**2 - 1, "s"), (x**2 - 2, "x"))).remainder(s**2 + x**3)
    -c^2 + 2*x + 1
    """

    def __init__(self, divisors: Divisors) -> None:
        self.divisors = divisors
        self.remainder = lru_cache(maxsize=2**15)(self._remainder)
        names = tuple(dict.fromkeys(name for _, name in divisors))
        self._ring = _leading(divisors[0][0].ring, names) if divisors else Ring(())
        self._converted = tuple(self._ring.convert(divisor) for divisor, _ in divisors)
        self._at_once = all(
            _leads(name, divisor) for divisor, (_, name) in zip(self._converted, divisors, strict=True)
        )

    def _remainder(self, polynomial: Polynomial) -> Polynomial:
        if all(polynomial.degree(name) < divisor.degree(name) for divisor, name in self.divisors):
            return polynomial
        if not self._at_once:
            for divisor, name in self.divisors:
                polynomial = remainder(polynomial, divisor, name)
            return polynomial
        left = self._ring.convert(polynomial).value
        for divisor in self._converted:
            left = divmod(left, divisor.value)[1]
        return polynomial.ring.convert(Polynomial(self._ring, left))


def _leads(name: str, divisor: Polynomial) -> bool:
    """Whether the leading monomial is a power of this variable."""
    leading = divisor.value.monomial(0)
    return bool(sum(leading) == leading[divisor.ring.index(name)])


@lru_cache(maxsize=256)
def division(divisors: Divisors) -> Division:
    """The division by these polynomials, one object for equal ones: many spaces have the same circles."""
    return Division(divisors)
