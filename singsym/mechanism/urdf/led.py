"""Mimic joints of a chain that follow joints which move: couplings, and where their limits go.

Source: the URDF specification (https://wiki.ros.org/urdf/XML), <mimic>.

A turn is known modulo 2 pi here, while a limited joint and those that follow it turn less than that or more.
So all their limits are put on the one of them of which the others are whole multiples: where that one is,
they are where they are in the file.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
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
    found = {}
    for joint in free.values():
        if joint.mimic is not None and joint.mimic.joint in free:
            led = _led(robot, joint, free)
            if fault := _fault(joint, led, free):
                raise _refused(robot, chain, joint, led, free, *fault)
            found[joint.name] = led
    return found


def _led(robot: Robot, joint: RobotJoint, free: Mapping[str, RobotJoint]) -> Led:
    """What a joint follows in the end, where leaders follow others."""
    multiplier, offset, leader, seen = Fraction(1), Fraction(0), joint, [joint.name]
    while leader.mimic is not None and leader.mimic.joint in free:
        mimic = leader.mimic
        offset += multiplier * Fraction(repr(mimic.offset))
        multiplier *= Fraction(repr(mimic.multiplier))
        leader = free[mimic.joint]
        if leader.name in seen:
            found = f"joints that follow each other: {', '.join(seen)}"
            raise robot.fault(f"joint {joint.name}", found, "one that moves on its own")
        seen.append(leader.name)
    return Led(leader.name, multiplier, offset)


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
    for leader in dict.fromkeys(one.leader for one in led.values()):
        if joints[leader].kind == "prismatic":
            continue
        group = {leader: Led(leader, Fraction(1), Fraction(0))}
        group |= {name: one for name, one in led.items() if one.leader == leader}
        low, high = _common(robot, [joints[name] for name in group], list(group.values()))
        limited = [joints[name] for name in group if joints[name].lower != joints[name].upper]
        cleared = {joint.name: replace(joint, lower=None, upper=None) for joint in limited}
        if math.isfinite(low) and math.isfinite(high):
            carrier = next(filter(None, _carriers(group)), None)
            if carrier is None:
                found = f"limits of {leader} and {', '.join(list(group)[1:])}, none a whole multiple of one"
                raise robot.fault(f"joint {leader}", found, "a ratio that is whole", f"hold {leader}")
            one = group[carrier]
            ends = sorted(float(one.multiplier) * end + float(one.offset) for end in (low, high))
            cleared[carrier] = replace(joints[carrier], lower=ends[0], upper=ends[1])
            notes.append(f"Limits of {', '.join(group)} together are put on {carrier}.")
        joints |= cleared
    return replace(chain, joints=tuple(joints[joint.name] for joint in chain.joints)), tuple(notes)


def _carriers(group: Mapping[str, Led]) -> Iterator[str]:
    """The joints of which all others are whole multiples."""
    for name, one in group.items():
        if all((other.multiplier / one.multiplier).denominator == 1 for other in group.values()):
            yield name


def _common(robot: Robot, joints: Sequence[RobotJoint], group: Sequence[Led]) -> Interval:
    """What the limits of all leave of the leader's values."""
    low, high = -math.inf, math.inf
    for joint, one in zip(joints, group, strict=True):
        if joint.lower is None or joint.upper is None or joint.lower == joint.upper:
            continue
        if joint.lower > joint.upper:
            found = f"the limits {joint.lower:g} and {joint.upper:g}"
            raise robot.fault(f"joint {joint.name}", found, "the lower limit first")
        multiplier, offset = float(one.multiplier), float(one.offset)
        first, last = sorted((end - offset) / multiplier for end in (joint.lower, joint.upper))
        low, high = max(low, first), min(high, last)
    if not low < high:
        names = ", ".join(joint.name for joint in joints)
        raise robot.fault(
            f"joint {joints[0].name}", f"limits of {names} without a common range", "limits that fit"
        )
    return low, high
