"""Numerical ranks of matrices whose singular values are known."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from singsym.kinematics.numerical_rank import numerical_rank


def test_gap_of_singular_values() -> None:
    found = numerical_rank(np.diag([1.0, 1e-12]))
    assert found.rank == 1
    assert found.gap == pytest.approx(1e12)
    assert numerical_rank(np.diag([2.0, 1.0])).gap == float("inf")


def test_nothing_has_rank_zero() -> None:
    assert numerical_rank(np.zeros((0, 2))).rank == 0
    assert numerical_rank(np.zeros((0, 2))).right.shape == (2, 2)
    assert numerical_rank(np.zeros((3, 0))).rank == 0
    assert numerical_rank(np.zeros((2, 2))).rank == 0


def test_what_is_zero_up_to_rounding_is_zero_where_the_size_is_known() -> None:
    column = np.array([[1e-16], [2e-16]])
    assert numerical_rank(column).rank == 1
    assert numerical_rank(column, size=1).rank == 0


@pytest.mark.parametrize(("value", "clear"), [(1e-6, True), (3e-8, False), (3e-9, False), (1e-10, True)])
def test_near_the_threshold_it_is_unclear(value: float, clear: bool) -> None:
    assert numerical_rank(np.diag([1.0, value]), 1e-8).is_clear == clear


@pytest.mark.parametrize("shape", [(2, 3), (3, 2), (2, 2)])
def test_mpmath_numbers_are_worked_out_in_their_precision(shape: tuple[int, int]) -> None:
    """A turned diagonal matrix with singular values 1 and 1e-25, which doubles cannot tell from 1 and 0."""
    with mpmath.workdps(60):
        c, s = mpmath.mpf(3) / 5, mpmath.mpf(4) / 5
        small = mpmath.mpf(10) ** -25
        matrix = np.full(shape, mpmath.mpf(0), dtype=object)
        matrix[:2, :2] = [[c, -s * small], [s, c * small]]
        found = numerical_rank(matrix, 1e-30)
    assert found.rank == 2
    assert found.singular_values == pytest.approx((1.0, 1e-25))
    assert np.allclose(found.right @ found.right.T, np.eye(shape[1]))
    assert found.right.shape == (shape[1], shape[1])
