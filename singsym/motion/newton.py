"""Newton's method for many configurations at once, over given values.

Source: Gauss-Newton steps of least norm, Ortega, Rheinboldt, Iterative Solution of Nonlinear Equations in
Several Variables (1970), ch. 8.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from singsym.motion.arithmetic import Arithmetic, Array, Function
from singsym.motion.drives import DrivenSystem
from singsym.polynomials import Equations

_STEPS = 40
_CUT = 1e-9
"""Singular values of the slopes below so much of the largest count as zero."""
_ARRIVED = 1e-9


@dataclass(frozen=True, eq=False)
class Newton:
    """Steps onto the loop equations and the given values, which are met to rounding where they arrive.

    Slopes are taken in doubles, whatever the numbers are.
    """

    system: DrivenSystem
    numbers: Arithmetic

    @cached_property
    def _equations(self) -> Equations:
        return (*self.system.loops, *(e for d in self.system.drives for e in d.equations))

    @cached_property
    def _values(self) -> Function:
        return self.numbers.compiled(self._equations, self.system.ring)

    @cached_property
    def _slopes(self) -> Function:
        slopes = [p.derivative(n) for p in self._equations for n in self.system.unknowns]
        return Arithmetic().compiled(slopes, self.system.ring)

    def wide(self, values: Mapping[str, Array], points: Array) -> Array:
        """Points of the system's ring: the variables of `points`, then what stands for the given values."""
        parts = []
        for drive in self.system.drives:
            value = values[drive.label]
            parts += [self.numbers.cosine(value), self.numbers.sine(value)] if drive.is_angle else [value]
        return np.array(np.stack(np.broadcast_arrays(*np.moveaxis(points, -1, 0), *parts), axis=-1))

    def onto(self, values: Mapping[str, Array], start: Array) -> Array:
        """The configurations with these values that steps from `start` lead to; not numbers where none do."""
        count = start.shape[-1]
        places = [self.system.ring.index(name) for name in self.system.unknowns]
        points = self.wide(values, start)
        with self.numbers.precision(), np.errstate(all="ignore"):
            for _ in range(_STEPS):
                residual = self._values(points)
                matrix = self._slopes(points.astype(np.float64)).reshape(*residual.shape, len(places))
                finite = np.isfinite(matrix).all(axis=(-2, -1), keepdims=True)
                safe = np.where(finite, matrix, 0.0)
                step = (np.linalg.pinv(safe, rcond=_CUT) @ residual[..., None])[..., 0]
                points[..., places] = points[..., places] - step
                if not (np.abs(step.astype(np.float64)) > self._smallest).any():
                    break
            left = np.abs(self._values(points).astype(np.float64)).max(axis=-1, initial=0.0)
        arrived = np.asarray(left < _ARRIVED) & np.isfinite(points.astype(np.float64)).all(axis=-1)
        return np.where(np.expand_dims(arrived, -1), points[..., :count], float("nan"))

    @property
    def _smallest(self) -> float:
        """Steps that are not longer change nothing any more."""
        return 1e-14 if self.numbers.dps is None else float(10.0 ** (2 - min(self.numbers.dps, 300)))
