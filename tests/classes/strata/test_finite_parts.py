"""Ranks at points that are known by boxes."""

from __future__ import annotations

import pytest

from singsym.classes.strata.finite_parts import defects_of_points
from singsym.classes.strata.ranks import RankProblem
from singsym.classes.taxonomy.types import Defects
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y"))
x, y = R.gens
POINT = RealSystem(R, (x**2 - 2, y - x))
"""Two points, (sqrt 2, sqrt 2) and its opposite."""


def problem(*rows: list[Polynomial]) -> RankProblem:
    """The first column the output's, the second the input's, no passive ones."""
    whole = PolynomialMatrix.of(R, rows)
    parts = {
        "L_I": whole.select(columns=[0]),
        "L_O": whole.select(columns=[1]),
        "L_p": whole.select(columns=[]),
    }
    return RankProblem({"L": whole, **parts}, 0, 1, 1)


def test_full_rank_is_seen_in_balls() -> None:
    found = defects_of_points(problem([x, y]), POINT, {})
    assert found is not None
    assert (found.value, found.certainty) == (frozenset([Defects(0, 0, 0, 0)]), "proven")


def test_a_lower_rank_is_proven_by_an_equation() -> None:
    """y - x is zero at both points, and an equation; x is not zero."""
    found = defects_of_points(problem([x, y - x]), POINT, {})
    assert found is not None
    assert found.value == frozenset([Defects(0, 0, 0, 1)])


def test_a_rank_that_only_seems_lower_is_not_decided() -> None:
    """x y - 2 is zero at both points, which no equation says by itself."""
    assert defects_of_points(problem([x, x * y - 2]), POINT, {}) is None


def test_points_outside_the_feasible_set_do_not_count() -> None:
    off = RealSystem(R, POINT.equations, positive=(x - 3,))
    found = defects_of_points(problem([x, y]), off, {})
    assert found is not None
    assert found.value == frozenset()


@pytest.mark.parametrize("equations", [(x**2 - 2,), (x**2 - y, y**2 + x - 3)], ids=["a line", "one module"])
def test_what_is_no_finite_part_of_modules(equations: tuple[Polynomial, ...]) -> None:
    assert defects_of_points(problem([x, y]), RealSystem(R, equations), {}) is None
