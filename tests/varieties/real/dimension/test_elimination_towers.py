"""Bounds of dimensions by elimination against sets whose dimension is known by construction."""

from __future__ import annotations

import pytest

from singsym.effort.chance import random
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.dimension.elimination_towers import is_dimension_at_most

R = Ring(("x", "y", "z", "w"))
x, y, z, w = R.gens


@pytest.mark.parametrize(
    ("equations", "nonzero", "dimension"),
    [
        ((x * y,), (), 3),
        ((x * y,), (x,), 3),
        ((x * y, x * z, x * w), (), 3),
        ((x * y, x * z, x * w), (x,), 1),
        # two circles about one centre have no point in common; about two centres two at most
        ((x**2 + y**2 - 1, x**2 + y**2 - 4), (), -1),
        ((x**2 + y**2 - 1, (x - 1) ** 2 + y**2 - 1), (), 2),
        # real zeros of sums of squares: x = y = 0
        ((x**2 + y**2,), (), 2),
        # the leg turns freely where its foot (z, w) is on the base: two circles coincide
        ((x**2 + y**2 - 1, (x - z) ** 2 + (y - w) ** 2 - 1), (), 2),
        ((x**2 + y**2 - 1, (x - z) ** 2 + (y - w) ** 2 - 1, z), (), 1),
    ],
)
def test_the_dimension_bounds_and_nothing_less(
    equations: tuple[Polynomial, ...], nonzero: tuple[Polynomial, ...], dimension: int
) -> None:
    found = [is_dimension_at_most(R, equations, nonzero, d) for d in range(5)]
    assert found == [d >= dimension for d in range(5)]


@pytest.mark.parametrize("seed", range(12))
def test_of_products_of_planes_no_bound_is_too_small(seed: int) -> None:
    """Of a union of linear spaces: 4 less the smallest rank of a choice of factors."""
    import itertools

    import numpy as np

    drawn = random("towers", seed)
    forms = [[[drawn.randint(-2, 2) for _ in range(4)] for _ in range(2)] for _ in range(3)]
    equations = []
    for pair in forms:
        one, other = (sum((g * c for g, c in zip(R.gens, form, strict=True)), start=R.zero) for form in pair)
        equations.append(one * other)
    exact = max(4 - int(np.linalg.matrix_rank(np.array(choice))) for choice in itertools.product(*forms))
    assert not any(is_dimension_at_most(R, equations, (), d) for d in range(exact))
    assert is_dimension_at_most(R, equations, (), exact)
