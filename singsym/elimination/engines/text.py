"""Polynomials as the expanded text that engines exchange, in variables x1, x2, ...

Source: the input formats of msolve and Singular.  Names are never passed on: `names` in Singular and `by` in
giac are reserved words, and msolve misreads everything but expanded terms with one integer coefficient.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from flint import fmpq, fmpz

from singsym.polynomials import Polynomial, Ring

_POWER = r"x\d+(?:\^\d+)?"
_TERM = re.compile(rf"([+-]?)(?:(\d+(?:/\d+)?)((?:\*{_POWER})*)|({_POWER}(?:\*{_POWER})*))")
_FACTOR = re.compile(r"x(\d+)(?:\^(\d+))?")


def write(polynomial: Polynomial, used: Sequence[int], characteristic: int = 0) -> str:
    """The primitive integer multiple, with the ring's variable `used[k]` written `x(k+1)`.

    Modulo a prime its coefficients are reduced here: msolve misreads those above 2^63.

    >>> x, y = Ring(("names", "by")).gens
    >>> write((x - 1) * (y - 2) / 2, (0, 1))
    '1*x1*x2-2*x1-1*x2+2'
    """
    pieces = []
    for exponents, c in polynomial.integer().terms():
        if characteristic and not (c := c % characteristic):
            continue
        powers = [
            f"*x{k}" if exponents[i] == 1 else f"*x{k}^{exponents[i]}"
            for k, i in enumerate(used, start=1)
            if exponents[i]
        ]
        pieces.append(f"{'' if c < 0 else '+'}{c}{''.join(powers)}")
    return "".join(pieces).removeprefix("+") or "0"


def read(text: str, ring: Ring, used: Sequence[int]) -> Polynomial:
    """The inverse of `write`; raises `ValueError` for anything but an expanded polynomial over Q.

    >>> read("x1^2*x2-1/2*x2+3", Ring(("a", "b")), (0, 1))
    a^2*b - 1/2*b + 3
    """
    text = re.sub(r"\s+", "", text)
    position, width = 0, len(ring.names)
    terms: dict[tuple[int, ...], fmpq] = {}
    while position < len(text):
        match = _TERM.match(text, position)
        if match is None or (position and not match[1]):
            raise ValueError(f"not a polynomial: {text[position : position + 40]!r}")
        sign, number, after_number, alone = match.groups()
        exponents = [0] * width
        for index, power in _FACTOR.findall(after_number or alone or ""):
            if not 1 <= int(index) <= len(used):
                raise ValueError(f"x{index} is not one of the {len(used)} variables")
            exponents[used[int(index) - 1]] += int(power or 1)
        key = tuple(exponents)
        terms[key] = terms.get(key, fmpq(0)) + _rational(number or "1", sign)
        position = match.end()
    if not text:
        raise ValueError("no polynomial, but empty text")
    return ring.from_dict({m: c for m, c in terms.items() if c})


def _rational(text: str, sign: str = "") -> fmpq:
    numerator, _, denominator = text.partition("/")
    value = fmpq(fmpz(numerator), fmpz(denominator or "1"))
    return -value if sign == "-" else value


def used_variables(*groups: Sequence[Polynomial]) -> tuple[int, ...]:
    """The positions of the variables that occur; the others are not shown to engines."""
    found: set[int] = set()
    for polynomial in (p for group in groups for p in group):
        found.update(i for i, d in enumerate(polynomial.degrees) if d > 0)
    return tuple(sorted(found))
