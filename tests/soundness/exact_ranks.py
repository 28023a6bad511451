"""The defects of a velocity equation at a point by exact ranks over the rationals.

Source: the definitions (i)-(vi) in section 3.1 of Zlatanov, Fenton, Benhabib (1998); the ranks are SymPy's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy

from singsym.classes.taxonomy.types import Defects

Columns = Sequence[tuple[str, str]]


def defects(L: sympy.Matrix, columns: Columns, at: Mapping[sympy.Symbol, int], N: int, n: int) -> Defects:
    """delta, p, k_I, k_O where the symbols have these values."""
    matrix = L.subs(at)

    def rank(*without: str) -> int:
        kept = [j for j, (_, role) in enumerate(columns) if role not in without]
        return int(matrix.extract(list(range(matrix.rows)), kept).rank()) if kept else 0

    return Defects(N - rank(), N - n - rank("input", "output"), N - rank("input"), N - rank("output"))
