"""Sums of squares seen at sight: equations that force several polynomials to vanish over the reals.

Source: Choi, Lam, Reznick, Proc. Symp. Pure Math. 58.2 (1995) 103-126; one Gram matrix is tried.
"""

from __future__ import annotations

from flint import fmpq

from singsym.polynomials import Polynomial

Monomial = tuple[int, ...]


def sum_of_squares(polynomial: Polynomial) -> tuple[int, tuple[Polynomial, ...]] | None:
    """A sign and squares' roots: polynomial = sign * (positive combination of their squares), or `None`.

    Every odd term goes to one pair of even ones, so that `None` proves nothing.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> sum_of_squares(2 * x * y - x**2 - 2 * y**2 - 1)
    (-1, (x - y, y, 1))
    >>> sum_of_squares(x**2 - y**2) is None
    True
    """
    terms = {tuple(map(int, m)): c for m, c in polynomial.terms()}
    if not terms:
        return None
    even = {m for m in terms if not any(e % 2 for e in m)}
    signs = {terms[m] > 0 for m in even}
    if len(signs) != 1:
        return None
    sign = 1 if signs.pop() else -1
    half = sorted((tuple(e // 2 for e in m) for m in even), reverse=True)
    gram = {(h, h): sign * terms[tuple(2 * e for e in h)] for h in half}
    for m, c in terms.items():
        if m in even:
            continue
        pair = _pair(m, half)
        if pair is None:
            return None
        gram[pair] = sign * c / 2
    roots = _decomposed(polynomial, half, gram)
    return None if roots is None else (sign, roots)


def _pair(m: Monomial, half: list[Monomial]) -> tuple[Monomial, Monomial] | None:
    known = set(half)
    for a in half:
        b = tuple(x - y for x, y in zip(m, a, strict=True))
        if b in known:
            return (a, b) if half.index(a) < half.index(b) else (b, a)
    return None


def _decomposed(
    polynomial: Polynomial, half: list[Monomial], gram: dict[tuple[Monomial, Monomial], fmpq]
) -> tuple[Polynomial, ...] | None:
    """The rows of L in Gram = L D L^T with D >= 0, as polynomials; `None` where it is not semidefinite."""
    size = len(half)
    matrix = [[fmpq(0)] * size for _ in range(size)]
    for i, a in enumerate(half):
        for j, b in enumerate(half[i:], i):
            matrix[i][j] = matrix[j][i] = gram.get((a, b), fmpq(0))
    roots = []
    for k in range(size):
        pivot = matrix[k][k]
        row = matrix[k][:]
        if pivot < 0 or (pivot == 0 and any(row[k:])):
            return None
        if pivot == 0:
            continue
        roots.append(polynomial.ring.from_dict({half[j]: row[j] / pivot for j in range(k, size) if row[j]}))
        for i in range(k + 1, size):
            factor = row[i] / pivot
            for j in range(k + 1, size):
                matrix[i][j] -= factor * row[j]
    return tuple(roots)
