"""Constructible sets: the laws of set algebra, checked by points and by verdicts, and known images."""

import pickle
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.effort.budget import Budget
from singsym.effort.verdict import Answer
from singsym.elimination import engines
from singsym.elimination.ideal import Ideal
from singsym.polynomials import AlgebraicConstant, Polynomial, Ring
from singsym.varieties.cells import Cell
from singsym.varieties.constructible import ConstructibleSet

R = Ring(("x", "y"))
x, y = R.gens
GRID = [{"x": a, "y": b} for a, b in product((-1, 0, 1, 2), repeat=2)]
SHAPES = (x, y, x - 1, y - x, x * y - 1, x**2 + y**2 - 1, y - x**2, x * (x - y), x**2 + 1)


def zeros(*polynomials: Polynomial) -> ConstructibleSet:
    return ConstructibleSet.zeros(R, *polynomials)


groups = st.lists(st.sampled_from(SHAPES), min_size=1, max_size=2, unique=True).map(tuple)
cells = st.builds(
    lambda inside, outside: Cell(Ideal(R, inside), tuple(outside)), groups, st.lists(groups, max_size=2)
)
sets = st.lists(cells, min_size=1, max_size=2).map(lambda cs: ConstructibleSet(R, tuple(cs)))


# -- laws ----------------------------------------------------------------------------------------------


@settings(max_examples=60, deadline=None)
@given(sets, sets, st.sampled_from(GRID))
def test_operations_point_by_point(a: ConstructibleSet, b: ConstructibleSet, p: dict[str, int]) -> None:
    assert (a | b).contains(p) == (a.contains(p) or b.contains(p))
    assert (a & b).contains(p) == (a.contains(p) and b.contains(p))
    assert (a - b).contains(p) == (a.contains(p) and not b.contains(p))


@settings(max_examples=20, deadline=None)
@given(sets, sets)
def test_difference_and_intersection_make_the_whole(a: ConstructibleSet, b: ConstructibleSet) -> None:
    assert ((a - b) | (a & b)).equals(a).is_yes
    assert ((a - b) & b).is_empty().is_yes
    assert (a & b).is_subset(a).is_yes
    assert a.is_subset(a | b).is_yes


@settings(max_examples=15, deadline=None)
@given(sets, sets, sets)
def test_de_morgan(a: ConstructibleSet, b: ConstructibleSet, c: ConstructibleSet) -> None:
    assert (a - (b | c)).equals((a - b) & (a - c)).is_yes
    assert (a - (b & c)).equals((a - b) | (a - c)).is_yes


@settings(max_examples=20, deadline=None)
@given(sets, sets)
def test_closure_and_dimension(a: ConstructibleSet, b: ConstructibleSet) -> None:
    closed = a.closure().value
    assert a.is_subset(closed).is_yes
    assert closed.closure().value.equals(closed).is_yes
    assert closed.dimension.value == a.dimension.value
    assert (a | b).dimension.value == max(a.dimension.value, b.dimension.value)
    assert (a.dimension.value == -1) == a.is_empty().is_yes
    # a constructible set is dense and open in its closure up to a smaller set
    assert a.is_empty().is_yes or (closed - a).dimension.value < a.dimension.value


@settings(max_examples=20, deadline=None)
@given(sets, st.sampled_from(GRID))
def test_projection_contains_the_points_below(a: ConstructibleSet, p: dict[str, int]) -> None:
    shadow = a.project(["x"])
    if a.contains(p):
        assert shadow.image.contains(p)
    if shadow.exact.is_yes:
        fibre = a & zeros(x - p["x"])
        assert shadow.image.contains(p) == fibre.is_empty().is_no


# -- single cases --------------------------------------------------------------------------------------


def test_written_and_equal_sets_differ() -> None:
    assert zeros(x) == zeros(x)
    assert zeros(x) != zeros(x**2)
    assert zeros(x).equals(zeros(x**2)).is_yes
    assert zeros(x).equals(zeros(x * y)).is_no


def test_union_of_closures_is_not_the_closed_set() -> None:
    axis = zeros(y) - zeros(x)
    assert axis.closure().value.equals(zeros(y)).is_yes
    assert axis.equals(zeros(y)).is_no
    assert (zeros(y) - axis).equals(zeros(x, y)).is_yes


def test_a_curve_covered_by_two_exclusions() -> None:
    cross = zeros(x * y)
    assert (cross - zeros(x) - zeros(y)).is_empty().is_yes
    (verdict,) = {(cross - zeros(x) - zeros(x, y)).is_empty().answer}
    assert verdict is Answer.NO


def test_no_truth_value_and_no_length() -> None:
    with pytest.raises(TypeError, match="is_empty"):
        bool(zeros(x))
    with pytest.raises(TypeError):
        len(zeros(x))  # type: ignore[arg-type]


def test_different_rings_raise() -> None:
    other = ConstructibleSet.zeros(Ring(("x", "z")))
    for operation in ("union", "intersection", "difference", "is_subset", "equals"):
        with pytest.raises(ValueError, match="ring"):
            getattr(zeros(x), operation)(other)
    with pytest.raises(ValueError, match="ring"):
        ConstructibleSet(R, other.cells)


def test_real_and_complex_emptiness() -> None:
    assert zeros(x**2 + y**2 + 1).is_empty().is_no
    assert zeros(x**2 + y**2 + 1).is_empty("real").is_yes
    origin = zeros(x**2 + y**2)
    assert origin.is_subset(zeros(x, y)).is_no
    assert origin.is_subset(zeros(x, y), "real").is_yes


def test_inequalities() -> None:
    right = ConstructibleSet.where(R, positive=[x])
    circle = zeros(x**2 + y**2 - 1)
    assert (circle & right).is_empty().is_undecided
    assert (circle & right).is_empty("real").is_no
    assert (circle & ConstructibleSet.where(R, positive=[x - 2])).is_empty("real").is_yes
    left = ConstructibleSet.where(R) - right
    assert left.contains({"x": 0, "y": 0})
    assert not left.contains({"x": Fraction(1, 9), "y": 0})
    assert (left & right).is_empty("real").is_yes
    (point,) = (circle & right).sample(seed=1)
    assert point.sign(x) == 1
    assert point.sign(x**2 + y**2 - 1) == 0


def test_undecided_cells_stay_marked() -> None:
    made = ConstructibleSet.zeros(R, x**3 * y - 3 * x + y**2 - 7, x**2 * y**2 - 11 * y - x + 5)
    kept = made.tidy(Budget(0))
    assert kept == made
    assert kept.cells[0].undecided
    assert "undecided" in repr(kept)
    assert made.is_empty(budget=Budget(0)).is_undecided


def test_projections() -> None:
    hyperbola = zeros(x * y - 1).project(["x"])
    assert hyperbola.exact.is_yes
    line = hyperbola.image.ring
    assert hyperbola.image.equals(ConstructibleSet.nonzeros(line, line.gen("x"))).is_yes
    # the plane (u, u v): everything but the points (0, b), b not 0
    space = Ring(("u", "v", "a", "b"))
    u, v, a, b = space.gens
    blown = ConstructibleSet.zeros(space, a - u, b - u * v).project(["a", "b"])
    plane = blown.image.ring
    pa, pb = plane.gens
    expected = ConstructibleSet.nonzeros(plane, pa) | ConstructibleSet.zeros(plane, pa, pb)
    assert blown.exact.is_yes
    assert blown.image.equals(expected).is_yes
    limited = (zeros(x * y - 1) & ConstructibleSet.where(R, positive=[y])).project(["x"])
    assert limited.exact.is_no
    with pytest.raises(KeyError):
        zeros(x).project(["w"])


def test_constants_hold_their_relations() -> None:
    sqrt2 = AlgebraicConstant("r", (-2, 0, 1), Fraction(1), Fraction(2))
    ring = Ring(("x", "r"), constants=(sqrt2,))
    unknown, r = ring.gens
    solutions = ConstructibleSet.zeros(ring, unknown**2 - 2)
    roots = ConstructibleSet.zeros(ring, unknown - r) | ConstructibleSet.zeros(ring, unknown + r)
    assert solutions.equals(roots).is_yes
    assert ConstructibleSet.zeros(ring, r).is_empty().is_yes
    assert ConstructibleSet.zeros(ring).dimension.value == 1


def test_display_and_pickling() -> None:
    shape = zeros(x * y) - zeros(x)
    assert repr(shape) == "{x*y = 0} \\ {x = 0}"
    assert shape._repr_latex_() == r"$V\left(x y\right) \setminus V\left(x\right)$"
    assert ConstructibleSet(R)._repr_latex_() == r"$\emptyset$"
    assert repr(ConstructibleSet(R)) == "{}"
    assert pickle.loads(pickle.dumps(shape)) == shape
    assert len({shape, zeros(x * y) - zeros(x)}) == 1


@pytest.mark.engines
def test_emptiness_modulo_primes_is_not_called_proven() -> None:
    """Five general equations in four unknowns have no solution; msolve alone says so modulo a prime only."""
    ring = Ring(("x", "y", "z", "t"))
    x, y, z, t = ring.gens
    first = (x**3 * y - z**2 + 7 * t, y**3 + x * z * t - 5, z**3 - x * y + t**2 - 1)
    second = (t**3 * x - y * z + 11, x**2 + y**2 + z**2 - 3 * t * x - 2)
    nothing = ConstructibleSet.zeros(ring, *first, *second)
    with engines.use("msolve"):
        verdict = nothing.is_empty()
        kept = nothing.tidy()
    assert verdict.is_yes
    assert verdict.certainty == "modular"
    assert [cell.undecided for cell in kept.cells] == ["it is empty modulo random primes"]
