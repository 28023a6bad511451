"""Polynomials over Q for the checker: read, reduced, divided; determinants by expansion.

Source: FLINT's `fmpq_mpoly` (https://flintlib.org); Cox, Little, O'Shea, *Ideals, Varieties, and
Algorithms*, 2.3 and 2.6, for remainders and S-polynomials.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import cache, reduce
from itertools import cycle

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz

_NUMBER = re.compile(r"\d+(/[1-9]\d*)?\Z")
_POWER = re.compile(r"([A-Za-z_]\w*)(?:\^([1-9]\d{0,3}))?\Z")
LONGEST = 2_000_000
"""A polynomial of more characters is refused."""
LARGEST = 20_000
"""A remainder with more terms on the way, or more binary digits in its first coefficient, is refused."""


class Rejected(ValueError):
    """A certificate, or a line of it, proves nothing."""


def ring(names: Sequence[str]) -> fmpq_mpoly_ctx:
    """Q[names] with the graded reverse lexicographic order."""
    if len(set(names)) < len(names) or not all(_POWER.match(name) and "^" not in name for name in names):
        raise Rejected(f"variables: expected different names, got {list(names)}")
    return fmpq_mpoly_ctx.get(tuple(names), Ordering.degrevlex)


def rational(text: str) -> fmpq:
    """A rational as `-3/2`, exactly; raises `Rejected` for anything else.

    >>> rational("-3/2")
    -3/2
    """
    if not isinstance(text, str) or not _NUMBER.match(text.removeprefix("-")):
        raise Rejected(f"expected a rational as -3/2, got {text!r}")
    return fmpq(*map(fmpz, text.split("/")))


def polynomial(text: str, context: fmpq_mpoly_ctx) -> fmpq_mpoly:
    """A polynomial from text as `2*x^2 - 1/2*x*y + 1`; raises `Rejected` for anything else.

    >>> polynomial("2*x^2 - 1/2*x + 1", ring(["x"]))
    2*x^2 - 1/2*x + 1
    """
    if not isinstance(text, str) or len(text) > LONGEST:
        raise Rejected(f"expected a polynomial as text, got {str(text)[:80]!r}")
    places = {name: i for i, name in enumerate(context.names())}
    terms: dict[tuple[int, ...], fmpq] = {}
    for term in text.replace(" - ", " + -").split(" + "):
        coefficient, exponents = fmpq(-1 if term.startswith("-") else 1), [0] * len(places)
        for part in term.removeprefix("-").split("*"):
            if _NUMBER.match(part):
                coefficient *= rational(part)
            elif (power := _POWER.match(part)) and power[1] in places:
                exponents[places[power[1]]] += int(power[2] or 1)
            else:
                raise Rejected(f"{part!r} is neither a number nor a power of a variable, in {text[:80]!r}")
        key = tuple(exponents)
        terms[key] = terms.get(key, fmpq(0)) + coefficient
    return context.from_dict(terms)


def repeated(exponents: Iterable[int]) -> tuple[int, ...]:
    """The places of the factors of a monomial, each as often as its exponent says."""
    return tuple(i for i, e in enumerate(exponents) for _ in range(int(e)))


def primitive(f: fmpq_mpoly) -> fmpq_mpoly:
    """The multiple with coprime integer coefficients and a positive leading one."""
    if not f:
        return f
    coefficients = f.coeffs()
    scale = fmpq(reduce(fmpz.lcm, (c.q for c in coefficients)), reduce(fmpz.gcd, (c.p for c in coefficients)))
    return f * (scale if (coefficients[0] > 0) == (scale > 0) else -scale)


def remainder(f: fmpq_mpoly, divisors: Iterable[fmpq_mpoly]) -> fmpq_mpoly:
    """What is left of f when the divisors are divided out, one after the other, until none changes it.

    The remainder by one divisor has no term that its leading monomial divides, and is unique.

    >>> x, y = ring(["x", "y"]).gens()
    >>> remainder(x**2 * y, [x - y, y**2 - 1])
    y
    """
    divisors, unchanged = [d for d in divisors if d], 0
    for divisor in cycle(divisors):
        quotient, rest = divmod(f, divisor)
        f, unchanged = (rest, 1) if quotient else (f, unchanged + 1)
        if not f or unchanged == len(divisors):
            break
        if max(len(f), f.coefficient(0).p.bit_length()) > LARGEST:
            raise Rejected("a remainder becomes too long")
    return f


def s_polynomial(f: fmpq_mpoly, g: fmpq_mpoly) -> fmpq_mpoly:
    """The combination of two polynomials, not zero, in which their leading terms cancel."""
    lcm = tuple(map(max, f.monomial(0), g.monomial(0)))

    def raised(h: fmpq_mpoly) -> fmpq_mpoly:
        more = tuple(m - n for m, n in zip(lcm, h.monomial(0), strict=True))
        return h * h.context().from_dict({more: 1 / h.coefficient(0)})

    return raised(f) - raised(g)


def determinant(rows: Sequence[Sequence[fmpq_mpoly]], divisors: Sequence[fmpq_mpoly]) -> fmpq_mpoly:
    """The determinant of a square matrix, with at least one row, modulo the divisors: expansion by rows."""
    context = rows[0][0].context()

    @cache
    def minor(columns: tuple[int, ...]) -> fmpq_mpoly:
        if not columns:
            return context.constant(1)
        row = rows[len(rows) - len(columns)]
        total = context.constant(0)
        for k, j in enumerate(columns):
            if row[j]:
                part = row[j] * minor((*columns[:k], *columns[k + 1 :]))
                total = total - part if k % 2 else total + part
        return remainder(total, divisors)

    return minor(tuple(range(len(rows))))
