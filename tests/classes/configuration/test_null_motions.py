"""The motions and restrictions that show the types, on equations of two or three velocities, by hand."""

from __future__ import annotations

import numpy as np
import pytest
import sympy

from singsym.classes.configuration.null_motions import Motion, null_motions, numerical_kernels
from singsym.classes.taxonomy.types import SingularityType
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.own_equation import SymbolicSpace, from_sympy
from singsym.kinematics.scaling import scaled_matrix
from singsym.kinematics.velocity import Role

T = SingularityType
TWO: list[tuple[str, Role]] = [("T", "output"), ("A", "input")]
THREE: list[tuple[str, Role]] = [*TWO, ("P", "passive")]


def motions(rows: list[list[int]], columns: list[tuple[str, Role]]) -> dict[SingularityType, list[Motion]]:
    """All motions of a constant L, by type, for the types that its ranks make."""
    equation = from_sympy(sympy.Matrix(rows), columns, SymbolicSpace())
    scaled = scaled_matrix(equation, [])
    seen = {name: numerical_rank(part, 1e-9) for name, part in scaled.submatrices().items()}
    ranks = {name: found.rank for name, found in seen.items()}
    kernels = numerical_kernels(scaled, seen, ranks)
    delta = len(columns) - equation.n - ranks["L"]
    size = {name: len(kernel) for name, kernel in kernels.items()}
    types = T(0)
    types |= T.RPM if size["L_p"] else T(0)
    types |= T.RI if size["L_O"] > size["L_p"] else T(0)
    types |= T.RO if size["L_I"] > size["L_p"] else T(0)
    types |= T.II if size["L_I"] > delta else T(0)
    types |= T.IO if size["L_O"] > delta else T(0)
    types |= T.IIM if delta else T(0)
    found = null_motions(equation, kernels, scaled.units, types)
    return {kind: [m for m in found if m.type is kind] for kind in T if kind in types}


def test_a_regular_configuration_has_none() -> None:
    """T = 2 A: both move, neither is restricted."""
    assert motions([[1, -2]], TWO) == {}


def test_a_redundant_input_and_an_impossible_output() -> None:
    """T = 0: A moves alone, and T cannot move."""
    assert motions([[1, 0]], TWO) == {
        T.RI: [Motion(T.RI, {"A": 1.0})],
        T.IO: [Motion(T.IO, {"T": 1.0}, True)],
    }


def test_a_redundant_output_and_an_impossible_input() -> None:
    """A = 0, with a factor that does not matter."""
    assert motions([[0, -5]], TWO) == {
        T.RO: [Motion(T.RO, {"T": 1.0})],
        T.II: [Motion(T.II, {"A": 1.0}, True)],
    }


def test_a_passive_motion_and_a_mobility_that_grows() -> None:
    """T = 2 A, and P is free: P alone for RPM, both motions for IIM; the larger rate is 1."""
    found = motions([[1, -2, 0], [0, 0, 0]], THREE)
    assert found[T.RPM] == [Motion(T.RPM, {"P": 1.0})]
    assert set(found) == {T.RPM, T.IIM}
    assert sorted((m.rates for m in found[T.IIM]), key=len) == [
        {"P": 1.0},
        pytest.approx({"T": 1.0, "A": 0.5}),
    ]


def test_what_moves_passively_is_no_motion_of_the_input() -> None:
    """T = 0 and P free: RI is shown by A alone, orthogonal to the passive motion."""
    found = motions([[1, 0, 0], [0, 0, 0]], THREE)
    assert found[T.RPM] == [Motion(T.RPM, {"P": 1.0})]
    assert found[T.RI] == [Motion(T.RI, {"A": 1.0})]
    assert found[T.IO] == [Motion(T.IO, {"T": 1.0}, True)]


def test_the_basis_of_a_kernel_does_not_matter() -> None:
    """The kernel of L_O spanned by A + P and A - P: less the passive motion P it is A, for RI."""
    equation = from_sympy(sympy.Matrix([[1, 0, 0], [0, 0, 0]]), THREE, SymbolicSpace())
    mixed = np.array([[0.0, 1.0, 1.0], [0.0, 1.0, -1.0]]) / 2**0.5
    passive, nothing = np.array([[0.0, 0.0, 1.0]]), np.zeros((0, 3))
    kernels = {"L": mixed, "L_I": nothing, "L_O": mixed, "L_p": passive}
    assert null_motions(equation, kernels, np.ones(3), T.RI) == (Motion(T.RI, {"A": 1.0}),)


def test_a_restriction_between_two_inputs() -> None:
    """T1 = A1 + A2 and 0 = A1 - 2 A2 with T2 free: the inputs obey A2 = A1/2."""
    columns: list[tuple[str, Role]] = [
        ("T1", "output"),
        ("T2", "output"),
        ("A1", "input"),
        ("A2", "input"),
    ]
    found = motions([[1, 0, -1, -1], [0, 0, 1, -2]], columns)
    (restriction,) = found[T.II]
    assert restriction.restriction
    assert restriction.rates == pytest.approx({"A1": -0.5, "A2": 1.0})
    assert found[T.RO] == [Motion(T.RO, {"T2": 1.0})]
