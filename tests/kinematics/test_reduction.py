"""The reduction of section 4.2: ranks drop by the constant everywhere.

Source: the 2-DOF linkage is written by hand from (6) of Zlatanov, Fenton, Benhabib (1998).
"""

from itertools import chain, combinations

from flint import fmpq, fmpq_mat
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.reduction import eliminate, reduce, reduce_submatrix
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from tests.kinematics.two_dof import collinear, two_dof


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


def test_a_pivot_stays_in_no_column() -> None:
    """Two pivots p leave p^2 w, p^2 z in the last column by row operations; p has no zero, and goes.

    Source: Cramer's rule for the two velocities that are solved for.
    """
    ring = Ring(("u", "v", "x", "y", "z", "w"))
    u, v, x, y, z, w = ring.gens
    o, p = ring.zero, u + v
    certifier = Certifier(ConfigurationSpace(ring, (), exclusions=((p,),)))
    chain_of_three = PolynomialMatrix.of(ring, [[p, x, o, o], [o, p, y, o], [z, o, o, w], [w, o, o, z]])
    found = reduce_submatrix(chain_of_three, certifier)
    assert found.constant == 2
    columns = list(zip(*found.matrix.rows, strict=True))
    assert {tuple(e.primitive() for e in column) for column in columns} == {(x * y * z, x * y * w), (w, z)}
