"""Null motions at a singular configuration: what moves while inputs, outputs or both stand still.

Source: the six types of Zlatanov, Fenton, Benhabib (1998), section 2.2, as null spaces of L_O, L_I and L_p.
The sizes of the null spaces come from exact ranks; their vectors are numerical, for drawing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from singsym.classes.types import Defects
from singsym.kinematics.sampling import numerical_matrix
from singsym.kinematics.velocity import VelocityEquation

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Motion:
    """A motion with zero input (RO), zero output (RI) or both (RPM): velocities by column label."""

    kind: str
    velocities: Mapping[str, float]

    @property
    def words(self) -> str:
        """What stands still and what moves."""
        return {
            "RI": "redundant input: inputs move, the output stands still",
            "RO": "redundant output: the output moves, inputs stand still",
            "RPM": "redundant passive motion: passive joints move, inputs and output stand still",
        }[self.kind]

    @property
    def rates(self) -> str:
        """The velocities that are not zero, in proportion."""
        return ", ".join(
            f"{label} {value:.3g}" for label, value in self.velocities.items() if abs(value) > 1e-6
        )


def null_motions(equation: VelocityEquation, point: Floats, defects: Defects) -> tuple[Motion, ...]:
    """One motion for each of RI, RO, RPM that the configuration has, largest velocity 1.

    Each is orthogonal to those with still more at rest, so that an RI motion shows no passive one.
    """
    labels = [c.label for c in equation.columns]
    roles = [c.role for c in equation.columns]
    full = numerical_matrix(equation.matrix, point)

    def kernel(kept: list[int], size: int) -> Floats:
        """Orthonormal null vectors of the chosen columns, in all columns, as rows."""
        vectors = np.zeros((size, len(labels)))
        if size:
            # the last right singular vectors span the null space whose dimension is known exactly
            vectors[:, kept] = np.linalg.svd(full[:, kept], full_matrices=True)[2][len(kept) - size :]
        return vectors

    passive = [j for j, role in enumerate(roles) if role == "passive"]
    still_output = [j for j, role in enumerate(roles) if role != "output"]
    still_input = [j for j, role in enumerate(roles) if role != "input"]
    both = kernel(passive, defects.p)
    found = []
    for kind, kept, size in (("RI", still_output, defects.k_O), ("RO", still_input, defects.k_I)):
        if size > defects.p:
            vectors = kernel(kept, size)
            vectors = vectors - vectors @ both.T @ both
            found.append((kind, max(vectors, key=lambda v: float(np.abs(v).max()))))
    if defects.p:
        found.append(("RPM", both[0]))
    return tuple(Motion(kind, dict(zip(labels, _scaled(v), strict=True))) for kind, v in found)


def _scaled(vector: Floats) -> list[float]:
    """The largest entry made 1."""
    largest = vector[int(np.abs(vector).argmax())]
    return [0.0 if abs(x) < 1e-9 else float(x) for x in vector / largest]


def impossible(equation: VelocityEquation, point: Floats, defects: Defects, role: str) -> str:
    """A linear relation that all feasible velocities of the inputs (II) or outputs (IO) obey; "" without one.

    role: "input" or "output".  A velocity that violates it is impossible.
    """
    full = numerical_matrix(equation.matrix, point)
    size = equation.n + defects.delta
    motions = np.linalg.svd(full, full_matrices=True)[2][len(equation.columns) - size :]
    kept = [j for j, c in enumerate(equation.columns) if c.role == role]
    values, vectors = np.linalg.svd(motions[:, kept], full_matrices=True)[1:]
    lost = (defects.k_I if role == "input" else defects.k_O) - defects.delta
    if lost <= 0 or len(values) == 0:
        return ""
    terms = [
        f"{_coefficient(x)}{equation.columns[j].label}"
        for x, j in zip(_scaled(vectors[-1]), kept, strict=True)
        if abs(x) > 1e-6
    ]
    return " ".join(terms).removeprefix("+ ") + " = 0"


def _coefficient(x: float) -> str:
    """A sign and a factor, 1 left out."""
    size = "" if abs(abs(x) - 1) < 1e-9 else f"{abs(x):.3g} "
    return f"{'−' if x < 0 else '+'} {size}"
