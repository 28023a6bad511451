"""All real points of a zero-dimensional system, complete and exact.

Source: Faugere et al. (1993) and Rouillier (1999), see quotient.py and parametrization.py; msolve
(https://msolve.lip6.fr) where it is there, for Groebner bases and parametrisations that are checked here.
"""

from __future__ import annotations

from collections.abc import Sequence

from singsym.elimination.basis import groebner_basis
from singsym.elimination.budget import Budget, Undecided, current
from singsym.elimination.ideal import Ideal
from singsym.polynomials import AlgebraicConstant, Polynomial
from singsym.varieties.real.parametrization import Parametrization, parametrize
from singsym.varieties.real.points import RealPoint, real_points_of
from singsym.varieties.real.quotient import NotZeroDimensional, quotient_algebra, reduced

__all__ = ["NotZeroDimensional", "pinned", "real_points", "solve"]


def real_points(
    equations: Ideal | Sequence[Polynomial], budget: Budget | None = None
) -> tuple[RealPoint, ...]:
    """All real points of a zero-dimensional system, in increasing order of the coordinates.

    equations: an `Ideal`, or polynomials of one ring; the relations of the ring's constants are added, and
    points with a conjugate of a constant are dropped.  Multiplicities are not told.
    Raises `NotZeroDimensional` where there are infinitely many complex points, `Undecided` out of budget.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> [p.decimals(4) for p in real_points([x**2 + y**2 - 4, x - y])]
    [{'x': '-1.414', 'y': '-1.414'}, {'x': '1.414', 'y': '1.414'}]
    """
    generators = equations.generators if isinstance(equations, Ideal) else tuple(equations)
    if not generators:
        raise NotZeroDimensional("no equations: the whole space")
    ring = generators[0].ring
    points = real_points_of(solve(generators, budget))
    return tuple(p for p in points if pinned(p, ring.constants))


def solve(equations: Sequence[Polynomial], budget: Budget | None = None) -> Parametrization:
    """All complex points of a zero-dimensional system as functions of the roots of one polynomial, proven."""
    budget = current(budget)
    ring = equations[0].ring.with_names(equations[0].ring.names, "degrevlex")
    system = [g for g in (*map(ring.convert, equations), *ring.relations) if not g.is_zero]
    if not system:
        raise NotZeroDimensional("only zero equations: the whole space")

    def check() -> None:
        budget.check("the quotient algebra of a zero-dimensional system")

    basis = groebner_basis(ring, system, budget)
    algebra = quotient_algebra(ring, basis.polynomials, check)
    found = parametrize(algebra, system, check=check)
    if found is None:
        found = parametrize(reduced(algebra, check), system, check=check)
    if found is None:
        raise Undecided("no linear form was found that separates the complex points")
    return found


def pinned(point: RealPoint, constants: Sequence[AlgebraicConstant]) -> bool:
    """Whether each algebraic constant has its own value at the point, not that of a conjugate."""
    return all(
        point.sign(point.ring.gen(c.name) - c.low) >= 0 and point.sign(point.ring.gen(c.name) - c.high) <= 0
        for c in constants
    )
