"""Exact points: refinement, decimals, decided signs, equality."""

import pickle
from decimal import Decimal, getcontext
from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.polynomials import Ring
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points

R = Ring(("x", "y"))
x, y = R.gens


def root_of_two() -> RealPoint:
    return real_points([x**2 - 2, y - x**3]).value[1]


def test_decimals_and_radius():
    getcontext().prec = 60
    p = root_of_two()
    assert abs(Decimal(p.decimals(40)["x"]) - Decimal(2).sqrt()) < Decimal(10) ** -39
    assert p.refine(300).radius < 2.0**-298
    assert abs(p.floats[0] ** 2 - 2) < 1e-12


def test_pickle_and_hash():
    p = root_of_two()
    assert p.box[0] > 1
    again = pickle.loads(pickle.dumps(p))
    assert again == p
    assert hash(again) == hash(p)
    assert again.sign(x**2 - 2) == 0


def test_a_sign_that_needs_many_digits():
    p = root_of_two()
    # the 80th convergent of sqrt 2 differs from it by less than 10^-60
    a, b = 1, 1
    for _ in range(80):
        a, b = a + 2 * b, a + b
    assert p.sign(x * b - a) == (1 if a * a < 2 * b * b else -1)
    assert p.sign(y - 2 * x) == 0


def test_the_same_point_from_another_system():
    p = root_of_two()
    q = next(q for q in real_points([x**4 - 4, y**2 - 8]).value if q.sign(x) > 0 and q.sign(y) > 0)
    assert p != q
    assert p.coincides(q)
    assert not p.coincides(real_points([x**2 - 2, y - x**3]).value[0])


def test_rational_coordinates_are_exact():
    (p,) = real_points([3 * x - 1, 7 * y + 2]).value
    assert (p.rational("x"), p.rational("y")) == (Fraction(1, 3), Fraction(-2, 7))
    assert p.degree == 1
    assert p.sign(x + y - Fraction(1, 21)) == 0


@settings(max_examples=30, deadline=None)
@given(st.lists(st.integers(-6, 6), min_size=2, max_size=5, unique=True))
def test_signs_at_integer_roots(roots):
    f = R.one
    for r in roots:
        f = f * (x - r)
    points = real_points([f, y - x**2]).value
    assert [p.rational("x") for p in points] == sorted(roots)
    assert all(p.sign(y - x**2) == 0 for p in points)
    assert [p.sign(x) for p in points] == [(r > 0) - (r < 0) for r in sorted(roots)]
