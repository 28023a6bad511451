"""Curves of dyads over a circle: all components, by what is known of four-bars."""

from __future__ import annotations

import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.polynomials import Ring
from singsym.varieties.real.modules.lifted_curve import lifted_curves, points_on_tower, towers
from singsym.varieties.real.modules.module_points import module_points
from tests.varieties.real.modules.four_bars import C, S, X, Y, four_bar


@pytest.mark.parametrize(
    ("lengths", "components"),
    [((1, 3, 2, 3), 2), ((3, 1, 2, 3), 2), ((3, 3, 2, 3), 2), ((2, 2, 2, 5), 1), ((1, 1, 1, 9), 0)],
)
def test_assembly_modes(lengths: tuple[int, int, int, int], components: int) -> None:
    """Grashof: two branches where the shortest and the longest are together less than the others, else one;
    none where the longest is more than the other three."""
    found = next(towers(four_bar(*lengths)))
    (curve,) = lifted_curves(found, module_points, Budget()).value
    assert len(curve.loops) == components


def test_a_foldable_four_bar_is_not_smooth() -> None:
    """1 + 3 = 2 + 2: all bars in line, where two branches cross."""
    found = next(towers(four_bar(1, 2, 2, 3)))
    with pytest.raises(Undecided):
        lifted_curves(found, module_points, Budget())


def test_dead_centres_of_a_double_rocker() -> None:
    """2, 2, 2, 5: coupler and rocker are in line where the crank's tip is 4 from (5, 0): c = 13/10, twice."""
    dead = (X - C) * Y - (X - 5) * (Y - S)
    found = points_on_tower((*four_bar(2, 2, 2, 5), dead), module_points, Budget()).value
    assert [round(p.floats[0], 9) for p in found] == [1.3, 1.3]


def test_no_tower() -> None:
    """A cubic over the crank is no dyad; nothing is no curve."""
    assert list(towers((C**2 + S**2 - 1, X**3 - C, Y - X))) == []
    assert list(towers(())) == []


def test_a_circle_about_a_point_that_is_solved_for() -> None:
    """About (a, 1) with a^2 = 4 a circle of radius 2, and on it a dyad to the origin with bars of length 2:
    in line where the point is 4 from the origin.  About (2, 1) and (-2, 1): 5 + 4 + 4 sqrt 5 > 16 > 5 + 4 - 4
    sqrt 5, so two points each."""
    ring = Ring(("a", "u", "v", "x", "y"))
    a, u, v, x, y = ring.gens
    circle = (u - a) ** 2 + (v - 1) ** 2 - 4
    dyad = ((x - u) ** 2 + (y - v) ** 2 - 4, x**2 + y**2 - 4)
    found = points_on_tower((a**2 - 4, circle, *dyad, u * y - v * x), module_points, Budget()).value
    stretched = [p for p in found if round(p.floats[1] ** 2 + p.floats[2] ** 2, 6) == 16]
    assert len(stretched) == 4
    assert sorted(round(p.floats[0]) for p in stretched) == [-2, -2, 2, 2]
