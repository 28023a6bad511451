"""Proofs that two regions with the same signs are apart: a plane that no region with these signs meets.

Source: singsym's own; the plane cuts a surface of configurations in a curve, whose topology is certified, and
whose arcs between borders are all looked at.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

import numpy as np

from singsym.classes.configuration.locate import sizes_of_coordinates
from singsym.effort import patience
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Certainty, weakest
from singsym.motion.enclosures import BITS, point_on
from singsym.motion.regions.free_motion import FreeMotions
from singsym.motion.regions.result import Wall
from singsym.polynomials import Polynomial
from singsym.polynomials.compiled_map import Floats
from singsym.varieties.real.curves.cuts import CutCurve
from singsym.varieties.real.curves.real_curve import real_curve
from singsym.varieties.real.points.intervals import at_precision, sign_on_box

_PLANES = 3
"""So many planes are tried for two regions."""
_SHARES = (0.5, 0.3, 0.7, 0.1, 0.9)
_DENOMINATORS = (2, 10, 100, 10000)


def wall(motions: FreeMotions, signs: tuple[int, ...], one: Floats, other: Floats) -> Wall | None:
    """A plane between configurations with these signs, (points, variables) each, that is proven to be a wall.

    None where none of those that are tried is in time, or where the configurations are no surface.
    """
    if motions.borders.equation.n != 2 or not all(signs):
        return None
    for number, plane in enumerate(_planes(motions, one, other)):
        if number == _PLANES:
            break
        try:
            certainty = _proven(motions, signs, plane)
        except (Undecided, ValueError):
            continue
        if certainty is not None:
            return Wall(plane, signs, certainty)
    return None


def _planes(motions: FreeMotions, one: Floats, other: Floats) -> Iterator[Polynomial]:
    """Planes between two sets of points: of one coordinate, those with the widest gap first; then any."""
    equation = motions.borders.equation
    ring, sizes = equation.space.ring, sizes_of_coordinates(equation)
    fixed = {c.name for c in ring.constants}
    moving = [k for k, name in enumerate(ring.names) if name not in fixed]
    found = []
    for k in moving:
        direction = np.zeros(len(ring.names))
        direction[k] = 1.0
        gap, between = _between(one @ direction, other @ direction)
        if between is not None:
            found.append((gap / sizes[k], k, between))
    for _, k, between in sorted(found, reverse=True):
        yield ring.gen(ring.names[k]) - between
    # the direction of Fisher's discriminant
    scaled = [points[:, moving] / sizes[moving] for points in (one, other)]
    spread = sum(np.cov(points.T, bias=True) for points in scaled) + 1e-3 * np.eye(len(moving))
    direction = np.linalg.solve(spread, scaled[1].mean(axis=0) - scaled[0].mean(axis=0)) / sizes[moving]
    largest = float(np.abs(direction).max(initial=0.0))
    if not largest:
        return
    rounded = [Fraction(float(x)).limit_denominator(8) for x in direction / largest]
    along = np.zeros(len(ring.names))
    along[moving] = [float(x) for x in rounded]
    _, between = _between(one @ along, other @ along)
    if between is not None:
        names = [ring.names[k] for k in moving]
        parts = (ring.gen(name) * x for name, x in zip(names, rounded, strict=True) if x)
        yield sum(parts, start=ring.zero) - between


def _between(one: Floats, other: Floats) -> tuple[float, Fraction | None]:
    """The gap between two sets of numbers, and a short fraction in it; None where there is no gap."""
    low, high = (one, other) if one.mean() < other.mean() else (other, one)
    least, most = float(low.max()), float(high.min())
    for denominator in _DENOMINATORS:
        found = Fraction((least + most) / 2).limit_denominator(denominator)
        if least < found < most:
            return most - least, found
    return most - least, None


def _proven(motions: FreeMotions, signs: tuple[int, ...], plane: Polynomial) -> Certainty | None:
    """How it is known that a plane meets no configuration with these signs; None where it may."""
    borders = motions.borders
    polynomials = [b.polynomial for b in borders.all]
    budget = current().part(patience.WALLS.work)
    curve = real_curve((*borders.equation.space.equations, plane), budget=budget)
    cut = curve.cut(*polynomials, budget=budget)
    for point in curve.isolated_points:
        if all(point.sign(p) == s for p, s in zip(polynomials, signs, strict=True)):
            return None
    pieces = range(len(cut.value.pieces))
    if not all(_has_other_signs(motions, signs, plane, cut.value, number) for number in pieces):
        return None
    return weakest("certified", cut.certainty)


def _has_other_signs(
    motions: FreeMotions, signs: Sequence[int], plane: Polynomial, cut: CutCurve, number: int
) -> bool:
    """Whether a border is proven to have another sign on a piece: at a configuration, and so on all of it."""
    equation, line = motions.borders.equation, cut.pieces[number].line
    places = np.arange(len(line), dtype=float)
    for share in _SHARES if len(line) else ():
        near = np.array([np.interp(share * places[-1], places, column) for column in line.T])
        point = point_on(equation, (plane,), near)
        if point is None:
            continue
        with at_precision(BITS):
            found = [sign_on_box(b.polynomial, point.box) for b in motions.borders.all]
        try:
            if (
                any(a * b < 0 for a, b in zip(found, signs, strict=True))
                and cut.piece_of(point.box) == number
            ):
                return True
        except Undecided:
            continue
    return False
