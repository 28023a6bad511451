"""A classification against the reference: what contradicts it.

Source: the definitions; see `reference`.  Numerics find and never conclude, so what they did not find is no
fault.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.laws.reference.bodies import Array, Model, Poses, at_point
from tests.laws.reference.defects import defects
from tests.laws.reference.model import model as reference_model
from tests.laws.reference.search import (
    Batch,
    Condition,
    closed,
    conditions,
    each,
    local_dimension,
    random_poses,
    singular,
    solve,
    start,
)

NEAR = 1e-4
"""How near, in units of the mechanism, configurations are taken for the same: double roots are rough."""
Types = frozenset[str]


@dataclass
class Seen:
    """What was found of one class: the configurations as marks, and the largest dimension walked in."""

    marks: list[Array] = field(default_factory=list)
    dimension: int = 0


def search(model: Model, random: np.random.Generator, starts: int, walks: int = 2) -> dict[Types, Seen]:
    """The classes found from so many starts for each condition; those with unclear ranks are left."""
    seen: dict[Types, Seen] = defaultdict(Seen)
    begin = closed(model, starts, random)
    for condition in conditions(model) if len(begin.t) else []:
        walked: dict[Types, int] = defaultdict(int)
        batch = singular(model, condition, begin, random)
        for k, poses in enumerate(each(batch.poses)):
            here = defects(model, poses)
            if here is None:
                continue
            known = seen[here.types]
            mark = marks(model, poses)
            if all(np.abs(mark - other).max() > NEAR for other in known.marks):
                known.marks.append(mark)
                if walked[here.types] < walks:
                    walked[here.types] += 1
                    known.dimension = max(known.dimension, walk(model, condition, batch, k, random))
    return seen


def walk(model: Model, condition: Condition, batch: Batch, k: int, random: np.random.Generator) -> int:
    """The local dimension of the class at the k-th solution."""
    (poses,) = each(batch[np.array([k])].poses)
    here = defects(model, poses)

    def same(there: Poses) -> bool:
        other = defects(model, there)
        return here is not None and other is not None and other.types == here.types

    return local_dimension(model, condition, batch[np.array([k])], random, same)


def marks(model: Model, poses: Poses) -> Array:
    """What tells configurations apart: the points and axes at the joints, without idle spins."""
    idle = {body for body, _ in model.idle}
    parts = [np.zeros(3)]
    for k in model.pairs:
        parts.append(poses.t[k.i] + poses.R[k.i] @ k.p)
        if k.i not in idle and k.kind != "S":
            parts.append(poses.R[k.i] @ k.u)
    return np.concatenate(parts)


def placed(
    model: Model, points: dict[str, Array], directions: dict[str, Array], random: np.random.Generator
) -> Poses | None:
    """The configuration with named points and axes where they are said to be; None if none is found."""
    where = [(i, x, points[n] / model.unit) for n in points for i, x in _bearers(model.points, n)]
    along = [(i, x, directions[n]) for n in directions for i, x in _bearers(model.axes, n)]

    def also(poses: Poses) -> tuple[Array, Array]:
        values, rows = [], []
        for bodies, turning in ((where, False), (along, True)):
            for i, x, wanted in bodies:
                r, J = at_point(model, poses, i, x, turning=turning)
                values.append(r - wanted)
                rows.append(J)
        if not values:
            return np.zeros((len(poses.t), 0)), np.zeros((len(poses.t), 0, model.freedoms))
        return np.concatenate(values, axis=1), np.concatenate(rows, axis=1)

    condition = Condition(also=also)
    for _ in range(6):
        begin = start(model, condition, random_poses(model, 30, random), random)
        batch, good = solve(model, condition, begin, 80, accuracy=1e-8)
        if good.any():
            return next(each(batch[good].poses))
    return None


def _bearers(named: tuple[dict[str, Array], ...], name: str) -> list[tuple[int, Array]]:
    """The only body with a point or axis of this name; of several, none: joints hold the others."""
    return [(i, here[name]) for i, here in enumerate(named) if name in here][:1]


def disagreements(result: Any, seed: int, starts: int = 200) -> list[str]:
    """What a classification says that the reference contradicts."""
    model = reference_model(result.mechanism)
    random = np.random.default_rng(seed)
    seen = search(model, random, starts)
    wrong: list[str] = []
    for c in result.classes:
        kinds = frozenset(c.types.names)
        wrong += [
            f"{', '.join(c.types.names)}: {fault}"
            for fault in _faults(model, c, seen.get(kinds), result, random)
        ]
    return wrong


def _faults(model: Model, c: Any, seen: Seen | None, result: Any, random: np.random.Generator) -> list[str]:
    wrong = []
    if c.verdict.is_no:
        return (
            [f"said to be empty, found at {seen.marks[0].round(6).tolist()}"] if seen and seen.marks else []
        )
    if c.dimension is not None and seen and seen.dimension > c.dimension:
        wrong.append(f"dimension {c.dimension}, walked in {seen.dimension} directions")
    known = []
    for w in c.witnesses:
        poses = placed(model, *_places(result.equation.space, w), random)
        if poses is None:
            wrong.append(f"no configuration is at the witness {dict(w.points) or dict(w.coordinates)}")
            continue
        here = defects(model, poses)
        if here is not None and here.types != frozenset(c.types.names):
            wrong.append(f"the witness {dict(w.points) or dict(w.coordinates)} has {here}")
        known.append(marks(model, poses))
    if c.dimension == 0 and c.points is not None and not wrong:
        wrong += _counts(c, seen, known)
    return wrong


def _counts(c: Any, seen: Seen | None, known: list[Array]) -> list[str]:
    """As many points as are said, and every one found among them."""
    wrong = []
    if len(known) != c.points:
        wrong.append(f"{c.points} points, {len(known)} witnesses")
    if any(np.abs(a - b).max() < NEAR for i, a in enumerate(known) for b in known[:i]):
        wrong.append("two witnesses are the same configuration")
    for mark in seen.marks if seen else []:
        if all(np.abs(mark - other).max() > 10 * NEAR for other in known):
            wrong.append(f"found besides its {c.points} points: {mark.round(6).tolist()}")
    return wrong


def _places(space: Any, witness: Any) -> tuple[dict[str, Array], dict[str, Array]]:
    """Points and axes of a witness as floats."""
    at = [float(witness.coordinates.get(name, 0)) for name in space.ring.names]

    def vector(polynomials: Any) -> Array:
        found = [float(p.evaluate(at)) for p in polynomials]
        return np.array(found + [0.0] * (3 - len(found)))

    points = {name: vector(p) for name, p in space.points.items()}
    raw = {name: vector(p) for name, p in space.directions.items()}
    return points, {name: v / np.linalg.norm(v) for name, v in raw.items() if np.linalg.norm(v) > 1e-9}
