"""Determinants and block forms against SymPy, and the two timings that engines.md names."""

from itertools import combinations

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.effort.budget import Budget, BudgetExceeded
from singsym.minors.blocks import block_triangular, diagonal_blocks
from singsym.minors.determinant import block_determinants, determinant, maximal_minors, minors
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring

R = Ring(("x", "y", "z"))
ENTRIES = st.sampled_from([0, 0, 0, 1, -2, *R.gens, R.gens[0] * R.gens[1] / 3 - 1, R.gens[2] ** 2 + 2])


def matrices(height: int, width: int) -> st.SearchStrategy[PolynomialMatrix]:
    row = st.lists(ENTRIES, min_size=width, max_size=width)
    return st.lists(row, min_size=height, max_size=height).map(lambda rows: PolynomialMatrix.of(R, rows))


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 5).flatmap(lambda k: matrices(k, k)))
def test_determinant_agrees_with_sympy(matrix: PolynomialMatrix) -> None:
    expected = R.from_sympy(sympy.expand(matrix.to_sympy().det(method="berkowitz")))
    assert determinant(matrix) == expected


@settings(max_examples=40, deadline=None)
@given(matrices(3, 5))
def test_minors_agree_with_sympy(matrix: PolynomialMatrix) -> None:
    full = matrix.to_sympy()
    for size in (1, 2, 3):
        found = {(r, c): m for r, c, m in minors(matrix, size)}
        for rows in combinations(range(3), size):
            for columns in combinations(range(5), size):
                expected = sympy.expand(full.extract(list(rows), list(columns)).det(method="berkowitz"))
                assert found.get((rows, columns), R.zero) == R.from_sympy(expected)
    assert {(c, r): m for r, c, m in maximal_minors(matrix)} == {
        (r, c): m for r, c, m in maximal_minors(matrix.T)
    }


@settings(max_examples=80, deadline=None)
@given(st.tuples(st.integers(1, 6), st.integers(1, 6)).flatmap(lambda s: matrices(*s)))
def test_block_form_is_triangular(matrix: PolynomialMatrix) -> None:
    form = block_triangular(matrix)
    assert sorted(form.row_order) == list(range(matrix.shape[0]))
    assert sorted(form.column_order) == list(range(matrix.shape[1]))
    parts = [form.wide, *form.square, form.tall]
    for later, (rows, _) in enumerate(parts):
        for _, columns in parts[:later]:
            assert not any(matrix[i, j] for i in rows for j in columns)
    assert all(len(rows) == len(columns) for rows, columns in form.square)
    assert len(form.wide[0]) <= len(form.wide[1])
    assert len(form.tall[0]) >= len(form.tall[1])
    matching = len(form.wide[0]) + sum(len(rows) for rows, _ in form.square) + len(form.tall[1])
    assert matrix.to_sympy().subs({"x": 3, "y": 7, "z": 11}).rank() <= matching


@settings(max_examples=40, deadline=None)
@given(matrices(5, 5))
def test_ranks_of_diagonal_blocks_add(matrix: PolynomialMatrix) -> None:
    point = {"x": 2, "y": -3, "z": 5}
    parts = [matrix.select(r, c).to_sympy().subs(point).rank() for r, c in diagonal_blocks(matrix)]
    assert sum(parts) == matrix.to_sympy().subs(point).rank()


def test_no_transversal_gives_zero() -> None:
    x = R.gens[0]
    matrix = PolynomialMatrix.of(R, [[x, x, x], [x, 0, 0], [x, 0, 0]])
    assert block_determinants(matrix) == (R.zero,)
    assert not determinant(matrix)
    assert determinant(PolynomialMatrix.of(R, [], 0)) == 1
    with pytest.raises(ValueError, match="square"):
        determinant(PolynomialMatrix.of(R, [[x, x]]))


def stewart() -> PolynomialMatrix:
    """Rows (P - B, B x P) of the six legs with the platform at a position, turned by a quaternion."""
    ring = Ring(("px", "py", "pz", "q0", "q1", "q2", "q3"))
    px, py, pz, a, b, c, d = ring.gens
    n = a * a + b * b + c * c + d * d
    turn = [
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ]
    base = [(0, 0, 0), (7, 0, 0), (9, 4, 0), (5, 9, 1), (1, 8, 0), (-2, 3, 2)]
    platform = [(0, 0, 0), (3, 0, 0), (4, 2, 1), (2, 4, 0), (1, 3, 1), (-1, 1, 0)]
    rows = []
    for foot, own in zip(base, platform, strict=True):
        end = [p + sum((t * o for t, o in zip(row, own, strict=True)), start=ring.zero)
               for p, row in zip((px * n, py * n, pz * n), turn, strict=True)]  # fmt: skip
        leg = [e - n * f for e, f in zip(end, foot, strict=True)]
        moment = [foot[i - 2] * leg[i - 1] - foot[i - 1] * leg[i - 2] for i in range(3)]
        rows.append([*leg, *moment])
    return PolynomialMatrix.of(ring, rows)


def at(matrix: PolynomialMatrix, point: list[int]) -> sympy.Matrix:
    return sympy.Matrix([[sympy.Rational(str(e)) for e in row] for row in matrix.evaluate(point)])


def test_stewart_determinant_in_seven_unknowns() -> None:
    matrix = stewart()
    value = determinant(matrix)
    point = [1, 2, 3, 1, -2, 1, 3]
    assert at(matrix, point).det() == value.evaluate(point)


def test_all_84_maximal_minors_of_a_sparse_6x9() -> None:
    ring = Ring(tuple(f"x{i}" for i in range(18)))
    g: tuple[Polynomial, ...] = ring.gens
    rows = [[(g[(5 * i + 7 * j) % 18] * g[(i + j) % 18] + g[(3 * i * j) % 18] - j - 1) * ((i + j) % 3 != 0)
             for j in range(9)] for i in range(6)]  # fmt: skip
    matrix = PolynomialMatrix.of(ring, rows)
    found = list(maximal_minors(matrix))
    point = [1, 2, -1, 3, 1, 2, 5, -2, 1, 1, 4, 3, -3, 2, 1, 2, 7, 1]
    full = at(matrix, point)
    for rows_, columns, minor in found[::13]:
        assert full.extract(list(rows_), list(columns)).det() == minor.evaluate(point)


def test_a_determinant_ends_with_its_budget() -> None:
    """A full 30 by 30 matrix of unknowns has 30! terms."""
    names = tuple(f"x{i}_{j}" for i in range(30) for j in range(30))
    ring = Ring(names)
    matrix = PolynomialMatrix.of(ring, [ring.gens[30 * i : 30 * i + 30] for i in range(30)])
    with Budget(work=0.1), pytest.raises(BudgetExceeded):
        determinant(matrix)
