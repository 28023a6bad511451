"""Curves that cross where a dyad turns freely: rhombi and kites, whose parts are known."""

from __future__ import annotations

import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.polynomials import Ring
from singsym.varieties.real.modules.crossing_curves import crossing_parts
from singsym.varieties.real.modules.curve_components import components_off
from singsym.varieties.real.modules.towers import towers
from tests.varieties.real.modules.four_bars import C, S, X, Y, four_bar


def test_a_rhombus_is_three_circles() -> None:
    """Bars 1, A = (0, 0), D = (1, 0): C = B + D, B on its circle; C = A, and so; B = D, C on its circle.

    The first meets the second at B = (-1, 0), and the third at C = (2, 0); these meet where B = D and C = A.
    Off the second the others still meet; off the first and the third only the second is left."""
    rhombus = four_bar(1, 1, 1, 1)
    assert len(crossing_parts(next(towers(rhombus)))) == 3
    assert components_off(rhombus, (), Budget()) == 1
    assert components_off(rhombus, ((X, Y),), Budget()) == 1
    assert components_off(rhombus, ((X - C - 1, Y - S), (C - 1, S)), Budget()) == 1
    assert components_off(rhombus, ((X - C - 1, Y - S), (C - 1, S), (X, Y)), Budget()) == 0


def test_a_rhombus_that_carries_a_dyad() -> None:
    """C is on its circle about D but where C = A.

    A dyad of 2 and 3 to (6, 0) reaches C where that is not further than 5 from there, not at A: of the first
    and of the third circle an arc, with (2, 0) in its middle; the dyad's sheets are joined at its ends, so
    that there are two closed curves, which meet over (2, 0).  One of 2 and 2 to (-3, 0) reaches C not further
    than 4 from there, so at A, where B turns with the dyad above or below, but not at (2, 0): two closed
    curves again, each of which meets the two circles of B."""
    ring = Ring(("c", "s", "x", "y", "u", "v"))
    x, y, u, v = (ring.gen(n) for n in "xyuv")
    rhombus = tuple(map(ring.convert, four_bar(1, 1, 1, 1)))
    right = ((u - x) ** 2 + (v - y) ** 2 - 4, (u - 6) ** 2 + v**2 - 9)
    left = ((u - x) ** 2 + (v - y) ** 2 - 4, (u + 3) ** 2 + v**2 - 4)
    assert components_off((*rhombus, *right), (), Budget()) == 1
    assert components_off((*rhombus, *right), ((x, y),), Budget()) == 1
    assert components_off((*rhombus, *left), (), Budget()) == 1
    assert components_off((*rhombus, *left), ((x, y),), Budget()) == 2


def test_a_kite_is_seen_from_its_other_end() -> None:
    """Bars 2, 1, 1, 2: B may be at D, and C turn about both; from C's circle, the crank, B has two places."""
    assert components_off(four_bar(2, 1, 1, 2), (), Budget()) == 1


def test_no_dyad_turns_freely() -> None:
    with pytest.raises(Undecided, match="turn freely"):
        crossing_parts(next(towers(four_bar(1, 3, 2, 3))))
