"""A motion followed with proof: pieces of time, over each a box that holds its one configuration.

Source: certified tracking, Beltran, Leykin, Certified numerical homotopy tracking, Experimental Mathematics
21 (2012) 69-83; here by the Krawczyk test, with steps that are halved, and boxes joined by uniqueness.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import arb, arb_mat

from singsym.kinematics.velocity import VelocityEquation
from singsym.motion.arithmetic import Arithmetic
from singsym.motion.drives import DrivenSystem
from singsym.motion.enclosures import BITS, Enclosure, Sheet, sure_sign
from singsym.motion.newton import Newton
from singsym.motion.trajectory import Trajectory
from singsym.polynomials import Polynomial
from singsym.polynomials.compiled_map import Floats
from singsym.varieties.real.points.intervals import Box, at_precision, evaluate, jacobian

_SHORTEST = 2.0**-24
"""A piece is not made shorter than so much of the whole time."""
_SHARE = 0.4871
"""Where a piece is cut in two: not in the middle, where a zero is more likely than elsewhere."""


@dataclass(frozen=True)
class MotionPiece:
    """A span of time, and where the one configuration of the motion is at each time of it.

    first, last: the same at its start and at its end.
    """

    start: float
    end: float
    whole: Enclosure
    first: Enclosure
    last: Enclosure

    @property
    def box(self) -> Box:
        """Balls that hold all configurations of the piece."""
        return self.whole.box


class Continuation:
    """One trajectory on the assembly mode of a configuration at its first row."""

    def __init__(self, equation: VelocityEquation, system: DrivenSystem, trajectory: Trajectory) -> None:
        self.system, self.trajectory = system, trajectory
        self.sheet = Sheet(equation, system)
        self.newton = Newton(system, Arithmetic())
        self.names = equation.space.ring.names
        self.count = len(self.names)
        self.shortest = _SHORTEST * float(trajectory.times[-1] - trajectory.times[0])

    def near(self, time: float, point: Floats) -> Floats:
        """The configuration at a time, numerically, from one near by."""
        return self.newton.onto(self.trajectory.at(np.array(time)), point)

    def box_at(self, start: float, end: float, near: Floats) -> Enclosure | None:
        """Where a sheet is over a span of time; near: the configuration in the middle, numerically."""
        if not np.isfinite(near).all():
            return None
        with at_precision(BITS):
            values, _ = self.trajectory.balls(start, end)
        return self.sheet.over(values, near)

    def pieces(self, point: Floats) -> Iterator[MotionPiece]:
        """Proven pieces one after the other from the first time on, as far as they can be had.

        point: the configuration there, numerically.  Lemma: the ball around the configuration at the end of a
        piece lies in the boxes of this piece and of the next; each holds one configuration for the values of
        that time, so that it is the same, and the motion goes on.
        """
        times = self.trajectory.times
        first = self.box_at(float(times[0]), float(times[0]), self.near(float(times[0]), point))
        if first is None:
            return
        for row in range(len(times) - 1):
            start, goal = float(times[row]), float(times[row + 1])
            step = goal - start
            while start < goal:
                end = goal if start + 1.5 * step >= goal else start + step
                piece = self.piece(start, end, first)
                if piece is not None:
                    yield piece
                    first, start, step = piece.last, end, 2 * (end - start)
                elif end - start < self.shortest:
                    return
                else:
                    step = (end - start) / 2

    def piece(self, start: float, end: float, first: Enclosure) -> MotionPiece | None:
        """The piece from a configuration known by balls; None where it is not proven."""
        point = self.middle(first)
        middle = self.near((start + end) / 2, point)
        box = self.box_at(start, end, middle)
        if box is None:
            return None
        last = self.box_at(end, end, self.near(end, middle))
        if last is None or not (box.has_configuration(first) and box.has_configuration(last)):
            return None
        return MotionPiece(start, end, box, first, last)

    def on_motion(
        self, pieces: Sequence[MotionPiece], start: float, end: float, near: Floats
    ) -> Enclosure | None:
        """Where the motion's configuration is at each time of a span, which may be in several pieces.

        near: about in its middle, numerically.  None where it is not proven to be on the sheet of `pieces`.
        """
        box = self.box_at(start, end, near)
        own = next((piece for piece in pieces if piece.start <= start <= piece.end), None)
        point = None if own is None else self.box_at(start, start, self.near(start, near))
        if box is None or own is None or point is None:
            return None
        return box if own.whole.has_configuration(point) and box.has_configuration(point) else None

    def middle(self, at: Enclosure) -> Floats:
        """The middle of a box, numerically."""
        return np.array([float(b.mid()) for b in at.box[: self.count]])

    def rates(self, piece: MotionPiece) -> list[arb] | None:
        """Balls around the rates of all variables over a piece; None where they are not bounded."""
        with at_precision(BITS):
            values, rates = self.trajectory.balls(piece.start, piece.end)
            given = []
            for drive in self.system.drives:
                value, rate = values[drive.label], rates[drive.label]
                given += [-value.sin() * rate, value.cos() * rate] if drive.is_angle else [rate]
            by_names, by_given = self._slopes
            slopes = arb_mat([[evaluate(e, piece.box) for e in row] for row in by_names])
            sides = arb_mat([[evaluate(e, piece.box) for e in row] for row in by_given])
            try:
                found = slopes.solve(sides * arb_mat([[g] for g in given]))
            except ZeroDivisionError:
                return None
            return [-found[k, 0] for k in range(len(self.names))]

    @cached_property
    def _slopes(self) -> tuple[list[list[Polynomial]], list[list[Polynomial]]]:
        given = [name for drive in self.system.drives for name in drive.names]
        return jacobian(self.sheet.equations, self.names), jacobian(self.sheet.equations, given)

    # -- zeros of a polynomial on the way ------------------------------------------------------------

    def zeros(
        self, piece: MotionPiece, polynomial: Polynomial, exact: float
    ) -> Iterator[tuple[float, float, bool]]:
        """Spans of time in which a polynomial vanishes on a piece: start, end, and whether it surely does.

        It vanishes once in a span that is sure, which is no longer than `exact` where signs can be told on
        the way; in the others that is not decided.  Nowhere else.
        """
        if sure_sign(polynomial, piece.whole):
            return
        if self._is_monotone(piece, polynomial):
            signs = [sure_sign(polynomial, at) for at in (piece.first, piece.last)]
            if signs[0] * signs[1] > 0:
                return
            if signs[0] * signs[1] < 0:
                yield (*self._bisected(piece, polynomial, signs[0], exact), True)
                return
        if piece.end - piece.start < max(exact, self.shortest):
            yield piece.start, piece.end, False
            return
        middle = piece.start + _SHARE * (piece.end - piece.start)
        one = self.piece(piece.start, middle, piece.first)
        two = None if one is None else self.piece(middle, piece.end, one.last)
        if one is None or two is None:
            yield piece.start, piece.end, False
            return
        yield from self.zeros(one, polynomial, exact)
        yield from self.zeros(two, polynomial, exact)

    def _is_monotone(self, piece: MotionPiece, polynomial: Polynomial) -> bool:
        rates = self.rates(piece)
        if rates is None:
            return False
        with at_precision(BITS):
            total = arb(0)
            names = polynomial.variables
            for name, slope in zip(names, jacobian((polynomial,), names)[0], strict=True):
                total += evaluate(slope, piece.box) * rates[polynomial.ring.index(name)]
            return bool(total > 0) or bool(total < 0)

    def _bisected(
        self, piece: MotionPiece, polynomial: Polynomial, sign: int, exact: float
    ) -> tuple[float, float]:
        """A span with the change of sign inside, `exact` long at most, or as short as signs can be told.

        sign: that of the polynomial at the start of the piece.
        """
        low, high, near = piece.start, piece.end, self.middle(piece.first)
        while high - low > exact:
            middle = low + _SHARE * (high - low)
            near = self.near(middle, near)
            box = self.box_at(middle, middle, near)
            on_it = box is not None and piece.whole.has_configuration(box)
            found = sure_sign(polynomial, box) if box is not None and on_it else 0
            if not found:
                break
            low, high = (middle, high) if found == sign else (low, middle)
        return low, high
