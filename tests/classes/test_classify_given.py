"""Classifications of small velocity equations of one's own, whose answer is plain to see."""

import sympy

from singsym.classes.classify import classify_equation
from singsym.classes.taxonomy.types import SingularityType
from singsym.kinematics.own_equation import SymbolicSpace, from_sympy

RI, RO, II, IO = SingularityType.RI, SingularityType.RO, SingularityType.II, SingularityType.IO


def classified(entry_T: sympy.Expr, entry_A: sympy.Expr):
    """On the unit circle, entry_T T + entry_A A = 0: (4) is entry_T = 0, (5) is entry_A = 0."""
    x, y = sympy.symbols("x y")
    columns = [("T", "output"), ("A", "input")]
    equation = from_sympy(sympy.Matrix([[entry_T, entry_A]]), columns, SymbolicSpace([x**2 + y**2 - 1]))
    return classify_equation(None, equation, cache=False)


def test_a_point_on_two_factors_counts_once():
    """y = 0 holds at (1, 0), (-1, 0), and x + y = 1 at (1, 0), (0, 1): three points, two on each."""
    x, y = sympy.symbols("x y")
    result = classified(sympy.Integer(1), y * (x + y - 1))
    found = result[RI | IO]
    assert found.points == 3
    assert len({(w.coordinates["x"], w.coordinates["y"]) for w in found.witnesses}) == 3
    assert [locus.points for locus in result.loci] == [2, 2]


def test_both_conditions_apart():
    """T y + A x = 0: (RO, II) at (1, 0), (-1, 0), (RI, IO) at (0, 1), (0, -1)."""
    x, y = sympy.symbols("x y")
    result = classified(y, x)
    assert {c.types: c.points for c in result.classes if c.verdict.is_yes} == {RI | IO: 2, RO | II: 2}
    assert not result.undecided


def test_both_conditions_at_once_is_increased_mobility():
    """T y + A y = 0: at y = 0 the equation says nothing, so there is IIM with redundant input and output."""
    _, y = sympy.symbols("x y")
    result = classified(y, y)
    found = [c for c in result.classes if c.verdict.is_yes]
    assert [(c.types, c.points) for c in found] == [(RI | RO | SingularityType.IIM, 2)]


def test_ranks_of_a_given_matrix_do_not_say_whether_the_space_is_smooth():
    """T + A = 0 never loses rank, on the cross x y = 0, which is singular at (0, 0)."""
    x, y = sympy.symbols("x y")
    equation = from_sympy(sympy.Matrix([[1, 1]]), [("T", "output"), ("A", "input")], SymbolicSpace([x * y]))
    (space,) = classify_equation(None, equation, cache=False).configuration_space
    assert (space.dimension, space.smooth) == (1, "undecided")
