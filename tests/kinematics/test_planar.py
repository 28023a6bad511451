"""The planar formulation: variables, loop equations, screws, on published and on hand-made linkages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
import sympy

from singsym.elimination.ideal import Ideal
from singsym.kinematics import check_mobility, place, velocity_equation
from singsym.kinematics.reduction import reduce
from singsym.mechanism import MechanismError, load
from singsym.mechanism.model import Exclusion, Limit, Mechanism
from singsym.minors.determinant import determinant
from tests.kinematics.linkages import (
    EVERY,
    inverted_slider,
    link,
    parallel_slides,
    planar,
    skew_yoke,
    slide,
)

LIBRARY = ["zlatanov-2dof", "fourbar", "slider-crank", "five-bar", "3rpr", "3rrr", "pentagon", "2r"]


@pytest.mark.parametrize("name", LIBRARY)
def test_screws_of_the_library_are_the_motion(name: str, motion_residual: Callable[..., float]) -> None:
    mechanism = load(name)
    assert motion_residual(mechanism.resolved, place(mechanism, "planar"), seed=2) < 1e-7


@pytest.mark.parametrize("make", EVERY, ids=lambda make: make.__name__)
def test_screws_with_slides_are_the_motion(
    make: Callable[[], Mechanism], motion_residual: Callable[..., float]
) -> None:
    mechanism = make()
    assert motion_residual(mechanism, place(mechanism, "planar"), seed=1) < 1e-7


@pytest.mark.parametrize("make", EVERY, ids=lambda make: make.__name__)
def test_ranks_agree_with_those_of_joint_angles(make: Callable[[], Mechanism]) -> None:
    mechanism = make()
    points, angles = (check_mobility(velocity_equation(mechanism, f), seed=3) for f in ("planar", "joint"))
    assert points.ranks == angles.ranks
    assert points.messages == angles.messages == ()


def test_the_axis_of_a_slide_is_one_direction_in_both_links() -> None:
    """The yoke stays upright, so that its slot through Z at (4, d_Y + 1) has the direction (4, -3)."""
    space = place(skew_yoke()).space
    (d,) = (space.ring.gen(name) for name in space.variables if name == "d_Y")
    x, y = space.points["B"]
    assert space.points["Z"] == (space.ring.constant(4), d + 1)
    assert not 3 * (x - 4) + 4 * (y - d - 1)


def test_slides_in_a_loop_that_cannot_be_parallel() -> None:
    straight = parallel_slides()
    turned = [link(k.name, k.points, {**k.axes, "w": ("4/5", "3/5")}) for k in straight.links[1:2]]
    with pytest.raises(MechanismError, match=r"joints\.W\.axis: found slides in a loop"):
        place(replace(straight, links=(straight.links[0], *turned, straight.links[2])))


def test_the_loops_of_the_paper() -> None:
    """Section 3.3: the pins B, C, F, G and six distances; dimension 2, degree 40."""
    space = place(load("zlatanov-2dof")).space
    assert space.variables == ("Bx", "By", "Cx", "Cy", "Fx", "Fy", "Gx", "Gy")
    assert [e.total_degree for e in space.equations] == [2] * 6
    ideal = Ideal(space.ring, space.equations)
    assert (ideal.dimension.value, ideal.degree.value) == (2, 40)


def three_rpr() -> Mechanism:
    apart = tuple(Exclusion("coincide", (f"A{i}", f"B{i}")) for i in (1, 2, 3))
    return replace(load("3rpr"), exclusions=apart)


def test_legs_that_cannot_fold_need_no_variables(motion_residual: Callable[..., float]) -> None:
    mechanism = three_rpr()
    placed = place(mechanism)
    assert placed.space.variables == ("B1x", "B1y", "c_platform", "s_platform")
    assert len(placed.space.exclusions) == 3
    bx, by = placed.space.points["B1"]
    assert placed.screws["P1"] == (placed.space.ring.zero, bx, by)


def test_singularity_of_three_rpr() -> None:
    """results.md row 11 (Sefrioui, Gosselin 1995): degree 3 and 14 terms, a conic at fixed orientation."""
    reduced = reduce(velocity_equation(three_rpr())).equation
    (factor, power), *rest = determinant(reduced.L_I).factors()
    assert (power, rest) == (1, [])
    x, y, c, s = sympy.symbols("B1x B1y c_platform s_platform")
    surface = sympy.rem(sympy.expand(factor.to_sympy()), c**2 + s**2 - 1, s, c)
    polynomial = sympy.Poly(sympy.expand(surface), x, y, c, s)
    assert polynomial.total_degree() == 3
    assert len(polynomial.terms()) == 14
    assert sympy.Poly(surface, x, y).total_degree() == 2


def test_limits_of_a_leg_are_squared() -> None:
    length = sympy.Symbol("length(P1)")
    limit = Limit(length, sympy.Integer(2), sympy.Integer(30))
    space = place(replace(load("3rpr"), limits=(limit,))).space
    bx, by = space.points["B1"]
    assert set(space.nonnegative) == {bx**2 + by**2 - 4, 900 - bx**2 - by**2}


def test_limits_of_angles_and_slides() -> None:
    cosine, length, x = sympy.Symbol("cos(A)"), sympy.Symbol("length(S)"), sympy.Symbol("B.x")
    limits = (
        Limit(cosine, sympy.Rational(1, 2)),
        Limit(length, sympy.Integer(0)),
        Limit(x, None, sympy.Integer(1)),
    )
    space = place(replace(inverted_slider(), limits=limits)).space
    ring = space.ring
    bx, _ = space.points["B"]
    assert space.nonnegative[0].primitive() == (2 * bx - 1).primitive()
    assert space.nonnegative[1:] == (ring.gen("d_S"), 1 - bx)


def test_a_limit_on_nothing_known_says_what_is() -> None:
    limit = Limit(sympy.Symbol("cos(Z)"), sympy.Integer(0))
    with pytest.raises(ValueError, match=r"cos\(Z\)"):
        place(replace(inverted_slider(), limits=(limit,)))


def test_slides_on_the_ground_are_solved_for() -> None:
    """The slider's pin is its slide times the axis: one variable, and the coupler's circle."""
    space = place(load("slider-crank")).space
    assert space.variables == ("Bx", "By", "d_P")
    assert len(space.equations) == 2


def test_a_named_point_that_two_pins_place() -> None:
    """Midpoint of the coupler of a four-bar, halfway between B and C."""
    fourbar = load("fourbar").resolved
    coupler = next(k for k in fourbar.links if {"B", "C"} <= k.points.keys())
    middle = tuple((a + b) / 2 for a, b in zip(coupler.points["B"], coupler.points["C"], strict=True))
    traced = replace(coupler, points={**coupler.points, "M": middle})
    links = tuple(traced if k.name == coupler.name else k for k in fourbar.links)
    points = place(replace(fourbar, links=links)).space.points
    assert points["M"] == tuple((b + c) / 2 for b, c in zip(points["B"], points["C"], strict=True))


def test_a_link_held_by_nothing_is_named() -> None:
    mechanism = planar(
        [*inverted_slider().links[:2]], [slide("X", "ground", "crank", ("A", "A"), "u")], ["X"]
    )
    with pytest.raises((ValueError, KeyError), match="u"):
        place(mechanism, "planar")
