"""L in pure numbers: the same whatever the unit of length and the place of the frame."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from singsym.kinematics.scaling import scaled_matrix
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Mechanism, define


def slider_crank(unit: int, x: int, y: int) -> Mechanism:
    """Crank 1 and rod 3, in a unit and with the crank's pin at (x, y)."""
    return define(
        inputs=["A"],
        output={"rate": "S"},
        links={
            "ground": {"points": {"A": [x * unit, y * unit]}, "axes": {"u": [1, 0]}},
            "AB": unit,
            "BC": 3 * unit,
            "slider": {"points": {"C": [0, 0]}, "axes": {"u": [1, 0]}},
        },
        joints={
            "A": "R",
            "B": "R",
            "C": "R",
            "S": {"type": "P", "links": ["ground", "slider"], "at": ["A", "C"], "axis": "u"},
        },
    )


def singular_values(unit: int, x: int, y: int, angle: float) -> list[float]:
    equation = velocity_equation(slider_crank(unit, x, y))
    B = (math.cos(angle), math.sin(angle))
    C = (B[0] + math.sqrt(9 - B[1] ** 2), 0.0)
    known: dict[str, float] = {}
    for name, place in (("B", B), ("C", C)):
        for polynomial, value, shift in zip(equation.space.points[name], place, (x, y), strict=True):
            (variable,) = polynomial.variables or ("",)
            if variable:
                offset = float(str(polynomial.constant))
                known.setdefault(variable, (value + shift) * unit - offset)
    point = np.array([known[name] for name in equation.space.ring.names])
    found = scaled_matrix(equation, point)
    return [float(v) for part in found.submatrices().values() for v in np.linalg.svd(part, compute_uv=False)]


@pytest.mark.parametrize(("unit", "x", "y"), [(1000, 0, 0), (1, 500, -300), (1000, 7, 9)])
def test_neither_unit_nor_frame_matters(unit: int, x: int, y: int) -> None:
    plain: Any = singular_values(1, 0, 0, 0.7)
    assert singular_values(unit, x, y, 0.7) == pytest.approx(plain, rel=1e-9)
