"""Gough platforms with distinct or coincident points, for tests."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from singsym.mechanism import Mechanism, define

Place = tuple[int, int, int]

SIX_THREE: tuple[list[Place], list[Place]] = (
    [(0, 0, 0), (4, 0, 0), (6, 2, 1), (4, 5, 0), (1, 6, -1), (-1, 3, 0)],
    [(0, 0, 0), (0, 0, 0), (2, 0, 0), (2, 0, 0), (1, 2, 0), (1, 2, 0)],
)
"""Six points of the base, three of the platform, two legs at each."""

THREE_THREE: tuple[list[Place], list[Place]] = (
    [(0, 0, 0), (5, 0, 0), (5, 0, 0), (1, 4, 0), (1, 4, 0), (0, 0, 0)],
    [(0, 0, 0), (0, 0, 0), (2, 0, 0), (2, 0, 0), (1, 2, 0), (1, 2, 0)],
)
"""An octahedron: three points of each, each with two legs."""


def gough(base: Sequence[Place], platform: Sequence[Place]) -> Mechanism:
    """Six legs S-P-S between points of the ground and of a platform, their lengths the inputs."""
    legs = range(1, 7)
    links: dict[str, Any] = {
        "ground": {"points": {f"A{i}": list(place) for i, place in zip(legs, base, strict=True)}},
        "platform": {"points": {f"B{i}": list(place) for i, place in zip(legs, platform, strict=True)}},
    }
    joints: dict[str, Any] = {}
    for i in legs:
        links[f"lower{i}"] = {"points": {f"A{i}": [0, 0, 0]}, "axes": {f"u{i}": [0, 0, 1]}}
        links[f"upper{i}"] = {"points": {f"B{i}": [0, 0, 0]}, "axes": {f"u{i}": [0, 0, 1]}}
        slide = {"type": "P", "links": [f"lower{i}", f"upper{i}"], "at": [f"A{i}", f"B{i}"], "axis": f"u{i}"}
        joints[f"P{i}"] = slide
        joints[f"A{i}"] = {"type": "S", "links": ["ground", f"lower{i}"]}
        joints[f"B{i}"] = {"type": "S", "links": ["platform", f"upper{i}"]}
    return define(
        name="gough",
        space="spatial",
        inputs=[f"P{i}" for i in legs],
        output={"twist": "platform", "at": "B1"},
        links=links,
        joints=joints,
        exclusions={f"leg {i} of length zero": {"coincide": [f"A{i}", f"B{i}"]} for i in legs},
    )
