"""Mechanisms on which the classification was wrong or silent, with what is right and why.

Each expected value is derived in the test's docstring, from the geometry of the mechanism and the definitions
of section 2.2 of Zlatanov, Fenton, Benhabib (1998); none of them comes from the program.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from singsym.classes.classify import Limits, classify
from singsym.classes.configuration.at import at
from singsym.classes.result import Classification, Locus
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.conditions.conditions import conditions
from singsym.kinematics.reduction import reduce
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Mechanism, load
from singsym.mechanism.urdf import from_urdf

CASES = Path(__file__).parent
STILL, DEAD = T.RI | T.IO, T.RO | T.II
FLAT = T.RI | T.RO | T.IIM
"""Classes 1, 2 and 8."""


def case(name: str) -> Mechanism:
    return load(CASES / f"{name}.toml")


@cache
def classified(name: str) -> Classification:
    return classify(case(name), cache=False)


def occurring(result: Classification) -> dict[T, int | None]:
    """The dimension of each class that occurs; nothing may be undecided."""
    assert not result.undecided
    return {c.types: c.dimension for c in result.classes if c.verdict.is_yes}


def space_dimensions(result: Classification) -> set[int | None]:
    return {piece.dimension for piece in result.configuration_space}


def of_condition(result: Classification, label: str) -> list[Locus]:
    return [locus for locus in result.loci if locus.condition == label]


def witnesses_agree(result: Classification, holds: Callable[[dict[str, float]], bool]) -> None:
    """Every witness of the classification lies where it should."""
    for c in result.classes:
        for w in c.witnesses:
            assert holds({k: float(v) for k, v in {**w.coordinates, **w.points}.items()})


# -- local dimensions are not the whole ---------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("name", ["3rrr-congruent", "spherical-3rrr-60"])
def test_legs_that_are_folded_at_once_turn_freely(name: str) -> None:
    """Legs (1, 1), or arcs (60, 60), and a platform that fits the base: class 1 has dimension 3.

    With the platform on the base, C_i = A_i, each leg is folded and turns about A_i by itself, and the
    platform rests: a torus of dimension 3. There L_I is regular: with the inputs locked every B_i is fixed,
    and the platform, held by three bars B_i C_i in general directions, cannot move. So k_I = delta = p = 0
    and k_O = 3: (RI, IO). No set is larger, for the space has dimension 3 and is regular where no leg is
    straight. All three legs are folded there, so each leg's own locus of (5) has dimension 3 too.
    """
    result = classified(name)
    assert result[STILL].dimension == 3
    assert [locus.dimension for locus in of_condition(result, "5")] == [3, 3, 3]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["delta-guided", "delta-guided-rational"])
def test_three_legs_alike_have_loci_alike(name: str) -> None:
    """A Delta whose platform is guided: arms and rods of length 1, C_i on A_i where the platform is at 0.

    There each arm A_i B_i turns freely about its axis, with its rod folded back on it, and the platform
    rests: a torus of dimension 3 in class 1, on which the factors of all three legs vanish. A turn of 120
    degrees (for the rational directions a reflection) exchanges legs, so their loci are alike in any case.
    """
    result = classified(name)
    loci = of_condition(result, "5")
    assert [locus.dimension for locus in loci if not locus.verdict.is_no] == [3, 3, 3]
    assert result[STILL].dimension == 3


@pytest.mark.slow
def test_a_configuration_with_one_leg_singular_is_in_a_piece_of_class_1() -> None:
    """M = a + t2 with the arm a = sin(0.3) e2 + cos(0.3) z: rod 2, M - a = t2, is along the axis of its arm.

    The arm moves B2 at right angles to a and t2, so at right angles to its rod: a velocity of input 2 does
    not move the platform, (RI). The rods of the two other legs are not at right angles to their arms'
    motions.
    """
    mechanism = case("delta-guided")
    given = tomllib.loads((CASES / "delta-guided.config.toml").read_text(encoding="utf-8"))
    point = {name: float(value) for name, value in at(mechanism, given).values.items()}
    result = classified("delta-guided")
    ring = result.equation.space.ring
    values = [point[name] for name in ring.names]
    assert any(all(abs(p.evaluate(values)) < 1e-6 for p in piece.basis) for piece in result[STILL].pieces)


# -- parts that are lost -------------------------------------------------------------------------------


@pytest.mark.slow
def test_an_architecture_singular_platform() -> None:
    """Griffis and Duffy's platform: the feet of the legs are projective images of each other.

    Then the six legs' lines always belong to one linear complex (Husty and Karger, 2000): with the legs
    locked the platform moves, in every configuration, so that (4) holds everywhere, k_I >= 1 = 42 - 41, and
    (RI, IO) alone occurs nowhere. Where B1 is on A1 the leg has length zero and its direction is free: such
    loci of (5) are not empty; one configuration is the platform put down with B1 = A1, B4 = A4.
    """
    mechanism = case("architecture-singular-6sps")
    equation = velocity_equation(mechanism)
    assert conditions(equation, reduce(equation))["4"].everywhere
    result = classify(mechanism, cache=False, limits=Limits(seconds=3, total=6))
    assert not result[STILL].verdict.is_yes
    assert not all(c.verdict.is_no for c in result.classes)
    assert not any(locus.verdict.is_no for locus in of_condition(result, "5"))


def test_an_exclusion_leaves_two_points_to_be_counted() -> None:
    """A kite A = (0, 0), D = (2, 0), sides 2, 2, 1, 1, with B = D taken out.

    (RO, II) is where B, C, D are in line: |BD| is 0, which is out, or 2. Then A, B, D is an equilateral
    triangle: B = (1, +-sqrt 3) with C in the middle of BD. (RI, IO) is where A, B, C are in line: |AC| is 3
    or 1, so C is on the x-axis, and B = (2, 0) = D, which is out. So is the flat configuration.
    """
    result = classified("kite-exclusion")
    assert occurring(result) == {DEAD: 0}
    dead = result[DEAD]
    assert dead.points == 2
    found = sorted([float(w.points[k]) for k in ("B.x", "B.y", "C.x", "C.y")] for w in dead.witnesses)
    root = math.sqrt(3)
    expected = [[1, -root, 1.5, -root / 2], [1, root, 1.5, root / 2]]
    assert [x for row in found for x in row] == pytest.approx([x for row in expected for x in row])


def test_a_stretched_knee_on_its_limit() -> None:
    """Two bones of length 1 whose knee bends from 0 to 2.5: it is straight at its limit 0, and singular.

    The tool's distance from the hip is stationary where j3 = 0, whatever j1 and j2: dimension 2. The other
    locus is the tool above or below the hip, cos j2 + cos(j2 + j3) = 0, of dimension 2.
    """
    result = classify(from_urdf(CASES / "knee.urdf"), cache=False)
    assert occurring(result) == {STILL: 2}
    assert [(locus.verdict.is_yes, locus.dimension) for locus in of_condition(result, "5")] == [(True, 2)] * 2


# -- the configuration space ---------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["point-space", "point-space-lever", "point-space-spherical"])
def test_a_linkage_stretched_as_far_as_it_goes_is_one_point(name: str) -> None:
    """6 = 1 + 2 + 3; 90 = 30 + 30 + 30 degrees; |DB| >= 2 = |DA| + |AB|: one configuration.

    Its screws lie in one line (plane), so their rank is 2 and not 3: delta = 1. A and D (P and D) turn each
    by itself to the first order, so input and output are redundant, no velocity of theirs is impossible, and
    none is left with both at rest: (RI, RO, IIM). The space is that point.
    """
    result = classified(name)
    assert occurring(result) == {FLAT: 0}
    assert result[FLAT].points == 1
    assert space_dimensions(result) == {0}


def test_four_right_arcs() -> None:
    """A spherical linkage with all arcs 90 degrees, A = x, D = y: B is normal to A, C to D and to B.

    B = (0, b, b') and C = (c, 0, c') with b' c' = 0: B = +-D with C anywhere on its circle, or C = +-A with B
    anywhere. In the first two circles axes B and D turn and A and C rest: the output A rests, (RI, IO); in
    the other two A and C turn, and the input B rests: (RO, II). Where they meet, in 4 points, both motions
    are possible: (RI, RO, IIM).
    """
    result = classified("all-right-spherical")
    assert occurring(result) == {STILL: 1, DEAD: 1, FLAT: 0}
    assert result[FLAT].points == 4
    assert (result[STILL].components, result[DEAD].components) == (2, 2)
    assert space_dimensions(result) == {1}


def test_three_parallel_cranks() -> None:
    """Unit cranks at 0, 1, 2 with their tips at 0, 1, 2 of a coupler, whose rate is the output.

    The middle tip is the mean of the outer ones, and a unit vector is the mean of two unit vectors only where
    these are equal: the coupler translates in a circle, and its rate is always 0: (RI, IO). Where the cranks
    are along the ground, in 2 points, all tips move at right angles to it, and the coupler may turn: rank 4
    instead of 5 of the loops, and (RI, RO, IIM).
    """
    result = classified("three-crank-coupler-rate")
    assert occurring(result) == {STILL: 1, FLAT: 0}
    assert result[FLAT].points == 2
    assert result[STILL].components == 1
    assert space_dimensions(result) == {1}


def test_two_rods_stretched_between_two_guides() -> None:
    """Rods BC = CD = 1 between guides at distance 2: always stretched, B, C, D = (p, 0), (p, 1), (p, 2).

    With rates a, b of the sliders and w, w' of the rods, C's velocity is (a - w, 0) and D's (a - w - w', 0) =
    (b, 0): three freedoms for n = 2. C's vertical velocity is impossible (IO). With the sliders locked C
    moves (RO), with C at rest both sliders do (RI), each at any velocity, and nothing is left with all at
    rest.
    """
    result = classified("prrrp-stretched-space")
    assert occurring(result) == {T.RI | T.RO | T.IO | T.IIM: 1}
    assert space_dimensions(result) == {1}
    witnesses_agree(result, lambda at: abs(at["B.x"] - at["C.x"]) + abs(at["C.x"] - at["D.x"]) < 1e-9)


def test_a_scissor_lift_has_a_part_of_dimension_2() -> None:
    """Legs AMD and BMC, M their middle: B = (2 cos, 0) for the angle of leg AMD, or B = A.

    In the first case the top is level and one angle tells all: dimension 1. In the second C = D, both legs
    lie on one another and turn as one, and the top turns freely about C: dimension 2.
    """
    result = classified("scissor")
    assert space_dimensions(result) == {1, 2}
    assert max(c.dimension or 0 for c in result.classes if c.verdict.is_yes) == 2


def test_a_leg_of_length_zero_turns_freely() -> None:
    """A platform on a vertical guide at height z and one leg from A to B, which is z above A.

    Where z is not 0 the leg is vertical: dimension 1. At z = 0 it has length 0 and any direction: dimension
    2, and of the classes too, for guide and leg still move on in two more ways.
    """
    result = classified("sps1")
    assert space_dimensions(result) == {1, 2}
    assert max(c.dimension or 0 for c in result.classes if c.verdict.is_yes) == 2


def test_whether_a_space_is_smooth_may_depend_on_a_value() -> None:
    """A four-bar linkage 2, 1, b, 1, which lies flat for b = 2 with B and C on the same side.

    With b among the coordinates the set is smooth: the gradients of |AB|, |CD| and |BC| - b are independent,
    the last by its part for b. For b = 2 it is a parallelogram, whose modes meet where it lies flat.
    """
    mechanism = case("symbolic-smooth")
    result = classify(mechanism, cache=False)
    assert [(s.dimension, s.smooth) for s in result.configuration_space] == [(2, "yes")]
    fixed = classify(mechanism.with_parameters(b=2), cache=False)
    assert {s.smooth for s in fixed.configuration_space} == {"no"}


# -- numbers that were left open --------------------------------------------------------------------------


def test_two_circles_on_which_both_rods_turn_alike() -> None:
    """Rods BC = CD = 1 between guides along x and y; outputs are C's rate and its vertical velocity.

    With both outputs at rest both rods turn at one rate w, not 0, and C's vertical velocity is w (C.x - B.x):
    so C is above or below B, C = (p, +-1), and |CD| = 1 is p^2 + (s -+ 1)^2 = 1: two circles of (RI, IO).
    """
    still = classified("prrrp-joint-rate")[STILL]
    assert still.verdict.is_yes
    assert (still.dimension, still.components) == (1, 2)
    for w in still.witnesses:
        assert float(w.points["C.x"]) == pytest.approx(float(w.points["B.x"]), abs=1e-9)


@pytest.mark.slow
def test_a_six_bar_linkage_with_square_roots() -> None:
    """Stephenson's linkage with lengths such as sqrt 2 and sqrt 7: 4 and 6 dead centres, and no other class.

    By the numerical reference of `tests/laws`, from 60 starts for each condition; a scan of the crank angle
    gives the same.
    """
    result = classified("stephenson-square-roots")
    assert occurring(result) == {STILL: 0, DEAD: 0}
    assert (result[STILL].points, result[DEAD].points) == (4, 6)


# -- arms and over-constrained chains --------------------------------------------------------------------


def test_a_planar_arm_stretched_and_folded() -> None:
    """Two links of length 1: (RI, IO) where they are in line, whatever the first angle: two circles."""
    result = classified("at-2r-folded")
    assert occurring(result) == {STILL: 1}
    assert result[STILL].components == 2


def test_an_elbow_arm() -> None:
    """det J = -sin q3 (cos q2 + cos(q2 + q3)): elbow straight or folded, tool over the shoulder."""
    result = classified("at-elbow-shoulder")
    assert occurring(result) == {STILL: 2}
    assert [locus.dimension for locus in of_condition(result, "5")] == [2, 2]


def test_a_goldberg_linkage_has_no_singularity() -> None:
    """Five joints and mobility 1: two Bennett linkages with a link in common, without their common joint.

    Of a Bennett linkage the half-angles of opposite joints are equal and those of neighbours satisfy tan tan'
    = constant (Bennett 1914), so that J1 and J2 turn with rates that never vanish.
    """
    result = classified("goldberg-5r")
    assert occurring(result) == {}
    assert space_dimensions(result) == {1}
