"""Proof that a smooth arc of a curve runs along a polyline: a box around each segment with one arc inside.

Source: R. Krawczyk, Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4 (1969)
187-201, with a parameter; overdetermined systems enter through the preconditioner.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from singsym.varieties.real.curves.arithmetic import EPSILON, TINY, Array, Balls, System

#: how far a tube goes on beyond both ends of its segment, in lengths of the segment
MARGIN = 1e-2
_ORTHOGONAL = 1e-12


@dataclass(frozen=True, eq=False)
class Tubes:
    """Boxes {center + s * step + frame y : |s| <= 1/2 + MARGIN, |y| <= radius}, one a row.

    Where `proven`, for every such s there is exactly one such y with Y f = 0, Y the preconditioner; it
    depends smoothly on s, and the Jacobian of f has full rank n-1 on the whole box.  The arc leaves the ends
    p, q of the segment by at most `error`, and its tangent from `step` by at most `slope`.
    """

    start: Array
    end: Array
    center: Array
    step: Array
    frame: Array
    radius: Array
    error: Array
    slope: Array
    proven: np.ndarray

    def __len__(self) -> int:
        return len(self.start)

    def take(self, rows: np.ndarray) -> Tubes:
        """Some of the tubes."""
        return Tubes(*(getattr(self, f.name)[rows] for f in fields(self)))

    def replace(self, rows: np.ndarray, new: Tubes) -> Tubes:
        """With other tubes in some rows."""
        columns = []
        for f in fields(self):
            column = getattr(self, f.name).copy()
            column[rows] = getattr(new, f.name)
            columns.append(column)
        return Tubes(*columns)

    def split(self, rows: np.ndarray) -> Tubes:
        """With two rows instead of each of these, their radius nan: to be proven."""
        twice = np.ones(len(self), dtype=int)
        twice[rows] = 2
        order = np.repeat(np.arange(len(self)), twice)
        result = self.take(order)
        result.radius[np.isin(order, rows)] = np.nan
        return result


@np.errstate(all="ignore")
def prove_tubes(system: System, start: Array, end: Array) -> Tubes:
    """Tubes around the segments from `start` to `end` (B, n), marked whether proven (nan proves nothing)."""
    n = start.shape[1]
    step, center = end - start, (start + end) / 2
    length = np.linalg.norm(step, axis=1)
    frame = frames(step)
    jacobian = system.jacobian(center)
    precondition = Balls.exact(inverses(jacobian @ frame))
    exact_frame, exact_step = Balls.exact(frame), Balls.exact(step[:, :, None])
    half = 0.5 + MARGIN
    at_jacobian = precondition.matmul(system.jacobian_balls(Balls.exact(center)))
    at_center = precondition.matmul(system.map.precise(center).reshape(len(start), -1, 1)).magnitude()
    spread = np.abs(step) * half
    radius = np.zeros(len(start))
    for _ in range(2):
        reach = (spread + np.abs(frame).sum(axis=2) * radius[:, None]) * (1 + 1e-12) + TINY
        slopes = _slopes(system, precondition, at_jacobian, Balls(center, reach), step, frame, radius)
        along = slopes.matmul(exact_step).magnitude()
        defect = (slopes.matmul(exact_frame) - Balls.exact(np.eye(n - 1)[None])).magnitude()
        contraction = defect.sum(axis=2).max(axis=1, initial=0.0) * (1 + n * EPSILON)
        move = (at_center + half * along).max(axis=(1, 2), initial=0.0) * (1 + 8 * EPSILON)
        proven = (contraction < 0.9) & (move + contraction * radius < radius * (1 - 1e-6))
        safe = np.maximum(1 - contraction, 0.05)
        if not radius.any():
            radius = 1.5 * move / safe + 1e-4 * length
    frame_norm = _orthogonality(step, frame, length)
    proven &= (frame_norm < _ORTHOGONAL) & np.isfinite(move) & (length > 0)
    slope = 1.01 * np.sqrt(n) * along.max(axis=(1, 2), initial=0.0) / safe
    size = 1 + np.maximum(np.abs(start), np.abs(end)).max(axis=1)
    error = np.maximum(*(_end_error(system, precondition, slopes, p, size, safe) for p in (start, end)))
    return Tubes(start, end, center, step, frame, radius, error, slope, proven)


def joined(before: Tubes, after: Tubes) -> np.ndarray:
    """Whether the arc in each tube of `before` goes on, forward, as the arc in the tube of `after` beside it.

    Lemma: the end of the first arc lies in the second box, where the arc is unique; the tangents of both at
    that point are parallel and have positive products with the second step.
    """
    length = np.linalg.norm(after.step, axis=1)
    near = before.error < 0.4 * np.minimum(MARGIN * length, after.radius)
    forward = (before.step * after.step).sum(axis=1) > 1.001 * before.slope * length + TINY
    same = (before.end == after.start).all(axis=1)
    return np.asarray(near & forward & same & before.proven & after.proven)


@np.errstate(all="ignore")
def location(tubes: Tubes, points: Balls) -> tuple[np.ndarray, np.ndarray]:
    """For each ball (G, n; `rad` a 2-norm bound in every entry) and tube: surely inside, surely outside."""
    offset = points.mid[:, None, :] - tubes.center[None]
    length = np.linalg.norm(tubes.step, axis=1)
    along = np.abs((offset * tubes.step[None]).sum(axis=2)) / length
    across = np.abs(np.einsum("gbi,bij->gbj", offset, tubes.frame)).max(axis=2, initial=0.0)
    slack = points.rad.max(axis=1)[:, None] * 1.001 + 10 * _ORTHOGONAL * np.linalg.norm(offset, axis=2) + TINY
    limit = (0.5 + MARGIN) * length
    inside = (along <= limit - slack) & (across <= tubes.radius - slack)
    outside = (along > limit + slack) | (across > tubes.radius + slack)
    return inside & tubes.proven, outside


def frames(directions: Array) -> Array:
    """Orthonormal complements (B, n, n-1) of directions (B, n), by Householder reflections."""
    n = directions.shape[1]
    unit = directions / np.maximum(np.linalg.norm(directions, axis=1, keepdims=True), TINY)
    sign = np.where(unit[:, :1] >= 0, 1.0, -1.0)
    mirror = unit.copy()
    mirror[:, :1] += sign
    scale = 2 / np.maximum((mirror**2).sum(axis=1), TINY)
    full = np.eye(n)[None] - scale[:, None, None] * mirror[:, :, None] * mirror[:, None, :]
    return np.asarray(full[:, :, 1:])


def _orthogonality(step: Array, frame: Array, length: Array) -> Array:
    """A bound of |Q^T Q - 1| for Q = [step / length, frame]."""
    n = step.shape[1]
    basis = np.concatenate([step[:, :, None] / np.maximum(length, TINY)[:, None, None], frame], axis=2)
    gram = Balls.exact(np.swapaxes(basis, 1, 2)).matmul(Balls.exact(basis)) - Balls.exact(np.eye(n)[None])
    return np.asarray(gram.magnitude().sum(axis=2).max(axis=1) * (1 + n * EPSILON) + 4 * EPSILON)


def _slopes(
    system: System,
    precondition: Balls,
    at_center: Balls,
    box: Balls,
    step: Array,
    frame: Array,
    radius: Array,
) -> Balls:
    """Y J over boxes in mean value form: Y J(center) + Y H(box) (s step + frame y), H the Hessians."""
    count, n = step.shape
    second = precondition.matmul(system.hessian_balls(box)).reshape(count, (n - 1) * n, n)
    basis = np.concatenate([step[:, :, None] * (0.5 + MARGIN), frame * radius[:, None, None]], axis=2)
    change = second.matmul(Balls.exact(basis)).magnitude().sum(axis=2).reshape(count, n - 1, n)
    return Balls(at_center.mid, (at_center.rad + change) * (1 + 4 * n * EPSILON) + TINY)


def inverses(matrices: Array) -> Array:
    """Inverses, or pseudo-inverses where the matrices are not square or one is singular."""
    if matrices.shape[1] == matrices.shape[2]:
        try:
            return np.asarray(np.linalg.inv(matrices), dtype=np.float64)
        except np.linalg.LinAlgError:
            pass
    return np.asarray(np.linalg.pinv(matrices), dtype=np.float64)


def _end_error(
    system: System, precondition: Balls, slopes: Balls, points: Array, size: Array, safe: Array
) -> Array:
    """How far the arc can be from a point at an end: |Y f| / (1 - contraction), as a 2-norm.

    The end of the segment and the point differ by rounding, which Y f at the point takes up by its slopes.
    """
    n = points.shape[1]
    rounding = 2 * EPSILON * size
    residual = precondition.matmul(system.map.precise(points).reshape(len(points), -1, 1)).magnitude()
    moved = residual[:, :, 0] + slopes.magnitude().sum(axis=2) * rounding[:, None] * 1.01
    return np.asarray(np.sqrt(n) * (1.01 * moved.max(axis=1, initial=0.0) / safe + 2 * rounding))
