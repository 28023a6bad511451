"""Columns that others determine."""

import numpy as np

from singsym.varieties.real.numerical.dependent_columns import dependent_columns


def test_dependent_columns_go_by_the_size_of_the_matrix() -> None:
    """Of a matrix of small numbers the first column is chosen where it is asked for."""
    assert dependent_columns(np.array([[1.0, 2.0]]) * 1e-12, 1, [0]) == [0]
    assert dependent_columns(np.array([[1e-12, 2.0]]), 1, [0]) == [1]
