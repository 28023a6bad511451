"""Graphs of curves, and how many components are left when points are taken out; by hand."""

from __future__ import annotations

import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.arithmetic import System
from singsym.varieties.real.curves.assembly import Assembly, assemble, count_without, extended
from singsym.varieties.real.curves.critical_points import points_on_components
from singsym.varieties.real.curves.stars import find_stars
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points

R = Ring(("x", "y"))
x, y = R.gens
CIRCLE = x**2 + y**2 - 1
LEMNISCATE = (x**2 + y**2) ** 2 - x**2 + y**2


def graph(curve: Polynomial) -> Assembly:
    samples = points_on_components([curve], 0, Budget(20))
    assert samples is not None
    system = System(R, (curve,))
    stars, found = find_stars(system, [curve], samples.value, 0, Budget(20)).value
    return assemble(system, (curve,), found, stars, Budget(20), True)


def points(*equations: Polynomial) -> tuple[RealPoint, ...]:
    return real_points(equations).value


@pytest.mark.parametrize(
    ("curve", "ends"),
    [
        (CIRCLE, [("loop", "loop")]),
        (LEMNISCATE, [("singular", "singular")] * 2),
        (x * y - 1, [("end", "end")] * 2),
        (y**2 - x**3, [("end", "singular")] * 2),
    ],
    ids=["circle", "lemniscate", "hyperbola", "cusp"],
)
def test_edges(curve: Polynomial, ends: list[tuple[str, str]]) -> None:
    """A loop for the circle; two from the node to itself; two arcs from infinity to infinity, or a cusp."""
    assert sorted(tuple(sorted(kind for kind, _ in e.ends)) for e in graph(curve).edges) == ends


def test_components_of_a_circle_without_points() -> None:
    """No point: 1; one point: still 1; k different points cut it into k arcs, the same point twice once."""
    circle = graph(CIRCLE)
    pair, top = points(y, CIRCLE), points(x, y - 1)
    assert count_without(circle, (), ()) == 1
    assert count_without(circle, top, ()) == 1
    assert count_without(circle, (*top, *top), ()) == 1
    assert count_without(circle, (*pair, *top), ()) == 3


def test_components_of_a_lemniscate_without_points() -> None:
    """Without the node two arcs are left; without (1, 0), on one of its loops, all hangs together."""
    curve = graph(LEMNISCATE)
    node, right = points(x, y), points(x - 1, y)
    assert count_without(curve, (), ()) == 1
    assert count_without(curve, node, ()) == 2
    assert count_without(curve, right, ()) == 1
    assert count_without(curve, (*node, *right), ()) == 3


def test_branches_do_not_meet_at_infinity() -> None:
    """A hyperbola has two components, three without a point of one of them."""
    hyperbola = graph(x * y - 1)
    assert count_without(hyperbola, (), ()) == 2
    assert count_without(hyperbola, points(x - 1, y - 1), ()) == 3


def test_isolated_points_count_where_they_are_kept() -> None:
    """The circle and the point (3, 0) apart: 2 components; of an empty curve the point alone."""
    circle, apart = graph(CIRCLE), points(x - 3, y)
    assert count_without(circle, (), apart) == 2
    assert count_without(Assembly.empty(), (), apart) == 1


def test_a_point_off_the_curve_is_on_none_of_its_arcs() -> None:
    with pytest.raises(Undecided, match="not proven"):
        count_without(graph(CIRCLE), points(x, y), ())


def test_a_curve_is_followed_to_points_beyond_its_ends() -> None:
    """(10^4, 10^-4) is on the hyperbola, farther out than it was followed at first."""
    hyperbola = graph(x * y - 1)
    far = points(x - 10**4, x * y - 1)
    with pytest.raises(Undecided):
        count_without(hyperbola, far, ())
    assert count_without(extended(hyperbola, far, Budget(20)).value, far, ()) == 3
    near = points(x - 1, y - 1)
    assert extended(hyperbola, near, Budget(20)).value is hyperbola
