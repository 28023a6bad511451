"""Ranks at a point, and the loci where the rank of a polynomial matrix is too low.

Source: conditions (iii), (vi) of Zlatanov, Fenton, Benhabib (1998), section 2.3, and section 3.2 on how to
write them as equations.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations
from math import comb, prod

from flint import fmpq, fmpq_mat

from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.reduction import Elimination, eliminate, reduce_submatrix
from singsym.minors.blocks import diagonal_blocks, sparser
from singsym.minors.determinant import maximal_minors
from singsym.minors.factored import factored
from singsym.polynomials import Polynomial, PolynomialMatrix


def rank_at(matrix: PolynomialMatrix, point: Sequence[fmpq]) -> int:
    """The exact rank at a rational point, in the order of the ring's names.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> rank_at(PolynomialMatrix.of(x.ring, [[x, y], [1, 2]]), [fmpq(1, 2), fmpq(1)])
    1
    """
    height, width = matrix.shape
    if not height or not width:
        return 0
    return int(fmpq_mat(height, width, [fmpq(e) for e in chain(*matrix.evaluate(point))]).rank())


@dataclass(frozen=True)
class RankBlocks:
    """A matrix taken apart: its rank is `constant` plus the sum of the ranks of `blocks`, everywhere.

    shape: of the matrix; record: the eliminations that `constant` counts.
    """

    shape: tuple[int, int]
    blocks: tuple[PolynomialMatrix, ...]
    constant: int
    record: tuple[Elimination, ...]

    @property
    def size(self) -> tuple[int, int]:
        """Rows and terms of the blocks."""
        terms = sum(len(e) for block in self.blocks for row in block.rows for e in row)
        return sum(block.shape[0] for block in self.blocks), terms

    def locus(self, rank: int) -> tuple[PolynomialMatrix, ...] | None:
        """The blocks of which at least one must lose rank (rows or columns) for the whole to be below `rank`.

        None where `rank` is neither the number of rows nor of columns of what is left after elimination.
        """
        wanted = rank - self.constant
        for side in (0, 1):
            if wanted == sum(block.shape[side] for block in self.blocks):
                return self.blocks
        return None


FEW_TERMS = 20
"""Blocks with fewer terms are not tried to be made simpler."""


def rank_blocks(matrix: PolynomialMatrix, certifier: Certifier) -> RankBlocks:
    """Eliminate what has a pivot proved nonzero, drop zero rows and columns, split into diagonal blocks.

    >>> from singsym.kinematics.placement import ConfigurationSpace
    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> space = Certifier(ConfigurationSpace(R, ()))
    >>> found = rank_blocks(PolynomialMatrix.of(R, [[1, x, 0], [y, 0, 0], [0, 0, y]]), space)
    >>> [b.rows for b in found.blocks], found.constant
    ([((-x*y,),), ((y,),)], 1)
    """
    reduced = reduce_submatrix(matrix, certifier)
    left = sparser(reduced.matrix.map(certifier.shorten))
    blocks = tuple(left.select(rows, columns) for rows, columns in diagonal_blocks(left))
    return RankBlocks(matrix.shape, blocks, reduced.constant, reduced.record)


def simplest_blocks(matrix: PolynomialMatrix, certifier: Certifier, outputs: int) -> RankBlocks:
    """The same by the simpler of two ways: any pivots, or those in the first `outputs` columns last.

    Pivots in the output's columns are easy to find, as it is the twist of one link, but write all legs in
    the coordinates of one of them.
    """
    found = rank_blocks(matrix, certifier)
    if not outputs or found.size[1] < FEW_TERMS:
        return found
    joints = eliminate(matrix, range(outputs, matrix.width), certifier, thorough=True)
    rest = rank_blocks(joints.matrix, certifier)
    other = replace(
        rest,
        shape=matrix.shape,
        constant=joints.constant + rest.constant,
        record=(*joints.record, *rest.record),
    )
    return min(found, other, key=lambda f: f.size)


Minors = tuple[tuple[Polynomial, ...], ...]


def minor_factors(block: PolynomialMatrix, certifier: Certifier) -> Minors | None:
    """For each maximal minor its distinct factors that are not proved nonzero; None where one has none left.

    Minors that vanish on the configuration space are left out, and those with all the factors of another.
    """
    found: dict[frozenset[Polynomial], tuple[Polynomial, ...]] = {}
    for _, _, minor in maximal_minors(block):
        parts = factored((minor,), certifier)
        if parts.vanishes:
            continue
        if not parts.factors:
            return None
        found[frozenset(parts.polynomials)] = parts.polynomials
    kept = [f for key, f in found.items() if not any(other < key for other in found)]
    return tuple(sorted(kept, key=lambda f: (sum(len(p) for p in f), str(f))))


MANY_ALTERNATIVES = 40
"""More alternatives than this are not written out."""

MANY_MINORS = 100
"""More maximal minors of a block than this are not worked out."""

MANY_PRODUCTS = 10**7
"""Nor those of a block where the product of the rows' numbers of terms is larger."""


def is_small(block: PolynomialMatrix) -> bool:
    """Whether the locus of lower rank of a block can be written with its maximal minors."""
    wide = block if block.shape[0] <= block.shape[1] else block.T
    products = prod(sum(len(e) for e in row) for row in wide.rows)
    return comb(wide.width, wide.shape[0]) <= MANY_MINORS and products <= MANY_PRODUCTS


def alternatives(minors: Minors, certifier: Certifier) -> Minors | None:
    """The common zeros of products as a union of common zeros of factors, one of each product, minimal.

    Choices without a common zero on the feasible set are left out.  None where there are too many.

    >>> from singsym.kinematics.placement import ConfigurationSpace
    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> alternatives(((x, y), (y, z)), Certifier(ConfigurationSpace(x.ring, ())))
    ((y,), (x, z))
    """
    choices: set[frozenset[Polynomial]] = {frozenset()}
    for factors in minors:
        wider = {c if c & set(factors) else c | {f} for c in choices for f in factors}
        choices = {c for c in wider if not any(other < c for other in wider)}
        if len(choices) > MANY_ALTERNATIVES:
            return None
    possible = (c for c in choices if _may_vanish(c, certifier))
    ordered = [tuple(sorted(c, key=lambda p: (len(p), str(p)))) for c in possible]
    return tuple(sorted(ordered, key=lambda c: (len(c), sum(len(p) for p in c), str(c))))


def _may_vanish(polynomials: Iterable[Polynomial], certifier: Certifier) -> bool:
    """False where some of them are proved, by their sum of squares, not to vanish together."""
    short = [p for p in polynomials if len(p) <= 3]
    groups = (group for size in (2, 3) for group in combinations(short, size))
    return all(certifier.reason(sum((p * p for p in g[1:]), start=g[0] * g[0])) is None for g in groups)
