"""The input plane of a 2-DOF mechanism: how many assemblies there are, and regions free of singularities.

Source: aspects of Borrel, Liegeois (1986), and of Wenger, Chablat (1997) for parallel mechanisms: the
connected parts of the configuration space between its singularities.
Regions are filled on a grid from random configurations: numbers for drawing, from which nothing is concluded.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import networkx as nx
import numpy as np

from singsym.classes.result import Classification
from singsym.kinematics.sampling import sample_configurations
from singsym.output.figures.curves import Coordinate, Trace, draw_traces, finish_axes, input_plane, trace_loci
from singsym.output.figures.style import INK, OUTPUT, PALE, Floats, Picture, canvas
from singsym.polynomials.compiled_map import CompiledMap

GRID, SEEDS, MOST = 60, 150, 11
"""Cells along each input, random configurations to begin with, and the largest regions, which are drawn."""

_FEW = 0.01
"""A part of the cells, those on borders, in which an assembly may have been missed."""

_PARTS, _STEPS, _REACHED, _SAME, _FAR = 4, 4, 1e-8, 1e-4, 0.5
"""Parts of the way from cell to cell, and Newton's steps for each; values at their end; how near solutions
are the same, and how far they may go in a part, both over the sizes of the variables."""

Cell = tuple[int, int]


@dataclass(frozen=True, eq=False)
class Regions:
    """What was found over a grid of two inputs.

    inputs: middles of the cells; assemblies: the number of configurations over each cell; regions: for each
    region how many of its configurations are over each cell, large ones first.
    """

    inputs: tuple[Floats, Floats]
    assemblies: Floats
    regions: tuple[Floats, ...]


def find_regions(classification: Classification, grid: int = GRID, seeds: int = SEEDS) -> Regions | None:
    """The regions over the inputs of a mechanism with two; None where their values are not known."""
    plane = input_plane(classification)
    if plane is None or classification.equation.space.parameters:
        return None
    starts = sample_configurations(classification.equation.space, seeds, seed=classification.seed)
    if not starts:
        return None
    flood = _Flood(classification, plane, np.array(starts), grid)
    flood.fill(np.array(starts))
    return flood.found()


class _Flood:
    """Configurations over the cells of a grid, joined where a step from cell to cell meets no singularity."""

    def __init__(
        self, classification: Classification, plane: tuple[str, str], starts: Floats, grid: int
    ) -> None:
        space = classification.equation.space
        self.grid = grid
        self.coordinates = [Coordinate(label, classification.equation) for label in plane]
        self.axes = tuple(_middles(c, starts, grid) for c in self.coordinates)
        self.equations = CompiledMap.balanced(space.equations, space.ring)
        self.inputs = [CompiledMap(c.polynomials, space.ring) for c in self.coordinates]
        fixed = {c.name for c in space.ring.constants}
        self.free = [i for i, name in enumerate(space.ring.names) if name not in fixed]
        self.sizes = np.maximum(self.equations.sizes, 1e-9)
        real = [locus.factor for locus in classification.loci if not locus.verdict.is_no]
        self.factors = CompiledMap.balanced(real, space.ring)
        self.points: list[Floats] = []
        self.over: dict[Cell, list[int]] = defaultdict(list)
        self.joined: Any = nx.utils.UnionFind()

    def fill(self, starts: Floats) -> None:
        """From configurations to all that are reached, step by step from cell to cell."""
        cells = np.column_stack(
            [_nearest(a, c.at(starts)) for a, c in zip(self.axes, self.coordinates, strict=True)]
        )
        landed, ok = self._solved(starts, cells, cells, 1.0)
        front = []
        for point, cell in zip(landed[ok], cells[ok], strict=True):
            number, new = self._entered(point, (int(cell[0]), int(cell[1])))
            front += [number] if new else []
        where = {n: cell for cell, numbers in self.over.items() for n in numbers}
        while front:
            begun = [(n, step) for n, step in product(front, ((1, 0), (-1, 0), (0, 1), (0, -1)))]
            targets = [self._shifted(where[n], step) for n, step in begun]
            kept = [(n, cell) for (n, _), cell in zip(begun, targets, strict=True) if cell is not None]
            front = []
            if not kept:
                break
            before = np.array([self.points[n] for n, _ in kept])
            begun_at = np.array([where[n] for n, _ in kept])
            landed, ok, free = self._moved(before, begun_at, np.array([cell for _, cell in kept]))
            for k in np.flatnonzero(ok):
                start, cell = kept[int(k)]
                number, new = self._entered(landed[k], cell)
                if free[k]:
                    self.joined.union(start, number)
                if new:
                    where[number] = cell
                    front.append(number)

    def _moved(self, points: Floats, begun: Any, cells: Any) -> tuple[Floats, Any, Any]:
        """From cells to cells in small steps: the ends, where there is one, and where no locus was met."""
        ok, free = np.ones(len(points), dtype=bool), np.ones(len(points), dtype=bool)
        signs = self._signs(points)
        for part in np.arange(1, _PARTS + 1) / _PARTS:
            landed, there = self._solved(points, begun, cells, part)
            near = (np.abs(landed - points) / self.sizes).max(axis=1) < _FAR
            free &= near & (self._signs(landed) == signs).all(axis=1)
            ok &= there
            points = np.where(there[:, None], landed, points)
        return points, ok, free & ok

    def _signs(self, points: Floats) -> Floats:
        """On which side of each locus points are, (points, loci)."""
        if not self.factors.count:
            return np.zeros((len(points), 1))
        return np.sign(self.factors.values(points))

    def found(self) -> Regions:
        """What the cells hold."""
        shape = (self.grid, self.grid)
        whole = np.zeros(shape)
        by_root: dict[int, Floats] = defaultdict(lambda: np.zeros(shape))
        for cell, numbers in self.over.items():
            whole[cell] = len(numbers)
            for number in numbers:
                by_root[self.joined[number]][cell] += 1
        regions = sorted(by_root.values(), key=lambda region: -int((region > 0).sum()))
        # a few cells are a corner that a step went around
        kept = tuple(region for region in regions if (region > 0).sum() > 4)
        return Regions((self.axes[0], self.axes[1]), whole, kept)

    def _shifted(self, cell: Cell, step: Cell) -> Cell | None:
        """The next cell; around the circle for an angle, None over the end of a length."""
        moved = []
        for place, by, coordinate in zip(cell, step, self.coordinates, strict=True):
            to = place + by
            if not coordinate.is_angle and not 0 <= to < self.grid:
                return None
            moved.append(to % self.grid)
        return moved[0], moved[1]

    def _entered(self, point: Floats, cell: Cell) -> tuple[int, bool]:
        """The number of a configuration over a cell, and whether it is new there."""
        for number in self.over[cell]:
            if float((np.abs(self.points[number] - point) / self.sizes).max()) < _SAME:
                return number, False
        number = len(self.points)
        self.points.append(point)
        self.over[cell].append(number)
        _ = self.joined[number]
        return number, True

    def _solved(self, starts: Floats, begun: Any, cells: Any, part: float) -> tuple[Floats, Any]:
        """Configurations with inputs part of the way between cells by Newton's method, and where it ended."""
        points = starts.copy()
        wanted = [self._between(k, begun[:, k], cells[:, k], part) for k in (0, 1)]
        for step in range(_STEPS + 1):
            values, slopes = self._with_inputs(points, wanted)
            if step == _STEPS:
                break
            matrix = slopes[:, :, self.free] * self.sizes[self.free]
            turned = matrix.transpose(0, 2, 1)
            gram = turned @ matrix + 1e-12 * np.eye(len(self.free))
            changes = np.linalg.solve(gram, -(turned @ values[:, :, None]))[:, :, 0]
            points[:, self.free] += self.sizes[self.free] * np.clip(changes, -1, 1)
        ahead = [self._ahead(points, k, target) for k, target in enumerate(wanted)]
        return points, (np.abs(values).max(axis=1) < _REACHED) & ahead[0] & ahead[1]

    def _between(self, k: int, begun: Any, ends: Any, part: float) -> Floats:
        """Values of an input part of the way between cells, the shorter way for an angle."""
        axis = self.axes[k]
        way = axis[ends] - axis[begun]
        if self.coordinates[k].is_angle:
            way = (way + np.pi) % (2 * np.pi) - np.pi
        return np.asarray(axis[begun] + part * way)

    def _with_inputs(self, points: Floats, wanted: Sequence[Floats]) -> tuple[Floats, Floats]:
        """Values and slopes of the loop equations, and of what is zero where the inputs are as wanted."""
        values, slopes = self.equations(points)
        for system, coordinate, target in zip(self.inputs, self.coordinates, wanted, strict=True):
            here, by = system(points)
            if coordinate.is_angle:
                c, s = np.cos(target)[:, None], np.sin(target)[:, None]
                value, slope = c * here[:, 1:] - s * here[:, :1], c * by[:, 1] - s * by[:, 0]
            else:
                value, slope = here - coordinate.powered(target)[:, None], by[:, 0]
            values = np.concatenate([values, value], axis=1)
            slopes = np.concatenate([slopes, slope[:, None]], axis=1)
        return values, slopes

    def _ahead(self, points: Floats, k: int, target: Floats) -> Any:
        """Whether an angle is as wanted, and not half a turn from it."""
        if not self.coordinates[k].is_angle:
            return np.ones(len(points), dtype=bool)
        here = self.inputs[k].values(points)
        return np.cos(target) * here[:, 0] + np.sin(target) * here[:, 1] > 0


def _middles(coordinate: Coordinate, starts: Floats, grid: int) -> Floats:
    """The middles of the cells along an input: of all angles, or between the lengths that were met."""
    values = coordinate.at(starts)
    low, high = (-np.pi, np.pi) if coordinate.is_angle else (float(values.min()), float(values.max()))
    return np.asarray(low + (np.arange(grid) + 0.5) * (high - low) / grid)


def _nearest(axis: Floats, values: Floats) -> Any:
    return np.clip(np.round((values - axis[0]) / (axis[1] - axis[0])).astype(int), 0, len(axis) - 1)


def plot_regions(
    classification: Classification, traces: Sequence[Trace] | None = None, regions: Regions | None = None
) -> Picture:
    """The input plane shaded by the number of assemblies, under the singularity curves; then each region.

    traces, regions: from `trace_loci` and `find_regions`, where they are known already.
    Raises `ValueError` for a mechanism without two inputs of known values.
    """
    found = find_regions(classification) if regions is None else regions
    plane = input_plane(classification)
    if found is None or plane is None:
        raise ValueError("regions over the inputs are for mechanisms with two inputs of known values")
    traces = trace_loci(classification) if traces is None else traces
    shown = found.regions[:MOST]
    columns = min(4, len(shown) + 1)
    rows = -(-(len(shown) + 1) // columns)
    figure = canvas(2.6 * columns, 2.75 * rows + 0.5)
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    across, up = (Coordinate(label, classification.equation) for label in plane)
    numbers, cells = np.unique(found.assemblies, return_counts=True)
    counts = [int(n) for n, size in zip(numbers, cells, strict=True) if n and size > _FEW * cells.sum()]
    for n in counts:
        _shade(panels[0], found, found.assemblies >= n, PALE, 0.3)
    draw_traces(panels[0], traces, across, up, width=0.9)
    darker = " (darker: more)" if len(counts) > 1 else ""
    head = f"assemblies: {', '.join(map(str, counts)) or 'none'}{darker}"
    panels[0].set_title(head, fontsize=9, color=INK)
    for number, (panel, region) in enumerate(zip(panels[1:], shown, strict=False), 1):
        _shade(panel, found, region > 0, OUTPUT, 0.55)
        part = 100 * float((region > 0).mean())
        panel.set_title(f"region {number}: {part:.0f} % of the plane", fontsize=9, color=INK)
    for panel in panels[: len(shown) + 1]:
        finish_axes(panel, across, up)
    for panel in panels[1 : len(shown) + 1]:
        # the same axes as those of the first
        panel.set(xlabel="", ylabel="")
        panel.tick_params(labelbottom=False, labelleft=False)
    for panel in panels[len(shown) + 1 :]:
        panel.axis("off")
    title = "Assemblies and singularity-free regions over the inputs"
    figure.suptitle(title, fontsize=11, color=INK)
    more = len(found.regions) - len(shown)
    rest = f", {more} smaller ones are left out" if more else ""
    most = max(counts, default=0)
    described = f"{len(found.regions)} regions found{rest}; up to {most} assembl{'y' if most == 1 else 'ies'}"
    return Picture(figure, title, f"{title}: {described}")


def _shade(axes: Any, found: Regions, inside: Any, colour: str, alpha: float) -> None:
    """The cells where something holds, as one area, to the borders of the plane."""
    padded = np.pad(np.asarray(inside, dtype=float), 1, mode="edge")
    steps = [axis[1] - axis[0] for axis in found.inputs]
    x, y = (
        np.concatenate([[axis[0] - h], axis, [axis[-1] + h]])
        for axis, h in zip(found.inputs, steps, strict=True)
    )
    axes.contourf(x, y, padded.T, levels=[0.5, 2.0], colors=[colour], alpha=alpha)
    axes.set(
        xlim=(x[0] + steps[0] / 2, x[-1] - steps[0] / 2), ylim=(y[0] + steps[1] / 2, y[-1] - steps[1] / 2)
    )
    axes.tick_params(labelsize=7, colors=PALE)
