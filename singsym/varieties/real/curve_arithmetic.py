"""Vectorised evaluation of polynomial maps, in doubles and in balls that enclose all rounding errors.

Source: S. M. Rump, Fast and parallel interval arithmetic, BIT 39 (1999) 534-554 (midpoint-radius matrices).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from singsym.polynomials import Polynomial, Ring

Array = NDArray[np.float64]

EPSILON = 2.0**-52
TINY = 1e-290


@dataclass(frozen=True, eq=False)
class Balls:
    """An array of intervals `mid` +- `rad` (entrywise); operations enclose the exact results.

    >>> Balls(np.array([[2.0]]), np.array([[0.5]])).matmul(Balls.exact(np.array([[3.0]]))).magnitude() >= 7.5
    array([[ True]])
    """

    mid: Array
    rad: Array

    @classmethod
    def exact(cls, values: Array) -> Balls:
        """Doubles taken as exact numbers."""
        return cls(values, np.zeros_like(values))

    def magnitude(self) -> Array:
        """An upper bound of the absolute values."""
        return (np.abs(self.mid) + self.rad) * (1 + 4 * EPSILON)

    def matmul(self, other: Balls) -> Balls:
        """The (stacked) matrix product."""
        size = self.mid.shape[-1]
        a, b = np.abs(self.mid), np.abs(other.mid)
        rad = a @ (other.rad + (size + 4) * EPSILON * b) + self.rad @ (b + other.rad)
        return Balls(self.mid @ other.mid, rad * (1 + (2 * size + 16) * EPSILON) + TINY)

    def __add__(self, other: Balls) -> Balls:
        mid = self.mid + other.mid
        rad = self.rad + other.rad + EPSILON * np.abs(mid)
        return Balls(mid, rad * (1 + 8 * EPSILON) + TINY)

    def __neg__(self) -> Balls:
        return Balls(-self.mid, self.rad)

    def __sub__(self, other: Balls) -> Balls:
        return self + (-other)

    def reshape(self, *shape: int) -> Balls:
        """The same balls in another shape."""
        return Balls(self.mid.reshape(shape), self.rad.reshape(shape))

    def transpose(self) -> Balls:
        """The last two axes exchanged."""
        return Balls(np.swapaxes(self.mid, -1, -2), np.swapaxes(self.rad, -1, -2))


class PolynomialMap:
    """Polynomials of one ring, evaluated at many points at once through a shared table of monomials."""

    def __init__(self, polynomials: Sequence[Polynomial], variables: int) -> None:
        tables = [{m: Fraction(int(c.p), int(c.q)) for m, c in p.terms()} for p in polynomials]
        monomials = _closed_under_division({m for table in tables for m in table}, variables)
        index = {m: k for k, m in enumerate(monomials)}
        self.coefficients: Array = np.zeros((len(monomials), len(tables)))
        for column, table in enumerate(tables):
            for monomial, c in table.items():
                self.coefficients[index[monomial], column] = _to_float(c)
        self._levels = []
        start = 1
        while start < len(monomials):
            degree = sum(monomials[start])
            stop = start
            while stop < len(monomials) and sum(monomials[stop]) == degree:
                stop += 1
            parents, factors = [], []
            for m in monomials[start:stop]:
                i = _last_variable(m)
                parents.append(index[_divided(m, i)])
                factors.append(i)
            self._levels.append((start, stop, np.array(parents), np.array(factors)))
            start = stop

    def values(self, points: Array) -> Array:
        """Values at points (B, variables) in double arithmetic: (B, polynomials)."""
        table = np.ones((len(points), len(self.coefficients)))
        for start, stop, parents, factors in self._levels:
            table[:, start:stop] = table[:, parents] * points[:, factors]
        return table @ self.coefficients

    def balls(self, points: Balls) -> Balls:
        """Enclosures of the values over boxes (B, variables): (B, polynomials)."""
        shape = (len(points.mid), len(self.coefficients))
        mid, rad = np.ones(shape), np.zeros(shape)
        for start, stop, parents, factors in self._levels:
            a, b, s = mid[:, parents], points.mid[:, factors], points.rad[:, factors]
            r = rad[:, parents]
            product = a * b
            bound = np.abs(a) * s + r * (np.abs(b) + s) + EPSILON * np.abs(product)
            mid[:, start:stop] = product
            rad[:, start:stop] = bound * (1 + 16 * EPSILON) + TINY
        # the conversion of coefficients to doubles is within the EPSILON terms of `matmul`
        return Balls(mid, rad).matmul(Balls.exact(self.coefficients))


@dataclass(frozen=True, eq=False)
class System:
    """Polynomials, scaled to coefficients of size 1, with their derivatives as numerical maps."""

    ring: Ring
    equations: tuple[Polynomial, ...]

    @property
    def shape(self) -> tuple[int, int]:
        """Number of equations and of variables."""
        return len(self.equations), len(self.ring.names)

    @cached_property
    def scaled(self) -> tuple[Polynomial, ...]:
        """The equations divided by their largest coefficient."""
        return tuple(p / max(abs(c) for _, c in p.terms()) for p in self.equations if p)

    @cached_property
    def map(self) -> PolynomialMap:
        return PolynomialMap(self.scaled, len(self.ring.names))

    @cached_property
    def _gradients(self) -> list[Polynomial]:
        return [p.derivative(name) for p in self.scaled for name in self.ring.names]

    @cached_property
    def derivative_map(self) -> PolynomialMap:
        return PolynomialMap(self._gradients, len(self.ring.names))

    @cached_property
    def second_map(self) -> PolynomialMap:
        second = [g.derivative(name) for g in self._gradients for name in self.ring.names]
        return PolynomialMap(second, len(self.ring.names))

    def values(self, points: Array) -> Array:
        """(B, equations)."""
        return self.map.values(points)

    def jacobian(self, points: Array) -> Array:
        """(B, equations, variables)."""
        r, n = len(self.scaled), len(self.ring.names)
        return self.derivative_map.values(points).reshape(len(points), r, n)

    def jacobian_balls(self, points: Balls) -> Balls:
        """(B, equations, variables), over boxes."""
        r, n = len(self.scaled), len(self.ring.names)
        return self.derivative_map.balls(points).reshape(len(points.mid), r, n)

    def hessian_balls(self, points: Balls) -> Balls:
        """(B, equations, variables * variables), over boxes."""
        r, n = len(self.scaled), len(self.ring.names)
        return self.second_map.balls(points).reshape(len(points.mid), r, n * n)


def _to_float(number: Fraction) -> float:
    value = float(number)
    if value and abs(value) < 1e-250:
        raise OverflowError(
            f"coefficients differ by more than 250 orders of magnitude ({value:g} after scaling)"
        )
    return value


def _last_variable(monomial: tuple[int, ...]) -> int:
    return max(i for i, e in enumerate(monomial) if e)


def _divided(monomial: tuple[int, ...], i: int) -> tuple[int, ...]:
    return (*monomial[:i], monomial[i] - 1, *monomial[i + 1 :])


def _closed_under_division(monomials: set[tuple[int, ...]], variables: int) -> list[tuple[int, ...]]:
    """All prefixes of the monomials, by degree, the monomial 1 first."""
    closed = {(0,) * variables}
    for m in monomials:
        while m not in closed:
            closed.add(m)
            m = _divided(m, _last_variable(m))
    return sorted(closed, key=lambda m: (sum(m), m))
