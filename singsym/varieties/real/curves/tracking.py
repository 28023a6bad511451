"""Numerical tracking of many arcs of a curve at once; what it finds is proven by tubes.

Source: E. L. Allgower, K. Georg, Introduction to Numerical Continuation Methods, SIAM 2003, ch. 6
(predictor by tangent and curvature, corrector by Newton in the normal hyperplane).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from singsym.varieties.real.curves.arithmetic import Array, System

_NEWTON = 4
_PLACINGS = 4
"""Steps to the place on a cubic beside a mark."""


@dataclass(frozen=True, eq=False)
class Marks:
    """Points at which tracking starts and stops, with the unit tangents of the arcs that leave them.

    owner: for each half-edge its mark; directions: the tangent of each half-edge, away from the mark.
    """

    points: Array
    owner: np.ndarray
    directions: Array

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True, eq=False)
class Track:
    """A polyline from one half-edge to another, by their numbers."""

    start: int
    end: int
    points: Array


@np.errstate(all="ignore")
def newton(system: System, points: Array, normals: Array, steps: int = _NEWTON) -> tuple[Array, Array]:
    """Points moved onto the curve in the hyperplanes normal to `normals`, and how far they moved last."""
    moved = np.zeros(len(points))
    for _ in range(steps):
        correction = _solve(system, points, normals, system.values(points))
        points = points - correction
        moved = np.linalg.norm(correction, axis=1)
    return points, moved


def tangents(system: System, points: Array, along: Array) -> Array:
    """Unit tangents, on the side of `along`."""
    n = points.shape[1]
    jacobian = system.jacobian(points)
    if jacobian.shape[1] == n - 1:
        matrix = np.concatenate([jacobian, along[:, None, :]], axis=1)
        right = np.zeros((len(points), n, 1))
        right[:, -1] = 1
    else:
        matrix = np.swapaxes(jacobian, 1, 2) @ jacobian + along[:, :, None] * along[:, None, :]
        right = along[:, :, None]
    found = _safe_solve(matrix, right)[:, :, 0]
    return np.asarray(found / np.maximum(np.linalg.norm(found, axis=1, keepdims=True), 1e-300))


def kernels(system: System, points: Array) -> Array:
    """Unit tangents at smooth points, of no particular orientation: the last right singular vectors."""
    return np.asarray(np.linalg.svd(system.jacobian(points))[2][:, -1, :])


@np.errstate(all="ignore")
def track(
    system: System, marks: Marks, lanes: np.ndarray, *, bend: float = 0.3, steps: int = 6000
) -> list[Track]:
    """Track from these half-edges until another mark is reached; lanes that get nowhere are left out.

    bend: largest relative change of the Jacobian over one step, the measure that decides provability.
    """
    n = marks.points.shape[1]
    position = marks.points[marks.owner[lanes]]
    tangent = marks.directions[lanes]
    size = 1 + np.abs(marks.points).max(initial=0.0)
    step = np.full(len(lanes), 1e-2 * size)
    turn = np.zeros((len(lanes), n))
    paths: list[list[Array]] = [[p.copy()] for p in position]
    alive = np.arange(len(lanes))
    found: list[Track] = []
    for _ in range(steps):
        if not len(alive):
            break
        p, t, h = position[alive], tangent[alive], step[alive]
        guess = p + h[:, None] * t + 0.5 * (h**2)[:, None] * turn[alive]
        q, moved = newton(system, guess, t, 3)
        t_new = tangents(system, q, t)
        change = _change(system, p, q, t)
        cosine = (t * t_new).sum(axis=1)
        off = np.linalg.norm(q - guess, axis=1)
        good = (
            (moved < np.maximum(1e-9 * size, 1e-5 * h))
            & (change < bend)
            & (cosine > 0.8)
            & (off < 0.3 * h)
            & np.isfinite(off)
        )
        ratio = np.where(np.isfinite(change), 0.8 * bend / np.maximum(change, 1e-3 * bend), 0.0)
        step[alive] = h * np.where(good, np.clip(ratio, 0.5, 2.0), np.clip(ratio, 0.1, 0.5))
        reached = np.full(len(alive), -1)
        for k in np.flatnonzero(good):
            reached[k] = _arrival(marks, p[k], q[k], t[k], t_new[k])
        for k in np.flatnonzero(good):
            lane = alive[k]
            if reached[k] >= 0:
                paths[lane].append(marks.points[marks.owner[reached[k]]])
                found.append(Track(int(lanes[lane]), int(reached[k]), np.array(paths[lane])))
                continue
            paths[lane].append(q[k])
            turn[lane] = (t_new[k] - t[k]) / h[k]
            position[lane], tangent[lane] = q[k], t_new[k]
        alive = alive[(reached < 0) & (step[alive] > 1e-10 * size)]
    return found


def _change(system: System, p: Array, q: Array, t: Array) -> Array:
    """The change of the Jacobian from p to q relative to it, in the maximum norm."""
    before, after = system.jacobian(p), system.jacobian(q)
    n = p.shape[1]
    if before.shape[1] == n - 1:
        matrix = np.concatenate([before, t[:, None, :]], axis=1)
        right = np.concatenate([after - before, np.zeros((len(p), 1, n))], axis=1)
    else:
        matrix = np.swapaxes(before, 1, 2) @ before + t[:, :, None] * t[:, None, :]
        right = np.swapaxes(before, 1, 2) @ (after - before)
    return np.asarray(np.abs(_safe_solve(matrix, right)).sum(axis=2).max(axis=1))


def _arrival(marks: Marks, p: Array, q: Array, t: Array, t_new: Array) -> int:
    """The half-edge whose mark lies on the cubic from p to q with these tangents and faces it; or -1."""
    chord = q - p
    length = float(np.linalg.norm(chord))
    s = (marks.points - p) @ chord / length**2
    candidates = np.flatnonzero((s > 1e-9) & (s <= 1 + 1e-9))
    best, where = -1, 2.0
    for k in candidates:
        x, cubic = s[k], p
        # the place on the cubic that is as far along the chord as the mark
        for _ in range(_PLACINGS):
            cubic = (
                (1 + 2 * x) * (1 - x) ** 2 * p
                + x * (1 - x) ** 2 * length * t
                + x**2 * (3 - 2 * x) * q
                + x**2 * (x - 1) * length * t_new
            )
            x += s[k] - (cubic - p) @ chord / length**2
        if np.linalg.norm(cubic - marks.points[k]) < 2e-3 * length and x < where:
            facing = [j for j in np.flatnonzero(marks.owner == k) if marks.directions[j] @ chord < 0]
            if facing:
                best, where = int(facing[0]), float(x)
    return best


def _solve(system: System, points: Array, normals: Array, values: Array) -> Array:
    """The Newton correction orthogonal to `normals` (least squares where there are more equations)."""
    jacobian = system.jacobian(points)
    n = points.shape[1]
    if jacobian.shape[1] == n - 1:
        matrix = np.concatenate([jacobian, normals[:, None, :]], axis=1)
        right = np.concatenate([values, np.zeros((len(points), 1))], axis=1)[:, :, None]
    else:
        turned = np.swapaxes(jacobian, 1, 2)
        matrix = turned @ jacobian + normals[:, :, None] * normals[:, None, :]
        right = turned @ values[:, :, None]
    return _safe_solve(matrix, right)[:, :, 0]


def _safe_solve(matrix: Array, right: Array) -> Array:
    """Solutions of stacked square systems; where one is singular, least squares for all."""
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        finite = np.nan_to_num(matrix, nan=0.0, posinf=0.0, neginf=0.0)
        return np.asarray(np.linalg.pinv(finite) @ np.nan_to_num(right, nan=0.0, posinf=0.0, neginf=0.0))
