"""Exact and boxed points: their balls, without which they are pickled and compared."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from fractions import Fraction

import pytest
from flint import fmpq

from singsym.polynomials import Ring
from singsym.varieties.real.points.boxed_point import boxed_point
from singsym.varieties.real.points.enclosed_point import EnclosedPoint
from singsym.varieties.real.points.finite_sets import real_points

R = Ring(("x", "y"))
x, y = R.gens


def exact() -> EnclosedPoint:
    """(sqrt 2, 1) as an exact point."""
    return real_points((x**2 - 2, y - 1)).value[1]


def boxed() -> EnclosedPoint:
    """The same in a box, y held at 1."""
    found = boxed_point(R, (x**2 - 2,), {"y": Fraction(1)}, (1.4, 1.0))
    assert found is not None
    return found


@pytest.mark.parametrize("make", [exact, boxed])
def test_balls_hold_the_coordinates(make: Callable[[], EnclosedPoint]) -> None:
    """x^2 - 2 and y - 1 are zero at the point, and x^2 - 2.0001 is not."""
    for bits in (64, 200):
        point = make().refine(bits)
        assert (point["x"] ** 2).contains(2)
        assert not (point["x"] ** 2).contains(fmpq(20001, 10000))
        assert point["y"].contains(1)
        assert float(point["x"].rad()) < 2.0 ** (1 - bits)
    with pytest.raises(KeyError, match="z"):
        make()["z"]


@pytest.mark.parametrize(
    ("make", "text"),
    [(exact, "RealPoint(x=1.41421, y=1.00000)"), (boxed, "BoxPoint(x=1.41421, y=1.00000)")],
)
def test_points_are_printed_with_their_kind(make: Callable[[], EnclosedPoint], text: str) -> None:
    assert repr(make()) == text


@pytest.mark.parametrize("make", [exact, boxed])
def test_points_are_pickled_without_their_balls(make: Callable[[], EnclosedPoint]) -> None:
    point = make()
    assert point.box
    assert "box" not in point.__getstate__()
    again = pickle.loads(pickle.dumps(point))
    assert again == point
    assert again.floats == point.floats
    assert all(a.overlaps(b) for a, b in zip(again.box, point.box, strict=True))
