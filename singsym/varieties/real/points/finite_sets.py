"""All real points of a zero-dimensional system, complete and exact.

Source: Faugere et al. (1993) and Rouillier (1999), see quotient.py and parametrization.py; msolve
(https://msolve.lip6.fr) where it is there, for Groebner bases and parametrisations that are checked here.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice
from math import lcm
from typing import Any

from flint import fmpq_mpoly, fmpz_mpoly_vec, fmpz_poly

from singsym.effort.attempts import cut_short
from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.chance import PRIMES, random_primes
from singsym.effort.processor_time import worked
from singsym.effort.verdict import Known, Premises
from singsym.elimination import engines
from singsym.elimination.basis import canonical, groebner_basis
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.elimination.engines.msolve import RawParametrization
from singsym.elimination.engines.registry import msolve, over_rationals
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import is_known, remember
from singsym.polynomials import AlgebraicConstant, Polynomial, Ring
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.completeness import is_complete
from singsym.varieties.real.points.exact_point import RealPoint, real_points_of
from singsym.varieties.real.points.macaulay_algebra import quotient_algebra_over
from singsym.varieties.real.points.parametrization import Parametrization, divides, parametrize
from singsym.varieties.real.points.quotient_algebra import (
    Algebra,
    Check,
    commuting,
    quotient_algebra,
    reduced,
)

__all__ = ["parametrized", "pinned", "real_points"]

# (polynomials, terms of each, bits of a coefficient) up to which FLINT computes a basis in this process
_CAPS = (150, 500, 1500)

# bits of arithmetic, some seconds, above which a "modular" answer is checked modulo primes only
_EXACT_COST = 2e9

# the same of all these equations together, above which they are not checked for a proof either
_PROOF_COST = 1e11


def real_points(
    equations: Ideal | Sequence[Polynomial], budget: Budget | None = None
) -> Known[tuple[RealPoint, ...]]:
    """All real points of a zero-dimensional system, in increasing order of the coordinates.

    Each is a point of it; the certainty is that of there being no others.
    equations: an `Ideal`, or polynomials of one ring; the relations of the ring's constants are added, and
    points with a conjugate of a constant are dropped.  Multiplicities are not told.  A ring without variables
    has one point.
    Raises `NotZeroDimensional` where there are infinitely many complex points, `Undecided` out of budget.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> [p.decimals(4) for p in real_points([x**2 + y**2 - 4, x - y]).value]
    [{'x': '-1.414', 'y': '-1.414'}, {'x': '1.414', 'y': '1.414'}]
    """
    points = parametrized(equations, budget).map(real_points_of)
    return points.map(lambda found: tuple(p for p in found if pinned(p, p.ring.constants)))


def parametrized(
    equations: Ideal | Sequence[Polynomial], budget: Budget | None = None
) -> Known[Parametrization]:
    """All complex points of a zero-dimensional system as functions of the roots of one polynomial.

    FLINT's basis first where it takes milliseconds, then msolve's parametrisation where it is there, then the
    easy equations' basis with the hard ones by linear algebra, then any engine's basis.  Every point is
    proven by substitution, modulo primes where that is too dear and the certainty stays "modular"; it is
    "proven" where that none is missing is proven.
    """
    budget = current(budget)
    if not isinstance(equations, Ideal):
        if not equations:
            raise NotZeroDimensional("no equations: the whole space")
        equations = Ideal(equations[0].ring, equations)
    ring = equations.ring.with_names(equations.ring.names, "degrevlex")
    system = canonical(ring, (*map(ring.convert, equations.generators), *ring.relations))
    if not system:
        if ring.names:
            raise NotZeroDimensional("only zero equations: the whole space")
        return Known(Parametrization(ring, fmpz_poly([0, 1]), fmpz_poly([1]), ()))
    return remember("points", (ring, frozenset(system)), lambda: _solve(ring, system, budget), budget)


def _solve(ring: Ring, system: tuple[Polynomial, ...], budget: Budget) -> Known[Parametrization]:
    def check() -> None:
        budget.check("the quotient algebra of a zero-dimensional system")

    known = is_known("groebner", (ring, frozenset(system)), budget)
    if not known and "flint" in engines.allowed():
        whole = _capped_basis(ring, system)
        if whole is not None:
            return Known(_from_basis(ring, whole, system, check))
    if not known and engines.has("msolve"):
        start = worked()
        found = _by_msolve(ring, system, budget)
        if found is not None:
            complete = _is_known_complete(found, system, worked() - start, check)
            return Known(found, "proven" if complete else "modular")
    elif not known and "flint" in engines.allowed():
        easy, hard = _easy_part(ring, system)
        algebra = quotient_algebra_over(Ideal(ring, easy), hard, check) if easy else Known(None)
        found = None if algebra.value is None else _points(algebra.value, system, check)
        if found is not None:
            return Known(found, algebra.certainty)
    premises = Premises()
    basis = premises.take(groebner_basis(ring, system, budget))
    return premises.conclude(_from_basis(ring, basis.polynomials, system, check))


def _from_basis(
    ring: Ring, basis: Sequence[Polynomial], system: Sequence[Polynomial], check: Check
) -> Parametrization:
    found = _points(quotient_algebra(ring, basis, check), system, check)
    if found is None:
        raise Undecided("no linear form was found that separates the complex points")
    return found


def _points(algebra: Algebra, system: Sequence[Polynomial], check: Check) -> Parametrization | None:
    found = parametrize(algebra, system, check=check)
    if found is None and commuting(algebra):
        found = parametrize(reduced(algebra, check), system, check=check)
    return found


def _easy_part(ring: Ring, system: Sequence[Polynomial]) -> tuple[tuple[Polynomial, ...], list[Polynomial]]:
    """The Groebner basis of the equations that FLINT takes milliseconds for, and the other equations."""
    basis: tuple[Polynomial, ...] = ()
    hard = []
    for f in sorted(system, key=lambda f: (f.total_degree, len(f))):
        grown = _capped_basis(ring, (*basis, f))
        if grown is None:
            hard.append(f)
        else:
            basis = grown
    return basis, hard


def _capped_basis(ring: Ring, system: Sequence[Polynomial]) -> tuple[Polynomial, ...] | None:
    vector: Any = fmpz_mpoly_vec([f.integer() for f in system], ring.integer_context)
    basis, done = vector.buchberger_naive(limits=_CAPS)
    return tuple(Polynomial(ring, fmpq_mpoly(p)).primitive() for p in basis.autoreduction()) if done else None


def _by_msolve(ring: Ring, system: Sequence[Polynomial], budget: Budget) -> Parametrization | None:
    """msolve's parametrisation with every point proven by substitution; `None` where that fails."""
    try:
        raw = msolve.parametrization(system, ring, budget=budget)
    except engines.EngineFailure:
        cut_short("real points by msolve")
        budget.check("real points by msolve")
        return None
    if raw is None:
        one, none = fmpz_poly([1]), fmpz_poly([])
        return Parametrization(ring, one, one, (none,) * len(ring.names))
    found, separating = _read(ring, raw)
    return found if separating and all(_holds(found, f, budget) for f in system) else None


def _is_known_complete(
    found: Parametrization, system: tuple[Polynomial, ...], work: float, check: Check
) -> bool:
    """Whether these are proven to be all points, where a basis over Q is found quickly.

    work: what the search for them took; `_holds` has checked other equations exactly.
    """
    dear = [f for f in system if found.cost_of(f) >= _EXACT_COST]
    if sum(map(found.cost_of, dear)) > _PROOF_COST:
        return False
    task = engines.Task("groebner", found.ring, system)
    basis = over_rationals(task, work, short=found.minimal.degree() == 0)
    return (
        basis is not None and is_complete(found, basis, check) and all(found.vanishes(f, check) for f in dear)
    )


def _holds(found: Parametrization, equation: Polynomial, budget: Budget) -> bool:
    """Whether an equation holds at all points: exactly, or modulo primes where that is too dear."""
    if found.cost_of(equation) < _EXACT_COST:
        return found.vanishes(equation, lambda: budget.check("the substitution of points"))
    answers = (found.vanishes_modulo(equation, p) for p in random_primes("points", equation, bits=62))
    return all(islice((answer for answer in answers if answer is not None), PRIMES))


def _read(ring: Ring, raw: RawParametrization) -> tuple[Parametrization, bool]:
    """msolve's answer in our form, and whether different roots are proven to give different points."""
    common = lcm(*raw.divisors)
    minimal = fmpz_poly(list(raw.minimal))
    denominator = fmpz_poly(list(raw.denominator)) * common
    numerators = [fmpz_poly([])] * len(ring.names)
    root = fmpz_poly([0, 1]) * denominator
    for place, n, d in zip(raw.order, raw.numerators, raw.divisors, strict=False):
        numerators[place] = fmpz_poly(list(n)) * (-common // d)
    form = fmpz_poly([])
    if len(raw.numerators) < len(raw.order):
        numerators[raw.order[-1]] = form = root
    else:
        for place, w in zip(raw.order, raw.form, strict=False):
            form = form + numerators[place] * w
    content = minimal.content()
    minimal = fmpz_poly([c // content for c in minimal.coeffs()])
    separating = any(divides(minimal, form - s * root) for s in (1, -1))
    squarefree = minimal.gcd(minimal.derivative()).degree() == 0
    return Parametrization(ring, minimal, denominator, tuple(numerators)), separating and squarefree


def pinned(point: RealPoint | BoxPoint, constants: Sequence[AlgebraicConstant]) -> bool:
    """Whether each algebraic constant has its own value at the point, not that of a conjugate."""
    return all(
        point.sign(point.ring.gen(c.name) - c.low) >= 0 and point.sign(point.ring.gen(c.name) - c.high) <= 0
        for c in constants
    )
