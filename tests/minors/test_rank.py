"""Ranks at points against SymPy, and rank loci against ranks at random points."""

from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.minors.rank import minor_factors, rank_at, rank_blocks, simplest_blocks
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring

R = Ring(("x", "y", "z"))
x, y, z = R.gens
SPACE = Certifier(ConfigurationSpace(R, ()))
ENTRIES = st.sampled_from([0, 0, 0, 1, x, y, z, x - y, x * z, y + 1])
MATRICES = st.lists(st.lists(ENTRIES, min_size=3, max_size=3), min_size=4, max_size=4)
POINTS = st.lists(st.integers(-1, 1), min_size=3, max_size=3)


@settings(max_examples=80, deadline=None)
@given(MATRICES, POINTS)
def test_ranks_and_where_they_are_too_low(rows: list[list[Polynomial]], point: list[int]) -> None:
    matrix = PolynomialMatrix.of(R, rows)
    exact = [fmpq(v) for v in point]
    rank = matrix.to_sympy().subs(dict(zip("xyz", point, strict=True))).rank()
    assert rank_at(matrix, exact) == rank
    for parts in (rank_blocks(matrix, SPACE), simplest_blocks(matrix, SPACE, 1)):
        assert parts.constant + sum(rank_at(block, exact) for block in parts.blocks) == rank
    apart = rank_blocks(matrix, SPACE)
    if apart.constant + sum(min(block.shape) for block in apart.blocks) < 3:
        assert rank < 3
        return
    blocks = apart.locus(3)
    assert blocks is not None
    minors = [minor_factors(block, SPACE) for block in blocks]
    lost = [
        all(any(f.evaluate(exact) == 0 for f in factors) for factors in found)
        for found in minors
        if found is not None
    ]
    assert any(lost) == (rank < 3)
