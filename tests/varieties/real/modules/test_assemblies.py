"""Assemblies of modules over points that are known by balls."""

from __future__ import annotations

import pytest
from flint import arb

from singsym.effort.budget import Undecided
from singsym.polynomials import Ring
from singsym.polynomials.block_form import Module
from singsym.varieties.real.modules.assemblies import assemblies, dyad, is_simple, real_roots_of

R = Ring(("a", "b", "x", "y"))
A, B, X, Y = R.gens
CIRCLES = Module(((X - A) ** 2 + (Y - B) ** 2 - 25, X**2 + Y**2 - 25), ("x", "y"), ("a", "b"))


def test_two_circles() -> None:
    """Radii 5 about (0, 0) and (6, 8): the middle is (3, 4), half the distance 5: they touch at (3, 4).
    About (6, 0): x = 3, y = -4 or 4.  About (11, 0): none."""
    found = assemblies(CIRCLES, {"a": arb(6), "b": arb(0)})
    assert [(float(p["x"].mid()), float(p["y"].mid())) for p in found] == [(3, -4), (3, 4)]
    assert assemblies(CIRCLES, {"a": arb(11), "b": arb(0)}) == []
    with pytest.raises(Undecided, match="one"):
        assemblies(CIRCLES, {"a": arb(6), "b": arb(8)})


def test_a_dyad_that_turns_freely() -> None:
    """Both circles are the same one."""
    with pytest.raises(Undecided, match="turns freely"):
        assemblies(CIRCLES, {"a": arb(0), "b": arb(0)})


def test_the_discriminant_of_two_circles() -> None:
    """Positive where the centres are less than 10 apart."""
    found = dyad(CIRCLES)
    assert found is not None
    signs = [
        float(found.discriminant.evaluate([float(a), float(b), 0.0, 0.0]))
        for a, b in ((6, 0), (6, 8), (11, 0))
    ]
    assert signs[0] > 0 == signs[1] > signs[2]


def test_a_circle_and_a_hyperbola_are_no_dyad() -> None:
    assert not is_simple(Module((X**2 + Y**2 - A, X * Y - B), ("x", "y"), ("a", "b")))


def test_real_roots_of_a_cubic() -> None:
    """x^3 - x has -1, 0, 1; x^3 - 1 has 1; a double root is not decided in balls."""
    roots = real_roots_of([arb(0), arb(-1), arb(0), arb(1)])
    assert [round(float(r.mid()), 12) for r in roots] == [-1, 0, 1]
    assert len(real_roots_of([arb(-1), arb(0), arb(0), arb(1)])) == 1
    with pytest.raises(Undecided):
        real_roots_of([arb(1), arb(-2), arb(1)])


def test_a_parent_without_a_value_may_have_any() -> None:
    with pytest.raises(Undecided):
        assemblies(CIRCLES, {"a": arb(6)})
