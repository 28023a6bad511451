"""Block triangular and block diagonal forms of a matrix, from the places of its zeros alone.

Source: A. L. Dulmage, N. S. Mendelsohn, "Coverings of bipartite graphs" (1958); A. Pothen, C.-J. Fan,
"Computing the block triangular form of a sparse matrix" (1990).  Matching and components by networkx.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, islice

import networkx

from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.polynomials.block_form import ordered_components

Block = tuple[tuple[int, ...], tuple[int, ...]]


@dataclass(frozen=True)
class BlockForm:
    """The Dulmage-Mendelsohn decomposition: with rows and columns in this order the matrix is block upper
    triangular, with the wide part first, then the square blocks, then the tall part.

    wide: rows and columns of the part with more columns than rows (a maximum matching covers the rows).
    square: the diagonal blocks, each square and not to be split further.
    tall: the part with more rows than columns (the matching covers the columns).
    """

    wide: Block
    square: tuple[Block, ...]
    tall: Block

    @property
    def is_square(self) -> bool:
        """Whether there is only the square part: the matrix is square and has a nonzero transversal."""
        return not (self.wide[1] or self.tall[0])

    @property
    def row_order(self) -> tuple[int, ...]:
        """The permutation of the rows."""
        return (*self.wide[0], *(i for rows, _ in self.square for i in rows), *self.tall[0])

    @property
    def column_order(self) -> tuple[int, ...]:
        """The permutation of the columns."""
        return (*self.wide[1], *(j for _, columns in self.square for j in columns), *self.tall[1])


def _nonzeros(matrix: PolynomialMatrix) -> list[tuple[int, int]]:
    return [(i, j) for i, row in enumerate(matrix.rows) for j, entry in enumerate(row) if entry]


def block_triangular(matrix: PolynomialMatrix) -> BlockForm:
    """The Dulmage-Mendelsohn decomposition of a matrix of any shape.

    The square blocks are the strongly connected components of the graph on the rows in which row i points
    to the row matched to each column where row i has an entry.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> block_triangular(PolynomialMatrix.of(x.ring, [[0, y], [x, 1]])).square
    (((1,), (0,)), ((0,), (1,)))
    """
    height, width = matrix.shape
    graph = networkx.Graph()
    row_nodes = [("row", i) for i in range(height)]
    column_nodes = [("column", j) for j in range(width)]
    graph.add_nodes_from(row_nodes)
    graph.add_nodes_from(column_nodes)
    graph.add_edges_from((("row", i), ("column", j)) for i, j in _nonzeros(matrix))
    matching = networkx.bipartite.hopcroft_karp_matching(graph, top_nodes=row_nodes)
    tall = _alternating(graph, matching, [r for r in row_nodes if r not in matching])
    wide = _alternating(graph, matching, [c for c in column_nodes if c not in matching])
    middle = [row for row in row_nodes if row not in tall and row not in wide]
    edges = (
        (row[1], matching[column][1])
        for row in middle
        for column in graph[row]
        if column not in wide and column not in tall
    )
    square = tuple(
        (tuple(rows), tuple(sorted(matching["row", i][1] for i in rows)))
        for rows in ordered_components((i for _, i in middle), edges)
    )
    return BlockForm(_block(wide), square, _block(tall))


def _alternating(
    graph: networkx.Graph, matching: dict[tuple[str, int], tuple[str, int]], start: list[tuple[str, int]]
) -> set[tuple[str, int]]:
    """The nodes that alternating paths reach from unmatched nodes of one side."""
    seen = set(start)
    stack = list(start)
    while stack:
        for neighbour in graph[stack.pop()]:
            if neighbour not in seen:
                seen.add(neighbour)
                partner = matching[neighbour]
                if partner not in seen:
                    seen.add(partner)
                    stack.append(partner)
    return seen


def _block(nodes: set[tuple[str, int]]) -> Block:
    return tuple(sorted(i for k, i in nodes if k == "row")), tuple(
        sorted(j for k, j in nodes if k == "column")
    )


def diagonal_blocks(matrix: PolynomialMatrix) -> tuple[Block, ...]:
    """The connected components of rows and columns, without zero rows and zero columns.

    Outside the blocks the matrix is zero, so its rank is the sum of theirs.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> diagonal_blocks(PolynomialMatrix.of(x.ring, [[x, 0, 0], [0, y, 1], [0, 0, 0]]))
    (((0,), (0,)), ((1,), (1, 2)))
    """
    graph = networkx.Graph()
    graph.add_edges_from((("row", i), ("column", j)) for i, j in _nonzeros(matrix))
    return tuple(sorted(_block(nodes) for nodes in networkx.connected_components(graph)))


def sparser(matrix: PolynomialMatrix) -> PolynomialMatrix:
    """The matrix after rational row operations that make it sparser: all its ranks by columns stay.

    >>> x, y = Ring(("x", "y")).gens
    >>> sparser(PolynomialMatrix.of(x.ring, [[x, 0], [2 * x, y]])).rows
    ((x, 0), (0, y))
    """
    rows = [list(row) for row in matrix.rows]
    changed = True
    while changed:
        changed = False
        for i, row in enumerate(rows):
            for k, other in enumerate(rows):
                better = None if i == k else _combined(row, other)
                if better is not None:
                    rows[i] = row = better
                    changed = True
    return PolynomialMatrix(matrix.ring, tuple(map(tuple, rows)), matrix.width)


def _combined(row: list[Polynomial], other: list[Polynomial]) -> list[Polynomial] | None:
    """The row minus a rational multiple of the other that has more zeros, if there is one."""
    zeros = sum(e.is_zero for e in row)
    tried = set()
    for a, b in zip(row, other, strict=True):
        if a.is_zero or b.is_zero or a.primitive() != b.primitive():
            continue
        factor = a.leading_term[1] / b.leading_term[1]
        if factor in tried:
            continue
        tried.add(factor)
        candidate = [x - y * factor for x, y in zip(row, other, strict=True)]
        if sum(e.is_zero for e in candidate) > zeros:
            return candidate
    return None


EASY_BLOCK = 3
"""Minors whose block triangular form has no larger diagonal block are easy to expand."""
MOST_CHOICES = 1000
"""Among more sets of columns than these, only the first are looked at."""


def easy_columns(matrix: PolynomialMatrix) -> tuple[tuple[int, ...], ...]:
    """Sets of as many columns as there are rows whose minors are products of small determinants.

    >>> x, y = Ring(("x", "y")).gens
    >>> easy_columns(PolynomialMatrix.of(x.ring, [[x, 0, y], [0, y, 0]]))
    ((0, 1), (1, 2))
    """
    pattern = tuple(tuple(bool(e) for e in row) for row in matrix.rows)
    return _easy_columns(pattern, matrix.width)


@lru_cache(maxsize=256)
def _easy_columns(pattern: tuple[tuple[bool, ...], ...], width: int) -> tuple[tuple[int, ...], ...]:
    ring = Ring(("x",))
    model = PolynomialMatrix.of(ring, [[int(e) for e in row] for row in pattern], width)
    found = []
    for columns in islice(combinations(range(width), len(pattern)), MOST_CHOICES):
        form = block_triangular(model.select(columns=columns))
        sizes = [len(rows) for rows, _ in form.square]
        if sum(sizes) == len(pattern) and max(sizes, default=0) <= EASY_BLOCK:
            found.append((sum(size**3 for size in sizes), columns))
    return tuple(columns for _, columns in sorted(found))
