"""One configuration: exact and numerical ranks, types against the definitions by null motions."""

import math

import numpy as np
import pytest
import sympy

from singsym.classes.configuration.at import at, at_equation
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.kinematics.own_equation import SymbolicSpace, from_sympy
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import MechanismError, load
from singsym.polynomials.compiled_map import numerical_matrix


def test_a_flat_linkage_is_exact():
    """4 + 1 = 2 + 3: a four-bar linkage that lies flat, where all pins are on a line, has IIM."""
    found = at(load("change-point"), {"points": {"B": [-1, 0], "C": [1, 0]}})
    assert found.exact
    assert found.defects.delta == 1
    assert T.IIM in found.types


def test_irrational_configurations_are_exact():
    """The rod of length 3 in line with the crank of length 1 at 30 degrees cannot be; at 0 it is."""
    found = at(load("slider-crank"), {"joints": {"A": "pi/2"}, "points": {"C": ["2*sqrt(2)", 0]}})
    assert found.exact
    assert not found.types
    dead = at(load("slider-crank"), {"joints": {"A": 0}, "points": {"C": [4, 0]}})
    assert dead.exact
    assert dead.types == T.RI | T.IO


def test_serial_arm_at_its_wrist_singularity():
    """PUMA 560: s5 = 0 makes joints 4 and 6 turn about one axis."""
    values = {"J1": "0.3", "J2": "0.4", "J3": "0.5", "J4": "0.6", "J5": 0, "J6": "0.7"}
    found = at(load("puma560"), {"joints": values})
    assert found.defects == (0, 0, 0, 1)
    (motion,) = [m for m in found.motions if m.type is T.RI]
    assert set(motion.rates) == {"J4", "J6"}
    assert math.isclose(motion.rates["J4"], -motion.rates["J6"])
    assert found.matrices["L_O"].gap > 1e6


def test_rounded_values_are_brought_onto_the_loops():
    linkage = load("zlatanov-2dof")
    given = {"B": ["0.25", "0.968"], "C": ["0.5", "1.936"], "F": [-1, 0], "G": ["0.936", "0.501"]}
    found = at(linkage, {"points": given})
    assert not found.exact
    assert 1e-5 < found.located.before < 1e-2
    assert found.located.after < 1e-12
    assert found.located.moved < 5e-3
    assert T.RI in at(linkage, {"points": given}, tolerance=1e-2).types


def test_null_motions_satisfy_the_velocity_equation():
    """Each motion in the kernel of L, with the zeros that its type is defined by."""
    equation = velocity_equation(load("zlatanov-2dof"))
    third = math.sqrt(3) / 2
    points = {"B": [0.5, -third], "C": [0, -2 * third], "G": [-0.75, -3.031088913245535]}
    points["F"] = [-0.8168334966, -1.0322063597]
    found = at_equation(equation, {"points": points}, tolerance=1e-4)
    assert found.types == T.RPM | T.II | T.IO
    point = np.array([found.values[name] for name in equation.space.ring.names])
    L = numerical_matrix(equation.L, point)
    labels = [c.label for c in equation.columns]
    for motion in found.motions:
        if not motion.restriction:
            rates = np.array([motion.rates.get(label, 0.0) for label in labels])
            assert np.abs(L @ rates).max() < 1e-6
            assert not {"A", "E", "T.x", "T.y"} & set(motion.rates)
        else:
            assert set(motion.rates) <= ({"A", "E"} if motion.type is T.II else {"T.x", "T.y"})


def test_restrictions_hold_for_every_motion():
    """Where an input is impossible, no null vector of L violates the restriction that is reported."""
    found = at(load("slider-crank"), {"points": {"B": [1, 0], "C": [4, 0]}})
    equation = found.equation
    point = np.array([found.values[name] for name in equation.space.ring.names])
    _, _, right = np.linalg.svd(numerical_matrix(equation.L, point))
    (restriction,) = [m for m in found.motions if m.restriction]
    row = np.array([restriction.rates.get(c.label, 0.0) for c in equation.columns])
    assert np.abs(right[4:] @ row).max() < 1e-12


@pytest.mark.parametrize("name", ["fourbar", "five-bar", "3rrr", "bennett", "stewart-gough"])
def test_generic_configurations_are_regular(name):
    equation = velocity_equation(load(name))
    (point,) = sample_configurations(equation.space, 1, seed=3)
    variables = {v: float(x) for v, x in zip(equation.space.ring.names, point, strict=True)}
    kept = {v: variables[v] for v in equation.space.variables}
    found = at(load(name), {"variables": kept})
    assert not found.types
    assert found.located.moved < 1e-6


def test_ranks_do_not_depend_on_the_unit_of_length():
    small = at(load("slider-crank").with_parameters(r="1/1000", l="3/1000"), {"joints": {"A": "0.3"}})
    large = at(load("slider-crank").with_parameters(r=1000, l=3000), {"joints": {"A": "0.3"}})
    for name in small.matrices:
        assert small.matrices[name].distance == pytest.approx(large.matrices[name].distance, rel=1e-6)


def test_what_is_left_open_or_wrong_is_said():
    linkage = load("zlatanov-2dof")
    with pytest.raises(MechanismError, match="one of"):
        at(linkage, {"points": {"Q": [0, 0]}})
    with pytest.raises(MechanismError, match="2 coordinates"):
        at(linkage, {"points": {"B": [0, 0, 0]}})
    with pytest.raises(MechanismError, match="no values"):
        at(linkage, {})
    with pytest.raises(MechanismError, match="no configuration"):
        at(linkage, {"points": {"B": [50, 60]}})
    open_ = at(linkage, {"joints": {"A": "80 deg"}})
    assert any("leave 1 freedom" in remark for remark in open_.remarks)
    outside = at(load("slider-crank"), {"points": {"B": [1, 0], "C": [-2, 0]}})
    assert any("outside the feasible set" in remark for remark in outside.remarks)


def test_equations_of_ones_own():
    c, s = sympy.symbols("c s")
    own = from_sympy(
        sympy.Matrix([[1, -s]]), [("T", "output"), ("A", "input")], SymbolicSpace([c**2 + s**2 - 1])
    )
    assert at_equation(own, {"variables": {"c": 1, "s": 0}}).types == T.RI | T.IO
    assert not at_equation(own, {"variables": {"c": "3/5", "s": "4/5"}}).types


def test_near_an_earlier_configuration_its_assembly_mode_is_kept() -> None:
    """A step of a crank; the two assemblies over the same values are on both sides of the line BD."""
    five_bar = load("five-bar")
    ends = []
    for C in ((4.755, 0.893), (-0.397, -1.131)):
        given = {"points": {"B": [1.755, 0.959], "C": C, "D": [2.602, -1.197]}}
        start = at(five_bar, given, tolerance=1e-3)
        angles = {"A": start.joints["A"] + 0.02, "E": start.joints["E"]}
        found = at(five_bar, {"joints": angles}, near=start)
        assert found.located is not None
        assert found.located.misfit < 1e-9
        assert max(abs(a - b) for a, b in zip(found.points["C"], start.points["C"], strict=True)) < 0.1
        assert not found.remarks
        ends.append(found.points["C"])
    assert abs(ends[1][0] - ends[0][0]) + abs(ends[1][1] - ends[0][1]) > 1
