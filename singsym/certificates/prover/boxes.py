"""A point of a set in a box, as the leaf `ranks` has it, and the dimension that it shows.

Source: Newton's method from numerical points, which prove nothing; the checker's Krawczyk test does.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from decimal import Decimal
from fractions import Fraction
from itertools import islice
from typing import Any

from flint import arb, arb_mat, ctx, fmpq, fmpq_mpoly

from singsym.certificates.checker.polynomials import Rejected, remainder, ring
from singsym.certificates.checker.sets import RealSet
from singsym.certificates.checker.strata import BITS, INVERSE, dimension_below
from singsym.certificates.prover.multipliers import multipliers
from singsym.certificates.prover.traced_basis import traced_basis
from singsym.effort.attempts import attempt
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.numerical.sampling import numerical_points
from singsym.varieties.real.system import RealSystem

GRIDS = (8, 64, 2**12, 2**24)
"""Coordinates that are held are rounded to one over one of these."""
STEPS = 12
MOST_LOCALS, MOST_TERMS = 5, 200
DIGITS = 30
RADIUS = Fraction(1, 10**20)
FOLLOWS, QUOTIENT = 20.0, 5.0
"""Seconds of work in which the other equations are to follow from the square system, and to find where."""


def point_leaf(at: RealSet, near: Sequence[Sequence[float]]) -> tuple[dict[str, Any], int] | None:
    """A point of a set, and the dimension of the set near it; None where none is found.

    near: numerical points that may be of it; others are looked for where none of them is.
    """
    shortest = by_length(at.equations)
    orders = (shortest, sorted(shortest, key=lambda k: at.equations[k] not in at.generators))
    for start in _starts(at, near):
        ways = [independent(at, start, order) for order in orders]
        # where all generators are taken nothing has to follow from them
        ways.sort(key=lambda way: bool(_others(at, way[0])))
        for rows, columns in ways:
            boxed = [data for grid in GRIDS if (data := _boxed(at, start, rows, columns, grid)) is not None]
            implied = implied_by(at, rows, start) if boxed and _others(at, rows) else {}
            if implied is None:
                break
            for data in boxed:
                shown = data | ({"implied": implied} if implied else {})
                with suppress(Rejected):
                    return shown, dimension_below(at, shown)
    return None


def _starts(at: RealSet, near: Sequence[Sequence[float]]) -> Iterator[Sequence[float]]:
    system = _system(at)
    yield from (point for point in near if _seems_in(system, point))
    yield from numerical_points(system)


def seems_in(at: RealSet, points: Sequence[Sequence[float]]) -> bool:
    """Whether one of some numerical points seems to be of a set."""
    system = _system(at)
    return any(_seems_in(system, point) for point in points)


def _system(at: RealSet) -> RealSystem:
    own = Ring(at.variables)

    def raised(polynomials: Sequence[fmpq_mpoly]) -> tuple[Polynomial, ...]:
        return tuple(Polynomial(own, p) for p in polynomials)

    exclusions = tuple((p,) for p in raised(at.units))
    equations = raised([e for e in at.equations if e])
    return RealSystem(own, equations, exclusions, raised(at.positive), raised(at.nonnegative))


def _seems_in(system: RealSystem, point: Sequence[float]) -> bool:
    small = all(abs(e.evaluate(point)) < 1e-6 * _largest(e, point) for e in system.equations)
    off = all(is_off(unit.value, point) for (unit,) in system.exclusions)
    return small and off and all(p.evaluate(point) > 0 for p in (*system.positive, *system.nonnegative))


def _largest(f: Polynomial, point: Sequence[complex]) -> float:
    """The size of the largest term at a point, at least 1."""
    sizes = [1.0]
    for exponents, coefficient in f.terms():
        size = abs(float(coefficient.p) / float(coefficient.q))
        for x, e in zip(point, exponents, strict=True):
            size *= abs(x) ** int(e)
        sizes.append(size)
    return max(sizes)


def by_length(equations: Sequence[fmpq_mpoly]) -> list[int]:
    """Places of equations, those of low degree and few terms first."""
    return sorted(range(len(equations)), key=lambda k: _length(equations[k]))


def _length(f: fmpq_mpoly) -> tuple[int, int]:
    return int(f.total_degree()), len(f)


def independent(at: RealSet, point: Sequence[complex], order: Sequence[int]) -> tuple[list[int], list[int]]:
    """The first equations in an order with independent gradients, and as many variables to be solved for."""
    import numpy

    own = Ring(at.variables)
    slopes = [[Polynomial(own, e.derivative(i)) for i in range(len(point))] for e in at.equations]
    gradients = [[complex(slope.evaluate(point)) for slope in row] for row in slopes]
    rows: list[int] = []
    basis: list[Any] = []
    for k in order:
        vector = numpy.array(gradients[k])
        size = numpy.linalg.norm(vector)
        for b in basis:
            vector = vector - numpy.vdot(b, vector) * b
        if size and numpy.linalg.norm(vector) > 1e-6 * size:
            rows.append(k)
            basis.append(vector / numpy.linalg.norm(vector))
    left = numpy.array([gradients[k] for k in rows]).reshape(len(rows), len(point))
    columns: list[int] = []
    for _ in rows:
        j = int(numpy.argmax(numpy.abs(left).max(axis=0)))
        i = int(numpy.argmax(numpy.abs(left[:, j])))
        columns.append(j)
        left = left - numpy.outer(left[:, j] / left[i, j], left[i])
        left[i] = 0
    return rows, sorted(columns)


def _boxed(
    at: RealSet, start: Sequence[float], rows: list[int], columns: list[int], grid: int
) -> dict[str, Any] | None:
    """The box near a numerical point, the other coordinates held at rationals; None if Newton fails."""
    names = at.variables
    fixed = {k: Fraction(round(start[k] * grid), grid) for k in range(len(names)) if k not in columns}
    own = Ring(at.variables)
    equations = [Polynomial(own, at.equations[k]) for k in rows]
    gradients = [[e.derivative(names[j]) for j in columns] for e in equations]
    with ctx.workprec(BITS):
        held = {k: arb(fmpq(*value.as_integer_ratio())) for k, value in fixed.items()}
        values = [held.get(k, arb(x)) for k, x in enumerate(start)]
        for _ in range(STEPS if rows else 0):
            slope = arb_mat([[arb(g.evaluate(values)) for g in row] for row in gradients])
            try:
                step = slope.solve(arb_mat([[arb(e.evaluate(values))] for e in equations]))
            except ZeroDivisionError:
                return None
            for i, j in enumerate(columns):
                values[j] = (values[j] - step[i, 0]).mid()
        if not all(abs(values[j] - arb(start[j])) < 0.5 for j in columns):
            return None
        centre = {names[j]: _text(Fraction(Decimal(values[j].str(DIGITS, radius=False)))) for j in columns}
    return {
        "fixed": {names[k]: _text(value) for k, value in fixed.items()},
        "centre": centre,
        "radius": _text(RADIUS),
        "square": rows,
    }


def _text(value: Fraction) -> str:
    return str(value)


def _others(at: RealSet, rows: Sequence[int]) -> list[fmpq_mpoly]:
    """The generators that are not among some equations."""
    own = [at.equations[k] for k in rows]
    return [g for g in at.generators if g and g not in own]


def implied_by(at: RealSet, rows: Sequence[int], near: Sequence[complex]) -> dict[str, Any] | None:
    """How other generators follow from the square system off the zeros of a polynomial, if they do.

    near: a point at which that polynomial does not vanish.
    """
    larger, own = ring([INVERSE, *at.variables]), Ring((INVERSE, *at.variables))
    gen = larger.gens()[0]
    square = [at.equations[k].project_to_context(larger) for k in rows]
    others = [g.project_to_context(larger) for g in _others(at, rows)]
    for local in islice((f for f in _locals(at, rows) if is_off(f, near)), MOST_LOCALS):
        start = [*square, 1 - gen * local.project_to_context(larger)]
        ideal = Ideal(own, [Polynomial(own, f) for f in start])
        with attempt("that equations follow from others", FOLLOWS) as budget:
            # an engine is asked first, as steps take much longer to find
            if all(ideal.contains(Polynomial(own, g)).value for g in others):
                target = [tuple(map(int, m)) for m in ideal.leading_monomials().value]
                found = traced_basis(start, budget, target)
                if not any(remainder(g, found.basis) for g in others):
                    return {"local": str(local), "steps": found.steps, "equations": found.equations}
    return None


def is_off(f: fmpq_mpoly, point: Sequence[complex]) -> bool:
    """Whether a polynomial is not zero at a numerical point."""
    own = Polynomial(Ring(f.context().names()), f)
    return bool(abs(own.evaluate(point)) > 1e-6 * _largest(own, point))


def _locals(at: RealSet, rows: Sequence[int]) -> Iterator[fmpq_mpoly]:
    """Polynomials off whose zeros the equations may be those of a square system.

    1; the product of the units; polynomials whose products with the other generators are in the square's
    ideal, those of low degree first.
    """
    units = at.context.constant(1)
    yield units
    for unit in at.units:
        units = units * unit
    if len(units) < MOST_TERMS:
        yield units
    with attempt("a quotient of ideals", QUOTIENT):
        yield from multipliers([at.equations[k] for k in rows], _others(at, rows))
