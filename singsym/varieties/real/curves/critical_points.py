"""Points that meet every connected component of a real curve, the singular points among them, and the ends.

Source: P. Aubry, F. Rouillier, M. Safey El Din, Real solving for positive dimensional systems, J. Symb.
Comput. 34 (2002) 543-560; here with the determinant split into factors.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from random import Random

import numpy as np

from singsym.effort import chance
from singsym.effort.budget import Budget, Undecided
from singsym.effort.progress import report
from singsym.effort.verdict import Known, Premises
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.minors.determinant import determinant
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.varieties.real.curves.arithmetic import EPSILON, Array, Balls
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points

Row = tuple[Polynomial, ...]

_LONGEST_FACTORED = 2000
"""Polynomials with more terms are not factored."""


@dataclass(frozen=True)
class Samples:
    """Real points of a curve that meet each of its components, and where it leaves every bounded set.

    points: all real zeros on the curve of the critical determinant of `objective` (singular points included).
    boxed: smooth points that are found in another way.
    ends: the points at which `objective` has the value `level`, beyond which the curve runs off to infinity.
    """

    objective: Polynomial
    points: tuple[RealPoint, ...]
    ends: tuple[RealPoint, ...] = ()
    level: Fraction | None = None
    boxed: tuple[BoxPoint, ...] = ()


def points_on_components(equations: Sequence[Polynomial], seed: int, budget: Budget) -> Known[Samples] | None:
    """Samples of V(equations); `None` where every attempt meets infinitely many critical points.

    Lemma: where a function attains its minimum on a component it is critical.  A linear form does on a
    bounded curve, the distance from a point on any.  Where the system is square (n-1 equations), finitely
    many complex critical points prove that it is radical and of dimension 1 or empty.
    """
    ring = equations[0].ring
    rng = chance.random("critical points of a curve", seed)
    gradients = gradient_rows(equations)
    bounded = is_bounded(equations)
    for objective in _objectives(ring, gradients, bounded, rng):
        report("curve", f"critical points of {objective}")
        points = _critical_points(equations, gradients, objective, rng, budget)
        if points is not None:
            return with_ends(equations, objective, points, budget)
    return None


def distance_samples(
    equations: Sequence[Polynomial], near: Sequence[float], rng: Random, budget: Budget
) -> Known[Samples]:
    """Samples by the distance from a random point near another; raises `Undecided` if not isolated."""
    objective = distance_from(equations[0].ring, rng, near)
    points = _critical_points(equations, gradient_rows(equations), objective, rng, budget)
    if points is None:
        raise Undecided("the critical points of a distance are not isolated")
    return with_ends(equations, objective, points, budget)


def with_ends(
    equations: Sequence[Polynomial],
    objective: Polynomial,
    points: Known[tuple[RealPoint, ...]],
    budget: Budget,
) -> Known[Samples]:
    """Samples at these points, with the ends beyond all of them where the curve may be unbounded."""
    premises = Premises()
    own = premises.take(points)
    if is_bounded(equations):
        return premises.conclude(Samples(objective, own))
    level = level_above(objective, own)
    ends = premises.take(real_points((*equations, objective - level), budget))
    return premises.conclude(Samples(objective, own, ends, level))


def distance_from(ring: Ring, rng: Random, near: Sequence[float] = ()) -> Polynomial:
    """The squared distance from a random rational point (near one, if given), constants left out."""
    constants = {c.name for c in ring.constants}
    total = ring.zero
    for k, name in enumerate(ring.names):
        if name not in constants:
            center = Fraction(rng.randint(-40, 40), 32) + (round(near[k]) if near else 0)
            total = total + (ring.gen(name) - center) ** 2
    return total


def gradient_rows(equations: Sequence[Polynomial]) -> tuple[Row, ...]:
    """The Jacobian matrix, by rows."""
    return tuple(tuple(p.derivative(name) for name in p.ring.names) for p in equations)


def critical_determinant(gradients: Sequence[Row], objective: Polynomial, rng: Random) -> Polynomial:
    """det [J; grad objective], J replaced by n-1 random combinations of its rows where it has more.

    It vanishes wherever the Jacobian and the gradient have rank below n: a superset of the critical points.
    """
    ring = objective.ring
    rows = [*_combined(gradients, len(ring.names) - 1, rng), gradient_rows([objective])[0]]
    return determinant(PolynomialMatrix(ring, tuple(rows)))


def _critical_points(
    equations: Sequence[Polynomial],
    gradients: Sequence[Row],
    objective: Polynomial,
    rng: Random,
    budget: Budget,
) -> Known[tuple[RealPoint, ...]] | None:
    critical = critical_determinant(gradients, objective, rng)
    if critical.is_zero:
        return None
    found: list[RealPoint] = []
    premises = Premises()
    try:
        for factor in _split(critical):
            budget.check("critical points of a curve")
            found += premises.take(real_points((*equations, factor), budget))
    except NotZeroDimensional:
        return None
    return premises.conclude(tuple(found))


def _split(critical: Polynomial) -> list[Polynomial]:
    """The factors of a polynomial, but not where they would be long to find."""
    return [critical] if len(critical) > _LONGEST_FACTORED else [f for f, _ in critical.factors()]


def _objectives(ring: Ring, gradients: Sequence[Row], bounded: bool, rng: Random) -> Iterator[Polynomial]:
    """Functions to try: on bounded curves coordinates, the one whose determinant splits best first."""
    if bounded:
        ranked = []
        for name in ring.names:
            critical = critical_determinant(gradients, ring.gen(name), rng)
            if critical:
                factors = _split(critical)
                cost = max((f.total_degree for f in factors), default=0), sum(map(len, factors))
                ranked.append((cost, name))
        for _, name in sorted(ranked)[:4]:
            yield ring.gen(name)
        yield sum((g * rng.randint(1, 20) for g in ring.gens), start=ring.zero)
    for _ in range(2):
        yield distance_from(ring, rng)


def _combined(rows: Sequence[Row], count: int, rng: Random) -> tuple[Row, ...]:
    if len(rows) <= count:
        return tuple(rows)
    zero = rows[0][0].ring.zero
    return tuple(
        tuple(
            sum(column, start=zero)
            for column in zip(*[[e * k for e in row] for row, k in weighted], strict=True)
        )
        for weighted in ([(row, rng.randint(-9, 9)) for row in rows] for _ in range(count))
    )


def is_bounded(equations: Sequence[Polynomial], nonnegative: Sequence[Polynomial] = ()) -> bool:
    """Whether the real zeros are proven bounded: the quadrics among the equations say so.

    nonnegative: what is not negative where they are asked for; products of two linear ones are not either.
    Lemma: where a sum of quadrics that are zero or less has a positive definite leading form, it is bounded.

    >>> x, y = Ring(("x", "y")).gens
    >>> is_bounded([x - y], [4 - x**2]), is_bounded([x**2 - 1], [y, 2 - y]), is_bounded([x**2 - 1], [y])
    (False, True, False)
    """
    given = [*equations, *nonnegative]
    if not given:
        return False
    ring = given[0].ring
    size = len(ring.names)
    total = [[Fraction(0)] * size for _ in range(size)]
    linear = [p for p in nonnegative if p.total_degree == 1]
    signed = [(p, 0) for p in (*equations, *ring.relations)]
    signed += [(p, -1) for p in (*nonnegative, *(p * q for p, q in combinations(linear, 2)))]
    for p, only in signed:
        if p.total_degree != 2:
            continue
        form = _leading_form(p, size)
        sign = only or next((1 if form[i][i] > 0 else -1 for i in range(size) if form[i][i]), 0)
        form = [[e * sign for e in row] for row in form]
        if sign and _semidefinite(form):
            total = [[a + b for a, b in zip(u, v, strict=True)] for u, v in zip(total, form, strict=True)]
    return _semidefinite(total, definite=True)


def _leading_form(quadric: Polynomial, size: int) -> list[list[Fraction]]:
    """Twice the symmetric matrix of the terms of degree 2."""
    form = [[Fraction(0)] * size for _ in range(size)]
    for monomial, c in quadric.terms():
        if sum(monomial) == 2:
            i, j = (k for k, e in enumerate(monomial) for _ in range(e))
            value = Fraction(int(c.p), int(c.q))
            form[i][j] += value
            form[j][i] += value
    return form


def _semidefinite(form: list[list[Fraction]], definite: bool = False) -> bool:
    """Whether a symmetric matrix is positive semidefinite (or definite), by symmetric elimination."""
    rows = [list(row) for row in form]
    for i in range(len(rows)):
        pivot = rows[i][i]
        if pivot < 0 or (pivot == 0 and (definite or any(rows[i][i:]))):
            return False
        if pivot:
            for j in range(i + 1, len(rows)):
                factor = rows[j][i] / pivot
                rows[j] = [a - factor * b for a, b in zip(rows[j], rows[i], strict=True)]
    return True


def singular_points(equations: Sequence[Polynomial], budget: Budget) -> Known[tuple[RealPoint, ...]]:
    """All real points of V(equations) at which the Jacobian has rank below n-1 (all minors are taken)."""
    ring = equations[0].ring
    size = len(ring.names) - 1
    matrix = PolynomialMatrix(ring, gradient_rows(equations))
    rows, columns = (_subsets(k, size) for k in matrix.shape)
    if len(rows) * len(columns) > 400:
        raise Undecided(
            f"{len(rows) * len(columns)} minors of the Jacobian, too many to find the singular points"
        )
    minors = [determinant(matrix.select(r, c)) for r in rows for c in columns]
    return real_points((*equations, *(m for m in minors if m)), budget)


def _subsets(count: int, size: int) -> list[tuple[int, ...]]:
    return list(combinations(range(count), size))


def level_above(objective: Polynomial, points: Sequence[RealPoint]) -> Fraction:
    """A small rational above the values of the objective at the points."""
    highest = Fraction(1)
    for point in points:
        bound = objective.evaluate(point.box).upper()
        highest = max(highest, Fraction(int(bound.ceil().unique_fmpz())))
    return highest * 2 + 1


def as_balls(points: Sequence[RealPoint | BoxPoint], size: int) -> Balls:
    """Midpoints in doubles; `rad` bounds the 2-norm of the distance of the exact point, in every entry."""
    mid: Array = np.array([p.floats for p in points], dtype=float).reshape(len(points), size)
    rad = np.zeros_like(mid)
    for k, point in enumerate(points):
        distance = max(
            (abs(b - m).upper() for b, m in zip(point.box, map(float, mid[k]), strict=True)), default=0
        )
        rad[k] = float(distance) * (1 + 8 * EPSILON) * np.sqrt(size) + 1e-300
    return Balls(mid, rad)
