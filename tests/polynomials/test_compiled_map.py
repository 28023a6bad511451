"""Compiled maps against exact values, and many points at once against one by one."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.polynomials.compiled_map import CompiledMap, MonomialTable, numerical_matrix

RING = Ring(("x", "y", "z"))
x, y, z = RING.gens
number = st.integers(-64, 64).map(lambda k: k / 8)
coefficient = st.fractions(-100, 100, max_denominator=97)
monomial = st.tuples(*[st.integers(0, 4)] * 3)
polynomial = st.dictionaries(monomial, coefficient, max_size=6).map(RING.from_dict)
point = st.tuples(number, number, number)


def is_near(found: float, exact: Fraction, terms: Fraction) -> bool:
    """Within the rounding of a few dozen operations, for the size of all terms together."""
    return abs(Fraction(found) - exact) <= 100 * Fraction(2) ** -53 * terms


def size_of_terms(p: Polynomial, at: list[Fraction]) -> Fraction:
    positive = RING.from_dict({m: abs(c) for m, c in p.terms()})
    return Fraction(str(positive.evaluate([abs(c) for c in at])))


@settings(deadline=None)
@given(st.lists(polynomial, max_size=3), st.lists(point, min_size=1, max_size=3))
def test_values_and_slopes_are_the_exact_ones_up_to_rounding(
    polynomials: list[Polynomial], points: list[tuple[float, ...]]
) -> None:
    """Exact values by fractions, derivatives by FLINT; the coordinates are eighths, so exact in doubles."""
    compiled = CompiledMap(polynomials, RING)
    values, slopes = compiled(np.array(points))
    assert values.shape == (len(points), len(polynomials))
    assert slopes.shape == (len(points), len(polynomials), 3)
    for i, at in enumerate(points):
        exact = [Fraction(c) for c in at]
        for k, p in enumerate(polynomials):
            assert is_near(values[i, k], Fraction(str(p.evaluate(exact))), size_of_terms(p, exact))
            for j, name in enumerate(RING.names):
                slope = p.derivative(name)
                expected = Fraction(str(slope.evaluate(exact)))
                assert is_near(slopes[i, k, j], expected, size_of_terms(slope, exact))
        for alone, here in zip(compiled(np.array(at)), (values[i], slopes[i]), strict=True):
            assert np.allclose(alone, here, rtol=1e-12, atol=1e-6)
    assert np.allclose(compiled.values(np.array(points)), values, rtol=1e-12, atol=1e-6)
    assert np.allclose(compiled.jacobian(np.array(points)), slopes, rtol=1e-12, atol=1e-6)


@pytest.mark.parametrize("others", [0, 200])
def test_few_terms_and_many_variables(others: int) -> None:
    """With 200 variables more the matrix of coefficients is almost empty: sums of terms take its place."""
    ring = Ring(("x", "y", "z", *(f"u{k}" for k in range(others))))
    x, y, z, *rest = ring.gens
    polynomials = (x * y - z, ring.zero, *rest, x**2)
    points = np.arange(2.0 * len(ring.names)).reshape(2, -1)
    compiled = CompiledMap(polynomials, ring)
    for values, slopes, at in zip(*compiled(points), points, strict=True):
        assert values.tolist() == [at[0] * at[1] - at[2], 0, *at[3:], at[0] ** 2]
        assert slopes[0, :3].tolist() == [at[1], at[0], -1]
        assert slopes[-1, 0] == 2 * at[0]
        assert np.count_nonzero(slopes) == np.count_nonzero([at[1], at[0], 1, 2 * at[0]]) + others
        assert compiled.values(at).tolist() == values.tolist()
        assert compiled.jacobian(at).tolist() == slopes.tolist()
    assert compiled.magnitudes(-points[1], points[0]).tolist()[-1] == max(points[0, 0], points[1, 0]) ** 2


def test_coefficients_too_large_for_doubles() -> None:
    """10^400 (x^2 - 2) at x = 1: the half of its largest term, negative, where |x| is sqrt(2)."""
    huge = CompiledMap.balanced((10**400 * (x**2 - 2),), RING)
    assert huge.values(np.array([[1.0, 0.0, 0.0]]))[0, 0] == pytest.approx(-0.5)


@pytest.mark.parametrize("k", [Fraction(1, 10**6), Fraction(10**6)])
def test_a_balanced_map_does_not_depend_on_the_unit(k: Fraction) -> None:
    """x^2 + y^2 - k^2 and 3 x - 2 k are 4 k^2 and k at (k, 2 k), their slopes there 2 k, 4 k and 3."""
    compiled = CompiledMap.balanced((x**2 + y**2 - k**2, 3 * x - 2 * k), RING)
    size = compiled.sizes[0] / float(k)
    values, slopes = compiled(np.array([1.0, 2.0, 5.0]) * float(k))
    largest = max(size**2, (compiled.sizes[1] / float(k)) ** 2, 1), max(3 * size, 2)
    assert values == pytest.approx(np.array([4, 1]) / largest)
    assert slopes[0] * float(k) == pytest.approx(np.array([2, 4, 0]) / largest[0])
    assert max(abs(compiled.magnitudes(np.zeros(3), compiled.sizes))) <= 3


def test_magnitudes_count_every_term_as_positive() -> None:
    """|x y| + |-3| at (-2, 5) is 13; where x is at least 10, 53."""
    compiled = CompiledMap((x * y - 3,), RING)
    assert compiled.magnitudes(np.array([-2.0, 5.0, 0.0]), np.zeros(3)).tolist() == [13]
    assert compiled.magnitudes(np.array([-2.0, 5.0, 0.0]), np.array([10.0, 1.0, 1.0])).tolist() == [53]


def test_a_matrix_at_a_point() -> None:
    matrix = PolynomialMatrix.of(RING, [[x, 1, 0], [y * z, -x, x - x]])
    assert numerical_matrix(matrix, np.array([2.0, 3.0, 5.0])).tolist() == [[2, 1, 0], [15, -2, 0]]
    assert numerical_matrix(PolynomialMatrix(RING, (), 3), np.zeros(3)).shape == (0, 3)


@given(st.sets(monomial, max_size=8))
def test_a_monomial_is_made_of_an_earlier_one(monomials: set[tuple[int, ...]]) -> None:
    table = MonomialTable(monomials, 3)
    assert monomials <= set(table.index)
    assert all(parents.max() < start for start, _, parents, _ in table.levels)
    base = np.array([2.0, 3.0, 5.0])
    assert table.at(base).tolist() == [float(np.prod(base ** np.array(m))) for m in table.index]
