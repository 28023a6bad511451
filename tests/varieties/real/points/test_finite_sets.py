"""Finite systems: all real points, against independent counts, on FLINT alone and with msolve."""

import random
from fractions import Fraction
from itertools import pairwise

import pytest
from flint import fmpz_poly

from singsym.effort.budget import Budget, Undecided
from singsym.elimination import engines
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.elimination.engines.registry import msolve, singular
from singsym.elimination.memo import forget
from singsym.polynomials import AlgebraicConstant, Polynomial, Ring
from singsym.varieties.real.points import finite_sets
from singsym.varieties.real.points.finite_sets import Ideal, parametrized, real_points
from singsym.varieties.real.points.macaulay_algebra import quotient_algebra_over
from singsym.varieties.real.points.parametrization import reconstruct

R = Ring(("x", "y", "z"))
x, y, z = R.gens

# issue 3: found with msolve and Krawczyk balls by a separate program
PAIRS = {
    ("BCD", "CDG"): 8,
    ("BCD", "CGF"): 8,
    ("BCD", "EFG"): 0,
    ("ABC", "BCD"): 0,
    ("ABC", "CDG"): 8,
    ("CDG", "CGF"): 4,
    ("CDG", "EFG"): 0,
    ("ABC", "CGF"): 4,
    ("ABC", "EFG"): 4,
    ("CGF", "EFG"): 4,
}


@pytest.fixture(params=["flint", "all"], autouse=True)
def engine(request):
    forget()
    with engines.use(*(["flint"] if request.param == "flint" else [])):
        yield request.param


@pytest.mark.parametrize(("pair", "count"), PAIRS.items(), ids=["-".join(p) for p in PAIRS])
def test_the_linkage_has_these_points(linkage, pair, count):
    equations = [*linkage.loops, *map(linkage.determinant, pair)]
    points = real_points(equations).value
    assert len(points) == count
    assert all(p.sign(f) == 0 for p in points for f in equations)


def katsura(n: int) -> list[Polynomial]:
    """Katsura, Sasaki (1987): sum over l of u_l u_(m-l) = u_m, sum of all u = 1."""
    ring = Ring(tuple(f"u{i}" for i in range(n + 1)))
    u = ring.gens

    def at(i: int) -> Polynomial:
        return u[abs(i)] if abs(i) <= n else ring.zero

    span = range(-n, n + 1)
    total = sum((at(i) for i in span), start=ring.zero) - 1
    return [total] + [sum((at(k) * at(m - k) for k in span), start=ring.zero) - at(m) for m in range(n)]


# real solutions of katsura-n as in the PHCpack and SymbolicData collections
@pytest.mark.parametrize(("n", "count"), [(2, 4), (3, 6), (4, 12), (5, 16), (6, 32)])
def test_katsura(n, count):
    assert parametrized(katsura(n)).value.minimal.degree() == 2**n
    assert len(real_points(katsura(n)).value) == count


@pytest.mark.parametrize(
    ("equations", "expected"),
    [
        ([x**2 + y**2 + z**2], None),
        ([x**2 + 1, y, z], []),
        ([x**2, y - 1, z], [(0, 1, 0)]),
        ([(x - 1) ** 2, (x - 1) * (y - 2), (y - 2) ** 2, z], [(1, 2, 0)]),
        ([x * y, x**2 - x, y**2 - y, z - x], [(0, 0, 0), (0, 1, 0), (1, 0, 1)]),
        ([R.one], []),
        ([x**2 + y**2, x - y**3, z], [(0, 0, 0)]),
        ([(x - y) ** 2, y - 1, z * (x - 1), z**3], [(1, 1, 0)]),
        ([x * y - 1, x], None),
    ],
)
def test_small_systems(equations, expected):
    if equations == [x * y - 1, x]:
        assert real_points(equations).value == ()
    elif expected is None:
        with pytest.raises(NotZeroDimensional):
            real_points(equations)
    else:
        found = [tuple(p.rational(n) for n in R.names) for p in real_points(equations).value]
        assert found == [tuple(map(Fraction, e)) for e in expected]


def test_an_unused_variable_means_infinitely_many_points():
    with pytest.raises(NotZeroDimensional):
        real_points([x**2 - 2, y - x])
    with pytest.raises(NotZeroDimensional):
        real_points([R.zero])


def test_a_hundred_digits():
    big = 10**99 + 7
    (low, high) = real_points([x**2 - big, y - x, z]).value
    assert high.sign(x**2 - big) == 0
    assert high.sign(x * 10**60 - 316227766016837933199889354443271853372 * 10**71) in (-1, 1)
    assert low.sign(x) == -1


def test_constants_are_pinned_to_their_root():
    root2 = AlgebraicConstant("r", (-2, 0, 1), Fraction(1), Fraction(2))
    root3 = AlgebraicConstant("s", (-3, 0, 1), Fraction(1), Fraction(2))
    ring = Ring(("x", "r", "s"), constants=(root2, root3))
    t, r, s = ring.gens
    points = real_points([t**2 - (5 + 2 * r * s)]).value
    assert [p.sign(t - r - s) for p in points] == [-1, 0]
    assert [p.sign(t + r + s) for p in points] == [0, 1]
    assert real_points([t**2 + r]).value == ()


def stewart_gough(seed: int) -> list[Polynomial]:
    """Forward kinematics of a general platform, Study parameters, e0 = 1 (Husty, 1996); one pose is known."""
    rnd = random.Random(seed)
    ring = Ring(("e1", "e2", "e3", "g0", "g1", "g2", "g3"))
    e1, e2, e3, g0, g1, g2, g3 = ring.gens

    def rotation(a, b, c, d):
        return [
            [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
        ]

    n = 1 + e1 * e1 + e2 * e2 + e3 * e3
    turned = rotation(ring.one, e1, e2, e3)
    moved = [
        g1 - e1 * g0 - e3 * g2 + e2 * g3,
        g2 - e2 * g0 + e3 * g1 - e1 * g3,
        g3 - e3 * g0 - e2 * g1 + e1 * g2,
    ]
    back = [
        g1 - e1 * g0 + e3 * g2 - e2 * g3,
        g2 - e2 * g0 - e3 * g1 + e1 * g3,
        g3 - e3 * g0 + e2 * g1 - e1 * g2,
    ]
    pose = [Fraction(1), *(Fraction(rnd.randint(-3, 3), 4) for _ in range(3))]
    place = [rnd.randint(-3, 3), rnd.randint(-3, 3), rnd.randint(5, 9)]
    known, norm = rotation(*pose), sum(e * e for e in pose)
    equations = [g0 + e1 * g1 + e2 * g2 + e3 * g3]
    for _ in range(6):
        b = [rnd.randint(-9, 9) for _ in range(3)]
        p = [rnd.randint(-5, 5) for _ in range(3)]
        at = [sum(known[i][j] * p[j] for j in range(3)) / norm + place[i] for i in range(3)]
        square = sum((at[i] - b[i]) ** 2 for i in range(3))
        leg = n * (sum(c * c for c in (*b, *p)) - square) + 4 * (g0 * g0 + g1 * g1 + g2 * g2 + g3 * g3)
        leg += sum((back[i] * (4 * p[i]) - moved[i] * (4 * b[i]) for i in range(3)), start=ring.zero)
        leg -= sum((turned[i][j] * (2 * b[i] * p[j]) for i in range(3) for j in range(3)), start=ring.zero)
        equations.append(leg)
    return equations


@pytest.mark.engines
@pytest.mark.skipif(not msolve.available(), reason="msolve is not installed")
def test_stewart_gough_has_forty_poses():
    equations = stewart_gough(1)
    with engines.use():
        assert parametrized(equations).value.minimal.degree() == 40
        points = real_points(equations).value
    raw = msolve.parametrization(equations, equations[0].ring)
    assert raw is not None
    roots = [root for root, _ in fmpz_poly(list(raw.minimal)).complex_roots()]
    assert len(points) == sum(root.imag == 0 for root in roots) > 0
    assert all(p.sign(f) == 0 for p in points for f in equations[:2])


@pytest.mark.engines
@pytest.mark.skipif(not (msolve.available() and singular.available()), reason="needs msolve and Singular")
def test_points_that_were_checked_modulo_primes_only_are_not_proven(monkeypatch):
    equations = [x**2 + y**2 + z**2 - 3, x * y - z, x - y + z**2 - 1]
    monkeypatch.setattr(finite_sets, "_CAPS", (1, 1, 1))
    monkeypatch.setattr(finite_sets, "_EXACT_COST", 0)
    with engines.use():
        assert parametrized(equations).certainty == "proven"
        forget()
        monkeypatch.setattr(finite_sets, "_PROOF_COST", 0)
        assert parametrized(equations).certainty == "modular"


def test_hard_equations_over_easy_ones_agree_with_the_whole_basis(linkage):
    ring = linkage.ring
    easy = Ideal(ring, (*linkage.loops, linkage.determinant("ABC")))
    hard = [ring.gen("Gx") * 2 - ring.gen("By") - Fraction(1, 3)]
    algebra = quotient_algebra_over(easy, hard).value
    assert algebra is not None
    assert algebra.dimension == Ideal(ring, (*easy.generators, *hard)).vector_space_dimension.value


def test_easy_equations_without_a_common_zero(monkeypatch):
    """x = 0 and x = 1 are easy; that the third equation is not must not matter."""
    x, y = Ring(("x", "y")).gens
    known = finite_sets._capped_basis
    monkeypatch.setattr(
        finite_sets, "_capped_basis", lambda ring, fs: known(ring, fs) if y not in fs else None
    )
    forget()
    with engines.use("flint"):
        assert real_points((x, x - 1, y)).value == ()


def test_points_come_in_order_and_are_distinct():
    points = real_points([x**3 - 2 * x, y**2 - 3, z - x * y]).value
    assert len(points) == 6
    assert all(a.floats < b.floats for a, b in pairwise(points))
    assert not any(a.coincides(b) for a, b in pairwise(points))


def test_the_budget_ends_it():
    with pytest.raises(Undecided):
        real_points(katsura(5), Budget(0))


def test_reconstruction():
    modulus = 2**61 - 1
    numbers = [Fraction(355, 113), Fraction(-22, 7), Fraction(0)]
    residues = [n.numerator * pow(n.denominator, -1, modulus) % modulus for n in numbers]
    found = reconstruct(residues, modulus)
    assert found is not None
    assert [Fraction(n, found[1]) for n in found[0]] == numbers


def test_a_ring_without_variables_has_one_point():
    """A point: without equations, or with 0 = 0, it solves; with 1 = 0 it does not."""
    nowhere = Ring(())
    for equations in (Ideal(nowhere), Ideal(nowhere, [nowhere.zero]), [nowhere.zero]):
        (point,) = real_points(equations).value
        assert point.box == ()
        assert point.sign(nowhere.one) == 1
        assert point.sign(nowhere.zero) == 0
    assert real_points([nowhere.one]).value == ()


def test_no_equations_in_a_ring_with_variables_are_refused():
    for equations in (Ideal(R), [R.zero]):
        with pytest.raises(NotZeroDimensional, match="whole space"):
            real_points(equations)
