"""Parts of a configuration space that are finitely many points: solved by modules, ranked point by point.

Source: ranks from below by a regular minor in balls (Neumaier, Interval Methods for Systems of Equations,
1990, 4.1), from above by what is known of the loci that led there.
"""

from __future__ import annotations

from collections.abc import Mapping

from singsym.classes.strata.block_rank import bordered
from singsym.classes.strata.ranks import RankProblem
from singsym.classes.taxonomy.types import Defects
from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided
from singsym.effort.verdict import Known
from singsym.minors.determinant import determinant
from singsym.polynomials import PolynomialMatrix
from singsym.varieties.real.modules.module_points import comes_apart, module_points
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.intervals import at_precision, evaluate, pivots, rank_at_least
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
    """Those at one point; raises `Undecided` where a rank is not seen.

    Lemma: k_I and k_O are not less than p and delta (Table 1), which are 0 where one of them is.
    """

    def defect(name: str) -> int:
        most = problem.full(name) - defect_bounds.get(name, 0)
        return problem.full(name) - _rank(problem.matrices[name], most, point)

    k_I, k_O = defect("L_I"), defect("L_O")
    both = k_I > 0 and k_O > 0
    return Defects(defect("L") if both else 0, defect("L_p") if both else 0, k_I, k_O)


def _rank(matrix: PolynomialMatrix, most: int, point: BoxPoint) -> int:
    """The rank of a matrix at a point, where it is known to be this at most; raises `Undecided`.

    Lemma (Kronecker): it is r where an r-minor is not zero, and all (r+1)-minors that border it are.
    """
    if any(_has_rank(matrix, most, point, bits) for bits in _BITS):
        return most
    rows, columns = pivots([[float(e) for e in row] for row in matrix.evaluate(point.floats)])
    for r, c in bordered(matrix.shape, rows, columns):
        minor = determinant(matrix.select(r, c))
        if minor and not any(point.is_known_zero(factor) for factor, _ in minor.factors()):
            raise Undecided("whether a minor is zero at a point is not seen")
    # of the same minor: another one that is not zero would not do
    if rows and not _has_rank(matrix.select(rows, columns), len(rows), point, _BITS[-1]):
        raise Undecided("whether a minor is not zero at a point is not seen")
    return len(rows)


def _has_rank(matrix: PolynomialMatrix, rank: int, point: BoxPoint, bits: int) -> bool:
    """Whether a matrix is proven to have at least this rank in a box of so many bits around a point."""
    box = point.refine(bits).box
    with at_precision(bits + 64):
        return rank_at_least([[evaluate(e, box) for e in row] for row in matrix.rows], rank)
