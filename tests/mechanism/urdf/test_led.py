"""Mimic joints that follow joints which move: coupled, with their limits on one of them."""

from __future__ import annotations

from pathlib import Path

import pytest
import sympy

from singsym.classes.classify import classify
from singsym.classes.taxonomy.types import SingularityType
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Choice, MechanismError, dumps, load, loads
from singsym.mechanism.arcs import decimal_arc
from singsym.mechanism.urdf import from_urdf
from tests.mechanism.urdf.files import joint, write

PLANE = Choice(components=("vx", "vy"))


def snake(folder: Path, mimic: str, limits: tuple[str, ...] = ("", "", ""), kind: str = "revolute") -> Path:
    """Three joints about z, 0.5 apart; the last follows another one."""
    parts = [{"limit": limit} if limit else {} for limit in limits]
    parts[2]["mimic"] = mimic
    turns = [
        joint(kind, f"s{i}", f"s{i + 1}", xyz="0.5 0 0", axis="0 0 1", **part) for i, part in enumerate(parts)
    ]
    return write(folder, *turns, joint("fixed", "s3", "tip", xyz="0.25 0 0"))


def test_a_follower_is_coupled_and_no_input(tmp_path: Path) -> None:
    path = snake(tmp_path, 'joint="to_s2" multiplier="-0.5" offset="1.5708"')
    arm = load(path, PLANE)
    assert arm.inputs == ("to_s1", "to_s2")
    (coupling,) = arm.couplings
    assert dict(coupling.terms) == {"to_s3": 1, "to_s2": sympy.Rational(1, 2)}
    assert coupling.constant == sympy.pi / 2
    assert "Joint to_s3 follows to_s2, coupled: -0.5 * to_s2 + 1.5708." in arm.description
    assert loads(dumps(arm), origin=arm.origin) == arm


def test_the_classes_are_those_of_the_arm_by_hand(tmp_path: Path) -> None:
    """C = -B: the last link, of 0.25, stays parallel to the first, of 0.5: links 0.75 and 0.5, in line."""
    path = snake(tmp_path, 'joint="to_s2" multiplier="-1"')
    result = classify(load(path, PLANE), cache=False)
    assert not result.undecided
    found = {c.types: (c.dimension, c.components) for c in result.classes if c.verdict.is_yes}
    assert found == {SingularityType.RI | SingularityType.IO: (1, 2)}


def test_followers_of_followers_lead_to_the_first(tmp_path: Path) -> None:
    turns = [
        joint("continuous", "s0", "s1", axis="0 0 1"),
        joint("continuous", "s1", "s2", xyz="1 0 0", axis="0 0 1", mimic='joint="to_s1" multiplier="2"'),
        joint("continuous", "s2", "s3", xyz="1 0 0", axis="0 0 1", mimic='joint="to_s2" multiplier="-3"'),
    ]
    arm = load(write(tmp_path, *turns), Choice(components=("vx",)))
    assert arm.inputs == ("to_s1",)
    assert [dict(c.terms) for c in arm.couplings] == [{"to_s2": 1, "to_s1": -2}, {"to_s3": 1, "to_s1": 6}]
    assert velocity_equation(arm).L.shape == (3, 4)


def test_slides_follow_slides(tmp_path: Path) -> None:
    slides = [
        joint("prismatic", "s0", "s1", axis="1 0 0", limit="0 1"),
        joint(
            "prismatic",
            "s1",
            "s2",
            axis="0 1 0",
            limit="0 1",
            mimic='joint="to_s1" multiplier="0.3" offset="0.1"',
        ),
    ]
    arm = load(write(tmp_path, *slides), Choice(components=("vx",)))
    (coupling,) = arm.couplings
    assert dict(coupling.terms) == {"to_s2": 1, "to_s1": -sympy.Rational(3, 10)}
    assert coupling.constant == sympy.Rational(1, 10)
    assert len(arm.limits) == 2


@pytest.mark.parametrize(
    ("multiplier", "limits", "carrier", "ends"),
    [
        # 2 B within -1 and 1, and not within these and a full turn more
        ("2", ("", "-3 3", "-1 1"), "to_s2", (-0.5, 0.5)),
        ("-1", ("", "-2 1", "-3 0.5"), "to_s2", (-0.5, 1.0)),
        # half of B tells B, not the other way round
        ("0.5", ("", "-3 2", ""), "to_s3", (-1.5, 1.0)),
    ],
)
def test_limits_are_put_on_one(
    tmp_path: Path, multiplier: str, limits: tuple[str, str, str], carrier: str, ends: tuple[float, float]
) -> None:
    """By hand: the follower is at `multiplier` times its leader, in real numbers."""
    arm = load(snake(tmp_path, f'joint="to_s2" multiplier="{multiplier}"', limits), PLANE)
    assert arm.limits == (decimal_arc(carrier, *ends)[0],)
    assert f"Limits of to_s2, to_s3 together are put on {carrier}." in arm.description


@pytest.mark.parametrize(
    ("mimic", "limits", "words"),
    [
        (
            'joint="to_s2" multiplier="1.0585"',
            ("", "", ""),
            r"1.0585 \* to_s2; expected a ratio of whole numbers",
        ),
        (
            'joint="to_s2" offset="0.3"',
            ("", "", ""),
            r"to_s2 \+ 0.3; expected an offset that is a multiple of pi",
        ),
        (
            'joint="to_s2" multiplier="1.5"',
            ("", "-1 1", ""),
            r"limits of to_s2, to_s3, of which none tells where the others are; .*hold it, as --lock to_s2=0",
        ),
        ('joint="to_s2"', ("", "-1 1", "2 3"), r"limits of to_s2, to_s3 without a common range"),
        ('joint="to_s3"', ("", "", ""), r"joint to_s3: found joints that follow each other"),
    ],
)
def test_what_cannot_be_coupled_is_named(
    tmp_path: Path, mimic: str, limits: tuple[str, str, str], words: str
) -> None:
    with pytest.raises(MechanismError, match=words):
        from_urdf(snake(tmp_path, mimic, limits), PLANE)


def test_a_turn_does_not_follow_a_slide(tmp_path: Path) -> None:
    chain = [
        joint("prismatic", "s0", "s1", axis="1 0 0", limit="0 1"),
        joint("continuous", "s1", "s2", axis="0 0 1"),
        joint("continuous", "s2", "s3", xyz="1 0 0", axis="0 0 1", mimic='joint="to_s1"'),
    ]
    ways = r"1 \* to_s1, a length and an angle; .*--lock to_s1=0, or end the chain before it, as --tip s2"
    with pytest.raises(MechanismError, match=ways):
        from_urdf(write(tmp_path, *chain), PLANE)


def test_what_is_offered_counts_followers_with_their_leaders(tmp_path: Path) -> None:
    """Of the plane two components fit, the turn of the tip and its velocity; there are no others."""
    path = snake(tmp_path, 'joint="to_s2" multiplier="-1"')
    with pytest.raises(MechanismError, match=r"2 moving joints and no output .*--components vx,vy"):
        from_urdf(path)
    held = from_urdf(path, Choice(lock={"to_s2": 0}, components=("vx",)))
    assert held.inputs == ("to_s1",)
    assert held.couplings == ()
