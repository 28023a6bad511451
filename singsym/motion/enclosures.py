"""Interval proofs about configurations: one sheet over a box of values, ranks, and points on a locus.

Source: Krawczyk, Computing 4 (1969) 187-201; Neumaier, Interval Methods for Systems of Equations (1990), 5.1.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from flint import arb

from singsym.classes.configuration.locate import sizes_of_coordinates
from singsym.classes.taxonomy.types import Defects
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.velocity import VelocityEquation
from singsym.motion.drives import DrivenSystem
from singsym.polynomials import Equations, Polynomial
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
    krawczyk,
    rank_at_least,
    sign_on_box,
)

BITS = 96
"""Of the balls."""
_WIDER = (1.2, 2.0, 4.0)
"""How many times as wide as the slopes say a box is tried."""
_BEND = 2.0
"""And how many times the square of its width, over the sizes of its variables, is added (measured)."""
_LEAST = 1e-10
"""Of a box around a configuration in doubles, which may be ill-conditioned, over the size of its numbers."""


@dataclass(frozen=True)
class Enclosure:
    """Where a sheet is over some values: the only configuration in `room` for each of them lies in `box`.

    Both are balls in the order of the driven system's ring; the box is the narrower one.
    """

    room: Box
    box: Box

    def has(self, point: Enclosure, count: int) -> bool:
        """Whether a point of the sheet is one of another enclosure over one of its values, by uniqueness.

        count: of the variables, which come first.
        """
        return all(a.contains(b) for a, b in zip(self.room[:count], point.box[:count], strict=True))


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
        self._sizes = sizes_of_coordinates(equation)

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
            given = self._balls(values)
            if given is None or not self.is_square:
                return None
            middle = np.array([*near.tolist(), *(float(b.mid()) for b in given)])
            slopes = self._map.jacobian(middle)
            square = slopes[:, self._places]
            if not np.isfinite(square).all() or numerical_rank(square, 1e-13).rank < len(self.names):
                return None
            change = np.abs(np.linalg.solve(square, slopes[:, self._given]))
            widths = change @ np.array([float(b.rad()) for b in given])
            middles = near.tolist()
            box = [*map(arb, middles), *given]
            # what is quadratic counts where a coordinate is at an end of its range
            bend = _BEND * float((widths / self._sizes).max(initial=0.0)) ** 2 * self._sizes
            least = _LEAST * (1 + np.abs(near))
            for wider in _WIDER:
                wide = wider * widths + wider**2 * bend + least
                radii = dict(zip(self.names, map(Fraction, wide.tolist()), strict=True))
                found = krawczyk(self.equations, self.names, box, radii)
                if found is not None:
                    room = [arb(x, ball(r).upper()) for x, r in zip(middles, radii.values(), strict=True)]
                    return Enclosure((*room, *given), found) if self._is_own(found) else None
        return None

    def _balls(self, values: Mapping[str, arb]) -> list[arb] | None:
        found = []
        for drive in self.system.drives:
            value = values[drive.label]
            found += [value.cos(), value.sin()] if drive.is_angle else [value]
        return found if all(b.is_finite() for b in found) else None

    def _is_own(self, box: Box) -> bool:
        """Whether angles are the given ones, not half a turn away, and constants have their own values."""
        own = (box[self.ring.index(c.name)] for c in self.constants)
        pinned = all(ball(c.low) < b and b < ball(c.high) for c, b in zip(self.constants, own, strict=True))
        return pinned and all(evaluate(d.agreement, box) > 0 for d in self.system.drives)


def sure_sign(polynomial: Polynomial, box: Box) -> int:
    """The sign of a polynomial on a whole box, by its values or by its slopes; 0 where they do not decide."""
    with at_precision(BITS):
        sign = sign_on_box(polynomial, box)
        if sign:
            return sign
        names = polynomial.variables
        middle = [arb(b.mid()) for b in box]
        total = evaluate(polynomial, middle)
        for name, slope in zip(names, jacobian((polynomial,), names)[0], strict=True):
            place = polynomial.ring.index(name)
            total = total + evaluate(slope, box) * (box[place] - middle[place])
        return int(total > 0) - int(total < 0)


def is_surely_regular(
    equation: VelocityEquation, conditions: Mapping[str, Sequence[Polynomial] | None], box: Box
) -> bool:
    """Whether L_I and L_O have full rank on a whole box, so that no configuration in it is singular.

    conditions: the factors of (4) and (5); None where they are not written out: then by the ranks.
    """
    for label, name in (("4", "L_I"), ("5", "L_O")):
        factors = conditions[label]
        if factors is None:
            with at_precision(BITS):
                matrix = getattr(equation, name)
                rows = [[evaluate(e, box) for e in row] for row in matrix.rows]
                if not rank_at_least(rows, equation.N):
                    return False
        elif not all(sure_sign(p, box) for p in factors):
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
    equations = (*space.equations, *space.ring.relations, *locus)
    slopes = CompiledMap.balanced(equations, space.ring).jacobian(near)
    constants = [space.ring.index(c.name) for c in space.ring.constants]
    rank = numerical_rank(slopes, 1e-9).rank
    if rank < len(equations):
        return None
    dependent = dependent_columns(slopes, rank, constants)
    held = {name: Fraction(float(near[k])) for k, name in enumerate(space.ring.names) if k not in dependent}
    point = boxed_point(space.ring, equations, held, near.tolist())
    return point if point is not None and pinned(point, space.ring.constants) else None
