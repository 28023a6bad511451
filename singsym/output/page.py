"""Pages of text and grids, that a terminal, a pipe and a notebook show each in their own way.

Source: singsym's own.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Grid:
    """A table: headers, rows of as many cells, and a title above."""

    headers: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    title: str = ""


Block = str | Grid
Page = tuple[Block, ...]


def plain(page: Page) -> str:
    """The page as text, blocks apart by an empty line, columns aligned; for pipes and files.

    >>> print(plain(("Joints", Grid(("joint", "kind"), (("A", "R"), ("B2", "P"))))))
    Joints
    <BLANKLINE>
    joint  kind
    -----  ----
    A      R
    B2     P
    """
    return "\n\n".join(block if isinstance(block, str) else _aligned(block) for block in page)


def _aligned(grid: Grid) -> str:
    cells = [grid.headers, *grid.rows]
    widths = [max(len(row[j]) for row in cells) for j in range(len(grid.headers))]
    lines = [_line(grid.headers, widths), _line(tuple("-" * w for w in widths), widths)]
    lines += [_line(row, widths) for row in grid.rows]
    return "\n".join([grid.title, *lines] if grid.title else lines)


def _line(cells: tuple[str, ...], widths: list[int]) -> str:
    return "  ".join(cell.ljust(width) for cell, width in zip(cells, widths, strict=True)).rstrip()
