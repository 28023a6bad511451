"""Rank strata on small matrices whose ranks are known by hand."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.classes.strata import ground as ground_module
from singsym.classes.strata.block_rank import BlockRank, block_rank, expanded, union_of_loci
from singsym.classes.strata.ground import Ground, NotEvident
from singsym.classes.strata.patches import Patch
from singsym.classes.strata.ranks import RankProblem, ranked, relevant
from singsym.classes.taxonomy.types import Defects, SingularityType, feasible_defects
from singsym.effort import patience
from singsym.effort.budget import Undecided, current
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.varieties.decomposition import decompose
from singsym.varieties.real.numerical.sampling import numerical_points
from singsym.varieties.real.points.intervals import pivots
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y"))
x, y = R.gens


def ground(*equations: Polynomial) -> Ground:
    (component,) = decompose(equations, ring=R).value
    points = numerical_points(RealSystem(R, equations))
    return Ground(Patch(R, {}, component.generators), points, component)


def rank(matrix: PolynomialMatrix, where: Ground) -> BlockRank:
    return block_rank(matrix, where, where.certifier(RealSystem(R, ()), ())).value


def test_rank_of_a_matrix_on_the_plane_and_on_a_line() -> None:
    """diag(x, y): rank 2 off xy = 0; on y = 0 rank 1 off x = 0."""
    matrix = PolynomialMatrix.of(R, [[x, 0], [0, y]])
    assert rank(matrix, ground()).rank == 2
    assert rank(matrix, ground()).minors == (x * y,)
    assert rank(matrix, ground(y)).rank == 1
    assert rank(matrix, ground(y)).minors == (x,)


def test_rank_that_never_drops_needs_no_minors() -> None:
    matrix = PolynomialMatrix.of(R, [[1, x], [y, 0]])
    assert rank(matrix, ground(x)).minors == ()
    assert rank(PolynomialMatrix.of(R, [[0, 0]]), ground()).rank == 0


def test_rank_on_a_reducible_set_that_is_not_known_to_be_prime() -> None:
    """On x y = 0, taken whole, the matrix (x) vanishes on one of two lines: its rank is 1 off that line."""
    found = rank(PolynomialMatrix.of(R, [[x]]), ground(x**2 - 2 * y**2))
    assert (found.rank, found.minors) == (1, (x,))


@given(st.lists(st.lists(st.integers(-2, 2), min_size=3, max_size=3), min_size=2, max_size=4))
@settings(max_examples=50, deadline=None)
def test_pivots_have_numpys_rank(rows: list[list[int]]) -> None:
    matrix = [[float(e) for e in row] for row in rows]
    chosen = pivots(matrix)
    expected = np.linalg.matrix_rank(np.array(matrix))
    assert len(chosen[0]) == len(chosen[1]) == expected
    if expected:
        assert abs(np.linalg.det(np.array(matrix)[np.ix_(*chosen)])) > 1e-9


def row_problem() -> RankProblem:
    """N = 2, n = 1: L is a unit and the row (x y), L_I the row (x), L_O (y), L_p nothing."""
    unit = PolynomialMatrix.of(R, [[1, 0, 0], [0, x, y]])
    columns = {"L": [0, 1, 2], "L_I": [0, 1], "L_O": [0, 2], "L_p": [0]}
    return RankProblem({name: unit.select(columns=c) for name, c in columns.items()}, 0, 2, 1)


def test_ranks_on_the_plane_and_on_a_line() -> None:
    """Off the axes nothing is singular; L_O is where y = 0, and at the origin both are and so is L."""
    plane = ranked(row_problem(), ground(), RealSystem(R, ())).value
    assert plane.stratum is not None
    assert plane.stratum.defects == Defects(0, 0, 0, 0)
    assert set(plane.loci) == {(x,), (y,)}
    line = ranked(row_problem(), ground(y), RealSystem(R, ())).value
    assert line.stratum is not None
    assert line.stratum.defects == Defects(0, 0, 0, 1)
    assert line.loci == {(x,): {"L": 1}}
    origin = ranked(row_problem(), ground(x, y), RealSystem(R, ())).value
    assert origin.stratum is not None
    assert (origin.stratum.defects, origin.loci) == (Defects(1, 0, 1, 1), {})


def test_what_is_known_is_not_written_again() -> None:
    """With full rank of L and L_p no stratum where its types are among those known."""
    known = (SingularityType(0), SingularityType.RO | SingularityType.II)
    assert ranked(row_problem(), ground(), RealSystem(R, ()), complete_types=known).value.stratum is None


def test_a_minor_that_only_seems_to_vanish_is_not_evident() -> None:
    """It vanishes on the patch, but is not in the ideal of its equation."""
    one = x**2 - 2 * y**2
    where = Ground(Patch(R, {}, (one**2,)), ((2**0.5, 1.0),))
    with pytest.raises(NotEvident):
        rank(PolynomialMatrix.of(R, [[one]]), where)


def test_a_combination_of_equations_vanishes() -> None:
    """The point: y^2 = sqrt 2, x = y^3."""
    one, two = x**2 - 2 * y**2, y**3 - x
    where = Ground(Patch(R, {}, (one, two)), ((2**0.75, 2**0.25),))
    assert rank(PolynomialMatrix.of(R, [[y * one + x * two]]), where).rank == 0


def test_whether_a_patch_is_irreducible_is_asked_last(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not where one entry alone does not vanish: off its zeros the rank is 1, whatever lies inside them.

    Nor for long where the only larger minor is zero, so that each entry shows the rank.
    """
    asked: list[float] = []

    def never(*given: object, **named: object) -> object:
        asked.append(current().remaining() or 0.0)
        raise Undecided("not seen")

    monkeypatch.setattr(ground_module, "decompose", never)
    where = Ground(Patch(R, {}, (x * y,)), ((0.0, 1.0),))
    found = rank(PolynomialMatrix.of(R, [[y, x * y], [x * y**2, 0]]), where)
    assert (found.rank, found.minors, found.seen_off, asked) == (1, (y,), y, [])
    assert not where.has_no_zeros_inside(y).value
    assert len(asked) == 2
    asked.clear()
    plane = Ground(Patch(R, {}, ()), ((1.0, 2.0),))
    found = rank(PolynomialMatrix.of(R, [[x, y], [2 * x, 2 * y]]), plane)
    assert (found.rank, set(found.minors)) == (1, {x, y})
    assert len(asked) == 1
    assert asked[0] == pytest.approx(patience.SOON_IRREDUCIBLE.work, abs=0.2)


@pytest.mark.parametrize("n", [1, 2, 3])
def test_matrices_left_out_cannot_change_the_types(n: int) -> None:
    """Where only matrices that are not relevant lose rank, the types stay: over all feasible defects."""
    feasible = list(feasible_defects(n))
    place = {"L": "delta", "L_p": "p", "L_I": "k_I", "L_O": "k_O"}
    for here in feasible:
        watched = [place[name] for name in relevant(here)]
        for there in feasible:
            grown = all(b >= a for a, b in zip(here, there, strict=True))
            if grown and all(getattr(here, f) == getattr(there, f) for f in watched):
                assert here.types == there.types


def test_minors_that_are_small_at_known_points_do_not_leave_no_locus() -> None:
    """At x = y = 1 the first eight columns are zero, the others (z, 1), (1, z): rank 1 at z = 1, 2 at z = 0.

    Only (1, 1, 0) is known, where all minors of the first eight with another column are zero: at (1, 1, 1) is
    the rank lower none the less, and the locus has to hold this point.
    """
    space = Ring(("x", "y", "z"))
    first, second, third = space.gens
    powers = range(1, 5)
    matrix = PolynomialMatrix.of(
        space,
        [
            [*((first - 1) ** k for k in powers), *([0] * 4), third, 1],
            [*([0] * 4), *((second - 1) ** k for k in powers), 1, third],
        ],
    )
    where = Ground(Patch(space, {}, ()), ((1.0, 1.0, 0.0),))
    certifier = where.certifier(RealSystem(space, ()), ())
    found = block_rank(matrix, where, certifier, ((0, 1), (8, 9)), True).value
    assert found.rank == 2
    loci, _ = union_of_loci(found.minors, certifier)
    assert any(all(p.evaluate((1.0, 1.0, 1.0)) == 0 for p in locus) for locus in loci)


def test_a_determinant_that_is_too_large_asks_for_an_entry_that_may_vanish() -> None:
    """A shorter one that is excluded from being zero is known: to ask for it again would never end."""
    ring = Ring(("x", "y", *(f"a{k}" for k in range(8))))
    p, q, *others = ring.gens
    long = sum(others, start=ring.one) ** 2
    rows = [[p if i == j == 0 else q + 2 if i == j == 1 else long for j in range(8)] for i in range(8)]
    square = PolynomialMatrix.of(ring, rows)
    certifier = Certifier(ConfigurationSpace(ring, (), exclusions=((p,),)))
    with pytest.raises(NotEvident) as asked:
        expanded(square, certifier)
    assert asked.value.polynomial == q + 2
    every = Certifier(ConfigurationSpace(ring, (), exclusions=((p,), (q + 2,), (long,))))
    with pytest.raises(Undecided, match="too large") as doubt:
        expanded(square, every)
    assert not isinstance(doubt.value, NotEvident)
