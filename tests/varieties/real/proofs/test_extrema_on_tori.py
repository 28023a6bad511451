"""Polynomials in unit vectors that are zero only where they are extreme."""

from __future__ import annotations

from fractions import Fraction
from math import cos, pi, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.polynomials import AlgebraicConstant, Polynomial, Ring
from singsym.varieties.real.proofs.extrema_on_tori import extreme_zeros
from singsym.varieties.real.proofs.real_consequences import real_consequences
from singsym.varieties.real.system import RealSystem

ROOT = AlgebraicConstant("r", (-3, 0, 1), Fraction(1), Fraction(2))
R = Ring(("c", "s", "x", "y", "u", "v", "r"), constants=(ROOT,))
c, s, x, y, u, v, r = R.gens
PAIRS = (("c", "s"), ("x", "y"), ("u", "v"))
ROOT3 = 3**0.5


def test_a_leg_that_reaches_only_when_stretched() -> None:
    """A leg of two unit links reaches 2 along (1/2, sqrt(3)/2), the direction of c + sqrt(3) s, at most:
    t (x + u) - x u - y v - 3 with t = c + sqrt(3) s is minus half of |(x + u, y + v) - (t, 0)|^2 + (4 - t^2).
    """
    reach = (c + r * s) * (x + u) - x * u - y * v - 3
    forced = extreme_zeros(reach, PAIRS).value
    stretched = (0.5, ROOT3 / 2, 1.0, 0.0, 1.0, 0.0, ROOT3)
    assert len(forced) == 3
    assert abs(reach.evaluate(stretched)) < 1e-12
    assert all(abs(p.evaluate(stretched)) < 1e-12 for p in forced)
    # a zero over the complex numbers that is none of the real ones: the derivatives tell them apart
    other = (2.0, 3**0.5 * 1j, 1.0, 0.0, 1.0, 0.0, 1.0 / 3**0.5 * -1j)
    assert any(abs(p.evaluate(other)) > 1e-3 for p in forced)


def test_out_of_reach() -> None:
    assert extreme_zeros(c + r * s - 3, PAIRS).value == (R.one,)
    assert real_consequences(RealSystem(R, ()), (c**2 + s**2 - 1, c + r * s - 3)).value is None


def test_nothing_is_said_of_what_changes_its_sign_or_has_other_variables() -> None:
    assert extreme_zeros(c * x + s * y - u, PAIRS).value == ()
    assert extreme_zeros(c * x + s * y - 1, PAIRS[:1]).value == ()


@settings(max_examples=40, deadline=None, derandomize=True)
@given(st.lists(st.integers(-3, 3), min_size=8, max_size=8), st.sampled_from([0, 1, 2, 3, 5, 8, 13]))
def test_the_sign_on_a_grid_agrees(coefficients: list[int], constant: int) -> None:
    """Where something is said, values on a grid of the torus have one sign."""
    terms = (c * x, c * y, s * x, s * y, c, s, x, y)
    f: Polynomial = sum((t * k for t, k in zip(terms, coefficients, strict=True)), start=R.one * constant)
    forced = extreme_zeros(f, PAIRS).value
    angles = [2 * pi * k / 60 for k in range(60)]
    values = [f.evaluate((cos(a), sin(a), cos(b), sin(b), 0, 0, ROOT3)) for a in angles for b in angles]
    if forced:
        assert min(values) > -1e-9 or max(values) < 1e-9
    if forced == (R.one,):
        assert min(map(abs, values)) > 1e-9
    if min(values) > 1e-9 or max(values) < -1e-9:
        # values of both signs may lie between: nothing is claimed then
        assert forced in ((), (R.one,)) or all(forced)


@pytest.mark.parametrize(("p", "q", "length"), [(3, 4, 5), (5, -12, 13), (-8, 15, 17)])
def test_a_direction_at_its_bound(p: int, q: int, length: int) -> None:
    """p c + q s = length only at (p, q)/length; there q c - p s vanishes, by Cauchy and Schwarz."""
    assert [f.primitive() for f in extreme_zeros(p * c + q * s - length, PAIRS).value] in (
        [(q * c - p * s).primitive()],
        [(p * s - q * c).primitive()],
    )
