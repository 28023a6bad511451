"""Sets that come apart because a few of their equations do."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import pytest

from singsym.effort import patience
from singsym.polynomials import Equations, Ring
from singsym.polynomials.ring import AlgebraicConstant
from singsym.varieties.disjoint_parts import disjoint_parts

RING = Ring(("x", "y", "u", "v", "w"))
X, Y, U, V, W = RING.gens
IN_LINE = (X - 3) * (V + 1) - (Y + 1) * (U - 3)
"""(x, y), (u, v) and (3, -1) are in line."""


@pytest.fixture(autouse=True)
def without_hurry() -> Iterator[None]:
    """What is found is tested here, not how soon."""
    with patience.scaled(20.0):
        yield


def dyad(to_point: int, to_ground: int) -> Equations:
    """(u, v) at distances from (x, y) and from (3, -1)."""
    return (U - X) ** 2 + (V - Y) ** 2 - to_point**2, (U - 3) ** 2 + (V + 1) ** 2 - to_ground**2


def holding(parts: tuple[Equations, ...], point: tuple[float, ...]) -> list[int]:
    exact = [Fraction(c) for c in point]
    return [i for i, part in enumerate(parts) if all(p.evaluate(exact) == 0 for p in part)]


@pytest.mark.parametrize("lengths", [(7, 5), (7, 7), (10, 5)])
def test_a_dyad_in_line_is_stretched_or_folded(lengths: tuple[int, int]) -> None:
    """Along the direction (3, 4)/5 from the ground: at the sum and at the difference of the lengths.

    With equal lengths the folded one has (x, y) on the ground point, and turns freely.
    """
    a, b = lengths
    parts = disjoint_parts((*dyad(a, b), IN_LINE, W - X))
    assert len(parts) == 2

    def at(x_far: int, side: int = 1) -> tuple[float, ...]:
        point = (Fraction(3 * x_far, 5) + 3, Fraction(4 * x_far, 5) - 1)
        tip = (Fraction(3 * side * b, 5) + 3, Fraction(4 * side * b, 5) - 1)
        return (*point, *tip, point[0])

    stretched, folded = holding(parts, at(a + b)), holding(parts, at(b - a))
    assert len(stretched) == len(folded) == 1
    assert stretched != folded
    assert holding(parts, (0, 0, 0, 0, 0)) == []
    if a == b:
        assert holding(parts, at(0, -1)) == folded


def test_parts_that_meet_are_left_together() -> None:
    """x = 0 and y = 0 meet, where z = x: neither is a part of its own."""
    equations = (X * Y, U - X, U + X - 2 * X * (Y + 1), W - 1)
    assert disjoint_parts(equations) == (equations,)


def test_too_many_variables() -> None:
    """Three equations of all variables are left to other ways."""
    ring = Ring(tuple("abcdefgh"))
    a, b, c, d, e, f, g, h = ring.gens
    equations = (a * b - c * d + e * f - g, a - b, a**2 - 1, h)
    assert disjoint_parts(equations) == (equations,)


def test_fixed_numbers_keep_what_is_known_of_them() -> None:
    """u = r v or u = -r v with r = sqrt(3), off zero as u v = 3 r or -3 r: each is a part with r in it.

    A part that would say more of r than its minimal polynomial does is no part.
    """
    root = AlgebraicConstant("r", (-3, 0, 1), Fraction(1), Fraction(2))
    ring = Ring(("u", "v", "w", "r"), constants=(root,))
    u, v, w, r = ring.gens
    equations = ((u - r * v) * (u + r * v), u**2 - 9, u**2 - 3 * v**2, w - u, *ring.relations)
    for part in disjoint_parts(equations):
        assert set(ring.relations) <= set(part)
        assert all(p in ring.relations for p in part if p.variables == ("r",))


def test_a_dyad_in_line_between_two_cranks_comes_apart() -> None:
    """(u, v) in line with the ends of two cranks, 4 from the one and 7 from the other: |P - Q| is 3 or 11."""
    ring = Ring(("px", "py", "qx", "qy", "u", "v"))
    px, py, qx, qy, u, v = ring.gens
    cranks = px**2 + py**2 - 1, (qx - 1) ** 2 + qy**2 - 25
    legs = (u - px) ** 2 + (v - py) ** 2 - 16, (u - qx) ** 2 + (v - qy) ** 2 - 49
    in_line = (qx - px) * (v - py) - (qy - py) * (u - px)
    parts = disjoint_parts((*cranks, *legs, in_line))
    assert len(parts) == 2
    for end in (
        Fraction(7, 4),
        Fraction(-3, 4),
    ):  # of |PQ| / 4 from P to (u, v): 7 from Q beyond it, or before
        direction = 3 * u - 7 * px + 4 * qx if end > 1 else 11 * u - 7 * px - 4 * qx
        assert sum(direction.primitive() in {p.primitive() for p in part} for part in parts) == 1


def test_a_leg_as_long_as_its_crank_comes_apart_in_its_shorter_form() -> None:
    """|P| = |P C| = 4 with |P|^2 taken from |P C|^2, |Q C| = 5: C = (5 P + 4 Q) / 9 or 5 P - 4 Q."""
    ring = Ring(("px", "py", "qx", "qy", "u", "v"))
    px, py, qx, qy, u, v = ring.gens
    cranks = px**2 + py**2 - 16, (qx - 3) ** 2 + (qy - 2) ** 2 - 25
    legs = 2 * px * u + 2 * py * v - u**2 - v**2, (u - qx) ** 2 + (v - qy) ** 2 - 25
    in_line = (qx - px) * (v - py) - (qy - py) * (u - px)
    first, second = disjoint_parts((*cranks, *legs, in_line))
    found = [{p.primitive() for p in part if p.total_degree == 1} for part in (first, second)]
    expected = [9 * u - 5 * px - 4 * qx, 9 * v - 5 * py - 4 * qy], [u - 5 * px + 4 * qx, v - 5 * py + 4 * qy]
    assert {*map(frozenset, found)} == {frozenset(p.primitive() for p in pair) for pair in expected}
    assert all(len(part) == 5 for part in (first, second))
