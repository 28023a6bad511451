"""The spherical formulation against joint angles, motion, and a spherical triangle."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import pytest
import sympy

from singsym.kinematics import check_mobility, place, sample_configurations, velocity_equation
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.mechanism import load
from singsym.mechanism.model import Joint, JointKind, JointRate, Link, Mechanism, PointVelocity, Space, Twist
from singsym.polynomials.compiled_map import numerical_matrix

HALF = sympy.Rational(1, 2)
AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "p": ("3/5", "4/5", 0), "q": (0, "3/5", "4/5")}


def link(
    name: str, axes: Mapping[str, str], centre: Sequence[int] = (0, 0, 0), **points: Sequence[int]
) -> Link:
    exact = {k: tuple(sympy.sympify(c) for c in AXES[v]) for k, v in axes.items()}
    places = {k: tuple(map(sympy.Integer, v)) for k, v in {"O": centre, **points}.items()}
    return Link(name, places, exact)


def hinge(name: str, first: str, second: str) -> Joint:
    return Joint(name, JointKind.R, first, second, ("O", "O"), (name, name))


def wrist() -> Mechanism:
    """An open chain of three hinges with its centre off the fixed origin and a tool."""
    return Mechanism(
        "wrist",
        Space.SPHERICAL,
        "ground",
        (
            link("ground", {"A": "z"}, (1, 2, 3)),
            link("one", {"A": "z", "B": "x"}),
            link("two", {"B": "x", "C": "p"}),
            link("hand", {"C": "p"}, (1, 1, 1), tip=(3, 1, 2)),
        ),
        (hinge("A", "ground", "one"), hinge("B", "one", "two"), hinge("C", "two", "hand")),
        ("A", "B", "C"),
        (Twist("hand", "tip", ("wx", "wy", "wz")),),
    )


def three_rrr() -> Mechanism:
    """Three legs of three hinges to a platform with three axes (a spherical parallel manipulator)."""
    links = [
        link("ground", {"A1": "x", "A2": "y", "A3": "z"}),
        link("top", {"C1": "z", "C2": "q", "C3": "p"}),
    ]
    joints = []
    for i in "123":
        links += [
            link(f"low{i}", {f"A{i}": "x", f"B{i}": "p"}),
            link(f"high{i}", {f"B{i}": "y", f"C{i}": "q"}),
        ]
        joints += [
            hinge(f"A{i}", "ground", f"low{i}"),
            hinge(f"B{i}", f"low{i}", f"high{i}"),
            hinge(f"C{i}", f"high{i}", "top"),
        ]
    inputs = ("A1", "A2", "A3")
    output = Twist("top", "O", ("wx", "wy", "wz"))
    return Mechanism("agile", Space.SPHERICAL, "ground", tuple(links), tuple(joints), inputs, (output,))


MECHANISMS = {"fourbar": lambda: load("spherical-fourbar").resolved, "wrist": wrist, "3rrr": three_rrr}


@pytest.mark.parametrize("name", ["fourbar", "3rrr"])
def test_screws_are_the_motion(name: str, motion_residual: Callable[..., float]) -> None:
    mechanism = MECHANISMS[name]()
    assert motion_residual(mechanism, place(mechanism, "spherical"), seed=1) < 1e-7


@pytest.mark.parametrize("name", list(MECHANISMS))
def test_ranks_agree_with_those_of_joint_angles(name: str) -> None:
    mechanism = MECHANISMS[name]()
    vectors, angles = (
        check_mobility(velocity_equation(mechanism, f), seed=3) for f in ("spherical", "joint")
    )
    assert vectors.ranks == angles.ranks
    assert vectors.messages == ()


def test_variables_of_a_platform_with_three_axes() -> None:
    """C3 follows from C1 and C2: five vectors for six moving axes."""
    space = place(three_rrr(), "spherical").space
    stems = {name[:-1] for name in space.variables}
    assert len(stems) == 5
    assert all(e.total_degree <= 4 for e in space.equations)


def test_no_mirror_image_of_a_link_enters() -> None:
    """det(C1, C2, C3) of the platform keeps its sign in every configuration."""
    placed = place(three_rrr(), "spherical")
    local = np.array([[float(sympy.sympify(c)) for c in AXES[a]] for a in ("z", "q", "p")])
    for point in sample_configurations(placed.space, 5, 2):
        axes = [[float(c.evaluate(list(point))) for c in placed.space.directions[f"C{i}"]] for i in (1, 2, 3)]
        assert np.linalg.det(axes) == pytest.approx(np.linalg.det(local))


def test_points_move_about_the_centre() -> None:
    """The tip's velocity is w x (tip - centre), with the centre at (1, 2, 3): |v| <= |w| |tip - centre|."""
    mechanism = replace(wrist(), outputs=(PointVelocity("hand", "tip", ("x", "y", "z")),), mobility=3)
    equation = velocity_equation(mechanism, "spherical")
    placed = place(mechanism, "spherical")
    (point,) = sample_configurations(equation.space, 1, 4)
    tip = np.array([float(c.evaluate(list(point))) for c in placed.link_points["hand", "tip"]])
    assert np.linalg.norm(tip - [1, 2, 3]) == pytest.approx(np.sqrt(5))
    for name in "ABC":
        column = {c.label: j for j, c in enumerate(equation.columns)}[name]
        moved = -numerical_matrix(equation.matrix, point)[:3, column]
        axis = np.array([float(c.evaluate(list(point))) for c in placed.screws[name]])
        assert moved == pytest.approx(np.cross(axis, tip - [1, 2, 3]))


def test_a_folded_fourbar_is_singular() -> None:
    """Where A, B, C lie on one great circle the follower is at rest: L_O or L_I loses a rank, L does not."""
    mechanism = replace(load("spherical-fourbar"), outputs=(JointRate("D"),))
    equation = velocity_equation(mechanism, "spherical")
    a, b, c = (equation.space.directions[name] for name in "ABC")
    volume = sum(
        (a[i] * (b[j] * c[k] - b[k] * c[j]) for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))),
        start=equation.space.ring.zero,
    )
    folded = replace(equation.space, equations=(*equation.space.equations, volume))
    for point in sample_configurations(folded, 3, 1):
        found = [
            numerical_rank(numerical_matrix(m, point)).rank for m in (equation.L, equation.L_O, equation.L_I)
        ]
        assert found == [4, 3, 4]


def test_what_is_refused() -> None:
    with pytest.raises(ValueError, match="spherical"):
        place(load("fourbar"), "spherical")
    slider = replace(wrist().joints[0], kind=JointKind.P)
    with pytest.raises(ValueError, match="R joints only"):
        place(replace(wrist(), joints=(slider, *wrist().joints[1:])), "spherical")
    with pytest.raises(ValueError, match="not attached"):
        place(replace(wrist(), joints=wrist().joints[:2]), "spherical")
