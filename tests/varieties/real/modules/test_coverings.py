"""Curves of dyads over a circle as graphs: four-bars that fold, of which all is known."""

from __future__ import annotations

from contextlib import suppress
from functools import partial

import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Known
from singsym.polynomials import Equations, Ring
from singsym.varieties.real.curves.real_curve import real_curve
from singsym.varieties.real.modules.coverings import coverings
from singsym.varieties.real.modules.curve_components import components_off
from singsym.varieties.real.modules.module_points import points_of
from singsym.varieties.real.modules.towers import towers
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.exact_point import RealPoint
from tests.laws.draws import SEED, draw
from tests.varieties.real.modules.four_bars import RING, C, S, X, Y, four_bar


@pytest.mark.parametrize(
    ("lengths", "nodes"),
    [((1, 3, 2, 3), 0), ((2, 2, 2, 5), 0), ((1, 2, 2, 3), 1), ((1, 2, 1, 2), 2), ((1, 1, 1, 3), 0)],
)
def test_nodes_are_where_all_bars_are_in_line(lengths: tuple[int, int, int, int], nodes: int) -> None:
    """Four arcs meet where the sum of two lengths is that of the others and the bars are folded so, once in a
    kite or a four-bar with 1 + 3 = 2 + 2, twice in a parallelogram."""
    (curve,) = coverings(next(towers(four_bar(*lengths))), points_of, Budget()).value
    ends = [k for arc in curve.arcs for k in arc.ends]
    assert sum(ends.count(k) == 4 for k in range(len(curve.points))) == nodes


@pytest.mark.parametrize(
    ("lengths", "components"),
    [((1, 3, 2, 3), 2), ((2, 2, 2, 5), 1), ((1, 2, 2, 3), 1), ((1, 2, 1, 2), 1), ((1, 1, 1, 3), 1)],
)
def test_components(lengths: tuple[int, int, int, int], components: int) -> None:
    """Grashof: two where the shortest and the longest are together less than the others; one where they are
    equal, as the branches cross; the last is rigid, a point."""
    assert components_off(four_bar(*lengths), (), Budget()) == components
    assert (
        components_off(tuple(p.reflect(("c", "x")) for p in four_bar(*lengths)), (), Budget()) == components
    )


def test_branches_that_are_excluded() -> None:
    """Of a parallelogram with bars 1 and 2 the parallel branch is C = B + (2, 0); y = s on it, and on the
    other only where both are 0, and y = 0 nowhere else on either; 0 = 0 on all of the curve."""
    curve = four_bar(1, 2, 1, 2)
    parallel = (X - C - 2, Y - S)
    assert components_off(curve, (parallel,), Budget()) == 1
    assert components_off(curve, ((Y - S,),), Budget()) == 1
    assert components_off(curve, (parallel, (RING.zero,)), Budget()) == 0
    assert components_off(curve, ((Y,),), Budget()) == 1


def test_over_two_points_beside_it() -> None:
    """Two values of w, which has nothing to do with the four-bar, and over each its two components."""
    ring = Ring(("w", "c", "s", "x", "y"))
    w = ring.gen("w")
    four = tuple(map(ring.convert, four_bar(1, 3, 2, 3)))
    assert components_off((w**2 - 2, *four), (), Budget()) == 4
    assert components_off((w**2 - 4, *four), ((w + 2,),), Budget()) == 2
    assert components_off((w**2 + 4, *four), (), Budget()) == 0


def test_a_dyad_that_turns_freely() -> None:
    """A rhombus of bars 1: where B is at D the dyad turns about both, a circle over one point."""
    with pytest.raises(Undecided):
        coverings(next(towers(four_bar(1, 1, 1, 1))), points_of, Budget())


def test_two_dyads_one_upon_the_other() -> None:
    """A crank-rocker 1, 3, 2, 3, and on the coupler's end a dyad of bars 9 and 9 to (5, 0): the end is at
    most 4 from the origin, so between 1 and 9 from there, and the dyad never in line: each branch twice."""
    ring = Ring(("c", "s", "x", "y", "u", "v"))
    x, y, u, v = (ring.gen(n) for n in "xyuv")
    four = tuple(map(ring.convert, four_bar(1, 3, 2, 3)))
    dyad = ((u - x) ** 2 + (v - y) ** 2 - 81, (u - 5) ** 2 + v**2 - 81)
    assert components_off((*four, *dyad), (), Budget()) == 4


@pytest.mark.parametrize("number", range(8))
def test_as_many_components_as_when_traced(number: int) -> None:
    """Four-bars with small lengths, every other one with a second dyad: `real_curve` traces the whole."""
    random = draw("coverings", number)
    length = partial(random.randint, 1, 4)
    curve = four_bar(length(), length(), length(), length())
    if number % 2:
        ring = Ring(("c", "s", "x", "y", "u", "v"))
        u, v = ring.gen("u"), ring.gen("v")
        x, y = map(ring.gen, random.choice(("cs", "xy")))
        dyad = (
            (u - x) ** 2 + (v - y) ** 2 - random.randint(1, 5) ** 2,
            (u - random.randint(-3, 5)) ** 2 + (v - random.randint(0, 2)) ** 2 - random.randint(1, 5) ** 2,
        )
        curve = (*map(ring.convert, curve), *dyad)
    traced = real_curve(curve)
    with suppress(Undecided, ValueError):
        assert components_off(curve, (), Budget(20)) == traced.connected_components, f"SINGSYM_SEED={SEED}"


def test_a_dyad_is_stretched_or_folded() -> None:
    """Its discriminant is a product of two circles in its parents, each of which is asked for by itself."""
    asked = list[int]()

    def solve(equations: Equations) -> Known[tuple[RealPoint, ...]] | Known[tuple[BoxPoint, ...]]:
        asked.append(max(p.total_degree for p in equations))
        return points_of(equations)

    (curve,) = coverings(next(towers(four_bar(1, 3, 2, 3))), solve, Budget()).value
    assert asked == [2, 2]
    assert len(curve.arcs) == 2


def test_a_dyad_in_line_on_all_of_a_curve() -> None:
    """(x, y) at 2 from the origin; a dyad of bars 1 and 3 from there to it is folded wherever it is, with its
    elbow at -(x, y) / 2.  On the elbow a dyad of 2 and 2 to (2, 0), at least 1 and at most 3 from it: never
    in line, it is above or below.  One of 1 and 1 stands over one arc of the circle, at whose ends it is
    stretched, so that its sheets meet."""
    ring = Ring(("x", "y", "a", "b", "u", "v"))
    x, y, a, b, u, v = ring.gens
    folded = (x**2 + y**2 - 4, a**2 + b**2 - 1, (a - x) ** 2 + (b - y) ** 2 - 9)
    for length, components in ((2, 2), (1, 1)):
        dyad = ((u - a) ** 2 + (v - b) ** 2 - length**2, (u - 2) ** 2 + v**2 - length**2)
        assert components_off((*folded, *dyad), (), Budget()) == components
    assert components_off((*folded, *dyad), ((2 * a + x, 2 * b + y),), Budget()) == 0
    assert components_off((*folded, *dyad), ((2 * a - x,),), Budget()) == 1
