"""Interval proofs about configurations: one sheet over a box of values, ranks, and points on a locus.

Source: Krawczyk, Computing 4 (1969) 187-201; Neumaier, Interval Methods for Systems of Equations (1990), 5.1.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
from flint import arb, arb_mat

from singsym.classes.taxonomy.types import Defects
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.velocity import VelocityEquation
from singsym.motion.drives import DrivenSystem
from singsym.motion.tilted_box import TiltedBox
from singsym.polynomials import Equations, Polynomial, PolynomialMatrix
from singsym.polynomials.compiled_map import CompiledMap, Floats
from singsym.polynomials.ring import AlgebraicConstant
from singsym.varieties.real.numerical.dependent_columns import dependent_columns
from singsym.varieties.real.points.boxed_point import BoxPoint, boxed_point
from singsym.varieties.real.points.finite_sets import pinned
from singsym.varieties.real.points.intervals import (
    Box,
    at_precision,
    ball,
    evaluate,
    jacobian,
    rank_at_least,
    sign_on_box,
)

BITS = 96
"""Of the balls."""
_TESTS = 8
"""So often a box is tried, each time wider than what the last test made of it."""
_WIDER = 1.3
_WIDEST = 10.0
"""Tests of boxes that have become wider than so much, over the size of the variables, lead nowhere."""
_LEAST = 1e-10
"""Of a box around a configuration in doubles, which may be ill-conditioned, over the size of its numbers."""


@dataclass(frozen=True)
class Enclosure:
    """Where a sheet is over some values: the only configuration in `room` for each of them lies in `along`.

    values: the middles of the given ones, the parameters of `along`; turning: which of them are angles.
    Coordinates are those of the driven system's ring, the variables first; room: wider balls for the last
    parameters of `along`, as many as variables.
    """

    values: Box
    turning: tuple[bool, ...]
    along: TiltedBox
    room: Box

    @property
    def box(self) -> Box:
        """Balls that hold all of it."""
        return self.along.hull

    def value(self, number: int) -> arb:
        """One of the given values, by its number: a ball that holds all of them."""
        return self.values[number] + self.along.spans[number]

    def has_values(self, point: Enclosure) -> bool:
        """Whether the values of another enclosure are among those of this one."""
        with at_precision(BITS):
            pairs = zip(self.along.spans, self._away(point), strict=False)
            return all(span.contains(away) for span, away in pairs)

    def has_configuration(self, point: Enclosure) -> bool:
        """Whether the configuration in another enclosure is on this sheet, by uniqueness.

        That the values there are among this one's is for the caller to know.
        """
        with at_precision(BITS):
            away, tilt, count = self._away(point), self.along.tilt, len(self.room)
            ahead = len(away)
            along = arb_mat([[tilt[i, j] for j in range(ahead)] for i in range(count)])
            frame = arb_mat([[tilt[i, ahead + j] for j in range(count)] for i in range(count)])
            moved = arb_mat([[point.box[i] - self.along.centre[i]] for i in range(count)])
            own = frame.solve(moved - along * arb_mat([[t] for t in away]))
            return all(room.contains(own[k, 0]) for k, room in enumerate(self.room))

    def _away(self, point: Enclosure) -> list[arb]:
        """What leads from the middles of the values to those of a point, angles by the shorter way round."""
        found = []
        rows = zip(point.values, point.along.spans, self.values, self.turning, strict=False)
        for there, span, here, turns in rows:
            away = there + span - here
            found.append(away - 2 * arb.pi() * round(float(away.mid()) / (2 * math.pi)) if turns else away)
        return found


class Sheet:
    """The configurations of a driven system near a numerical one, as functions of the given values."""

    def __init__(self, equation: VelocityEquation, system: DrivenSystem) -> None:
        self.system, self.ring = system, system.ring
        self.constants: Sequence[AlgebraicConstant] = equation.space.ring.constants
        self.names = equation.space.ring.names
        relations = map(self.ring.convert, equation.space.ring.relations)
        loops = dict.fromkeys((*system.loops, *relations))
        self.equations: Equations = (*loops, *(d.equation for d in system.drives))
        places = [self.ring.index(name) for name in self.names]
        given = [self.ring.index(name) for d in system.drives for name in d.names]
        self._map = CompiledMap(self.equations, self.ring)
        self._places, self._given = places, given

    @property
    def is_square(self) -> bool:
        """Whether there are as many equations as variables, so that a box can be proven to hold one sheet."""
        return len(self.equations) == len(self.names)

    def over(self, values: Mapping[str, arb], near: Floats) -> Enclosure | None:
        """Balls in which there is exactly one configuration for each choice of values.

        values: radians and lengths, as balls; near: the configuration over their middles, numerically.
        None where the Krawczyk test proves nothing.
        """
        with at_precision(BITS):
            given = [values[drive.label] for drive in self.system.drives]
            if not self.is_square or not all(value.is_finite() for value in given):
                return None
            start = self._start(given, near)
            if start is None:
                return None
            inverse, box = start
            size = 1 + float(np.abs(near).max(initial=0.0))
            least = arb(0, _LEAST * size)
            room = [least] * len(self.names)
            for _ in range(_TESTS):
                found = self._krawczyk(inverse, replace(box, spans=(*box.spans[: len(given)], *room)))
                if not all(x.abs_upper() < _WIDEST * size for x in found):
                    return None
                if all(r.contains_interior(x) for r, x in zip(room, found, strict=True)):
                    return self._enclosure(given, box, found, room)
                room = [arb(0, (_WIDER * x.abs_upper() + least.rad()).upper()) for x in found]
        return None

    def slopes(self, values: Mapping[str, arb], near: Floats) -> Floats | None:
        """The slopes by the given values at their middles, numerically: (variables, values)."""
        start = self._start([values[drive.label] for drive in self.system.drives], near)
        if start is None:
            return None
        tilt, ahead = start[1].tilt, range(len(self.system.drives))
        return np.array([[float(tilt[i, k]) for k in ahead] for i in range(len(near))])

    def _enclosure(
        self, given: Sequence[arb], box: TiltedBox, found: Sequence[arb], room: Sequence[arb]
    ) -> Enclosure | None:
        own = (arb(0, x.abs_upper().upper()) for x in found)
        along = replace(box, spans=(*box.spans[: len(given)], *own))
        middles = tuple(arb(value.mid()) for value in given)
        turning = tuple(drive.is_angle for drive in self.system.drives)
        return Enclosure(middles, turning, along, tuple(room)) if self._is_own(along.hull) else None

    def _start(self, given: Sequence[arb], near: Floats) -> tuple[arb_mat, TiltedBox] | None:
        """A box along the sheet without a width, and about the inverse of the slopes by its last parameters.

        Its parameters are the given values, then a move along each right singular vector of the slopes.
        """
        count = len(near)
        centre, rest, turns = [arb(x) for x in near.tolist()], [arb(0)] * count, []
        for drive, value in zip(self.system.drives, given, strict=True):
            middle, radius = arb(value.mid()), arb(value.rad())
            own, rates = [middle], [arb(1)]
            if drive.is_angle:
                own, rates = [middle.cos(), middle.sin()], [-middle.sin(), middle.cos()]
            turn = [float(rate.mid()) for rate in rates]
            bent = radius * radius / 2 if drive.is_angle else arb(0)
            centre += [arb(x.mid()) for x in own]
            for x, rate, rounded in zip(own, rates, turn, strict=True):
                rest.append(arb(0, (x.rad() + bent + radius * abs(rate - rounded)).upper()))
            turns.append(turn)
        slopes = self._map.jacobian(np.array([float(x) for x in centre]))
        square = slopes[:, self._places]
        if not np.isfinite(square).all() or numerical_rank(square, 1e-13).rank < count:
            return None
        left, sizes, right = np.linalg.svd(square)
        tilt = np.zeros((len(centre), len(given) + count))
        row = count
        for k, turn in enumerate(turns):
            tilt[row : row + len(turn), k] = turn
            row += len(turn)
        by_given = slopes[:, self._given] @ tilt[count:, : len(given)]
        tilt[:count] = np.hstack([-np.linalg.solve(square, by_given), right.T])
        spans = (*(arb(0, value.rad()) for value in given), *[arb(0)] * count)
        box = TiltedBox(tuple(centre), arb_mat(tilt.tolist()), spans, tuple(rest), len(given))
        return arb_mat((left / sizes).T.tolist()), box

    def _krawczyk(self, inverse: arb_mat, box: TiltedBox) -> list[arb]:
        """The Krawczyk operator for the last parameters of a box along the sheet, for all of the given ones.

        What it maps into its own interior holds one zero for each choice of these.
        """
        count, ahead = len(self.names), len(self.system.drives)
        flat = replace(box, spans=(*box.spans[:ahead], *[arb(0)] * count))
        shifts = flat.combined(inverse, [[flat.form(f)] for f in self.equations], arb_mat([[1]]))
        slopes = [[box.form(p) for p in row] for row in jacobian(self.equations, self.names)]
        frame = arb_mat([[box.tilt[i, ahead + j] for j in range(count)] for i in range(count)])
        near_one = box.combined(inverse, slopes, frame)
        moves = arb_mat([[span] for span in box.spans[ahead:]])
        defect = arb_mat([[int(i == j) - near_one[i, j] for j in range(count)] for i in range(count)])
        mapped = defect * moves - shifts
        return [mapped[i, 0] for i in range(count)]

    def _is_own(self, box: Box) -> bool:
        """Whether angles are the given ones, not half a turn away, and constants have their own values."""
        own = (box[self.ring.index(c.name)] for c in self.constants)
        pinned = all(ball(c.low) < b and b < ball(c.high) for c, b in zip(self.constants, own, strict=True))
        return pinned and all(evaluate(d.agreement, box) > 0 for d in self.system.drives)


def sure_sign(polynomial: Polynomial, where: Enclosure) -> int:
    """The sign of a polynomial on a whole enclosure, by derivatives too; 0 where that is open."""
    with at_precision(BITS):
        sign = sign_on_box(polynomial, where.box)
        if sign:
            return sign
        total = where.along.value(polynomial)
        return int(total > 0) - int(total < 0)


def is_surely_regular(
    equation: VelocityEquation, conditions: Mapping[str, Sequence[Polynomial] | None], where: Enclosure
) -> bool:
    """Whether L_I and L_O have full rank on a whole enclosure, so that no configuration in it is singular.

    conditions: the factors of (4) and (5); None where they are not written out: then by the ranks of blocks.
    """
    for label, name in (("4", "L_I"), ("5", "L_O")):
        factors = conditions[label]
        if factors is None:
            whole: PolynomialMatrix = getattr(equation, name)
            apart = equation.conditions.rank_blocks(name)
            is_sum = apart.constant + sum(min(block.shape) for block in apart.blocks) == equation.N
            blocks = apart.blocks if is_sum else (whole,)
            with at_precision(BITS):
                if not all(where.along.has_full_rank(block.rows) for block in blocks):
                    return False
        elif not all(sure_sign(p, where) for p in factors):
            return False
    return True


def certified_defects(
    equation: VelocityEquation, box: Sequence[arb], bounds: Mapping[str, int]
) -> Defects | None:
    """The defects at a point known by balls, where the ranks have these bounds from above; None if not shown.

    bounds: by how much the ranks of L, L_I, L_O and L_p are at least below full, 0 by default.
    Lemma: rank L_I and L_O fall with those of L and of L_p; minors that are nonzero on the balls bound the
    ranks from below.
    """
    least = {name: bounds.get(name, 0) for name in ("L", "L_I", "L_O", "L_p")}
    for name in ("L_I", "L_O"):
        least[name] = max(least[name], least["L"], least["L_p"])
    full = {"L": equation.N, "L_I": equation.N, "L_O": equation.N, "L_p": equation.N - equation.n}
    with at_precision(BITS):
        for name, defect in least.items():
            rows = [[evaluate(e, box) for e in row] for row in getattr(equation, name).rows]
            if not rank_at_least(rows, full[name] - defect):
                return None
    return Defects(least["L"], least["L_p"], least["L_I"], least["L_O"])


def point_on(equation: VelocityEquation, locus: Sequence[Polynomial], near: Floats) -> BoxPoint | None:
    """A certified configuration on a locus, next to a numerical one; None where the equations are too many.

    As many coordinates as stay free are held at the numerical values.
    """
    space = equation.space
    equations = tuple(dict.fromkeys((*space.equations, *space.ring.relations, *locus)))
    slopes = CompiledMap.balanced(equations, space.ring).jacobian(near)
    constants = [space.ring.index(c.name) for c in space.ring.constants]
    rank = numerical_rank(slopes, 1e-9).rank
    if rank < len(equations):
        return None
    dependent = dependent_columns(slopes, rank, constants)
    held = {name: Fraction(float(near[k])) for k, name in enumerate(space.ring.names) if k not in dependent}
    point = boxed_point(space.ring, equations, held, near.tolist())
    return point if point is not None and pinned(point, space.ring.constants) else None
