"""Kernels over number fields against SymPy's ranks and against L itself."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy

from singsym.classes.configuration.exact_configuration import exact_kernels, exact_values
from singsym.classes.configuration.given_values import Given, targets
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("change-point", {"points": {"B": [-1, 0], "C": [1, 0]}}),
        ("slider-crank", {"points": {"B": [1, 0], "C": [4, 0]}}),
        ("slider-crank", {"joints": {"A": "pi/2"}, "points": {"C": ["2*sqrt(2)", 0]}}),
        ("orthogonal-3r", {"joints": {"J1": "30 deg", "J2": "45 deg", "J3": "60 deg"}}),
    ],
)
def test_kernels_are_as_large_as_ranks_are_low(name: str, given: dict[str, Any]) -> None:
    equation = velocity_equation(load(name))
    values = exact_values(equation, targets(Given.of(given), equation))
    assert values is not None
    kernels = exact_kernels(equation, values)
    assert kernels is not None
    numbers = {sympy.Symbol(name): value for name, value in values.items()}
    for key, kernel in kernels.items():
        matrix = getattr(equation, key).to_sympy().xreplace(numbers).applyfunc(sympy.nsimplify)
        if matrix.shape[1]:
            assert len(kernel) == matrix.shape[1] - matrix.rank(simplify=True)
            assert np.abs(np.array(matrix.evalf(), dtype=float) @ kernel.T).max(initial=0.0) < 1e-12


def test_open_loops_have_no_exact_kernels() -> None:
    equation = velocity_equation(load("slider-crank"))
    wanted = targets(Given.of({"points": {"B": [1, 0], "C": ["4.1", 0]}}), equation)
    values = exact_values(equation, wanted)
    assert values is not None
    assert exact_kernels(equation, values) is None


def test_no_field_is_looked_for_where_loops_are_surely_open(monkeypatch: pytest.MonkeyPatch) -> None:
    """Angles of 60 and 100 degrees make a field of degree 12; C is a tenth off the circle about B."""
    equation = velocity_equation(load("five-bar"))
    given = {"joints": {"A": "60 deg", "E": "100 deg"}, "points": {"C": ["33/10", "1/10"]}}
    values = exact_values(equation, targets(Given.of(given), equation))
    assert values is not None

    def refused(*_: object, **__: object) -> None:
        raise AssertionError("a field was looked for")

    monkeypatch.setattr("sympy.polys.constructor.construct_domain", refused)
    assert exact_kernels(equation, values) is None
