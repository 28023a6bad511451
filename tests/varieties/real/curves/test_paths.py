"""Chains of arcs: how they are put together, and which of them are proven."""

from __future__ import annotations

import numpy as np

from singsym.effort.budget import Budget
from singsym.polynomials import Ring
from singsym.varieties.real.curves.arithmetic import Array, Balls, System
from singsym.varieties.real.curves.paths import Chain, chains, contained, pair_tracks, prove_chains
from singsym.varieties.real.curves.tracking import Marks, Track

R = Ring(("x", "y"))
x, y = R.gens
CIRCLE = System(R, (x**2 + y**2 - 1,))


def on_circle(*angles: float) -> Array:
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def polygon(corners: int) -> Array:
    return on_circle(*np.linspace(0, 2 * np.pi, corners + 1)[:-1], 0.0)


def segment(start: int, end: int, way: float = 1.0) -> Track:
    return Track(start, end, np.array([[float(start), 0.0], [float(end), way]]))


def test_arcs_are_joined_into_loops_and_edges() -> None:
    """Marks 0, 1 are on a loop of two arcs; marks 2, 3 are gates with one half-edge each: an edge."""
    marks = Marks(np.zeros((4, 2)), np.array([0, 0, 1, 1, 2, 3]), np.zeros((6, 2)))
    pairs = [(0, 2), (2, 0), (1, 3), (3, 1), (4, 5), (5, 4)]
    found = chains(marks, {start: segment(start, end) for start, end in pairs})
    assert sorted((c.closed, tuple(sorted(c.marks))) for c in found) == [(False, (2, 3)), (True, (0, 1))]


def test_an_edge_goes_through_a_smooth_mark() -> None:
    """Gate, mark, gate: one edge with all three, its middle point once."""
    marks = Marks(np.zeros((3, 2)), np.array([0, 1, 1, 2]), np.zeros((4, 2)))
    pairs = [(0, 1), (1, 0), (2, 3), (3, 2)]
    (edge,) = chains(marks, {start: segment(start, end) for start, end in pairs})
    assert (edge.closed, edge.marks, len(edge.points)) == (False, (0, 1, 2), 3)


def test_half_edges_that_do_not_pair_up_have_a_reason() -> None:
    """A circle from one mark pairs up; the way from (1, 1) into a cusp does not arrive."""
    mark = Marks(np.array([[1.0, 0.0]]), np.array([0, 0]), np.array([[0.0, 1.0], [0.0, -1.0]]))
    found = pair_tracks(CIRCLE, mark, np.arange(2), 0.3)
    assert not isinstance(found, str)
    assert (found[0].end, found[1].end) == (1, 0)
    inward = Marks(np.array([[1.0, 1.0]]), np.array([0]), np.array([[-2.0, -3.0]]) / 13**0.5)
    lost = pair_tracks(System(R, (y**2 - x**3,)), inward, np.arange(1), 0.3)
    assert isinstance(lost, str)
    assert "did not arrive" in lost


def test_a_loop_is_proven_after_cutting_its_segments() -> None:
    """Twelve corners are too few for tubes: points of the circle are put in between."""
    proven = prove_chains(CIRCLE, [Chain(polygon(12), (0,), True)], Budget(20))
    assert not isinstance(proven, str)
    (loop,) = proven
    assert len(loop.points) > 13
    assert np.abs(np.linalg.norm(loop.points, axis=1) - 1).max() < 1e-9
    assert loop.tubes is not None
    assert loop.tubes.proven.all()


def test_a_chain_that_leaves_the_curve_is_not_proven() -> None:
    """From one branch of x y = 1 to the other."""
    jump = Chain(np.array([[1.0, 1.0], [-1.0, -1.0]]), (0, 1), False)
    assert isinstance(prove_chains(System(R, (x * y - 1,)), [jump], Budget(20)), str)


def test_no_chain_is_proven_through_a_crossing() -> None:
    through = Chain(np.array([[-1.0, 0.0], [1.0, 0.0]]), (0, 1), False)
    assert isinstance(prove_chains(System(R, (x * y,)), [through], Budget(20)), str)


def test_a_chain_that_turns_back_is_not_proven() -> None:
    """Each of its two segments is an arc of the circle, but the second does not go on from the first."""
    there_and_back = Chain(on_circle(0.0, 0.1, 0.0), (0, 1), False)
    assert isinstance(prove_chains(CIRCLE, [there_and_back], Budget(20)), str)


def test_what_is_on_a_chain_and_what_is_not() -> None:
    """A quarter of the circle: 45 degrees is on it, 135 degrees and the centre are not."""
    quarter = Chain(on_circle(*np.linspace(0, np.pi / 2, 40)), (0, 1), False)
    proven = prove_chains(CIRCLE, [quarter], Budget(20))
    assert not isinstance(proven, str)
    points = np.concatenate([on_circle(np.pi / 4, 3 * np.pi / 4), [[0.0, 0.0]]])
    inside, outside = contained(proven, Balls(points, np.full((3, 2), 1e-12)))
    assert inside[:, 0].tolist() == [True, False, False]
    assert outside[:, 0].tolist() == [False, True, True]


def test_a_chain_that_is_only_drawn_holds_nothing_for_sure() -> None:
    inside, _ = contained([Chain(polygon(12), (0,), True)], Balls(on_circle(0.0), np.zeros((1, 2))))
    assert not inside.any()
