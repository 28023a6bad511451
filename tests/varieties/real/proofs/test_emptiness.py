"""Emptiness and dimension over the reals: textbook sets with known answers."""

from fractions import Fraction

import pytest

from singsym.effort.budget import Budget
from singsym.effort.verdict import Answer
from singsym.elimination import engines
from singsym.elimination.memo import forget
from singsym.polynomials import AlgebraicConstant, Ring
from singsym.polynomials.sums_of_squares import sum_of_squares
from singsym.varieties.real.dimension.real_dimension import real_dimension
from singsym.varieties.real.proofs.critical_points import sample_points
from singsym.varieties.real.proofs.emptiness import is_empty_over_reals
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y", "z"))
x, y, z = R.gens
MOTZKIN = x**4 * y**2 + x**2 * y**4 + 1 - 3 * x**2 * y**2
ACNODE = y**2 - x**3 + x**2


@pytest.fixture(params=["flint", "all"], autouse=True)
def engine(request):
    forget()
    with engines.use(*(["flint"] if request.param == "flint" else [])):
        yield request.param


SYSTEMS = {
    "sphere": (RealSystem(R, (x**2 + y**2 + z**2 - 1,)), "no"),
    "point": (RealSystem(R, (x**2 + y**2 + z**2,)), "no"),
    "point left out": (RealSystem(R, (x**2 + y**2 + z**2,), exclusions=((x, y, z),)), "yes"),
    "complex only": (RealSystem(R, (x**2 + y**2 + 1,)), "yes"),
    "no sum of squares": (RealSystem(R, (MOTZKIN + 1 + z**2,)), "yes"),
    "Motzkin's zeros": (RealSystem(R, (MOTZKIN,)), "no"),
    "quartic": (RealSystem(R, (x**4 + y**4 + z**4 - 3 * x * y * z + 5,)), "yes"),
    "isolated point": (RealSystem(R, (ACNODE, z), positive=(1 - x,)), "no"),
    "isolated point left out": (RealSystem(R, (ACNODE, z), ((x, y),), positive=(1 - x,)), "yes"),
    "double line": (RealSystem(R, ((x - y) ** 2,)), "no"),
    "double line left out": (RealSystem(R, ((x - y) ** 2,), exclusions=((x - y,),)), "yes"),
    "unit ideal": (RealSystem(R, (x, x - 1)), "yes"),
    "zero ideal": (RealSystem(R, ()), "no"),
    "hyperbola": (RealSystem(R, (x * y - 1,), positive=(x, -y)), "yes"),
    "arc": (RealSystem(R, (x**2 + y**2 - 1,), positive=(x - y - 1, -x + Fraction(1, 2))), "no"),
    "beyond": (RealSystem(R, (x**2 + y**2 - 1,), positive=(x + y - 2,)), "yes"),
    "touching": (RealSystem(R, (x**2 + y**2 - 1,), nonnegative=(x - 1,)), "no"),
    "contradiction": (RealSystem(R, (), positive=(x - 3, 3 - x)), "yes"),
}


@pytest.mark.parametrize(("system", "empty"), SYSTEMS.values(), ids=list(SYSTEMS))
def test_verdicts(system, empty):
    verdict = is_empty_over_reals(system, Budget(60))
    assert verdict.answer == Answer(empty), verdict
    if verdict.is_no:
        assert all(verdict.witness.sign(f) == 0 for f in system.equations)
        assert system.admits(verdict.witness.point)


def test_constants_are_pinned():
    ring = Ring(("x", "s"), constants=(AlgebraicConstant("s", (-3, 0, 1), Fraction(1), Fraction(2)),))
    t, s = ring.gens
    assert is_empty_over_reals(RealSystem(ring, (t**2 + s,))).is_yes
    assert is_empty_over_reals(RealSystem(ring, (t**2 - s,))).is_no


def test_out_of_budget_is_undecided():
    assert is_empty_over_reals(RealSystem(R, (MOTZKIN + 1 + z**2,)), Budget(0)).is_undecided


DIMENSIONS = {
    "sphere": (RealSystem(R, (x**2 + y**2 + z**2 - 1,)), 2),
    "Whitney": (RealSystem(R, (x**2 - y**2 * z,)), 2),
    "line": (RealSystem(R, (x**2 + y**2,)), 1),
    "acnode line": (RealSystem(R, (ACNODE,), positive=(Fraction(1, 2) - x,)), 1),
    "tangent": (RealSystem(R, (x**2 + y**2 - 1,), nonnegative=(x - 1,)), 1),
    "points": (RealSystem(R, (x**2 - 2, y, z)), 0),
    "nothing": (RealSystem(R, (x**2 + 1,)), -1),
    "space": (RealSystem(R, (), positive=(x,)), 3),
    "plane and line": (RealSystem(R, (x * z, y * z), exclusions=((z,),)), 1),
    "plane and line, off a set": (RealSystem(R, (x * z, y * z), exclusions=((z, x * z),)), 1),
    # (z + 3 y)^2 + 9 x^2 = 0 on the circle
    "two points of a curve": (RealSystem(R, (x**2 + y**2 - 1, z**2 + 6 * y * z + 9)), 0),
}


@pytest.mark.parametrize(("system", "dimension"), DIMENSIONS.values(), ids=list(DIMENSIONS))
def test_dimensions(system, dimension):
    found, witness = real_dimension(system, Budget(60)).value
    assert found == dimension
    assert (witness is None) == (dimension < 0)


@pytest.mark.slow
def test_the_stick_of_the_whitney_umbrella():
    assert real_dimension(RealSystem(R, (x**2 - y**2 * z,), positive=(-z,)), Budget(120)).value[0] == 1


def test_every_circle_has_a_sample():
    circles = [(x - 4 * k) ** 2 + y**2 - 1 for k in range(3)]
    points = sample_points(R, [circles[0] * circles[1] * circles[2], z]).value
    for f in circles:
        assert any(p.sign(f) == 0 for p in points)


def test_a_joint_out_of_reach(linkage):
    # B stays on the unit circle around A, so that x_B > 2 never holds, whatever the rest does
    ring = linkage.ring
    system = RealSystem(ring, (*linkage.loops, linkage.determinant("BCD")), positive=(ring.gen("Bx") - 2,))
    assert is_empty_over_reals(system, Budget(60)).is_yes


@pytest.mark.slow
@pytest.mark.parametrize("triple", ["BCD", "CGF", "ABC", "CDG", "EFG"])
def test_samples_on_the_curves_of_the_linkage(linkage, triple):
    equations = [*linkage.loops, linkage.determinant(triple)]
    points = sample_points(linkage.ring, equations, Budget(120)).value
    assert points
    assert all(p.sign(f) == 0 for p in points for f in equations)


def test_sums_of_squares():
    assert sum_of_squares((x - y) ** 2 + (y - 2 * z) ** 2) is not None
    assert sum_of_squares(-(x**2) - 3) is not None
    assert sum_of_squares(x * y) is None
    assert sum_of_squares(x**2 - 2 * x) is None
    assert sum_of_squares(MOTZKIN) is None


def test_a_sum_of_squares_modulo_a_circle() -> None:
    """d^2 + 6 s d + 9 = (d + 3 s)^2 + 9 c^2 on the circle: c = 0 is all that is real."""
    c, s, d = Ring(("c", "s", "d")).gens
    hinge = (c**2 + s**2 - 1, d**2 + 6 * s * d + 9)
    budget = Budget(20)
    assert is_empty_over_reals(RealSystem(c.ring, hinge, exclusions=((c,),)), budget).is_yes
    assert is_empty_over_reals(RealSystem(c.ring, hinge, exclusions=((s,),)), budget).is_no
