"""L and the loop equations of one's own, as SymPy objects."""

from __future__ import annotations

import pytest
import sympy

from singsym.kinematics.mobility import check_mobility
from singsym.kinematics.own_equation import SymbolicSpace, from_sympy
from singsym.kinematics.velocity import Role
from singsym.mechanism.model import Parameter

COLUMNS: list[tuple[str, Role]] = [("T", "output"), ("A", "input")]


def test_a_matrix_of_ones_own() -> None:
    """2R with link lengths 1 and a, 0 < a < 2: det of the output rows is a sin(t2)."""
    t1, t2, a = sympy.symbols("t1 t2 a")
    x = sympy.cos(t1) + a * sympy.cos(t1 + t2)
    y = sympy.sin(t1) + a * sympy.sin(t1 + t2)
    J = sympy.Matrix([x, y]).jacobian([t1, t2])
    L = sympy.eye(2).row_join(-J)
    columns = [("x", "output"), ("y", "output"), ("A", "input"), ("B", "input")]
    length = Parameter("a", None, sympy.Integer(0), sympy.Integer(2))
    found = from_sympy(L, columns, SymbolicSpace(parameters=[length]))
    ring = found.space.ring
    assert ring.names == ("c_t1", "c_t2", "s_t1", "s_t2", "a")
    assert len(found.space.equations) == 2
    assert found.space.positive == (ring.gen("a"), 2 - ring.gen("a"))
    M = found.L_O
    determinant = M[0, 0] * M[1, 1] - M[0, 1] * M[1, 0]
    circle = ring.gen("c_t1") ** 2 + ring.gen("s_t1") ** 2
    assert circle - 1 in found.space.equations
    assert determinant == circle * ring.gen("s_t2") * ring.gen("a")
    assert check_mobility(found).messages == ()


def test_irrational_numbers_in_a_matrix_of_ones_own() -> None:
    x = sympy.Symbol("x")
    found = from_sympy(
        sympy.Matrix([[1, x / sympy.sqrt(3)]]), [("T", "output"), ("A", "input")], SymbolicSpace([x**2 - 2])
    )
    ring = found.space.ring
    assert ring.names == ("x", "sqrt3")
    assert found.matrix[0, 1] == ring.gen("x") * ring.gen("sqrt3") / 3


@pytest.mark.parametrize(
    ("entry", "columns", "message"),
    [
        ("1/x", [("T", "output"), ("A", "input")], "polynomial"),
        ("x", [("T", "output")], "columns"),
        ("x", [("T", "output"), ("A", "driver")], "roles"),
        ("x", [("T", "output"), ("A", "passive")], "mobility"),
        ("sin(x**2)", [("T", "output"), ("A", "input")], "sines and cosines"),
    ],
)
def test_matrices_that_do_not_fit(entry: str, columns: list[tuple[str, str]], message: str) -> None:
    x = sympy.Symbol("x")
    entries = {"1/x": 1 / x, "x": x, "sin(x**2)": sympy.sin(x**2)}
    with pytest.raises(ValueError, match=message):
        from_sympy(sympy.Matrix([[1, entries[entry]]]), columns, SymbolicSpace())  # type: ignore[arg-type]


def test_each_part_of_a_space_goes_where_it_belongs() -> None:
    """A slide x on a track at height y, with a mark at (cos t, 0); x is wanted before y."""
    x, y, t = sympy.symbols("x y t")
    space = SymbolicSpace(
        [x - sympy.cos(t)],
        exclusions=[[x, y - 1]],
        positive=[y],
        nonnegative=[2 - x],
        variables=("x", "y", "c_t", "s_t"),
        points={"mark": (sympy.cos(t), 0)},
    )
    found = from_sympy(sympy.Matrix([[1, -y]]), COLUMNS, space).space
    a, b, c, s = found.ring.gens
    assert found.ring.names == ("x", "y", "c_t", "s_t")
    assert set(found.equations) == {a - c, c**2 + s**2 - 1}
    assert found.exclusions == ((a, b - 1),)
    assert (found.positive, found.nonnegative) == ((b,), (2 - a,))
    assert found.points == {"mark": (c, found.ring.zero)}


def test_a_symbol_that_is_neither_wanted_nor_a_parameter_is_told() -> None:
    x, y = sympy.symbols("x y")
    L = sympy.Matrix([[1, x * y]])
    with pytest.raises(ValueError, match=r"\['y'\] are neither"):
        from_sympy(L, COLUMNS, SymbolicSpace(variables=("x",)))
    known = from_sympy(L, COLUMNS, SymbolicSpace(variables=("x",), parameters=("y",))).space
    assert (known.variables, known.parameters) == (("x",), ("y",))
