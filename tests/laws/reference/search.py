"""Configurations by damped Gauss-Newton from many random starts; singular ones with the motion that shows it.

Source: Levenberg (1944), Marquardt (1963).  A singular configuration is looked for together with vectors V in
the kernel of a matrix M(q): C(q) = 0, M(q) V = 0, W V = 1 with random W, so that it is a regular solution
where the kernel is no larger than it must be.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from tests.laws.reference.bodies import Array, Model, Poses, moved, rotation, velocities
from tests.laws.reference.defects import motions

STEP = 1e-7
"""Of the differences that stand for derivatives of M(q) V: Gauss-Newton's steps are exact to that."""


def random_poses(model: Model, count: int, random: np.random.Generator) -> Poses:
    """Bodies anywhere within a few units, turned any way that they may; the ground at its place."""
    angles = random.uniform(-np.pi, np.pi, (count, len(model.bodies), 3))
    free = np.abs(model.basis).sum(axis=1) > 0
    angles[:, :, ~free[:3]] = 0
    places = 1.5 * random.normal(size=(count, len(model.bodies), 3))
    places[:, :, ~free[3:]] = 0
    angles[:, 0], places[:, 0] = 0, 0
    return Poses(rotation(angles), places)


@dataclass(frozen=True)
class Condition:
    """What makes a configuration singular: `size` independent motions with outputs, inputs at rest.

    also: further residues and derivatives, as functions of poses.
    """

    outputs: bool = False
    inputs: bool = False
    size: int = 0
    also: Callable[[Poses], tuple[Array, Array]] | None = None

    def matrix(self, model: Model, poses: Poses, V: Array | None = None) -> Array:
        """M(q), or M(q) V."""
        C, T, A = motions(model, poses, V)
        return np.concatenate([C, *([T] if self.outputs else []), *([A] if self.inputs else [])], axis=-2)


def conditions(model: Model) -> list[Condition]:
    """No condition, then k_O and k_I at least 1, ..., n, p at least 1, delta at least 1."""
    return [
        Condition(),
        *(Condition(outputs=True, size=size) for size in range(1, model.n + 1)),
        *(Condition(inputs=True, size=size) for size in range(1, model.n + 1)),
        Condition(outputs=True, inputs=True, size=1),
        Condition(size=model.n + 1),
    ]


@dataclass
class Batch:
    """Solutions under way: poses, and of each the vectors V (count, freedoms, size) with their form W."""

    poses: Poses
    V: Array
    W: Array

    def __getitem__(self, chosen: Array) -> Batch:
        return Batch(Poses(*(x[chosen] for x in self.poses)), self.V[chosen], self.W[chosen])


def start(model: Model, condition: Condition, poses: Poses, random: np.random.Generator) -> Batch:
    """Poses with the vectors that are nearest to a kernel of the condition's matrix."""
    count, size = len(poses.t), condition.size
    W = random.normal(size=(count, size, model.freedoms))
    if not size:
        return Batch(poses, np.zeros((count, model.freedoms, 0)), W)
    _, _, rows = np.linalg.svd(condition.matrix(model, poses), full_matrices=True)
    V = np.swapaxes(rows[:, -size:], 1, 2)
    return Batch(poses, V @ np.linalg.inv(W @ V), W)


def _equations(model: Model, condition: Condition, batch: Batch) -> tuple[Array, Array]:
    """Residues (count, m) and derivatives (count, m, freedoms + freedoms * size)."""
    found = velocities(model, batch.poses)
    count, freedoms, size = batch.V.shape
    values, rows = [found.r], [found.C]
    if condition.also is not None:
        more = condition.also(batch.poses)
        values, rows = [*values, more[0]], [*rows, more[1]]
    r, J = np.concatenate(values, axis=1), np.concatenate(rows, axis=1)
    if not size:
        return r, J
    M = condition.matrix(model, batch.poses)
    wide = Poses(batch.poses.R[:, None], batch.poses.t[:, None])
    shifts = np.broadcast_to(STEP * np.eye(freedoms), (count, freedoms, freedoms))
    product = M @ batch.V
    slopes = (condition.matrix(model, moved(model, wide, shifts), batch.V[:, None]) - product[:, None]) / STEP
    m = M.shape[1]
    MV = product.swapaxes(1, 2).reshape(count, -1)
    by_q = slopes.transpose(0, 3, 2, 1).reshape(count, size * m, freedoms)
    by_V = np.zeros((count, size, m, size, freedoms))
    form = (batch.W @ batch.V - np.eye(size)).swapaxes(1, 2).reshape(count, -1)
    form_by_V = np.zeros((count, size, size, size, freedoms))
    for k in range(size):
        by_V[:, k, :, k] = M
        form_by_V[:, k, :, k] = batch.W
    width = size * freedoms
    top = np.concatenate([J, np.zeros((count, J.shape[1], width))], axis=2)
    middle = np.concatenate([by_q, by_V.reshape(count, size * m, width)], axis=2)
    bottom = np.zeros((count, size * size, freedoms + width))
    bottom[:, :, freedoms:] = form_by_V.reshape(count, size * size, width)
    return np.concatenate([r, MV, form], axis=1), np.concatenate([top, middle, bottom], axis=1)


def solve(
    model: Model, condition: Condition, batch: Batch, steps: int = 45, accuracy: float = 1e-10
) -> tuple[Batch, Array]:
    """Improved solutions, and which of them are good; starts that fail just stay bad."""
    size = batch.V.shape[2]
    poses, V = Poses(*(x.copy() for x in batch.poses)), batch.V.copy()
    left = np.arange(len(V))
    for _ in range(steps):
        now = Batch(Poses(*(x[left] for x in poses)), V[left], batch.W[left])
        r, J = _equations(model, condition, now)
        norm = np.linalg.norm(r, axis=1)
        kept = norm > accuracy / 100
        left, r, J, now = left[kept], r[kept], J[kept], now[kept]
        if not len(left):
            break
        damping = np.minimum(1e-2, (r**2).sum(axis=1)) + 1e-13
        JT = J.swapaxes(1, 2)
        H = JT @ J + damping[:, None, None] * np.eye(J.shape[2])
        x = -np.linalg.solve(H, JT @ r[:, :, None])[:, :, 0]
        x *= np.minimum(1.0, 0.7 / np.maximum(np.abs(x[:, : model.freedoms]).max(axis=1), 1e-9))[:, None]
        now = _stepped(model, now, x)
        poses.R[left], poses.t[left], V[left] = now.poses.R, now.poses.t, now.V
    ended = Batch(poses, V, batch.W)
    r, _ = _equations(model, condition, ended)
    good = (np.linalg.norm(r, axis=1) < accuracy) & _proper(model, poses)
    if size:
        good &= np.abs(V).max(axis=(1, 2)) < 1e4
    return ended, good


def _stepped(model: Model, batch: Batch, x: Array) -> Batch:
    count, freedoms, size = batch.V.shape
    change = x[:, freedoms:].reshape(count, size, freedoms).swapaxes(1, 2)
    return Batch(moved(model, batch.poses, x[:, :freedoms]), batch.V + change, batch.W)


def _proper(model: Model, poses: Poses) -> Array:
    """Near enough for rounding to mean nothing, and not excluded."""
    good = np.abs(poses.t).max(axis=(1, 2)) < 50
    for a, b in model.excluded:
        good &= np.linalg.norm(place(model, poses, a) - place(model, poses, b), axis=1) > 1e-6
    return np.asarray(good)


def place(model: Model, poses: Poses, name: str) -> Array:
    """Where a named point is, of the first body that has it."""
    body = next(i for i, named in enumerate(model.points) if name in named)
    return np.asarray(poses.t[:, body] + poses.R[:, body] @ model.points[body][name])


def closed(model: Model, count: int, random: np.random.Generator) -> Poses:
    """Configurations from so many random starts."""
    anywhere = start(model, Condition(), random_poses(model, count, random), random)
    batch, good = solve(model, Condition(), anywhere)
    return batch[good].poses


def singular(model: Model, condition: Condition, poses: Poses, random: np.random.Generator) -> Batch:
    """Configurations that satisfy a condition, from others as starts."""
    batch, good = solve(model, condition, start(model, condition, poses, random))
    return batch[good]


def each(poses: Poses) -> Iterator[Poses]:
    for R, t in zip(*poses, strict=True):
        yield Poses(R, t)


def local_dimension(
    model: Model,
    condition: Condition,
    solution: Batch,
    random: np.random.Generator,
    same: Callable[[Poses], bool],
    step: float = 0.03,
) -> int:
    """In how many independent directions one can walk on the solutions from one of them (a batch of one).

    A tangent counts where a step along it, and one mixed with others, leads to a solution that is about as
    far along it and the same in kind.
    """
    _, J = _equations(model, condition, solution)
    _, values, rows = np.linalg.svd(J[0], full_matrices=True)
    tangents = rows[int((values > 1e-6 * values[0]).sum()) :].T
    left, sizes, right = np.linalg.svd(tangents[: model.freedoms], full_matrices=False)
    idle = velocities(model, solution.poses).idle[0]
    directions = [
        (left[:, k], tangents @ right[k] / sizes[k])
        for k in range(len(sizes))
        if sizes[k] > 1e-3 and np.abs(idle @ left[:, k]).max(initial=0) < 1e-3
    ]
    walked = 0
    for along, whole in directions:
        mixed = whole + 0.3 * sum(random.normal() * other for _, other in directions)
        walked += all(_leads_on(model, condition, solution, step * x, along, same) for x in (whole, mixed))
    return walked


def _leads_on(
    model: Model, condition: Condition, solution: Batch, x: Array, along: Array, same: Callable[[Poses], bool]
) -> bool:
    end, good = solve(model, condition, _stepped(model, solution, x[None]), 40)
    wanted = x[: model.freedoms] @ along
    gone = _difference(model, solution.poses, end.poses) @ along
    return (
        bool(good[0]) and abs(gone - wanted) < 0.3 * abs(wanted) and same(Poses(*(y[0] for y in end.poses)))
    )


def _difference(model: Model, one: Poses, two: Poses) -> Array:
    """The small velocity that leads from one to the other."""
    turn = two.R[0] @ one.R[0].swapaxes(1, 2)
    w = 0.5 * np.stack(
        [turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], axis=1
    )
    return np.asarray((np.concatenate([w, two.t[0] - one.t[0]], axis=1)[1:] @ model.basis).reshape(-1))
