"""Singularity-free regions, joined configurations and free boxes, as pages and as plain data.

Source: what is printed is as `singsym.motion.regions` says.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from math import degrees
from typing import Any

from singsym.kinematics.velocity import VelocityEquation
from singsym.motion.regions.free_box import FreeBox
from singsym.motion.regions.joined import Joined
from singsym.motion.regions.result import Region, Regions
from singsym.output.page import Block, Grid, Page
from singsym.output.pieces import counted

_SIGNS = {1: "+", -1: "-", 0: "?"}
_LONGEST = 30
"""Rows of the table; pairs that are not known to be apart are not listed beyond that."""


def regions_page(name: str, found: Regions) -> Page:
    """How many regions there are, what bounds them, and a configuration of each."""
    equation, count = found.equation, len(found.regions)
    blocks: list[Block] = [f"{name}: N = {equation.N}, n = {equation.n}"]
    many = f"{counted(count, 'region')} without singularities"
    if found.verdict.is_yes:
        blocks.append(f"{many}, {found.verdict.certainty}: {found.verdict.reason}.")
    else:
        least = f"; {found.at_least} at least, proven" if count else ""
        blocks.append(f"{many} found{least}.  Undecided whether these are all: {found.verdict.reason}.")
    lines = [f"  {k}  {border}" for k, border in enumerate(found.borders, 1)]
    if lines:
        blocks.append("\n".join(("Signs are those of", *lines)))
    if any(not border.is_singular for border in found.borders):
        blocks.append(
            "Limits and exclusions are barriers, not singularities: none of the six types is there."
        )
    if found.regions:
        headers = ("region", "share" if found.axes else "arc", "a configuration of it", "signs", "ends at")
        rows = (_row(k, r, found) for k, r in enumerate(found.regions[:_LONGEST], 1))
        blocks.append(Grid(headers, tuple(rows)))
    if count > _LONGEST:
        blocks.append(f"{count - _LONGEST} smaller regions are not shown; JSON has all.")
    open_pairs = [
        f"{a + 1} and {b + 1}"
        for a, b in combinations(range(min(count, _LONGEST)), 2)
        if found.apart(a, b).is_undecided
    ]
    if open_pairs:
        blocks.append(f"Not known whether joined: {', '.join(open_pairs)}.")
    return tuple(blocks)


def _row(number: int, region: Region, found: Regions) -> tuple[str, ...]:
    signs = "".join(_SIGNS[s] for s in region.signs)
    ends = ", ".join(str(k) for k, b in enumerate(found.borders, 1) if b in region.ends)
    share = f"{100 * _share(region, found):.1f} %" if found.axes else f"{len(region.points)} vertices"
    inputs = {k: v for k, v in region.joints.items() if k in found.inputs or not found.axes}
    return (
        str(number),
        share,
        ", ".join(_values(inputs, found.equation)),
        signs,
        ends or ("none seen" if found.axes else "nothing"),
    )


def _share(region: Region, found: Regions) -> float:
    """The part of the grid's cells over which a region is."""
    cells = len({tuple(cell) for cell in region.cells.tolist()})
    size = 1
    for axis in found.axes:
        size *= len(axis)
    return cells / size


def _values(values: Mapping[str, float], equation: VelocityEquation) -> Iterator[str]:
    for label, value in values.items():
        known = equation.values.get(label)
        angle = known is not None and known.cosine is not None
        yield f"{label} = {degrees(value):.4g} deg" if angle else f"{label} = {value:.5g}"


def regions_data(name: str, found: Regions) -> dict[str, Any]:
    """The same as plain data."""
    return {
        "mechanism": name,
        "n": found.equation.n,
        "verdict": {
            "answer": str(found.verdict.answer),
            "certainty": found.verdict.certainty,
            "reason": found.verdict.reason,
        },
        "at_least": found.at_least,
        "borders": [
            {"condition": b.condition, "singular": b.is_singular, "where": b.words} for b in found.borders
        ],
        "regions": [
            {
                "joints": dict(r.joints),
                "variables": dict(r.values),
                "signs": list(r.signs),
                "ends": [k for k, b in enumerate(found.borders) if b in r.ends],
                "share": _share(r, found) if found.axes else None,
            }
            for r in found.regions
        ],
    }


def joined_page(name: str, found: Joined) -> Page:
    """Whether two configurations are joined, and by which motion."""
    said = {"yes": "Joined", "no": "Not joined", "undecided": "Undecided whether joined"}
    blocks: list[Block] = [name, f"{said[found.verdict.answer]} without a singularity: {found.verdict}."]
    if found.path is not None:
        rows = zip(*found.path.values.values(), strict=True)
        body = tuple(tuple(f"{round(x, 9):.6g}" for x in row) for row in rows)
        title = "Straight between these values of the inputs, in radians and lengths"
        blocks.append(Grid(found.path.labels, body, title))
    return tuple(blocks)


def joined_data(name: str, found: Joined) -> dict[str, Any]:
    """The same as plain data."""
    path = found.path
    return {
        "mechanism": name,
        "joined": str(found.verdict.answer),
        "certainty": found.verdict.certainty,
        "reason": found.verdict.reason,
        "boxes": found.boxes,
        "path": None if path is None else {label: v.tolist() for label, v in path.values.items()},
        "apart": None if found.apart is None else str(found.apart),
    }


def box_page(name: str, found: FreeBox) -> Page:
    """The box around a configuration."""
    rows = tuple(
        (label, f"{low:.6g}", f"{found.centre[label]:.6g}", f"{high:.6g}")
        for label, (low, high) in found.inputs.items()
    )
    length = f"{found.length:.4g}"
    return (
        name,
        Grid(("input", "from", "at", "to"), rows, "Free of singularities, in radians and lengths"),
        f"Certified, in {found.boxes} boxes: while the inputs stay inside, the mechanism meets no "
        "singularity, no limit and no exclusion.  A larger box may be free as well.",
        f"The nearest face is {found.clear:.4g} away, in radians, lengths over {length}.",
    )


def box_data(name: str, found: FreeBox) -> dict[str, Any]:
    """The same as plain data."""
    return {
        "mechanism": name,
        "centre": dict(found.centre),
        "inputs": {label: list(ends) for label, ends in found.inputs.items()},
        "clear": found.clear,
        "length": found.length,
        "variables": {label: list(ends) for label, ends in found.variables.items()},
        "boxes": found.boxes,
        "tests": found.tests,
    }
