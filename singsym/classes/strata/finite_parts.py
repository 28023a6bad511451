"""Parts of a configuration space that are finitely many points: solved by modules, ranked point by point.

Source: ranks from below by a regular minor in balls (Neumaier, Interval Methods for Systems of Equations,
1990, 4.1), from above by what is known of the loci that led there.
"""

from __future__ import annotations

from collections.abc import Mapping

from singsym.classes.strata.ranks import RankProblem
from singsym.classes.taxonomy.types import Defects
from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided
from singsym.effort.verdict import Known
from singsym.polynomials import PolynomialMatrix
from singsym.varieties.real.modules.module_points import comes_apart, module_points
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.intervals import at_precision, evaluate, rank_at_least
from singsym.varieties.real.system import RealSystem

_BITS = (64, 256, 1024)
"""Of the boxes in which a rank is looked at, one after the other."""


def defects_of_points(
    problem: RankProblem, system: RealSystem, defect_bounds: Mapping[str, int]
) -> Known[frozenset[Defects]] | None:
    """The defects that occur in a set of finitely many points; `None` where this is not found out.

    defect_bounds: how far at least each matrix is below full rank at all of the points.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> row = PolynomialMatrix.of(R, [[x, y]])
    >>> parts = {name: row.select(columns=c) for name, c in (("L_I", [0]), ("L_O", [1]), ("L_p", []))}
    >>> problem = RankProblem({"L": row, **parts}, 0, 1, 1)
    >>> defects_of_points(problem, RealSystem(R, (x**2 - 1, y)), {"L_O": 1}).value
    frozenset({Defects(delta=0, p=0, k_I=0, k_O=1)})
    """
    equations = system.closed_equations
    if len(equations) < len(system.ring.names) or not comes_apart(equations):
        return None
    with attempt("points of a part", patience.POINTS_BY_MODULES.work):
        points = module_points(equations)
        admitted = [p for p in points.value if system.admits(p)]
        return Known(frozenset(_defects(problem, p, defect_bounds) for p in admitted), points.certainty)
    return None


def _defects(problem: RankProblem, point: BoxPoint, defect_bounds: Mapping[str, int]) -> Defects:
    """Those at one point; raises `Undecided` where a rank is not seen to be as large as it may be.

    Lemma: k_I and k_O are not less than p and delta (Table 1), which are 0 where one of them is.
    """

    def defect(name: str) -> int:
        known = defect_bounds.get(name, 0)
        if not _has_rank(problem.matrices[name], problem.full(name) - known, point):
            raise Undecided(f"the rank of {name} at a point is not seen")
        return known

    k_I, k_O = defect("L_I"), defect("L_O")
    both = k_I > 0 and k_O > 0
    return Defects(defect("L") if both else 0, defect("L_p") if both else 0, k_I, k_O)


def _has_rank(matrix: PolynomialMatrix, rank: int, point: BoxPoint) -> bool:
    """Whether a matrix is proven to have at least this rank at a point."""

    def seen(bits: int) -> bool:
        box = point.refine(bits).box
        with at_precision(bits + 64):
            return rank_at_least([[evaluate(e, box) for e in row] for row in matrix.rows], rank)

    return any(map(seen, _BITS))
