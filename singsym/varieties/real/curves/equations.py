"""Equations of a curve fit for tracking: reduced, of dimension 1 at every point, isolated points apart.

Source: Krull's height theorem and the unmixedness of complete intersections (Eisenbud, Commutative Algebra,
18.14); everything else through the decomposition into components.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Known, Premises
from singsym.elimination.ideal import Ideal, intersection
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points


@dataclass(frozen=True)
class CurveEquations:
    """Equations whose complex zeros have dimension 1 everywhere, and the isolated points left out of them."""

    equations: tuple[Polynomial, ...]
    points: tuple[RealPoint, ...] = ()


def candidates(
    ring: Ring, generators: tuple[Polynomial, ...], budget: Budget
) -> Iterator[Known[CurveEquations]]:
    """Systems to try in turn; one with finitely many critical points is reduced.

    With n-1 equations every component has dimension at least 1, and finitely many critical points prove
    dimension 1.  With more, or where that fails, the system is decomposed first.
    Raises `NotACurve` naming the dimension where it is not 1.
    """
    size, premises = len(ring.names), Premises()
    equations = tuple(
        dict.fromkeys(p.squarefree_part() for p in (*generators, *ring.relations) if not p.is_zero)
    )
    if any(p.is_constant for p in equations):
        yield Known(CurveEquations(()))
        return
    if len(equations) < size - 1:
        dimension = premises.take(Ideal(ring, equations).dimension)
        if dimension < 0:
            yield premises.conclude(CurveEquations(()))
            return
        _refuse(dimension, len(ring.constants))
    if len(equations) == size - 1:
        yield Known(CurveEquations(equations))
    pieces = premises.take(decompose(equations, ring=ring, budget=budget))
    if not pieces:
        yield premises.conclude(CurveEquations(()))
        return
    dimension = max(p.dimension for p in pieces)
    if dimension != 1:
        _refuse(dimension, 0)
    curves = [p for p in pieces if p.dimension == 1]
    if not all(p.is_pure for p in curves):
        raise Undecided("a part of the curve is not proven to have one dimension: it may hide points")
    points = premises.take(_isolated(pieces, curves, budget))
    if len(equations) > size - 1 and not points:
        yield premises.conclude(CurveEquations(equations))
    union = premises.take(intersection(ring, (p.ideal for p in curves), budget))
    basis = premises.take(union.groebner_basis(budget))
    yield premises.conclude(CurveEquations(basis, points))


class NotACurve(ValueError):
    """Raised where a curve is expected and the complex dimension is another."""


def _refuse(dimension: int, constants: int) -> None:
    what = f"dimension {dimension}" + (" with its constants as variables" if constants else "")
    raise NotACurve(
        f"a curve (dimension 1) is expected, the system has complex {what}: add or remove equations"
    )


def _isolated(
    pieces: tuple[Component, ...], curves: list[Component], budget: Budget
) -> Known[tuple[RealPoint, ...]]:
    """The real points of the 0-dimensional pieces that lie on no curve."""
    found: list[RealPoint] = []
    premises = Premises()
    for piece in pieces:
        if piece.dimension == 0:
            for point in premises.take(real_points(piece.generators, budget)):
                on_curve = any(all(point.sign(g) == 0 for g in c.generators) for c in curves)
                if not on_curve and not any(point.coincides(p) for p in found):
                    found.append(point)
    return premises.conclude(tuple(found))
