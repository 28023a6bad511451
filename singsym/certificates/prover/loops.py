"""The components of a smooth bounded curve as closed chains of tubes, as the leaf `ranks` has them.

Source: predictor and corrector (Allgower, Georg, Introduction to Numerical Continuation Methods, 2003);
what they find proves nothing, the checker's tubes do.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import Any

import numpy
from flint import ctx, fmpq_mpoly
from numpy.typing import NDArray

from singsym.certificates.checker.curves import BITS, UNIT, Tube, Tubes, real_points, square_system
from singsym.certificates.checker.polynomials import Rejected, determinant, remainder
from singsym.certificates.checker.sets import RealSet
from singsym.certificates.prover.boxes import by_length, implied_by, independent
from singsym.certificates.prover.finite import points_leaf
from singsym.effort import chance
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided, current
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.compiled_map import CompiledMap

Floats = NDArray[numpy.float64]
Based = Callable[[RealSet, int], tuple[RealSet, dict[str, Any]]]
"""The set with a Groebner basis of its equations, of which so many first ones may hold one, and the steps."""

FIRST_STEP, LEAST_STEP, LARGEST_STEP = 0.2, 1e-4, 0.5
FINITE = 20.0
"""Seconds of work in which critical points are to be seen to be finitely many."""
MOST_TUBES = 4000
CORRECTIONS, EXACT = 8, 1e-9
"""Newton's method ends after so many steps, or with one so short that the next would be of rounding only."""
MOST_SYSTEMS, MOST_POINTS = 6, 12
"""So many square systems are tried for one curve, each looked at in so many points."""
BETTER = 1.2
"""An equation is exchanged for one with which gradients are so much more independent."""
NEWTON_STEPS = 40
SHORTER = 0.3
OVERLAP = 0.08
"""Tubes go on beyond both ends by this part of their length."""
WIDTHS = (8.0, 4.0, 16.0)
"""Radii that are tried, as multiples of how far the curve is from the line."""
NARROWEST = 1e-6


def curve_leaf(at: RealSet, point: Mapping[str, Any], based: Based) -> dict[str, Any] | None:
    """`bounded`, `critical` and `loops` of a curve; None where it is not one that the checker counts.

    point: as the leaf has it; empty where none is known, then the curve has no loops.  Raises `Undecided`
    where arcs are not closed in time.
    """
    bounded = _bounded(at)
    if bounded is None:
        return None
    data = dict(point) or _some_square(at)
    if not data and len(at.generators) != len(at.variables) - 1:
        return None
    seen, tried = list[list[float]](), list[set[int]]()
    for _ in range(MOST_SYSTEMS):
        own, local = square_system(at, data)
        critical, points = (
            _critical(at, own, local, based) if len(own) == len(at.variables) - 1 else (None, [])
        )
        if critical is None:
            return None
        if points and not point and not at.inequalities:
            return None
        starts = [[float(x.mid()) for x in root] for root in points]
        tracker = _Tracker(own, at)
        bad = next((start for start in starts if tracker.is_singular(start)), None)
        if bad is None:
            more = {key: data[key] for key in ("square", "implied") if data.get(key) != point.get(key)}
            if at.inequalities:
                signs = [all_zeros(at.within([f]), based, len(at.equations)) for f in at.inequalities]
                if None in signs:
                    return None
                more["signs"] = signs
            return {"bounded": bounded, "critical": critical, "loops": _loops(tracker, points), **more}
        # another square system, that is regular there
        seen = [bad, *seen, *starts[:MOST_POINTS]]
        implied = None
        while implied is None and len(tried) < MOST_SYSTEMS and (rows := _regular_rows(at, seen, tried)):
            tried.append({*rows})
            implied = implied_by(at, rows, bad)
        if implied is None:
            return None
        data |= {"square": rows, "implied": implied}
    return None


def _regular_rows(
    at: RealSet, points: Sequence[Sequence[float]], tried: Sequence[set[int]]
) -> list[int] | None:
    """Places of equations, one less than variables, with gradients as independent at points as can be.

    tried: other ones are wanted.  None where the gradients of all are dependent at the first point.
    """
    rows = independent(at, points[0], by_length(at.equations))[0]
    if len(rows) < len(at.variables) - 1:
        return None
    ring = Ring(at.variables)
    slopes = CompiledMap([Polynomial(ring, e) for e in at.equations], ring)
    matrices = numpy.array([slopes.jacobian(numpy.array(point)) for point in points])
    sizes = numpy.linalg.norm(matrices, axis=2, keepdims=True)
    matrices = matrices / numpy.where(sizes > 0, sizes, 1.0)

    def least(own: list[int]) -> float:
        return float(numpy.linalg.svd(matrices[:, own, :], compute_uv=False)[:, -1].min())

    best = 0.0 if {*rows} in tried else least(rows)
    while True:
        current().check("a square system of a curve")
        others = [k for k in range(len(at.equations)) if k not in rows]
        exchanged = [[*rows[:i], k, *rows[i + 1 :]] for i in range(len(rows)) for k in others]
        found = max((own for own in exchanged if {*own} not in tried), key=least, default=rows)
        if least(found) <= BETTER * best or found == rows:
            return None if {*rows} in tried else rows
        rows, best = found, least(found)


def _some_square(at: RealSet) -> dict[str, Any]:
    """A square system of a set of which no real point is known: equations independent at a complex one."""
    near = _complex_point(at)
    rows = independent(at, near, by_length(at.equations))[0]
    implied = implied_by(at, rows, near) if len(rows) == len(at.variables) - 1 else None
    return {} if implied is None else {"square": rows, "implied": implied}


def _complex_point(at: RealSet) -> list[complex]:
    """Numbers near a complex zero of the equations, by Newton's method from random ones."""
    ring, draw = Ring(at.variables), chance.random("a complex point", *at.variables)
    equations = [Polynomial(ring, e) for e in at.equations if e]
    slopes = [[e.derivative(name) for name in at.variables] for e in equations]
    x = numpy.array([complex(draw.uniform(-1, 1), draw.uniform(-1, 1)) for _ in at.variables])
    for _ in range(NEWTON_STEPS):
        values = numpy.array([complex(e.evaluate(list(x))) for e in equations])
        matrix = numpy.array([[complex(slope.evaluate(list(x))) for slope in row] for row in slopes])
        if not (numpy.isfinite(values).all() and numpy.isfinite(matrix).all()):
            raise Undecided("no complex point of a curve is found")
        x = x - numpy.linalg.lstsq(matrix, values, rcond=1e-9)[0]
    return [complex(value) for value in x]


def _loops(tracker: _Tracker, points: Sequence[Sequence[Any]]) -> list[list[Any]]:
    """The components through some points, balls, each once."""
    loops: list[list[Any]] = []
    with ctx.workprec(BITS):
        known: list[Tube] = []
        for root in points:
            if any(tube.holds(root) for tube in known):
                continue
            entries, tubes = tracker.loop(numpy.array([float(x.mid()) for x in root]))
            loops.append(entries)
            known += tubes
    return loops


def _bounded(at: RealSet) -> list[list[Any]] | None:
    """Generators, each with the variables that it bounds, in order; None where that does not reach all."""
    known: set[int] = set()
    steps: list[list[Any]] = []
    size = len(at.variables)
    while len(known) < size:
        for place, f in enumerate(at.generators):
            own = [i for i, d in enumerate(f.degrees()) if d and i not in known]
            if own and _is_definite(f, own):
                steps.append([place, [at.variables[i] for i in own]])
                known |= set(own)
                break
        else:
            return None
    return steps


def _is_definite(f: fmpq_mpoly, own: Sequence[int]) -> bool:
    """Whether a polynomial is a definite quadratic form in some variables, up to terms of lower degree."""
    form = numpy.zeros((len(own), len(own)))
    for exponents, coefficient in f.terms():
        inside = [k for k, i in enumerate(own) for _ in range(int(exponents[i]))]
        outside = sum(map(int, exponents)) - len(inside)
        if len(inside) > 2 or (len(inside) == 2 and outside):
            return False
        if len(inside) == 2:
            form[inside[0], inside[1]] += float(coefficient.p) / float(coefficient.q) / 2
            form[inside[1], inside[0]] += float(coefficient.p) / float(coefficient.q) / 2
    values = numpy.linalg.eigvalsh(form)
    return bool(values.min() > 1e-9 or values.max() < -1e-9)


def _critical(
    at: RealSet, square: Sequence[fmpq_mpoly], local: fmpq_mpoly, based: Based
) -> tuple[dict[str, Any] | None, list[Any]]:
    """Critical points of a coordinate that has finitely many, and balls around the real ones.

    Short determinants are tried first: they have few zeros.
    """
    ways = []
    for own in reversed(range(len(at.variables))):
        others = [i for i in range(len(at.variables)) if i != own]
        # not reduced, as it comes apart into factors then
        found = local * determinant([[e.derivative(i) for i in others] for e in square], [])
        if remainder(found, at.equations):
            ways.append((own, found))
    shortest = sorted(ways, key=lambda way: len(way[1]))
    finite = (way for way in shortest if all(_is_finite(at.within([f])) for f, _ in way[1].factor()[1]))
    best = next(finite, None)
    if best is None:
        return None, []
    own, (scale, parts) = best[0], best[1].factor()
    entries = []
    balls: list[Any] = []
    for part, multiplicity in sorted(parts, key=lambda pair: len(pair[0])):
        there = at.within([part])
        if (zeros := all_zeros(there, based, len(at.equations))) is None:
            return None, []
        entries.append({"polynomial": str(part), "multiplicity": int(multiplicity), **zeros})
        balls += real_points(there, zeros)
    return {"variable": at.variables[own], "scale": str(scale), "factors": entries}, balls


def all_zeros(at: RealSet, based: Based, known: int) -> dict[str, Any] | None:
    """Steps to a basis of the equations of a set, and a chart of its zeros where these are finitely many.

    known: so many of the first equations may hold a basis of their own ideal.
    """
    there, steps = based(at, known)
    if any(e.is_constant() for e in there.equations if e):
        return steps
    return steps | points_leaf(there) if _is_finite(there) else None


def _is_finite(at: RealSet) -> bool:
    """Whether the equations are seen to have finitely many complex zeros, or none."""
    own = Ring(at.variables)
    with attempt("whether critical points are finitely many", FINITE):
        return Ideal(own, [Polynomial(own, e) for e in at.equations if e]).dimension.value <= 0
    return False


class _Tracker:
    """Arcs of one curve."""

    def __init__(self, equations: Sequence[fmpq_mpoly], at: RealSet) -> None:
        ring = Ring(at.variables)
        self.map = CompiledMap([Polynomial(ring, e) for e in equations], ring)
        self.tubes = Tubes(equations)
        self.size = len(at.variables)

    def is_singular(self, x: Sequence[float]) -> bool:
        """Whether the gradients are dependent at a point, up to rounding."""
        sizes = numpy.linalg.svd(self.map.jacobian(numpy.array(x)), compute_uv=False)
        return bool(sizes[-1] < 1e-9 * sizes[0])

    def loop(self, start: Floats) -> tuple[list[Any], list[Tube]]:
        """The tubes of the component through a point; raises `Undecided`."""
        start = self._corrected(start, self._tangent(start, None))
        first = direction = self._tangent(start, None)
        x, step = start, FIRST_STEP
        entries: list[Any] = []
        tubes: list[Tube] = []
        before: list[tuple[Floats, Floats, float]] = []
        while len(tubes) < MOST_TUBES:
            current().check("the components of a curve for a certificate")
            ahead = start - x
            near = ahead @ direction > 0 and numpy.linalg.norm(ahead) < 1.5 * step
            closing = bool(len(tubes) > 1 and near and direction @ first > 0.5)
            y = start if closing else self._corrected(x + step * direction, direction)
            made = self._tube(x, y, partial(self._joined, tubes, closing))
            if made is None:
                step /= 2
                if before and step < SHORTER * before[-1][2]:
                    # a tube so much shorter does not reach over the overlap: the last one is made anew
                    x, direction, step = before.pop()
                    del entries[-1], tubes[-1]
                    step /= 2
                if step < LEAST_STEP:
                    raise Undecided("an arc of a curve is not followed by tubes")
                continue
            before.append((x, direction, step))
            entries.append(made[0])
            tubes.append(made[1])
            if closing:
                return entries, tubes
            x, direction = y, self._tangent(y, direction)
            step = min(1.5 * step, LARGEST_STEP)
        raise Undecided(f"a curve takes more than {MOST_TUBES} tubes")

    @staticmethod
    def _joined(before: Sequence[Tube], closing: bool, new: Tube) -> bool:
        """Whether the last tube leads into a new one, and that into the first where it closes the loop."""
        neighbours = [(before[-1], new)] if before else []
        neighbours += [(new, before[0])] if closing else []
        return all(one.holds(two.start) and two.holds(one.end) for one, two in neighbours)

    def _tangent(self, x: Floats, before: Floats | None) -> Floats:
        direction: Floats = numpy.linalg.svd(self.map.jacobian(x))[2][-1]
        return -direction if before is not None and direction @ before < 0 else direction

    def _corrected(self, x: Floats, normal: Floats) -> Floats:
        """The point of the curve near another, in the hyperplane through it."""
        for _ in range(CORRECTIONS):
            matrix = numpy.vstack([self.map.jacobian(x), normal])
            try:
                step = numpy.linalg.solve(matrix, numpy.append(self.map.values(x), 0.0))
            except numpy.linalg.LinAlgError:
                raise Undecided("a curve is singular near an arc") from None
            x = x - step
            if not numpy.isfinite(x).all():
                raise Undecided("Newton's method leaves an arc of a curve")
            if numpy.abs(step).max() < EXACT:
                break
        return x

    def _tube(self, x: Floats, y: Floats, fits: Callable[[Tube], bool]) -> tuple[Any, Tube] | None:
        """A tube between two points, over the coordinate that changes most, if one is proven and fits."""
        secant = y - x
        along = int(numpy.argmax(numpy.abs(secant)))
        if not abs(secant[along]) > 1e-7:
            return None
        slope = secant / secant[along]
        first, last = x[along] - OVERLAP * secant[along], y[along] + OVERLAP * secant[along]
        away = max(self._away(x, slope, along, t) for t in (first, (first + last) / 2, last))
        base = x + slope * (first - x[along])
        for width in WIDTHS:
            radius = max(width * away, NARROWEST)
            entry = [along, _whole(first), _whole(last), _wholes(base), _wholes(slope), _whole(radius)]
            with suppress(Rejected):
                made = self.tubes.tube(entry)
                if fits(made):
                    return entry, made
        return None

    def _away(self, x: Floats, slope: Floats, along: int, t: float) -> float:
        """How far the curve is from the line over a value of a coordinate."""
        on_line = x + slope * (t - x[along])
        normal = numpy.zeros(self.size)
        normal[along] = 1.0
        return float(numpy.abs(self._corrected(on_line, normal) - on_line).max())


def _whole(number: float) -> int:
    return round(number * UNIT)


def _wholes(numbers: Floats) -> list[int]:
    return [_whole(float(x)) for x in numbers]
