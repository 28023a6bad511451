"""The reduction of section 4.2: ranks drop by the constant everywhere.

Source: the 2-DOF linkage is written by hand from (6) of Zlatanov, Fenton, Benhabib (1998).
"""

from dataclasses import dataclass
from itertools import chain, combinations

from flint import fmpq, fmpq_mat
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.reduction import eliminate, reduce, reduce_submatrix
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring


@dataclass(frozen=True)
class Column:
    label: str
    role: str


@dataclass(frozen=True)
class Equation:
    """What the reduction and the conditions need to know of a velocity equation."""

    space: ConfigurationSpace
    matrix: PolynomialMatrix
    columns: tuple[Column, ...]
    rows: tuple[str, ...]
    N: int
    n: int

    def without(self, *roles: str) -> PolynomialMatrix:
        return self.matrix.select(columns=[j for j, c in enumerate(self.columns) if c.role not in roles])

    @property
    def L(self) -> PolynomialMatrix:
        return self.matrix

    @property
    def L_I(self) -> PolynomialMatrix:
        return self.without("input")

    @property
    def L_O(self) -> PolynomialMatrix:
        return self.without("output")

    @property
    def L_p(self) -> PolynomialMatrix:
        return self.without("input", "output")


RING = Ring(("xB", "yB", "xC", "yC", "xF", "yF", "xG", "yG"))
_xB, _yB, _xC, _yC, _xF, _yF, _xG, _yG = RING.gens
Point = tuple[Polynomial, Polynomial]
POINTS: dict[str, Point] = {
    "A": (RING.zero, RING.zero),
    "B": (_xB, _yB),
    "C": (_xC, _yC),
    "D": (RING.one, RING.zero),
    "E": (RING.constant(2), RING.zero),
    "F": (_xF, _yF),
    "G": (_xG, _yG),
}


def collinear(p: str, q: str, r: str) -> Polynomial:
    """Twice the signed area of a triangle of named points."""
    (px, py), (qx, qy), (rx, ry) = POINTS[p], POINTS[q], POINTS[r]
    return (qx - px) * (ry - py) - (qy - py) * (rx - px)


def two_dof() -> Equation:
    """AB = BC = CD = 1, CG = 3/2, FG = 2, EF = 3; inputs at A and E, output the velocity of G."""
    loops = []
    for p, q, square in [
        ("A", "B", 4),
        ("B", "C", 4),
        ("C", "D", 4),
        ("C", "G", 9),
        ("F", "G", 16),
        ("E", "F", 36),
    ]:
        (px, py), (qx, qy) = POINTS[p], POINTS[q]
        loops.append(((px - qx) ** 2 + (py - qy) ** 2) * 4 - square)
    space = ConfigurationSpace(RING, tuple(loops), points=POINTS)
    first, second = (
        {"A": "A", "B": "B", "C": "C1", "D": "D"},
        {"E": "E", "D": "D", "C": "C2", "G": "G", "F": "F"},
    )
    labels = ["vx", "vy", "A", "E", "B", "C1", "D", "C2", "G", "F"]
    rows: list[list[Polynomial]] = [[RING.zero] * 10 for _ in range(8)]
    rows[0][0] = rows[1][1] = RING.one
    for p in ("E", "F"):
        rows[0][labels.index(p)] = POINTS[p][1] - _yG
        rows[1][labels.index(p)] = _xG - POINTS[p][0]
    for start, loop in ((2, first), (5, second)):
        for p, label in loop.items():
            x, y = POINTS[p]
            for k, entry in enumerate((RING.one, y, -x)):
                rows[start + k][labels.index(label)] = entry
    roles = ["output"] * 2 + ["input"] * 2 + ["passive"] * 6
    columns = tuple(Column(label, role) for label, role in zip(labels, roles, strict=True))
    names = ("G x", "G y", *(f"loop {k} {c}" for k in (1, 2) for c in ("w", "vx", "vy")))
    return Equation(space, PolynomialMatrix.of(RING, rows), columns, names, 8, 2)


def rank(matrix: PolynomialMatrix, point: list[fmpq]) -> int:
    rows, columns = matrix.shape
    return (
        int(fmpq_mat(rows, columns, list(chain(*matrix.evaluate(point)))).rank()) if rows and columns else 0
    )


def test_two_dof_reduces_to_one_row_a_loop() -> None:
    """Every loop keeps one row, of collinearity determinants: reciprocal to the two pins that went."""
    reduction = reduce(two_dof())
    assert reduction.constant == 4
    assert reduction.equation.N == 4
    assert reduction.equation.matrix.shape == (4, 6)
    entries = {e.primitive() for row in reduction.equation.matrix.rows[2:] for e in row if e}
    named = {collinear(*p).primitive() for p in ("ABC", "BCD", "CGE", "CDG", "CFG")}
    assert entries == named
    assert any("C1 from rows" in line and "squares 1" in line for line in reduction.lines)
    assert reduction.lines[-1] == "every rank is that of the reduced matrix (4x6) + 4"


def test_passive_columns_alone_reduce_to_two_determinants() -> None:
    """L_p loses rank iff B, C, D and C, D, G are collinear (section 3.3, step 2)."""
    found = reduce_submatrix(two_dof().L_p, Certifier(two_dof().space))
    assert {row[0].primitive() for row in found.matrix.rows} == {
        collinear("B", "C", "D").primitive(),
        collinear("C", "D", "G").primitive(),
    }
    assert found.constant == 5


def test_outputs_and_inputs_stay() -> None:
    before, after = two_dof(), reduce(two_dof()).equation
    for role in ("output", "input"):
        assert [c for c in before.columns if c.role == role] == [c for c in after.columns if c.role == role]


CIRCLES = Ring(("c", "s", "d", "t", "x"))
c, s, d, t, x = CIRCLES.gens
SPACE = ConfigurationSpace(CIRCLES, (c**2 + s**2 - 1, d**2 + t**2 - 1), exclusions=((c + d, s + t),))
ENTRIES = st.sampled_from([0, 0, 0, 0, 1, -2, c, s, -s, d, t, x, x * c, c * d + s * t + 1, c * d + s * t])


def on_circle(k: fmpq) -> list[fmpq]:
    return [(1 - k * k) / (1 + k * k), 2 * k / (1 + k * k)]


PARAMETERS = st.fractions(-3, 3, max_denominator=4).map(lambda f: fmpq(f.numerator, f.denominator))


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.lists(ENTRIES, min_size=6, max_size=6), min_size=4, max_size=5),
    PARAMETERS,
    PARAMETERS,
    PARAMETERS,
)
def test_ranks_drop_by_the_constant_whatever_else_is_taken_away(
    rows: list[list[Polynomial]], k: fmpq, m: fmpq, value: fmpq
) -> None:
    point = [*on_circle(k), *on_circle(m), value]
    if point[0] == -point[2] and point[1] == -point[3]:
        return
    matrix = PolynomialMatrix.of(CIRCLES, rows)
    found = eliminate(matrix, range(3, 6), Certifier(SPACE))
    for count in range(4):
        for dropped in combinations(range(3), count):
            before = matrix.select(columns=[j for j in range(6) if j not in dropped])
            kept = [place for place, j in enumerate(found.columns) if j not in dropped]
            after = found.matrix.select(columns=kept)
            assert rank(before, point) == rank(after, point) + found.constant
    alone = reduce_submatrix(matrix, Certifier(SPACE))
    assert rank(matrix, point) == rank(alone.matrix, point) + alone.constant


def test_spherical_joint_with_an_idle_spin() -> None:
    """The 4x3 block [-[d]x; d^T] of a leg d of length 2 leaves the one row d^T: velocities along the leg."""
    ring = Ring(("x", "y", "z"))
    x, y, z = ring.gens
    o = ring.zero
    spins = [[o, z, -y, 1, 0, 0], [-z, o, x, 0, 1, 0], [y, -x, o, 0, 0, 1], [x, y, z, 0, 0, 0]]
    certifier = Certifier(ConfigurationSpace(ring, (x**2 + y**2 + z**2 - 4,)))
    found = eliminate(PolynomialMatrix.of(ring, spins), (0, 1, 2), certifier)
    assert found.matrix.rows in (((x, y, z),), ((-x, -y, -z),))
    assert found.constant == 3
    somewhere = Certifier(ConfigurationSpace(ring, ()))
    assert eliminate(PolynomialMatrix.of(ring, spins), (0, 1, 2), somewhere).constant == 0
