"""Links by length, sides and arc, as points and axes."""

from __future__ import annotations

from typing import Any

import pytest
import sympy

from singsym.mechanism.links import read_links
from singsym.mechanism.model import Link, Space
from singsym.mechanism.reader import Reader


def read(entry: Any, name: str = "AB", space: Space = Space.PLANAR) -> tuple[Link, list[str]]:
    reader = Reader()
    reader.space = space
    (link,) = read_links({name: entry}, reader)
    return link, [f"{p.place}: {p.expected}" for p in reader.problems]


def test_a_length_is_along_x() -> None:
    """The two points are read off the name: AB, A0B1."""
    assert read(3)[0].points == {"A": (0, 0), "B": (3, 0)}
    assert read("7/2", "A0B1")[0].points == {"A0": (0, 0), "B1": (sympy.Rational(7, 2), 0)}
    assert read(2, space=Space.SPATIAL)[0].points == {"A": (0, 0, 0), "B": (2, 0, 0)}


def test_three_sides_by_the_law_of_cosines() -> None:
    """3, 4, 5 has its right angle at B: C is above B, at (3, 4); below it where the triangle is mirrored."""
    sides = {"AB": 3, "BC": 4, "CA": 5}
    link, problems = read({"sides": sides}, "plate")
    assert link.points == {"A": (0, 0), "B": (3, 0), "C": (3, 4)}
    assert problems == []
    assert read({"sides": sides, "mirror": True}, "plate")[0].points["C"] == (3, -4)


def test_a_flat_triangle_is_one() -> None:
    """1 + 2 = 3: C is on the line beyond B."""
    assert read({"sides": {"AB": 1, "BC": 2, "CA": 3}}, "plate")[0].points["C"] == (3, 0)


@pytest.mark.parametrize(
    "sides",
    [
        {"AB": 1, "BC": 1, "CA": 3},
        {"AB": 3, "BC": 4},
        {"AB": 3, "BC": 4, "CD": 5},
        {"AB": 3, "BC": 4, "CA": -5},
        {"AB": 3, "BC": 4, "ABC": 5},
    ],
    ids=["too long a side", "two sides", "four points", "negative", "no side"],
)
def test_sides_that_are_no_triangle(sides: dict[str, int]) -> None:
    link, problems = read({"sides": sides}, "plate")
    assert link.points == {}
    assert problems


def test_an_arc_is_between_two_axes() -> None:
    """60 degrees from z towards x: (sqrt 3/2, 0, 1/2)."""
    link, problems = read("60 deg", space=Space.SPHERICAL)
    assert link.axes == {"A": (0, 0, 1), "B": (sympy.sqrt(3) / 2, 0, sympy.Rational(1, 2))}
    assert link.points == {"O": (0, 0, 0)}
    assert problems == []


def test_a_length_needs_two_points() -> None:
    """The name of the link does not say them; two points listed do."""
    assert read(3, "crank")[1]
    assert read({"length": 3, "points": ["P", "Q"]}, "crank")[0].points == {"P": (0, 0), "Q": (3, 0)}
    assert read({"length": 3, "sides": {}}, "AB")[1]
    assert read({}, "AB")[1]
