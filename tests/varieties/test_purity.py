"""Sets with a large part that has no real point, and a smaller one beside it that has: none of it is lost.

A decomposition that is cut short leaves both in one piece; then the answer may be undecided, never another.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random

import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Known
from singsym.elimination import engines
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import forget
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.varieties import decomposition
from singsym.varieties.constructible import ConstructibleSet
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.irreducibility import Splitting
from singsym.varieties.purity import PurePiece
from singsym.varieties.real.dimension.real_dimension import real_dimension
from singsym.varieties.real.proofs.critical_points import component_samples, sample_points
from singsym.varieties.real.proofs.emptiness import is_empty_over_reals
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y", "z"))
x, y, z = R.gens


@pytest.fixture(params=["never", "at times", "flint", "all"], autouse=True)
def pace(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """How often proofs come to an end in time: never, at times (at random), or always, with some engines."""
    forget()
    if request.param in ("never", "at times"):
        rng = Random(f"{request.node.name}")

        def at_times(work: Callable[..., object], nothing: object) -> Callable[..., object]:
            fails = 1.0 if request.param == "never" else 0.5
            return lambda *given: nothing if rng.random() < fails else work(*given)

        for name, nothing in (
            ("analysed", Known(Splitting())),
            ("saturated", None),
            ("_by_engine", Known(())),
        ):
            monkeypatch.setattr(decomposition, name, at_times(getattr(decomposition, name), nothing))
    with engines.use(*([] if request.param == "all" else ["flint"])):
        yield request.param
    forget()


DONE = ("flint", "all")


def dimension_or_none(equations: Equations, seconds: float = 60) -> int | None:
    """The real dimension; None where it is undecided."""
    try:
        return real_dimension(RealSystem(equations[0].ring, equations), Budget(seconds)).value[0]
    except Undecided:
        return None


# -- unions that are known by construction ---------------------------------------------------------------


def union(ring: Ring, first: Equations, second: Equations, seed: int) -> Equations:
    """Generators of the product of two ideals, mixed: its zeros are those of either."""
    rng = Random(seed)
    mixed = [p * q for p in first for q in second]
    for _ in range(2):
        for i in range(len(mixed)):
            for j in range(len(mixed)):
                if i != j:
                    mixed[i] += mixed[j] * rng.choice((-2, -1, 1, 2))
    return tuple(mixed)


def imaginary(ring: Ring, rng: Random) -> Equations:
    """A part of codimension 2 without a real point: one of its equations is positive."""
    squares = sum((g**2 * rng.randint(1, 3) for g in ring.gens), start=ring.one * rng.randint(1, 4))
    quadric = ring.gens[0] * ring.gens[1] - ring.gens[-1] * rng.randint(1, 3) + ring.gens[0]
    return squares, quadric


@pytest.mark.parametrize("seed", range(4))
def test_a_real_point_beside_an_imaginary_curve(seed: int, pace: str) -> None:
    rng = Random(seed)
    place = tuple(g - rng.randint(-3, 3) for g in R.gens)
    equations = union(R, imaginary(R, rng), place, seed)
    verdict = is_empty_over_reals(RealSystem(R, equations), Budget(60), tries=0)
    there = ConstructibleSet.zeros(R, *equations).is_empty("real", Budget(60))
    dimension = dimension_or_none(equations)
    assert not verdict.is_yes
    assert not there.is_yes
    assert dimension in (0, None)
    if pace in DONE:
        assert verdict.is_no
        assert there.is_no
        assert dimension == 0
        (point,) = sample_points(R, equations, Budget(60)).value
        assert not any(map(point.sign, place))


@pytest.mark.parametrize("seed", range(3))
def test_a_real_line_beside_an_imaginary_surface(seed: int, pace: str) -> None:
    ring = Ring(("x", "y", "z", "w"))
    rng = Random(seed)
    line = tuple(g - ring.gens[-1] * rng.randint(-2, 2) for g in ring.gens[:3])
    equations = union(ring, imaginary(ring, rng), line, seed)
    verdict = is_empty_over_reals(RealSystem(ring, equations), Budget(60), tries=0)
    dimension = dimension_or_none(equations)
    assert not verdict.is_yes
    assert dimension in (1, None)
    if pace in DONE:
        assert verdict.is_no
        assert dimension == 1


@pytest.mark.parametrize("seed", range(3))
def test_an_imaginary_point_beside_an_imaginary_curve(seed: int, pace: str) -> None:
    rng = Random(seed)
    place = (x**2 + rng.randint(1, 5), y - x, z - rng.randint(-3, 3))
    equations = union(R, imaginary(R, rng), place, seed)
    verdict = is_empty_over_reals(RealSystem(R, equations), Budget(60))
    assert not verdict.is_no
    assert dimension_or_none(equations) in (-1, None)
    if pace in DONE:
        assert verdict.is_yes
        assert dimension_or_none(equations) == -1


# -- as many equations as unknowns, with an excess of solutions ------------------------------------------


def residual(rng: Random, ring: Ring, quadric: Polynomial) -> Equations:
    """f p_i + g q_i for i = 1, 2, 3 with f positive, g a quadric, and p_i, q_i linear forms in x, y, z."""
    first, variables = sum((v**2 for v in ring.gens), start=ring.one), ring.gens[:3]

    def form() -> Polynomial:
        return sum((v * rng.randint(-3, 3) for v in variables), start=ring.zero)

    return tuple(first * form() + quadric * form() for _ in range(3))


@pytest.mark.parametrize("seed", range(5))
def test_the_origin_beside_a_curve_of_excess(seed: int, pace: str) -> None:
    """All p_i and q_i vanish at the origin, which lies off the curve f = g = 0, where there is no real point.

    A real point elsewhere is on a ray on which the p_i are proportional to the q_i: these are finitely many
    for general forms, and f : g is given on each, so that there are finitely many points.
    """
    equations = residual(Random(seed), R, x * y - z + x)
    verdict = is_empty_over_reals(RealSystem(R, equations), Budget(60), tries=0)
    dimension = dimension_or_none(equations)
    assert not verdict.is_yes
    assert dimension in (0, None)
    if pace == "all":
        assert verdict.is_no
        assert dimension == 0


def test_the_rest_of_a_set_without_its_excess(pace: str) -> None:
    """Off f = g = 0 the complex points are finitely many as well: there (p, q) has rank 1 at most."""
    quadric = x * y - z + x
    excess = ConstructibleSet.zeros(R, x**2 + y**2 + z**2 + 1, quadric)
    whole = ConstructibleSet.zeros(R, *residual(Random(1), R, quadric))
    assert whole.dimension.value == 1
    assert (whole - excess).dimension.value == 0
    assert (whole - excess).closure().value.dimension.value == 0


def test_the_axis_beside_a_surface_of_excess(pace: str) -> None:
    """The w-axis, on which all p_i and q_i vanish, is real, so that the dimension is 1 at least.

    Where f > 0 the vectors p and q are dependent (f p + g q = 0), which for these forms holds on finitely
    many rays of (x, y, z) only; on each, f : g is given, a curve in the plane of the ray and w: so it is 1.
    """
    ring = Ring(("x", "y", "z", "w"))
    x, y, z, w = ring.gens
    f, g = x**2 + y**2 + z**2 + w**2 + 1, x * y - z + w
    p, q = (x + 2 * y - z, y - 3 * z, x + z - 2 * y), (x - y + 3 * z, 2 * x + z, y + z - x)
    minors = [p[i] * q[j] - p[j] * q[i] for i in range(3) for j in range(i)]
    assert Ideal(ring, minors).dimension.value == 2  # rays
    assert w
    equations = tuple(f * a + g * b for a, b in zip(p, q, strict=True))
    dimension = dimension_or_none(equations, 60 if pace == "all" else 10)
    assert dimension in (1, None)
    if pace == "all" and engines.has("singular"):
        assert dimension == 1
    assert not is_empty_over_reals(RealSystem(ring, equations), Budget(20), tries=0).is_yes


# -- the door --------------------------------------------------------------------------------------------


def test_a_doubtful_piece_is_refused() -> None:
    """The plane z = 0 and the z-axis as one piece of dimension 2."""
    doubtful = Component(Ideal(R, (x * z, y * z)), prime=False, dimension=2)
    with pytest.raises(Undecided, match="may hold smaller ones"):
        PurePiece.of(doubtful)
    with pytest.raises(Undecided, match="may hold smaller ones"):
        component_samples(doubtful)


def test_what_is_called_pure_is_so(pace: str) -> None:
    """Two planes of 4-space that meet in a point are no complete intersection, but all of one dimension.

    With a line beside them they are not; the equations are mixed, so that no factor shows.
    """
    ring = Ring(tuple("abcd"))
    a, b, c, d = ring.gens
    planes = union(ring, (a, b), (c - 1, d), 1)
    line = (a - b - 3, c - 2, d - 2)
    for equations, count in ((planes, 2), (union(ring, planes, line, 2), 3)):
        found = decompose(equations, ring=ring, budget=Budget(60)).value
        assert all(c.dimension == 2 or len(found) == count for c in found if c.is_pure)
        if pace in DONE:
            assert len(found) == count
            assert all(c.prime for c in found)
