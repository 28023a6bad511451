"""Ranges of angles against the definition: which angles of the circle fulfil the condition, in mpmath."""

import random
from fractions import Fraction

import mpmath
import pytest
import sympy

from singsym.mechanism.arcs import OUTWARDS, decimal_arc, exact_arc, multiple_of_pi, rational_point
from singsym.mechanism.model import Limit


def value(limit: Limit, angle: mpmath.mpf) -> mpmath.mpf:
    """How far inside the limit an angle is, to 40 digits."""
    assert limit.low is not None
    with mpmath.workdps(40):
        put = {sympy.Symbol("cos(A)"): mpmath.cos(angle), sympy.Symbol("sin(A)"): mpmath.sin(angle)}
        inside = sympy.lambdify([*put], limit.expression - limit.low, "mpmath")
        return inside(*put.values())


RANGES = [
    ("0", "2.5"),
    ("-2.5", "0"),
    ("-1.9", "1.9"),
    ("-0.25", "2.7"),
    ("-3.5", "1.2"),
    ("0.1", "6.2"),
    ("2.2", "3.7"),
    ("-2.9671", "2.9671"),
    ("-3.0001", "3.0001"),
    ("1.5708", "3"),
    ("7", "8.25"),
]


@pytest.mark.parametrize("spelled", RANGES)
def test_decimals_are_rounded_outwards(spelled: tuple[str, str]) -> None:
    limit, _ = decimal_arc("A", *map(float, spelled))
    assert limit is not None
    with mpmath.workdps(40):
        low, high = (mpmath.pi / 2 if s == "1.5708" else mpmath.mpf(s) for s in spelled)
        # Every angle of the range is allowed, its ends as well; the condition is exact, 40 digits are not.
        for k in range(101):
            assert value(limit, low + (high - low) * k / 100) > -(mpmath.mpf(10) ** -30)
        # And none that is more than 1e-6 beyond it.
        beyond = mpmath.mpf(1.001) * OUTWARDS.numerator / OUTWARDS.denominator
        rest = 2 * mpmath.pi - (high - low) - 2 * beyond
        for k in range(101):
            assert value(limit, high + beyond + rest * k / 100) < 0


@pytest.mark.parametrize(
    "low", [Fraction(0), Fraction(-1, 3), Fraction(1, 4), Fraction(5, 12), Fraction(3, 2)]
)
@pytest.mark.parametrize("span", [Fraction(1, 4), Fraction(1), Fraction(7, 6), Fraction(23, 12)])
def test_multiples_of_pi_are_exact(low: Fraction, span: Fraction) -> None:
    ends = [sympy.Rational(t.numerator, t.denominator) * sympy.pi for t in (low, low + span)]
    limit = exact_arc("A", *ends)
    trigonometric = {sympy.Symbol("cos(A)"): sympy.cos, sympy.Symbol("sin(A)"): sympy.sin}
    for end in ends:
        put = {symbol: function(end) for symbol, function in trigonometric.items()}
        assert sympy.simplify(limit.expression.xreplace(put) - limit.low) == 0
    with mpmath.workdps(40):
        start, width = (
            mpmath.pi * low.numerator / low.denominator,
            mpmath.pi * span.numerator / span.denominator,
        )
        for k in range(1, 50):
            assert value(limit, start + width * k / 50) > 0
            assert value(limit, start + width + (2 * mpmath.pi - width) * k / 50) < 0


def test_the_simpler_form_is_taken() -> None:
    # From its middle pi/8 the range 0 to pi/4 needs a root of a root, by its chord only sqrt(2).
    limit = exact_arc("A", sympy.Integer(0), sympy.pi / 4)
    assert limit.expression.atoms(sympy.Pow) <= {sympy.sqrt(2)}
    # From the middle pi/2 the range pi/18 to 17 pi/18 needs one cosine.
    limit = exact_arc("A", sympy.pi / 18, 17 * sympy.pi / 18)
    assert limit.expression == sympy.Symbol("sin(A)")


def test_a_full_turn_is_no_limit() -> None:
    for ends in ((-3.5, 3.5), (0.0, 6.2832), (0.0, 6.28), (-3.14, 3.14), (-3.14159265359, 3.14159265359)):
        assert decimal_arc("A", *ends)[0] is None
    for ends in ((-3.1, 3.1), (0.0, 6.2), (-3.0, 3.2)):
        assert decimal_arc("A", *ends)[0] is not None


def test_multiples_of_pi_by_their_digits() -> None:
    # pi/2 = 1.5707963..., rounded or cut; 1.6 has too few digits, 1.5709 is another number.
    for text in ("1.57", "1.571", "1.570", "1.5707", "1.5708", "1.570796", "1.5707963267948966"):
        assert multiple_of_pi(float(text)) == sympy.pi / 2
        assert multiple_of_pi(-float(text)) == -sympy.pi / 2
    for text in ("1.6", "1.58", "1.5709", "1.5706", "1.57079634", "0.0001", "3.1", "6.3", "1.05", "0.52"):
        assert multiple_of_pi(float(text)) is None
    # pi/3 = 1.04719..., pi/4 = 0.78539..., pi/6 = 0.52359..., 2 pi = 6.28318...
    for text, ratio in (
        ("1.047", "1/3"),
        ("0.785", "1/4"),
        ("0.7854", "1/4"),
        ("0.5236", "1/6"),
        ("6.283", "2"),
    ):
        assert multiple_of_pi(float(text)) == sympy.Rational(ratio) * sympy.pi
    assert multiple_of_pi(0.0) == 0


def test_ends_that_mean_one_multiple_of_pi_stay_apart() -> None:
    # 1.5707 is pi/2 cut and 1.5708 is pi/2 rounded: the range between them is none of a point.
    limit, _ = decimal_arc("A", 1.5707, 1.5708)
    assert limit is not None
    assert value(limit, mpmath.mpf("1.57075")) > 0


def test_rational_points_are_on_the_circle() -> None:
    draw = random.Random(7)
    for _ in range(50):
        angle = Fraction(round(draw.uniform(-7, 7), draw.randint(0, 9))).limit_denominator(10**9)
        for up in (True, False):
            cosine, sine = rational_point(angle, up)
            assert cosine**2 + sine**2 == 1
            with mpmath.workdps(30):
                given = mpmath.mpf(angle.numerator) / angle.denominator
                moved = mpmath.arg(mpmath.mpc(str(cosine.n(30)), str(sine.n(30))) * mpmath.expj(-given))
                assert -1e-25 < (moved if up else -moved) <= 1e-6
