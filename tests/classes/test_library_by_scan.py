"""Linkages of the library with one input: as many configurations of each class as a scan of the crank finds.

The scans have the dimensions from the drawings, not from the files; what they do not find must not occur.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pytest

from singsym.classes.taxonomy.types import SingularityType as T
from singsym.mechanism import load
from tests.classes.crank_scan import (
    SIDES,
    STEPS,
    Branch,
    Complex,
    carried,
    counts,
    crank,
    dyad,
    fixed,
    found_by_singsym,
    occurring,
    slider,
    turns,
)

ALONG, DOWN = 1 + 0j, -1j
Closed = Iterator[tuple[Complex, Complex, np.ndarray]]


def four_bar(radius: float, pivot: complex, coupler: float, rocker: float) -> Closed:
    """The pins B, C of a four-bar with its crank about the origin, in both ways of assembly."""
    b = crank(radius)
    for side in SIDES:
        c, there = dyad(b, fixed(pivot), coupler, rocker, side)
        yield b, c, there


def rods(ends: list[tuple[Complex, np.ndarray]], rod: float, start: complex, way: complex) -> list[Branch]:
    """Rams on a line, each driven by a rod from one of the ends."""
    found = []
    for end, there in ends:
        for side in SIDES:
            place, own = slider(end, rod, start, way, side)
            found.append((place, own & there))
    return found


def angle(arm: Complex) -> np.ndarray:
    """The angle of an arm, without jumps."""
    return np.unwrap(np.angle(arm))


def chebyshev_lambda() -> dict[T, int]:
    return counts([((2 * c - b).real, there) for b, c, there in four_bar(1, 2, 2.5, 2.5)])


def klann_leg() -> dict[T, int]:
    branches = []
    for m, c, there in four_bar(2.5, -6 - 2j, 6, 3.2):
        d = carried(m, c, 0, 6, 10 + 2j)
        for side in SIDES:
            e, own = dyad(d, fixed(-5 + 4j), 5, 7, side)
            branches.append((carried(d, e, 0, 4 - 3j, 1 - 8j).real, own & there))
    return counts(branches)


def toggle_press() -> dict[T, int]:
    return counts(rods([(c, there) for _, c, there in four_bar(1, 4 + 3j, 4, 3)], 3.5, 4, DOWN))


def drawing_press() -> dict[T, int]:
    ends = [(carried(b, c, 0, 5, 3 + 3j), there) for b, c, there in four_bar(2, 6, 5, 4)]
    return counts(rods(ends, 6, 8, DOWN))


def drag_link_press() -> dict[T, int]:
    ends = [(1 - (c - 1) / 2, there) for _, c, there in four_bar(3, 1, 3.5, 4)]
    return counts(rods(ends, 6, 0, ALONG))


def atkinson_engine() -> dict[T, int]:
    ends = [(2 * c - b, there) for b, c, there in four_bar(1, -2j, 3.5, 4)]
    return counts(rods(ends, 7, 2j, ALONG))


def shaper() -> dict[T, int]:
    lever = crank(1) + 3j
    return counts(rods([(6 * lever / abs(lever) - 3j, np.ones(STEPS, dtype=bool))], 4, 4j, ALONG))


def watt_one_six_bar() -> dict[T, int]:
    branches = []
    for b, c, there in four_bar(2, 6, 5, 4):
        e, f = carried(b, c, 0, 5, 3 + 2j), carried(fixed(6), c, 0, 4, 2 + 3j)
        for side in SIDES:
            g, own = dyad(e, f, 4, 3, side)
            branches.append((g.imag, own & there))
    return counts(branches)


def stephenson_one_six_bar() -> dict[T, int]:
    branches = []
    for b, c, there in four_bar(2, 6, 5, 4):
        e, f = b / 2 * (1 + 2j), carried(fixed(6), c, 0, 4, 2 + 2j)
        for side in SIDES:
            g, own = dyad(e, f, 5, 4, side)
            branches.append((g.imag, own & there))
    return counts(branches)


def stephenson_two_six_bar() -> dict[T, int]:
    """Round the angle of the rod BC as the crank sees it: the four-bar B, C, F, E, then the triangle A, G, D.

    The output rests where D's angle turns back, the input stops where the crank's does.
    """
    c, rests, stops = 3 + crank(4), 0, 0
    for side in SIDES:
        f, there = dyad(c, fixed(1 + 2j), abs(3 + 1j), 5, side)
        g = carried(c, f, 0, 3 + 1j, 2 - 2j)
        for other in SIDES:
            seen, own = dyad(fixed(0), fixed(7), abs(g), 3, other)
            rests += turns(angle(seen - 7), own & there)
            stops += turns(angle(seen / g), own & there)
    return occurring(rests, stops)


def rockers() -> Closed:
    """The pins H, K of the eight-bar in all its ways of assembly."""
    for b, c, first in four_bar(1, 4, 3, 3):
        e = carried(b, c, 0, 3, 2 + 2j)
        for one in SIDES:
            f, second = dyad(e, fixed(7 + 3j), 4.5, 2.5, one)
            h = carried(fixed(7 + 3j), f, 0, 2.5, 1 + 2j)
            for two in SIDES:
                k, third = dyad(h, fixed(9 + 1j), 3, 3, two)
                yield h, k, first & second & third


def eight_bar() -> dict[T, int]:
    return counts([(angle(k - 9 - 1j), there) for _, k, there in rockers()])


def ten_bar() -> dict[T, int]:
    ends = [(carried(fixed(9 + 1j), k, 0, 3, 1 - 2j), there) for _, k, there in rockers()]
    return counts(rods(ends, 6, -3j, ALONG))


SCANS = [
    chebyshev_lambda,
    klann_leg,
    toggle_press,
    drawing_press,
    drag_link_press,
    atkinson_engine,
    shaper,
    watt_one_six_bar,
    stephenson_one_six_bar,
    # a triad, one module of four unknowns
    pytest.param(stephenson_two_six_bar, marks=pytest.mark.engines),
    eight_bar,
    ten_bar,
]


@pytest.mark.parametrize("scan", SCANS, ids=lambda scan: str(scan.__name__))
def test_the_scan_finds_the_same(scan: Callable[[], dict[T, int]]) -> None:
    assert found_by_singsym(load(scan.__name__.replace("_", "-"))) == scan()
