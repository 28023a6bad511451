"""Proofs that a polynomial has one sign."""

from hypothesis import given
from hypothesis import strategies as st

from singsym.kinematics.signs import is_definite
from singsym.polynomials import Ring

x, y = Ring(("x", "y")).gens


@given(st.lists(st.integers(-3, 3), min_size=6, max_size=6))
def test_definiteness_of_sums_of_squares(k: list[int]) -> None:
    u, v = k[0] * x + k[1] * y + k[2], k[3] * x + k[4] * y + k[5]
    form = u * u + v * v
    assert not is_definite(-form)
    if form.total_degree == 2:
        assert is_definite(form + 1)
