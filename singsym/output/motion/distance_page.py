"""Distances to singularities, as a page and as plain data.

Source: what is printed is as `singsym.motion.distance` says.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from singsym.motion.distance import NearSingularity, SingularityDistance
from singsym.output.page import Block, Grid, Page


def distance_page(found: SingularityDistance) -> Page:
    """Tables of the nearest singularities, the proven clearance and the condition numbers."""
    length = f"{found.length:.4g}"
    blocks: list[Block] = []
    said = f"Nearest singularities by the inputs, in radians, lengths over {length}"
    blocks.append(_table(said, found.joint))
    if found.output:
        blocks.append(_table("Nearest singularities by the output, in its own units", found.output))
    blocks.append(
        "certified: a singular configuration is proven to be no farther away; nearer ones may be missed. "
        "That a straight line reaches it is seen numerically; limits are not regarded."
    )
    if found.clear is None:
        blocks.append("No clearance is proven: no box of the inputs was seen to be free.")
    else:
        blocks.append(f"Proven: no singularity while the inputs keep nearer than {_floor(found.clear)}.")
    numbers = ", ".join(f"{name} {value:.4g}" for name, value in found.condition_numbers.items())
    blocks.append(f"Condition numbers, lengths over {length}: {numbers}.")
    if found.remarks:
        blocks.append("\n".join(f"Note: {remark}." for remark in found.remarks))
    return tuple(blocks)


def _table(title: str, nearest: Mapping[str, NearSingularity]) -> Grid:
    rows = tuple(
        (
            kind,
            f"{near.distance:.6g}",
            "yes" if near.certified else "no",
            f"{near.types}" if near.types_certified else f"{near.types}, numerically",
            near.words,
            _direction(near.away),
        )
        for kind, near in nearest.items()
    )
    return Grid(("type", "distance", "certified", "types there", "where", "leads away"), rows, title)


def _direction(away: Mapping[str, float]) -> str:
    return ", ".join(f"{label} {x:+.3f}" for label, x in away.items() if abs(x) >= 5e-4)


def _floor(number: float) -> str:
    """Four digits, rounded down, as is right of a bound from below."""
    text = f"{number:.3e}"
    if float(text) > number:
        text = f"{number - 10.0 ** (int(text.partition('e')[2]) - 3):.3e}"
    return f"{float(text):.4g}"


def distance_data(found: SingularityDistance) -> dict[str, Any]:
    """The same as plain data."""
    return {
        "joint": {kind: _near_data(near) for kind, near in found.joint.items()},
        "output": {kind: _near_data(near) for kind, near in found.output.items()},
        "clear": found.clear,
        "length": found.length,
        "condition_numbers": {
            name: None if value == float("inf") else value for name, value in found.condition_numbers.items()
        },
        "remarks": list(found.remarks),
    }


def _near_data(near: NearSingularity) -> dict[str, Any]:
    return {
        "distance": near.distance,
        "certified": near.certified,
        "types": list(near.types.names),
        "types_certified": near.types_certified,
        "where": near.words,
        "away": dict(near.away),
        "variables": dict(near.values),
        "points": {name: list(place) for name, place in near.points.items()},
        "joints": dict(near.joints),
    }
