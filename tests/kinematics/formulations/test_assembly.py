"""What a placement makes of bodies: each equation once, points by the names that are free."""

from __future__ import annotations

import sympy

from singsym.kinematics.dimensions import dimensions
from singsym.kinematics.formulations.assembly import Assembly, placement
from singsym.kinematics.formulations.frames import Algebra, Body, rigid
from singsym.kinematics.formulations.local import UNITS, Geometry
from singsym.kinematics.placement import Placement
from singsym.mechanism.model import Joint, JointKind, JointRate, Link, Mechanism, Space
from singsym.polynomials import Polynomial

ZERO, ONE = sympy.Integer(0), sympy.Integer(1)


def point(*components: int) -> tuple[sympy.Expr, ...]:
    return tuple(map(sympy.Integer, components))


MECHANISM = Mechanism(
    "hinge",
    Space.SPATIAL,
    "ground",
    (
        Link("ground", {"A": point(0, 0, 0), "M": point(7, 0, 0)}, {"u": UNITS[2]}),
        Link("arm", {"A": point(0, 0, 0), "B": point(2, 0, 0), "M": point(1, 0, 0)}, {"u": UNITS[2]}),
    ),
    (Joint("A", JointKind.R, "ground", "arm", ("A", "A"), ("u", "u")),),
    ("A",),
    (JointRate("A"),),
)


def assembled(line_only: bool = False, twice: bool = False) -> tuple[Placement, tuple[Polynomial, ...]]:
    """The arm turned about z by the angle of (c, s); or only the line from A to B of it."""
    sized = dimensions(MECHANISM, ("c", "s"))
    algebra = Algebra(sized.ring, sized.number)
    c, s = sized.ring.gens
    zero, one = sized.ring.zero, sized.ring.one
    arm = rigid(algebra, algebra.origin, ((c, s, zero), (-s, c, zero), (zero, zero, one)))
    if line_only:
        arm = Body(algebra, algebra.origin, point(0, 0, 0), ((c, s, zero),), (UNITS[0],))
    bodies = {"ground": rigid(algebra, algebra.origin, algebra.axes), "arm": arm}
    circle = c**2 + s**2 - 1
    more = [circle * 3, circle * s - circle * s] if twice else []
    found = Assembly(MECHANISM, Geometry(MECHANISM), algebra, bodies, [circle, *more], circles=(circle,))
    if not line_only:
        found.close(MECHANISM.joints)
    return placement(found, sized, "test"), (c, s)


def test_a_closed_joint_adds_nothing_where_it_holds() -> None:
    """The arm turns about A as it is placed: the equation of the circle is all that is left, and once."""
    placed, (c, s) = assembled(twice=True)
    assert placed.space.equations == (c**2 + s**2 - 1,)
    assert (placed.values["A"].cosine, placed.values["A"].sine) == (c, s)
    assert placed.screws["A"] == (*placed.space.directions["u"], *(placed.space.ring.zero,) * 3)


def test_points_are_named_once_and_the_ground_comes_first() -> None:
    """M of the ground is at (7, 0, 0); that of the arm is another point of space, arm.M, at (c, s, 0)."""
    placed, (c, s) = assembled()
    zero = placed.space.ring.zero
    assert placed.space.points["M"] == (zero + 7, zero, zero)
    assert placed.space.points["arm.M"] == (c, s, zero)
    assert placed.space.points["B"] == (c * 2, s * 2, zero)
    assert "arm.A" not in placed.space.points


def test_directions_that_are_not_placed_are_left_out() -> None:
    """Of an arm that is only a line, points on it are placed; its axis z is not, and is the ground's."""
    placed, (c, s) = assembled(line_only=True)
    zero, one = placed.space.ring.zero, placed.space.ring.one
    assert placed.link_points["arm", "B"] == (c * 2, s * 2, zero)
    assert placed.space.directions["u"] == (zero, zero, one)
    assert placed.screws["A"] == (zero, zero, one, zero, zero, zero)
