"""The configuration nearest to given values: where it is, how many fit, and where there is none."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
import sympy

from singsym.classes.configuration.given_values import Given, targets
from singsym.classes.configuration.locate import Located, is_feasible, locate, sizes_of_coordinates
from singsym.kinematics.own_equation import SymbolicSpace, from_sympy
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import Mechanism, load

FOUR = load("fourbar")
"""A = (0, 0), D = (4, 0), AB = 1, BC = 7/2, CD = 3."""
SLIDER = load("slider-crank")
"""A = (0, 0), AB = 1, BC = 3, C = (d, 0) with d >= 0."""

C, S = sympy.symbols("c s")


def nearest(mechanism: Mechanism, more: bool = False, **given: object) -> tuple[VelocityEquation, Located]:
    equation = velocity_equation(mechanism)
    found = locate(equation, targets(Given.of(given), equation), more)
    assert found is not None
    return equation, found


def place(equation: VelocityEquation, found: Located, name: str) -> list[float]:
    return [float(p.evaluate(list(found.point))) for p in equation.space.points[name]]


def test_values_that_fit_are_kept() -> None:
    """The crank upright: B = (0, 1), and C = (sqrt 8, 0), as (-sqrt 8, 0) is not feasible."""
    equation, found = nearest(SLIDER, joints={"A": "90 deg"})
    assert place(equation, found, "B") == pytest.approx([0, 1])
    assert place(equation, found, "C") == pytest.approx([8**0.5, 0])
    assert (found.open, found.others) == (0, 0)
    assert max(found.misfit, found.moved, found.before, found.after) < 1e-9


def test_two_ways_of_assembly_fit_one_crank_angle() -> None:
    """B = (0, 1): circles of radius 7/2 around B and 3 around D meet twice."""
    _, found = nearest(FOUR, joints={"A": "90 deg"})
    assert (found.open, found.others) == (0, 1)


def test_a_freedom_that_nothing_fixes_is_open() -> None:
    """Of B only the length of AB is known, which says nothing."""
    equation = velocity_equation(FOUR)
    found = locate(equation, ())
    assert found is not None
    assert found.open == 1


def on_circle(*more: sympy.Expr) -> VelocityEquation:
    """c^2 + s^2 = 1, and more equations, with two velocities that do not matter."""
    space = SymbolicSpace([C**2 + S**2 - 1, *more])
    return from_sympy(sympy.Matrix([[1, C]]), [("T", "output"), ("A", "input")], space)


def test_values_that_do_not_fit_are_moved() -> None:
    """(0, 2) is off the unit circle, whose nearest point is (0, 1); there one equation is 4 - 1 = 3 off 0."""
    equation = on_circle()
    found = locate(equation, targets(Given.of({"variables": {"c": 0, "s": 2}}), equation))
    assert found is not None
    assert found.given == pytest.approx((0, 2), abs=1e-6)
    assert found.point == pytest.approx((0, 1), abs=1e-6)
    assert min(found.before, found.moved, found.misfit) > 1e-2
    assert found.after < 1e-9


def test_no_configuration_is_found_where_there_is_none() -> None:
    """The line c = 2 does not meet the circle, though (2, 0) is on it and near."""
    equation = on_circle(C - 2)
    assert locate(equation, targets(Given.of({"variables": {"s": 0}}), equation)) is None


def test_further_digits() -> None:
    """C = (sqrt 8, 0) to 50 digits."""
    with mpmath.workdps(50):
        equation, found = nearest(SLIDER, more=True, joints={"A": "90 deg"})
        x = equation.space.points["C"][0].evaluate(list(found.point))
        assert abs(x - mpmath.sqrt(8)) < mpmath.mpf(10) ** -45


def test_what_limits_allow() -> None:
    """The slider works for d >= 0; 0 itself is allowed, also up to rounding, and -1/10 is not."""
    equation = velocity_equation(SLIDER)
    sizes = sizes_of_coordinates(equation)
    for d, allowed in ((3.0, True), (0.0, True), (-1e-12, True), (-0.1, False)):
        point = np.array([{"d_P": d}.get(name, 0.5) for name in equation.space.ring.names])
        assert is_feasible(equation, point, sizes) == allowed
