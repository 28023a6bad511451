"""Joints of a file: which links they join, and how many joints one pin is."""

from __future__ import annotations

from typing import Any

import pytest
import sympy

from singsym.mechanism.joints import read_inputs, read_joints
from singsym.mechanism.model import Joint, JointKind, Link, Space
from singsym.mechanism.reader import Reader

ORIGIN = (sympy.Integer(0),) * 3
UP = (sympy.Integer(0), sympy.Integer(0), sympy.Integer(1))
LINKS = tuple(Link(name, {"A": ORIGIN}, {"A": UP, "u": UP}) for name in ("ground", "one", "two"))


def read(
    table: dict[str, Any], space: Space = Space.PLANAR, links: tuple[Link, ...] = LINKS
) -> tuple[tuple[Joint, ...], list[str]]:
    reader = Reader()
    reader.space = space
    joints = read_joints(table, links, reader)
    return joints, [p.place for p in reader.problems]


def test_a_pin_through_three_links_is_two_joints() -> None:
    """k links on one pin are k - 1 joints, in the order of the file."""
    joints, problems = read({"A": "R"})
    assert [(j.name, j.first, j.second) for j in joints] == [("A1", "ground", "one"), ("A2", "one", "two")]
    assert problems == []


def test_a_pin_through_two_links_keeps_its_name() -> None:
    joints, _ = read({"A": "R"}, links=LINKS[:2])
    assert [(j.name, j.kind, j.at, j.axes) for j in joints] == [("A", JointKind.R, ("A", "A"), None)]


def test_links_that_are_named_are_taken() -> None:
    joints, problems = read({"A": {"type": "P", "links": ["two", "ground"], "axis": ["u", "A"]}})
    assert [(j.first, j.second, j.axes) for j in joints] == [("two", "ground", ("u", "A"))]
    assert problems == []


@pytest.mark.parametrize(
    "table",
    [
        {"B": "R"},
        {"A": "X"},
        {"A": {"type": "R", "pitch": 2}},
        {"A": {"type": "P", "links": ["one"]}},
        {"A": {"type": "P", "links": ["one", "two"], "axis": ["u"]}},
    ],
    ids=["no link has it", "no such type", "a pitch of a pin", "one link", "an axis too few"],
)
def test_joints_that_do_not_fit_are_told(table: dict[str, Any]) -> None:
    assert read(table)[1]


def test_a_screw_needs_a_pitch() -> None:
    """A pitch of 2 is kept; without one that is told."""
    screw = {"type": "H", "pitch": 2}
    joints, problems = read({"A": screw}, Space.SPATIAL, LINKS[:2])
    assert joints[0].pitch == 2
    assert problems == []
    assert read({"A": "H"}, Space.SPATIAL, LINKS[:2])[1] == ["joints.A"]


def test_a_name_among_the_inputs_is_all_freedoms_of_the_joint() -> None:
    """A cylindrical joint has two, a pin one; a single freedom is named with the joint."""
    cylinder = Joint("C", JointKind.C, "ground", "one", ("A", "A"), ("A", "A"))
    pin = Joint("A", JointKind.R, "one", "two", ("A", "A"))
    assert read_inputs(["C", "A"], (cylinder, pin), Reader()) == (*cylinder.columns, "A")
    assert len(cylinder.columns) == 2
    assert read_inputs([cylinder.columns[1]], (cylinder, pin), Reader()) == cylinder.columns[1:]
