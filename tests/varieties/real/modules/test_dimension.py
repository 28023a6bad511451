"""Bounds of dimensions by fibres of dyads."""

from __future__ import annotations

from singsym.polynomials import Ring
from singsym.varieties.real.modules.dimension import dimension_bound, is_dimension_at_most

R = Ring(("c", "s", "x", "y", "u", "v"))
C, S, X, Y, U, V = R.gens
CRANK = C**2 + S**2 - 4


def dyad_over(x: int) -> tuple:  # type: ignore[type-arg]
    return (X - C) ** 2 + (Y - S) ** 2 - 9, (X - x) ** 2 + Y**2 - 9


def test_a_crank_with_two_dyads_is_a_curve() -> None:
    """The pivot (5, 0) is never the crank's tip, which is 2 from the origin; nor (9, 0) the first dyad's."""
    second = (U - X) ** 2 + (V - Y) ** 2 - 1, (U - 9) ** 2 + V**2 - 16
    found = dimension_bound((CRANK, *dyad_over(5), *second))
    assert found is not None
    assert (found.value, found.certainty) == (1, "proven")


def test_a_dyad_that_may_turn_freely() -> None:
    """With both bars of length 3 and the pivot at (2, 0), the tip passes there, and the dyad turns about it.

    That is a circle over one point, beside a curve, times the plane of u and v; without the crank beside all
    that c, s and v may be.  A second dyad over it adds nothing, but one that turns freely too: a torus."""
    systems = (
        (CRANK, *dyad_over(2)),
        (U - C * S, *dyad_over(2)),
        (CRANK, *dyad_over(2), (U - X) ** 2 + (V - Y) ** 2 - 1, (U - 2) ** 2 + (V - 3) ** 2 - 1),
        (CRANK, *dyad_over(2), (U - C) ** 2 + (V - S) ** 2 - 1, (U - 2) ** 2 + V**2 - 1),
    )
    found = [bound.value for equations in systems if (bound := dimension_bound(equations)) is not None]
    assert found == [3, 3, 1, 2]


def test_a_core_with_a_free_unknown() -> None:
    found = dimension_bound((CRANK, U - C * S, *dyad_over(5)))
    assert found is not None
    assert found.value == 2, "the curve, and v, which is in no equation"


def test_without_a_dyad_that_comes_last_nothing_is_said() -> None:
    assert dimension_bound((CRANK, C * S - X * Y)) is None


def test_one_more_equation_leaves_less_of_a_linkage() -> None:
    """The coupler of a four-bar is level in finitely many configurations, but always in a parallelogram.

    A crank of 2 and a rocker of 2 on pivots 3 apart, with a coupler of 3: it is a parallelogram, or crossed.
    """
    crossed = (CRANK, (X - C) ** 2 + (Y - S) ** 2 - 9, (X - 3) ** 2 + Y**2 - 4, U, V)
    level = (Y - S) * (C**2 * X - 5 * S * X**2 + 7 * X * Y + C * S * Y - 11)
    assert is_dimension_at_most((CRANK, *dyad_over(5), U, V, level), (), 0).value
    assert not is_dimension_at_most((*crossed, level), (), 0).value
    assert is_dimension_at_most((*crossed, level), (), 1).value


def test_what_is_left_where_a_dyad_turns_freely_counts() -> None:
    """With the pivot on the crank's circle the dyad may turn about it, whatever is said of c beside."""
    free = (CRANK, *dyad_over(2), U, V)
    cut = (C - 2) * (C**2 + 3 * C * S - 5 * S**2 + 7 * C - 11)
    assert not is_dimension_at_most((*free, cut), (), 0).value
    assert is_dimension_at_most((*free, cut), (), 1).value


def test_a_circle_of_radius_zero_holds_lines_over_the_complex_numbers() -> None:
    """c^2 + s^2 = 0 with x^2 + y^2 = 0 and c x + s y = 0: over s = i c, c not 0, all (x, i x), a plane.

    Of the real zeros, c = s = 0 = x = y, it is a bound all the same."""
    circles = (C**2 + S**2, X**2 + Y**2, C * Y - S * X, U, V)
    found = dimension_bound(circles)
    assert found is not None
    assert found.value == 1
    assert dimension_bound(circles, complex_too=True) is None
    four_bar = (CRANK, *dyad_over(9), U, V)
    assert dimension_bound(four_bar, complex_too=True) == dimension_bound(four_bar)
