"""Constraints, screws and values of each joint between the ground and one body, by hand.

The joint's point is (1, 2, 0) in the ground and the origin of the body; its axis is z in both.
"""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

from singsym.kinematics.formulations import closure
from singsym.kinematics.formulations.frames import Algebra, Body, rigid
from singsym.kinematics.formulations.local import UNITS, Geometry
from singsym.mechanism.model import Joint, JointKind, JointRate, Link, Mechanism, Space
from singsym.polynomials import Ring

R = Ring(("d",))
ALGEBRA = Algebra(R, R.from_sympy)
Three = tuple[Fraction | int, Fraction | int, Fraction | int]

STILL = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
TURNED = ((Fraction(3, 5), Fraction(4, 5), 0), (Fraction(-4, 5), Fraction(3, 5), 0), (0, 0, 1))
OVER = ((1, 0, 0), (0, -1, 0), (0, 0, -1))
TILTED = ((0, 0, 1), (1, 0, 0), (0, 1, 0))


def placed(origin: Three, frame: tuple[Three, Three, Three] = STILL) -> Body:
    """A body by its frame's origin and its frame's vectors."""
    vectors = [tuple(map(R.constant, v)) for v in (origin, *frame)]
    return rigid(ALGEBRA, vectors[0], tuple(vectors[1:]))


GROUND = placed((0, 0, 0))


def between(kind: str, pitch: int | None = None) -> tuple[Joint, Geometry]:
    zero = sympy.Integer(0)
    ground = Link("ground", {"A": (sympy.Integer(1), sympy.Integer(2), zero)}, {"u": UNITS[2]})
    arm = Link("arm", {"A": (zero,) * 3}, {"u": UNITS[2], "v": UNITS[0]})
    axes = {"S": None, "U": ("u", "v")}.get(kind, ("u", "u"))
    exact = None if pitch is None else sympy.Integer(pitch)
    joint = Joint("A", JointKind(kind), "ground", "arm", ("A", "A"), axes, exact)
    rate = (JointRate(joint.columns[0]),)
    mechanism = Mechanism("test", Space.SPATIAL, "ground", (ground, arm), (joint,), joint.columns[:1], rate)
    return joint, Geometry(mechanism)


def holds(kind: str, body: Body) -> bool:
    joint, geometry = between(kind)
    return not any(closure.equations(joint, geometry, GROUND, body))


@pytest.mark.parametrize(
    ("kind", "body", "expected"),
    [
        ("R", placed((1, 2, 0), TURNED), True),
        ("R", placed((1, 2, 1), TURNED), False),
        ("R", placed((1, 2, 0), OVER), False),
        ("C", placed((1, 2, 5), TURNED), True),
        ("C", placed((2, 2, 5), TURNED), False),
        ("C", placed((1, 2, 5), OVER), False),
        ("P", placed((1, 2, 5)), True),
        ("P", placed((1, 2, 5), TURNED), False),
        ("P", placed((1, 3, 5)), False),
        ("E", placed((7, -3, 0), TURNED), True),
        ("E", placed((7, -3, 1), TURNED), False),
        ("E", placed((7, -3, 0), OVER), False),
        ("S", placed((1, 2, 0), TILTED), True),
        ("S", placed((1, 2, 1), TILTED), False),
        ("U", placed((1, 2, 0), TURNED), True),
        ("U", placed((1, 2, 0), TILTED), False),
        ("U", placed((0, 2, 0), TURNED), False),
    ],
)
def test_a_constraint_holds_where_the_joint_allows_it(kind: str, body: Body, expected: bool) -> None:
    """Turned: about z by the angle of (3/5, 4/5).  Over: upside down.  Tilted: the body's x along z.

    For U the ground's z and the body's x are at right angles, which they are not where the body is tilted.
    """
    assert holds(kind, body) == expected


def test_a_slide_with_a_variable_for_its_length() -> None:
    """(1, 2, 5) is at (1, 2, 0) + d z: what is left is 5 - d."""
    joint, geometry = between("P")
    found = closure.equations(joint, geometry, GROUND, placed((1, 2, 5)), R.gen("d"))
    assert [e for e in found if e] == [5 - R.gen("d")]


def numbers(kind: str, body: Body, pitch: int | None = None) -> dict[str, list[Fraction]]:
    joint, geometry = between(kind, pitch)
    found = closure.screws(joint, geometry, GROUND, body)
    return {k: [Fraction(int(e.constant.p), int(e.constant.q)) for e in v] for k, v in found.items()}


def test_screws_about_and_along_the_axis() -> None:
    """w = z through p = (1, 2, 0): p x w = (2, -1, 0); with a pitch of 3 along z as well."""
    body = placed((1, 2, 0), TURNED)
    assert numbers("R", body) == {"A": [0, 0, 1, 2, -1, 0]}
    assert numbers("H", body, 3) == {"A": [0, 0, 1, 2, -1, 3]}
    assert numbers("P", placed((1, 2, 5))) == {"A": [0, 0, 0, 0, 0, 1]}
    turn, slide = numbers("C", placed((1, 2, 5), TURNED)).values()
    assert (turn, slide) == ([0, 0, 1, 2, -1, 0], [0, 0, 0, 0, 0, 1])


def test_screws_of_joints_with_two_or_three_axes() -> None:
    """About x through p = (1, 2, 0): p x x = (0, 0, -2), about y: (0, 0, 1).  U: z, and the body's x."""
    assert list(numbers("S", placed((1, 2, 0), TILTED)).values()) == [
        [1, 0, 0, 0, 0, -2],
        [0, 1, 0, 0, 0, 1],
        [0, 0, 1, 2, -1, 0],
    ]
    c, s = Fraction(3, 5), Fraction(4, 5)
    assert list(numbers("U", placed((1, 2, 0), TURNED)).values()) == [
        [0, 0, 1, 2, -1, 0],
        [c, s, 0, 0, 0, s - 2 * c],
    ]


def test_screws_of_a_planar_joint() -> None:
    """Two slides in the plane, and the rotation about z through the body's point (7, -3, 0)."""
    *slides, turn = numbers("E", placed((7, -3, 0), TURNED)).values()
    assert slides == [[0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0]]
    assert turn == [0, 0, 1, -3, -7, 0]


def test_values_with_their_signs() -> None:
    """The angle from the ground's x to the body's: cosine 3/5, sine 4/5; backwards with sine -4/5."""
    joint, geometry = between("R")
    (value,) = closure.value(joint, geometry, GROUND, placed((1, 2, 0), TURNED)).values()
    assert (value.cosine, value.sine, value.scale) == (Fraction(3, 5), Fraction(4, 5), 1)
    back = tuple(zip(*TURNED, strict=True))
    (value,) = closure.value(joint, geometry, GROUND, placed((1, 2, 0), back)).values()
    assert (value.cosine, value.sine) == (Fraction(3, 5), Fraction(-4, 5))
    joint, geometry = between("P")
    (value,) = closure.value(joint, geometry, GROUND, placed((1, 2, -5))).values()
    assert value.length == -5
    joint, geometry = between("S")
    assert closure.value(joint, geometry, GROUND, placed((1, 2, 0))) == {}


def test_distance_of_two_points() -> None:
    """|(3, 4, 0)|^2 = 25 is the square of 5, not of 6."""
    p, q = (tuple(map(R.constant, v)) for v in ((3, 4, 0), (0, 0, 0)))
    zero, five, six = (tuple(map(sympy.Integer, v)) for v in ((0, 0, 0), (5, 0, 0), (0, 6, 0)))
    assert closure.distance(ALGEBRA, p, q, five, zero).is_zero
    assert closure.distance(ALGEBRA, p, q, six, zero) == 25 - 36
