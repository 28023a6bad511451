"""Bounds of dimensions by fibres of dyads."""

from __future__ import annotations

from singsym.polynomials import Ring
from singsym.varieties.real.modules.dimension import dimension_bound

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


def test_a_dyad_that_may_turn_freely_gives_no_bound() -> None:
    """With both bars of length 3 and the pivot at (2, 0), the tip passes there, and the dyad turns."""
    assert dimension_bound((CRANK, U - C * S, *dyad_over(2))) is None
    found = dimension_bound((CRANK, U - C * S, *dyad_over(5)))
    assert found is not None
    assert found.value == 2, "the curve, and v, which is in no equation"


def test_without_a_dyad_that_comes_last_nothing_is_said() -> None:
    assert dimension_bound((CRANK, C * S - X * Y)) is None
