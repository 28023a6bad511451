"""Renamings that carry families of polynomials over to each other."""

from __future__ import annotations

from fractions import Fraction

from singsym.polynomials import Ring
from singsym.polynomials.renamings import Group, Likeness
from singsym.polynomials.ring import AlgebraicConstant

R = Ring(("x", "y", "z"))
X, Y, Z = R.gens
CYCLE = Group("loops", (X**2 * Y + Y**2 * Z + Z**2 * X,))


def test_only_turns_keep_a_cycle() -> None:
    """x^2 y + y^2 z + z^2 x has the three turns as symmetries; no exchange of two variables is one."""
    turned = Likeness(R).renaming([CYCLE, Group("off", (X - 1,))], [CYCLE, Group("off", (1 - Y,))])
    assert turned == {"x": "y", "y": "z", "z": "x"}
    exchanged = [[CYCLE, Group("off", (X - 1, Y - 2))], [CYCLE, Group("off", (Y - 1, X - 2))]]
    assert Likeness(R).renaming(*exchanged) is None


def test_labels_signs_and_constants_are_kept() -> None:
    """x > 0 is not y < 0, nor y > 1 where y = 0; x = r is not r = y for a constant r."""
    likeness = Likeness(R)
    above = [Group("positive", (p,), signed=True) for p in (X - 1, 1 - Y, Y - 1)]
    assert likeness.renaming(above[:1], above[1:2]) is None
    assert likeness.renaming(above[:1], above[2:]) == {"x": "y", "y": "x", "z": "z"}
    assert likeness.renaming([Group("zero", (X,))], [Group("off", (X,))]) is None
    root = AlgebraicConstant("r", (-2, 0, 1), Fraction(1), Fraction(2))
    ring = Ring(("r", "x"), constants=(root,))
    r, x = ring.gens
    assert Likeness(ring).renaming([Group("zero", (x - r**2,))], [Group("zero", (r - x**2,))]) is None
