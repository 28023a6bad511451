"""Bounds from link lengths, and what they decide."""

from fractions import Fraction

from singsym.effort.budget import Budget
from singsym.polynomials import Ring
from singsym.polynomials.sums_of_squares import squares_less_constant
from singsym.varieties.real.bounds_of_solutions import extreme_values, sign_within, solution_bounds
from singsym.varieties.real.proofs.emptiness import is_empty_over_reals
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y", "z"))
x, y, z = R.gens


def test_bounds_pass_along_a_chain():
    bounds = solution_bounds(R, [x**2 + y**2 - 4, (x - z) ** 2 - 9])
    assert bounds == {"x": (-2, 2), "y": (-2, 2), "z": (-5, 5)}
    assert sign_within(z - 6, bounds) == -1
    assert sign_within(z - 4, bounds) == 0


def test_unbounded_and_impossible():
    assert solution_bounds(R, [x * y - 1]) == {}
    assert sign_within(x + 10, {}) == 0
    assert solution_bounds(R, [x**2 + y**2 + 1]) is None


def test_completed_squares_multiply_out():
    f = -2 * (x - 3 * y + 1) ** 2 - (y + z) ** 2 + 7
    found = squares_less_constant(f)
    assert found is not None
    sign, squares, less = found
    again = sum((root**2 * d for d, root in squares), start=R.zero) - less
    assert again * sign == f


def test_a_joint_out_of_reach_at_once(linkage):
    reach = linkage.ring.gen("Bx") - 2
    assert is_empty_over_reals(RealSystem(linkage.ring, linkage.loops, positive=(reach,)), Budget(5)).is_yes
    touching = RealSystem(linkage.ring, linkage.loops[:1], positive=(reach + Fraction(9, 10),))
    assert is_empty_over_reals(touching, Budget(20)).is_yes


def test_extremes_of_a_range_that_is_not_symmetric() -> None:
    # (x - 1)^2 <= 4 gives -1 <= x <= 3, and -x - 1 = 0 holds at the end x = -1 only: not where x^2 = 9
    bounds = solution_bounds(R, [(x - 1) ** 2 + y**2 - 4])
    assert bounds is not None
    assert extreme_values(-x - 1, bounds) == (-x - 1,)


def test_a_vector_bounds_its_parts_by_its_length() -> None:
    # x^2 + y^2 = z^2 and z^2 <= 4: at x = 2 nothing is left for y
    bounds = solution_bounds(R, [z**2 - 4, x - 2, x**2 + y**2 - z**2])
    assert bounds is not None
    assert bounds["y"] == (0, 0)
