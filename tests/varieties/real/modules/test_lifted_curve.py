"""Curves of dyads over a circle: all components, by what is known of four-bars."""

from __future__ import annotations

import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.polynomials import Equations, Ring
from singsym.varieties.real.modules.lifted_curve import lifted_curve, points_on_tower, tower

R = Ring(("c", "s", "x", "y"))
C, S, X, Y = R.gens


def four_bar(crank: int, coupler: int, rocker: int, base: int) -> Equations:
    return (
        C**2 + S**2 - crank**2,
        (X - C) ** 2 + (Y - S) ** 2 - coupler**2,
        (X - base) ** 2 + Y**2 - rocker**2,
    )


@pytest.mark.parametrize(
    ("lengths", "components"),
    [((1, 3, 2, 3), 2), ((3, 1, 2, 3), 2), ((3, 3, 2, 3), 2), ((2, 2, 2, 5), 1), ((1, 1, 1, 9), 0)],
)
def test_assembly_modes(lengths: tuple[int, int, int, int], components: int) -> None:
    """Grashof: two branches where the shortest and the longest are together less than the others, else one;
    none where the longest is more than the other three."""
    found = tower(four_bar(*lengths))
    assert found is not None
    assert len(lifted_curve(found, Budget()).loops) == components


def test_a_foldable_four_bar_is_not_smooth() -> None:
    """1 + 3 = 2 + 2: all bars in line, where two branches cross."""
    found = tower(four_bar(1, 2, 2, 3))
    assert found is not None
    with pytest.raises(Undecided):
        lifted_curve(found, Budget())


def test_dead_centres_of_a_double_rocker() -> None:
    """2, 2, 2, 5: coupler and rocker are in line where the crank's tip is 4 from (5, 0): c = 13/10, twice."""
    dead = (X - C) * Y - (X - 5) * (Y - S)
    found = points_on_tower((*four_bar(2, 2, 2, 5), dead), Budget())
    assert [round(p.floats[0], 9) for p in found] == [1.3, 1.3]


def test_no_tower() -> None:
    """A cubic over the crank is no dyad."""
    assert tower((C**2 + S**2 - 1, X**3 - C, Y - X)) is None
