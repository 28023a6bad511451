"""The numerical reference itself: configurations known by hand, and answers made wrong on purpose."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from singsym.classes.classify import classify
from singsym.classes.result import Classification, ClassResult
from singsym.effort.verdict import Verdict
from singsym.mechanism import load
from singsym.varieties.real.dimension.extent import Extent
from tests.laws.reference.compare import disagreements, placed, search
from tests.laws.reference.defects import defects
from tests.laws.reference.model import model

CASES = Path(__file__).parents[1] / "cases"
STILL, DEAD, FLAT = frozenset({"RI", "IO"}), frozenset({"RO", "II"}), frozenset({"RI", "RO", "IIM"})


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        # the tool on the first axis, with the arm folded: the first joint moves nothing
        ("at-2r-folded", (0, 0, 0, 1)),
        # rod 2 along the axis of its arm, at right angles to what the arm can do
        ("delta-guided", (0, 0, 0, 1)),
        # two legs of length zero, each turning about two axes for nothing: p = k_O = 4; with the legs locked
        # these four turns and the self-motion of an architecture singularity
        ("architecture-singular-6sps", (0, 4, 5, 4)),
    ],
)
def test_defects_at_configurations(name: str, expected: tuple[int, int, int, int]) -> None:
    own = model(load(CASES / f"{name}.toml"))
    given = tomllib.loads((CASES / f"{name}.config.toml").read_text(encoding="utf-8"))["points"]
    points = {p: np.array([*map(float, x), *[0.0] * (3 - len(x))]) for p, x in given.items()}
    poses = placed(own, points, {}, np.random.default_rng(0))
    assert poses is not None
    assert defects(own, poses) == expected


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        # crank and coupler in line, stretched or folded, and mirrored; the follower goes to and fro
        ("fourbar", {STILL: 4}),
        # both cranks rock: each stands still twice, and mirrored
        ("double-rocker", {STILL: 4, DEAD: 4}),
        # equal opposite sides lie flat in two ways
        ("parallelogram", {FLAT: 2}),
        # 4 + 1 = 2 + 3 lies flat in one way; the crank of length 1 is in line with its coupler elsewhere too
        ("change-point", {STILL: 2, FLAT: 1}),
    ],
)
def test_all_points_are_found(name: str, expected: dict[frozenset[str], int]) -> None:
    seen = search(model(load(name)), np.random.default_rng(1), 60)
    assert {kinds: len(known.marks) for kinds, known in seen.items() if kinds} == expected
    assert seen[frozenset()].dimension == 1


@pytest.mark.slow
def test_a_torus_of_folded_legs_is_walked_in_three_directions() -> None:
    """See `tests/cases`: three legs (1, 1) with the platform on the base turn freely."""
    seen = search(model(load(CASES / "3rrr-congruent.toml")), np.random.default_rng(1), 24)
    assert seen[STILL].dimension == seen[frozenset()].dimension == 3


@pytest.fixture(scope="module")
def double_rocker() -> Classification:
    return classify(load("double-rocker"), cache=False)


def spoilt(result: Classification, change: ClassResult) -> Classification:
    classes = tuple(change if c.types == change.types else c for c in result.classes)
    return replace(result, classes=classes)


def test_a_right_answer_is_not_contradicted(double_rocker: Classification) -> None:
    assert not disagreements(double_rocker, 1, 40)


def test_wrong_answers_are_contradicted(double_rocker: Classification) -> None:
    """An occurring class called empty, a point lost, a class of the other's points, a point too many."""
    first, second = (c for c in double_rocker.classes if c.verdict.is_yes)
    whole = first.pieces
    lost = tuple(replace(p, witnesses=p.witnesses[1:]) for p in whole)
    wrong = {
        "empty": replace(first, verdict=Verdict.no()),
        "found besides": replace(first, pieces=lost, points=sum(len(p.witnesses) for p in lost)),
        "the witness": replace(first, pieces=second.pieces),
        "5 points": replace(first, points=5),
    }
    for words, change in wrong.items():
        found = disagreements(spoilt(double_rocker, change), 1, 40)
        assert any(words in fault for fault in found), words


def test_a_dimension_too_small_is_contradicted() -> None:
    """Four equal sides: with B on D a circle of configurations is of class 2."""
    rhombus = classify(load("fourbar").with_parameters(g=1, a=1, b=1, c=1), cache=False)
    dead = next(c for c in rhombus.classes if frozenset(c.types.names) == DEAD)
    assert dead.dimension == 1
    found = disagreements(spoilt(rhombus, replace(dead, extent=Extent(0, 0))), 1, 40)
    assert any("walked in 1 direction" in fault for fault in found)
