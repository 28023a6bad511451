"""Modules in terms of kinematics: cranks, dyads, triads, legs.

Source: Galletti, A note on modular approaches to planar linkage kinematic analysis, Mech. Mach. Theory 21
(1986) 385-391, for Assur groups.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from singsym.kinematics.modules.places import Meeting, Places
from singsym.mechanism.model import JointKind, Space, Twist


@dataclass(frozen=True)
class Part:
    """What is placed by one module, and how it hangs together.

    told: the link or point whose own coordinates the output gives, else ""; whole: whether all of the output.
    outer, inner: where its links meet what is placed before, and where only each other; with these links.
    """

    links: tuple[str, ...]
    unknowns: int
    driven: tuple[str, ...]
    told: str
    whole: bool
    outer: tuple[Meeting, ...]
    inner: tuple[Meeting, ...]


def words(part: Part, places: Places, driven_link: str) -> str:
    """A module in words; driven_link: what a link that is driven at the ground is called."""
    if part.told:
        return _told(part, places)
    start = f" from {listed([m.name for m in part.outer])}" if part.outer else ""
    text = f"module of {part.unknowns} unknown{'' if part.unknowns == 1 else 's'}{start}"
    if part.driven:
        return _driven(part, places, driven_link) or f"{text}, driven by {listed(part.driven)}"
    if places.mechanism.space is Space.PLANAR:
        text = _assur_group(part) or text
    legs = [k for k, leg in enumerate(places.legs, 1) if part.links and leg.issuperset(part.links)]
    return f"leg {legs[0]}: {text}" if legs else text


def _told(part: Part, places: Places) -> str:
    """A link or a point whose coordinates the output gives, and the legs that this places."""
    turning = any(isinstance(o, Twist) and o.link == part.told for o in places.mechanism.outputs)
    size = 2 if places.mechanism.space is Space.PLANAR else 3
    if not part.whole or (len(part.driven) < size and not turning):
        return listed(part.driven)
    what = f"{'output link' if turning else 'point'} {part.told}"
    legs = [str(k) for k, leg in enumerate(places.legs, 1) if leg.issubset(part.links)]
    return f"{what}, and with it leg{'s' if len(legs) > 1 else ''} {listed(legs)}" if legs else what


def _driven(part: Part, places: Places, driven_link: str) -> str:
    """One link that one joint moves, or the value of one joint; "" for anything else."""
    joint = next((j for j in places.mechanism.joints if {*part.driven} & {*j.columns}), None)
    if joint is None or len(part.driven) > 1 or len(part.links) > 1:
        return ""
    if not {*part.links} <= {joint.first, joint.second}:
        return ""
    if joint.kind is JointKind.P:
        return f"slide {joint.name}"
    if not part.links:
        return f"joint {part.driven[0]}"
    text = f"{part.links[0]} at {joint.name}"
    is_crank = places.is_closed and places.mechanism.ground in (joint.first, joint.second)
    return f"{driven_link} {text}" if is_crank and part.links[0] != driven_link else text


def _assur_group(part: Part) -> str:
    """Links in the plane whose joints leave them no freedom: two for each three joints; else ""."""
    count = len(part.links)
    outside, inside = sum(len(m.links) for m in part.outer), sum(len(m.links) - 1 for m in part.inner)
    if not count or 2 * (outside + inside) != 3 * count:
        return ""
    names, start = listed([m.name for m in part.inner]), f"from {listed([m.name for m in part.outer])}"
    if count == 2:
        sliding = any(m.kind is not JointKind.R for m in (*part.outer, *part.inner))
        return f"{'slider dyad' if sliding else 'dyad'} {names} {start}"
    if (count, outside, inside) == (4, 3, 3):
        return f"triad {names} {start}, {part.unknowns} unknowns"
    return f"Assur group of {count} links {start}, {part.unknowns} unknowns"


def listed(names: Sequence[str], word: str = "and") -> str:
    """Names in a sentence.

    >>> listed(["A", "B", "C"])
    'A, B and C'
    """
    return f" {word} ".join(filter(None, (", ".join(names[:-1]), *names[-1:])))
