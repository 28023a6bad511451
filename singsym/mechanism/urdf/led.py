"""Mimic joints of a chain that follow joints which move: couplings, and where their limits go.

Source: the URDF specification (https://wiki.ros.org/urdf/XML), <mimic>.

A turn is known modulo 2 pi here, while a limited joint and those that follow it turn less than that or more.
So all their limits are put on the one of them of which the others are whole multiples: where that one is,
they are where they are in the file.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from singsym.mechanism.couplings import LARGEST
from singsym.mechanism.urdf.chains import Chain
from singsym.mechanism.urdf.numbers import Reading
from singsym.mechanism.urdf.robot_file import Robot, RobotJoint

Interval = tuple[float, float]


@dataclass(frozen=True)
class Led:
    """A joint's value: `multiplier` times that of `leader`, which moves on its own, plus `offset`.

    The decimals of the file as fractions, in radians or metres.
    """

    leader: str
    multiplier: Fraction
    offset: Fraction


def led_joints(robot: Robot, chain: Chain, held: Mapping[str, Any]) -> dict[str, Led]:
    """The joints of a chain that follow joints which are not held, by name.

    Raises `MechanismError` for those that no coupling can say.
    """
    free = {joint.name: joint for joint in chain.moving if joint.name not in held}
    relations = {
        joint.name: Led(mimic.joint, Fraction(repr(mimic.multiplier)), Fraction(repr(mimic.offset)))
        for joint in free.values()
        if (mimic := joint.mimic) is not None and mimic.joint in free
    }
    found = {}
    for name in relations:
        led = composed(name, relations)
        if led is None:
            raise robot.fault(f"joint {name}", "joints that follow each other", "one that moves on its own")
        if fault := _fault(free[name], led, free):
            raise _refused(robot, chain, free[name], led, free, *fault)
        found[name] = led
    return found


def composed(name: str, relations: Mapping[str, Led]) -> Led | None:
    """What a joint follows in the end, where leaders follow others; None where they follow each other.

    >>> twice = {"B": Led("A", Fraction(2), Fraction(1)), "C": Led("B", Fraction(-1), Fraction(0))}
    >>> composed("C", twice)
    Led(leader='A', multiplier=Fraction(-2, 1), offset=Fraction(-1, 1))
    """
    multiplier, offset, leader, seen = Fraction(1), Fraction(0), name, {name}
    while leader in relations:
        one = relations[leader]
        offset, multiplier, leader = offset + multiplier * one.offset, multiplier * one.multiplier, one.leader
        if leader in seen:
            return None
        seen.add(leader)
    return Led(leader, multiplier, offset)


def _fault(joint: RobotJoint, led: Led, free: Mapping[str, RobotJoint]) -> tuple[str, ...]:
    """What cannot be said of a relation, beside how it is written, and what should be; empty if all can."""
    turning = joint.kind != "prismatic"
    if turning != (free[led.leader].kind != "prismatic"):
        return ", a length and an angle", "joints that both turn or both slide"
    if not turning:
        return ()
    if max(abs(led.multiplier.numerator), led.multiplier.denominator) > LARGEST:
        return "", f"a ratio of whole numbers up to {LARGEST}"
    if Reading().multiple(float(led.offset)) is None:
        return "", "an offset that is a multiple of pi, as 0, 0.7854 or 1.5708"
    return ()


def _refused(
    robot: Robot,
    chain: Chain,
    joint: RobotJoint,
    led: Led,
    free: Mapping[str, RobotJoint],
    more: str,
    expected: str,
) -> Exception:
    """The leader may be held, or the chain end before."""
    leader = free[led.leader]
    still = [
        name for name, j in free.items() if j is not leader and (j.mimic is None or j.mimic.joint not in free)
    ]
    ways = [f"hold its leader, as --lock {leader.name}={leader.resting}"] if still else []
    if joint is not chain.moving[0]:
        ways.append(f"end the chain before it, as --tip {joint.parent}")
    found = f"a mimic joint, {_relation(led)}{more}"
    return robot.fault(f"joint {joint.name}", found, expected, ", or ".join(ways))


def _relation(led: Led) -> str:
    plus = f" + {float(led.offset):g}" if led.offset else ""
    return f"{float(led.multiplier):g} * {led.leader}{plus}"


# -- limits -----------------------------------------------------------------------------------------------


def with_limits(robot: Robot, chain: Chain, led: Mapping[str, Led]) -> tuple[Chain, tuple[str, ...]]:
    """The chain with the limits of turning joints that follow others put on one of each group, and notes.

    Raises `MechanismError` where no joint of a group tells where the others are, or no value is left.
    """
    joints = {joint.name: joint for joint in chain.joints}
    notes = [f"Joint {name} follows {one.leader}, coupled: {_relation(one)}." for name, one in led.items()]
    for leader, group in groups(led).items():
        limits = {name: _limits(robot, joints[name]) for name in group if joints[name].kind != "prismatic"}
        known = {name: ends for name, ends in limits.items() if ends is not None}
        try:
            shared = shared_limits(group, known)
        except ValueError as fault:
            found, expected = str(fault), "limits that one of them can have for all"
            advice = f"hold it, as --lock {leader}={joints[leader].resting}"
            raise robot.fault(f"joint {leader}", found, expected, advice) from None
        joints |= {name: replace(joints[name], lower=None, upper=None) for name in known}
        if shared is not None:
            carrier, ends = shared
            joints[carrier] = replace(joints[carrier], lower=ends[0], upper=ends[1])
            notes.append(f"Limits of {', '.join(group)} together are put on {carrier}.")
    return replace(chain, joints=tuple(joints[joint.name] for joint in chain.joints)), tuple(notes)


def groups(led: Mapping[str, Led]) -> dict[str, dict[str, Led]]:
    """By the joint that they follow, those that follow one, and before these itself."""
    found: dict[str, dict[str, Led]] = {}
    for name, one in led.items():
        group = found.setdefault(one.leader, {one.leader: Led(one.leader, Fraction(1), Fraction(0))})
        group[name] = one
    return found


def shared_limits(group: Mapping[str, Led], limits: Mapping[str, Interval]) -> tuple[str, Interval] | None:
    """A turning joint of which all of a group are whole multiples, and its range by the limits of all.

    None where a side is without a limit.  Raises `ValueError`, with what is found, where there is no such
    joint, or no range.

    >>> group = groups({"B": Led("A", Fraction(2), Fraction(0))})["A"]
    >>> shared_limits(group, {"A": (-3, 3), "B": (-1, 1)})
    ('A', (-0.5, 0.5))
    """
    low, high = -math.inf, math.inf
    for name, ends in limits.items():
        multiplier, offset = float(group[name].multiplier), float(group[name].offset)
        first, last = sorted((end - offset) / multiplier for end in ends)
        low, high = max(low, first), min(high, last)
    if not low < high:
        raise ValueError(f"limits of {', '.join(group)} without a common range")
    if not (math.isfinite(low) and math.isfinite(high)):
        return None
    carrier = next(filter(None, _carriers(group)), None)
    if carrier is None:
        raise ValueError(f"limits of {', '.join(group)}, of which none tells where the others are")
    one = group[carrier]
    first, last = sorted(float(one.multiplier) * end + float(one.offset) for end in (low, high))
    return carrier, (first, last)


def _carriers(group: Mapping[str, Led]) -> Iterator[str]:
    """The joints of which all others are whole multiples."""
    for name, one in group.items():
        if all((other.multiplier / one.multiplier).denominator == 1 for other in group.values()):
            yield name


def _limits(robot: Robot, joint: RobotJoint) -> Interval | None:
    """The range of a joint; None where it has none, or both ends are the same and it is not meant."""
    if joint.lower is None or joint.upper is None or joint.lower == joint.upper:
        return None
    if joint.lower > joint.upper:
        found = f"the limits {joint.lower:g} and {joint.upper:g}"
        raise robot.fault(f"joint {joint.name}", found, "the lower limit first")
    return joint.lower, joint.upper
