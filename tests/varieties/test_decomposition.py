"""Decomposition: varieties known in advance, unions of known primes, and the curves of the 2-DOF linkage."""

from contextlib import AbstractContextManager, suppress
from fractions import Fraction
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.effort.budget import Budget, BudgetExceeded, Undecided
from singsym.effort.chance import use_seed
from singsym.effort.chaos import chaos
from singsym.effort.patience import scaled
from singsym.elimination import engines
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import forget
from singsym.polynomials import AlgebraicConstant, Equations, Polynomial, Ring
from singsym.varieties.decomposition import decompose

R = Ring(("x", "y", "z"))
x, y, z = R.gens


def zeros(*equations: Polynomial, nonzero: Equations = (), ring: Ring = R) -> set[frozenset[Polynomial]]:
    """The reduced Groebner bases of the components, all of them proven prime."""
    found = decompose(equations, nonzero, ring=ring).value
    assert all(c.prime for c in found)
    return {frozenset(c.generators) for c in found}


def bases(*ideals: Equations) -> set[frozenset[Polynomial]]:
    return {frozenset(Ideal(R, ideal).groebner_basis().value) for ideal in ideals}


# -- less time -----------------------------------------------------------------------------------------


def curve_and_points() -> Equations:
    """Combinations a f + b g with linear a, b: zero on the curve f = g = 0 and where the rows (a, b) are
    dependent, a cubic curve, and one of the equations holds as well, which leaves finitely many points."""
    f, g = x**2 + y**2 + z**2 + 1, x * y - z + x
    rows = (
        (3 * y - 2 * x + 1, x - y - z),
        (2 * x + 2 * z - 1, y + 3 * z + 2),
        (x + y - 3 * z, 2 * x - y + z + 1),
    )
    return tuple(a * f + b * g for a, b in rows)


@pytest.mark.parametrize("hurry", [scaled(1e-5), chaos(2, 0.3)])
def test_what_a_hurry_leaves_whole_is_split_in_the_same_process(
    hurry: AbstractContextManager[object],
) -> None:
    with hurry, suppress(Undecided):
        decompose(curve_and_points(), ring=R)
    assert [(c.dimension, c.prime) for c in decompose(curve_and_points(), ring=R).value] == [
        (1, True),
        (0, True),
    ]


# -- single cases --------------------------------------------------------------------------------------


def test_unit_and_zero_ideals() -> None:
    assert decompose([R.one], ring=R).value == ()
    assert decompose([x, x - 1], ring=R).value == ()
    (space,) = decompose([], ring=R).value
    assert (space.generators, space.dimension, space.prime) == ((), 3, True)
    assert decompose([R.zero], ring=R).value == (space,)
    assert decompose([], [R.zero], ring=R).value == ()


def test_double_line_and_embedded_point() -> None:
    assert zeros((x - y) ** 2, z) == bases((x - y, z))
    assert zeros(x**2, x * y, z) == bases((x, z))


def test_unused_variable_counts_in_the_dimension() -> None:
    (circle,) = decompose([x**2 + y**2 - 1], ring=R).value
    assert circle.dimension == 2


def test_points_and_curves_of_one_ideal() -> None:
    # The space curve (t^3, t^4, t^5) with a point beside it, and with a point embedded in it.
    curve = (x * z - y**2, x**3 - y * z, z**2 - x**2 * y)
    beside, on = (x - 1, y - 1, z - 2), (x - 1, y - 1, z - 1)
    assert zeros(*(p * q for p in curve for q in beside)) == bases(curve, beside)
    assert zeros(*(p * a * b for p in curve for a in on for b in on)) == bases(curve)


def test_determinantal_variety_is_prime() -> None:
    ring = Ring(tuple("abcdef"))
    a, b, c, d, e, f = ring.gens
    (found,) = decompose([a * e - b * d, a * f - c * d, b * f - c * e], ring=ring).value
    assert (found.prime, found.dimension) == (True, 4)


@pytest.mark.engines
def test_splitting_that_no_equation_shows() -> None:
    # x = y or x = -y for the square roots of 2; sqrt(6) is the product of sqrt(2) and sqrt(3).
    assert zeros(x**2 - 2, y**2 - 2, z) == bases((x**2 - 2, y - x, z), (x**2 - 2, y + x, z))
    root2, root3 = x**2 - 2, y**2 - 3
    assert zeros(root2, root3, z**2 - 6) == bases((root2, root3, z - x * y), (root2, root3, z + x * y))
    # conjugate pairs of lines: u^2 = 2 v^2 twice
    ring = Ring(tuple("uvst"))
    u, v, s, t = ring.gens
    found = decompose([u**2 - 2 * v**2, s**2 - 2 * t**2], ring=ring).value
    assert [c.dimension for c in found] == [2, 2]
    assert {c.vanishes(u * t - v * s).value for c in found} == {True, False}


@pytest.mark.engines
def test_constants_bring_their_relations() -> None:
    sqrt2 = AlgebraicConstant("r", (-2, 0, 1), Fraction(1), Fraction(2))
    sqrt3 = AlgebraicConstant("s", (-3, 0, 1), Fraction(1), Fraction(2))
    ring = Ring(("x", "r", "s"), constants=(sqrt2, sqrt3))
    unknown, r, s = ring.gens
    assert zeros(unknown**2 - 2, ring=ring) == {
        frozenset(Ideal(ring, (unknown - sign * r, *ring.relations)).groebner_basis().value)
        for sign in (1, -1)
    }
    assert len(zeros(unknown**2 - 5, ring=ring)) == 1
    assert len(zeros(unknown**2 - 6, ring=ring)) == 2
    assert len(zeros(unknown**2 - 2 * r * s - 5, ring=ring)) == 2  # (sqrt2 + sqrt3)^2 = 5 + 2 sqrt6


def test_coefficients_of_a_hundred_digits() -> None:
    a, b = 10**100 + 267, 10**99 + 289
    assert zeros(a * x - b * y, (a * x + b) * (y - a), z - a) == bases(
        (a * x - b * y, y - a, z - a), (a * x - b * y, a * x + b, z - a)
    )


def test_nonzero_drops_whole_components_only() -> None:
    assert zeros(x * y, nonzero=(x,)) == bases((y,))
    assert zeros(x * y * (z - 1), x * z, nonzero=(x, y)) == set()
    assert zeros(x**2 + y**2 - 1, nonzero=(x - 1,)) == bases((x**2 + y**2 - 1,))


def test_pieces_in_sets_that_do_not_count_are_left_out() -> None:
    """Of the plane x = 0, the line y = z = 0 and, in another order, what lies in a set only as a whole."""
    plane, line = bases((x,)), bases((y, z))

    def left(*excluded: Equations) -> set[frozenset[Polynomial]]:
        found = decompose((x * y, x * z), ring=R, excluded=excluded).value
        return {frozenset(c.generators) for c in found}

    assert left() == left((x, y), (y, z - 1)) == plane | line
    assert left((z, y + z)) == plane
    assert left((x, x * z)) == line
    assert left((x, x * z), (y, z)) == set()


def test_progress_and_budget() -> None:
    forget()
    events: list[object] = []
    decompose([x**2 + y**2 - 1, x * y * z - 1], ring=R, progress=events.append)
    assert events
    with pytest.raises(BudgetExceeded):
        decompose([x**3 + y**3 - z, x**2 - y * z**2 + 5], ring=R, budget=Budget(0))


# -- unions of known primes ----------------------------------------------------------------------------

PRIMES: tuple[Equations, ...] = (
    (x, y, z - 1),
    (x - 1, y - 2, z - 3),
    (x**2 - 2, y - x, z),
    (x, y),
    (x - y, z - 1),
    (x**2 + y**2 - 1, z),
    (y - x**2, z - x**3),
    (x**2 - 2 * y**2, z),
    (z,),
    (x**2 + y**2 + z**2 - 1,),
    (x * y - z,),
)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.sampled_from(range(len(PRIMES))), min_size=1, max_size=3, unique=True), st.booleans())
def test_unions_of_primes_come_apart(chosen: list[int], squared: bool) -> None:
    ideals = [PRIMES[i] for i in chosen]
    equations = [R.one]
    for ideal in ideals:
        equations = [e * p for e in equations for p in ideal]
    if squared:
        equations = [e**2 for e in equations]
    with engines.use("flint"):
        larger = [
            [j for j in chosen if j != i and Ideal(R, PRIMES[i]).radical_contains(Ideal(R, PRIMES[j])).value]
            for i in chosen
        ]
        expected = [ideal for ideal, inside in zip(ideals, larger, strict=True) if not inside]
        assert zeros(*equations) == bases(*expected)


@pytest.mark.engines
@settings(max_examples=15, deadline=None)
@given(st.lists(st.tuples(*[st.integers(-2, 2)] * 7), min_size=2, max_size=3))
def test_same_components_as_singular(rows: list[tuple[int, ...]]) -> None:
    monomials = (x**2, y**2, x * y, y * z, x, z, R.one)
    equations = [sum((m * c for m, c in zip(monomials, row, strict=True)), start=R.zero) for row in rows]
    with engines.use("flint"):
        ours = decompose(equations, ring=R).value
    expected = Ideal(R, equations).minimal_primes().value
    assert {frozenset(p.groebner_basis().value) for p in expected} == {frozenset(c.generators) for c in ours}


# -- the 2-DOF linkage of Zlatanov, Fenton, Benhabib (1998), §3.3 ---------------------------------------

PLANE = Ring(("Bx", "By", "Cx", "Cy", "Fx", "Fy", "Gx", "Gy"))
Point = tuple[Polynomial, Polynomial]
POINTS: dict[str, Point] = {n: (PLANE.constant(i), PLANE.zero) for i, n in enumerate("ADE")} | {
    n: (PLANE.gen(f"{n}x"), PLANE.gen(f"{n}y")) for n in "BCFG"
}
LENGTHS = {"AB": 1, "BC": 1, "CD": 2, "CG": Fraction(3, 2), "FG": 2, "EF": 3}


def squared_distance(p: Point, q: Point) -> Polynomial:
    return (p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2


def collinear(triple: str) -> Polynomial:
    p, q, r = (POINTS[n] for n in triple)
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


LOOPS = [
    squared_distance(POINTS[pair[0]], POINTS[pair[1]]) - Fraction(length) ** 2
    for pair, length in LENGTHS.items()
]
# Two links in line reach |a ± b|; ABC folded would put C on A, at distance 1 and not 2 from D.
REACHES = {
    "BCD": ("BD", (1, 3)),
    "CGF": ("CF", (Fraction(1, 2), Fraction(7, 2))),
    "ABC": ("AC", (2,)),
    "CDG": ("DG", (Fraction(1, 2), Fraction(7, 2))),
    "EFG": ("EG", (1, 5)),
}


@pytest.fixture(params=[("flint",), ("flint", "msolve", "singular")], ids=["flint", "all"])
def allowed(request: pytest.FixtureRequest) -> tuple[str, ...]:
    forget()
    return tuple(request.param)


@pytest.mark.parametrize("triple", REACHES)
def test_curves_of_the_linkage(triple: str, allowed: tuple[str, ...]) -> None:
    with engines.use(*allowed):
        found = decompose([*LOOPS, collinear(triple)], ring=PLANE, budget=Budget(30)).value
    ends, reaches = REACHES[triple]
    assert [(c.dimension, c.prime) for c in found] == [(1, True)] * len(reaches)
    span = squared_distance(POINTS[ends[0]], POINTS[ends[1]])
    for reach in reaches:
        assert sum(c.ideal.contains(span - Fraction(reach) ** 2).value for c in found) == 1


def test_pairs_of_determinants_of_the_linkage() -> None:
    with engines.use("flint"):
        for first, second in combinations(REACHES, 2):
            found = decompose(
                [*LOOPS, collinear(first), collinear(second)], ring=PLANE, budget=Budget(30)
            ).value
            assert all(c.prime and c.dimension == 0 for c in found)
            assert bool(found) == ({first, second} != {"BCD", "ABC"})


@pytest.mark.parametrize("drawn", [1, 5, 314007])
def test_stretched_and_folded_cranks_of_all_lengths_are_two_pure_parts(drawn: int) -> None:
    # C on a circle about (1, 0), B in line with the origin and C, at the distance a from the one and b from
    # the other, of either sign: |C| = a + b or a - b, each over C's curve and the line of all b
    forget()
    S = Ring(("Bx", "By", "Cx", "Cy", "a", "b"))
    Bx, By, Cx, Cy, a, b = S.gens
    apart = (Bx - Cx) ** 2 + (By - Cy) ** 2 - b**2
    equations = (Bx**2 + By**2 - a**2, apart, (Cx - 1) ** 2 + Cy**2 - 9, By * Cx - Bx * Cy)
    with use_seed(drawn), engines.use("flint"):
        found = decompose(equations, ring=S).value
    assert [(c.prime, c.dimension, c.is_pure) for c in found] == [(True, 2, True)] * 2
    for sign in (1, -1):
        assert sum(c.vanishes((a + sign * b) ** 2 - Cx**2 - Cy**2).value for c in found) == 1
