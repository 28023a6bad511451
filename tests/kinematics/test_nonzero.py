"""Proofs of nonvanishing: what must be proved by elementary trigonometry, and what must not be."""

from fractions import Fraction

import pytest

from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.polynomials import AlgebraicConstant, Polynomial, Ring

R = Ring(("c", "s", "d", "t", "x", "y", "a"))
c, s, d, t, x, y, a = R.gens
CIRCLES = (c**2 + s**2 - 1, d**2 + t**2 - 1)
LEG = (3 * (c + d), 3 * (s + t))


@pytest.mark.parametrize(
    "polynomial",
    [
        R.constant(-2),
        c**2 + s**2,
        5 + 4 * c,
        13 + 12 * (c * d + s * t) - 12 * (c * d + s * t) + x**2,
        x**2 + 2 * x * y + 2 * y**2 + 1,
        a,
        a * x**2 + 3 * a,
        (2 - a) * a,
        (x - 1) ** 2 + y**2,
        c * d + s * t + 1,
        x - 5,
    ],
)
def test_proved(polynomial: Polynomial) -> None:
    space = ConfigurationSpace(
        R,
        (*CIRCLES, (x - 1) ** 2 + y**2 - 9),
        exclusions=(LEG, (x - 5,)),
        positive=(a, 2 - a),
        parameters=("a",),
    )
    assert Certifier(space).reason(polynomial)


@pytest.mark.parametrize(
    "polynomial",
    [R.zero, c, c + d, x, x**2 + y**2, c * d + s * t - 1, 4 + 4 * c, 1 - a, c * t - s * d, a * x],
)
def test_not_proved_because_false(polynomial: Polynomial) -> None:
    space = ConfigurationSpace(R, CIRCLES, exclusions=(LEG,), positive=(a, 2 - a), parameters=("a",))
    assert Certifier(space).reason(polynomial) is None


def test_sine_where_both_extension_and_folding_are_excluded() -> None:
    both = ConfigurationSpace(R, CIRCLES, exclusions=((1 - c,), (1 + c, s)))
    assert Certifier(both).reason(s)
    assert Certifier(ConfigurationSpace(R, CIRCLES, exclusions=((1 - c,),))).reason(s) is None


def test_range_of_a_parameter_with_an_algebraic_end() -> None:
    """2/sqrt(3) < a < 2 keeps a - 1 positive, and says nothing about a - 3/2."""
    root = AlgebraicConstant("r", (-3, 0, 1), _f(17, 10), _f(9, 5))
    ring = Ring(("a", "r"), constants=(root,))
    b, r = ring.gens
    certifier = Certifier(
        ConfigurationSpace(ring, ring.relations, positive=(b - r * 2 / 3, 2 - b), parameters=("a",))
    )
    assert certifier.reason(b - 1)
    assert certifier.reason(b * 2 - 3) is None


def _f(p: int, q: int) -> Fraction:
    return Fraction(p, q)
