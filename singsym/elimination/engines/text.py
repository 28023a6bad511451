"""Polynomials as the expanded text that engines exchange, in variables x1, x2, ...

Source: the input formats of msolve and Singular.  Names are never passed on: `names` in Singular and `by` in
giac are reserved words, and msolve misreads everything but expanded terms with one integer coefficient.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from flint import fmpq_mpoly, fmpq_mpoly_ctx, fmpz_mpoly_ctx

from singsym.polynomials import Polynomial, Ring

_POWERS = r"x\d+(?:\^\d{1,6})?(?:\*x\d+(?:\^\d{1,6})?)*"
_TERM = rf"(?:\d+(?:/0*[1-9]\d*)?(?:\*{_POWERS})?|{_POWERS})"
_SUM = re.compile(rf"[+-]?{_TERM}(?:[+-]{_TERM})*")
_WITHOUT_COEFFICIENT = re.compile(r"(?<![*\d])x")


def write(polynomial: Polynomial, used: Sequence[int], characteristic: int = 0) -> str:
    """The primitive integer multiple, with the ring's variable `used[k]` written `x(k+1)`.

    Modulo a prime its coefficients are reduced here: msolve misreads those above 2^63.

    >>> x, y = Ring(("names", "by")).gens
    >>> write((x - 1) * (y - 2) / 2, (0, 1))
    '1*x1*x2-2*x1-1*x2+2'
    """
    value = polynomial.integer()
    if characteristic:
        terms = zip(value.monoms(), (c % characteristic for c in value.coeffs()), strict=True)
        value = polynomial.ring.integer_context.from_dict(dict(terms))
    context = fmpz_mpoly_ctx.get([f"x{k}" for k in range(1, len(used) + 1)], value.context().ordering())
    moved = value.project_to_context(context, {i: k for k, i in enumerate(used)})
    return _WITHOUT_COEFFICIENT.sub("1*x", str(moved).replace(" ", ""))


def read(text: str, ring: Ring, used: Sequence[int]) -> Polynomial:
    """The inverse of `write`; raises `ValueError` for anything but an expanded polynomial over Q.

    >>> read("x1^2*x2-1/2*x2+3", Ring(("a", "b")), (0, 1))
    a^2*b - 1/2*b + 3
    """
    text = re.sub(r"\s+", "", text)
    if not _SUM.fullmatch(text):
        known = _SUM.match(text)
        raise ValueError(f"not a polynomial: {text[known.end() if known else 0 :][:40]!r}")
    context = fmpq_mpoly_ctx.get([f"x{k}" for k in range(1, len(used) + 1)], ring.context.ordering())
    try:
        value = fmpq_mpoly(text, context)
    except ValueError:
        raise ValueError(f"not a polynomial in x1, ..., x{len(used)}: {text[:40]!r}") from None
    return Polynomial(ring, value.project_to_context(ring.context, dict(enumerate(used))))


def used_variables(*groups: Sequence[Polynomial]) -> tuple[int, ...]:
    """The positions of the variables that occur; the others are not shown to engines."""
    found: set[int] = set()
    for polynomial in (p for group in groups for p in group):
        found.update(i for i, d in enumerate(polynomial.degrees) if d > 0)
    return tuple(sorted(found))
