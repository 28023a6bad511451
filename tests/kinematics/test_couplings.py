"""Coupled joints: the equations hold where the gears mesh, and rates are the derivatives of values."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from singsym.kinematics.formulations import place
from singsym.kinematics.mobility import check_mobility
from singsym.kinematics.placement import ConfigurationSpace, Placement
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.scaling import scaled_matrix
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Mechanism, MechanismError, define
from tests.kinematics.conftest import tangents

Configuration = Callable[[ConfigurationSpace, int], Any]


def five_bar(rates: object, constant: str = "0", **more: Any) -> Mechanism:
    """Cranks AB = 2 and ED = 1 on (0, 0) and (5, 0), rods BC = 3 and CD = 4, the cranks geared."""
    return define(
        inputs=["A"],
        output={"velocity": "C", "components": ["x"]},
        links={"ground": {"points": {"A": [0, 0], "E": [5, 0]}}, "AB": 2, "BC": 3, "CD": 4, "ED": 1},
        joints=dict.fromkeys("ABCDE", "R"),
        couplings={"gears": {"rates": rates, "constant": constant}},
        **more,
    )


def angles(placed: Placement, point: Any) -> dict[str, complex]:
    """cosine + i sine of each joint whose value is known."""
    found = {}
    for name, value in placed.values.items():
        if value.cosine is not None and value.sine is not None and value.scale is not None:
            c, s, scale = (float(p.evaluate(list(point))) for p in (value.cosine, value.sine, value.scale))
            found[name] = complex(c, s) / scale
    return found


@pytest.mark.parametrize("formulation", ["planar", "joint", "natural"])
@pytest.mark.parametrize(
    ("rates", "constant"),
    [({"A": 1, "E": 1}, "0"), ({"A": 3, "E": "-3/2"}, "45 deg"), ({"A": 1, "B": 2, "E": -1}, "90 deg")],
)
def test_gears_mesh_and_their_rates_are_those_of_the_row(
    rates: dict[str, Any], constant: str, formulation: str
) -> None:
    """At random configurations, by the angles themselves; along the motion, by their derivatives."""
    mechanism = five_bar(rates, constant)
    placed = place(mechanism, formulation)
    equation = velocity_equation(mechanism, formulation)
    assert equation.rows[-1] == "coupling gears"
    for point in sample_configurations(placed.space, 2, 1):
        here = angles(placed, point)
        numbers = {name: Fraction(x) for name, x in rates.items()}
        whole = math.lcm(*(x.denominator for x in numbers.values()))
        divisor = math.gcd(*(int(x * whole) for x in numbers.values()))
        product = math.prod(here[name] ** int(x * whole / divisor) for name, x in numbers.items())
        phase = math.radians(float(constant.split()[0])) * whole / divisor
        assert product == pytest.approx(cmath.exp(1j * phase), abs=1e-9)
        (tangent,) = tangents(placed.space, point)
        moved = np.array(point)
        for name, x in zip(placed.space.variables, tangent, strict=True):
            moved[placed.space.ring.index(name)] += 1e-6 * x
        there = angles(placed, moved)
        speeds = {name: cmath.phase(there[name] / here[name]) for name in here}
        matrix = np.array([[float(e.evaluate(list(point))) for e in row] for row in equation.matrix.rows])
        null = np.linalg.svd(matrix)[2][-1]
        seen = {c.label: x for c, x in zip(equation.columns, null, strict=True)}
        for name in here:
            assert speeds[name] * seen["A"] == pytest.approx(seen[name] * speeds["A"], abs=1e-9)


@pytest.mark.parametrize("formulation", ["planar", "joint"])
def test_a_geared_five_bar_has_one_freedom(formulation: str) -> None:
    found = check_mobility(velocity_equation(five_bar({"A": 1, "E": 1}), formulation))
    assert found.ranks == {"L": 5, "L_I": 5, "L_O": 5, "L_p": 4}
    assert found.messages == ()


def test_a_differential_adds_rates(configuration: Configuration) -> None:
    """Three wheels on the ground, 2 C = A + B: the third is at half their sum, or half a turn from it."""
    ground = {"points": {"A": [0, 0], "B": [4, 0], "C": [8, 0]}}
    links = {"ground": ground, **{f"wheel{x}": {"points": {x: [0, 0], f"T{x}": [1, 0]}} for x in "ABC"}}
    mechanism = define(
        inputs=["A", "B"],
        output=[{"rate": "C"}, {"velocity": "TB", "components": ["x"]}],
        links=links,
        joints=dict.fromkeys("ABC", "R"),
        couplings={"differential": {"rates": {"A": 1, "B": 1, "C": -2}}},
    )
    placed = place(mechanism)
    for seed in (3, 4):
        here = angles(placed, configuration(placed.space, seed))
        assert here["C"] ** 2 == pytest.approx(here["A"] * here["B"])
    assert check_mobility(velocity_equation(mechanism)).messages == ()


def strut(couplings: dict[str, object]) -> Mechanism:
    """A crank AB and a cylinder from C to B, never folded, beside a slide on the ground."""
    return define(
        inputs=["P"],
        output={"rate": "A"},
        links={
            "ground": {"points": {"A": [0, 0], "C": [3, 0], "O": [0, -2]}, "axes": {"x": [1, 0]}},
            "AB": 1,
            "barrel": {"points": {"C": [0, 0]}, "axes": {"u": [1, 0]}},
            "rod": {"points": {"B": [0, 0]}, "axes": {"u": [1, 0]}},
            "block": {"points": {"M": [0, 0]}, "axes": {"x": [1, 0]}},
        },
        joints={
            "A": "R",
            "B": {"type": "R", "links": ["AB", "rod"]},
            "C": "R",
            "P": {"type": "P", "links": ["barrel", "rod"], "at": ["C", "B"], "axis": "u"},
            "Q": {"type": "P", "links": ["ground", "block"], "at": ["O", "M"], "axis": "x"},
        },
        exclusions={"folded": {"coincide": ["B", "C"]}},
        couplings=couplings,
    )


def test_slides_are_coupled_by_their_lengths(configuration: Configuration) -> None:
    """A coupled cylinder is no strut, whose length would be known by its square alone."""
    couplings: dict[str, object] = {"pipe": {"rates": {"P": 1, "Q": -2}, "constant": "7/2"}}
    placed = place(strut(couplings))
    point = list(configuration(placed.space, 1))
    lengths = {}
    for name in "PQ":
        length = placed.values[name].length
        assert length is not None
        lengths[name] = float(length.evaluate(point))
    assert lengths["P"] - 2 * lengths["Q"] == pytest.approx(3.5)


def test_couplings_of_lengths_do_not_depend_on_the_unit(configuration: Configuration) -> None:
    from singsym.mechanism.units import scaled

    couplings: dict[str, object] = {"pipe": {"rates": {"P": 1, "Q": -2}, "constant": "7/2"}}
    found = []
    for unit in (Fraction(1), Fraction(1000)):
        equation = velocity_equation(scaled(strut(couplings), unit))
        point = configuration(velocity_equation(strut(couplings)).space, 1)
        scales = [float(unit) if n in equation.space.lengths else 1.0 for n in equation.space.ring.names]
        matrix = scaled_matrix(equation, np.array(point) * scales)
        found.append([np.linalg.svd(m, compute_uv=False) for m in matrix.submatrices().values()])
    for one, other in zip(*found, strict=True):
        assert one == pytest.approx(other, rel=1e-9)


def test_a_value_that_the_formulation_does_not_know() -> None:
    """In natural coordinates a universal joint has no angles, in joint coordinates it has."""
    mechanism = define(
        space="spatial",
        inputs=["U.angle1", "U.angle2"],
        output={"twist": "tip", "components": ["wx", "wy"]},
        links={
            "ground": {"points": {"O": [0, 0, 0]}, "axes": {"x": [1, 0, 0]}},
            "arm": {
                "points": {"O": [0, 0, 0], "A": [1, 0, 0]},
                "axes": {"y": [0, 1, 0], "z": [0, 0, 1]},
            },
            "tip": {"points": {"A": [0, 0, 0]}, "axes": {"z": [0, 0, 1]}},
        },
        joints={
            "U": {"type": "U", "links": ["ground", "arm"], "at": "O", "axis": ["x", "y"]},
            "A": {"type": "R", "axis": "z"},
        },
        couplings={"belt": {"rates": {"U.angle1": 1, "A": 1}}},
    )
    assert place(mechanism, "joint").space.equations
    with pytest.raises(MechanismError, match=r"U.angle1, whose value the natural formulation does not know"):
        place(mechanism, "natural")
