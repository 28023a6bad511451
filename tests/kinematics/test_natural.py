"""The natural formulation: screws against motion, agreement of its variants, Stewart's polynomial."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from singsym.kinematics.formulations import natural
from singsym.kinematics.formulations.frames import Algebra
from singsym.kinematics.formulations.platforms import body_on_points
from singsym.kinematics.placement import Placement
from singsym.mechanism.fileformat import load
from singsym.minors.determinant import determinant
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring


@pytest.mark.parametrize("quaternion", [False, True])
@pytest.mark.parametrize(
    "name",
    [
        "scara",
        "3rps",
        "3upu-tsai",
        "sarrus",
        "bennett",
        "spherical-fourbar",
        "stewart-gough",
        "zlatanov-hybrid",
    ],
)
def test_screws_are_the_motion(name: str, quaternion: bool, motion_residual: Callable[..., float]) -> None:
    mechanism = load(name)
    assert motion_residual(mechanism, natural.place(mechanism, quaternion=quaternion), 1) < 1e-6


def lines(placement: Placement) -> Polynomial:
    """The determinant of the six legs' Pluecker coordinates."""
    rows = []
    for i in range(1, 7):
        g, b = placement.screws[f"P{i}"][3:], placement.space.points[f"A{i}"]
        rows.append((*g, *(b[j] * g[k] - b[k] * g[j] for j, k in ((1, 2), (2, 0), (0, 1)))))
    return determinant(PolynomialMatrix.of(placement.space.ring, rows))


@pytest.mark.parametrize(("name", "count"), [("stewart-gough", 20), ("stewart-gough-planar", 16)])
def test_stewart_at_fixed_orientation(name: str, count: int) -> None:
    """Row 12: a cubic in position with 20 monomials, 16 for planar ones; 7 unknowns."""
    placement = natural.place(load(name), quaternion=True)
    assert placement.space.variables == ("x", "y", "z", "q0", "q1", "q2", "q3")
    polynomial = lines(placement)
    turned = polynomial.substitute({"q0": 3, "q1": 1, "q2": -2, "q3": 1})
    assert (len(turned), turned.total_degree) == (count, 3)
    if name == "stewart-gough-planar":
        level = polynomial.substitute({"q0": 1, "q1": 0, "q2": 0, "q3": 0})
        assert [str(f) for f, _ in level.factors()] == ["z"]


def test_a_leg_that_may_vanish_has_a_direction_of_its_own() -> None:
    """Without exclusions each leg has a length and a unit vector, and its screw is that of the vector."""
    space = natural.place(replace(load("stewart-gough"), exclusions=())).space
    assert len(space.variables) == 9 + 6 * 4
    assert max(equation.total_degree for equation in space.equations) == 2


def test_points_and_quaternion_agree_on_stewart() -> None:
    """The same configuration in both: the determinants are equal numbers, for the unit quaternion."""
    mechanism = load("stewart-gough")
    by_pose, by_points = natural.place(mechanism, quaternion=True), natural.place(mechanism)
    q = np.array([0.5, 0.5, -0.1, 0.7])
    pose = [0.3, -0.4, 2.0, *(q / np.linalg.norm(q))]
    corners = {name: [float(x.evaluate(pose)) for x in p] for (_, name), p in by_pose.link_points.items()}
    values = [corners[v[2:]]["xyz".index(v[0])] for v in by_points.space.ring.names]
    for equation in by_points.space.equations:
        assert float(equation.evaluate(values)) == pytest.approx(0, abs=1e-9)
    expected = float(lines(by_pose).evaluate(pose))
    assert float(lines(by_points).evaluate(values)) == pytest.approx(expected)


def test_a_body_on_three_points_is_not_its_mirror_image() -> None:
    """The fourth point of a turned tetrahedron is on the right side."""
    ring = Ring(("x",))
    algebra = Algebra(ring, ring.from_sympy)
    inner = [tuple(ring.constant(x).to_sympy() for x in p) for p in ((0, 0, 0), (2, 0, 0), (1, 3, 0))]
    quarter_turn = [tuple(ring.constant(x) for x in p) for p in ((1, 1, 1), (1, 3, 1), (-2, 2, 1))]
    body = body_on_points(algebra, quarter_turn, inner)
    fourth = tuple(ring.constant(x).to_sympy() for x in (0, 0, 5))
    assert [int(x.constant.p) for x in body.point(fourth)] == [1, 1, 6]
