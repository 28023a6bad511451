"""Classes of coupled mechanisms, against scans over the angles and against mechanisms without couplings."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from singsym.classes.classify import classify
from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType
from singsym.mechanism import Mechanism, define
from singsym.output.plain_data import classification_data
from tests.laws.answers import contradictions
from tests.laws.disguises import mirrored, reordered, scaled

T = SingularityType
BARS = (2, 3, 4, 1, 5)
"""Crank AB, rods BC and CD, crank ED, and the distance of A and E."""


def geared_five_bar(ratio: int, constant: str = "0", whole: int = 1) -> Mechanism:
    """`whole` * E = `ratio` * A + constant."""
    a, b, c, d, g = BARS
    return define(
        inputs=["A"],
        output={"velocity": "C", "components": ["x"]},
        links={"ground": {"points": {"A": [0, 0], "E": [g, 0]}}, "AB": a, "BC": b, "CD": c, "ED": d},
        joints=dict.fromkeys("ABCDE", "R"),
        couplings={"gears": {"rates": {"E": whole, "A": -ratio}, "constant": constant}},
    )


def scanned(ratio: int, phase: float, whole: int = 1) -> tuple[int, int]:
    """Configurations in which B, C, D are in line, and in which the x-coordinate of C is extreme.

    With the cranks at A = `whole` * t and E = `ratio` * t + phase, t round the circle, C is one of the two
    points of two circles. It comes to an end where BD = BC + CD, or BC - CD; its velocity is that of B and
    one at right angles to BC, and that of D and one at right angles to CD. Both are counted by signs.
    """
    a, b, c, d, g = BARS
    t = np.linspace(0, 2 * np.pi, 40001) + 1e-3
    B, D = a * np.exp(1j * whole * t), g + d * np.exp(1j * (ratio * t + phase))
    vB, vD = 1j * whole * B, 1j * ratio * (D - g)
    far = abs(D - B)
    in_line = sum(changes(far - reach) for reach in (b + c, abs(b - c)))
    along = (far**2 + b**2 - c**2) / (2 * far)
    square = b**2 - along**2
    extreme = 0
    for side in (1, -1):
        C = B + (D - B) / far * (along + side * 1j * np.sqrt(np.maximum(square, 0)))
        p, q = C - B, C - D
        rate = dot(p, vB) * q.imag - dot(q, vD) * p.imag  # of x, times the determinant of p and q
        extreme += int(np.sum((np.diff(np.sign(rate)) != 0) & (square[1:] > 0) & (square[:-1] > 0)))
    return in_line, extreme


def changes(values: Any) -> int:
    return int(np.sum(np.diff(np.sign(values)) != 0))


def dot(p: Any, q: Any) -> Any:
    return (p * np.conj(q)).real


def numbers(result: Classification) -> dict[SingularityType, int | None]:
    """The number of points of each class that occurs, all being finite and all else decided."""
    assert not result.undecided
    found = [c for c in result.classes if c.verdict.is_yes]
    assert all(c.dimension == 0 for c in found)
    return {c.types: c.points for c in found}


@pytest.mark.parametrize(
    ("ratio", "constant", "whole"),
    [(1, "0", 1), (-1, "0", 1), (-1, "90 deg", 1), (2, "0", 1), (-1, "0", 2)],
)
def test_a_geared_five_bar_by_a_scan_over_its_cranks(ratio: int, constant: str, whole: int) -> None:
    """Of mobility 1: dead points of the crank are (RO, II), extremes of the output (RI, IO)."""
    phase = math.radians(float(constant.split()[0])) / whole
    in_line, extreme = scanned(ratio, phase, whole)
    expected = {T.RO | T.II: in_line, T.RI | T.IO: extreme}
    result = classify(geared_five_bar(ratio, constant, whole), cache=False)
    assert numbers(result) == {types: count for types, count in expected.items() if count}
    assert [(s.dimension, s.smooth) for s in result.configuration_space] == [(1, "yes")]


def test_in_joint_coordinates_it_is_the_same() -> None:
    plain = classification_data(classify(geared_five_bar(2), cache=False))
    other = classification_data(classify(geared_five_bar(2), formulation="joint", cache=False))
    assert not contradictions(plain, other, same_names=False)
    assert {c["number"]: c["points"] for c in plain["classes"]} == {
        c["number"]: c["points"] for c in other["classes"]
    }


@pytest.mark.parametrize("disguise", [mirrored, reordered, scaled(1000)])
def test_a_disguise_changes_nothing(disguise: Any) -> None:
    mechanism = geared_five_bar(-1, "90 deg")
    plain = classification_data(classify(mechanism, cache=False))
    other = classification_data(classify(disguise(mechanism), cache=False))
    assert not contradictions(plain, other, same_names=False)


def arm(lengths: tuple[int, ...], ratio: int | None = None) -> Mechanism:
    """A planar arm A, B (and C = `ratio` * B), with the velocity of its tip T as output."""
    names = "ABC"[: len(lengths)]
    ends = [*names, "T"]
    sides = zip(ends, ends[1:], lengths, strict=False)
    couplings = {} if ratio is None else {"belt": {"rates": {"B": ratio, "C": -1}}}
    return define(
        inputs=["A", "B"],
        output={"velocity": "T"},
        links={"ground": {"points": {"A": [0, 0]}}, **{f"{p}{q}": x for p, q, x in sides}},
        joints=dict.fromkeys(names, "R"),
        couplings=couplings,
    )


def singular(result: Classification) -> dict[SingularityType, tuple[int | None, int | None]]:
    assert not result.undecided
    return {c.types: (c.dimension, c.components) for c in result.classes if c.verdict.is_yes}


@pytest.mark.parametrize(("lengths", "ratio"), [((3, 2, 2), 1), ((2, 3, 4), -2), ((4, 2, 1), 2)])
def test_an_arm_with_a_belt_by_hand(lengths: tuple[int, int, int], ratio: int) -> None:
    """With u = exp(i B) the tip is at p = l1 + l2 u + l3 u^(1 + k), up to the turn of A.

    The rates of A and B move it by i p and i (l2 u + (1 + k) l3 u^(1 + k)), parallel where the imaginary
    part of the one's conjugate times the other is 0. Each such B gives a circle of configurations, (RI, IO).
    """
    l1, l2, l3 = lengths
    B = np.linspace(0, 2 * np.pi, 100001) + 1e-3
    u = np.exp(1j * B)
    tip, slope = l1 + l2 * u + l3 * u ** (1 + ratio), l2 * u + (1 + ratio) * l3 * u ** (1 + ratio)
    circles = changes((np.conj(tip) * slope).imag)
    assert singular(classify(arm(lengths, ratio), cache=False)) == {T.RI | T.IO: (1, circles)}


def test_a_link_that_is_kept_parallel_to_the_first_is_a_longer_first_link() -> None:
    """C = -B: the tip is at (l1 + l3) exp(i A) + l2 exp(i (A + B))."""
    coupled, plain = classify(arm((3, 2, 1), -1), cache=False), classify(arm((4, 2)), cache=False)
    assert singular(coupled) == singular(plain) == {T.RI | T.IO: (1, 2)}


def test_a_symmetric_five_bar_by_hand() -> None:
    """Cranks 2 on (0, 0) and (2, 0), rods 3, E = 180 deg - A: mirror images in x = 1; the output is C's y.

    With c = cos A, C is on x = 1, at y = 2 sin A +- sqrt(9 - (1 - 2c)^2), or, where c = 1/2, so that B and D
    coincide, anywhere on a circle about them.  On these two circles the cranks stand still and C moves up or
    down, (RO, II), but where CB is upright, in 2 points of each: there C moves sideways alone, and the cranks
    can move too and take C's y along: (RPM, IIM).  y is extreme, (RI, IO), where 5c^2 + 4c - 1 = 0, so
    at c = 1/5 with one sign for each of the two A.  The other root is c = -1, where all is level: B, C and D
    are in line, C may move without the cranks, and these without C: (RI, RO, IIM).
    """
    mechanism = define(
        inputs=["A"],
        output={"velocity": "C", "components": ["y"]},
        links={"ground": {"points": {"A": [0, 0], "E": [2, 0]}}, "AB": 2, "BC": 3, "CD": 3, "ED": 2},
        joints=dict.fromkeys("ABCDE", "R"),
        couplings={"gears": {"rates": {"A": 1, "E": 1}, "constant": "180 deg"}},
    )
    result = classify(mechanism, cache=False)
    assert not result.undecided
    assert {c.types: (c.dimension, c.components) for c in result.classes if c.verdict.is_yes} == {
        T.RO | T.II: (1, 2),
        T.RPM | T.IIM: (0, 4),
        T.RI | T.RO | T.IIM: (0, 1),
        T.RI | T.IO: (0, 2),
    }


def wheel(radius: int, arm: int, component: str) -> Mechanism:
    """A wheel that rolls on a line: its hub slides along x by P, and it turns by R; T is a point of it."""
    return define(
        inputs=["R"],
        output={"velocity": "T", "components": [component]},
        links={
            "ground": {"points": {"O": [0, 0]}, "axes": {"x": [1, 0]}},
            "hub": {"points": {"R": [0, 0]}, "axes": {"x": [1, 0]}},
            "wheel": {"points": {"R": [0, 0], "T": [arm, 0]}},
        },
        joints={"P": {"type": "P", "links": ["ground", "hub"], "at": ["O", "R"], "axis": "x"}, "R": "R"},
        couplings={"rolling": {"rates": {"P": 1, "R": radius}}},
    )


@pytest.mark.parametrize(("arm", "lines"), [(3, 2), (1, 0)])
def test_a_rolling_wheel_by_hand(arm: int, lines: int) -> None:
    """T has the velocity (-r - l sin R, l cos R) for a unit rate of R, with r = 2.

    Along y it rests twice in a turn, along x at two angles where l > r, wherever the wheel is: these are
    lines in the plane of angle and length, of which the mounting is one dimension.
    """
    for component, count in (("x", lines), ("y", 2)):
        result = classify(wheel(2, arm, component), cache=False)
        assert classification_data(result)["mountings"] == ["rolling"]
        assert result.parameters_note == "dimensions count how rolling is mounted, which may vary"
        assert singular(result) == ({T.RI | T.IO: (1, count)} if count else {})
        assert [(s.dimension, s.smooth) for s in result.configuration_space] == [(2, "yes")]


def test_a_wheel_in_disguise() -> None:
    plain = classification_data(classify(wheel(2, 3, "x"), cache=False))
    for disguise in (mirrored, scaled(Fraction(700, 3)), reordered):
        other = classification_data(classify(disguise(wheel(2, 3, "x")), cache=False))
        assert not contradictions(plain, other, same_names=False)


def test_a_wheel_that_drives_a_dyad() -> None:
    """A rod TC and a rocker CD on T: dead where T, C, D are in line, so at TD = 2 + 3 and at TD = 3 - 2.

    T is at (x + 3 cos R, 3 sin R), D at (0, -1).  In the plane of R and x TD = 5 is a curve on each side, as
    the heights differ by 4 at most, and TD = 1 closed curves about R = 0 and R = pi.  There the wheel can
    move too where T moves at right angles to TD, (RI, RO, IIM); such points are counted by changes of sign.
    """
    base = wheel(2, 3, "x")
    mechanism = define(
        inputs=["R"],
        output={"rate": "D"},
        links={
            "ground": {"points": {"O": [0, 0], "D": [0, -1]}, "axes": {"x": [1, 0]}},
            **{k.name: {"points": dict(k.points), "axes": dict(k.axes)} for k in base.links[1:]},
            "TC": 3,
            "CD": 2,
        },
        joints={
            "P": {"type": "P", "links": ["ground", "hub"], "at": ["O", "R"], "axis": "x"},
            **dict.fromkeys("RTCD", "R"),
        },
        couplings={"rolling": {"rates": {"P": 1, "R": 2}}},
    )
    result = classify(mechanism, cache=False)
    assert not result.undecided
    R = np.linspace(0, 2 * np.pi, 40001) + 1e-3
    height, sideways, upwards = 3 * np.sin(R) + 1, -2 - 3 * np.sin(R), 3 * np.cos(R)
    meeting = 0
    for reach in (5, 1):
        square = reach**2 - height**2
        for side in (1, -1):
            rate = side * np.sqrt(np.maximum(square, 0)) * sideways + height * upwards
            meeting += int(np.sum((np.diff(np.sign(rate)) != 0) & (square[1:] > 0) & (square[:-1] > 0)))
    found = singular(result)
    assert found.keys() == {T.RO | T.II, T.RI | T.IO, T.RI | T.RO | T.IIM}
    assert found[T.RO | T.II] == (1, 4)
    assert found[T.RI | T.RO | T.IIM] == (0, meeting)
    assert [(s.dimension, s.smooth) for s in result.configuration_space] == [(2, "undecided")]


def test_a_screw_is_mounted_in_any_way() -> None:
    """H along x with pitch 1, then R about z, T 2 from it: of mobility 2, and one dimension more.

    T moves in the (y, z)-directions of the ground by 2 sin B, up to the turn of H, along both joints' rates
    where this is not 0: the class has dimension 2 of 3, and is no piece of the space.
    """
    mechanism = define(
        space="spatial",
        inputs=["A", "B"],
        output={"velocity": "T", "components": ["y", "z"]},
        links={
            "ground": {"points": {"A0": [0, 0, 0]}, "axes": {"x": [1, 0, 0]}},
            "one": {
                "points": {"A1": [0, 0, 0], "B": [0, 1, 0]},
                "axes": {"x": [1, 0, 0], "z": [0, 0, 1]},
            },
            "two": {"points": {"B": [0, 0, 0], "T": [2, 0, 0]}, "axes": {"z": [0, 0, 1]}},
        },
        joints={
            "A": {"type": "H", "links": ["ground", "one"], "at": ["A0", "A1"], "axis": "x", "pitch": 1},
            "B": {"type": "R", "axis": "z"},
        },
    )
    result = classify(mechanism, cache=False)
    assert not result.undecided
    assert [(s.dimension, s.smooth) for s in result.configuration_space] == [(3, "yes")]
    assert {c.types: c.dimension for c in result.classes if c.verdict.is_yes} == {T.RI | T.IO: 2}


def cam(lift: str, pushed: dict[str, Any] | None = None, **more: Any) -> Mechanism:
    """A disk on A, and a follower that slides along y, with a point T; `pushed` hangs on T."""
    up = {"axes": {"y": [0, 1]}}
    return define(
        **{"inputs": ["A"], "output": {"velocity": "T", "components": ["y"]}, **more},
        links={
            "ground": {"points": {"A": [0, 0], "O": [0, 0], "D": [3, 4]}, **up},
            "disk": {"points": {"A": [0, 0]}},
            "follower": {"points": {"T": [0, 0]}, **up},
            **(pushed or {}),
        },
        joints={
            "A": "R",
            "P": {"type": "P", "links": ["ground", "follower"], "at": ["O", "T"], "axis": "y"},
            **dict.fromkeys("TCD" if pushed else "", "R"),
        },
        couplings={"cam": {"follower": "P", "lift": lift}},
    )


LIFTS = {
    "3 + 2*sin(A)": lambda a: 3 + 2 * np.sin(a),
    "3 + sin(A) + 2*cos(A)^2": lambda a: 3 + np.sin(a) + 2 * np.cos(a) ** 2,
    "4 + cos(A) - 4*cos(A)^3": lambda a: 4 + np.cos(a) - 4 * np.cos(a) ** 3,
}


@pytest.mark.parametrize("lift", LIFTS)
def test_a_cam_by_its_extremes(lift: str) -> None:
    """The follower rests, (RI, IO), where its lift is extreme; where it drives, it is dead there."""
    a = np.linspace(0, 2 * np.pi, 40001) + 1e-3
    extremes = changes(np.diff(LIFTS[lift](a)))
    result = classify(cam(lift), cache=False)
    assert numbers(result) == {T.RI | T.IO: extremes}
    assert [(s.dimension, s.smooth) for s in result.configuration_space] == [(1, "yes")]
    back = classify(cam(lift, inputs=["P"], output={"rate": "A"}), cache=False)
    assert numbers(back) == {T.RO | T.II: extremes}


def pushing(lift: str, **more: Any) -> Mechanism:
    """The follower's point T pushes a rod TC of length 4 on a rocker CD of length 2 about (3, 4)."""
    return cam(lift, {"TC": 4, "CD": 2}, output={"rate": "D"}, **more)


@pytest.mark.parametrize("lift", LIFTS)
def test_a_cam_that_pushes_a_rocker(lift: str) -> None:
    """T = (0, lift) is between 2 and 6 from D: it is dead where it comes to an end, (RO, II).

    The rocker is still, (RI, IO), at extremes of the lift, each with two positions of the rocker, and where
    the rod is level: C = (4, lift) is 2 from D at two lifts, C = (-4, lift) at none.
    """
    a = np.linspace(0, 2 * np.pi, 40001) + 1e-3
    far = np.hypot(3, LIFTS[lift](a) - 4)
    ends = changes(far - 6) + changes(far - 2)
    slope = np.diff(LIFTS[lift](a))
    rests = int(np.sum((np.diff(np.sign(slope)) != 0) & (far[1:-1] < 6) & (far[1:-1] > 2)))
    found = numbers(classify(pushing(lift), cache=False))
    level = changes(LIFTS[lift](a) - 4 - math.sqrt(3)) + changes(LIFTS[lift](a) - 4 + math.sqrt(3))
    expected = {T.RO | T.II: ends, T.RI | T.IO: 2 * rests + level}
    assert found == {types: count for types, count in expected.items() if count}


@pytest.mark.parametrize("disguise", [mirrored, reordered, scaled(1000)])
def test_a_cam_in_disguise(disguise: Any) -> None:
    mechanism = pushing("3 + sin(A) + 2*cos(A)^2")
    plain = classification_data(classify(mechanism, cache=False))
    other = classification_data(classify(disguise(mechanism), cache=False))
    assert not contradictions(plain, other, same_names=False)
