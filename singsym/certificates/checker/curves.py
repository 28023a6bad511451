"""The connected components of a smooth bounded curve, as closed chains of tubes.

Source: Krawczyk (1969), with a parameter; Neumaier, Interval Methods for Systems of Equations (1990), 5.1; a
closed and bounded component has a point at which a coordinate is largest, a critical one (Seidenberg 1954).

Lemma.  In a tube there is one point of the curve over each value of one coordinate between two bounds: an
arc.  A chain in which each arc begins inside the one before and ends inside the next, and the last is before
the first, has a union that is compact, and open in the curve: a component of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from flint import arb, arb_mat, arb_poly, ctx, fmpq, fmpq_mpoly

from singsym.certificates.checker.balls import Compiled, is_off_zero, preconditioned
from singsym.certificates.checker.points import chart_of
from singsym.certificates.checker.polynomials import Rejected, determinant, polynomial, rational, remainder
from singsym.certificates.checker.rules import Line, derive
from singsym.certificates.checker.sets import MOST, RealSet, chosen, listed, named, whole_number
from singsym.certificates.checker.strata import implied

BITS, ROOT_BITS = 90, 512
Boxes = list[list[arb]]
UNIT = 10**9
"""Numbers of tubes are whole multiples of one over this."""


def components(at: RealSet, data: Line) -> Loops:
    """The components of a curve, the zeros of the equations of a set, in tubes; raises `Rejected`.

    The set has one generator less than variables; or else there is a `square` system, see `strata.implied`.
    bounded: see `_check_bounded`; critical: see `_critical_points`; loops: chains of tubes, see
    `Tubes.tube`.  Each critical point lies in a tube, and each loop has a point that is in the set up to
    inequalities, so that the loop is its closure.  signs: that these vanish nowhere on the equations' zeros,
    see `real_points`, one for each; loops on which one is negative are left out.
    """
    own, local = square_system(at, data)
    if not own or len(own) != len(at.variables) - 1:
        raise Rejected("a curve: expected equations, one less than variables")
    _check_bounded(at, listed(data, "bounded", list))
    system = Tubes(own)
    with ctx.workprec(BITS):
        loops = [[system.tube(entry) for entry in loop] for loop in listed(data, "loops", list)]
        for k, loop in enumerate(loops):
            for one, two in zip(loop, loop[1:] + loop[:1], strict=True):
                if not (two.holds(one.end) and one.holds(two.start)):
                    raise Rejected(f"loop {k}: a tube does not lead into the next one")
            if not any(all(is_off_zero(unit, tube.start) for unit in (*at.units, local)) for tube in loop):
                raise Rejected(f"loop {k}: no point of it is seen to be in the set")
            for other in loops[:k]:
                if not all(tube.misses(loop[0].start) for tube in other):
                    raise Rejected(f"loop {k} is not seen to be another one than those before")
        inside = list[Boxes]([[] for _ in loops])
        for box in _critical_points(at, own, local, named(data, "critical")):
            inside[_loop_of(box, loops)].append(box)
        entries, within = listed(data, "signs", dict, []), [at.within([f]) for f in at.inequalities]
        if len(entries) != len(within) or any(map(real_points, within, entries)):
            raise Rejected("signs: an inequality may vanish on a curve")
        return [loop for loop, boxes in zip(loops, inside, strict=True) if _has_signs(at, boxes)]


def _has_signs(at: RealSet, boxes: Boxes) -> bool:
    """Whether inequalities that vanish nowhere on a loop hold at points of it; raises `Rejected`."""
    signs = [{v > 0 for v in map(Compiled(f).at, boxes) if not v.contains(0)} for f in at.inequalities]
    if any(len(own) != 1 for own in signs):
        raise Rejected("signs: that of an inequality is not seen on a loop")
    return {False} not in signs


def square_system(at: RealSet, data: Line) -> tuple[Sequence[fmpq_mpoly], fmpq_mpoly]:
    """Equations, and a polynomial off whose zeros they have just those of the set; raises `Rejected`."""
    if len(at.generators) == len(at.variables) - 1:
        return at.generators, at.context.constant(1)
    return chosen(at.equations, listed(data, "square"), "equation"), implied(at, data)


@dataclass(frozen=True)
class Tube:
    """Points with one coordinate `along` between two bounds, each other one within `radius` of a line.

    start, end: balls that hold the ends of the arc inside; box: one that holds all of the tube.
    """

    along: int
    first: arb
    last: arb
    centre: tuple[arb, ...]
    slope: tuple[arb, ...]
    radius: arb
    start: tuple[arb, ...] = ()
    end: tuple[arb, ...] = ()
    box: tuple[arb, ...] = ()

    def line(self, t: arb) -> list[arb]:
        """The point of the middle line over a value of the coordinate."""
        found = [c + s * (t - self.first) for c, s in zip(self.centre, self.slope, strict=True)]
        found[self.along] = t
        return found

    def holds(self, box: Sequence[arb]) -> bool:
        """Whether a box lies inside, off both ends."""
        return self._beyond(box) < 0 and all(distance < self.radius for distance in self._away(box))

    def overlaps(self, other: Tube) -> bool:
        """Whether two tubes may have a point in common."""
        return all(x.overlaps(y) for x, y in zip(self.box, other.box, strict=True))

    def misses(self, box: Sequence[arb]) -> bool:
        """Whether a box has no point of the tube."""
        return self._beyond(box) > 0 or any(distance > self.radius for distance in self._away(box))

    def _beyond(self, box: Sequence[arb]) -> arb:
        """Negative between both bounds of the coordinate, positive outside."""
        return (box[self.along] - self.first) * (box[self.along] - self.last)

    def _away(self, box: Sequence[arb]) -> list[arb]:
        """How far a box is from the middle line, by each coordinate but one."""
        pairs = enumerate(zip(box, self.line(box[self.along]), strict=True))
        return [abs(x - c) for i, (x, c) in pairs if i != self.along]


Loops = Sequence[Sequence[Tube]]
Curve = tuple[RealSet, Loops]


class Tubes:
    """A curve, and tubes with an arc of it in each."""

    def __init__(self, equations: Sequence[fmpq_mpoly]) -> None:
        self.size = len(equations) + 1
        with ctx.workprec(BITS):
            self.functions = [Compiled(e) for e in equations]
            self.gradients = [[Compiled(e.derivative(i)) for i in range(self.size)] for e in equations]

    def tube(self, entry: Any) -> Tube:
        """`[along, from, to, centre, slope, radius]`, all but the first in units; raises `Rejected`.

        For each value of the coordinate the Newton operator maps the box around the line's point into itself.
        """
        along, first, last, _, slope, radius = numbers = self._read(entry)
        tube = Tube(*numbers)
        others = [i for i in range(self.size) if i != along]
        middle = (first + last) / 2
        half = arb(0, (abs(last - first) / 2).upper())
        spread = arb(0, radius.upper())
        box = [x if i == along else x + spread for i, x in enumerate(tube.line(middle + half))]
        jacobian = [[g.at(box) for g in row] for row in self.gradients]
        square = arb_mat([[row[i] for i in others] for row in jacobian])
        inverse, defect = preconditioned(square)
        line = [arb_poly([c, d]) for c, d in zip(tube.line(middle), slope, strict=True)]
        line[along] = arb_poly([middle, 1])
        series = [f.at(line).coeffs() for f in self.functions]
        terms = max(map(len, series))
        # the inverse first, then the range: what cancels is not counted twice
        on_line = inverse * arb_mat([[*c, *[arb(0)] * (terms - len(c))] for c in series])
        ranges = [arb_poly([on_line[i, k] for k in range(terms)])(half) for i in range(len(others))]
        moved = defect * arb_mat([[spread] for _ in others])
        if not all(abs(total + moved[i, 0]) < radius for i, total in enumerate(ranges)):
            raise Rejected("a tube: the Newton operator does not map it into itself")
        ends = []
        for t in (first, last):
            point = tube.line(t)
            at_end = inverse * arb_mat([[f.at(point)] for f in self.functions])
            near = at_end - defect * (at_end + moved)
            for k, i in enumerate(others):
                point[i] = point[i] - near[k, 0]
            ends.append(tuple(point))
        return Tube(*numbers, ends[0], ends[1], tuple(box))

    def _read(self, entry: Any) -> tuple[int, arb, arb, tuple[arb, ...], tuple[arb, ...], arb]:
        """The numbers of a tube; raises `Rejected`."""
        if isinstance(entry, list) and [*map(type, entry)] == [int, int, int, list, list, int]:
            along, first, last, centre, slope, radius = entry
            whole = all(type(x) is int for x in (*centre, *slope)) and radius > 0 and first != last
            if whole and len(centre) == len(slope) == self.size and 0 <= along < self.size:
                a, b, r = _line((first, last, radius))
                return along, a, b, _line(centre), _line(slope), r
        raise Rejected(f"expected a tube of {self.size} coordinates, got {str(entry)[:80]}")


def _line(numbers: Sequence[int]) -> tuple[arb, ...]:
    return tuple(arb(fmpq(x, UNIT)) for x in numbers)


def _check_bounded(at: RealSet, steps: Sequence[Any]) -> None:
    """Whether all variables are bounded on the set, step by step; raises `Rejected`.

    Each step is `[generator, names]`: in these variables the generator is a definite quadratic form, and
    terms of lower degree with coefficients in variables that are known to be bounded.
    """
    known: set[int] = set()
    for step in steps:
        if len(step) != 2 or not isinstance(step[1], list) or not all(n in at.variables for n in step[1]):
            raise Rejected(f"bounded: expected [generator, names], got {str(step)[:80]}")
        f = chosen(at.generators, [step[0]], "generator")[0]
        own = [at.variables.index(name) for name in step[1]]
        form = [[f.derivative(i).derivative(j) for j in own] for i in own]
        others = {i for i, degree in enumerate(f.degrees()) if degree and i not in own}
        if others - known or not all(e.is_constant() for row in form for e in row):
            raise Rejected(f"bounded: generator {step[0]} is not of this kind")
        sizes = range(1, len(own) + 1)
        minors = [determinant([row[:k] for row in form[:k]], []).leading_coefficient() for k in sizes]
        sign = 1 if minors and minors[0] > 0 else -1
        if not all(m * sign**k > 0 for k, m in enumerate(minors, 1)):
            raise Rejected(f"bounded: the form of generator {step[0]} is not definite")
        known |= set(own)
    if len(known) < len(at.variables):
        raise Rejected("bounded: not all variables are seen to be bounded")


def _critical_points(at: RealSet, own: Sequence[fmpq_mpoly], local: fmpq_mpoly, data: Line) -> Boxes:
    """Balls around points of the curve among which are all where a coordinate is largest on a component.

    variable: the coordinate.  There `local` vanishes, or the determinant of the gradients by the others.
    Their product is on the curve `scale` times that of the polynomials of `factors`, each with its own zeros:
    see `real_points`.
    """
    if data.get("variable") not in at.variables:
        raise Rejected("critical: expected a variable of the set")
    others = [i for i, name in enumerate(at.variables) if name != data["variable"]]
    rows = [[remainder(e.derivative(i), at.equations) for i in others] for e in own]
    product = at.context.constant(rational(data.get("scale", "1")))
    found: Boxes = []
    for entry in listed(data, "factors", dict):
        part = polynomial(entry.get("polynomial", ""), at.context)
        product = product * part ** whole_number(entry, "multiplicity", 1, MOST)
        found += real_points(at.within([part]), entry)
    if not product or remainder(determinant(rows, at.equations) * local - product, at.equations):
        raise Rejected("critical: the determinant is not seen to be this product")
    return found


def real_points(at: RealSet, line: Line) -> Boxes:
    """Balls around all real zeros of a set's equations; raises `Rejected`.

    steps and equations as of `derive`, to a constant, or else with a chart as of the leaf `points`.
    """
    (there,) = derive(at, line)
    if any(e.is_constant() for e in there.equations if e):
        return []
    chart, roots = chart_of(there, line)
    with ctx.workprec(ROOT_BITS):
        return chart.balls(roots)


def meetings(one: Curve, two: Curve, line: Line) -> list[tuple[int, int]]:
    """Which loops of two curves have a point in common, by all points of both sets; raises `Rejected`."""
    boxes = real_points(one[0].within(two[0].equations), line)
    kept = [box for box in boxes if not any(Compiled(f).at(box) < 0 for f in one[0].inequalities)]
    return [(_loop_of(box, one[1]), _loop_of(box, two[1])) for box in kept]


def _loop_of(box: Sequence[arb], loops: Loops) -> int:
    """The loop on which a point lies, critical or of two curves; raises `Rejected`."""
    for k, loop in enumerate(loops):
        if any(tube.holds(box) for tube in loop):
            return k
    raise Rejected("a critical point, or one of two curves, lies in no tube")
