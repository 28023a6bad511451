"""A motion of the inputs between two configurations, proven to meet neither a singularity nor a limit.

Source: certified continuation as in `singsym.motion.continuation`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import arb

from singsym.motion.arithmetic import Arithmetic
from singsym.motion.continuation import Continuation, MotionPiece
from singsym.motion.coordinates import Coordinates
from singsym.motion.drives import DrivenSystem, driven_system
from singsym.motion.enclosures import BITS, Enclosure, Sheet
from singsym.motion.newton import Newton
from singsym.motion.numeric import NumericLinkage, numeric_equation
from singsym.motion.regions.borders import Borders
from singsym.motion.trajectory import Trajectory
from singsym.polynomials.compiled_map import Floats
from singsym.varieties.real.points.intervals import at_precision

OUTSIDE = "not proven to be regular and within limits: on a border, beyond one, or too near"
_GIVEN = 1e-9
"""How well a configuration is given: the inputs' values, in radians or lengths over their unit."""


@dataclass(frozen=True, eq=False)
class Place:
    """A regular configuration within limits, proven.

    point: about where it is; inputs: the values of the inputs there, by label.
    near: where its sheet is while the inputs' values are within 1e-9 of these; no border is there.
    """

    point: Floats
    inputs: dict[str, float]
    near: Enclosure


class FreeMotions:
    """Motions of one mechanism that stay inside its regions."""

    def __init__(self, borders: Borders, space: Coordinates) -> None:
        self.borders, self.space = borders, space
        self.system: DrivenSystem = driven_system(
            borders.equation, space.labels, dict(zip(space.labels, space.values, strict=True))
        )
        self.sheet = Sheet(borders.equation, self.system)

    @cached_property
    def _newton(self) -> Newton:
        return Newton(self.system, Arithmetic())

    @cached_property
    def _linkage(self) -> NumericLinkage:
        return numeric_equation(self.borders.equation)

    def onto(self, inputs: Floats, near: Floats) -> Floats:
        """The configuration over values of the inputs, over their units, that Newton's method reaches."""
        values = (inputs * np.array(self.space.units)).tolist()
        given = {label: np.array(x) for label, x in zip(self.space.labels, values, strict=True)}
        return self._newton.onto(given, near)

    def named(self, point: Floats) -> tuple[dict[str, float], dict[str, float]]:
        """The values of the variables and of the joints in a configuration, by name."""
        joints = {label: float(value) for label, value in self._linkage.joints(point).items()}
        return dict(zip(self._linkage.names, point.tolist(), strict=True)), joints

    def place(self, point: Floats) -> Place | None:
        """A configuration known in doubles; None where it is not proven to be inside a region."""
        near = self.near(point)
        if near is None or not self.borders.are_off(near):
            return None
        values = self.space.at(point)[0] * np.array(self.space.units)
        return Place(point, dict(zip(self.space.labels, values.tolist(), strict=True)), near)

    def near(self, point: Floats) -> Enclosure | None:
        """Where the sheet of a configuration is while the inputs keep within 1e-9 of its values."""
        values, units = self.space.at(point)[0], np.array(self.space.units)
        with at_precision(BITS):
            rows = zip(self.space.labels, (values * units).tolist(), units.tolist(), strict=True)
            wide = {label: arb(x, _GIVEN * unit) for label, x, unit in rows}
        return self.sheet.over(wide, point)

    def joins(self, path: Trajectory, one: Place, other: Place) -> int:
        """The number of boxes that prove a motion from one place to the other inside a region; 0 if none do.

        Lemma: over a box of values there is one sheet, which is connected and on which no border is; the
        sheets of two boxes are joined where a configuration of one is in the other, by uniqueness.
        """
        way = Continuation(self.borders.equation, self.system, path)
        boxes, first, last = 0, None, None
        for piece in way.pieces(one.point):
            found = self._free(way, piece)
            if not found:
                return 0
            boxes += found
            first, last = first or piece.first, piece
        if first is None or last is None or last.end != path.times[-1]:
            return 0
        ends = ((one.near, first), (other.near, last.last))
        return boxes if all(near.has_values(end) and near.has_configuration(end) for near, end in ends) else 0

    def _free(self, way: Continuation, piece: MotionPiece) -> int:
        """In how many boxes a piece is free of borders; 0 where that is not proven."""
        if self.borders.are_off(piece.whole):
            return 1
        if piece.end - piece.start < way.shortest:
            return 0
        middle = (piece.start + piece.end) / 2
        one = way.piece(piece.start, middle, piece.first)
        two = None if one is None else way.piece(middle, piece.end, one.last)
        if one is None or two is None:
            return 0
        found = self._free(way, one)
        more = self._free(way, two) if found else 0
        return found + more if more else 0

    def along(self, rows: Floats) -> Trajectory:
        """The motion through values of the inputs, (rows, inputs), angles by the shorter way from row to row.

        Rows are numbers over their units, as in `space.at`.
        """
        values = (rows * np.array(self.space.units)).T
        own = dict(zip(self.space.labels, values, strict=True))
        turning = [d.label for d in self.system.drives if d.is_angle]
        return Trajectory.of(own).unwrapped(turning)
