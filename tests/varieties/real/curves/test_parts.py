"""Components of curves without some of their irreducible components, which are circles and lines."""

from __future__ import annotations

import pytest

from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.parts import components_outside
from singsym.varieties.real.curves.real_curve import real_curve

x, y = Ring(("x", "y")).gens


def circle(a: int, r: int) -> Polynomial:
    return (x - a) ** 2 + y**2 - r**2


@pytest.mark.parametrize(
    ("kept", "removed", "left"),
    [
        ((circle(0, 1),), (circle(5, 1),), 1),
        # the line through both circles joins them; without it they are two
        ((circle(0, 1), circle(5, 1)), (y,), 2),
        # crossing circles are one component, also without a third one
        ((circle(0, 2), circle(1, 2)), (circle(10, 1),), 1),
        # the line alone, crossed by what is taken out
        ((y,), (circle(0, 1), circle(5, 1)), 1),
    ],
)
def test_arcs_of_what_is_taken_out_join_nothing(
    kept: tuple[Polynomial, ...], removed: tuple[Polynomial, ...], left: int
) -> None:
    own, other = x.ring.one, x.ring.one
    for p in kept:
        own = own * p
    for p in removed:
        other = other * p
    assert components_outside(real_curve([own * other]), [[other]], [own]) == left
