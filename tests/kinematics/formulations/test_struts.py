"""Which links are rods and struts between two spherical joints, and which are not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import sympy

from singsym.kinematics.formulations.local import Geometry
from singsym.kinematics.formulations.natural import place
from singsym.kinematics.formulations.struts import Strut, find_struts, length_symbol
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.mechanism.model import Exclusion, Limit, Mechanism

RSSR = load("rssr")
PLATFORM = load("stewart-gough-planar")
LEG = PLATFORM.joint("P1")


def struts(mechanism: Mechanism) -> dict[tuple[str, ...], Strut]:
    found = find_struts(mechanism, Geometry(mechanism.resolved))
    return {strut.links: strut for strut in found}


def with_points(mechanism: Mechanism, name: str, points: Mapping[str, tuple[int, int, int]]) -> Mechanism:
    exact = {key: tuple(map(sympy.Integer, value)) for key, value in points.items()}
    links = tuple(replace(k, points=exact) if k.name == name else k for k in mechanism.links)
    return replace(mechanism, links=links)


def without_exclusions(*exclusions: Exclusion, limits: tuple[Limit, ...] = ()) -> Mechanism:
    return replace(PLATFORM, exclusions=exclusions, limits=limits)


def test_a_rod_between_two_spherical_joints() -> None:
    """The rod of RSSR; the crank and the rocker have one spherical joint each."""
    (strut,) = struts(RSSR).values()
    assert (strut.links, strut.slide, strut.names) == (("rod",), None, ())
    assert [(end.joint.name, end.other) for end in strut.ends] == [("B", "crank"), ("C", "rocker")]


def test_no_rod_where_the_joints_have_one_centre() -> None:
    assert struts(with_points(RSSR, "rod", {"B": (1, 0, 0), "C": (1, 0, 0)})) == {}


def test_legs_that_cannot_vanish_need_no_direction() -> None:
    """Six legs; that the ends of each are apart is excluded, so their difference is a direction."""
    found = struts(PLATFORM)
    assert sorted(found) == [(f"lower{k}", f"upper{k}") for k in range(1, 7)]
    assert all(strut.names == () for strut in found.values())


def test_a_leg_that_may_vanish_has_a_direction_of_its_own() -> None:
    """Without exclusions; where ends of two legs are apart; with a lower limit of 0, or on another leg."""
    own = ("d_P1", "ux_P1", "uy_P1", "uz_P1")
    other = Exclusion("coincide", ("A1", "B2"))
    touching = Limit(length_symbol(LEG), sympy.Integer(0))
    other_leg = Limit(length_symbol(PLATFORM.joint("P2")), sympy.Integer(1))
    limited = [without_exclusions(limits=(limit,)) for limit in (touching, other_leg)]
    for mechanism in (without_exclusions(), without_exclusions(other), *limited):
        leg = struts(mechanism)["lower1", "upper1"]
        assert leg.names == own
        assert leg.lengths == own[:1]


def test_a_leg_with_a_positive_limit_has_its_length_alone() -> None:
    found = struts(without_exclusions(limits=(Limit(length_symbol(LEG), sympy.Rational(1, 2)),)))
    assert found["lower1", "upper1"].names == ("d_P1",)
    assert len(found["lower2", "upper2"].names) == 4


def with_slide_at(*place: int) -> Mechanism:
    """The slide of the first leg is at K in its lower part, and at least 1/2 long; the joint A1 is at 0."""
    joints = tuple(replace(j, at=("K", "B1")) if j is LEG else j for j in PLATFORM.joints)
    limited = without_exclusions(limits=(Limit(length_symbol(LEG), sympy.Rational(1, 2)),))
    x, y, z = place
    return with_points(replace(limited, joints=joints), "lower1", {"A1": (0, 0, 0), "K": (x, y, z)})


def test_a_slide_beside_the_line_of_the_ends_is_no_strut() -> None:
    """One unit to the side it is none; two units along the axis it is straight."""
    assert ("lower1", "upper1") not in struts(with_slide_at(1, 0, 0))
    assert ("lower1", "upper1") in struts(with_slide_at(0, 0, 2))


def test_a_slide_that_is_longer_than_its_strut() -> None:
    """From K = (0, 0, -2) the strut is 2 shorter than its slide: at a length of 2 the ends meet.

    From K = (0, 0, 2) it is 2 longer, so at least 5/2.
    """
    assert len(struts(with_slide_at(0, 0, -2))["lower1", "upper1"].names) == 4
    assert struts(with_slide_at(0, 0, 2))["lower1", "upper1"].names == ("d_P1",)


def test_the_rod_is_closed_by_its_length_and_does_not_spin() -> None:
    """|B - C|^2 = 9, and the idle spin of the rod is about the line of its ends."""
    found = place(RSSR)
    b, c = (found.link_points[end] for end in (("crank", "B"), ("rocker", "C")))
    gap = [x - y for x, y in zip(c, b, strict=True)]
    square = sum((g * g for g in gap), start=found.space.ring.zero) - 9
    assert square.primitive() in {e.primitive() for e in found.space.equations}
    assert found.idle_spins == (("B", tuple(gap)),)


def test_a_strut_without_a_variable_tells_its_length() -> None:
    """The slide of a leg is as long as its ends are apart."""
    equation = velocity_equation(load("stewart-gough"))
    ends = [equation.space.points[name] for name in ("A3", "B3")]
    square = sum(((b - a) ** 2 for a, b in zip(*ends, strict=True)), equation.space.ring.zero)
    assert equation.values["P3"].square == square
