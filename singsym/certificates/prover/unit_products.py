"""Polynomials as products of those that vanish nowhere on a set.

Source: unique factorisation; modulo the equations of a set by remainders.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import chain, product
from typing import Any

from flint import fmpq, fmpq_mpoly

from singsym.certificates.checker.polynomials import Rejected, determinant, primitive, remainder
from singsym.certificates.checker.rules import is_unit
from singsym.certificates.checker.sets import RealSet
from singsym.effort.budget import Undecided, current

MOST_TERMS = 20_000
"""Determinants with more terms are not taken apart."""
HIGHEST_POWER, LONGEST_PRODUCT = 4, 100_000
"""Of units, and of what vanishes by a power; products of more terms are not reduced."""
LARGEST = 6
"""Larger determinants are expanded modulo the equations only."""


Units = Sequence[tuple[int, fmpq_mpoly]]
"""Units by their places, each as it is written, and as it is modulo the equations where that differs."""


def factors(f: fmpq_mpoly, units: Units) -> list[fmpq_mpoly]:
    """The irreducible factors of a polynomial that are no units, primitive, short ones first."""
    found = [] if f.is_constant() else [primitive(factor) for factor, _ in f.factor()[1]]
    known = [primitive(unit) for _, unit in units]
    return sorted((factor for factor in found if factor not in known), key=lambda p: (len(p), str(p)))


def units_of(at: RealSet) -> Units:
    """All units of a set."""
    reduced = [remainder(unit, at.equations) for unit in at.units]
    written = [*enumerate(at.units), *((k, r) for k, r in enumerate(reduced) if r != at.units[k])]
    return [(place, unit) for place, unit in written if not unit.is_constant()]


def product_of_units(f: fmpq_mpoly, at: RealSet, units: Units) -> dict[str, Any] | None:
    """`units` and `scale` of a polynomial that is a product of units times a number, as these are written."""
    if not f:
        return None
    left, places = f, list[int]()
    for place, unit in units:
        while not left.is_constant():
            quotient, rest = divmod(left, unit)
            if rest:
                break
            left = quotient
            places.append(place)
    if not left.is_constant():
        return None
    form = _form(left.leading_coefficient(), places)
    # units as they are modulo equations that are no basis may have another product
    return form if is_unit(f, at, form) else None


def _form(scale: fmpq, places: list[int]) -> dict[str, Any]:
    """As a line has it, without what is the same where it is left out."""
    return {"units": places} | ({} if scale == 1 else {"scale": str(scale)})


def cancelled(f: fmpq_mpoly, at: RealSet) -> dict[str, Any] | None:
    """`units` and `power` as of the rule `cancel`, where some show that a polynomial vanishes on the set.

    Its powers alone, then times powers of one unit, or of all of them: low powers first.
    """
    places = range(len(at.units))
    ways = [(place,) for place in places] + ([(*places,)] if len(places) > 1 else [])
    powers = range(1, 2 if f.is_constant() else HIGHEST_POWER + 1)

    @cache
    def tried(way: tuple[int, ...], count: int, power: int) -> fmpq_mpoly:
        """So many of the units times a power, multiplied as the checker does it."""
        if power:
            return _times(tried(way, count, power - 1), f, at)
        found = tried(way, count - 1, 0) if count else at.context.constant(1)
        for place in way if count else ():
            found = _times(found, at.units[place], at)
        return found

    more = product(range(1, HIGHEST_POWER + 1), powers, ways)
    for count, power, way in chain(
        ((0, power, ()) for power in powers), sorted(more, key=lambda one: (sum(one[:2]), one[1]))
    ):
        if count + power <= HIGHEST_POWER + 1 and not tried(way, count, power):
            return {"units": [*way] * count, "power": power}
    return None


def _times(f: fmpq_mpoly, g: fmpq_mpoly, at: RealSet) -> fmpq_mpoly:
    """A product as the checker reduces it; raises `Undecided` where it is long."""
    current().check("what vanishes on a set for a certificate")
    if len(f) * len(g) > LONGEST_PRODUCT:
        raise Undecided("products of units are too long")
    try:
        return remainder(f * g, at.equations)
    except Rejected as error:
        raise Undecided(f"products of units: {error}") from None


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
    for multiple in known:
        other = remainder(multiple, at.equations)
        if other and other * short.leading_coefficient() == short * other.leading_coefficient():
            yield multiple * (short.leading_coefficient() / other.leading_coefficient())
    if len(rows) <= LARGEST and sum(len(e) for row in rows for e in row) < MOST_TERMS // 100:
        yield determinant(rows, [])


def unit_form(
    rows: Sequence[Sequence[fmpq_mpoly]], at: RealSet, known: Sequence[fmpq_mpoly], units: Units
) -> dict[str, Any] | None:
    """`units` and `scale` of a minor that is a product of units on the set, where it is seen to be one."""
    found = (product_of_units(f, at, units) for f in spellings(rows, at, known))
    return next((form for form in found if form is not None), None)


def open_factors(
    rows: Sequence[Sequence[fmpq_mpoly]], at: RealSet, known: Sequence[fmpq_mpoly], units: Units
) -> list[fmpq_mpoly]:
    """Factors of a minor of which it is not known that they vanish nowhere on the set; fewest terms first."""
    ways = [factors(f, units) for f in spellings(rows, at, known) if len(f) <= MOST_TERMS]
    return min(ways, key=lambda own: (max(map(len, own), default=0), len(own)), default=[])
