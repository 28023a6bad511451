"""The cheap steps of splitting, on systems whose zeros are seen by eye."""

from __future__ import annotations

from singsym.polynomials import Ring
from singsym.varieties.splitting import factor_equations, irreducible_factors, levels, used_ring

R = Ring(("x", "y", "z"))
x, y, z = R.gens


def test_factors_that_are_known_not_to_vanish_are_dropped() -> None:
    """Off y = 0, x y = 0 is x = 0 and y^2 = 0 is nothing; where x = 0, x (y - 1) = 0 says nothing more."""
    off = irreducible_factors([y])
    assert off == frozenset([y])
    assert factor_equations([x * y], off) == ((x,),)
    assert factor_equations([x, y**2], off) is None
    assert factor_equations([x * y, x * (y - 1)], off) == ((x,),)
    assert factor_equations([R.zero], off) == ()


def test_zero_is_not_nonzero() -> None:
    assert irreducible_factors([x, R.zero]) is None


def test_levels_begin_where_fewest_variables_are_needed() -> None:
    """x alone, then y over it, then z; all equations and all variables are there at the end."""
    found = levels([z - x * y, x**2 - 2, y**2 - x])
    assert set(found[0].names) <= {"x", "y"}
    assert {p for level in found for p in level.equations} == {z - x * y, x**2 - 2, y**2 - x}
    assert set(found[-1].names) == {"x", "y", "z"}


def test_the_ring_of_what_is_used() -> None:
    assert used_ring(R, [x - z, R.one]).names == ("x", "z")
