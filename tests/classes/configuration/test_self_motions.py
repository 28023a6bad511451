"""Self-motions of configurations in which it is known by hand what moves."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from singsym.classes.configuration.self_motions import SelfMotion, self_motions
from singsym.mechanism import Choice, load
from singsym.output.motion.self_motion_page import self_motion_data, self_motion_page
from singsym.output.page import Grid

ARM = """
name = "arm"
title = "Planar arm with a joint too many"
source = "own"
inputs = ["A", "B", "C"]
output = {{ velocity = "D" }}
[links]
ground = {{ points = {{ A = [0, 0] }} }}
AB = {}
BC = 2
CD = 1
[joints]
A = "R"
B = "R"
C = "R"
"""


def of(name: str, given: dict[str, Any]) -> list[tuple[int | None, int | None]]:
    """Null motions and dimension, with the inputs and with the outputs at rest."""
    return [(m.null_motions, m.dimension) for m in self_motions(load(name), given)]


def arm(folder: Path, first: int, *degrees: int) -> SelfMotion:
    """The redundant arm's self-motion with its hand at rest."""
    file = folder / "arm.toml"
    file.write_text(ARM.format(first))
    given = {"joints": {j: f"{x} deg" for j, x in zip("ABC", degrees, strict=True)}}
    return self_motions(load(file, choice=Choice(redundant=True)), given)[1]


@pytest.mark.parametrize(
    ("first", "degrees", "null_motions", "dimension"),
    [(2, (30, 60, 0), 1, 1), (2, (30, 0, 0), 2, 0), (3, (0, 0, 180), 2, 1)],
    ids=["regular", "stretched", "a change point"],
)
def test_a_redundant_arm(
    tmp_path: Path, first: int, degrees: tuple[int, ...], null_motions: int, dimension: int
) -> None:
    """With its hand at rest the arm is a four-bar: a curve; stretched it cannot move at all.

    Links 3, 2, 1 with the last folded back: the hand is 4 away, 4 + 1 = 3 + 2, Grashof's change point, in
    whose flat configuration two branches of the four-bar's curve cross.
    """
    found = arm(tmp_path, first, *degrees)
    assert (found.null_motions, found.dimension, found.certainty) == (null_motions, dimension, "proven")


def test_five_bar_with_coincident_cranks() -> None:
    """B = D and equal rods: C turns about B while A and E rest; C rests with all, A, B, C not in line."""
    place = ["1/2", "sqrt(15)/2"]
    folded = {"points": {"B": place, "D": place, "C": ["7/2", "sqrt(15)/2"]}}
    assert of("five-bar", folded) == [(1, 1), (0, 0)]


def test_the_curve_of_a_self_motion_is_traced() -> None:
    """The same: a circle of C about B, 3 wide, once round."""
    place = ["1/2", "sqrt(15)/2"]
    folded = {"points": {"B": place, "D": place, "C": ["7/2", "sqrt(15)/2"]}}
    (found, still) = self_motions(load("five-bar"), folded)
    assert still.curve is None
    assert found.curve is not None
    assert found.curve.certainty == "certified"
    curve = found.curve.value
    assert curve.closed
    assert not curve.singular_points
    (line,) = curve.polylines
    rest, arm = line[:, [0, 1, 4, 5]], line[:, 2:4] - line[:, :2]
    assert np.allclose(rest, [0.5, 15**0.5 / 2] * 2, atol=1e-6)
    assert np.allclose(np.hypot(*arm.T), 3, atol=1e-6)
    turned = np.unwrap(np.arctan2(*arm.T[::-1]))
    assert abs(turned[-1] - turned[0]) == pytest.approx(2 * np.pi, abs=1e-6)
    blocks = self_motion_page((found, still))
    assert isinstance(blocks[1], Grid)
    assert "closed (certified)" in blocks[1].title
    assert "limits and exclusions are not looked at" in str(blocks[-1])
    data = self_motion_data((found, still))
    assert data[0]["curve"]["closed"]
    assert data[0]["curve"]["limits"] == "not looked at"


def test_why_a_curve_was_not_traced_is_said() -> None:
    """On the page and in JSON alike."""
    untraced = SelfMotion("inputs", 1, 1, "proven", untraced="too hard")
    assert "The curve with the inputs at rest is not proven: too hard." in self_motion_page((untraced,))
    assert self_motion_data((untraced,))[0]["untraced"] == "too hard"


def test_the_curve_crosses_itself_at_a_change_point(tmp_path: Path) -> None:
    """The arm of 3, 2, 1 with its hand 4 away: both circuits of the four-bar meet there, and only there."""
    found = arm(tmp_path, 3, 0, 0, 180)
    assert found.curve is not None
    assert found.curve.value.closed
    assert len(found.curve.value.singular_points) == 1
    assert len(found.curve.value.polylines) == 2


def test_null_motions_that_are_infinitesimal() -> None:
    """A dead point's slide rests to first order only, as do a flat parallelogram's crank and follower."""
    assert of("slider-crank", {"points": {"B": [1, 0], "C": [4, 0]}}) == [(0, 0), (1, 0)]
    flat = {"points": {"B": [1, 0], "C": [3, 0]}}
    assert of("parallelogram", flat) == [(1, 0), (1, 0)]


def test_values_in_decimals_are_undecided() -> None:
    """They do not close the loops exactly."""
    found = self_motions(load("slider-crank"), {"joints": {"A": 0.3}})
    assert [m.dimension for m in found] == [None, None]
    assert "exactly" in found[0].reason
