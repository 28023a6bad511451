"""The singularity-free regions of a mechanism, as they were found.

Source: regions are aspects, Borrel, Liegeois (1986); for parallel mechanisms Wenger, Chablat (1997).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from singsym.effort.verdict import Certainty, Verdict
from singsym.kinematics.velocity import VelocityEquation
from singsym.motion.arithmetic import Array
from singsym.motion.regions.borders import Border
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
class Regions:
    """All regions that were found, large ones first.

    borders: the factors of (4) and (5), then, apart from these, limits and exclusions.
    verdict: yes where these are proven to be all, each of one piece, and no two the same: for n = 1; else
    undecided: a small one may be missed, and which are apart is as `apart` says.
    axes: for n = 2 the middles of the grid's cells along the inputs, in radians or lengths; assemblies: the
    number of configurations within limits over each cell.
    """

    equation: VelocityEquation
    borders: tuple[Border, ...]
    regions: tuple[Region, ...]
    verdict: Verdict
    axes: tuple[Floats, ...] = ()
    assemblies: Floats | None = None

    @property
    def inputs(self) -> tuple[str, ...]:
        """The labels of the input joints."""
        return tuple(c.label for c in self.equation.columns if c.role == "input")

    @property
    def at_least(self) -> int:
        """So many regions are proven to be there."""
        return len(self.regions) if self.verdict.is_yes else len({r.signs for r in self.regions})

    def apart(self, one: int, other: int) -> Verdict:
        """Whether two regions, by their numbers from 0, are proven to be two."""
        certainty: Certainty = "certified"
        first, second = self.regions[one].signs, self.regions[other].signs
        for border, a, b in zip(self.borders, first, second, strict=True):
            if a * b < 0:
                return Verdict.yes(certainty, reason=f"{border}: other signs in both")
        if self.verdict.is_yes:
            return Verdict.yes(self.verdict.certainty, reason="they are different arcs")
        return Verdict.undecided("no step on the grid joins them, and no sign tells them apart")
