"""The border between a mechanism's own unit and the user's."""

from __future__ import annotations

from fractions import Fraction

import pytest

from singsym.classes.result import Configuration
from singsym.classes.solve import solve
from singsym.classes.unit_border import Border
from singsym.kinematics.formulations import FORMULATIONS
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import MechanismError, load
from singsym.mechanism.library import names
from singsym.mechanism.units import own_unit, scaled

SLOW = {"zlatanov-hybrid", "zlatanov-hybrid-3-2", "3upu-tsai", "3rps"}


@pytest.mark.parametrize("name", sorted(set(names()) - SLOW))
def test_both_sides_agree_for_the_library(name: str) -> None:
    """Where they did not, the mechanism would be taken as it is, in a unit that is not its own."""
    mechanism = scaled(load(name), Fraction(7, 3))
    tried = 0
    for formulation in ("auto", *FORMULATIONS):
        try:
            border = Border.of(mechanism, formulation)
        except (MechanismError, ValueError):
            continue
        tried += 1
        assert border.unit == own_unit(mechanism)
    assert tried >= 2


def test_polynomials_are_turned_back() -> None:
    """Equations inside, in units of 2, become those of the user up to a positive factor."""
    border = Border.of(load("3rrr"))
    assert border.unit == 2
    for inside, outside in zip(border.inside.space.equations, border.outside.space.equations, strict=True):
        assert border.polynomial(inside) == outside.primitive()
        assert border.polynomial(-inside) == -outside.primitive()


def test_configurations_are_turned_back_before_they_are_rounded() -> None:
    """A third of a unit of 3 is 1, not 0.999999999999999; angles and pure numbers stay."""
    mechanism = scaled(load("slider-crank"), Fraction(3))
    border = Border.of(mechanism)
    assert border.unit == 3
    third = "0.3333333333333333333333333"
    inside = Configuration({"Bx": third, "By": "0"}, {"B.x": third}, {"A": third, "P": third}, "1e-24")
    found = border.configuration(inside)
    assert found.coordinates == {"Bx": "1", "By": "0"}
    assert found.points == {"B.x": "1"}
    assert found.joints == {"A": "0.333333333333333", "P": "1"}
    assert 0.3e-15 < float(found.radius) < 0.4e-15  # the angle's 16th digit


def test_an_equation_by_itself_is_taken_as_it_is() -> None:
    equation = velocity_equation(scaled(load("fourbar"), Fraction(1000)))
    border = Border.around(equation)
    assert border.inside is border.outside is equation
    assert border.equations(equation.space.equations) == equation.space.equations


def test_solution_sets_are_in_the_users_unit() -> None:
    """The dead centres of a slider-crank with crank r and rod l have their pins at l - r and l + r."""
    mechanism = load("slider-crank")
    sizes = [p.value for p in mechanism.parameters]
    for k in (1, 1000):
        (dead,) = solve(scaled(mechanism, Fraction(k)), "5", cache=False)
        ends = sorted(float(w.points["C.x"]) for p in dead.pieces for w in p.witnesses)
        crank, rod = sorted(k * float(x) for x in sizes if x is not None)
        assert ends == pytest.approx([rod - crank, rod + crank])
        for piece in dead.pieces:
            for w in piece.witnesses:
                values = [float(w.coordinates[name]) for name in dead.equation.space.ring.names]
                assert all(abs(p.evaluate(values)) < 1e-12 * k**2 for p in (*piece.path, *piece.basis))
