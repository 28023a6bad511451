"""Configurations over a grid of the inputs, joined where a step from cell to cell meets no border.

Source: aspects of Borrel, Liegeois (1986), and of Wenger, Chablat (1997) for parallel mechanisms; grids of
configurations as roadmaps, LaValle, Planning Algorithms (2006), 5.4.
Numbers that find; nothing is concluded from them.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from itertools import product
from typing import Any

import networkx as nx
import numpy as np

from singsym.classes.configuration.locate import sizes_of_coordinates
from singsym.motion.regions.borders import Borders
from singsym.motion.regions.free_motion import FreeMotions
from singsym.polynomials.compiled_map import CompiledMap, Floats

_PARTS, _STEPS, _REACHED, _SAME, _FAR = 4, 4, 1e-8, 1e-4, 0.5
"""Parts of the way from cell to cell, and Newton's steps for each; values at their end; how near solutions
are the same, and how far they may go in a part, both over the sizes of the variables."""
SAMPLES = 150
"""Random configurations to find the first ones of a grid."""

Cell = tuple[int, ...]


class Flood:
    """Configurations over the cells of a grid, as nodes of a graph.

    axes: the middles of the cells along each input, over their units; an angle's go once round.
    points, cells: of each node; over: the nodes over each cell.
    free: the graph of the steps that meet no border, each with the least `margin` of its two ends; met: of
    each node the borders that steps from it met.
    """

    def __init__(self, motions: FreeMotions, axes: Sequence[Floats]) -> None:
        self.borders: Borders = motions.borders
        self.space, self.axes = motions.space, tuple(axes)
        equation, system = self.borders.equation, motions.system
        self.turning = np.array([d.is_angle for d in system.drives])
        self.sizes = sizes_of_coordinates(equation)
        given = [1.0 for d in system.drives for _ in d.names]
        both = [*self.sizes.tolist(), *given]
        self.equations = CompiledMap.balanced(motions.sheet.equations, system.ring, both)
        self.agreements = CompiledMap([d.agreement for d in system.drives], system.ring)
        fixed = {c.name for c in equation.space.ring.constants}
        self.moving = [k for k, name in enumerate(equation.space.ring.names) if name not in fixed]
        self.points: list[Floats] = []
        self.cells: list[Cell] = []
        self.over: dict[Cell, list[int]] = defaultdict(list)
        self.free: Any = nx.Graph()
        self.met: dict[int, set[int]] = defaultdict(set)

    def fill(self, starts: Floats, across: bool = True) -> None:
        """From configurations to all that are reached, step by step from cell to cell.

        across: whether steps lead on where a border was met, but for limits.
        """
        front = [n for n in map(self.enter, starts) if n is not None]
        ways = [way for k in range(len(self.axes)) for way in _both_ways(k, len(self.axes))]
        while front:
            begun = [(n, self._shifted(self.cells[n], way)) for n, way in product(dict.fromkeys(front), ways)]
            steps = [(n, cell) for n, cell in begun if cell is not None]
            front = []
            if not steps:
                break
            before = np.array([self.points[n] for n, _ in steps])
            ends = np.array([self.middle(cell) for _, cell in steps])
            landed, there, crossed = self.moved(before, ends)
            allowed = self.borders.allows(self.borders.values(landed))
            for k, (start, cell) in enumerate(steps):
                self.met[start].update(map(int, np.flatnonzero(crossed[k])))
                if not there[k] or not allowed[k] or (crossed[k].any() and not across):
                    continue
                number, new = self._entered(landed[k], cell)
                if not crossed[k].any():
                    self.free.add_edge(start, number, margin=min(self.margin(start), self.margin(number)))
                if new:
                    front.append(number)

    def enter(self, start: Floats) -> int | None:
        """The node over the cell that a configuration is over, if the way there meets no border."""
        cell = self.cell(self.space.at(start)[0])
        landed, there, crossed = self.moved(start[None], self.middle(cell)[None])
        if not there[0] or crossed.any():
            return None
        return self._entered(landed[0], cell)[0]

    def cell(self, values: Floats) -> Cell:
        """The cell that values of the inputs are in."""
        return tuple(int(np.argmin(np.abs(_around(a - x, t)))) for a, x, t in self._each(values))

    def middle(self, cell: Cell) -> Floats:
        """The inputs' values in the middle of a cell."""
        return np.array([axis[k] for axis, k in zip(self.axes, cell, strict=True)])

    def margin(self, node: int) -> float:
        """How far a configuration is from borders, about: the least of their polynomials' values."""
        values = np.abs(self.borders.values(self.points[node]))
        return float(values.min(initial=1.0))

    def _each(self, values: Floats) -> Any:
        return zip(self.axes, values.tolist(), self.turning.tolist(), strict=True)

    def _entered(self, point: Floats, cell: Cell) -> tuple[int, bool]:
        """The node of a configuration over a cell, and whether it is new."""
        for number in self.over[cell]:
            if self.are_same(self.points[number], point):
                return number, False
        number = len(self.points)
        self.points.append(point)
        self.cells.append(cell)
        self.over[cell].append(number)
        self.free.add_node(number)
        return number, True

    def are_same(self, one: Floats, other: Floats) -> bool:
        """Whether two points seem to be one configuration."""
        return float((np.abs(one - other) / self.sizes).max()) < _SAME

    def _shifted(self, cell: Cell, way: Cell) -> Cell | None:
        """The next cell; round the circle for an angle, None over the end of a length."""
        moved = []
        for place, by, axis, turns in zip(cell, way, self.axes, self.turning, strict=True):
            if not turns and not 0 <= place + by < len(axis):
                return None
            moved.append((place + by) % len(axis))
        return tuple(moved)

    # -- steps ---------------------------------------------------------------------------------------

    def moved(self, points: Floats, ends: Floats) -> tuple[Floats, Any, Any]:
        """From configurations to values of the inputs, in small steps.

        The configurations at the ends, where there is one, and which borders were met on the way,
        (points, borders): the polynomial changes its sign.
        """
        starts = np.array([self.space.at(point)[0] for point in points])
        change = np.where(self.turning, _around(ends - starts, True), ends - starts)
        there = np.ones(len(points), dtype=bool)
        signs = np.sign(self.borders.values(points))
        crossed = np.zeros(signs.shape, dtype=bool)
        for part in np.arange(1, _PARTS + 1) / _PARTS:
            landed, ok = self._solved(points, starts + part * change)
            ok &= (np.abs(landed - points) / self.sizes).max(axis=1) < _FAR
            crossed |= (np.sign(self.borders.values(landed)) != signs) & ok[:, None]
            there &= ok
            points = np.where(there[:, None], landed, points)
        return points, there, crossed

    def _solved(self, starts: Floats, values: Floats) -> tuple[Floats, Any]:
        """Configurations over values of the inputs by Newton's method, and where it came to an end."""
        given: list[Floats] = []
        for k, turns in enumerate(self.turning):
            value = values[:, k] * self.space.units[k]
            given += [np.cos(value), np.sin(value)] if turns else [value]
        points = np.column_stack([starts, *given])
        count = starts.shape[1]
        for step in range(_STEPS + 1):
            residual, slopes = self.equations(points)
            if step == _STEPS:
                break
            matrix = slopes[:, :, self.moving] * self.sizes[self.moving]
            turned = matrix.transpose(0, 2, 1)
            gram = turned @ matrix + 1e-12 * np.eye(len(self.moving))
            changes = np.linalg.solve(gram, -(turned @ residual[:, :, None]))[:, :, 0]
            points[:, self.moving] += self.sizes[self.moving] * np.clip(changes, -1, 1)
        reached = (np.abs(residual).max(axis=1) < _REACHED) & (self.agreements.values(points) > 0).all(axis=1)
        return points[:, :count], reached


def _around(change: Any, turns: bool) -> Any:
    """A change of an angle by the shorter way."""
    return (change + np.pi) % (2 * np.pi) - np.pi if turns else change


def _both_ways(k: int, count: int) -> tuple[Cell, Cell]:
    one = tuple(int(j == k) for j in range(count))
    return one, tuple(-x for x in one)


def axes_of(motions: FreeMotions, starts: Floats, grid: int) -> tuple[Floats, ...]:
    """The middles of as many cells along each input: of all angles, or between the lengths that were met."""
    values = np.array([motions.space.at(start)[0] for start in starts])
    found = []
    for k, drive in enumerate(motions.system.drives):
        low, high = (-np.pi, np.pi) if drive.is_angle else (values[:, k].min(), values[:, k].max())
        found.append(low + (np.arange(grid) + 0.5) * (high - low) / grid)
    return tuple(found)
