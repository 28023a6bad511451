"""Numbers, polynomials and mechanisms in plain form, as `json_codec` writes them.

Source: FLINT (https://flintlib.org), whose numbers are read and written as text of any length; a mechanism is
the text of its file.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import fmpq, fmpz

from singsym.mechanism import Mechanism, dumps, loads
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


def _file(mechanism: Mechanism) -> tuple[str, str]:
    """Where a mechanism is from, and its file; raises `ValueError` where that would say something else."""
    text = dumps(mechanism)
    if loads(text, mechanism.origin) != mechanism:
        raise ValueError(f"{mechanism!r} differs from what its file would say")
    return mechanism.origin, text


FORMS: dict[Any, Form] = {
    Fraction: Form(tuple[int, int], lambda q: (q.numerator, q.denominator), lambda pair: Fraction(*pair)),
    fmpz: Form(int, int, fmpz),
    fmpq: Form(str, str, fmpq),
    Polynomial: Form(tuple[Ring, str, str], _plain, _polynomial),
    Mechanism: Form(tuple[str, str], _file, lambda plain: loads(plain[1], plain[0])),
}
