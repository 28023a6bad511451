"""The rules that take a set apart, into sets that have its points together and no point in common.

Source: singsym's own; the steps of `derive` follow the practical algebraic calculus (Kaufmann, Fleury, Biere,
Kauers 2022).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from flint import fmpq_mpoly

from singsym.certificates.checker.polynomials import (
    Rejected,
    determinant,
    polynomial,
    primitive,
    rational,
    remainder,
    s_polynomial,
)
from singsym.certificates.checker.sets import MOST, RealSet, chosen, listed, whole_number

Line = Mapping[str, Any]


def unit_product(at: RealSet, line: Line) -> fmpq_mpoly:
    """`scale` times the units of the places `units`, a polynomial that vanishes nowhere on the set."""
    scale = rational(line.get("scale", "1"))
    if not scale:
        raise Rejected("scale: expected a number that is not zero")
    product = at.context.constant(scale)
    for unit in chosen(at.units, listed(line, "units"), "unit"):
        product = product * unit
    return product


def is_unit(f: fmpq_mpoly, at: RealSet, line: Line) -> bool:
    """Whether f is, on the set, the product that the line gives."""
    return not remainder(f - unit_product(at, line), at.equations)


def split(at: RealSet, line: Line) -> tuple[RealSet, ...]:
    """Where `by` vanishes, and where it does not."""
    by = polynomial(line.get("by", ""), at.context)
    return at.within([by]), replace(at, units=(*at.units, by))


def derive(at: RealSet, line: Line) -> tuple[RealSet, ...]:
    """More equations from those there are, by S-polynomials and remainders; some may go.

    steps: each `[places, divisors]`, one or two places; its result is the remainder of the polynomial, or of
        the S-polynomial of the two, by the divisors, as a primitive polynomial.  Places count the equations,
        then the results.
    equations: the places of the new equations; each old one has remainder zero by these.
    """
    pool = list(at.equations)
    for step in listed(line, "steps", list):
        if len(step) != 2 or not all(isinstance(part, list) for part in step) or len(step[0]) not in (1, 2):
            raise Rejected(f"steps: expected [places, divisors], got {str(step)[:80]}")
        of = chosen(pool, step[0], "polynomial")
        if len(of) == 2 and not all(of):
            raise Rejected("steps: the S-polynomial of zero")
        f = s_polynomial(*of) if len(of) == 2 else of[0]
        pool.append(primitive(remainder(f, chosen(pool, step[1], "polynomial"))))
    kept = listed(line, "equations")
    new = tuple(chosen(pool, kept, "polynomial"))
    for k, old in enumerate(at.equations):
        if k not in kept and remainder(old, new):
            raise Rejected(f"equation {k} does not follow from those that are kept")
    return (replace(at, equations=new),)


def cancel(at: RealSet, line: Line) -> tuple[RealSet, ...]:
    """One more equation, of which a power times units is in the ideal of those there are."""
    f = polynomial(line.get("polynomial", ""), at.context)
    product, units = at.context.constant(1), chosen(at.units, listed(line, "units"), "unit")
    for factor in (*units, *[f] * whole_number(line, "power", 1, MOST)):
        product = remainder(product * factor, at.equations)
    if product:
        raise Rejected("the product is not seen to be in the ideal")
    return (at.within([f]),)


def squares(at: RealSet, line: Line) -> tuple[RealSet, ...]:
    """More equations: polynomials whose squares add up to zero on the set, with positive weights.

    terms: each `[weight, polynomial]`.
    """
    given = listed(line, "terms", list)
    if any(len(term) != 2 for term in given):
        raise Rejected("terms: expected pairs of a weight and a polynomial")
    terms = [(rational(w), polynomial(f, at.context)) for w, f in given]
    total = sum((f * f * w for w, f in terms), start=at.context.constant(0))
    if not all(w > 0 for w, _ in terms) or remainder(total, at.equations):
        raise Rejected("squares with positive weights are not seen to add up to zero")
    return (at.within([f for _, f in terms]),)


def rows(at: RealSet, line: Line) -> tuple[RealSet, ...]:
    """Rows become combinations of them, by a square matrix `by` with a determinant that vanishes nowhere."""
    places, texts = listed(line, "rows"), listed(line, "by", list)
    old, by = chosen(at.matrix, places, "row"), [[polynomial(t, at.context) for t in row] for row in texts]
    if not old or {len(set(places)), len(by), *map(len, by)} != {len(old)}:
        raise Rejected("rows: expected different ones, and a square matrix for them")
    if not is_unit(determinant(by, at.equations), at, line):
        raise Rejected("the determinant is not seen to be the product of units")

    new = dict(zip(places, (_combined(weights, old) for weights in by), strict=True))
    return (replace(at, matrix=tuple(new.get(k, row) for k, row in enumerate(at.matrix))),)


def _combined(weights: Sequence[fmpq_mpoly], rows: Sequence[Sequence[fmpq_mpoly]]) -> tuple[fmpq_mpoly, ...]:
    columns = zip(*rows, strict=True)
    return tuple(sum((w * e for w, e in zip(weights, c, strict=True)), start=c[0] * 0) for c in columns)


def pivot(at: RealSet, line: Line) -> tuple[RealSet, ...]:
    """A row and a passive column less, by a pivot that vanishes nowhere: all four ranks are one less."""
    i, j = whole_number(line, "row"), whole_number(line, "column")
    row = chosen(at.matrix, [i], "row")[0]
    entry = chosen(row, [j], "column")[0]
    if at.roles[j] != "passive":
        raise Rejected(f"column {j} is not passive")
    if not is_unit(entry, at, line):
        raise Rejected("the pivot is not seen to be the product of units")

    def left(other: tuple[fmpq_mpoly, ...]) -> tuple[fmpq_mpoly, ...]:
        if other[j]:
            sums = _combined((entry, -other[j]), (other, row))
            other = tuple(remainder(e, at.equations) for e in sums)
        return other[:j] + other[j + 1 :]

    matrix = tuple(map(left, at.matrix[:i] + at.matrix[i + 1 :]))
    roles = at.roles[:j] + at.roles[j + 1 :]
    return (replace(at, matrix=matrix, roles=roles, eliminated=at.eliminated + 1),)


RULES: dict[str, Callable[[RealSet, Line], tuple[RealSet, ...]]] = {
    rule.__name__: rule for rule in (split, derive, cancel, squares, rows, pivot)
}
