"""The singularity-free regions of a mechanism, as they were found.

Source: regions are aspects, Borrel, Liegeois (1986); for parallel mechanisms Wenger, Chablat (1997).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import networkx as nx

from singsym.effort.verdict import Certainty, Verdict
from singsym.kinematics.velocity import VelocityEquation
from singsym.motion.arithmetic import Array
from singsym.motion.regions.borders import Border
from singsym.polynomials import Polynomial
from singsym.polynomials.compiled_map import Floats


@dataclass(frozen=True, eq=False)
class Region:
    """Configurations that are joined without a singularity, limit or exclusion.

    values, joints: of a configuration of it that is certified, in floats: of the variables, of the joints.
    signs: of each of the borders' polynomials, certified.
    ends: the borders that it ends at; seen numerically for n = 2.
    points: configurations of it, (B, variables), numerical; of an arc in order.
    cells: for n = 2 over which cell of the grid each of them is, (B, 2).
    """

    values: Mapping[str, float]
    joints: Mapping[str, float]
    signs: tuple[int, ...]
    ends: tuple[Border, ...]
    points: Floats
    cells: Array


@dataclass(frozen=True, eq=False)
class Wall:
    """A polynomial that vanishes at no configuration at which the borders' polynomials have these signs.

    Lemma: in a region it keeps its sign, for the region is connected and has these signs throughout.
    """

    polynomial: Polynomial
    signs: tuple[int, ...]
    certainty: Certainty

    def __str__(self) -> str:
        return f"{self.polynomial.short_text(4)} vanishes at no configuration with the signs of both"


@dataclass(frozen=True, eq=False)
class Regions:
    """All regions that were found, large ones first.

    borders: the factors of (4) and (5), then, apart from these, limits and exclusions.
    verdict: yes where these are proven to be all, each of one piece, and no two the same; else undecided: a
    small one may be missed, or two of them be one, and which are apart is as `apart` says.
    walls: for n = 2 further polynomials that keep their signs in regions with some signs, and of each region
    the certified sign, 0 where the wall says nothing of it.
    axes: for n = 2 the middles of the grid's cells along the inputs, in radians or lengths; assemblies: the
    number of configurations within limits over each cell.
    """

    equation: VelocityEquation
    borders: tuple[Border, ...]
    regions: tuple[Region, ...]
    verdict: Verdict
    walls: tuple[tuple[Wall, tuple[int, ...]], ...] = ()
    axes: tuple[Floats, ...] = ()
    assemblies: Floats | None = None

    @property
    def inputs(self) -> tuple[str, ...]:
        """The labels of the input joints."""
        return tuple(c.label for c in self.equation.columns if c.role == "input")

    @property
    def at_least(self) -> int:
        """So many regions are proven to be there."""
        pairs = combinations(range(len(self.regions)), 2)
        graph = nx.Graph(pair for pair in pairs if not self.apart(*pair).is_yes)
        graph.add_nodes_from(range(len(self.regions)))
        return int(nx.number_connected_components(graph))

    def apart(self, one: int, other: int) -> Verdict:
        """Whether two regions, by their numbers from 0, are proven to be two."""
        certainty: Certainty = "certified"
        first, second = self.regions[one].signs, self.regions[other].signs
        for border, a, b in zip(self.borders, first, second, strict=True):
            if a * b < 0:
                return Verdict.yes(certainty, reason=f"{border}: other signs in both")
        for wall, sides in self.walls:
            if sides[one] * sides[other] < 0:
                return Verdict.yes(wall.certainty, reason=str(wall))
        if self.verdict.is_yes:
            return Verdict.yes(self.verdict.certainty, reason="they are different arcs")
        return Verdict.undecided(
            "no step on the grid joins them, and neither a sign nor a plane tells them apart"
        )
