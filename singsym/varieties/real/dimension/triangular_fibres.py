"""Whether polynomials have a common zero over almost all values of some coordinates, on a triangular set.

A triangular set gives one coordinate after the other by an equation in it and those known.  Over values of
the free ones at which no leading coefficient is a zero divisor, its points make up a finite algebra.

Lemma.  Let O be the local ring of Z[free coordinates] at a prime number p and values modulo p.  If, modulo p
and at these values, each leading coefficient is a unit in the algebra of the equations before it, then so it
is over O, and the algebra A of all equations is a free O-module.  If polynomials generate the unit ideal of A
modulo p and at these values, they do so over O (Nakayama), and over the field of rational functions: off a
proper closed set of values of the free coordinates they have no common zero on the triangular set.
Source: Atiyah, Macdonald, Introduction to Commutative Algebra (1969), 2.8; Aubry, Lazard, Moreno Maza,
J. Symb. Comput. 28 (1999) 105-124 (regular chains).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from flint import nmod, nmod_mat

from singsym.effort import chance
from singsym.effort.budget import current
from singsym.polynomials import Polynomial

_MOST_POINTS = 256
"""Fibres with more points, each as often as it counts, are not looked at."""

Triangular = tuple[tuple[Polynomial, str], ...]
"""Equations, each with the coordinate that it gives; those after it are in neither, nor is it in them."""


def miss_almost_all(tower: Triangular, free: Collection[str], polynomials: Sequence[Polynomial]) -> bool:
    """Whether there is no common zero on a triangular set over almost all values of the free coordinates.

    tower: the last equation is in its own coordinate and the free ones alone.
    False proves nothing.  Raises `BudgetExceeded`.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> sphere, circle = (z**2 + x**2 + y**2 - 2, "z"), (y**2 + x**2 - 1, "y")
    >>> miss_almost_all((sphere, circle), "x", [z - y]), miss_almost_all((sphere, circle), "x", [z**2 - 1])
    (True, False)
    """
    if not polynomials:
        return False
    prime, drawn = chance.sparing_prime(), chance.random("triangular fibres", *polynomials)
    fibre = _Fibre(prime, 1, {name: _scalar(1, drawn.randrange(prime), prime) for name in sorted(free)})
    for equation, name in reversed(tower):
        above = fibre.extended(equation.primitive(), name)
        if above is None:
            return False
        fibre = above
    rows: list[list[nmod]] = []
    for p in polynomials:
        rows += fibre.value(p.primitive()).tolist()
    return bool(nmod_mat(rows, prime).rank() == fibre.size)


@dataclass(frozen=True)
class _Fibre:
    """The algebra over some values, modulo a prime: its coordinates, as they act on a basis of `size`.

    values: matrices by names, `size` x `size`; they commute.
    """

    prime: int
    size: int
    values: dict[str, nmod_mat]

    def value(self, p: Polynomial) -> nmod_mat:
        """How a polynomial in the names, with whole coefficients, acts."""
        total = nmod_mat(self.size, self.size, self.prime)
        known: dict[tuple[str, ...], nmod_mat] = {(): _scalar(self.size, 1, self.prime)}
        for exponents, c in p.terms():
            current().check("points over values of coordinates")
            names = tuple(n for n, e in zip(p.ring.names, exponents, strict=True) for _ in range(e))
            for k in range(1, len(names) + 1):
                if names[:k] not in known:
                    known[names[:k]] = known[names[: k - 1]] * self.values[names[k - 1]]
            total += known[names] * nmod(int(c.p), self.prime)
        return total

    def extended(self, equation: Polynomial, name: str) -> _Fibre | None:
        """With one coordinate more; None where its leading coefficient is no unit, or it is too large."""
        degree = equation.degree(name)
        if degree * self.size > _MOST_POINTS:
            return None
        *lower, lead = (self.value(equation.coefficient(name, k)) for k in range(degree + 1))
        try:
            scale = lead.inv() * nmod(-1, self.prime)
        except ZeroDivisionError:
            return None
        # basis 1, x, ..., x^(k-1): the companion matrix, in blocks
        size = degree * self.size
        rows = [[0] * size for _ in range(size)]
        for k, block in enumerate(scale * part for part in lower):
            for i, row in enumerate(block.tolist()):
                rows[(degree - 1) * self.size + i][k * self.size : (k + 1) * self.size] = map(int, row)
        for i in range(size - self.size):
            rows[i][self.size + i] = 1
        values = {known: _repeated(value, degree, self.prime) for known, value in self.values.items()}
        return _Fibre(self.prime, size, values | {name: nmod_mat(rows, self.prime)})


def _scalar(size: int, number: int, prime: int) -> nmod_mat:
    return nmod_mat(size, size, [number * (i == j) for i in range(size) for j in range(size)], prime)


def _repeated(matrix: nmod_mat, times: int, prime: int) -> nmod_mat:
    """The matrix so many times along the diagonal."""
    size = matrix.nrows()
    rows = [[0] * (size * times) for _ in range(size * times)]
    for i, row in enumerate(matrix.tolist()):
        for k in range(times):
            rows[k * size + i][k * size : (k + 1) * size] = map(int, row)
    return nmod_mat(rows, prime)
