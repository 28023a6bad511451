"""Small velocity equations made so that a lemma does not apply, against exact ranks at rational points.

Source: the counterexamples are singsym's own; every expected value is derived in the test's docstring.
"""

from __future__ import annotations

import pytest
import sympy

from singsym.classes.classify import classify_equation
from singsym.classes.taxonomy.types import Defects, SingularityType
from singsym.kinematics.own_equation import SymbolicSpace, from_sympy
from tests.soundness.exact_ranks import defects

T = SingularityType
x, y, z, w, c, s = sympy.symbols("x y z w c s")


def test_a_rank_on_a_curve_whose_minors_vanish_in_different_points() -> None:
    """u y = v x, with u = v = 0 at (50, 30): the rank is not full at the origin, and not at (50, 30).

    Elsewhere on the curve (u, v) = t (x, y) with t not 0: then f = t (x^2 + y^2) is not 0, rows 1 and 3 are
    independent in P1 and P2, row 2 has T and A, so all four ranks are full. At (50, 30) rows 1 and 4 vanish
    and the two others are left, in P1 and P2 as well: delta = 2, p = 1, k_I = k_O = 2. At the origin (x, y)
    is gone: one row is left in P1 and P2: p = 2 and delta = k_I = k_O = 2.
    """
    u, v = 100 * ((x - 50) + 2 * (y - 30)), 100 * (3 * (x - 50) - (y - 30))
    f = u * x + v * y
    a, b = (1 + x + y) / 10, (2 - x) / 10
    L = sympy.Matrix(
        [
            [0, 0, u, v, 0],
            [1, 3, a * u + x, a * v + y, 0],
            [0, 0, b * u - y, b * v + x, 0],
            [0, 0, 0, 0, f],
        ]
    ).applyfunc(sympy.expand)
    columns = [("T", "output"), ("A", "input"), ("P1", "passive"), ("P2", "passive"), ("P3", "passive")]
    curve = sympy.expand(u * y - v * x)
    at_origin, at_vertex = {x: 0, y: 0}, {x: 50, y: 30}
    assert curve.subs(at_origin) == curve.subs(at_vertex) == 0
    assert defects(L, columns, at_origin, 4, 1) == Defects(2, 2, 2, 2)
    assert defects(L, columns, at_vertex, 4, 1) == Defects(2, 1, 2, 2)
    result = classify_equation(None, from_sympy(L, columns, SymbolicSpace([curve])), cache=False)
    assert {k.types: k.points for k in result.classes if not k.verdict.is_no} == {
        T.RPM | T.IIM: 1,
        T.RI | T.RO | T.RPM | T.IIM: 1,
    }


def test_a_plane_that_two_equations_share() -> None:
    """X a + Y b = X c + Y d = 0: the plane X = Y = 0 and a surface that meets it.

    L = [1, A] with A = [[X, Y], [-g, e]] has k_I = delta = p = 0 everywhere and k_O = 2 - rank A: class 1 is
    det A = 0. That is the whole plane, of dimension 2, and a curve on the surface.
    """
    X, Y = x - 100, y - 80
    a, b = x + 2 * y - z + 3 * w + 1, 2 * x - y + 3 * z - w - 2
    c_, d = -x + y + 2 * z + w + 2, 3 * x + y - z + 2 * w - 1
    e, g = x - y + z - 2 * w + 3, x + 3 * y + 2 * z + w - 2
    loops = [sympy.expand(X * a + Y * b), sympy.expand(X * c_ + Y * d)]
    L = sympy.Matrix([[1, 0, X, Y], [0, 1, -g, e]])
    columns = [("T1", "output"), ("T2", "output"), ("A1", "input"), ("A2", "input")]
    for on_plane in ({x: 100, y: 80, z: 5, w: 7}, {x: 100, y: 80, z: -3, w: 11}):
        assert [q.subs(on_plane) for q in loops] == [0, 0]
        assert defects(L, columns, on_plane, 2, 2) == Defects(0, 0, 0, 1)
    result = classify_equation(None, from_sympy(L, columns, SymbolicSpace(loops)), cache=False)
    assert {k.types: k.dimension for k in result.classes if not k.verdict.is_no} == {T.RI | T.IO: 2}
    assert [locus.dimension for locus in result.loci] == [2]


@pytest.mark.parametrize(
    ("loops", "sheet"),
    [
        ([z * (z - 1)], z),
        ([c**2 - 1], c),
        ([c**2 + s**2 - 1, s], c),
    ],
    ids=["two planes", "two signs", "a unit vector along a line"],
)
def test_circles_in_two_planes(loops: list[sympy.Expr], sheet: sympy.Symbol) -> None:
    """In one plane g = f, in the other g = f + 5 or f + 10: f = 0 is a circle, g = 0 the same or empty.

    L_O has rank 2 off f = 0, L_I off g = 0. So (RI, RO, II, IO) is one circle, (RI, IO) the other one, no
    class is elsewhere, and the locus f = 0 of (5) is both circles, g = 0 of (4) one.
    """
    f = x**2 + y**2 - 1
    g = f + 5 * (1 - sheet)
    L = sympy.Matrix([[1, 0, 1, 0], [0, g, 1, f]])
    columns = [("T1", "output"), ("T2", "output"), ("A1", "input"), ("A2", "input")]
    other = 0 if sheet is z else -1
    rest = {s: 0, x: sympy.Rational(3, 5), y: sympy.Rational(4, 5)}
    assert defects(L, columns, {sheet: 1, **rest}, 2, 2) == Defects(0, 0, 1, 1)
    assert defects(L, columns, {sheet: other, **rest}, 2, 2) == Defects(0, 0, 0, 1)
    result = classify_equation(None, from_sympy(L, columns, SymbolicSpace(loops)), cache=False)
    assert {k.types: (k.dimension, k.components) for k in result.classes if not k.verdict.is_no} == {
        T.RI | T.IO: (1, 1),
        T.RI | T.RO | T.II | T.IO: (1, 1),
    }
    assert {locus.condition: locus.components for locus in result.loci} == {"4": 1, "5": 2}
