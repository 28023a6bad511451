"""Whether the regions that were found for n = 2 are all: each arc of the slices is joined to one of them.

Source: the lemma of `singsym.motion.regions.slices`; paths are found on a grid, and proven as in
`singsym.motion.regions.joined`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import networkx as nx
import numpy as np

from singsym.effort import progress
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Certainty, weakest
from singsym.motion.regions.arcs import Arcs
from singsym.motion.regions.flood import Flood
from singsym.motion.regions.free_motion import FreeMotions, Place
from singsym.motion.regions.slices import Slices
from singsym.polynomials.compiled_map import Floats

_STRAIGHT = 6
"""So many places near one that the grid does not reach are tried straight."""
_SHARES = 12
"""Steps of a straight motion, of some parts each, in which borders are looked for before it is proven."""
_NARROW = 1e-2
"""What is added to a margin, so that paths take no long ways round for a wider one."""


@dataclass(frozen=True)
class Sampled:
    """At least one configuration of each region.

    words: how they were found; certainty: that no region is without one.
    """

    places: tuple[Place, ...]
    words: str
    certainty: Certainty


def sampled(motions: FreeMotions) -> Sampled:
    """A configuration on each arc of the slices; raises `Undecided` where these may not meet all regions."""
    chosen = _slices(motions)
    places: list[Place] = []
    certainty = weakest("certified", chosen.certainty)
    label, count = motions.space.labels[chosen.number], len(chosen.slices)
    for number, own in enumerate(chosen.slices):
        progress.report("regions", f"arcs of a slice at a value of {label}", number, count)
        arcs = Arcs(motions, own)
        places += arcs.places()
        certainty = weakest(certainty, arcs.certainty)
    return Sampled(tuple(places), f"{count} slice{'' if count == 1 else 's'} at values of {label}", certainty)


def _slices(motions: FreeMotions) -> Slices:
    """The slices by the input of which the fewest are needed."""
    found: list[Slices] = []
    reason = Undecided("no input can be held")
    for number in range(len(motions.space.labels)):
        own = Slices(motions.borders, motions.space, number)
        try:
            own.slices  # noqa: B018
        except Undecided as why:
            reason = why
            continue
        found.append(own)
    if not found:
        raise reason
    return min(found, key=lambda own: len(own.slices))


class Gathering:
    """Places that are joined, one by one, to those that stand for the regions.

    joined: those that are proven to be in a region of one that stood for it at the beginning, and these;
    new: others, which stand for regions of their own; open: how many the grid, but no proof, joins to others.
    """

    def __init__(self, motions: FreeMotions, flood: Flood, kept: Sequence[Place]) -> None:
        self.motions, self.flood, self.joined = motions, flood, list(kept)
        self.new: list[Place] = []
        self.open = 0
        self._known_signs: dict[int, tuple[int, ...]] = {}

    def gather(self, places: Sequence[Place]) -> None:
        """Join all that can be joined."""
        kept, entered = self._entered(self.joined), self._entered(places)
        left = list(places)
        for part in nx.connected_components(self.flood.free):
            known = {node: p for node, p in kept if node in part}
            own = [(node, p) for node, p in entered if node in part]
            if known:
                left = [p for p in left if all(p is not other for _, other in own)]
                self._along_grid(known, own)
        while found := [p for p in left if self._straight(p, self.joined)]:
            self.joined += found
            left = [p for p in left if all(p is not other for other in found)]
        for place in left:
            if current().is_worked_off():
                self.open += 1
            elif not self._straight(place, self.new):
                self.new.append(place)

    def _entered(self, places: Sequence[Place]) -> list[tuple[int, Place]]:
        """Those from which the grid is reached, with the node there."""
        found = [(self.flood.enter(place.point), place) for place in places]
        return [(node, place) for node, place in found if node is not None]

    def _along_grid(self, known: dict[int, Place], waiting: list[tuple[int, Place]]) -> None:
        """Join those over one connected part of the grid, the nearest to joined ones first."""
        count = len(waiting)
        while waiting:
            progress.report("regions", "joining arcs", count - len(waiting), count)
            far, ways = nx.multi_source_dijkstra(self.flood.free, set(known), weight=_cost)
            node, place = waiting.pop(min(range(len(waiting)), key=lambda k: far[waiting[k][0]]))
            way = [self.flood.middle(self.flood.cells[k]) for k in ways[node]]
            if self._joins(known[ways[node][0]], place, way) or self._straight(place, self.joined):
                known[node] = place
                self.joined.append(place)
            else:
                self.open += 1

    def _straight(self, place: Place, others: Sequence[Place]) -> bool:
        """Whether a straight motion to one of the nearest others with the same signs is proven."""
        signs = self._signs(place)
        alike = [p for p in others if self._signs(p) == signs]
        alike.sort(key=lambda p: float(np.abs((p.point - place.point) / self.flood.sizes).max()))
        return any(self._seems_free(p, place) and self._joins(p, place, ()) for p in alike[:_STRAIGHT])

    def _seems_free(self, one: Place, other: Place) -> bool:
        """Whether a straight motion seems to lead from one place to the other without a border."""
        space, point = self.motions.space, one.point[None]
        start, end = (space.at(place.point)[0] for place in (one, other))
        for share in np.arange(1, _SHARES + 1) / _SHARES:
            point, there, crossed = self.flood.moved(
                point, (start + share * space.difference(end, start))[None]
            )
            if not there[0] or crossed.any():
                return False
        return self.flood.are_same(point[0], other.point)

    def _signs(self, place: Place) -> tuple[int, ...]:
        known = self._known_signs.get(id(place))
        return self._known_signs.setdefault(id(place), known or self.motions.borders.signs(place.near))

    def _joins(self, one: Place, other: Place, way: Sequence[Floats]) -> bool:
        if current().is_worked_off():
            return False
        start, end = (self.motions.space.at(place.point)[0] for place in (one, other))
        return self.motions.joins(self.motions.along(np.array([start, *way, end])), one, other) > 0


def _cost(_one: int, _other: int, data: dict[str, float]) -> float:
    """Of a step on the grid: less where it keeps clear of borders."""
    return 1 / (data["margin"] + _NARROW)
