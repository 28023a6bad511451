"""Bounds of dimensions by random values of coordinates, on sets whose dimension is known by construction."""

from __future__ import annotations

from random import Random

import pytest

from singsym.elimination import engines
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Equations, Ring
from singsym.varieties.real.dimension import independent_coordinates
from singsym.varieties.real.dimension.independent_coordinates import are_dependent, is_missed
from singsym.varieties.real.system import RealSystem

pytestmark = pytest.mark.engines

R = Ring(("x", "y", "z", "w"))
x, y, z, w = R.gens


def least(system: RealSystem) -> int:
    """The least dimension that is confirmed."""
    return next(d for d in range(len(system.ring.names) + 1) if are_dependent(system, d).is_yes)


def flat(codimension: int, rng: Random) -> Equations:
    """Linear equations in general position: a flat of dimension 4 less their number."""
    return tuple(
        sum((g * rng.randint(-9, 9) for g in R.gens), start=R.constant(rng.randint(1, 9)))
        for _ in range(codimension)
    )


@pytest.mark.parametrize("seed", range(6))
def test_a_union_has_the_dimension_of_its_largest_part(seed: int) -> None:
    """Products of the equations of two flats vanish on both."""
    rng = Random(seed)
    first, second = rng.choices((1, 2, 3), k=2)
    parts = flat(first, rng), flat(second, rng)
    products = tuple(p * q for p in parts[0] for q in parts[1])
    assert Ideal(R, products).dimension.value == 4 - min(first, second)
    assert least(RealSystem(R, products)) == 4 - min(first, second)


def test_a_part_on_which_a_coordinate_is_constant_counts() -> None:
    """The plane x = y = 0 beside the curve (t, t^2, t^3, 1): only z and w together see it."""
    curve = (y - x**2, z - x**3, w - 1)
    assert least(RealSystem(R, tuple(p * q for p in (x, y) for q in curve))) == 2


def test_what_is_excluded_does_not_count() -> None:
    """Where x = y = 0 is left out, alone or as the zeros of a sum of squares, the curve is left."""
    curve = (y - x**2, z - x**3, w - 1)
    products = tuple(p * q for p in (x, y) for q in curve)
    assert least(RealSystem(R, products, exclusions=((x,),))) == 1
    assert least(RealSystem(R, products, exclusions=((x, y),))) == 1


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, ...]]:
    """The coordinates that random values are drawn for."""
    found: list[tuple[str, ...]] = []
    original = independent_coordinates.random_values

    def noted(ring: Ring, chosen: tuple[str, ...], random: Random) -> object:
        found.append(chosen)
        return original(ring, chosen, random)

    monkeypatch.setattr(independent_coordinates, "random_values", noted)
    return found


def test_a_circle_is_one_coordinate(drawn: list[tuple[str, ...]]) -> None:
    """Three circles, one angle is the sum of the others: that its circle is one follows from the others."""
    c1, s1, c2, s2, c3, s3 = Ring(("c1", "s1", "c2", "s2", "c3", "s3")).gens
    circles = tuple(c**2 + s**2 - 1 for c, s in ((c1, s1), (c2, s2)))
    system = RealSystem(c1.ring, (*circles, c3 - c1 * c2 + s1 * s2, s3 - s1 * c2 - c1 * s2))
    assert least(system) == 2
    drawn.clear()
    assert are_dependent(system, 2, [("c3", "s3")]).certainty == "modular"
    assert drawn == [("c1", "s1"), ("c2", "s2"), ("c3", "s3")]


def test_a_coordinate_that_another_one_determines_is_not_chosen(drawn: list[tuple[str, ...]]) -> None:
    """Angles with c2 = -c1, or with both in line, and a length with u^3 = 2 are algebraic over the others.

    By the conditions at sight: two angles in line are apart by 0 or 180 degrees.
    """
    c1, s1, c2, s2, c3, s3, u, v = Ring(("c1", "s1", "c2", "s2", "c3", "s3", "u", "v")).gens
    circles = tuple(c**2 + s**2 - 1 for c, s in ((c1, s1), (c2, s2), (c3, s3)))
    ties = (c1 + c2, s1 * c3 - c1 * s3, u**3 - 2)
    system = RealSystem(c1.ring, (*circles, *ties, v**2 * c2 - s3 * u))
    assert are_dependent(system, 1).is_yes
    assert {names[0] for names in drawn} in ({"c1", "v"}, {"c2", "v"}, {"c3", "v"})
    assert least(system) == 1


def test_a_coordinate_is_free_where_its_equation_says_nothing() -> None:
    """c x1 = s x1 holds for all angles at x1 = 0, where x2 is free as well."""
    c, s, x1, x2 = Ring(("c", "s", "x1", "x2")).gens
    system = RealSystem(c.ring, (c**2 + s**2 - 1, x1 * (c - s), x1 * x2))
    assert least(system) == 2


def test_values_that_are_taken_are_not_missed() -> None:
    one = R.one
    assert is_missed((x * y - 1,), {"x": R.zero}).is_yes
    assert is_missed((x * y - 1,), {"x": one}).is_undecided
    assert is_missed((x * y - 1, z - y), {"x": one, "z": 2 * one}).is_yes
    assert is_missed((x * y,), {"x": R.zero, "y": one, "z": one}, (x,)).is_undecided  # no equation is left


def test_without_an_engine_nothing_is_said() -> None:
    with engines.use("sympy"), pytest.raises(engines.EngineUnavailable):
        are_dependent(RealSystem(R, (x * y - z, x**2 - y * w, z**2 - x)), 1)
