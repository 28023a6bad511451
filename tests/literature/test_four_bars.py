"""Rows 1-5 of the published results: four-bar linkages and the slider-crank, point by point."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import cos, isclose, sqrt

import pytest

from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType
from singsym.mechanism import JointRate, Mechanism, Twist, load

Occurring = Callable[[Mechanism], dict[str, int | None]]
Classified = Callable[[Mechanism], Classification]

STILL = "RI, IO"
DEAD = "RO, II"
SHAKY = "RI, RO, IIM"


def four_bar(g: str, a: str, b: str, c: str) -> Mechanism:
    return load("fourbar").with_parameters(g=g, a=a, b=b, c=c)


@pytest.mark.parametrize(
    ("lengths", "expected"),
    [
        (("4", "1", "7/2", "3"), {STILL: 4}),
        (("1", "3", "7/2", "4"), {}),
        (("4", "3", "1", "7/2"), {STILL: 4, DEAD: 4}),
        (("4", "3", "7/2", "1"), {DEAD: 4}),
        (("2", "2", "2", "5"), {STILL: 2, DEAD: 2}),
        (("5", "2", "2", "2"), {STILL: 2, DEAD: 2}),
    ],
)
def test_grashof_types(occurring: Occurring, lengths: tuple[str, ...], expected: dict[str, int]) -> None:
    """Row 1, Grashof (textbook): crank-rocker, drag link, double rocker, rocker-crank, two triple rockers."""
    assert occurring(four_bar(*lengths)) == expected


def test_the_output_choice_matters(classified: Classified) -> None:
    """Row 2: with the coupler's angle as output, crank and coupler in line is regular."""
    turned = replace(four_bar("4", "1", "7/2", "3"), outputs=(Twist("BC", "B", ("w",)),))
    result = classified(turned)
    assert not result.undecided
    found = {c.singularity_class.name: c for c in result.classes if c.verdict.is_yes}
    in_line = [w for c in found.values() for w in c.witnesses if abs(_abc(w.floats())) < 1e-9]
    assert in_line == []
    follower = classified(four_bar("4", "1", "7/2", "3"))[SingularityType.RI | SingularityType.IO]
    assert [abs(_abc(w.floats())) < 1e-9 for w in follower.witnesses] == [True] * 4


def _abc(q: dict[str, float]) -> float:
    return q["Bx"] * q["Cy"] - q["By"] * q["Cx"]


def test_parallelogram(occurring: Occurring) -> None:
    """Row 3: the two flat positions."""
    assert occurring(load("parallelogram")) == {SHAKY: 2}


def test_change_point(occurring: Occurring) -> None:
    """Row 4: lengths 4, 1, 2, 3 lie flat in one position."""
    assert occurring(load("change-point")) == {SHAKY: 1, STILL: 2}


def test_slider_crank_both_ways(occurring: Occurring, classified: Classified) -> None:
    """Row 5: two dead centres, at l + r and l - r from the crank's pin."""
    forward = load("slider-crank")
    backward = replace(forward, inputs=("P",), outputs=(JointRate("A"),))
    assert occurring(forward) == {STILL: 2}
    assert occurring(backward) == {DEAD: 2}
    witnesses = classified(forward)[SingularityType.RI | SingularityType.IO].witnesses
    assert sorted(w.floats()["d_P"] for w in witnesses) == [2, 4]


def test_crank_rocker_limits_by_the_law_of_cosines(classified: Classified) -> None:
    """Row 1: the follower's limits are where AC is b + a or b - a, at an angle known from triangle ADC."""
    result = classified(four_bar("4", "1", "7/2", "3"))
    found = result[SingularityType.RI | SingularityType.IO]
    reached = sorted(sqrt(q["Cx"] ** 2 + q["Cy"] ** 2) for q in (w.floats() for w in found.witnesses))
    assert all(isclose(x, y, abs_tol=1e-12) for x, y in zip(reached, [2.5, 2.5, 4.5, 4.5], strict=True))
    for w in found.witnesses:
        q = w.floats()
        reach = q["Cx"] ** 2 + q["Cy"] ** 2
        assert isclose(cos(float(w.joints["D"])), (16 + 9 - reach) / 24, abs_tol=1e-9) or "D" not in w.joints
