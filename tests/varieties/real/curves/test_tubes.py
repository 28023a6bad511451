"""What tubes must prove, and what they must refuse to prove."""

import numpy as np

from singsym.polynomials import Ring
from singsym.varieties.real.curves.arithmetic import Balls, System
from singsym.varieties.real.curves.tubes import joined, location, prove_tubes

x, y = Ring(("x", "y")).gens
CIRCLE = System(x.ring, (x**2 + y**2 - 1,))


def on_circle(*angles):
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def test_arcs_of_a_circle_join():
    points = on_circle(*np.linspace(0, 2 * np.pi, 60))
    tubes = prove_tubes(CIRCLE, points[:-1], points[1:])
    assert tubes.proven.all()
    assert joined(tubes.take(np.arange(58)), tubes.take(np.arange(1, 59))).all()


def test_turning_back_is_no_junction():
    points = on_circle(0.0, 0.1, 0.0)
    tubes = prove_tubes(CIRCLE, points[:-1], points[1:])
    assert tubes.proven.all()
    assert not joined(tubes.take(np.array([0])), tubes.take(np.array([1]))).any()


def test_gaps_and_chords_are_refused():
    points = on_circle(0.0, 0.1, 0.2, 0.3)
    tubes = prove_tubes(CIRCLE, points[[0, 2]], points[[1, 3]])
    assert not joined(tubes.take(np.array([0])), tubes.take(np.array([1]))).any()
    across = prove_tubes(CIRCLE, on_circle(0.0), on_circle(3.0))
    assert not across.proven.any()


def test_no_tube_through_a_node_and_an_honest_error_off_the_curve():
    off = prove_tubes(CIRCLE, np.array([[0.9, 0.0]]), np.array([[0.9, 0.05]]))
    assert not off.proven.any() or off.error[0] > 0.1
    far = prove_tubes(CIRCLE, np.array([[0.5, 0.0]]), np.array([[0.5, 0.05]]))
    assert not far.proven.any() or far.error[0] > 0.5
    cross = System(x.ring, (x * y,))
    assert not prove_tubes(cross, np.array([[-0.1, 0.0]]), np.array([[0.1, 0.0]])).proven.any()
    near = System(x.ring, (x * y - y**2 - y / 10**12,))
    assert not prove_tubes(near, np.array([[-0.1, 0.0]]), np.array([[0.1, 0.0]])).proven.any()


def test_no_jump_between_close_branches():
    lines = System(x.ring, (y**2 - x.ring.constant(1) / 10**12,))
    jump = prove_tubes(lines, np.array([[0.0, 1e-6]]), np.array([[1.0, -1e-6]]))
    stay = prove_tubes(lines, np.array([[0.0, 1e-6]]), np.array([[1e-3, 1e-6]]))
    assert not jump.proven.any()
    assert not stay.proven.any() or stay.radius[0] < 2e-6


def test_location_decides_membership():
    points = on_circle(0.0, 0.1)
    tubes = prove_tubes(CIRCLE, points[:1], points[1:])
    asked = Balls(on_circle(0.05, 0.5, np.pi), np.full((3, 2), 1e-12))
    inside, outside = location(tubes, asked)
    assert inside[:, 0].tolist() == [True, False, False]
    assert outside[:, 0].tolist() == [False, True, True]


def test_overdetermined_systems():
    X, Y, Z = Ring(("x", "y", "z")).gens
    cubic = System(X.ring, (Y - X**2, Z - X**3, X * Z - Y**2))
    t = np.linspace(0, 1, 30)
    points = np.stack([t, t**2, t**3], axis=1)
    tubes = prove_tubes(cubic, points[:-1], points[1:])
    assert tubes.proven.all()
