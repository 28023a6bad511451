"""The space in which distances are measured: values of the inputs, or coordinates of the output.

Source: singsym's own; angles are measured round the circle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import arb

from singsym.classes.realisation.certified_configuration import joint_ball
from singsym.kinematics.placement import JointValue
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial
from singsym.polynomials.compiled_map import CompiledMap, Floats


@dataclass(frozen=True, eq=False)
class Coordinates:
    """Values by label, over their units: radians, and a length for those that are lengths."""

    equation: VelocityEquation
    labels: tuple[str, ...]
    values: tuple[JointValue, ...]
    units: tuple[float, ...]

    @cached_property
    def _parts(self) -> CompiledMap:
        parts: list[Polynomial] = []
        zero = self.equation.space.ring.zero
        for value in self.values:
            if value.cosine is not None and value.sine is not None:
                parts += [value.cosine, value.sine]
            else:
                parts += [_side(value) or zero, zero]
        return CompiledMap(parts, self.equation.space.ring)

    def at(self, point: Floats) -> tuple[Floats, Floats]:
        """The values at a configuration, and their slopes (labels, variables)."""
        parts, slopes = self._parts(point)
        found, rows = np.zeros(len(self.labels)), np.zeros((len(self.labels), len(point)))
        for k, value in enumerate(self.values):
            c, s = parts[2 * k : 2 * k + 2]
            of_c, of_s = slopes[2 * k : 2 * k + 2]
            if value.cosine is not None:
                found[k], rows[k] = np.arctan2(s, c), (c * of_s - s * of_c) / (c * c + s * s)
            elif value.square is not None:
                found[k] = np.sqrt(max(c, 0.0))
                rows[k] = of_c / (2 * found[k]) if found[k] else 0.0
            else:
                found[k], rows[k] = c, of_c
        units = np.array(self.units)
        return found / units, rows / units[:, None]

    def difference(self, one: Floats, other: Floats) -> Floats:
        """What leads from the other values to these, angles by the shorter way round."""
        change = one - other
        turns = np.array([value.cosine is not None for value in self.values])
        return np.where(turns, change - 2 * np.pi * np.round(change / (2 * np.pi)), change)

    def farthest(self, box: Sequence[arb], other: Floats) -> float:
        """A bound from above of the distance from these values to a point in balls; it may be infinite."""
        total = arb(0)
        for value, unit, there in zip(self.values, self.units, other.tolist(), strict=True):
            own = joint_ball(value, tuple(box))
            if own is None or not own.is_finite():
                return float("inf")
            change = own / arb(unit) - arb(there)
            if value.cosine is not None:
                turns = round(float(change.mid()) / (2 * np.pi))
                change -= 2 * turns * arb.pi()
            total += change.abs_upper() * change.abs_upper()
        return float(total.sqrt().upper())


def _side(value: JointValue) -> Polynomial | None:
    return value.square if value.length is None else value.length


def joint_space(equation: VelocityEquation, length: float) -> Coordinates | None:
    """The values of the inputs, lengths over `length`; None where the formulation does not tell them."""
    labels = tuple(c.label for c in equation.columns if c.role == "input")
    if not all(label in equation.values for label in labels):
        return None
    values = tuple(equation.values[label] for label in labels)
    units = tuple(1.0 if value.cosine is not None else length for value in values)
    return Coordinates(equation, labels, values, units)


def output_space(equation: VelocityEquation) -> Coordinates | None:
    """The coordinates and joint values whose rates are the output; None where it has rotations of a link."""
    values = tuple(value for _, value in equation.outputs if value is not None)
    if not values or len(values) < len(equation.outputs):
        return None
    return Coordinates(equation, tuple(label for label, _ in equation.outputs), values, (1.0,) * len(values))
