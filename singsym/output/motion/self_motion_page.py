"""Self-motions through a configuration, as a page and as plain data.

Source: what is printed is as `singsym.classes.configuration.self_motions` says.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from singsym.classes.configuration.self_motions import SelfMotion
from singsym.effort.verdict import described
from singsym.output.page import Page


def self_motion_page(found: Sequence[SelfMotion]) -> Page:
    """One line for the inputs at rest, and one for the outputs."""
    lines = [
        f"Self-motion {m}" + ("" if m.dimension is None else f" ({described(m.certainty)})") for m in found
    ]
    return ("\n".join(f"{line}." for line in lines),)


def self_motion_data(found: Sequence[SelfMotion]) -> list[dict[str, Any]]:
    """The same as plain data."""
    return [
        {
            "held": m.held,
            "null_motions": m.null_motions,
            "dimension": m.dimension,
            "certainty": str(m.certainty),
            "undecided": m.reason or None,
        }
        for m in found
    ]
