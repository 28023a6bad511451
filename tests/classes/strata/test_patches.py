"""Quick splits: unit vectors that are parallel up to a turn, and products behind multiples of equations."""

from __future__ import annotations

from fractions import Fraction

import pytest

from singsym.classes.strata.patches import patches
from singsym.polynomials import AlgebraicConstant, Polynomial, Ring

ROOT = AlgebraicConstant("r", (-3, 0, 1), Fraction(1), Fraction(2))
R = Ring(("c1", "s1", "c2", "s2", "r"), constants=(ROOT,))
c1, s1, c2, s2, r = R.gens
CIRCLES = (c1**2 + s1**2 - 1, c2**2 + s2**2 - 1, r**2 - 3)


@pytest.mark.parametrize(
    ("equation", "turned"),
    [
        # sin(t1 - t2) = 0, sin(t1 + t2) = 0, cos(t1 - t2) = 0
        (s1 * c2 - c1 * s2, ((c2, s2), (-c2, -s2))),
        (s1 * c2 + c1 * s2, ((c2, -s2), (-c2, s2))),
        (c1 * c2 + s1 * s2, ((-s2, c2), (s2, -c2))),
        # 2 sin(t1 - t2 - 60 deg) = 0: t1 = t2 + 60 deg, or opposite
        (
            (s1 * c2 - c1 * s2) - r * (c1 * c2 + s1 * s2),
            (((c2 - r * s2) / 2, (s2 + r * c2) / 2), ((r * s2 - c2) / 2, (-s2 - r * c2) / 2)),
        ),
    ],
)
def test_parallel_up_to_a_turn(
    equation: Polynomial, turned: tuple[tuple[Polynomial, Polynomial], ...]
) -> None:
    found = patches((*CIRCLES, equation), (), R)
    expected = [{c1 - c, s1 - s, CIRCLES[1], CIRCLES[2]} for c, s in turned]
    assert len(found) == 2
    assert all(
        {g.primitive() for g in part.generators} in [{p.primitive() for p in e} for e in expected]
        for part in found
    )


def test_a_square_root_that_is_not_rational_is_left() -> None:
    """c1 c2 + 2 s1 c2 - 2 c1 s2 + s1 s2 turns by an angle whose cosine is 1/sqrt(5)."""
    equation = c1 * c2 + 2 * s1 * c2 - 2 * c1 * s2 + s1 * s2
    assert len(patches((*CIRCLES, equation), (), R)) == 1


def test_products_behind_multiples_of_other_equations() -> None:
    """(x y + z) w + x u with x y + z = 0 says x u = 0."""
    ring = Ring(("x", "y", "z", "u", "w"))
    x, y, z, u, w = ring.gens
    equations = (x * y + z**2, (x * y + z**2) * w + x * u)
    assert len(patches(equations, (), ring)) == 1
    found = patches(equations, (), ring, thorough=True)
    assert {part.generators for part in found} == {(x, z), (u, x * y + z**2)}
