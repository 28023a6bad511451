"""Self-motions through a configuration, as a page and as plain data.

Source: what is printed is as `singsym.classes.configuration.self_motions` says.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from singsym.classes.configuration.self_motions import SelfMotion
from singsym.effort.verdict import Known, described
from singsym.output.page import Block, Grid, Page
from singsym.output.pieces import counted
from singsym.varieties.real.curves.real_curve import CurveComponent

_WITHOUT_LIMITS = (
    "Joint limits and exclusions are not looked at: a curve goes on beyond them, a motion may end there."
)


def self_motion_page(found: Sequence[SelfMotion]) -> Page:
    """One line for the inputs at rest, and one for the outputs."""
    lines = [
        f"Self-motion {m}" + ("" if m.dimension is None else f" ({described(m.certainty)})") for m in found
    ]
    blocks: list[Block] = ["\n".join(f"{line}." for line in lines)]
    for m in found:
        if m.curve is not None:
            blocks.append(_ranges(m.held, m.curve.value, described(m.curve.certainty)))
        elif m.untraced:
            blocks.append(f"The curve with the {m.held} at rest is not proven: {m.untraced}.")
    if any(m.curve is not None for m in found):
        blocks.append(_WITHOUT_LIMITS)
    return tuple(blocks)


def _ranges(held: str, curve: CurveComponent, how: str) -> Grid:
    """Between which values the variables are on a curve, from its polylines."""
    line = curve.polyline
    ends = zip(curve.names, np.nanmin(line, axis=0), np.nanmax(line, axis=0), strict=True)
    rows = tuple((name, f"{low:.6g}", f"{high:.6g}") for name, low, high in ends)
    size = "closed" if curve.closed else f"with {counted(curve.ends, 'end')} at infinity"
    crossings = len(curve.singular_points)
    more = f", {counted(crossings, 'singular point')}" if crossings else ""
    title = f"All of the loop equations' curve, the {held} at rest, {size}{more} ({how}); ranges numerical"
    return Grid(("variable", "from", "to"), rows, title)


def self_motion_data(found: Sequence[SelfMotion]) -> list[dict[str, Any]]:
    """The same as plain data."""
    return [
        {
            "held": m.held,
            "null_motions": m.null_motions,
            "dimension": m.dimension,
            "certainty": str(m.certainty),
            "undecided": m.reason or None,
            "curve": None if m.curve is None else _curve_data(m.curve),
            "untraced": m.untraced or None,
        }
        for m in found
    ]


def _curve_data(curve: Known[CurveComponent]) -> dict[str, Any]:
    found = curve.value
    return {
        "certainty": str(curve.certainty),
        "closed": found.closed,
        "limits": "not looked at",
        "variables": list(found.names),
        "polylines": [line.tolist() for line in found.polylines],
    }
