"""Enclosures of polynomial maps at many points or boxes at once, in balls that hold all rounding errors.

Source: S. M. Rump, Fast and parallel interval arithmetic, BIT 39 (1999) 534-554 (midpoint-radius matrices).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from singsym.effort.budget import Undecided
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.compiled_map import CompiledMap, MonomialTable

Array = NDArray[np.float64]

EPSILON = 2.0**-52
#: of the platform's long doubles: 2^-63 where the processor has them, else that of doubles
_LONG_EPSILON = float(np.finfo(np.longdouble).eps)
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


class EnclosedMap:
    """Polynomials of one ring, enclosed at many points or over many boxes at once; (B, variables) each."""

    def __init__(self, polynomials: Sequence[Polynomial], variables: int) -> None:
        tables = [
            {tuple(map(int, m)): Fraction(int(c.p), int(c.q)) for m, c in p.terms()} for p in polynomials
        ]
        self._monomials = MonomialTable((m for table in tables for m in table), variables)
        index = self._monomials.index
        self.coefficients: Array = np.zeros((len(index), len(tables)))
        self._precise = np.zeros(self.coefficients.shape, dtype=np.longdouble)
        for column, table in enumerate(tables):
            for monomial, c in table.items():
                self.coefficients[index[monomial], column] = high = _to_float(c)
                low = float(c - Fraction(high))
                self._precise[index[monomial], column] = np.longdouble(high) + np.longdouble(low)

    def precise(self, points: Array) -> Balls:
        """Enclosures of the values at points taken as exact, in long doubles where the platform has them."""
        table = np.ascontiguousarray(self._monomials.at(points.T, np.longdouble).T)
        mid = np.asarray(table @ self._precise, dtype=np.float64)
        size = np.asarray(np.abs(table) @ np.abs(self._precise), dtype=np.float64)
        terms = len(self.coefficients) + 4 * len(self._monomials.levels) + 8
        rad = (terms * _LONG_EPSILON * size + EPSILON * np.abs(mid)) * (1 + 16 * EPSILON) + TINY
        return Balls(mid, rad)

    def balls(self, points: Balls) -> Balls:
        """Enclosures of the values over boxes (B, variables): (B, polynomials)."""
        shape = (len(points.mid), len(self.coefficients))
        mid, rad = np.ones(shape), np.zeros(shape)
        for start, stop, parents, factors in self._monomials.levels:
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
    def map(self) -> EnclosedMap:
        """The equations, with enclosures."""
        return EnclosedMap(self.scaled, len(self.ring.names))

    @cached_property
    def _derivatives(self) -> EnclosedMap:
        gradients = [p.derivative(name) for p in self.scaled for name in self.ring.names]
        return EnclosedMap(gradients, len(self.ring.names))

    @cached_property
    def _in_doubles(self) -> CompiledMap:
        return CompiledMap(self.scaled, self.ring)

    @cached_property
    def _taylor(self) -> _Taylor:
        return _Taylor(self.scaled, len(self.ring.names))

    def values(self, points: Array) -> Array:
        """(B, equations)."""
        return self.map.precise(points).mid

    def jacobian(self, points: Array) -> Array:
        """(B, equations, variables)."""
        return self._in_doubles.jacobian(points)

    def jacobian_balls(self, points: Balls) -> Balls:
        """(B, equations, variables), over boxes."""
        r, n = len(self.scaled), len(self.ring.names)
        return self._derivatives.balls(points).reshape(len(points.mid), r, n)

    def hessian_balls(self, points: Balls) -> Balls:
        """(B, equations, variables * variables), over boxes."""
        r, n = len(self.scaled), len(self.ring.names)
        return self._taylor.hessian(points).reshape(len(points.mid), r, n * n)


class _Taylor:
    """The second derivatives over boxes by Taylor expansion at their centres, free of cancellation."""

    def __init__(self, equations: Sequence[Polynomial], variables: int) -> None:
        coefficients: list[Polynomial] = []
        entries: list[tuple[int, int, float]] = []
        terms: list[tuple[int, int, float, tuple[int, ...]]] = []
        for k, equation in enumerate(equations):
            for order, coefficient in _expansion(equation).items():
                for i, j in ((i, j) for i in range(variables) for j in range(variables)):
                    rest = list(order)
                    rest[i] -= 1
                    rest[j] -= 1
                    if min(rest) < 0:
                        continue
                    target = (k * variables + i) * variables + j
                    factor = float(order[i] * (order[j] - (i == j)))
                    if sum(rest):
                        terms.append((target, len(coefficients), factor, tuple(rest)))
                    else:
                        entries.append((target, len(coefficients), factor))
                coefficients.append(coefficient)
        self._size = len(equations) * variables**2
        self._map = EnclosedMap(coefficients, variables)
        self._constant = np.zeros((len(coefficients), self._size))
        for target, source, factor in entries:
            self._constant[source, target] = factor
        self._sources = np.array([t[1] for t in terms], dtype=int)
        self._factors = np.array([t[2] for t in terms])
        self._powers = np.array([t[3] for t in terms]).reshape(len(terms), variables)
        self._targets = np.zeros((len(terms), self._size))
        self._targets[np.arange(len(terms)), [t[0] for t in terms]] = 1

    def hessian(self, points: Balls) -> Balls:
        """All second derivatives over boxes, (B, equations * variables * variables)."""
        center = self._map.precise(points.mid)
        value = center.matmul(Balls.exact(self._constant))
        if not len(self._sources):
            return value
        size = center.magnitude()[:, self._sources] * self._factors
        for i in range(self._powers.shape[1]):
            highest = int(self._powers[:, i].max())
            powers = np.cumprod(np.repeat(points.rad[:, i : i + 1], highest, axis=1), axis=1)
            powers = np.concatenate([np.ones((len(powers), 1)), powers], axis=1)
            size = size * powers[:, self._powers[:, i]]
        spread = size @ self._targets * (1 + (len(self._sources) + 64) * 4 * EPSILON)
        return Balls(value.mid, value.rad + spread + TINY)


def _expansion(equation: Polynomial) -> dict[tuple[int, ...], Polynomial]:
    """The nonzero Taylor coefficients of order 2 and more, as polynomials in the centre."""
    ring = equation.ring
    zero = (0,) * len(ring.names)
    found: dict[tuple[int, ...], Polynomial] = {}
    layer = {zero: equation}
    while layer:
        following: dict[tuple[int, ...], Polynomial] = {}
        for order, coefficient in layer.items():
            for i, name in enumerate(ring.names):
                raised = (*order[:i], order[i] + 1, *order[i + 1 :])
                if raised not in following:
                    derivative = coefficient.derivative(name) / raised[i]
                    if derivative:
                        following[raised] = derivative
        found.update({o: c for o, c in following.items() if sum(o) > 1})
        layer = following
    return found


def _to_float(number: Fraction) -> float:
    value = float(number)
    if value and abs(value) < 1e-250:
        raise Undecided(f"coefficients differ by more than 250 orders of magnitude ({value:g} after scaling)")
    return value
