"""Polynomial maps compiled to arrays: values and Jacobian matrices in doubles, at one point or at many.

Source: straight-line programs, Bürgisser, Clausen, Shokrollahi, Algebraic Complexity Theory (1997), 4.1: each
monomial is the product of an earlier one and a variable.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from singsym.polynomials.matrix import PolynomialMatrix
from singsym.polynomials.polynomial import Equations, Exponents, Polynomial
from singsym.polynomials.ring import Ring
from singsym.polynomials.sizes import largest_term, variable_sizes

Floats = NDArray[np.float64]

_DENSE = 50
"""With no more entries than so many times the terms, a full matrix is quicker than sums (measured)."""


class MonomialTable:
    """Monomials in an order in which each is the product of an earlier one and a variable; the first is 1.

    index: the place of each; levels: for each degree from 1 on the places from which and at which its
    monomials stand, the places of those that they are made of, and the variables that are multiplied with.

    >>> table = MonomialTable([(2, 1)], 2)
    >>> list(table.index), table.at(np.array([3.0, 5.0]))
    ([(0, 0), (1, 0), (2, 0), (2, 1)], array([ 1.,  3.,  9., 45.]))
    """

    def __init__(self, monomials: Iterable[Exponents], variables: int) -> None:
        closed = {(0,) * variables}
        for m in monomials:
            while m not in closed:
                closed.add(m)
                m = _divided(m, _last_variable(m))
        ordered = sorted(closed, key=lambda m: (sum(m), m))
        self.index = {m: k for k, m in enumerate(ordered)}
        self.levels: list[tuple[int, int, NDArray[np.intp], NDArray[np.intp]]] = []
        start = 1
        while start < len(ordered):
            degree = sum(ordered[start])
            stop = start
            while stop < len(ordered) and sum(ordered[stop]) == degree:
                stop += 1
            factors = [_last_variable(m) for m in ordered[start:stop]]
            parents = [self.index[_divided(m, i)] for m, i in zip(ordered[start:stop], factors, strict=True)]
            self.levels.append((start, stop, np.array(parents), np.array(factors)))
            start = stop

    def __len__(self) -> int:
        return len(self.index)

    def at(self, coordinates: NDArray[Any], dtype: DTypeLike = np.float64) -> NDArray[Any]:
        """Their values, (monomials, ...), where the variables have these values, (variables, ...)."""
        found = np.ones((len(self), *coordinates.shape[1:]), dtype=dtype)
        for start, stop, parents, factors in self.levels:
            np.multiply(found[parents], coordinates[factors], out=found[start:stop])
        return found


class CompiledMap:
    """Polynomials of one ring as a map in doubles, at one point (variables,) or at many (B, variables).

    sizes: how large the variables are, by default by `variable_sizes`.
    scales: what the polynomials are divided by, one for each, by default 1.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> spiral = CompiledMap((x * y, x - y**2), R)
    >>> spiral.values(np.array([2.0, 3.0]))
    array([ 6., -7.])
    >>> spiral.jacobian(np.array([[2.0, 3.0], [0.0, 1.0]])).shape
    (2, 2, 2)
    """

    def __init__(
        self,
        polynomials: Sequence[Polynomial],
        ring: Ring,
        sizes: Sequence[float] | Floats | None = None,
        scales: Sequence[float] | Floats | None = None,
    ) -> None:
        self.polynomials = tuple(polynomials)
        self.ring = ring
        self.size, self.count = len(ring.names), len(self.polynomials)
        self.scales = np.ones(self.count) if scales is None else np.array(scales, dtype=np.float64)
        self._given_sizes = sizes

    def rescaled(self, sizes: Floats, scales: Floats) -> CompiledMap:
        """The same polynomials with other sizes of the variables and other scales."""
        return CompiledMap(self.polynomials, self.ring, sizes, scales)

    @classmethod
    def balanced(
        cls, polynomials: Sequence[Polynomial], ring: Ring, sizes: Sequence[float] | None = None
    ) -> CompiledMap:
        """The map of polynomials scaled so that the largest term of each is 1 at these sizes of variables.

        Coefficients may be too large for doubles; they are divided by the largest one first.
        """
        return _balanced(tuple(polynomials), ring, None if sizes is None else tuple(sizes))

    @cached_property
    def sizes(self) -> Floats:
        """How large the variables are: steps of Newton's method are measured against these."""
        given = self._given_sizes
        return np.array(variable_sizes(self.ring, self.polynomials) if given is None else given, dtype=float)

    @cached_property
    def _rows(self) -> list[dict[Exponents, float]]:
        """The coefficients, each as the nearest double, over the scales."""
        pairs = zip(self.polynomials, self.scales.tolist(), strict=True)
        return [{tuple(map(int, m)): int(c.p) / int(c.q) / scale for m, c in p.terms()} for p, scale in pairs]

    @cached_property
    def _values(self) -> _Combinations:
        return _Combinations(self._rows, self.size)

    @cached_property
    def _slope_rows(self) -> list[dict[Exponents, float]]:
        """The coefficients of the derivatives, polynomial by polynomial."""
        places = range(self.size)
        return [
            {_divided(m, i): m[i] * c for m, c in row.items() if m[i]} for row in self._rows for i in places
        ]

    @cached_property
    def _slopes(self) -> _Combinations:
        return _Combinations(self._slope_rows, self.size)

    @cached_property
    def _values_and_slopes(self) -> _Combinations:
        return _Combinations([*self._rows, *self._slope_rows], self.size)

    def __call__(self, points: Floats) -> tuple[Floats, Floats]:
        """Values, (polynomials,) or (B, polynomials), and Jacobians, with a last axis of variables."""
        found = self._values_and_slopes.at(points)
        return found[..., : self.count], self._as_matrices(found[..., self.count :])

    def values(self, points: Floats) -> Floats:
        """The values alone."""
        return self._values.at(points)

    def jacobian(self, points: Floats) -> Floats:
        """The Jacobian matrices alone."""
        return self._as_matrices(self._slopes.at(points))

    def _as_matrices(self, slopes: Floats) -> Floats:
        return slopes.reshape(*slopes.shape[:-1], self.count, self.size)

    def magnitudes(self, points: Floats, sizes: Floats) -> Floats:
        """Sums of the absolute values of all terms, where no variable is taken for smaller than its size."""
        return self._values.absolute(np.maximum(np.abs(points), sizes))


@lru_cache(maxsize=64)
def _balanced(polynomials: Equations, ring: Ring, sizes: tuple[float, ...] | None) -> CompiledMap:
    """See `CompiledMap.balanced`; kept, as the same equations are compiled for each search of a point."""
    sizes = variable_sizes(ring, polynomials) if sizes is None else sizes
    scaled = [p / max(abs(c) for c in p.value.coeffs()) if p else p for p in polynomials]
    return CompiledMap(scaled, ring, sizes, [largest_term(p, sizes) or 1.0 for p in scaled])


class _Combinations:
    """Linear combinations of monomials of one table, by a full matrix where that is not much too large."""

    def __init__(self, rows: Sequence[Mapping[Exponents, float]], variables: int) -> None:
        self.count = len(rows)
        self._table = MonomialTable((m for row in rows for m in row), variables)
        self._places = np.array([self._table.index[m] for row in rows for m in row], dtype=np.intp)
        self._factors: Floats = np.array([c for row in rows for c in row.values()], dtype=np.float64)
        lengths = [len(row) for row in rows]
        # combinations that have terms, and where these begin
        self._filled = np.flatnonzero(lengths)
        self._starts = np.cumsum([0, *lengths], dtype=np.intp)[self._filled]
        self._matrix: Floats | None = None
        if self.count * len(self._table) <= _DENSE * len(self._places):
            self._matrix = np.zeros((self.count, len(self._table)))
            self._matrix[np.repeat(np.arange(self.count), lengths), self._places] = self._factors

    def at(self, points: Floats) -> Floats:
        """Their values at points."""
        return self._of(self._table.at(points.T), self._matrix, self._factors)

    def absolute(self, points: Floats) -> Floats:
        """The same with the absolute values of the coefficients."""
        matrix = None if self._matrix is None else np.abs(self._matrix)
        return self._of(self._table.at(points.T), matrix, np.abs(self._factors))

    def _of(self, monomials: Floats, matrix: Floats | None, factors: Floats) -> Floats:
        if matrix is not None:
            return np.ascontiguousarray((matrix @ monomials).T)
        found = np.zeros((*monomials.shape[1:], self.count))
        if self._places.size:
            terms = np.ascontiguousarray(monomials.T)[..., self._places] * factors
            found[..., self._filled] = np.add.reduceat(terms, self._starts, axis=-1)
        return found


def numerical_matrix(matrix: PolynomialMatrix, point: Floats) -> Floats:
    """A matrix of polynomials at a point given in the order of the ring's names."""
    entries = [e for row in matrix.rows for e in row]
    return CompiledMap(entries, matrix.ring).values(point).reshape(matrix.shape)


def _last_variable(monomial: Exponents) -> int:
    return max(i for i, e in enumerate(monomial) if e)


def _divided(monomial: Exponents, i: int) -> Exponents:
    return (*monomial[:i], monomial[i] - 1, *monomial[i + 1 :])
