"""Dimension and degree of monomial ideals against counting by brute force."""

from __future__ import annotations

from itertools import combinations, product
from math import comb

from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.elimination import monomial_ideals

N = 3
exponents = st.tuples(*[st.integers(0, 3)] * N)
systems = st.lists(exponents, max_size=4)


def standard(system: list[tuple[int, ...]], degree: int) -> int:
    """The number of monomials of this degree outside the ideal."""
    return sum(
        sum(m) == degree and not any(all(a <= b for a, b in zip(g, m, strict=True)) for g in system)
        for m in product(range(degree + 1), repeat=N)
    )


@settings(max_examples=60, deadline=None)
@given(systems)
def test_hilbert_series(system: list[tuple[int, ...]]) -> None:
    numerator = monomial_ideals.hilbert_numerator(system)
    for d in range(8):
        counted = sum(c * comb(d - k + N - 1, N - 1) for k, c in enumerate(numerator) if k <= d)
        assert counted == standard(system, d)


@settings(max_examples=60, deadline=None)
@given(systems)
def test_dimension(system: list[tuple[int, ...]]) -> None:
    free = [
        k
        for k in range(N + 1)
        for chosen in combinations(range(N), k)
        if all(any(e for i, e in enumerate(m) if i not in chosen) for m in system)
    ]
    assert monomial_ideals.independent_sets_dimension(system, N) == max(free, default=-1)


def test_degree_of_powers() -> None:
    assert monomial_ideals.degree([(2, 0, 0), (0, 3, 0)], 3) == 6
    assert monomial_ideals.degree([(2, 0, 0), (0, 3, 0), (0, 0, 5)], 3) == 30
    assert monomial_ideals.degree([], 3) == 1
    assert monomial_ideals.degree([(0, 0, 0)], 3) == 0
