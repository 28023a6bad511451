"""Links as bodies: which are plates, and their corners in order."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.output.figures.scene import Body

SQUARE = [(0, 0), (1, 1), (1, 0), (0, 1)]
"""Corners of a square, not in order."""


def body(*places: tuple[float, ...]) -> Body:
    points = {f"P{k}": np.array(place, dtype=float) for k, place in enumerate(places)}
    return Body("link", points, frozenset(points), ground=False, output=False)


@pytest.mark.parametrize(
    ("places", "is_plate"),
    [
        (SQUARE, True),
        ([(0, 0), (1, 0)], False),
        ([(0, 0), (1, 2), (2, 4)], False),
        ([(0, 0), (1, 0), (1, 1e-9)], False),
        ([(0, 0, 0), (1, 1, 1), (2, 2, 2)], False),
        ([(0, 0, 0), (1, 1, 1), (2, 2, 3)], True),
    ],
)
def test_plates_have_corners_off_a_line(places: list[tuple[float, ...]], is_plate: bool) -> None:
    assert body(*places).is_plate == is_plate


@pytest.mark.parametrize(
    "lift", [lambda x, y: (x, y), lambda x, y: (x, 2 * y, x - y)], ids=["plane", "space"]
)
def test_neighbours_of_an_outline_are_sides(lift: object) -> None:
    """Going around a square no step is a diagonal, in which both coordinates change."""
    corners = body(*(lift(x, y) for x, y in SQUARE)).outline  # type: ignore[operator]
    steps = np.abs(corners - np.roll(corners, 1, axis=0))
    assert ((steps[:, :2] > 0.5).sum(axis=1) == 1).all()


def test_a_bar_is_its_own_outline() -> None:
    assert body((2, 0), (0, 1)).outline.tolist() == [[2, 0], [0, 1]]
