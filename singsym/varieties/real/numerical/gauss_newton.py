"""Numerical search for real solutions: Gauss-Newton from random starts.  It finds; it proves nothing.

Sources: Ortega, Rheinboldt, Iterative Solution of Nonlinear Equations in Several Variables (1970), ch. 8;
Yamashita, Fukushima, On the Rate of Convergence of the Levenberg-Marquardt Method (2001), for the damping.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Protocol

import numpy as np

from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.sizes import largest_term, variable_sizes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Vector = NDArray[np.float64]


class Map(Protocol):
    """Values and Jacobian matrix at a point; `sizes` of the variables, against which steps are measured."""

    sizes: Vector

    def __call__(self, x: Vector) -> tuple[Vector, Vector]: ...


# damping over the squared norm of the values, and its least over the squared norm of the slopes
_DAMPING, _LEAST_DAMPING = 1e-2, 1e-12
# after so many steps the squared norm of the values should be less than so many times what it was
_PATIENCE, _PROGRESS = 10, 0.9
# norms of the values: where steps end, and where a few more without damping are worth while
_REACHED, _NEAR = 1e-12, 1e-4


class Compiled:
    """Polynomials and their first derivatives as NumPy functions.

    sizes: how large the variables are, by default by `variable_sizes`.  Each polynomial is scaled so that its
    largest term is 1 where all variables have these sizes.
    """

    def __init__(
        self, polynomials: Sequence[Polynomial], ring: Ring, sizes: Sequence[float] | None = None
    ) -> None:
        names = ring.names
        sizes = variable_sizes(ring, polynomials) if sizes is None else sizes
        self.sizes: Vector = np.array(sizes, dtype=np.float64)
        self.size = len(names)
        self.count = len(polynomials)
        table: dict[tuple[int, ...], int] = {}
        rows: list[int] = []
        places: list[int] = []
        factors: list[float] = []
        for k, f in enumerate(polynomials):
            terms = [(tuple(map(int, m)), float(Fraction(int(c.p), int(c.q)))) for m, c in f.terms()]
            scale = largest_term(f, sizes) or 1.0
            for m, c in terms:
                rows.append(k)
                places.append(table.setdefault(m, len(table)))
                factors.append(c / scale)
                for i, e in enumerate(m):
                    if e:
                        rows.append(self.count + k * self.size + i)
                        places.append(table.setdefault((*m[:i], e - 1, *m[i + 1 :]), len(table)))
                        factors.append(e * c / scale)
        self.exponents = np.array(list(table), dtype=np.int64).reshape(len(table), self.size)
        self.rows = np.array(rows, dtype=np.int64)
        self.places = np.array(places, dtype=np.int64)
        self.factors = np.array(factors, dtype=np.float64)

    def __call__(self, x: Vector) -> tuple[Vector, Vector]:
        """Values and Jacobian matrix at a point."""
        values, slopes = self.at(x[np.newaxis])
        return values[0], slopes[0]

    def at(self, points: Vector) -> tuple[Vector, Vector]:
        """Values and Jacobian matrices at several points, one a row."""
        number = len(points)
        highest = int(self.exponents.max(initial=0))
        powers = np.ones((number, self.size, highest + 1))
        for e in range(1, highest + 1):
            powers[:, :, e] = powers[:, :, e - 1] * points
        monomials = np.prod(powers[:, np.arange(self.size), self.exponents], axis=2)
        products = self.factors * monomials[:, self.places]
        length = self.count * (1 + self.size)
        places = np.arange(number)[:, np.newaxis] * length + self.rows
        sums = np.bincount(places.ravel(), weights=products.ravel(), minlength=number * length)
        total = np.asarray(sums, dtype=np.float64).reshape(number, length)
        slopes = total[:, self.count :].reshape(number, self.count, self.size)
        return total[:, : self.count], slopes


def gauss_newton(system: Map, start: Vector, steps: int = 60) -> Vector | None:
    """A point where the system is zero to rounding, near `start`, or `None`.

    Steps are no longer than 1 in variables over their sizes.
    """
    x, sizes = np.array(start), system.sizes
    for _ in range(steps):
        value, slope = system(x)
        if not np.all(np.isfinite(value)):
            return None
        step = np.linalg.lstsq(slope * sizes, -value, rcond=1e-12)[0]
        length = float(np.linalg.norm(step))
        x = x + sizes * step / max(1.0, length)
        if length < 1e-13 * (1 + float(np.linalg.norm(x / sizes))):
            break
    value, _ = system(x)
    return x if float(np.max(np.abs(value), initial=0.0)) < 1e-9 else None


def approach(system: Compiled, starts: Vector, steps: int = 60) -> list[Vector]:
    """Points near zeros of the system from those starts, one a row, that come near any, in their order.

    All starts take their steps together, damped by the squared size of the values: near dependent equations
    this is as quick as elsewhere.  Those that are there, or get no further, take no more.
    """
    points = np.array(starts)
    values, slopes = system.at(points)
    sizes = np.sum(values * values, axis=1)
    before = np.full(len(points), np.inf)
    moving = np.flatnonzero(sizes > _REACHED**2)
    for step in range(steps):
        if step % _PATIENCE == 0:
            moving = moving[sizes[moving] < _PROGRESS * before[moving]]
            before = sizes.copy()
        if not moving.size:
            break
        value, slope = values[moving], slopes[moving] * system.sizes
        turned = slope.transpose(0, 2, 1)
        gram = slope @ turned
        damping = np.maximum(_DAMPING * sizes[moving], _LEAST_DAMPING * np.trace(gram, axis1=1, axis2=2))
        gram += (damping + np.finfo(float).tiny)[:, np.newaxis, np.newaxis] * np.eye(system.count)
        changes = (turned @ np.linalg.solve(gram, -value[:, :, np.newaxis]))[:, :, 0]
        lengths = np.linalg.norm(changes, axis=1, keepdims=True)
        points[moving] += system.sizes * changes / np.maximum(1.0, lengths)
        values[moving], slopes[moving] = system.at(points[moving])
        sizes[moving] = np.sum(values[moving] ** 2, axis=1)
        moving = moving[sizes[moving] > _REACHED**2]
    return [x for x, size in zip(points, sizes, strict=True) if size < _NEAR**2]


def dependent_columns(slope: Vector, rank: int, first: Sequence[int]) -> list[int]:
    """Columns that the others determine, by pivoted orthogonalisation, those in `first` before others."""
    work = np.array(slope, dtype=np.float64)
    least = 1e-9 * float(np.linalg.norm(work, axis=0).max(initial=0.0))
    chosen: list[int] = []
    for k in range(rank):
        norms = np.linalg.norm(work, axis=0)
        candidates = [j for j in first if j not in chosen and norms[j] > least] if k < len(first) else []
        j = candidates[0] if candidates else int(np.argmax(norms))
        chosen.append(j)
        length = float(norms[j])
        if length == 0:
            break
        direction = work[:, j] / length
        work = work - np.outer(direction, direction @ work)
        work[:, chosen] = 0
    return sorted(chosen)
