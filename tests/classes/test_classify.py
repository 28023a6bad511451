"""Classification end to end on small mechanisms: verdicts, proofs, witnesses, the traps of components."""

from __future__ import annotations

from dataclasses import replace

import pytest

from singsym.classes.classify import Limits, classify
from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType, feasible_classes
from singsym.elimination import engines
from singsym.elimination.ideal import Ideal
from singsym.mechanism import JointRate, load, loads
from singsym.output.plain_data import classification_data

T = SingularityType


@pytest.fixture(scope="module")
def crank_rocker() -> Classification:
    return classify(load("fourbar"), cache=False)


def test_all_21_classes_are_reported(crank_rocker: Classification) -> None:
    assert [c.singularity_class for c in crank_rocker.classes] == list(feasible_classes())
    assert all(c.verdict.is_yes or c.verdict.is_no for c in crank_rocker.classes)


def test_classes_that_the_mobility_forbids_say_so(crank_rocker: Classification) -> None:
    possible = set(feasible_classes(1))
    for c in crank_rocker.classes:
        assert ("impossible for n = 1" in c.verdict.reason) == (c.singularity_class not in possible)


def test_witnesses_are_full_configurations(crank_rocker: Classification) -> None:
    """Points and joint angles to 15 digits within the radius; lengths 4, 1, 7/2, 3 hold there."""
    found = crank_rocker[T.RI | T.IO]
    assert found.points == len(found.witnesses) == 4
    for w in found.witnesses:
        assert float(w.radius) < 1e-14
        at = {n: complex(float(w.points[f"{n}.x"]), float(w.points[f"{n}.y"])) for n in "ABCD"}
        lengths = [abs(at[p] - at[q]) for p, q in ("AB", "BC", "CD", "DA")]
        assert lengths == pytest.approx([1, 3.5, 3, 4], abs=1e-13)
        assert (at["C"] / at["B"]).imag == pytest.approx(0, abs=1e-13)
    written = classification_data(crank_rocker)["classes"][0]["witnesses"]
    assert written == [{**w.coordinates, **w.points, **w.joints, "radius": w.radius} for w in found.witnesses]


def test_empty_classes_have_a_reason(crank_rocker: Classification) -> None:
    dead = crank_rocker[T.RO | T.II]
    assert dead.verdict.is_no
    assert dead.verdict.reason


def test_no_mobility_means_smooth(crank_rocker: Classification) -> None:
    assert [s.smooth for s in crank_rocker.configuration_space] == ["yes"]


@pytest.mark.parametrize("name", ["parallelogram", "change-point"])
def test_modes_that_meet_make_a_space_singular(name: str) -> None:
    """Textbook: in the flat positions of a foldable four-bar linkage two of its motions meet."""
    result = classify(load(name), cache=False)
    assert {s.smooth for s in result.configuration_space} == {"no"}


def test_of_a_mode_by_itself_the_ranks_do_not_say_whether_it_is_smooth() -> None:
    result = classify(replace(load("parallelogram"), translating=("BC",)), cache=False)
    (space,) = result.configuration_space
    assert (space.smooth, space.remark) == ("undecided", "only where these links keep their orientation: BC")


def test_steps_of_the_procedure(crank_rocker: Classification) -> None:
    """Section 3.2: no IIM after step 1, no RPM after 2, (RI, IO) divided off in 6."""
    assert crank_rocker[T.RI | T.IO].steps == ("6",)
    assert crank_rocker[T.RI | T.RO | T.IIM].steps == ("1",)
    assert crank_rocker[T.RPM | T.II | T.IO].steps == ("2",)


def test_conditions_are_printed(crank_rocker: Classification) -> None:
    assert "x_{C}" in crank_rocker[T.RI | T.IO].conditions


def test_mirror_images_are_other_configurations(crank_rocker: Classification) -> None:
    found = {round(float(w.points["C.y"]), 9) for w in crank_rocker[T.RI | T.IO].witnesses}
    assert found == {-y for y in found}


def test_a_component_may_be_singular_everywhere() -> None:
    """Four equal sides: with B on D the crank stands still and the rest turns, a whole circle of (RO, II)."""
    result = classify(load("fourbar").with_parameters(g=1, a=1, b=1, c=1), cache=False)
    assert not result.undecided
    assert {c.types: c.dimension for c in result.classes if c.verdict.is_yes} == {
        T.RO | T.II: 1,
        T.RI | T.IO: 1,
        T.RI | T.RO | T.IIM: 0,
    }


def test_a_mode_in_which_a_link_translates() -> None:
    """With its coupler parallel to the ground a parallelogram never becomes an antiparallelogram.

    Then D C = A B as vectors; the frame of link CD points the other way, from C to D.
    """
    parallelogram = load("parallelogram")
    whole = classify(parallelogram, cache=False)
    mode = classify(replace(parallelogram, translating=("BC",)), cache=False)
    for result in (whole, mode):
        assert {c.singularity_class.name: c.points for c in result.classes if c.verdict.is_yes} == {
            "RI, RO, IIM": 2
        }
    space = mode.equation.space
    c, s, d_c, d_s = (space.ring.gen(n) for n in ("c_A", "s_A", "c_D", "s_D"))
    assert all(Ideal(space.ring, space.equations).contains(p).value for p in (c + d_c, s + d_s))


def test_the_output_at_the_input_is_never_transmission() -> None:
    """With the crank's own rate as output, a dead centre leaves the rest a passive motion: (RPM, II, IO)."""
    mechanism = load("fourbar").with_parameters(g=4, a=3, b=1, c="7/2")
    result = classify(replace(mechanism, outputs=(JointRate("A"),)), cache=False)
    assert {c.types: c.points for c in result.classes if c.verdict.is_yes} == {T.RPM | T.II | T.IO: 4}


@pytest.mark.parametrize("name", ["fourbar", "parallelogram", "change-point", "slider-crank"])
def test_flint_alone_comes_to_the_same(name: str) -> None:
    """The base installation has no other engine."""
    with engines.use("flint"):
        alone = classify(load(name), cache=False)
    both = classify(load(name), cache=False)
    facts = [
        [(c.types, c.verdict.answer, c.dimension, c.points) for c in result.classes]
        for result in (alone, both)
    ]
    assert facts[0] == facts[1]
    assert alone.engines == ("flint",)


def test_too_small_a_budget_leaves_doubts_and_no_false_answers() -> None:
    """With no time at all nothing is claimed beyond what needs none."""
    hurried = classify(load("zlatanov-2dof"), limits=Limits(seconds=1e-3), cache=False)
    assert hurried.undecided
    for c in hurried.classes:
        if c.verdict.is_undecided:
            assert c.verdict.reason
    rpm = hurried[T.RPM | T.II | T.IO]
    assert not rpm.verdict.is_no


def test_a_gantry_without_loops_or_turns() -> None:
    """Three slides at right angles: no equation, and the identity as its Jacobian, so nothing is singular."""
    gantry = """name = "gantry"
        space = "spatial"
        output = { twist = "link3", components = ["vx", "vy", "vz"] }
        [dh]
        convention = "standard"
        rows = [
            { joint = "P", alpha = -90, theta = -90 },
            { joint = "P", alpha = 90, theta = 90 },
            { joint = "P" },
        ]"""
    result = classify(loads(gantry), cache=False)
    assert all(c.verdict.is_no for c in result.classes)
    (space,) = result.configuration_space
    assert space.dimension == 3


def test_loci_of_4_are_as_large_as_the_strata_with_k_I_and_come_apart_before_they_are_counted() -> None:
    """Everywhere RI, IO, as C2 is on a circle; (4) holds on curves alone: no locus is examined by itself.

    C1, C2, G2: |C1 G2| = 6, C1 on two arcs by |C1 B| from 5 to 7; on the right one the two P are one at
    (10, 0), on the left one they stay 2: 3 curves.  |C1 G2| = 2 at C1 = (4, -2) alone, with 2 P: 5.
    C1, P, Q: |PQ| = 11 at C1 = A alone, with 2 C2; |PQ| = 1, a kite A, P, Q, B: P is B, |C1 G2| up to 6, or P
    moves from B, with |C1 G2| = 4 there, until |C1 G2| = 6 on the other side: one curve that crosses itself.
    """
    text = """name = "kite"
inputs = ["A", "B"]
output = { velocity = "C2" }
[links]
ground = { points = { A = [0, 0], B = [4, 3], G2 = [4, 0] } }
AP = 5
BQ = 1
PC1 = 5
C1Q = 6
C1C2 = 2
C2G2 = 4
[joints]
A = "R"
B = "R"
G2 = "R"
P = "R"
Q = "R"
C1 = "R"
C2 = "R"
"""
    stages = set()
    found = classify(loads(text), cache=False, progress=lambda event: stages.add(event.stage))
    assert [(locus.condition, locus.dimension) for locus in found.loci] == [("4", 1), ("4", 1)]
    counted = {locus.words: locus.components for locus in found.loci}
    assert counted == {"C1, C2, G2 collinear": 5, "C1, P, Q collinear": 3}
    assert "curves" in stages
    assert "loci" not in stages
