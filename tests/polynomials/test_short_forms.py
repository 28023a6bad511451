"""Short forms have the same values on circles and at constants, and normal forms tell equal functions."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.polynomials import AlgebraicConstant, Polynomial, Ring
from singsym.polynomials.short_forms import short_forms
from singsym.polynomials.unit_circles import circle

ROOT = AlgebraicConstant("r", (-2, 0, 0, 1), Fraction(1), Fraction(2))
R = Ring(("c", "s", "d", "t", "x", "r"), constants=(ROOT,))
c, s, d, t, x, r = R.gens
CIRCLES = (circle(c, s), circle(d, t))
monomial = st.tuples(*[st.integers(0, 3)] * 5, st.just(0))
powers = st.tuples(*[st.integers(0, 2)] * 5, st.integers(0, 8))
polynomial = st.dictionaries(monomial, st.integers(-3, 3), max_size=6).map(R.from_dict)
tangent = st.fractions(-3, 3, max_denominator=5)


def on_circles(k: Fraction, m: Fraction, value: Fraction) -> list[Fraction]:
    pairs = [((1 - q * q) / (1 + q * q), 2 * q / (1 + q * q)) for q in (k, m)]
    return [*pairs[0], *pairs[1], value, Fraction(0)]


@settings(deadline=None)
@given(polynomial, polynomial, tangent, tangent, tangent)
def test_values_on_the_circles_are_kept(
    p: Polynomial, q: Polynomial, k: Fraction, m: Fraction, value: Fraction
) -> None:
    """Rational points by half-angles, where p plus a multiple of a circle has the value of p."""
    forms = short_forms(R, CIRCLES)
    point = on_circles(k, m, value)
    padded = p + q * CIRCLES[0] - x * CIRCLES[1]
    for form in (forms.shorten(padded), forms.normal_form(padded), *forms.forms(padded)):
        assert form.evaluate(point) == p.evaluate(point)
    assert forms.normal_form(padded) == forms.normal_form(p)
    assert len(forms.shorten(padded)) <= len(padded)


@settings(deadline=None)
@given(
    st.dictionaries(st.tuples(*[st.integers(0, 2)] * 5, st.integers(0, 8)), st.integers(-3, 3), max_size=6)
)
def test_powers_of_a_constant_go(terms: dict[tuple[int, ...], int]) -> None:
    """r^3 = 2, so r^8 = 4 r^2: each exponent of r is divided by 3, by hand."""
    expected = R.zero
    for m, coefficient in terms.items():
        expected = expected + R.from_dict({(*m[:5], m[5] % 3): coefficient * 2 ** (m[5] // 3)})
    assert R.reduced(R.from_dict(terms)) == expected


def test_no_variable_goes_by_an_equation_without_any() -> None:
    """1 = 0, which a loop gives that cannot be closed, is no circle."""
    forms = short_forms(R, (CIRCLES[0], R.one))
    assert forms.squares == short_forms(R, CIRCLES[:1]).squares
    assert forms.normal_form(s**2) == 1 - c**2
