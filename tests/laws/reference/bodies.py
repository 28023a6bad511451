"""Rigid bodies with joints between them: residues of the joints and their rates of change.

Source: J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), ch. 3.

Poses are arrays R (..., bodies, 3, 3), t (..., bodies, 3): planar and spherical mechanisms are spatial ones
whose bodies may only turn about z and move in the plane, or only turn.  All functions work on many poses.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

Array = np.ndarray[Any, Any]
BASES = {
    "planar": [[0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0]],
    "spherical": np.eye(6)[:3],
    "spatial": np.eye(6),
}


class Poses(NamedTuple):
    """Where bodies are: rotations and origins."""

    R: Array
    t: Array


@dataclass(frozen=True)
class Pair:
    """A joint between bodies i and j, with points and axes in their frames; `turned`, for P: R_j in R_i."""

    name: str
    kind: str
    i: int
    j: int
    p: Array
    q: Array
    u: Array
    v: Array
    turned: Array


@dataclass(frozen=True)
class Output:
    """A linear function of velocities: components of a body's twist at a point of it, or rates of joints."""

    body: int
    point: Array
    rows: tuple[int, ...]
    rates: tuple[str, ...] = ()


@dataclass(frozen=True)
class Model:
    """A mechanism in units of its own size; body 0 is the ground.

    points, axes: of each body, in its frame; excluded: points of bodies that must not coincide.
    idle: bodies that hang by spherical joints at both ends of a line, with its direction; their spins about
        it count for nothing.
    """

    space: str
    bodies: tuple[str, ...]
    points: tuple[dict[str, Array], ...]
    axes: tuple[dict[str, Array], ...]
    pairs: tuple[Pair, ...]
    inputs: tuple[str, ...]
    outputs: tuple[Output, ...]
    idle: tuple[tuple[int, Array], ...]
    excluded: tuple[tuple[str, str], ...]
    unit: float
    columns: tuple[str, ...]
    n: int

    @cached_property
    def basis(self) -> Array:
        """The velocities (angular, then linear) that a body may have, as columns."""
        return np.asarray(BASES[self.space], float).T

    @property
    def freedoms(self) -> int:
        return self.basis.shape[1] * (len(self.bodies) - 1)


class Velocities(NamedTuple):
    """At poses: residues r, their derivatives C by all bodies' velocities, and linear functions of these."""

    r: Array
    C: Array
    rates: Array
    T: Array
    A: Array
    idle: Array


def skew(x: Array) -> Array:
    out = np.zeros((*x.shape, 3))
    out[..., 0, 1], out[..., 0, 2], out[..., 1, 2] = -x[..., 2], x[..., 1], -x[..., 0]
    return out - np.swapaxes(out, -1, -2)


def cross(a: Array, b: Array) -> Array:
    """Along the last axis; `numpy.cross` does the same in three times the time."""
    x, y, z = (a[..., i] * b[..., j] - a[..., j] * b[..., i] for i, j in ((1, 2), (2, 0), (0, 1)))
    return np.stack([x, y, z], axis=-1)


def rotation(w: Array) -> Array:
    """The rotation by a vector (Rodrigues)."""
    angle = np.linalg.norm(w, axis=-1)[..., None, None]
    S = skew(w)
    return np.eye(3) + np.sinc(angle / np.pi) * S + 0.5 * np.sinc(angle / 2 / np.pi) ** 2 * (S @ S)


def moved(model: Model, poses: Poses, x: Array) -> Poses:
    """The bodies turned and moved by velocities x (..., freedoms) for a unit of time."""
    steps = x.reshape(*x.shape[:-1], -1, model.basis.shape[1]) @ model.basis.T
    steps = np.concatenate([np.zeros((*steps.shape[:-2], 1, 6)), steps], axis=-2)
    return Poses(rotation(steps[..., :3]) @ poses.R, poses.t + steps[..., 3:])


def across(u: Array) -> tuple[Array, Array]:
    """Two unit vectors at right angles to u and to each other."""
    helper = np.where(np.abs(u[..., :1]) < 0.6, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    e = cross(u, helper)
    e /= np.linalg.norm(e, axis=-1, keepdims=True)
    return e, cross(u, e)


class _Bodies:
    """Points, directions and their velocities at poses, for velocities V (..., freedoms, k) of all bodies."""

    def __init__(self, model: Model, poses: Poses, V: Array | None = None) -> None:
        self.model, self.poses = model, poses
        self.shape = poses.t.shape[:-2]
        V = np.eye(model.freedoms) if V is None else V
        self.count = V.shape[-1]
        self.twists = V.reshape(*V.shape[:-2], -1, model.basis.shape[1], self.count)

    def at(self, body: int, point: Array) -> Array:
        return self.poses.t[..., body, :] + self.poses.R[..., body, :, :] @ point

    def along(self, body: int, axis: Array) -> Array:
        return np.asarray(self.poses.R[..., body, :, :] @ axis)

    def turning(self, body: int) -> Array:
        """The angular velocity of a body, (..., 3, k)."""
        if not body:
            return np.zeros((*self.shape, 3, self.count))
        own = self.model.basis[:3] @ self.twists[..., body - 1, :, :]
        return np.broadcast_to(own, (*self.shape, 3, self.count))

    def moving(self, body: int, place: Array) -> Array:
        """The velocity of a body's point that is at a place."""
        if not body:
            return np.zeros((*self.shape, 3, self.count))
        own = self.model.basis[3:] - skew(place - self.poses.t[..., body, :]) @ self.model.basis[:3]
        return np.asarray(own @ self.twists[..., body - 1, :, :])


def at_point(model: Model, poses: Poses, body: int, x: Array, *, turning: bool) -> tuple[Array, Array]:
    """A body's point, or direction, in the fixed frame, with its derivative."""
    b = _Bodies(model, poses)
    if turning:
        u = b.along(body, x)
        return u, -skew(u) @ b.turning(body)
    P = b.at(body, x)
    return P, b.moving(body, P)


def dot(e: Array, M: Array) -> Array:
    """A row: the component along e of what M gives."""
    return np.asarray(e[..., None, :] @ M)


def _joint(b: _Bodies, k: Pair) -> tuple[list[Array], list[Array], list[Array]]:
    """Residues (..., m), their derivatives (..., m, k), and the rates, likewise."""
    P, Q = b.at(k.i, k.p), b.at(k.j, k.q)
    u, v = b.along(k.i, k.u), b.along(k.j, k.v)
    gap = Q - P
    spin = b.turning(k.j) - b.turning(k.i)
    slip = b.moving(k.j, Q) - b.moving(k.i, P)
    drift = slip + skew(gap) @ b.turning(k.i)
    e, f = across(u)

    def component(*directions: Array) -> tuple[list[Array], list[Array]]:
        values = [np.einsum("...a,...a->...", d, gap)[..., None] for d in directions]
        return values, [dot(d, drift) for d in directions]

    together = v - u, skew(u) @ b.turning(k.i) - skew(v) @ b.turning(k.j)
    if k.kind == "R":
        return [gap, together[0]], [slip, together[1]], [dot(u, spin)]
    if k.kind == "S":
        return [gap], [slip], [spin]
    if k.kind == "U":
        right = np.einsum("...a,...a->...", u, v)[..., None]
        return [gap, right], [slip, dot(cross(v, u), spin)], [dot(u, spin), dot(v, spin)]
    values, rows = component(e, f)
    if k.kind == "C":
        return [together[0], *values], [together[1], *rows], [dot(u, spin), dot(u, drift)]
    if k.kind == "P":
        wanted, here = b.poses.R[..., k.i, :, :] @ k.turned, b.poses.R[..., k.j, :, :]
        for x, y in ((wanted[..., c], here[..., c]) for c in range(3)):
            values.append(y - x)
            rows.append(skew(x) @ b.turning(k.i) - skew(y) @ b.turning(k.j))
        return values, rows, [dot(u, drift)]
    raise NotImplementedError(f"joint {k.kind}")


def velocities(model: Model, poses: Poses, V: Array | None = None) -> Velocities:
    """What the joints ask of poses and of velocities; the linear functions of V, where it is given."""
    b = _Bodies(model, poses, V)
    residues: list[Array] = []
    rows: list[Array] = []
    rates: list[Array] = []
    for pair in model.pairs:
        found = _joint(b, pair)
        residues, rows, rates = residues + found[0], rows + found[1], rates + found[2]
    zero = np.zeros((*b.shape, 0, b.count))
    omega = np.concatenate([zero, *rates], axis=-2)
    out = [zero]
    for output in model.outputs:
        if output.rates:
            out.append(omega[..., [model.columns.index(c) for c in output.rates], :])
        else:
            place = b.at(output.body, output.point)
            twist = np.concatenate([b.turning(output.body), b.moving(output.body, place)], axis=-2)
            out.append(twist[..., list(output.rows), :])
    idle = [zero, *(dot(b.along(body, d), b.turning(body)) for body, d in model.idle)]
    return Velocities(
        np.concatenate(residues, axis=-1),
        np.concatenate(rows, axis=-2),
        omega,
        np.concatenate(out, axis=-2),
        omega[..., [model.columns.index(c) for c in model.inputs], :],
        np.concatenate(idle, axis=-2),
    )
