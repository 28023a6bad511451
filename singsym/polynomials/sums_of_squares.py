"""Sums of squares seen at sight: equations that force several polynomials to vanish over the reals.

Source: Choi, Lam, Reznick, Proc. Symp. Pure Math. 58.2 (1995) 103-126; one Gram matrix is tried.
"""

from __future__ import annotations

from functools import lru_cache

from flint import fmpq

from singsym.polynomials import Polynomial
from singsym.polynomials.polynomial import Exponents


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
    if polynomial.is_constant and polynomial:
        return (1 if polynomial.constant > 0 else -1), (polynomial.ring.one,)
    found = squares_less_constant(polynomial)
    if found is None or found[2] > 0:
        return None
    sign, squares, less = found
    roots = [root for _, root in squares]
    return sign, tuple([*roots, polynomial.ring.one] if less < 0 else roots)


@lru_cache(maxsize=2**13)
def squares_less_constant(
    polynomial: Polynomial,
) -> tuple[int, tuple[tuple[fmpq, Polynomial], ...], fmpq] | None:
    """Sign, pairs (d > 0, root) and r with polynomial = sign * (sum of d root^2 - r), or `None`.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> squares_less_constant(x**2 - 2 * x + 4 * y**2)
    (1, ((1, x - 1), (4, y)), 1)
    """
    terms = {tuple(map(int, m)): c for m, c in polynomial.terms()}
    one = (0,) * len(polynomial.ring.names)
    if not set(terms) - {one}:
        return None
    even = {m for m in terms if not any(e % 2 for e in m)} | {one}
    signs = {terms[m] > 0 for m in even if m != one}
    if len(signs) != 1:
        return None
    sign = 1 if signs.pop() else -1
    half = sorted((tuple(e // 2 for e in m) for m in even), reverse=True)
    places = {h: k for k, h in enumerate(half)}
    gram = {(h, h): sign * terms.get(tuple(2 * e for e in h), fmpq(0)) for h in half}
    for m, c in terms.items():
        if m in even:
            continue
        pair = _pair(m, places)
        if pair is None:
            return None
        gram[pair] = sign * c / 2
    squares = _decomposed(polynomial, half, gram)
    if squares is None:
        return None
    kept = tuple(pair for pair in squares if not pair[1].is_constant)
    return sign, kept, sum((-d for d, root in squares if root.is_constant), start=fmpq(0))


def _pair(m: Exponents, half: dict[Exponents, int]) -> tuple[Exponents, Exponents] | None:
    for a in half:
        b = tuple(x - y for x, y in zip(m, a, strict=True))
        if b in half:
            return (a, b) if half[a] < half[b] else (b, a)
    return None


def _decomposed(
    polynomial: Polynomial, half: list[Exponents], gram: dict[tuple[Exponents, Exponents], fmpq]
) -> list[tuple[fmpq, Polynomial]] | None:
    """D and the rows of L^T in Gram = L D L^T; `None` where D < 0 elsewhere than at the constant."""
    size = len(half)
    matrix = [[fmpq(0)] * size for _ in range(size)]
    for i, a in enumerate(half):
        for j, b in enumerate(half[i:], i):
            matrix[i][j] = matrix[j][i] = gram.get((a, b), fmpq(0))
    roots = []
    for k in range(size):
        pivot = matrix[k][k]
        row = matrix[k][:]
        if (pivot < 0 and k < size - 1) or (pivot == 0 and any(row[k:])):
            return None
        if pivot == 0:
            continue
        root = polynomial.ring.from_dict({half[j]: row[j] / pivot for j in range(k, size) if row[j]})
        roots.append((pivot, root))
        for i in range(k + 1, size):
            factor = row[i] / pivot
            for j in range(k + 1, size):
                matrix[i][j] -= factor * row[j]
    return roots
