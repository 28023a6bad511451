"""Whether two configurations can be joined without a singularity: by a proven path, or a proof that none is.

Source: regions are aspects, Borrel, Liegeois, A study of multiple manipulator inverse kinematic solutions,
IEEE ICRA (1986) 1180-1185; paths are found on a grid and proven by certified continuation.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import networkx as nx
import numpy as np

from singsym.classes.configuration.at import Analysis
from singsym.effort import progress
from singsym.effort.budget import Undecided
from singsym.effort.verdict import Verdict
from singsym.kinematics.sampling import sample_configurations
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.enclosures import sure_sign
from singsym.motion.regions.arcs import Arcs
from singsym.motion.regions.borders import Border, borders, input_space, point_of
from singsym.motion.regions.flood import SAMPLES, Flood, axes_of
from singsym.motion.regions.free_motion import OUTSIDE, FreeMotions, Place
from singsym.motion.regions.result import Wall
from singsym.motion.regions.walls import wall
from singsym.motion.trajectory import Trajectory
from singsym.polynomials.compiled_map import Floats

_GRIDS = {1: (360, 2880), 2: (48, 96)}
"""Cells along each input, by mobility: grids that are tried one after the other."""


@dataclass(frozen=True, eq=False)
class Joined:
    """Whether two configurations can be joined by a motion that meets no singularity, limit or exclusion.

    verdict: yes, certified, with `path` and the number of `boxes` that prove it; no, with the reason; or
    undecided.  path: values of the inputs, straight between the rows.
    apart: what has other signs at both and vanishes nowhere inside a region, where that is the reason.
    """

    verdict: Verdict
    path: Trajectory | None = None
    boxes: int = 0
    apart: Border | None = None


def joined(one: Analysis, other: Analysis, *, seed: int = 0) -> Joined:
    """Whether a motion leads from one configuration to another in one region, within limits.

    Both are as `at` gives them, of the same mechanism and formulation.  A configuration is meant by its
    values to 1e-9.  A path is looked for straight, and for n = 1 and 2 on grids of the inputs.
    Raises `MechanismError` for configurations of different mechanisms, and where the inputs' values are not
    known.

    >>> from singsym.classes.configuration.at import at
    >>> from singsym.mechanism import load
    >>> arm = load("2r")
    >>> up, far, down = (at(arm, {"joints": {"A": a, "B": b}}) for a, b in ((0, 1), (2, 3), (0, -1)))
    >>> str(joined(up, far).verdict)
    'yes (certified): a motion without a border is proven, in 4 boxes'
    >>> joined(up, down).apart.words
    'A, B, C collinear'
    """
    if one.equation.space != other.equation.space or one.equation.columns != other.equation.columns:
        expected = "two configurations of one mechanism in one formulation"
        raise MechanismError([Problem("regions", "configurations of different mechanisms", expected)])
    motions = FreeMotions(borders(one.equation), input_space(one.equation, one.length))
    places = [motions.place(point_of(found)) for found in (one, other)]
    first, last = places
    if first is None or last is None:
        return Joined(Verdict.undecided(f"the {'second' if first else 'first'} configuration is {OUTSIDE}"))
    apart = _sign_apart(motions, first, last)
    if apart is not None:
        reason = f"{apart}: other signs at both, and a motion between them passes a zero"
        return Joined(Verdict.no("certified", reason=reason), apart=apart)
    if one.equation.n == 1:
        on_arcs = _on_arcs(motions, first, last)
        if on_arcs.is_no:
            return Joined(on_arcs)
    for path in _paths(motions, first, last, seed):
        boxes = motions.joins(path, first, last)
        if boxes:
            reason = f"a motion without a border is proven, in {boxes} boxes"
            return Joined(Verdict.yes("certified", reason=reason), path, boxes)
    between = _walled(motions, first, last)
    if between is not None:
        return Joined(Verdict.no(between.certainty, reason=str(between)))
    return Joined(Verdict.undecided("no path was found and proven, and no sign tells them apart"))


def _walled(motions: FreeMotions, first: Place, last: Place) -> Wall | None:
    """A wall between two places with the same signs."""
    between = wall(motions, motions.borders.signs(first.near), first.point[None], last.point[None])
    if between is None:
        return None
    sides = [sure_sign(between.polynomial, place.near) for place in (first, last)]
    return between if sides[0] * sides[1] < 0 else None


def _on_arcs(motions: FreeMotions, first: Place, last: Place) -> Verdict:
    """Whether both are on one arc of a configuration curve between its borders."""
    found = Arcs.of(motions)
    try:
        if found.number(first) != found.number(last):
            reason = "they are on different arcs of the configuration curve, between its borders"
            return Verdict.no(found.certainty, reason=reason)
    except Undecided as reason:
        return Verdict.undecided(str(reason))
    return Verdict.yes(found.certainty, reason="they are on one arc of the configuration curve")


def _sign_apart(motions: FreeMotions, first: Place, last: Place) -> Border | None:
    """A border on two sides of which the configurations are.

    Lemma: a factor of (4) or (5), or an exclusion, is continuous and vanishes nowhere on a motion inside a
    region; so it keeps its sign there.
    """
    borders = motions.borders
    signs = [borders.signs(place.near) for place in (first, last)]
    for border, a, b in zip(borders.all, signs[0], signs[1], strict=True):
        if a * b < 0:
            return border
    return None


def _paths(motions: FreeMotions, first: Place, last: Place, seed: int) -> Iterator[Trajectory]:
    """Motions that may lead from one place to the other, the straight one first."""
    space = motions.space
    start, end = (space.at(place.point)[0] for place in (first, last))
    yield motions.along(np.array([start, end]))
    if len(start) not in _GRIDS:
        return
    lengths = sample_configurations(motions.borders.equation.space, SAMPLES, seed)
    met = np.array([first.point, last.point, *lengths])
    for grid in _GRIDS[len(start)]:
        progress.report("joined", f"a grid of {grid} cells along each input")
        flood = Flood(motions, axes_of(motions, met, grid))
        flood.fill(first.point[None], across=False)
        rows = _on_grid(flood, first, last)
        if rows is None:
            return
        yield motions.along(np.array([start, *rows, end]))


def _on_grid(flood: Flood, first: Place, last: Place) -> list[Floats] | None:
    """The middles of the cells on the widest short way; None where the flood did not reach the second."""
    begin, end = flood.enter(first.point), flood.enter(last.point)
    if begin is None or end is None or not nx.has_path(flood.free, begin, end):
        return None

    def cost(a: int, b: int, data: dict[str, float]) -> float:
        return 1 / (data["margin"] + 1e-9)

    return [flood.middle(flood.cells[k]) for k in nx.shortest_path(flood.free, begin, end, weight=cost)]
