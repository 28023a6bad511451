"""Independent loops: how many, how long, and closed, whatever the order and the sense of joints."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.kinematics.loops import loops, path
from singsym.mechanism import load
from singsym.mechanism.model import Mechanism
from tests.kinematics.linkages import link, pin, planar


def names(mechanism: Mechanism) -> list[list[str]]:
    return [[joint.name for joint, _ in loop] for loop in loops(mechanism)]


@pytest.mark.parametrize(
    ("name", "lengths"),
    [("2r", []), ("fourbar", [4]), ("five-bar", [5]), ("zlatanov-2dof", [4, 5]), ("3rrr", [6, 6])],
)
def test_number_and_length_of_loops(name: str, lengths: list[int]) -> None:
    assert sorted(map(len, names(load(name)))) == lengths


def test_two_joints_between_the_same_links_are_a_loop() -> None:
    points = {"A": (0, 0), "B": (1, 0)}
    twice = planar(
        [link("ground", points), link("bar", points)],
        [pin("A", "ground", "bar"), pin("B", "ground", "bar")],
        ["A"],
    )
    (loop,) = loops(twice)
    assert [(joint.name, sign) for joint, sign in loop] == [("A", 1), ("B", -1)]


@given(st.permutations(range(8)), st.lists(st.booleans(), min_size=8, max_size=8))
@settings(max_examples=25, deadline=None)
def test_loops_close_and_are_independent(order: list[int], turned: list[bool]) -> None:
    """Walking a loop's joints by their signs comes back; every joint of the linkage is in a loop."""
    given_ = load("zlatanov-2dof")
    joints = []
    for i in order:
        joint = given_.joints[i]
        if turned[i]:
            joint = replace(joint, first=joint.second, second=joint.first, at=(joint.at[1], joint.at[0]))
        joints.append(joint)
    mechanism = replace(given_, joints=tuple(joints))
    found = loops(mechanism)
    assert sorted(len(loop) for loop in found) == [4, 5]
    assert {joint.name for loop in found for joint, _ in loop} == {joint.name for joint in joints}
    for loop in found:
        ends = Counter()
        for joint, sign in loop:
            ends[joint.second] += sign
            ends[joint.first] -= sign
        assert not any(ends.values())
        at = loop[0][0].first if loop[0][1] == 1 else loop[0][0].second
        start = at
        for joint, sign in loop:
            here, there = (joint.first, joint.second)[::sign]
            assert here == at
            at = there
        assert at == start


def test_the_way_to_a_link() -> None:
    mechanism = load("zlatanov-2dof")
    output = mechanism.outputs[0].link  # type: ignore[union-attr]
    at = mechanism.ground
    for joint, sign in path(mechanism, output):
        here, there = (joint.first, joint.second)[::sign]
        assert here == at
        at = there
    assert at == output
    assert path(mechanism, mechanism.ground) == ()
