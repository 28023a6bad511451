"""Coupler curves and circles: all points where they meet, in balls."""

from __future__ import annotations

from functools import partial

import pytest
from flint import arb

from singsym.effort.budget import Undecided
from singsym.polynomials import Equations, Ring
from singsym.polynomials.block_form import Module
from singsym.varieties.real.modules.module_points import module_points
from singsym.varieties.real.modules.triads import triad
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.points.intervals import at_precision
from tests.laws.draws import SEED, draw

R = Ring(("a", "b", "x", "y", "u", "v"))
A, B, X, Y, U, V = R.gens


def coupler(crank: int, side: int, rocker: int, reach: int) -> Equations:
    """(x, y) about (1, 0); (u, v) at `side` from it, twice as far beyond it at `rocker` from (5, 1); and at
    `reach` from (a, b)."""
    return (
        (X - 1) ** 2 + Y**2 - crank**2,
        (U - X) ** 2 + (V - Y) ** 2 - side**2,
        (3 * U - 2 * X - 5) ** 2 + (3 * V - 2 * Y - 1) ** 2 - rocker**2,
        (U - A) ** 2 + (V - B) ** 2 - reach**2,
    )


@pytest.mark.parametrize("number", range(6))
def test_as_many_as_by_algebra(number: int) -> None:
    """The equations have finitely many solutions, and algebra finds all that are real; see `real_points`."""
    random = draw("triads", number)
    length = partial(random.randint, 1, 5)
    equations = coupler(length(), length(), length(), length())
    at = {"a": random.randint(-2, 3), "b": random.randint(-2, 3)}
    found = triad(Module(equations, ("x", "y", "u", "v"), ("a", "b")))
    assert found is not None
    exact = real_points((*equations, A - at["a"], B - at["b"])).value
    with at_precision(256):
        try:
            known = list(found.solutions({name: arb(value) for name, value in at.items()}))
        except Undecided:
            return
    assert len(known) == len(exact), f"SINGSYM_SEED={SEED}"
    for point in exact:
        near = dict(zip(R.names, point.floats, strict=True))
        assert any(all(abs(float(v.mid()) - near[n]) < 1e-9 for n, v in one.items()) for one in known)


def test_two_solutions_that_are_one_are_not_two() -> None:
    """All in line: crank (1, 0) to (2, 0), side to (3, 0), rocker (4, 0) to (5, 0).  The coupler curve is
    symmetric to that line, and so touches the circle of 2 about (5, 0) where both meet it."""
    touching = (
        (X - 1) ** 2 + Y**2 - 1,
        (U - X) ** 2 + (V - Y) ** 2 - 1,
        (2 * U - X - 5) ** 2 + (2 * V - Y) ** 2 - 1,
        (U - 5) ** 2 + V**2 - A**2,
    )
    found = triad(Module(touching, ("x", "y", "u", "v"), ("a",)))
    assert found is not None
    with at_precision(256), pytest.raises(Undecided):
        list(found.solutions({"a": arb(2)}))


def test_others_are_no_triads() -> None:
    ring = Ring(("x", "y", "u", "v"))
    x, y, u, v = ring.gens
    ellipse = (2 * x**2 + y**2 - 1, (u - x) ** 2 + (v - y) ** 2 - 1, u**2 + v**2 - x, u**2 + v**2 + v - y)
    circle = (x**2 + y**2 - 2, *ellipse[1:])
    for equations in (ellipse, circle):
        assert triad(Module(equations, ("x", "y", "u", "v"), ())) is None


def test_over_a_tower_nothing_is_traced(monkeypatch: pytest.MonkeyPatch) -> None:
    """(a, b) is a corner of a triangle over another one, and a coupler is at 3 from there: with all equations
    at once, algebra finds as many points."""
    ring = Ring(("p", "q", *R.names))
    p, q = ring.gen("p"), ring.gen("q")
    a, b = map(ring.convert, (A, B))
    corner = (p**2 + q**2 - 16, (p - 5) ** 2 + q**2 - 16)
    second = ((a - p) ** 2 + (b - q) ** 2 - 5, (a - 5) ** 2 + b**2 - 4)
    equations = (*corner, *second, *map(ring.convert, coupler(2, 3, 4, 3)))
    exact = real_points(equations).value

    def traced(*_: object) -> None:
        pytest.fail("a curve is traced")

    monkeypatch.setattr("singsym.varieties.real.modules.module_points.points_on_tower", traced)
    assert len(module_points(equations).value) == len(exact) > 0
