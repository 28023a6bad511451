"""Each fault is named with its place, what is there and what should be."""

import re
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import pytest
import sympy

from singsym.mechanism import (
    Joint,
    JointKind,
    JointRate,
    Link,
    Mechanism,
    MechanismError,
    Parameter,
    Twist,
    check,
    define,
    load,
)

FOUR = load("fourbar")
HYBRID = load("zlatanov-hybrid")


def said(mechanism: Mechanism) -> str:
    return "\n".join(str(problem) for problem in check(mechanism))


def with_link(mechanism: Mechanism, name: str, change: Callable[[Link], Link]) -> Mechanism:
    links = tuple(change(link) if link.name == name else link for link in mechanism.links)
    return replace(mechanism, links=links)


def test_missing_ground() -> None:
    text = said(replace(FOUR, ground="base"))
    assert "fourbar.toml: ground: found no link 'base'" in text
    assert "a link among ground, AB, BC, CD" in text


def test_unknown_link_with_suggestion() -> None:
    joints = (replace(FOUR.joints[0], second="BA"), *FOUR.joints[1:])
    text = said(replace(FOUR, joints=joints))
    assert "joints.A: found the unknown link 'BA'" in text


def test_unattached_and_disconnected_links() -> None:
    extra = Link("spare", {"S": (sympy.Integer(0), sympy.Integer(0))}, {})
    assert "links.spare: found no joint at this link" in said(replace(FOUR, links=(*FOUR.links, extra)))
    pair = (Link("one", {"S": (0, 0)}, {}), Link("two", {"S": (0, 0)}, {}))
    joint = Joint("S", JointKind.R, "one", "two", ("S", "S"))
    text = said(replace(FOUR, links=(*FOUR.links, *pair), joints=(*FOUR.joints, joint)))
    assert "links.one: found no chain of joints to the ground" in text


def test_unknown_point() -> None:
    joints = (replace(FOUR.joints[0], at=("A", "Q")), *FOUR.joints[1:])
    assert "no point 'Q' in link 'AB'; expected a point of it: A, B" in said(replace(FOUR, joints=joints))


@pytest.mark.parametrize(
    ("axis", "found"),
    [
        ((0, 0, 0), "the zero vector"),
        ((0, 0, 2), "of squared length 4"),
        ((0, sympy.Rational(3, 5), sympy.Rational(3, 5)), "of squared length 18/25"),
        ((sympy.Symbol("a"), 0, 0), "of squared length a\\*\\*2"),
    ],
)
def test_axes_that_are_no_unit_vectors(axis: tuple[object, ...], found: str) -> None:
    vector = tuple(map(sympy.sympify, axis))
    bad = with_link(HYBRID, "yokeA", lambda link: replace(link, axes={**link.axes, "hA": vector}))
    problems = check(bad)
    assert [p.place for p in problems] == ["links.yokeA.axes.hA"]
    assert re.search(found, problems[0].found)


def test_unit_axes_with_roots_and_angles_pass() -> None:
    assert check(load("bennett")) == ()
    assert check(load("3rps")) == ()


def test_reference_at_right_angles() -> None:
    bennett = load("bennett")
    joints = (replace(bennett.joints[0], reference=("uD", "x")), *bennett.joints[1:])
    assert "joints.A.reference: found 'uD' in link 'DA'" in said(replace(bennett, joints=joints))


def test_loop_that_cannot_close() -> None:
    # 4 > 1 + 1 + 1.
    with pytest.raises(MechanismError, match="ground is too long for the loop to close"):
        define(
            inputs=["A"],
            output={"rate": "D"},
            links={"ground": {"points": {"A": [0, 0], "D": [4, 0]}}, "AB": 1, "BC": 1, "CD": 1},
            joints=dict.fromkeys("ABCD", "R"),
        )
    assert check(FOUR.with_parameters(g=10)) != ()
    # Equality is a configuration: the flat one.
    assert check(FOUR.with_parameters(g="15/2")) == ()


def test_impossible_triangle() -> None:
    with pytest.raises(MechanismError, match="no longer than the other two"):
        define(links={"plate": {"sides": {"AB": 1, "BC": 1, "CA": 3}}}, joints={})


def test_inputs() -> None:
    assert "inputs: found the unknown 'Q'" in said(replace(FOUR, inputs=("Q",)))
    assert "'A' 2 times" in said(replace(FOUR, inputs=("A", "A")))
    assert "found 1 inputs; expected 2, the mobility stated" in said(replace(FOUR, mobility=2))
    assert "inputs: found no inputs" in said(replace(FOUR, inputs=()))
    split = replace(load("zlatanov-2dof"), inputs=("A", "C"))
    assert "'C'" in said(split)


def test_translating_links() -> None:
    assert "translating: found 'BD'; expected links among AB, BC, CD" in said(
        replace(FOUR, translating=("BD",))
    )
    assert "translating: found 'ground'" in said(replace(FOUR, translating=("ground",)))
    assert check(replace(FOUR, translating=("BC",))) == ()


def test_outputs() -> None:
    assert "found 2 output components; expected 1" in said(
        replace(FOUR, outputs=(JointRate("D"), JointRate("B")))
    )
    assert "output.rate" in said(replace(FOUR, outputs=(JointRate("Q"),)))
    assert "components among w, vx, vy" in said(replace(FOUR, outputs=(Twist("AB", "A", ("wx",)),)))
    assert "no point 'D' in link 'AB'" in said(replace(FOUR, outputs=(Twist("AB", "D", ("w",)),)))
    assert "expected 1 components" in said(replace(FOUR, outputs=()))


def test_parameters() -> None:
    bare = replace(FOUR, parameters=(*FOUR.parameters, Parameter("h")))
    assert "parameters.h: found neither value nor range" in said(bare)
    assert "the value 3; expected a value above 2*sqrt(3)/3 and below 2" in said(HYBRID.with_parameters(a=3))
    quotient = with_link(
        FOUR, "AB", lambda k: replace(k, points={**k.points, "B": (1 / sympy.Symbol("a"), 0)})
    )
    assert "a polynomial in a" in said(quotient.with_parameters(a=None))
    assert check(quotient) == ()
    unknown = with_link(FOUR, "AB", lambda k: replace(k, points={**k.points, "B": (sympy.Symbol("z"), 0)}))
    assert "the unknown name 'z'" in said(unknown)


def test_transcendental_dimension() -> None:
    assert "rationals, roots and sin, cos" in said(FOUR.with_parameters(a="pi/3"))


def test_point_named_twice() -> None:
    bad = with_link(
        FOUR, "CD", lambda k: replace(k, points={**k.points, "A": (sympy.Integer(1), sympy.Integer(1))})
    )
    assert "one name for one point of space" in said(bad)


def test_exclusions_name_points() -> None:
    exclusion = replace(HYBRID.exclusions[0], points=("A", "Q"))
    assert "the unknown point 'Q'" in said(replace(HYBRID, exclusions=(exclusion,)))


def test_kinds_of_joints_by_space() -> None:
    joints = (replace(FOUR.joints[0], kind=JointKind.S), *FOUR.joints[1:])
    assert "a joint of type S; expected one of R P in a planar mechanism" in said(
        replace(FOUR, joints=joints)
    )


def test_dimensions_as_python_numbers_and_text() -> None:
    ground = Link("ground", {"A": (0, 0), "D": (4.0, "0")}, {})
    rod = Link("AB", {"A": (0, 0), "B": ("r/2", Fraction(0))}, {})
    m = replace(
        FOUR,
        links=(ground, rod, *FOUR.links[2:]),
        parameters=(*FOUR.parameters, Parameter("r", 2)),
    )
    assert check(m) == ()
    assert m.resolved.link("AB").points["B"] == (sympy.Integer(1), sympy.Integer(0))
    bad = replace(m, links=(ground, Link("AB", {"A": (0, 0), "B": ("r/", 0)}, {}), *FOUR.links[2:]))
    assert "links.AB.B, column 3" in said(bad)
