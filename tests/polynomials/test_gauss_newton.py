"""Newton's method: the same steps in every unit, of what may move only, and no zero where there is none."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from singsym.polynomials import Ring
from singsym.polynomials.compiled_map import CompiledMap
from singsym.polynomials.gauss_newton import Restricted, approach, gauss_newton, least_squares, project

R = Ring(("x", "y", "z"))
x, y, z = R.gens
UNITS = [Fraction(1, 10**6), Fraction(7, 3), Fraction(10**6)]


def sphere_and_plane(k: Fraction) -> CompiledMap:
    """Of lengths times k."""
    return CompiledMap.balanced((x**2 + y**2 + z**2 - 9 * k**2, x + 2 * y - z - k), R)


class Counting:
    """A map that counts how often it is asked."""

    def __init__(self, system: CompiledMap) -> None:
        self.system, self.sizes, self.calls = system, system.sizes, 0

    def __call__(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        self.calls += 1
        return self.system(points)


@pytest.mark.parametrize("k", UNITS)
def test_as_many_steps_from_far_away(k: Fraction) -> None:
    calls, ends = [], []
    for unit in (Fraction(1), k):
        counting = Counting(sphere_and_plane(unit))
        end = gauss_newton(counting, np.array([40.0, -30.0, 50.0]) * float(unit))
        assert end is not None
        calls.append(counting.calls)
        ends.append(end / float(unit))
    assert calls[0] == calls[1]
    assert np.allclose(*ends, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("k", UNITS)
def test_what_is_no_zero_is_not_taken_for_one(k: Fraction) -> None:
    """x^2 + y^2 + k^2 has no real zero; in small units its values are below any fixed bound."""
    system = CompiledMap.balanced((x**2 + y**2 + k**2,), R)
    start = np.array([1.0, 2.0, 0.0]) * float(k)
    assert gauss_newton(system, start) is None
    assert project(system, start, [0, 1, 2]) is None
    assert approach(system, start[np.newaxis]) == []


@pytest.mark.parametrize("k", UNITS)
def test_a_projection_is_as_close_as_its_equation_is_large(k: Fraction) -> None:
    """The nearest point of a circle about 0 is on the ray: (3, 4) k goes to (0.6, 0.8) k."""
    landed = project(
        CompiledMap.balanced((x**2 + y**2 - k**2,), R), np.array([3.0, 4.0, 9.0]) * float(k), [0, 1]
    )
    assert landed == pytest.approx(np.array([0.6, 0.8, 9.0]) * float(k), rel=1e-9)


def test_held_coordinates_stay() -> None:
    """With y = 3/5 held, x^2 + y^2 = 1 is met from x = 1 at 4/5; with y = 2 nowhere."""
    circle = CompiledMap.balanced((x**2 + y**2 - 1,), R)
    assert project(circle, np.array([1.0, 0.6, 7.0]), [0]) == pytest.approx([0.8, 0.6, 7.0])
    assert project(circle, np.array([1.0, 2.0, 7.0]), [0]) is None
    values, slopes = Restricted(circle, np.array([0.0, 0.6, 7.0]), [0, 2])(np.array([0.5, 7.0]))
    everywhere = circle(np.array([0.5, 0.6, 7.0]))
    assert values == pytest.approx(everywhere[0])
    assert slopes == pytest.approx(everywhere[1][:, [0, 2]])


@pytest.mark.parametrize("k", UNITS)
def test_least_squares_end_where_no_zero_is(k: Fraction) -> None:
    """x = 0, x = k and y = 2 k: (0 - x)^2 + (k - x)^2 is least in the middle, also from far away."""
    system = CompiledMap((x, x - k, y - 2 * k), R, [float(k)] * 3, [float(k)] * 3)
    end = least_squares(system, np.array([50.0, -30.0, 1.0]) * float(k))
    assert end == pytest.approx(np.array([0.5, 2.0, 1.0]) * float(k), rel=1e-6)


@pytest.mark.parametrize("power", [-40, 40])
def test_least_squares_take_the_same_steps_in_every_unit_of_the_values(power: int) -> None:
    """Values and their slopes times a power of two are rounded alike, so that ends are equal to the bit."""
    equations = (x**2 + y**2 - 4, x * y - 1, x - 3)
    starts = np.random.default_rng(5).normal(size=(10, 3))
    plain, scaled = (
        least_squares(CompiledMap(equations, R, [1.0] * 3, [size] * 3), starts) for size in (1.0, 2.0**power)
    )
    assert np.array_equal(plain, scaled)


def test_least_squares_of_many_starts_are_those_of_each() -> None:
    """Rows take their own steps, as one start does."""
    system = CompiledMap((x**2 + y**2 - 4, x * y - 1, x - 3), R, [1.0] * 3, [1.0] * 3)
    starts = np.random.default_rng(3).normal(size=(20, 3))
    together = least_squares(system, starts)
    for start, end in zip(starts, together, strict=True):
        assert least_squares(system, start) == pytest.approx(end, rel=1e-6)
