"""The regions of a mechanism of two degrees of freedom, found on a grid of the inputs.

Source: singsym's own; of each region one configuration and the signs of the borders are certified, so that
regions with other signs are proven to be two.  Which configurations belong together is numerical.
"""

from __future__ import annotations

from collections import defaultdict
from itertools import combinations

import networkx as nx
import numpy as np

from singsym.effort import patience, progress
from singsym.effort.budget import current
from singsym.effort.verdict import Verdict
from singsym.kinematics.sampling import sample_configurations
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.enclosures import sure_sign
from singsym.motion.regions.flood import SAMPLES, Flood, axes_of
from singsym.motion.regions.free_motion import FreeMotions
from singsym.motion.regions.result import Region, Regions, Wall
from singsym.motion.regions.walls import wall

_CORNER = 4
"""So few cells are a corner that a step went around, not a region."""
_TRIES = 5
"""Configurations of a region that are tried, until one is proven, the farthest from borders first."""


def chart(motions: FreeMotions, grid: int, seed: int = 0) -> Regions:
    """The regions over the inputs; grid: cells along each.

    Raises `MechanismError` where no configuration is found.
    """
    borders, equation = motions.borders, motions.borders.equation
    starts = np.array(sample_configurations(equation.space, SAMPLES, seed))
    if not len(starts):
        raise MechanismError([Problem("regions", "no configuration", "a mechanism that can be assembled")])
    flood = Flood(motions, axes_of(motions, starts, grid))
    progress.report("regions", f"a grid of {grid} cells along each input")
    flood.fill(starts)
    assemblies = np.zeros((grid, grid))
    for cell, nodes in flood.over.items():
        assemblies[cell] = len(nodes)
    groups = sorted((sorted(g) for g in nx.connected_components(flood.free)), key=lambda g: (-len(g), g))
    found = (_region(motions, flood, nodes) for nodes in groups if len(nodes) > _CORNER)
    axes = tuple(axis * unit for axis, unit in zip(flood.axes, motions.space.units, strict=True))
    verdict = Verdict.undecided("found on a grid of the inputs: small regions and narrow ways may be missed")
    regions = tuple(region for region in found if region is not None)
    with current().part(patience.ALL_WALLS.work):
        walls = _walls(motions, regions)
    return Regions(equation, borders.all, regions, verdict, walls, axes, assemblies)


def _walls(motions: FreeMotions, regions: tuple[Region, ...]) -> tuple[tuple[Wall, tuple[int, ...]], ...]:
    """Between any two regions with the same signs a wall, where one is proven in time."""
    found: list[tuple[Wall, tuple[int, ...]]] = []
    for one, other in combinations(range(len(regions)), 2):
        first, second = regions[one], regions[other]
        if first.signs != second.signs or any(sides[one] * sides[other] < 0 for _, sides in found):
            continue
        if current().is_worked_off():
            break
        progress.report("regions", f"whether regions {one + 1} and {other + 1} are apart")
        between = wall(motions, first.signs, first.points, second.points)
        if between is not None:
            found.append((between, tuple(_side(motions, between, region) for region in regions)))
    return tuple(found)


def _side(motions: FreeMotions, between: Wall, region: Region) -> int:
    """The sign of a wall's polynomial in a region, where it keeps it; 0 where that is not known."""
    near = motions.near(np.array(list(region.values.values()))) if region.signs == between.signs else None
    return 0 if near is None else sure_sign(between.polynomial, near)


def _region(motions: FreeMotions, flood: Flood, nodes: list[int]) -> Region | None:
    """What is known of the region of some nodes; None where no configuration of it is proven."""
    met: dict[int, int] = defaultdict(int)
    for node in nodes:
        for k in flood.met[node]:
            met[k] += 1
    for node in sorted(nodes, key=flood.margin, reverse=True)[:_TRIES]:
        place = motions.place(flood.points[node])
        signs = () if place is None else motions.borders.signs(place.near)
        if place is not None and all(signs):
            return Region(
                *motions.named(place.point),
                signs,
                tuple(b for k, b in enumerate(motions.borders.all) if met[k]),
                np.array([flood.points[k] for k in nodes]),
                np.array([flood.cells[k] for k in nodes]),
            )
    return None
