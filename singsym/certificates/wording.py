"""What a certificate proves, in words.

Source: singsym's own.
"""

from __future__ import annotations

from singsym.certificates.checker.table import Row

TRUSTED = (
    "that L, the loop equations and the conditions are those of the mechanism",
    "the arithmetic of FLINT: polynomials, factors over Q, roots, balls",
    "the checker, and the Python that runs it",
)
"""What is taken on trust."""


def row_text(row: Row) -> str:
    """A row of the table in words.

    >>> row_text(Row("RI, IO", True, 0, 2, 2))
    'RI, IO: occurs, dimension 0, 2 points, 2 components'
    """
    if not row.occurs:
        return f"{row.types}: {'not proven' if row.occurs is None else 'empty'}"
    numbers = ((row.points, "points"), (row.components, "components"))
    sizes = [f"{k} {word}" for k, word in numbers if k is not None]
    groups = [f"{len(own)} loops together" for own in row.together]
    dimension = "dimension not proven" if row.dimension is None else f"dimension {row.dimension}"
    return f"{row.types}: occurs, {', '.join((dimension, *sizes, *groups))}"
