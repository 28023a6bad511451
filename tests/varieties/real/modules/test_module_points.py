"""Square systems solved module by module."""

from __future__ import annotations

from fractions import Fraction

import pytest

from singsym.effort.budget import Undecided
from singsym.polynomials import Ring
from singsym.polynomials.ring import AlgebraicConstant
from singsym.varieties.real.modules import module_points as by_modules
from singsym.varieties.real.modules.module_points import module_points
from singsym.varieties.real.modules.no_assembly import has_no_assembly
from singsym.varieties.real.points.finite_sets import real_points

R = Ring(("c", "s", "u", "v", "x", "y"))
C, S, U, V, X, Y = R.gens
LINKAGE = (
    C**2 + S**2 - 4,
    (U - C) ** 2 + (V - S) ** 2 - 16,
    (U - 4) ** 2 + (V - 1) ** 2 - 9,
    (X - U) ** 2 + (Y - V) ** 2 - 25,
    (X - 7) ** 2 + Y**2 - 9,
)
"""A crank of length 2 with two dyads."""


def test_the_same_as_exact_algebra() -> None:
    """Where crank and coupler are in line; once by modules, once by one Groebner basis of all."""
    system = (*LINKAGE, C * V - S * U)
    found = sorted(p.floats for p in module_points(system).value)
    exact = sorted(p.floats for p in real_points(system).value)
    assert len(found) == len(exact) > 0
    assert all(a == pytest.approx(b, abs=1e-9) for a, b in zip(found, exact, strict=True))


def test_an_equation_more_is_looked_at_in_each_point() -> None:
    """Where crank and coupler are in line, no crank is upright as well."""
    assert module_points((*LINKAGE, C * V - S * U, C)).value == ()


def test_points_with_a_multiplicity_are_not_decided() -> None:
    """The second dyad at its limit, where the first one is: a square of four bars of length 1, folded."""
    with pytest.raises(Undecided):
        module_points((X**2 - 2, (X * Y - 1) ** 2, U - Y, V - U, C - V, S - C))


def test_a_module_by_itself_is_asked_for_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """x = 3 has nothing to do with the bits of balls: where it is not solved, more of them are not tried."""
    asked = []

    def unsolved(*step: object) -> None:
        asked.append(step)
        raise Undecided("not in time")

    monkeypatch.setattr(by_modules, "_alone", unsolved)
    with pytest.raises(Undecided, match="not in time"):
        module_points((X**2 - 9, X * Y - 12, *LINKAGE[:3], C - S))
    assert len(asked) == 1


def test_two_equations_for_six_unknowns() -> None:
    with pytest.raises(Undecided, match="fewer equations"):
        module_points((X**2 - 2, Y - X))


def test_two_assemblies_that_are_one() -> None:
    """A crank of length 3 at x = 3, and a dyad to (10, 0) with bars of length 4 and 3: it is stretched there.

    The point is (7, 0); what vanishes there and is not among the equations solved is known to."""
    crank = (C - 3, S**2)
    (point,) = module_points(
        (C - 3, S, (U - C) ** 2 + (V - S) ** 2 - 16, (U - 10) ** 2 + V**2 - 9, X - U, Y - V)
    ).value
    assert point.floats == pytest.approx((3, 0, 7, 0, 7, 0))
    assert point.sign((U - 10) ** 2 + V**2 - 9) == 0
    with pytest.raises(Undecided):
        module_points((*crank, (U - C) ** 2 + (V - S) ** 2 - 16, (U - 10) ** 2 + V**2 - 9, X - U, Y - V))


def test_a_hard_module_is_solved_with_all_that_it_needs_and_before_what_needs_that() -> None:
    """y hangs on c alone, and is listed before the hard module (u, v) over c: the same as by algebra."""
    small = Ring(("c", "y", "u", "v"))
    c, y, u, v = small.gens
    system = (c**2 - 2, y - c - 1, u**3 + v - c, u * v + 1)
    found = sorted(p.floats for p in module_points(system).value)
    exact = sorted(p.floats for p in real_points(system).value)
    assert len(found) == len(exact) > 0
    assert all(a == pytest.approx(b, abs=1e-9) for a, b in zip(found, exact, strict=True))


def test_a_dyad_whose_discriminant_is_zero_everywhere() -> None:
    """Two parallel lines and a third one parallel to them: in (x, y) x - y = -c or 2 - c, and x - y = 1.

    With c = 1 the third is one of the two, and there are no finitely many points to give."""
    ring = Ring(("c", "x", "y"))
    c, x, y = ring.gens
    with pytest.raises(Undecided, match="turns freely"):
        module_points((c**2 - c, (x - y + c - 1) ** 2 - 1, (c + 1) * (x - y - 1)))


@pytest.mark.parametrize(("radius", "empty"), [(14, True), (13, False)])
def test_a_circle_that_no_crank_reaches(radius: int, empty: bool) -> None:
    """A crank of 3 at the origin with a rod of 7 reaches 10 + sqrt(10) = 13.16 from (3, -1) at most."""
    ring = Ring(("px", "py", "cx", "cy", "dx", "dy"))
    px, py, cx, cy, dx, dy = ring.gens
    curve = (
        px**2 + py**2 - 9,
        (px - cx) ** 2 + (py - cy) ** 2 - 49,
        cx - 2 * dx + 3,
        cy - 2 * dy - 1,
        4 * ((dx - 3) ** 2 + (dy + 1) ** 2) - radius**2,
    )
    assert has_no_assembly(curve).is_yes == empty


@pytest.mark.parametrize(("radius", "empty"), [(14, True), (13, False)])
def test_what_turns_freely_beside_is_left_aside(radius: int, empty: bool) -> None:
    """The same with a wheel that is in no other equation, and one of a radius of its own: r^2 = 3, r > 0."""
    root = AlgebraicConstant("r", (-3, 0, 1), Fraction(1), Fraction(2))
    ring = Ring(("u", "px", "py", "v", "cx", "cy", "r"), constants=(root,))
    u, px, py, v, cx, cy, r = ring.gens
    crank = px**2 + py**2 - 3 * r**2, (px - cx) ** 2 + (py - cy) ** 2 - 49
    wheel = u**2 + v**2 - r
    circle = (cx - 3) ** 2 + (cy + 1) ** 2 - radius**2
    assert has_no_assembly((*ring.relations, wheel, *crank, circle)).is_yes == empty


@pytest.mark.parametrize(("distance", "empty"), [(5, True), (3, False)])
def test_a_hard_module_does_not_hide_that_what_it_needs_has_no_assembly(distance: int, empty: bool) -> None:
    """Two circles of radius 2 meet up to a distance of 4; over them stand two equations of degree 20."""
    ring = Ring(("x", "y", "u", "v"))
    x, y, u, v = ring.gens
    circles = x**2 + y**2 - 4, (x - distance) ** 2 + y**2 - 4
    assert has_no_assembly((*circles, u**20 + v * x - 1, v**20 + u * y - 1)).is_yes == empty


def test_a_fixed_number_is_no_unknown() -> None:
    """c r = 0 and c (c - 1) r = 0 with r = sqrt(3): c = 0, whichever of them is matched with what."""
    root = AlgebraicConstant("r", (-3, 0, 1), Fraction(1), Fraction(2))
    ring = Ring(("c", "y", "r"), constants=(root,))
    c, y, r = ring.gens
    (point,) = module_points((c * r, c * (c - 1) * r, y - c - r, *ring.relations)).value
    assert point.floats == pytest.approx((0, 3**0.5, 3**0.5))
