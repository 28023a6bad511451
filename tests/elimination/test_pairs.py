"""Buchberger's two criteria: which S-pairs of a basis need not be reduced."""

from __future__ import annotations

from itertools import combinations
from random import Random

import pytest

from singsym.elimination.engines.checks import _pairs
from singsym.polynomials import Exponents


def is_needed(leading: list[Exponents], i: int, j: int) -> bool:
    """Cox, Little, O'Shea, Ideals, Varieties, and Algorithms, 2.10: not coprime, and no third one between."""

    def lcm(a: Exponents, b: Exponents) -> Exponents:
        return tuple(map(max, a, b))

    whole = lcm(leading[i], leading[j])
    return any(map(min, leading[i], leading[j])) and not any(
        lcm(other, whole) == whole and whole not in (lcm(leading[i], other), lcm(leading[j], other))
        for k, other in enumerate(leading)
        if k not in (i, j)
    )


@pytest.mark.parametrize(("count", "variables"), [(2, 3), (3, 2), (30, 4), (60, 6)])
def test_pairs_that_the_criteria_leave(count: int, variables: int) -> None:
    rng = Random(count)
    leading = [tuple(rng.choice((0, 0, 1, 2, 3)) for _ in range(variables)) for _ in range(count)]
    needed = [(i, j) for i, j in combinations(range(count), 2) if is_needed(leading, i, j)]
    assert _pairs(leading) == needed
