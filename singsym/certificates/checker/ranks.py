"""The four ranks on a set, and the singularity types that follow from them.

Source: Kronecker's theorem on bordered minors (Gantmacher, The Theory of Matrices I, chapter 1); Zlatanov,
Fenton, Benhabib (1998), conditions (i) to (vi), and the inequalities of Table 1.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations, compress, product
from typing import Any

from flint import fmpq_mpoly

from singsym.certificates.checker.polynomials import Rejected, determinant, polynomial, remainder
from singsym.certificates.checker.rules import is_unit
from singsym.certificates.checker.sets import MATRICES, RealSet, Statement, chosen, listed, whole_number

Defects = tuple[int, int, int, int]
"""How far L, L_p, L_I and L_O are below full rank: delta, p, k_I, k_O."""

Rows = Sequence[Sequence[fmpq_mpoly]]
Bounds = dict[str, tuple[int, int]]
"""Of each matrix the least and the largest defect that there may be."""

MOST_MINORS = 5000


def types_of(defects: Defects) -> str:
    """The types of configurations with these defects, in the order RI RO RPM II IO IIM.

    >>> types_of((0, 0, 1, 0))
    'RO, II'
    """
    delta, p, inputs, outputs = defects
    holds = (outputs > p, inputs > p, p > 0, inputs > delta, outputs > delta, delta > 0)
    return ", ".join(compress(("RI", "RO", "RPM", "II", "IO", "IIM"), holds))


def is_possible(defects: Defects, n: int) -> bool:
    """Whether some matrix L of mobility n has these defects: ranks are submodular."""
    delta, p, inputs, outputs = defects
    return (
        min(inputs, outputs) >= max(delta, p)
        and max(inputs, outputs) <= n + p
        and inputs + outputs <= n + delta + p
    )


def possible_types(bounds: Bounds, n: int) -> frozenset[str]:
    """The types that defects within these bounds can have."""
    delta, p, inputs, outputs = (range(low, high + 1) for low, high in (bounds[name] for name in MATRICES))
    return frozenset(types_of(d) for d in product(delta, p, inputs, outputs) if is_possible(d, n))


def bounds_on(at: RealSet, about: Statement, evidence: Mapping[str, Any]) -> Bounds:
    """What the evidence for each matrix shows of its defect on all of the set; raises `Rejected`."""
    if set(evidence) - set(MATRICES):
        raise Rejected(f"ranks: expected some of {', '.join(MATRICES)}, got {list(evidence)}")
    found: Bounds = {}
    for name in MATRICES:
        rows = at.part(at.matrix, name)
        low, high = 0, min(len(rows), len(rows[0]) if rows else 0)
        for item in listed(evidence, name, dict, []):
            least, most = _rank(at, rows, item, low, high)
            low, high = max(low, least), min(high, most)
        full = about.full_rank(name) - at.eliminated
        if full < high or full < low:
            raise Rejected(f"the rank of {name} is not seen to be at most {about.full_rank(name)}")
        found[name] = full - high, full - low
    return found


def _rank(at: RealSet, rows: Rows, item: Mapping[str, Any], low: int, high: int) -> tuple[int, int]:
    """The least and largest rank by one item of evidence, modulo the equations `divisors`, else modulo all.

    `{"below": k}`: all k-minors vanish, or are the product of the equation `of` and the polynomial `by`.
    `{"rows": ..., "columns": ..., "units": ..., "scale": ...}`: this minor is the product of units; with
    `"exact": true` all minors that border it vanish.
    """
    known = at.context.constant(0)
    if "of" in item:
        known = chosen(at.equations, [item["of"]], "equation")[0] * polynomial(item.get("by", ""), at.context)
    if "divisors" in item:
        at = replace(at, equations=tuple(chosen(at.equations, listed(item, "divisors"), "equation")))
    if "below" in item:
        size = whole_number(item, "below")
        if size < 1 or any(remainder(f - known, at.equations) for f in _minors(at, rows, size)):
            raise Rejected(f"not all {size}-minors are seen to vanish")
        return low, min(high, size - 1)
    own_rows, own_columns = listed(item, "rows"), listed(item, "columns")
    size = len([chosen(row, own_columns, "column") for row in chosen(rows, own_rows, "row")])
    if {len(own_columns), len(set(own_rows)), len(set(own_columns))} != {size}:
        raise Rejected("ranks: expected as many different rows as columns")
    if size and not is_unit(_minor(at, rows, own_rows, own_columns), at, item):
        raise Rejected("a minor is not seen to be the product of units")
    if item.get("exact") is not True:
        return size, high
    if any(borders(at, rows, own_rows, own_columns)):
        raise Rejected("a bordering minor is not seen to vanish")
    return size, size


def borders(at: RealSet, rows: Rows, own: Sequence[int], columns: Sequence[int]) -> Iterator[fmpq_mpoly]:
    """The minors, modulo the equations, that have one row and one column more than some."""
    for i in set(range(len(rows))) - set(own):
        for j in set(range(len(rows[0]))) - set(columns):
            yield _minor(at, rows, [*own, i], [*columns, j])


def _minor(at: RealSet, rows: Rows, own: Sequence[int], columns: Sequence[int]) -> fmpq_mpoly:
    block = [[remainder(rows[i][j], at.equations) for j in columns] for i in own]
    return determinant(block, at.equations)


def _minors(at: RealSet, rows: Rows, size: int) -> Iterator[fmpq_mpoly]:
    """All minors of a size, for matrices that do not have too many."""
    width = len(rows[0]) if rows else 0
    choices = list(product(combinations(range(len(rows)), size), combinations(range(width), size)))
    if len(choices) > MOST_MINORS:
        raise Rejected(f"there are {len(choices)} minors of size {size}: at most {MOST_MINORS} are looked at")
    return (_minor(at, rows, own, columns) for own, columns in choices)
