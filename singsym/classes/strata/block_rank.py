"""The rank of a block of a matrix on a ground, and the minors off whose zeros it holds.

Source: Gantmacher, The Theory of Matrices I (1959), ch. 1 (Kronecker).

Lemma (Kronecker). Where an r-minor of a matrix does not vanish, the rank is r exactly if all (r+1)-minors
that border it vanish.  So one minor outside an ideal and its bordering minors inside it fix the rank on
V(ideal) minus V(minor), whether the ideal is prime or not.  Off the common zeros of several r-minors the rank
is r only where that holds for each of them: no minor is larger, or the larger ones vanish on the whole set.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product
from math import comb, prod

from singsym.classes.strata.ground import Ground, NotEvident
from singsym.effort.budget import Undecided
from singsym.effort.verdict import Known, Premises
from singsym.kinematics.nonzero import Certifier
from singsym.minors.blocks import easy_columns
from singsym.minors.determinant import determinant
from singsym.minors.factored import factored
from singsym.minors.rank import alternatives
from singsym.polynomials import Polynomial, PolynomialMatrix
from singsym.varieties.real.numerical.sampling import Points, is_large
from singsym.varieties.real.points.intervals import pivots

ALL_MINORS = 24
"""Up to this many minors of a block, its rank locus is written with all of them."""
EASY_MINORS = 24
"""Of a larger block, so many minors that are products of small determinants are used."""


@dataclass(frozen=True)
class BlockRank:
    """The rank of a block where the `minors` of that size do not all vanish.

    exact: whether all minors of that size vanish where these do; seen_off: a polynomial off whose zeros the
    rank is nowhere larger, where that is not known of all of the ground.
    """

    rank: int
    minors: tuple[Polynomial, ...]
    exact: bool = True
    seen_off: Polynomial | None = None


MOST_PRODUCTS = 10**10
"""A determinant whose rows have more terms, multiplied with each other, is not expanded."""


def expanded(square: PolynomialMatrix, certifier: Certifier) -> Polynomial:
    """The determinant; raises `NotEvident` with a short entry that may vanish where it would be too large.

    Where that entry is known not to vanish, it is a pivot, and the matrix gets smaller.
    """
    if prod(sum(map(len, row)) for row in square.rows) > MOST_PRODUCTS:
        why = f"a minor of size {square.width} is too large to be expanded"
        entries = {e for row in square.rows for e in row if not e.is_constant}
        for shortest in sorted(entries, key=lambda e: (*_weight(e), str(e))):
            if certifier.reason(shortest) is None:
                raise NotEvident(shortest, why)
        raise Undecided(why)
    return determinant(square)


Places = tuple[tuple[int, ...], tuple[int, ...]]
"""Rows and columns of a minor."""


def numerical_minor(block: PolynomialMatrix, samples: Points, certifier: Certifier) -> Places:
    """A minor that is as large as the rank of the block at one of the samples, and not small there."""
    best: Places = ((), ())
    for x in samples:
        found = pivots([[float(e) for e in row] for row in block.evaluate(x)])
        if len(found[0]) > len(best[0]) and is_large(expanded(block.select(*found), certifier), (x,)):
            best = found
    return best


def bordered(shape: tuple[int, int], rows: Sequence[int], columns: Sequence[int]) -> Iterator[Places]:
    """The minors with one row and one column more."""
    for i in range(shape[0]):
        if i in rows:
            continue
        for j in range(shape[1]):
            if j not in columns:
                yield tuple(sorted((*rows, i))), tuple(sorted((*columns, j)))


def block_rank(
    block: PolynomialMatrix,
    ground: Ground,
    certifier: Certifier,
    start: Places = ((), ()),
    largest: bool = False,
) -> Known[BlockRank]:
    """The rank of a matrix on the ground minus the common zeros of the minors returned.

    Grows a nonvanishing minor border by border until all bordering minors vanish (lemma above); of several
    nonvanishing ones the one with the simplest factors is taken.
    start: a nonvanishing minor to start from; largest: whether no rank on the ground is known to be larger.

    >>> from singsym.classes.strata.patches import Patch
    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> line = Ground(Patch(R, {"y": R.zero}, ()), ((1.0, 0.0),))
    >>> from singsym.varieties.real.system import RealSystem
    >>> matrix = PolynomialMatrix.of(R, [[x, y], [x, y]])
    >>> block_rank(matrix, line, line.certifier(RealSystem(R, ()), ())).value
    BlockRank(rank=1, minors=(x,), exact=True, seen_off=None)
    """
    rows, columns = start
    premises = Premises()
    last = expanded(block.select(rows, columns), certifier) if rows else None
    while not largest:
        candidates = []
        for r, c in bordered(block.shape, rows, columns):
            minor = expanded(block.select(r, c), certifier)
            if minor and not premises.take(ground.vanishes(minor, certifier)):
                candidates.append((_weight(minor), r, c, minor))
                if minor.is_constant:
                    break
        if not candidates:
            break
        _, rows, columns, last = min(candidates, key=lambda t: t[:3])
    if last is None:
        return premises.conclude(BlockRank(0, ()))
    if last.is_constant:
        return premises.conclude(BlockRank(len(rows), ()))
    seen_off = None if largest or len(rows) == min(block.shape) else last
    found = _with_locus(block, ground, certifier, (rows, columns), seen_off)
    return premises.pass_on(found)


def _is_rank(block: PolynomialMatrix, ground: Ground, certifier: Certifier, places: Places) -> Known[bool]:
    """Whether all minors that border one are seen to vanish on the ground."""
    premises = Premises()
    try:
        borders = (expanded(block.select(*border), certifier) for border in bordered(block.shape, *places))
        known = (premises.take(ground.vanishes(minor, certifier)) for minor in borders if minor)
        return premises.conclude(all(known))
    except NotEvident:
        return Known(False)


def _weight(minor: Polynomial) -> tuple[int, int]:
    return (minor.total_degree, len(minor))


def _with_locus(
    block: PolynomialMatrix,
    ground: Ground,
    certifier: Certifier,
    largest: Places,
    seen_off: Polynomial | None,
) -> Known[BlockRank]:
    """r-minors whose common zeros on the ground contain the locus of lower rank: all where they are few.

    largest: one of them, whose bordering minors vanish; seen_off: it, unless no rank on the ground is known
    to be larger.
    """
    rows, columns = largest
    r = len(rows)
    height, width = block.shape
    exact = comb(height, r) * comb(width, r) <= ALL_MINORS
    choices: Iterable[Places]
    if exact:
        choices = product(combinations(range(height), r), combinations(range(width), r))
    elif r == height and (easy := easy_columns(block)):
        choices = ((rows, c) for c in easy[:EASY_MINORS])
    else:
        choices = (largest, *_swapped(block.shape, rows, columns))
    minors: dict[Polynomial, None] = {}
    premises = Premises()
    for i, j in choices:
        minor = expanded(block.select(i, j), certifier)
        if not minor:
            continue
        if not exact and ground.seems_zero(minor):
            # without it the zeros are a larger set, if that
            continue
        try:
            vanishes = ground.vanishes(minor, certifier)
        except NotEvident:
            # with fewer minors the zeros are a larger set
            exact = False
            continue
        if vanishes.value:
            exact = exact and vanishes.is_proven
            continue
        if seen_off is not None and (i, j) != largest:
            if premises.take(ground.has_no_zeros_inside(seen_off, soon=True)):
                seen_off = None
            elif not premises.take(_is_rank(block, ground, certifier, (i, j))):
                if not premises.take(ground.has_no_zeros_inside(seen_off)):
                    # the rank may be higher where only this minor does not vanish
                    exact = False
                    continue
                seen_off = None
        if minor.is_constant:
            return premises.conclude(BlockRank(r, ()))
        minors[minor.squarefree_part()] = None
    if not minors:
        # none of those that were looked at is known not to vanish, but the one that the rank was seen by
        minors[expanded(block.select(rows, columns), certifier).squarefree_part()] = None
        exact = False
    shortest = tuple(sorted(minors, key=lambda m: (_weight(m), str(m))))
    return premises.conclude(BlockRank(r, shortest, exact, seen_off))


def _swapped(shape: tuple[int, int], rows: tuple[int, ...], columns: tuple[int, ...]) -> Iterator[Places]:
    """Index sets that differ from the given ones in one row or one column."""
    for out in rows:
        for new in range(shape[0]):
            if new not in rows:
                yield tuple(sorted({*rows, new} - {out})), columns
    for out in columns:
        for new in range(shape[1]):
            if new not in columns:
                yield rows, tuple(sorted({*columns, new} - {out}))


def union_of_loci(
    minors: tuple[Polynomial, ...], certifier: Certifier
) -> tuple[tuple[tuple[Polynomial, ...], ...], bool]:
    """Common zeros of factors, not proved nonzero, whose union holds the common zeros of the minors.

    Minors with few factors come first; where the choices are too many, the last are left out, and the union
    may be larger: the second value is False then.
    """
    products = []
    for minor in minors:
        parts = factored((minor,), certifier)
        if parts.vanishes:
            continue
        if not parts.factors:
            return (), True
        products.append(parts.polynomials)
    if not products:
        return (), True
    products.sort(key=lambda factors: (len(factors), sum(len(p) for p in factors)))
    found, count = alternatives(tuple(products), certifier), len(products)
    while found is None:
        # fewer equations hold on a larger set: still all of the locus
        products = products[: len(products) * 2 // 3]
        found = alternatives(tuple(products), certifier)
    return found, len(products) == count
