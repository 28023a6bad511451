"""Rank strata on small matrices whose ranks are known by hand."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.classes.strata import Ground, RankProblem, block_rank, pivots, relevant, stratum
from singsym.classes.types import Defects, feasible_defects
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.varieties.decomposition import decompose

R = Ring(("x", "y"))
x, y = R.gens


def ground(*equations: Polynomial) -> Ground:
    (component,) = decompose(equations, ring=R)
    return Ground(component)


def test_rank_of_a_matrix_on_the_plane_and_on_a_line() -> None:
    """diag(x, y): rank 2 off xy = 0; on y = 0 rank 1 off x = 0."""
    matrix = PolynomialMatrix.of(R, [[x, 0], [0, y]])
    assert block_rank(matrix, ground()).rank == 2
    assert block_rank(matrix, ground()).minors == (x * y,)
    assert block_rank(matrix, ground(y)).rank == 1
    assert block_rank(matrix, ground(y)).minors == (x,)


def test_rank_that_never_drops_needs_no_minors() -> None:
    matrix = PolynomialMatrix.of(R, [[1, x], [y, 0]])
    assert block_rank(matrix, ground(x)).minors == ()
    assert block_rank(PolynomialMatrix.of(R, [[0, 0]]), ground()).rank == 0


def test_rank_on_a_reducible_set_that_is_not_known_to_be_prime() -> None:
    """On x y = 0, taken whole, the matrix (x) vanishes on one of two lines: its rank is 1 off that line."""
    found = block_rank(PolynomialMatrix.of(R, [[x]]), ground(x**2 - 2 * y**2))
    assert (found.rank, found.minors) == (1, (x,))


@given(st.lists(st.lists(st.integers(-2, 2), min_size=3, max_size=3), min_size=2, max_size=4))
@settings(max_examples=50, deadline=None)
def test_pivots_have_numpys_rank(rows: list[list[int]]) -> None:
    matrix = [[float(e) for e in row] for row in rows]
    chosen = pivots(matrix)
    rank = np.linalg.matrix_rank(np.array(matrix))
    assert len(chosen[0]) == len(chosen[1]) == rank
    if rank:
        assert abs(np.linalg.det(np.array(matrix)[np.ix_(*chosen)])) > 1e-9


def test_defects_sum_blocks_and_constants() -> None:
    """N = 2, n = 1: L has a unit and the row (x y), L_I the row (x), L_O (y), L_p nothing."""
    row = PolynomialMatrix.of(R, [[x, y]])
    problem = RankProblem(
        {},
        0,
        {"L": (row,), "L_I": (row.select(columns=[0]),), "L_O": (row.select(columns=[1]),), "L_p": ()},
        {"L": 1, "L_I": 1, "L_O": 1, "L_p": 1},
        2,
        1,
    )
    plane = stratum(problem, ground())
    assert plane.defects == Defects(0, 0, 0, 0)
    assert plane.loci == {"L_I": ((x,),), "L_O": ((y,),)}
    line = stratum(problem, ground(x))
    assert line.defects == Defects(0, 0, 1, 0)
    assert line.degenerate == ((y,),)


@pytest.mark.parametrize("n", [1, 2, 3])
def test_matrices_left_out_cannot_change_the_types(n: int) -> None:
    """Where only matrices that are not relevant lose rank, the types stay: over all feasible defects."""
    feasible = list(feasible_defects(n))
    place = {"L": "delta", "L_p": "p", "L_I": "k_I", "L_O": "k_O"}
    for here in feasible:
        watched = [place[name] for name in relevant(here)]
        for there in feasible:
            grown = all(b >= a for a, b in zip(here, there, strict=True))
            if grown and all(getattr(here, f) == getattr(there, f) for f in watched):
                assert here.types == there.types
