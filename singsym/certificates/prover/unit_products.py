"""Polynomials as products of those that vanish nowhere on a set.

Source: unique factorisation; modulo the equations of a set by remainders.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from flint import fmpq, fmpq_mpoly

from singsym.certificates.checker.polynomials import determinant, primitive, remainder
from singsym.certificates.checker.sets import RealSet

MOST_TERMS = 20_000
"""Determinants with more terms are not taken apart."""
LARGEST = 6
"""Larger determinants are expanded modulo the equations only."""


def factors(f: fmpq_mpoly) -> list[fmpq_mpoly]:
    """The irreducible factors of a polynomial, primitive, short ones first."""
    if f.is_constant():
        return []
    return sorted((primitive(factor) for factor, _ in f.factor()[1]), key=lambda p: (len(p), str(p)))


def product_of_units(f: fmpq_mpoly, at: RealSet) -> dict[str, Any] | None:
    """`units` and `scale` of a polynomial that is a product of units times a number, as it is written."""
    if not f:
        return None
    places: list[int] = []
    for place, unit in enumerate(at.units):
        while not unit.is_constant() and not f.is_constant():
            quotient, rest = divmod(f, unit)
            if rest:
                break
            f = quotient
            places.append(place)
    if not f.is_constant():
        return None
    return _form(f.leading_coefficient(), places)


def _form(scale: fmpq, places: list[int]) -> dict[str, Any]:
    """As a line has it, without what is the same where it is left out."""
    return {"units": places} | ({} if scale == 1 else {"scale": str(scale)})


def spellings(
    rows: Sequence[Sequence[fmpq_mpoly]], at: RealSet, known: Sequence[fmpq_mpoly]
) -> Iterator[fmpq_mpoly]:
    """Polynomials that equal a determinant on the set; none where it vanishes there.

    known: products of factors of which one may be a multiple of it there.
    """
    reduced = [[remainder(e, at.equations) for e in row] for row in rows]
    short = determinant(reduced, at.equations)
    if not short:
        return
    yield short
    for product in known:
        other = remainder(product, at.equations)
        if other and other * short.leading_coefficient() == short * other.leading_coefficient():
            yield product * (short.leading_coefficient() / other.leading_coefficient())
    if len(rows) <= LARGEST and sum(len(e) for row in rows for e in row) < MOST_TERMS // 100:
        yield determinant(rows, [])


def unit_form(
    rows: Sequence[Sequence[fmpq_mpoly]], at: RealSet, known: Sequence[fmpq_mpoly]
) -> dict[str, Any] | None:
    """`units` and `scale` of a minor that is a product of units on the set, where it is seen to be one."""
    found = (product_of_units(f, at) for f in spellings(rows, at, known))
    return next((form for form in found if form is not None), None)


def open_factors(
    rows: Sequence[Sequence[fmpq_mpoly]], at: RealSet, known: Sequence[fmpq_mpoly]
) -> list[fmpq_mpoly]:
    """Factors of a minor of which it is not known that they vanish nowhere on the set; fewest terms first."""
    ways = []
    for f in spellings(rows, at, known):
        if len(f) <= MOST_TERMS:
            units = [primitive(unit) for unit in at.units]
            ways.append([factor for factor in factors(f) if factor not in units])
    return min(ways, key=lambda own: (max(map(len, own), default=0), len(own)), default=[])
