"""Real dimension: the complex one at a certified smooth real point, else that of the singular locus.

Source: Bochnak, Coste, Roy, Real Algebraic Geometry (1998), 2.8 and 3.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.verdict import Known, Premises
from singsym.elimination.linear_substitution import substitute_solved
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.purity import PurePiece, pure_or_whole
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.certified_point import Witness, find_witness
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.intervals import at_precision, evaluate, jacobian, rank_at_least
from singsym.varieties.real.proofs.critical_points import regular_samples
from singsym.varieties.real.proofs.emptiness import border_polynomials, is_empty_over_reals, is_excluded
from singsym.varieties.real.proofs.real_consequences import real_consequences
from singsym.varieties.real.system import RealSystem

_RANK_BITS = (64, 256)
Dimension = tuple[int, Witness | None]
"""A real dimension with a point where the set has it; (-1, None) of the empty set."""


def local_dimension(point: RealPoint | BoxPoint | Witness, piece: PurePiece) -> int | None:
    """The real dimension of a piece at a point of it, where it is a certified smooth one; else `None`.

    Independent gradients, as many as the codimension, make the set a manifold of its dimension there: a
    smaller component through the point could have as many.

    >>> from fractions import Fraction
    >>> from singsym.polynomials import Ring
    >>> from singsym.varieties.real.points.certified_point import frozen_points
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> circle = PurePiece.of(decompose([x**2 + y**2 - 1], ring=R).value[0])
    >>> local_dimension(frozen_points(R, circle.ideal.generators, {"x": Fraction(0)}).value[0], circle)
    1
    """
    place = point.point if isinstance(point, Witness) else point
    return piece.dimension if has_rank(piece.ideal.generators, place, piece.codimension) else None


def independent(equations: Sequence[Polynomial], point: RealPoint | BoxPoint) -> bool:
    """Whether the equations' gradients are certified to be independent at a point of their zero set.

    Near it the real zeros are then a manifold, of dimension the number of variables minus that of equations.

    >>> from fractions import Fraction
    >>> from singsym.polynomials import Ring
    >>> from singsym.varieties.real.points.certified_point import frozen_points
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> [
    ...     independent((f,), frozen_points(R, (f,), {"x": Fraction(0)}).value[0])
    ...     for f in (x**2 + y**2 - 1, y**2)
    ... ]
    [True, False]
    """
    return has_rank(equations, point, len(equations))


def has_rank(equations: Sequence[Polynomial], point: RealPoint | BoxPoint, rank: int) -> bool:
    """Whether so many gradients of the equations are certified to be independent at a point."""
    if not equations:
        return rank == 0
    slopes = jacobian(equations, equations[0].ring.names)
    for bits in _RANK_BITS:
        box = point.refine(bits).box
        with at_precision(bits + 64):
            if rank_at_least([[evaluate(d, box) for d in row] for row in slopes], rank):
                return True
    return False


def real_dimension(system: RealSystem, budget: Budget | None = None, *, seed: int = 0) -> Known[Dimension]:
    """The dimension of the real solution set and a point where it has it; (-1, None) where it is empty.

    Raises `Undecided` with the reason.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y", "z"))
    >>> x, y, z = R.gens
    >>> quadrics = (x**2 + y**2 + z**2 - 1, x**2 + y**2, x**2 + y**2 + z**2, x**2 + 1)
    >>> [real_dimension(RealSystem(R, (f,))).value[0] for f in (*quadrics, x**4 + y**2 - z**4 * x)]
    [2, 1, 0, -1, 2]
    """
    with current(budget).part() as limited:
        return _real_dimension(system, limited, seed)


def _real_dimension(system: RealSystem, budget: Budget, seed: int) -> Known[Dimension]:
    best: Dimension = (-1, None)
    premises = Premises()
    rest, _ = substitute_solved(system.closed_equations, _unknowns(system.ring))
    forced = premises.take(real_consequences(system, rest))
    if forced is None:
        return premises.conclude(best)
    system = replace(system, equations=(*system.equations, *forced))
    pieces = premises.take(
        decompose(
            system.closed_equations,
            system.nonzero,
            ring=system.ring,
            excluded=system.exclusions,
            budget=budget,
        )
    )
    components = premises.take(pure_or_whole(pieces, system.closed_equations, system.ring))
    for component in sorted(components, key=lambda c: -c.dimension):
        if component.dimension <= best[0]:
            continue
        found = premises.take(component_dimension(component, system, budget, seed=seed))
        best = max(best, found, key=lambda pair: pair[0])
    return premises.conclude(best)


def _unknowns(ring: Ring) -> list[str]:
    constants = {c.name for c in ring.constants}
    return [name for name in ring.names if name not in constants]


def component_dimension(
    component: Component, system: RealSystem, budget: Budget | None = None, *, seed: int = 0
) -> Known[Dimension]:
    """The same for one component in place of the system's equations, which are used where they hold on it.

    Raises `Undecided` also where the component is not proven to have one dimension.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> circle = decompose([x**2 + y**2 - 1], ring=R).value[0]
    >>> component_dimension(circle, RealSystem(R, (), positive=(x,))).value[0]
    1
    """
    budget, premises = current(budget), Premises()
    if premises.take(is_excluded(component, system)):
        return premises.conclude((-1, None))
    piece = replace(system, equations=component.generators)
    if component.dimension == 0:
        return premises.pass_on(_zero_or_empty(piece, budget, seed))
    pure = PurePiece.of(component)
    # where the inequalities are strict they are open and do not touch the dimension
    boundaries = tuple(p for p in system.nonnegative if not premises.take(component.vanishes(p)))
    strict = replace(piece, positive=(*system.positive, *boundaries), nonnegative=())
    found = find_witness(strict, seed=seed, tries=8, dimension=component.dimension, budget=budget)
    if found is not None and local_dimension(found, pure) is not None:
        return premises.conclude((component.dimension, found))
    borders = premises.take(border_polynomials(component, strict))
    points, singular = premises.take(regular_samples(pure, system.closed_equations, budget, nonzero=borders))
    point = next((p for p in points if strict.admits(p)), None)
    if point is not None:
        return premises.conclude((component.dimension, Witness(point)))
    smaller = [singular.generators, *((*component.generators, p) for p in boundaries)]
    parts = [premises.take(real_dimension(replace(system, equations=e), budget, seed=seed)) for e in smaller]
    return premises.conclude(max(parts, key=lambda pair: pair[0]))


def _zero_or_empty(system: RealSystem, budget: Budget, seed: int) -> Known[Dimension]:
    verdict = is_empty_over_reals(system, budget, seed=seed)
    if verdict.is_undecided:
        raise Undecided(verdict.reason)
    return Known((-1, None), verdict.certainty) if verdict.is_yes else Known((0, verdict.witness))
