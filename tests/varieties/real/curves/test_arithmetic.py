"""Enclosures hold the exact values, computed with fractions."""

from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.polynomials import Ring
from singsym.varieties.real.curves.arithmetic import Balls, EnclosedMap, System

RING = Ring(("x", "y", "z"))
number = st.floats(-20, 20, allow_nan=False, width=32)
coefficient = st.fractions(-100, 100, max_denominator=97)
monomial = st.tuples(*[st.integers(0, 3)] * 3)
polynomial = st.dictionaries(monomial, coefficient, min_size=1, max_size=6).map(RING.from_dict)
centers = st.tuples(number, number, number)
offsets = st.tuples(*[st.fractions(-1, 1, max_denominator=1000)] * 3)


def holds(balls, index, exact):
    return abs(Fraction(float(balls.mid[index])) - exact) <= Fraction(float(balls.rad[index]))


@settings(max_examples=60, deadline=None)
@given(polynomial, centers, st.floats(0, 2), offsets)
def test_values_over_boxes(p, center, radius, offset):
    box = Balls(np.array([center]), np.full((1, 3), radius))
    point = [Fraction(c) + Fraction(radius) * o for c, o in zip(center, offset, strict=True)]
    compiled = EnclosedMap([p], 3)
    assert holds(compiled.balls(box), (0, 0), p.evaluate(point))
    assert holds(compiled.precise(box.mid), (0, 0), p.evaluate([Fraction(c) for c in center]))


@settings(max_examples=60, deadline=None)
@given(polynomial, centers, st.floats(0, 2), offsets)
def test_derivatives_over_boxes(p, center, radius, offset):
    if p.is_zero:
        return
    box = Balls(np.array([center]), np.full((1, 3), radius))
    point = [Fraction(c) + Fraction(radius) * o for c, o in zip(center, offset, strict=True)]
    system = System(RING, (p,))
    scaled = system.scaled[0]
    jacobian, hessian = system.jacobian_balls(box), system.hessian_balls(box)
    for i, first in enumerate(RING.names):
        gradient = scaled.derivative(first)
        assert holds(jacobian, (0, 0, i), gradient.evaluate(point))
        for j, second in enumerate(RING.names):
            assert holds(hessian, (0, 0, 3 * i + j), gradient.derivative(second).evaluate(point))


def test_matrix_products_hold_their_rounding():
    rng = np.random.default_rng(1)
    a, b = rng.normal(size=(4, 5)) * 1e8, rng.normal(size=(5, 3))
    product = Balls.exact(a).matmul(Balls.exact(b))
    for i in range(4):
        for j in range(3):
            exact = sum(Fraction(x) * Fraction(y) for x, y in zip(a[i], b[:, j], strict=True))
            assert holds(product, (i, j), exact)
