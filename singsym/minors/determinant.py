"""Determinants and minors of sparse polynomial matrices by Laplace expansion with shared subminors.

Source: expansion along rows with every subminor computed once, as in W. M. Gentleman, S. C. Johnson,
"Analysis of algorithms, a case study: determinants of matrices with polynomial entries" (1976).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations

from flint import fmpq, fmpq_mpoly, fmpz, fmpz_mpoly

from singsym.effort.budget import current
from singsym.minors.blocks import block_triangular
from singsym.polynomials import Polynomial, PolynomialMatrix


class TooManyTerms(ArithmeticError):
    """A determinant has more terms than the limit that was asked for."""


_Row = tuple[tuple[int, fmpz_mpoly], ...]


def _integer_row(row: Sequence[Polynomial]) -> tuple[_Row, fmpz]:
    """The nonzero entries times the common denominator of the row, with that denominator."""
    denominator = fmpz(1)
    for entry in row:
        for c in entry.value.coeffs():
            denominator = denominator.lcm(c.q)
    cleared = []
    for j, entry in enumerate(row):
        if entry:
            terms = {m: c.p * (denominator // c.q) for m, c in entry.value.terms()}
            cleared.append((j, entry.ring.integer_context.from_dict(terms)))
    return tuple(cleared), denominator


def _row_order(rows: Sequence[_Row]) -> list[int]:
    """Rows that bring few new columns first, light ones before heavy ones: few subminors, late swell."""
    weight = [sum(len(entry) for _, entry in row) for row in rows]
    left, touched, order = set(range(len(rows))), set[int](), []
    while left:
        best = min(left, key=lambda i: (sum(j not in touched for j, _ in rows[i]), weight[i], i))
        order.append(best)
        left.remove(best)
        touched.update(j for j, _ in rows[best])
    return order


def _parity(permutation: Sequence[int]) -> bool:
    """Whether the permutation is odd."""
    return bool(sum(a > b for a, b in combinations(permutation, 2)) % 2)


def _expand(rows: Sequence[_Row], needed: Iterable[int], limit: int | None = None) -> dict[int, fmpz_mpoly]:
    """All maximal minors of the rows in the order given, by bit mask of columns.

    limit: of the number of terms of all minors of some first rows; `TooManyTerms` beyond.

    needed: after k rows, the columns (bit mask) that a subset must contain to be of use.
    """
    level: dict[int, fmpz_mpoly] = {}
    for k, (row, must) in enumerate(zip(rows, needed, strict=True)):
        following: dict[int, fmpz_mpoly] = {}
        previous: Iterable[tuple[int, fmpz_mpoly | None]] = level.items() if k else [(0, None)]
        for mask, minor in previous:
            current().check("a determinant")
            for j, entry in row:
                if mask >> j & 1 or (reached := mask | 1 << j) & must != must:
                    continue
                term = entry if minor is None else minor * entry
                if (k + (mask & (1 << j) - 1).bit_count()) % 2:
                    term = -term
                known = following.get(reached)
                following[reached] = term if known is None else known + term
        level = {mask: minor for mask, minor in following.items() if minor}
        if limit is not None and sum(len(minor) for minor in level.values()) > limit:
            raise TooManyTerms(f"more than {limit} terms in the minors of {k + 1} rows")
    return level


def _determinant(matrix: PolynomialMatrix, limit: int | None = None) -> Polynomial:
    """The determinant of a square matrix without splitting it into blocks."""
    if not matrix.rows:
        return matrix.ring.one
    cleared = [_integer_row(row) for row in matrix.rows]
    order = _row_order([row for row, _ in cleared])
    rows = [cleared[i][0] for i in order]
    needed, later = [], 0
    for row in reversed(rows):
        needed.append(((1 << matrix.width) - 1) & ~later)
        for j, _ in row:
            later |= 1 << j
    minors = _expand(rows, reversed(needed), limit)
    if not minors:
        return matrix.ring.zero
    scale = fmpz(-1 if _parity(order) else 1)
    denominator = fmpz(1)
    for _, d in cleared:
        denominator *= d
    value = fmpq_mpoly(next(iter(minors.values()))) * fmpq(scale, denominator)
    return Polynomial(matrix.ring, value)


def _require_square(matrix: PolynomialMatrix) -> None:
    if matrix.shape[0] != matrix.shape[1]:
        raise ValueError(f"a determinant needs a square matrix, not {matrix.shape}: use maximal_minors")


def block_determinants(matrix: PolynomialMatrix, limit: int | None = None) -> tuple[Polynomial, ...]:
    """Determinants of the diagonal blocks of the block triangular form; their product is the determinant.

    The sign is put on the first.  A single zero where no transversal exists.  Square matrices only.
    limit: raises `TooManyTerms` where the subminors on the way have more terms together.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> block_determinants(PolynomialMatrix.of(x.ring, [[x, 1], [0, y]]))
    (x, y)
    """
    _require_square(matrix)
    form = block_triangular(matrix)
    if not form.is_square:
        return (matrix.ring.zero,)
    found = [_determinant(matrix.select(rows, columns), limit) for rows, columns in form.square]
    row_order = [i for rows, _ in form.square for i in rows]
    column_order = [j for _, columns in form.square for j in columns]
    if found and _parity(row_order) != _parity(column_order):
        found[0] = -found[0]
    return tuple(found)


def determinant(matrix: PolynomialMatrix) -> Polynomial:
    """The determinant of a square matrix, expanded.

    Raises `ValueError` where the matrix is not square.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> determinant(PolynomialMatrix.of(x.ring, [[x, y], [1, x]]))
    x^2 - y
    """
    product = matrix.ring.one
    for factor in block_determinants(matrix):
        product = product * factor
    return product


Minor = tuple[tuple[int, ...], tuple[int, ...], Polynomial]


def _columns(mask: int) -> tuple[int, ...]:
    return tuple(j for j in range(mask.bit_length()) if mask >> j & 1)


def maximal_minors(matrix: PolynomialMatrix, limit: int | None = None) -> Iterator[Minor]:
    """The nonzero minors of the largest size, as (rows, columns, minor), sharing all subminors.

    limit: of the number of terms of all minors of some first rows; `TooManyTerms` beyond.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> list(maximal_minors(PolynomialMatrix.of(x.ring, [[x, y, 0], [0, x, y]])))
    [((0, 1), (0, 1), x^2), ((0, 1), (0, 2), x*y), ((0, 1), (1, 2), y^2)]
    """
    height, width = matrix.shape
    if height > width:
        for rows, columns, minor in maximal_minors(matrix.T, limit):
            yield columns, rows, minor
        return
    if not height:
        yield (), (), matrix.ring.one
        return
    cleared = [_integer_row(row) for row in matrix.rows]
    order = _row_order([row for row, _ in cleared])
    found = _expand([cleared[i][0] for i in order], [0] * height, limit)
    denominator = fmpz(1)
    for _, d in cleared:
        denominator *= d
    scale = fmpq(-1 if _parity(order) else 1, denominator)
    for columns, value in sorted((_columns(mask), value) for mask, value in found.items()):
        yield tuple(range(height)), columns, Polynomial(matrix.ring, fmpq_mpoly(value) * scale)


def minors(matrix: PolynomialMatrix, size: int, limit: int | None = None) -> Iterator[Minor]:
    """The nonzero minors of a size, as (rows, columns, minor); one of size 0, the empty one.

    Subminors are shared among the minors in the same rows.  limit: as of `maximal_minors`, of these.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> [m for _, _, m in minors(PolynomialMatrix.of(x.ring, [[x, y], [0, 1]]), 1)]
    [x, y, 1]
    """
    if size > min(matrix.shape):
        return
    if matrix.shape[0] > matrix.shape[1]:
        for columns, rows, minor in minors(matrix.T, size, limit):
            yield rows, columns, minor
        return
    for rows in combinations(range(matrix.shape[0]), size):
        for _, columns, minor in maximal_minors(matrix.select(rows), limit):
            yield rows, columns, minor
