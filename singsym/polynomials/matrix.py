"""Matrices of polynomials.

Source: the velocity equation's L and its submatrices, Zlatanov, Fenton, Benhabib (1998), (1)-(3).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import sympy

from singsym.polynomials.polynomial import Polynomial
from singsym.polynomials.ring import Ring


@dataclass(frozen=True)
class PolynomialMatrix:
    """An immutable matrix over a ring; `rows` is a tuple of equally long tuples, `width` its columns.

    >>> R = Ring(("x",))
    >>> x, = R.gens
    >>> M = PolynomialMatrix(R, ((x, R.one), (R.zero, x)))
    >>> M.shape
    (2, 2)
    >>> M.select(columns=(1,)).rows
    ((1,), (x,))
    """

    ring: Ring
    rows: tuple[tuple[Polynomial, ...], ...]
    width: int = -1

    def __post_init__(self) -> None:
        if self.width < 0:
            object.__setattr__(self, "width", len(self.rows[0]) if self.rows else 0)

    @classmethod
    def of(cls, ring: Ring, rows: Iterable[Iterable[Any]], width: int = -1) -> PolynomialMatrix:
        """From rows of polynomials of the ring or rationals."""
        return cls(
            ring,
            tuple(tuple(e if isinstance(e, Polynomial) else ring.constant(e) for e in row) for row in rows),
            width,
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of rows and of columns."""
        return len(self.rows), self.width

    def __getitem__(self, index: tuple[int, int]) -> Polynomial:
        return self.rows[index[0]][index[1]]

    def __repr__(self) -> str:
        return f"PolynomialMatrix({self.shape[0]}x{self.shape[1]} over {self.ring!r})"

    @property
    def T(self) -> PolynomialMatrix:
        """The transpose."""
        return PolynomialMatrix(self.ring, tuple(zip(*self.rows, strict=True)), len(self.rows))

    def select(
        self, rows: Sequence[int] | None = None, columns: Sequence[int] | None = None
    ) -> PolynomialMatrix:
        """The submatrix of these rows and columns, in the order given."""
        chosen = self.rows if rows is None else tuple(self.rows[i] for i in rows)
        if columns is None:
            return PolynomialMatrix(self.ring, chosen, self.width)
        return PolynomialMatrix(self.ring, tuple(tuple(r[j] for j in columns) for r in chosen), len(columns))

    def map(self, function: Callable[[Polynomial], Polynomial], ring: Ring | None = None) -> PolynomialMatrix:
        """The matrix with a function applied to each entry (into `ring`, if given)."""
        rows = tuple(tuple(function(e) for e in row) for row in self.rows)
        return PolynomialMatrix(ring or self.ring, rows, self.width)

    def evaluate(self, values: Sequence[Any]) -> list[list[Any]]:
        """The entries at a point given in the order of the ring's names (see `Polynomial.evaluate`)."""
        return [[e.evaluate(values) for e in row] for row in self.rows]

    def to_sympy(self) -> sympy.Matrix:
        """The same matrix in SymPy."""
        entries = [[e.to_sympy() for e in row] for row in self.rows]
        return sympy.ImmutableMatrix(len(self.rows), self.width, [e for row in entries for e in row])

    def _repr_latex_(self) -> str:
        return f"${sympy.latex(self.to_sympy())}$"
