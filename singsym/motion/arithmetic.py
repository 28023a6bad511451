"""The two kinds of numbers that configurations are worked out in: doubles, and mpmath's of any precision.

Source: NumPy (https://numpy.org); F. Johansson and others, mpmath (https://mpmath.org).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Protocol

import mpmath
import numpy as np
import sympy
from numpy.typing import NDArray

from singsym.mechanism.expressions import expression
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.compiled_map import CompiledMap

Array = NDArray[Any]
"""Of floats, or of objects that are mpmath numbers; the last axis is that of the variables or values."""
Function = Callable[[Array], Array]


class Roots(Protocol):
    """What closed forms need beside sums, products and quotients."""

    def root(self, squares: Array) -> Array:
        """Square roots."""

    def solved(self, matrices: Array, sides: Array) -> Array:
        """x with A x = b."""


@dataclass(frozen=True)
class Arithmetic:
    """Arrays of doubles where `dps` is None, else of mpmath numbers with so many decimal digits."""

    dps: int | None = None

    @contextmanager
    def precision(self) -> Iterator[None]:
        """The precision of mpmath inside."""
        if self.dps is None:
            yield
            return
        with mpmath.workdps(self.dps):
            yield

    def array(self, values: Any) -> Array:
        """Numbers, or arrays of them, as an array of this kind."""
        if self.dps is None:
            return np.asarray(values, dtype=np.float64)
        given = np.asarray(values, dtype=object)
        with self.precision():
            return np.array([_number(x) for x in given.flat], dtype=object).reshape(given.shape)

    def compiled(self, polynomials: Sequence[Polynomial], ring: Ring) -> Function:
        """The polynomials as a function of points (..., variables); its values are (..., polynomials)."""
        if self.dps is None:
            values, count, size = CompiledMap(polynomials, ring).values, len(polynomials), len(ring.names)
            return lambda points: values(points.reshape(-1, size)).reshape(*points.shape[:-1], count)
        return lambda points: self._evaluated(polynomials, points)

    def _evaluated(self, polynomials: Sequence[Polynomial], points: Array) -> Array:
        found = np.full((*points.shape[:-1], len(polynomials)), mpmath.mpf(0), dtype=object)
        with self.precision():
            for k, p in enumerate(polynomials):
                found[..., k] = p.evaluate(list(np.moveaxis(points, -1, 0)))
        return found

    def root(self, squares: Array) -> Array:
        """Square roots; not a number of what is negative."""
        return self._each(_real_root, np.sqrt, squares)

    def cosine(self, angles: Array) -> Array:
        """Cosines of angles in radians."""
        return self._each(mpmath.cos, np.cos, angles)

    def sine(self, angles: Array) -> Array:
        """Sines of angles in radians."""
        return self._each(mpmath.sin, np.sin, angles)

    def angle(self, sines: Array, cosines: Array) -> Array:
        """The angles in radians, above -pi and up to pi, that have sines and cosines in this proportion."""
        return self._each(mpmath.atan2, np.arctan2, sines, cosines)

    def solved(self, matrices: Array, sides: Array) -> Array:
        """x with A x = b, for matrices (..., n, n) and sides (..., n); not numbers where A is singular."""
        if self.dps is None:
            regular = np.abs(np.linalg.det(matrices)) > 0
            safe = np.where(regular[..., None, None], matrices, np.eye(matrices.shape[-1]))
            return np.where(regular[..., None], np.linalg.solve(safe, sides[..., None])[..., 0], np.nan)
        found = np.empty(sides.shape, dtype=object)
        with self.precision():
            for place in np.ndindex(sides.shape[:-1]):
                found[place] = _lu_solved(matrices[place], sides[place])
        return found

    def _each(self, exact: Callable[..., Any], fast: Callable[..., Array], *arrays: Array) -> Array:
        if self.dps is None:
            with np.errstate(invalid="ignore"):
                return np.asarray(fast(*arrays))
        with self.precision():
            return np.asarray(np.frompyfunc(exact, len(arrays), 1)(*arrays), dtype=object)


def _number(value: Any) -> Any:
    """A number, or text such as "1/3", in the precision of `mpmath.mp`."""
    if isinstance(value, str | sympy.Expr):
        return mpmath.mpf(expression(value, place="values").evalf(mpmath.mp.dps + 5))
    return mpmath.mpf(value)


def _real_root(square: Any) -> Any:
    return mpmath.sqrt(square) if square >= 0 else mpmath.nan


def _lu_solved(matrix: Array, side: Array) -> list[Any]:
    try:
        return list(mpmath.lu_solve(mpmath.matrix(matrix.tolist()), mpmath.matrix(side.tolist())))
    except ZeroDivisionError:
        return [mpmath.nan] * len(side)
