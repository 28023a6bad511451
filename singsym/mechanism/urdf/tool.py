"""The output of an arm: which components of its tip's twist are as many as its joints.

Source: singsym's own. Ranks of velocities at a few configurations find what is offered; they prove nothing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy

from singsym.mechanism.choices import Choice
from singsym.mechanism.expressions import expression
from singsym.mechanism.model import Mechanism, Output, PointVelocity, Space, Twist
from singsym.mechanism.outputs import TWISTS, coordinates
from singsym.mechanism.urdf.arm import TOOL
from singsym.mechanism.urdf.chains import Chain
from singsym.mechanism.urdf.led import Led
from singsym.mechanism.urdf.robot_file import Robot

_ORDER = ("vx", "vy", "vz", "wz", "wx", "wy")
"""In which components are offered: the velocity first, and a turn about the vertical before others."""
_TOLERANCE = 1e-6
_SEEDS = (1, 2, 3)


def tool_output(
    robot: Robot,
    chain: Chain,
    held: Mapping[str, Any],
    led: Mapping[str, Led],
    mechanism: Mechanism,
    choice: Choice,
) -> tuple[Output, str]:
    """The output and what is to be said of it.

    choice: where it names components, the output is the whole twist, from which they are taken.
    Raises `MechanismError` where it is not clear what is meant, with calls that would work.
    """
    link = mechanism.link(_carrier(mechanism)).name
    twist = TWISTS[Space.SPATIAL]
    if choice.components:
        return Twist(link, TOOL, twist), ""
    n = len(mechanism.inputs)
    columns = [_columns(chain, held, led, seed) for seed in _SEEDS]
    rank = max(_rank(rates) for rates in columns)
    if rank < n and choice.redundant and not led:
        n = rank
    if rank < n:
        raise _redundant(robot, chain, held, led, rank, columns)
    if n == len(twist):
        return Twist(link, TOOL, twist), ""
    velocity = [twist.index(name) for name in ("vx", "vy", "vz")]
    if n == len(velocity) and max(_rank(rates[velocity]) for rates in columns) == n:
        return PointVelocity(link, TOOL, coordinates(Space.SPATIAL)), ""
    moving = [i for i in range(6) if any(np.abs(rates[i]).max() > _TOLERANCE for rates in columns)]
    if len(moving) == n:
        names = tuple(twist[i] for i in moving)
        return Twist(link, TOOL, names), f"Output: {', '.join(names)}, all that the tip can do."
    offered = ",".join(_independent(columns, n))
    moves = len(mechanism.inputs)
    found = f"{moves} moving joint{'s' * (moves > 1)} and no output components"
    expected = f"{n} names among {', '.join(twist)}"
    raise robot.fault("components", found, expected, f"choose what the arm is for, as --components {offered}")


def _carrier(mechanism: Mechanism) -> str:
    return next(link.name for link in reversed(mechanism.links) if TOOL in link.points)


def _columns(chain: Chain, held: Mapping[str, Any], led: Mapping[str, Led], seed: int) -> Any:
    """The tip's twist, a column for each joint that moves on its own, velocities in the arm's own length."""
    values = {name: float(sympy.N(expression(value))) for name, value in held.items()}
    rates = np.array(columns_of(chain, values, seed, led)).T
    reach = max(float(np.abs(rates[3:]).max()), 1e-3)
    rates[3:] /= reach
    free = [joint for joint in chain.moving if joint.name not in values]
    rates[:, [joint.kind == "prismatic" for joint in free]] *= reach
    names = [joint.name for joint in free]
    for name, one in led.items():
        rates[:, names.index(one.leader)] += float(one.multiplier) * rates[:, names.index(name)]
    return rates[:, [name not in led for name in names]]


def _rank(rates: Any) -> int:
    return int(np.linalg.matrix_rank(rates, tol=_TOLERANCE))


def _independent(columns: Sequence[Any], count: int) -> list[str]:
    """Components, in the order in which they are offered, that are independent somewhere."""
    twist = TWISTS[Space.SPATIAL]
    chosen: list[str] = []
    for name in _ORDER:
        rows = [twist.index(other) for other in (*chosen, name)]
        if len(chosen) < count and max(_rank(rates[rows]) for rates in columns) == len(rows):
            chosen.append(name)
    return chosen


def _redundant(
    robot: Robot,
    chain: Chain,
    held: Mapping[str, Any],
    led: Mapping[str, Led],
    rank: int,
    columns: Sequence[Any],
) -> Exception:
    """More joints than independent velocities: which to hold, and what then is the output."""
    free = [joint for joint in chain.moving if joint.name not in held and joint.name not in led]
    kept = _kept(columns, len(free), rank)
    offered = " ".join(
        f"--lock {joint.name}={joint.resting}" for place, joint in enumerate(free) if place not in kept
    )
    reduced = [rates[:, sorted(kept)] for rates in columns]
    if rank < 6 and not (rank == 3 and max(_rank(rates[3:]) for rates in reduced) == 3):
        offered += f" --components {','.join(_independent(reduced, rank))}"
    where = "in every configuration" if len(free) > 6 else "at all configurations tried"
    found = f"{len(free)} moving joints, of a tip with {rank} independent velocities: RI {where}"
    expected = "as many joints as velocities, for the 21 classes"
    before = " ".join(f"--lock {name}={value}" for name, value in held.items())
    holds = f"{before} {offered}" if before else offered
    advice = f"hold the others, as {holds}"
    if not led:
        advice += "; `singsym conditions` says where IO holds without that"
    return robot.fault("joints", found, expected, advice)


def _kept(columns: Sequence[Any], count: int, rank: int) -> list[int]:
    """Places of `rank` joints with independent velocities, of `count`.

    Of seven joints the third goes, the roll of an upper arm, as is usual; else those near the base go.
    """
    usual = [place for place in range(count) if place != 2]
    if count == rank + 1 == 7 and max(_rank(rates[:, usual]) for rates in columns) == rank:
        return usual
    kept: list[int] = []
    for place in reversed(range(count)):
        if max(_rank(rates[:, [*kept, place]]) for rates in columns) == len(kept) + 1:
            kept.append(place)
    return kept


def columns_of(
    chain: Chain, values: Mapping[str, float], seed: int, led: Mapping[str, Led] | None = None
) -> list[list[float]]:
    """The columns (wx, wy, wz, vx, vy, vz) of the tip's twist for each moving joint, in floats.

    values: of the joints that are held, by name, which have no column; the others are where `seed` says, but
        for those that are `led`.
    """
    drawn = {j.name: 0.3 + 2.7 * math.fmod(n * seed * 0.618, 1) for n, j in enumerate(chain.joints, 1)}
    places = {**drawn, **values}
    for name, one in (led or {}).items():
        places[name] = float(one.multiplier) * places[one.leader] + float(one.offset)
    frame, place = np.eye(3), np.zeros(3)
    found = []
    for joint in chain.joints:
        place = place + frame @ np.array(joint.xyz)
        for axis, angle in zip(np.eye(3)[::-1], reversed(joint.rpy), strict=True):
            frame = frame @ _turn(axis, angle)
        if joint.kind == "fixed":
            continue
        axis = frame @ (np.array(joint.axis) / math.hypot(*joint.axis))
        value = places[joint.name]
        if joint.name not in values:
            found.append((joint.kind == "prismatic", axis, place))
        if joint.kind == "prismatic":
            place = place + value * axis
        else:
            frame = _turn(axis, value) @ frame
    zero = np.zeros(3)
    return [
        [float(x) for x in ((*zero, *u) if slides else (*u, *np.cross(u, place - p)))]
        for slides, u, p in found
    ]


def _turn(axis: Any, angle: float) -> Any:
    """Rodrigues' rotation about a unit vector."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
