"""Tracking along curves whose arcs are known: circles, lines, a twisted cubic."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.polynomials import Ring
from singsym.varieties.real.curves.arithmetic import System
from singsym.varieties.real.curves.tracking import Marks, kernels, newton, tangents, track

R = Ring(("x", "y"))
x, y = R.gens
S = Ring(("x", "y", "z"))
X, Y, Z = S.gens
CIRCLE = System(R, (x**2 + y**2 - 1,))
CUBIC = System(S, (Y - X**2, Z - X**3, X * Z - Y**2))


def marks(points: list[tuple[float, ...]], ways: list[tuple[float, ...]]) -> Marks:
    """For each point two half-edges, along its way and against it."""
    owner = np.repeat(np.arange(len(points)), 2)
    directions = np.array([sign * np.array(way) for way in ways for sign in (1.0, -1.0)])
    return Marks(np.array(points), owner, directions)


def test_newton_moves_in_the_normal_plane() -> None:
    """From (0.9, 0.1) along x to the circle: y stays, x = sqrt(1 - 0.01)."""
    found, moved = newton(CIRCLE, np.array([[0.9, 0.1]]), np.array([[0.0, 1.0]]), 8)
    assert found[0] == pytest.approx([0.99**0.5, 0.1])
    assert moved[0] < 1e-9


@pytest.mark.parametrize("system", [CIRCLE, System(R, (x**2 + y**2 - 1, x * (x**2 + y**2 - 1)))])
def test_tangents_are_on_the_side_asked_for(system: System) -> None:
    """At (3/5, 4/5) the tangent of the circle is (4, -3)/5, or its opposite; two equations agree."""
    point, way = np.array([[0.6, 0.8]]), np.array([0.8, -0.6])
    for sign in (1.0, -1.0):
        assert tangents(system, point, sign * np.array([[1.0, 0.0]]))[0] == pytest.approx(sign * way)
    assert abs(kernels(system, point)[0] @ way) == pytest.approx(1.0)


def test_tangents_of_an_overdetermined_curve() -> None:
    """(t, t^2, t^3) at t = 1: (1, 2, 3)/sqrt 14."""
    along = tangents(CUBIC, np.array([[1.0, 1.0, 1.0]]), np.array([[1.0, 0.0, 0.0]]))[0]
    assert along == pytest.approx(np.array([1.0, 2.0, 3.0]) / 14**0.5, abs=1e-6)


def test_once_around_a_circle_back_to_its_mark() -> None:
    """From (1, 0) upwards the arc arrives from below: on the half-edge that leaves downwards."""
    found = track(CIRCLE, marks([(1.0, 0.0)], [(0.0, 1.0)]), np.arange(2))
    assert {(t.start, t.end) for t in found} == {(0, 1), (1, 0)}
    for arc in found:
        assert np.abs(np.linalg.norm(arc.points, axis=1) - 1).max() < 1e-6
        assert arc.points[:, 0].min() < -0.9


def test_arcs_stop_at_the_next_mark() -> None:
    """Two marks on a circle: each of the two half circles joins half-edges of both."""
    found = track(CIRCLE, marks([(1.0, 0.0), (-1.0, 0.0)], [(0.0, 1.0), (0.0, 1.0)]), np.arange(4))
    assert {(t.start, t.end) for t in found} == {(0, 2), (2, 0), (1, 3), (3, 1)}
    assert all((arc.points[:, 1] >= -1e-9).all() for arc in found if arc.start == 0)


def test_no_jump_to_a_curve_beside() -> None:
    """Circles of radius 1 and 1.05: an arc of one does not end at the mark of the other."""
    both = System(R, ((x**2 + y**2 - 1) * (400 * x**2 + 400 * y**2 - 441),))
    found = track(both, marks([(1.0, 0.0), (1.05, 0.0)], [(0.0, 1.0), (0.0, 1.0)]), np.arange(4))
    assert {(t.start, t.end) for t in found} == {(0, 1), (1, 0), (2, 3), (3, 2)}


def test_a_branch_to_infinity_does_not_arrive() -> None:
    """From the vertex of a parabola both ways go off for ever."""
    parabola = System(R, (y - x**2,))
    assert track(parabola, marks([(0.0, 0.0)], [(1.0, 0.0)]), np.arange(2), steps=60) == []
