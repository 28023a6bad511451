"""The half-branches of a real curve at any singular point, by counting fibres of the distance from a point.

Source: fibres below, at and above a critical level, as for plane curves: H. Hong, An efficient method for
analyzing the topology of plane real algebraic curves, Math. Comput. Simulation 42 (1996) 571-582.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import cast

import numpy as np
from flint import acb, arb, fmpq_poly

from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Known, Premises
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.arithmetic import Array, Balls, System
from singsym.varieties.real.curves.critical_points import as_balls
from singsym.varieties.real.curves.paths import Chain, contained, prove_chains
from singsym.varieties.real.curves.singular_points import Star
from singsym.varieties.real.curves.tracking import Marks, kernels, track
from singsym.varieties.real.curves.tubes import frames, inverses
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.points.intervals import at_precision, evaluate

_SLABS = 5


def branch_star(
    system: System,
    equations: Sequence[Polynomial],
    objective: Polynomial,
    point: RealPoint,
    critical: Sequence[RealPoint],
    budget: Budget,
) -> Known[Star]:
    """The star of a singular point; `critical` are all critical points of `objective` on the curve.

    Lemma: let no other critical point have its level in [c-, c+], and let the level of the point hold k other
    points of the curve.  Then k arcs run from c- to c+, and all others between these levels end at the point:
    once k arcs are proven to pass, the remaining points at c- and c+ lie on its half-branches.
    Raises `Undecided` where another critical point has the same level, or the arcs cannot be proven.
    """
    premises = Premises()
    passing = len(premises.take(_fibre_through(equations, objective, point, budget))) - 1
    below, above = _gap(objective, point, critical)
    for _ in range(_SLABS):
        low, high = _levels(objective, point, below, above)
        fibres = [premises.take(real_points((*equations, objective - c), budget)) for c in (low, high)]
        star = _count(system, objective, point, fibres, passing, budget)
        if star is not None:
            return premises.conclude(star)
        below, above = below / 16, above / 16
    raise Undecided(f"the branches of the curve at {point!r} could not be told apart")


def _value(objective: Polynomial, point: RealPoint, bits: int) -> arb:
    with at_precision(bits + 64):
        return evaluate(objective, point.refine(bits).box)


def _gap(objective: Polynomial, point: RealPoint, critical: Sequence[RealPoint]) -> tuple[Fraction, Fraction]:
    """Most of the distance to the next critical levels below and above, at most 1."""
    bits = 128
    own = _value(objective, point, bits)
    gaps = [Fraction(1), Fraction(1)]
    for other in critical:
        level = _value(objective, other, bits)
        if not level.overlaps(own):
            side = int(level > own)
            gaps[side] = min(gaps[side], Fraction(float(abs(level - own).lower())) * 9 / 10)
        elif not other.coincides(point):
            raise Undecided("two critical points of a distance at the same level: draw another seed")
    return gaps[0], gaps[1]


def _levels(
    objective: Polynomial, point: RealPoint, below: Fraction, above: Fraction
) -> tuple[Fraction, Fraction]:
    """Rationals with small denominators just below and above the level of the point."""
    middle = Fraction(float(_value(objective, point, 128).mid()))
    low = (middle - below).limit_denominator(max(64, int(64 / below)))
    high = (middle + above).limit_denominator(max(64, int(64 / above)))
    own = _value(objective, point, 128)
    if not (own > arb(low.numerator) / low.denominator and own < arb(high.numerator) / high.denominator):
        raise Undecided("the critical levels of a distance are too close to be separated")
    return low, high


def _fibre_through(
    equations: Sequence[Polynomial], objective: Polynomial, point: RealPoint, budget: Budget
) -> Known[list[RealPoint]]:
    """All real points of the curve with the same value of the objective as the point."""
    level = _level_polynomial(objective, point)
    fibre = real_points((*equations, level), budget)
    bits = 128
    own = _value(objective, point, bits)
    return Known([p for p in fibre.value if _value(objective, p, bits).overlaps(own)], fibre.certainty)


def _level_polynomial(objective: Polynomial, point: RealPoint) -> Polynomial:
    """The minimal polynomial of the objective's value at the point, applied to the objective.

    Conjugate values nearer than 2^-100 are refused: 128 bits must tell them apart.
    """
    ring = Ring(("t", "x"))
    t, x = ring.gens
    below = sum((t**k * c for k, c in enumerate(point.denominator)), start=ring.zero)
    tops = [sum((t**k * c for k, c in enumerate(n)), start=ring.zero) for n in point.numerators]
    minimal = sum((t**k * c for k, c in enumerate(point.minimal)), start=ring.zero)
    degree = objective.total_degree
    value = ring.zero
    for exponents, c in objective.terms():
        term = below ** (degree - sum(exponents)) * c
        for top, e in zip(tops, exponents, strict=True):
            term = term * top**e
        value = value + term
    resultant = Polynomial(ring, minimal.value.resultant((below**degree * x - value).value, "t"))
    own = _value(objective, point, 256)
    factors = [f for f, _ in resultant.factors() if f.evaluate([arb(0), own]).contains(0)]
    if len(factors) != 1:
        raise Undecided("the level of a singular point could not be told from its conjugates")
    coefficients = [factors[0].coefficient("x", k).constant for k in range(factors[0].degree("x") + 1)]
    with at_precision(512):
        found = cast("list[tuple[acb, int]]", fmpq_poly(coefficients).numer().complex_roots())
        roots = [r.real for r, _ in found if r.imag == 0]
        near = [r for r in roots if abs(r - own) < arb(2) ** -100]
    if len(near) != 1:
        raise Undecided("the level of a singular point is too close to a conjugate of it")
    result = objective.ring.zero
    for c in reversed(coefficients):
        result = result * objective + c
    return result


def _count(
    system: System,
    objective: Polynomial,
    point: RealPoint,
    fibres: Sequence[Sequence[RealPoint]],
    passing: int,
    budget: Budget,
) -> Star | None:
    """The star, if as many arcs as must pass are proven to pass."""
    low, high = fibres
    size = len(system.ring.names)
    balls = as_balls([*low, *high], size)
    inward = _inward(system, objective, balls.mid, len(low))
    crossed: set[int] = set()
    if passing:
        marks = Marks(balls.mid, np.arange(len(balls.mid)), inward)
        arcs = [t for t in track(system, marks, np.arange(len(low)), bend=0.2) if t.end >= len(low)]
        for arc in arcs:
            proven = prove_chains(system, [Chain(arc.points, (arc.start, arc.end), False)], budget)
            ends = Balls(balls.mid[[arc.start, arc.end]], balls.rad[[arc.start, arc.end]])
            if isinstance(proven, str) or not contained(proven, ends)[0].all():
                continue
            if _goes_up(system, objective, proven[0], ends):
                crossed.update((arc.start, arc.end))
        if len(crossed) != 2 * passing:
            return None
    kept = [k for k in range(len(balls.mid)) if k not in crossed]
    kind = "isolated" if not kept else "branched"
    return Star(point, kind, Balls(balls.mid[kept], balls.rad[kept]), -inward[kept], True)


def _goes_up(system: System, objective: Polynomial, chain: Chain, ends: Balls) -> bool:
    """Whether the objective surely increases along a proven chain at both its ends.

    Lemma: the kernel of the Jacobian is within `tilt` of the computed tangent, and the arc of a tube moves
    along its step.
    """
    if chain.tubes is None:
        return False
    step = chain.tubes.step[[0, -1]]
    along = kernels(system, ends.mid)
    along = along * np.sign((along * step).sum(axis=1))[:, None]
    frame = frames(along)
    precondition = Balls.exact(inverses(system.jacobian(ends.mid) @ frame))
    slopes = precondition.matmul(system.jacobian_balls(ends))
    defect = (slopes.matmul(Balls.exact(frame)) - Balls.exact(np.eye(frame.shape[2])[None])).magnitude()
    moved = slopes.matmul(Balls.exact(along[:, :, None])).magnitude().max(axis=(1, 2), initial=0.0)
    tilt = 4 * len(system.ring.names) * moved
    if not (defect.sum(axis=2).max(initial=0.0) < 0.5 and tilt.max() < 1e-7):
        return False
    forward = (along * step).sum(axis=1) > 1e-5 * np.linalg.norm(step, axis=1)
    gradient = System(objective.ring, (objective,)).jacobian_balls(ends)
    rise = gradient.matmul(Balls.exact(along[:, :, None]))
    margin = tilt[:, None, None] * gradient.magnitude().sum(axis=2, keepdims=True)
    return bool(forward.all() and (rise.mid > (rise.rad + margin) * (1 + 1e-9)).all())


def _inward(system: System, objective: Polynomial, points: Array, lower: int) -> Array:
    """Unit tangents at the fibre points, into the slab: up at the first `lower`, down at the others."""
    if not len(points):
        return points
    directions = kernels(system, points)
    gradient = System(objective.ring, (objective,)).jacobian(points)[:, 0, :]
    side = np.sign((directions * gradient).sum(axis=1))
    side[lower:] *= -1
    return np.asarray(directions * side[:, None])
