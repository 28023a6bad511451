"""Elimination against curves and surfaces whose equations are in the books."""

from __future__ import annotations

from singsym.effort.budget import Budget
from singsym.elimination.elimination_orders import eliminate, without_zeros_of
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Ring

R = Ring(("t", "x", "y", "z"))
t, x, y, z = R.gens


def test_the_twisted_cubic() -> None:
    """(t, t^2, t^3) has the ideal (y - x^2, z - x y) (Cox, Little, O'Shea, section 1.4)."""
    found = eliminate(R, (x - t, y - t**2, z - t**3), ("t",), Budget()).value
    assert Ideal(R, found).equals(Ideal(R, (y - x**2, z - x * y))).value


def test_the_cissoid() -> None:
    """x (1 + t^2) = 2 t^2, y (1 + t^2) = 2 t^3 is the cissoid y^2 (2 - x) = x^3."""
    known = eliminate(R, (x * (1 + t**2) - 2 * t**2, y * (1 + t**2) - 2 * t**3, z), ("t",), Budget())
    assert known.is_proven
    found = Ideal(R, known.value)
    assert found.radical_contains(y**2 * (2 - x) - x**3).value
    assert not found.radical_contains(x).value


def test_zeros_are_left_out_by_inverses() -> None:
    """x y = x: off x = 0 the rest is y = 1."""
    plane = Ring(("x", "y"))
    a, b = plane.gens
    ring, generators = without_zeros_of(plane, (a * b - a,), a)
    assert Ideal(ring, generators).contains(ring.gen("y") - 1).value
    assert not Ideal(plane, (a * b - a,)).contains(b - 1).value
