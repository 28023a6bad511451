"""Numbers and polynomials in plain form, as `json_codec` writes them.

Source: FLINT (https://flintlib.org), whose numbers are read and written as text of any length.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import fmpq, fmpz

from singsym.polynomials import Polynomial, Ring


@dataclass(frozen=True)
class Form:
    """A type's plain form: its type hint, how a value is taken apart, and how it is made again."""

    hint: Any
    plain: Callable[[Any], Any]
    made: Callable[[Any], Any]


def _plain(polynomial: Polynomial) -> tuple[Ring, str, str]:
    """The ring, all exponents one after the other, and the coefficients."""
    value = polynomial.value
    exponents = " ".join(str(e) for monomial in value.monoms() for e in monomial)
    return polynomial.ring, exponents, " ".join(map(str, value.coeffs()))


def _polynomial(plain: tuple[Ring, str, str]) -> Polynomial:
    ring, exponents, coefficients = plain
    numbers, width = list(map(int, exponents.split())), len(ring.names)
    terms = {tuple(numbers[i * width : (i + 1) * width]): fmpq(c) for i, c in enumerate(coefficients.split())}
    return Polynomial(ring, ring.context.from_dict(terms))


FORMS: dict[Any, Form] = {
    Fraction: Form(tuple[int, int], lambda q: (q.numerator, q.denominator), lambda pair: Fraction(*pair)),
    fmpz: Form(int, int, fmpz),
    fmpq: Form(str, str, fmpq),
    Polynomial: Form(tuple[Ring, str, str], _plain, _polynomial),
}
