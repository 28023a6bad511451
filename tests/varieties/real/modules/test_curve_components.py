"""Components of curves that are coverings of smaller ones."""

from __future__ import annotations

import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.polynomials import Ring
from singsym.varieties.real.curves.real_curve import real_curve
from singsym.varieties.real.modules.curve_components import components_off

R = Ring(("c", "s", "x", "y", "z"))
C, S, X, Y, Z = R.gens
FOUR_BAR = (C**2 + S**2 - 1, (X - C) ** 2 + (Y - S) ** 2 - 9, (X - 3) ** 2 + Y**2 - 4)


def test_as_many_as_of_the_whole_curve() -> None:
    """A Grashof four-bar: two; once lifted from the crank's circle, once as one curve in four variables."""
    small = Ring(("c", "s", "x", "y"))
    four = tuple(map(small.convert, FOUR_BAR))
    assert components_off(four, (), Budget()) == real_curve(four).connected_components == 2


def test_a_component_in_an_exclusion_does_not_count() -> None:
    """Where the product (s - 2) (c^2 + s^2 - 1) is zero: all of the curve, and nothing else."""
    small = Ring(("c", "s", "x", "y"))
    four = tuple(map(small.convert, FOUR_BAR))
    assert components_off(four, (four[:1],), Budget()) == 0
    assert components_off(four, ((small.gens[1] - 2,),), Budget()) == 2


def test_no_algebra_where_balls_tell(monkeypatch: pytest.MonkeyPatch) -> None:
    """For exclusions that are long polynomials the Groebner basis of all loops was asked, for half a minute.

    x + 4 is positive on a four-bar whose coupler ends at 2 from (3, 0), and over an ellipse, which is traced,
    where the dyad stands on two opposite points, at most 2 apart and never one: it is above or below."""

    def asked(*_: object) -> None:
        pytest.fail("algebra is asked")

    monkeypatch.setattr("singsym.varieties.real.modules.curve_components.vanishes", asked)
    small = Ring(("c", "s", "x", "y"))
    c, s, x, y = small.gens
    four = tuple(map(small.convert, FOUR_BAR))
    assert components_off(four, ((c, x + 4),), Budget()) == 2
    ellipse = (2 * c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 4, (x + c) ** 2 + (y + s) ** 2 - 4)
    assert components_off(ellipse, ((x + 4,),), Budget()) == 2


def test_a_curve_without_dyads() -> None:
    with pytest.raises(Undecided, match="no dyads"):
        components_off((C**2 + S**2 - 1, X - C, Y - S, Z - C * S), (), Budget())


def test_circles_over_two_points_and_what_follows_from_equations() -> None:
    """x = sqrt(2) or -sqrt(2), u^2 + v^2 = 1 over each, w = x + u: two circles.

    (w - u)^2 = 2 follows from the equations, and holds on both; w = u + x + v only where v = 0."""
    ring = Ring(("x", "u", "v", "w"))
    x, u, v, w = ring.gens
    curve = (x**2 - 2, u**2 + v**2 - 1, w - x - u)
    assert components_off(curve, (), Budget()) == 2
    assert components_off(curve, (((x + 5) * (x**2 - 2),),), Budget()) == 0
    assert components_off(curve, ((w - u - x - v,),), Budget()) == 2


def test_a_part_that_is_no_curve_and_has_no_real_point_counts_for_nothing() -> None:
    """A kite: (u, v) at 2 from (1, 0) and at 7 from (x, y), which is at 7 from (3, 0), all in line with this.

    Folded (u, v) is at (3, 0), and (x, y) turns on its circle; stretched it would be at 14 from there, not 4.
    A dyad of 8 and 3 on (x, y) and (3, 0) makes triangles with the 7 between them, on either side.
    """
    x, y, u, v, p, q = Ring(("x", "y", "u", "v", "p", "q")).gens
    kite = ((x - 3) ** 2 + y**2 - 49, (u - x) ** 2 + (v - y) ** 2 - 49, (u - 1) ** 2 + v**2 - 4)
    dyad = ((p - x) ** 2 + (q - y) ** 2 - 64, (p - 3) ** 2 + q**2 - 9)
    in_line = (x - 3) * v - y * (u - 3)
    assert components_off((*kite, *dyad, in_line), (), Budget(20)) == 2


def test_what_a_circle_does_not_need_may_need_what_it_stands_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """w = 2 or -2, a four-bar of 1, 3, 2 at a distance of w^2 - 1 = 3, z^2 = w + 1: two components for
    each z, over w = 2 alone.  The curve is not traced."""

    def traced(*_: object, **__: object) -> None:
        pytest.fail("the curve is traced")

    monkeypatch.setattr("singsym.varieties.real.modules.curve_components.real_curve", traced)
    ring = Ring(("c", "s", "x", "y", "w", "z"))
    c, s, x, y, w, z = ring.gens
    four_bar = (c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 9, (x - w**2 + 1) ** 2 + y**2 - 4)
    assert components_off((*four_bar, w**2 - 4, z**2 - w - 1), (), Budget()) == 4
