"""Formulations: how a configuration is described by polynomial variables and equations.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.4; each module names the source of its own coordinates.
"""

from __future__ import annotations

from singsym.kinematics.constraints import constrained
from singsym.kinematics.couplings import coupled
from singsym.kinematics.formulations import joint, natural, planar, spherical
from singsym.kinematics.placement import Placement
from singsym.mechanism.model import Mechanism, Space
from singsym.mechanism.problems import MechanismError, Problem

FORMULATIONS = ("planar", "spherical", "joint", "natural", "quaternion")


def place(mechanism: Mechanism, formulation: str = "auto") -> Placement:
    """The mechanism's variables, loop equations, screws and feasible set in a formulation.

    formulation: "planar" (pins as points), "spherical" (axes as unit vectors), "joint" (angles along a tree),
        "natural" (points and unit vectors), "quaternion" (natural, platforms by quaternions), or "auto": the
        mechanism's own wish; else planar and spherical for mechanisms of those spaces with loops, joint
        otherwise and where links only translate, natural where that does not suit.
    Raises `ValueError` for another name, `MechanismError` where the mechanism cannot be placed.
    """
    chosen = mechanism.formulation if formulation == "auto" else formulation
    if chosen == "auto":
        closed = len(mechanism.joints) >= len(mechanism.links)
        chosen = "joint" if joint.suits(mechanism) else "natural"
        if closed and mechanism.space is not Space.SPATIAL:
            chosen = str(mechanism.space)
        if mechanism.translating:
            chosen = "joint"
    if chosen not in FORMULATIONS:
        raise ValueError(f"formulation {chosen!r}: expected auto, {', '.join(FORMULATIONS)}")
    if mechanism.translating and chosen != "joint":
        found = f"{chosen} for a mechanism with translating links"
        raise MechanismError([Problem("formulation", found, "auto or joint", file=mechanism.origin)])
    if chosen in [*Space] and chosen != mechanism.space:
        found, expected = f"{chosen} for a {mechanism.space} mechanism", "auto, joint or natural"
        raise MechanismError([Problem("formulation", found, expected, file=mechanism.origin)])
    if chosen == "planar":
        placed = planar.place(mechanism)
    elif chosen == "spherical":
        placed = spherical.place(mechanism)
    elif chosen == "joint":
        placed = joint.place(mechanism)
    else:
        placed = natural.place(mechanism, quaternion=chosen == "quaternion")
    return constrained(mechanism, coupled(mechanism, placed))
