"""Newton's method for any number of equations: Gauss-Newton, damped or not.  It finds; it proves nothing.

Sources: Ortega, Rheinboldt, Iterative Solution of Nonlinear Equations in Several Variables (1970), ch. 8;
Yamashita, Fukushima, On the Rate of Convergence of the Levenberg-Marquardt Method (2001), for the damping;
Nocedal, Wright, Numerical Optimization (2006), chapter 10, for least squares.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from singsym.polynomials.compiled_map import CompiledMap, Floats


class Map(Protocol):
    """Values and Jacobian matrix at a point; `sizes` of the variables, against which steps are measured."""

    @property
    def sizes(self) -> Floats:
        """One for each variable."""

    def __call__(self, points: Floats) -> tuple[Floats, Floats]:
        """Values (equations,) and slopes (equations, variables) at a point, or at many: an axis ahead."""


# damping over the squared norm of the values, and its least over the squared norm of the slopes
_DAMPING, _LEAST_DAMPING = 1e-2, 1e-12
# after so many steps the squared norm of the values should be less than so many times what it was
_PATIENCE, _PROGRESS = 10, 0.9
# norms of the values: where steps end, and where a few more without damping are worth while
_REACHED, _NEAR = 1e-12, 1e-4
# of least squares: the damping at first, at least and at most, over the mean squared slope by a variable at
# the start, and steps that change nothing any more
_FIRST, _LEAST, _MOST, _ROUNDING = 1e-2, 1e-14, 1e8, 1e-15


class Restricted:
    """A map with some coordinates held: a map in the free ones.

    whole: a point with the values of all; free: the places of those that may move.
    """

    def __init__(self, system: Map, whole: Floats, free: Sequence[int]) -> None:
        self.system, self.whole, self.free = system, np.array(whole), list(free)
        self.sizes = system.sizes[self.free]

    def __call__(self, points: Floats) -> tuple[Floats, Floats]:
        """Values and slopes by the free coordinates, at values of these."""
        values, slopes = self.system(self.filled(points))
        return values, slopes[..., self.free]

    def filled(self, x: Floats) -> Floats:
        """The whole point with these values of the free coordinates, or one a row."""
        point = np.empty((*x.shape[:-1], self.whole.shape[-1]))
        point[...] = self.whole
        point[..., self.free] = x
        return point


def gauss_newton(
    system: Map,
    start: Floats,
    steps: int = 60,
    *,
    accuracy: float = 1e-9,
    cut: float = 1e-12,
    longest: float = 1.0,
) -> Floats | None:
    """A point where the system is zero to rounding, near `start`, or `None`.

    Steps are those of least norm in variables over their sizes, and so measured no longer than `longest`.
    accuracy: so large may values be at the end; cut: singular values of the slopes below so much of the
    largest count as zero.
    """
    x, sizes = np.array(start), system.sizes
    for _ in range(steps):
        value, slope = system(x)
        if not np.all(np.isfinite(value)):
            return None
        step = np.linalg.lstsq(slope * sizes, -value, rcond=cut)[0]
        length = float(np.linalg.norm(step))
        x = x + sizes * step / max(1.0, length / longest)
        if length < 1e-13 * (1 + float(np.linalg.norm(x / sizes))):
            break
    value, _ = system(x)
    return x if float(np.max(np.abs(value), initial=0.0)) < accuracy else None


def project(
    system: Map, point: Floats, free: Sequence[int], *, accuracy: float = 1e-12, cut: float = 1e-10
) -> Floats | None:
    """The end of Gauss-Newton from a point, moving the free coordinates only; None where it is no zero.

    Steps are as long as they come: from random points far away these lead to zeros more often.
    """
    restricted = Restricted(system, point, free)
    start = point[restricted.free]
    found = gauss_newton(restricted, start, accuracy=accuracy, cut=cut, longest=np.inf)
    return None if found is None else restricted.filled(found)


def approach(system: CompiledMap, starts: Floats, steps: int = 60) -> list[Floats]:
    """Points near zeros of the system from those starts, one a row, that come near any, in their order.

    All starts take their steps together, damped by the squared size of the values: near dependent equations
    this is as quick as elsewhere.  Those that are there, or get no further, take no more.
    """
    points = np.array(starts)
    values, slopes = system(points)
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
        values[moving], slopes[moving] = system(points[moving])
        sizes[moving] = np.sum(values[moving] ** 2, axis=1)
        moving = moving[sizes[moving] > _REACHED**2]
    return [x for x, size in zip(points, sizes, strict=True) if size < _NEAR**2]


def least_squares(system: Map, start: Floats, steps: int = 80) -> Floats:
    """Points near `start`, one or one a row, where the sum of squared values is least, if not zero.

    Damped steps, of which those that go up are not taken (Levenberg and Marquardt); all starts take theirs
    together, and the same ones whatever unit the values are in.
    """
    points, sizes = np.array(np.atleast_2d(start)), system.sizes
    values, slopes = system(points)
    scale = np.sum((slopes * sizes) ** 2, axis=(1, 2)) / max(1, len(sizes)) + np.finfo(float).tiny
    damping, moving = np.full(len(points), _FIRST), np.arange(len(points))
    for _ in range(steps):
        if not moving.size:
            break
        slope = slopes[moving] * sizes
        turned = slope.transpose(0, 2, 1)
        damped = damping[moving] * scale[moving]
        normal = turned @ slope + damped[:, None, None] * np.eye(len(sizes))
        step = np.linalg.solve(normal, turned @ values[moving, :, None])[..., 0]
        trial = points[moving] - sizes * step
        fresh, fresh_slopes = system(trial)
        lower = (fresh**2).sum(axis=1) <= (values[moving] ** 2).sum(axis=1)
        taken, left = moving[lower], moving[~lower]
        points[taken], values[taken], slopes[taken] = trial[lower], fresh[lower], fresh_slopes[lower]
        damping[taken] = np.maximum(damping[taken] / 8, _LEAST)
        damping[left] *= 6
        ended = np.where(lower, np.abs(step).max(axis=1, initial=0.0) < _ROUNDING, damping[moving] > _MOST)
        moving = moving[~ended]
    return points.reshape(start.shape)
