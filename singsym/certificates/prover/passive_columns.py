"""Passive columns that go: by pivots that vanish nowhere, where needed after rows are combined.

Source: the lemmas of `singsym.kinematics.reduction`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

from flint import fmpq_mpoly

from singsym.certificates.checker.polynomials import determinant, remainder
from singsym.certificates.checker.rules import unit_product
from singsym.certificates.checker.sets import RealSet
from singsym.certificates.prover.unit_products import product_of_units, units_of

LARGEST_BLOCK = 3
"""Up to this many columns are looked at together: the spins of a spherical joint."""
MOST_TERMS = 160
"""Blocks with more terms in all their entries are not tried."""


def pivot(at: RealSet, first: Sequence[int] = ()) -> dict[str, Any] | None:
    """The pivot in a passive column that leaves the fewest entries, constants first.

    first: columns that go before others, where there is a constant in them.
    """
    best: tuple[tuple[int, ...], dict[str, Any]] | None = None
    units = units_of(at)
    for j in (j for j, role in enumerate(at.roles) if role == "passive"):
        below = [i for i, row in enumerate(at.matrix) if row[j]]
        place = first.index(j) if j in first else len(first)
        for i in below:
            row = at.matrix[i]
            entry = remainder(row[j], at.equations)
            cost = (len(below) - 1) * (sum(map(bool, row)) - 1)
            constant = entry.is_constant()
            key = (int(not constant), place if constant else 0, cost, sum(map(len, row)))
            if (best is None or key < best[0]) and (form := product_of_units(entry, at, units)) is not None:
                best = key, {"row": i, "column": j, **form}
    return None if best is None else best[1]


def mixed_rows(at: RealSet) -> dict[str, Any] | None:
    """Rows and a matrix for them after which there is a pivot, a sum of squares."""
    units = units_of(at)
    for rows, block in _blocks(at):
        by = [*map(list, zip(*block, strict=True)), *_kernel(block, at)]
        squares = sum((row[0] * row[0] for row in block), start=at.context.constant(0))
        form = product_of_units(squares, at, units)
        form = form or product_of_units(remainder(squares, at.equations), at, units)
        if form is not None and (powers := _power_of(determinant(by, []), form, at)) is not None:
            return {"rows": list(rows), "by": [[str(e) for e in row] for row in by], **powers}
    return None


def _power_of(f: fmpq_mpoly, form: dict[str, Any], at: RealSet) -> dict[str, Any] | None:
    """`units` and `scale` of a polynomial that is, on the set, a number times a power of units."""
    for power in range(1, LARGEST_BLOCK):
        places = form["units"] * power
        product = unit_product(at, {"units": places})
        for one, other in ((f, product), (remainder(f, at.equations), remainder(product, at.equations))):
            scale = one.leading_coefficient() / other.leading_coefficient() if one else 0
            if scale and one == other * scale:
                return {"units": places, "scale": str(scale)}
    return None


def _blocks(at: RealSet) -> Iterator[tuple[tuple[int, ...], list[list[fmpq_mpoly]]]]:
    """Rows and blocks of one column less, outside of which some passive columns are zero."""
    passive = [j for j, role in enumerate(at.roles) if role == "passive"]
    entries = {j: [row[j] for row in at.matrix] for j in passive}
    supports = {j: {i for i, e in enumerate(column) if e} for j, column in entries.items()}
    for size in range(1, LARGEST_BLOCK + 1):
        small = [j for j in passive if len(supports[j]) <= size + 1]
        for columns in combinations(small, size):
            rows = tuple(sorted(set().union(*(supports[j] for j in columns))))
            block = [[entries[j][i] for j in columns] for i in rows]
            if len(rows) == size + 1 and sum(len(e) for row in block for e in row) <= MOST_TERMS:
                yield rows, block


def _kernel(block: Sequence[Sequence[fmpq_mpoly]], at: RealSet) -> list[list[fmpq_mpoly]]:
    """The vector that a block of one row more than columns makes zero: minors with signs, without factors."""
    minors = [determinant([row for k, row in enumerate(block) if k != i], []) for i in range(len(block))]
    common = at.context.constant(0)
    for f in minors:
        common = common.gcd(f) if common else f
    return [[f / common * (-1) ** i for i, f in enumerate(minors)]] if common else []
