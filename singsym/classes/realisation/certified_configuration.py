"""A certified point as a configuration in decimals: coordinates, named points and joint values.

Source: interval arithmetic; the error of each number is bounded.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from flint import arb

from singsym.classes.result import Configuration
from singsym.kinematics.placement import Coordinates, JointValue
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.intervals import at_precision, evaluate

DIGITS = 24
"""Of decimals inside, more than are reported, so that they can be turned to another unit."""
_BITS = 80


@dataclass(frozen=True)
class Names:
    """What a configuration is reported in: named points of space, and the joints' values."""

    points: Mapping[str, Coordinates] = field(default_factory=dict)
    joints: Mapping[str, JointValue] = field(default_factory=dict)


def configuration(point: RealPoint | BoxPoint, names: Names) -> Configuration:
    """A point as decimal strings of `DIGITS` digits, with a bound on their error.

    Coordinates of the configuration space, of the named points, and joint values: angles in radians.
    """
    box = point.refine(_BITS).box
    with at_precision(_BITS + 64):
        coordinates = dict(zip(point.ring.names, box, strict=True))
        points = {
            f"{name}.{axis}": evaluate(value, box)
            for name, place in names.points.items()
            for axis, value in zip("xyz", place, strict=False)
        }
        joints = {}
        for name, value in names.joints.items():
            found = joint_ball(value, box)
            if found is not None:
                joints[name] = found
        tables = [_decimals(table) for table in (coordinates, points, joints)]
        radius = max((r for _, r in tables), default=0.0)
    return Configuration(tables[0][0], tables[1][0], tables[2][0], f"{radius:.1e}")


def joint_ball(value: JointValue, box: tuple[arb, ...]) -> arb | None:
    """A ball around a joint's value over balls of the coordinates; None where it is not told."""
    if value.length is not None:
        return evaluate(value.length, box)
    if value.square is not None:
        return evaluate(value.square, box).sqrt()
    if value.cosine is not None and value.sine is not None:
        sine, cosine = evaluate(value.sine, box), evaluate(value.cosine, box)
        if cosine < 0 and sine.contains(0):
            # atan2 jumps here between pi and -pi, and its ball would hold both
            return arb.pi() + arb.atan2(-sine, -cosine)
        return arb.atan2(sine, cosine)
    return None


def _decimals(table: Mapping[str, arb]) -> tuple[dict[str, str], float]:
    """Rounded midpoints, and a bound on the distance of each from the exact value."""
    shown: dict[str, str] = {}
    worst = 0.0
    for name, value in table.items():
        shown[name] = value.mid().str(DIGITS, radius=False)
        error = abs(value - arb(shown[name]))
        worst = max(worst, float(error.upper()))
    return shown, worst * (1 + 1e-9)
