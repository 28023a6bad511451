"""The four defects of a configuration, from the velocities that its joints allow.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.2.  With K the joint rates that close all loops, without
idle spins, the kernels of L, L_I, L_O, L_p are K and its parts with inputs, outputs, both at rest; L has N +
n columns, L_I and L_O N, L_p N - n: so delta = dim K - n, and k_I, k_O, p are the dimensions of those parts.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from tests.laws.reference.bodies import Array, Model, Poses, velocities

TOLERANCE = 1e-5
"""Relative to the largest singular value; a configuration that is a double root is known to 1e-7 or so."""


class Defects(NamedTuple):
    """delta, p, k_I, k_O."""

    delta: int
    p: int
    k_I: int
    k_O: int

    @property
    def types(self) -> frozenset[str]:
        """The names of the singularity types, by their inequalities."""
        tests = {
            "RI": self.k_O > self.p,
            "RO": self.k_I > self.p,
            "RPM": self.p > 0,
            "II": self.k_I > self.delta,
            "IO": self.k_O > self.delta,
            "IIM": self.delta > 0,
        }
        return frozenset(name for name, holds in tests.items() if holds)


def kernel(M: Array, tolerance: float = TOLERANCE) -> Array:
    """An orthonormal basis of the vectors that M sends to 0, as columns."""
    _, values, rows = np.linalg.svd(M, full_matrices=True)
    values = np.concatenate([values, np.zeros(len(rows) - len(values))])
    return np.asarray(rows[values <= tolerance * max(1.0, values[0] if len(values) else 1.0)].T)


def clear(M: Array, tolerance: float = TOLERANCE) -> bool:
    """Whether no singular value is near the tolerance, so that the rank is clear."""
    values = np.linalg.svd(M, compute_uv=False)
    near = (values > tolerance / 30) & (values < tolerance * 300)
    return not near.any()


def motions(model: Model, poses: Poses, V: Array | None = None) -> tuple[Array, Array, Array]:
    """Of all velocities, or of V: what joints forbid (idle spins too), outputs and inputs show."""
    found = velocities(model, poses, V)
    return np.concatenate([found.C, found.idle], axis=-2), found.T, found.A


def defects(model: Model, poses: Poses) -> Defects | None:
    """At one configuration; None where a rank is not clear."""
    C, T, A = motions(model, poses)
    parts = [C, np.vstack([C, T, A]), np.vstack([C, A]), np.vstack([C, T])]
    if not all(map(clear, parts)):
        return None
    sizes = [kernel(M).shape[1] for M in parts]
    return Defects(sizes[0] - model.n, *sizes[1:])
