"""Newton's method for many configurations at once, over given values.

Source: Gauss-Newton steps of least norm, Ortega, Rheinboldt, Iterative Solution of Nonlinear Equations in
Several Variables (1970), ch. 8.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from singsym.motion.arithmetic import Arithmetic, Array
from singsym.motion.drives import DrivenSystem

_STEPS = 40
_CUT = 1e-9
"""Singular values of the slopes below so much of the largest count as zero."""
_ARRIVED = 1e-9


def wide_points(
    system: DrivenSystem, values: Mapping[str, Array], points: Array, numbers: Arithmetic
) -> Array:
    """Points of the system's ring: the variables of `points`, then what stands for the given values."""
    parts = []
    for drive in system.drives:
        value = values[drive.label]
        parts += [numbers.cosine(value), numbers.sine(value)] if drive.is_angle else [value]
    variables = np.moveaxis(points, -1, 0)
    return np.array(np.stack(np.broadcast_arrays(*variables, *parts), axis=-1))


def brought_onto(
    system: DrivenSystem, values: Mapping[str, Array], start: Array, numbers: Arithmetic
) -> Array:
    """The configurations with these values that steps from `start` lead to; not numbers where they do not.

    Loop equations and values are met to rounding; slopes are taken in doubles, whatever the numbers are.
    """
    equations = (*system.loops, *(e for d in system.drives for e in d.equations))
    ring, count = system.ring, start.shape[-1]
    places = [ring.index(name) for name in system.unknowns]
    slopes = Arithmetic().compiled([p.derivative(n) for p in equations for n in system.unknowns], ring)
    function = numbers.compiled(equations, ring)
    points = wide_points(system, values, start, numbers)
    with numbers.precision(), np.errstate(all="ignore"):
        for _ in range(_STEPS):
            residual = function(points)
            matrix = slopes(points.astype(np.float64)).reshape(*residual.shape, len(places))
            safe = np.where(np.isfinite(matrix).all(axis=(-2, -1))[..., None, None], matrix, 0.0)
            step = (np.linalg.pinv(safe, rcond=_CUT) @ residual[..., None])[..., 0]
            points[..., places] = points[..., places] - step
            if not (np.abs(step.astype(np.float64)) > _smallest(numbers)).any():
                break
        left = np.abs(function(points).astype(np.float64)).max(axis=-1, initial=0.0)
    arrived = (left < _ARRIVED) & np.isfinite(points.astype(np.float64)).all(axis=-1)
    return np.where(arrived[..., None], points[..., :count], float("nan"))


def _smallest(numbers: Arithmetic) -> float:
    """Steps that are not longer change nothing any more."""
    return 1e-14 if numbers.dps is None else float(10.0 ** (2 - min(numbers.dps, 300)))
