"""The regions of a mechanism of two degrees of freedom, found on a grid of the inputs.

Source: singsym's own; of each region one configuration and the signs of the borders are certified, so that
regions with other signs are proven to be two.  That they are all is proven by slices, as in
`singsym.motion.regions.completeness`.  Which configurations belong together is numerical.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from itertools import combinations

import networkx as nx
import numpy as np

from singsym.effort import patience, progress
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Verdict
from singsym.kinematics.sampling import sample_configurations
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.enclosures import sure_sign
from singsym.motion.regions.completeness import Gathering, Sampled, sampled
from singsym.motion.regions.flood import SAMPLES, Flood, axes_of
from singsym.motion.regions.free_motion import FreeMotions, Place
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
    equation = motions.borders.equation
    with current().part(patience.ALL_REGIONS.work):
        known, doubt = _sampled(motions)
        places = known.places if known else ()
        starts = np.array([*sample_configurations(equation.space, SAMPLES, seed), *(p.point for p in places)])
        if not len(starts):
            raise MechanismError(
                [Problem("regions", "no configuration", "a mechanism that can be assembled")]
            )
        flood = Flood(motions, axes_of(motions, starts, grid))
        progress.report("regions", f"a grid of {grid} cells along each input")
        flood.fill(starts)
        shown = _on_grid(motions, flood)
        gathering = Gathering(motions, flood, [place for _, place in shown])
        gathering.gather(places)
    found = (*(region for region, _ in shown), *(_small(motions, flood, p) for p in gathering.new))
    with current().part(patience.ALL_WALLS.work):
        walls = _walls(motions, found)
    assemblies = np.zeros((grid, grid))
    for cell, nodes in flood.over.items():
        assemblies[cell] = len(nodes)
    axes = tuple(axis * unit for axis, unit in zip(flood.axes, motions.space.units, strict=True))
    verdict = Verdict.undecided(doubt)
    result = Regions(equation, motions.borders.all, found, verdict, walls, axes, assemblies)
    return replace(result, verdict=_verdict(result, known, gathering.open)) if known else result


def _sampled(motions: FreeMotions) -> tuple[Sampled | None, str]:
    """A configuration of each region, or why it is not proven that none is missing."""
    try:
        return sampled(motions), ""
    except (Undecided, ValueError) as reason:
        return None, f"small regions and narrow ways may be missed on a grid of the inputs; {reason}"


def _verdict(result: Regions, known: Sampled, left: int) -> Verdict:
    """Whether the regions are all, and no two the same; left: arcs that are not known to be in one."""
    arcs = f"each has an arc of {known.words}"
    if left:
        return Verdict.undecided(f"{arcs}, and of {left} arcs it is not proven that they are in these")
    if result.at_least < len(result.regions):
        return Verdict.undecided(f"there are no others, for {arcs}, but some of these may be one")
    return Verdict.yes(known.certainty, reason=f"all, for {arcs}, and all {len(known.places)} are in these")


def _small(motions: FreeMotions, flood: Flood, place: Place) -> Region:
    """A region of which the grid shows nothing."""
    cell = flood.cell(motions.space.at(place.point)[0])
    named, signs = motions.named(place.point), motions.borders.signs(place.near)
    return Region(*named, signs, (), place.point[None], np.array([cell]))


def _on_grid(motions: FreeMotions, flood: Flood) -> list[tuple[Region, Place]]:
    """The regions that the grid shows, large ones first, with a configuration of each that is proven."""
    groups = sorted((sorted(g) for g in nx.connected_components(flood.free)), key=lambda g: (-len(g), g))
    found = (_region(motions, flood, nodes) for nodes in groups if len(nodes) > _CORNER)
    return [pair for pair in found if pair is not None]


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


def _region(motions: FreeMotions, flood: Flood, nodes: list[int]) -> tuple[Region, Place] | None:
    """What is known of the region of some nodes; None where no configuration of it is proven."""
    met: dict[int, int] = defaultdict(int)
    for node in nodes:
        for k in flood.met[node]:
            met[k] += 1
    for node in sorted(nodes, key=flood.margin, reverse=True)[:_TRIES]:
        place = motions.place(flood.points[node])
        signs = () if place is None else motions.borders.signs(place.near)
        if place is not None and all(signs):
            ends = tuple(b for k, b in enumerate(motions.borders.all) if met[k])
            points, cells = ([own[k] for k in nodes] for own in (flood.points, flood.cells))
            region = Region(*motions.named(place.point), signs, ends, np.array(points), np.array(cells))
            return region, place
    return None
