"""The cells of a design over its parameters, coloured by their tables.

Source: singsym's own; borders and cells are exact, their curves are drawn in doubles.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from singsym.designs.plane import Plane
from singsym.designs.result import Cell, Design
from singsym.output.design.page import table_text
from singsym.output.figures.style import INK, PALE, PAPER, SERIES, Picture, entitle, paper
from singsym.output.pieces import counted

_OPEN = "open: not classified in time"
_HATCHED: dict[str, Any] = {"facecolor": PAPER, "edgecolor": PALE, "hatch": "///"}
_STEPS = 12
_BEYOND = 0.25
"""So much of a chart's width is drawn beyond the last border."""
_ROOM = 0.06
"""So much of a chart's width has room for what is written in a cell or at a border."""
_ROW = 0.19
"""The height of a row of the legend, in inches."""


def plot_design(found: Design, axes: Any = None) -> Picture:
    """The space of one or two parameters, one colour for each table of classes; white: no singularity,
    grey: no configuration, hatched: no table, as its sample was not classified.  Of one parameter, numbers
    of points or components stand in cells, and values at borders, that have the room.

    Where it is not proven that tables are those of whole cells, a line below the title says so.
    axes: of matplotlib to draw on; None: those of a new figure.  What lies beyond the last border of an
    unbounded range is cut off.
    """
    from matplotlib.patches import Patch

    alone = axes is None
    colours = _colours(found)
    own = paper(axes, 7.2, (1.8 if found.plane is None else 5.6) + _ROW * (len(colours) + 1))
    if found.plane is None:
        _draw_line(own, found, colours)
    else:
        _draw_plane(own, found, found.plane, colours)
    handles = [
        Patch(facecolor=colours[table], edgecolor=INK, alpha=0.45, label=table_text(table))
        for table in colours
    ]
    if any(cell.classification is None for cell in found.cells):
        handles.append(Patch(label=_OPEN, **_HATCHED))
    where = {"loc": "outside lower center"} if alone else {"loc": "best"}
    (own.figure if alone else own).legend(handles=handles, fontsize=8, frameon=False, **where)
    name = found.mechanism.title or found.mechanism.name
    title = f"{name}: classes over {', '.join(found.parameters)}"
    entitle(own, title, alone=alone)
    doubts = _doubts(found)
    if doubts and alone:
        own.set_title(doubts, fontsize=8, color=INK)
    described = "; ".join(f"{cell.where}: {_said(cell)}" for cell in found.cells)
    more = f" {doubts}." if doubts else ""
    return Picture(own.figure, title, f"Cells of the parameters. {described}.{more}")


def _said(cell: Cell) -> str:
    return _OPEN if cell.classification is None else table_text(cell.entries)


def _doubts(found: Design) -> str:
    """What is not proven of all of a cell, in one line."""
    types = {types for types, _ in found.doubts if types}
    if not found.doubts:
        return ""
    kinds = f"{counted(len(types), 'kind')} of singularity" if types else "whether there are configurations"
    return f"Only seen at samples, not proven for whole cells: {kinds}"


def _look(cell: Cell, colours: dict[Any, str]) -> dict[str, Any]:
    """How the area of a cell is filled."""
    if cell.classification is None:
        return _HATCHED
    return {"facecolor": colours[cell.entries], "alpha": 0.45}


def _colours(found: Design) -> dict[Any, str]:
    """A colour for each table of the cells."""
    tables = found.tables()
    others = [table for table in tables if table and table[0][0]]
    colours = {table: SERIES[k % len(SERIES)] for k, table in enumerate(others)}
    return {table: colours.get(table, PALE if table else PAPER) for table in tables}


def _draw_line(axes: Any, found: Design, colours: dict[Any, str]) -> None:
    name = found.parameters[0]
    ends = [cell.about for cell in found.values if cell.about is not None]
    ticks = [cell.about for cell in found.values if cell.about is not None and cell.sample]
    samples = [float(cell.sample[name]) for cell in found.cells]
    low, high = min(samples + ticks), max(samples + ticks)
    margin = _BEYOND * (high - low or 1.0)
    cuts = [max(0.0, low - margin) if low > 0 else low - margin, *ends, high + margin]
    for cell, left, right in zip(found.cells, cuts, cuts[1:], strict=False):
        axes.axvspan(left, right, **_look(cell, colours))
        if right - left > _ROOM * (cuts[-1] - cuts[0]):
            axes.text((left + right) / 2, 0.5, _short(cell), ha="center", va="center", fontsize=8, color=INK)
    for x in ends:
        axes.axvline(x, color=INK, lw=1.0)
    axes.set_xlim(cuts[0], cuts[-1])
    axes.set_ylim(0, 1)
    axes.set_yticks([])
    if ticks:
        shown = _apart(ticks, _ROOM * (cuts[-1] - cuts[0]))
        axes.set_xticks(shown, [f"{x:.4g}" for x in shown])
    axes.set_xlabel(name)


def _apart(places: list[float], room: float) -> list[float]:
    """Those of ascending places that have so much room from the one before."""
    found: list[float] = []
    for x in places:
        if not found or x - found[-1] >= room:
            found.append(x)
    return found


def _short(cell: Cell) -> str:
    """Numbers of points or components by class."""
    return "\n".join(
        f"{number}: {'' if points is None and components is None else points or components}".rstrip(": ")
        for number, _, _, points, components in cell.entries
        if number
    )


def _draw_plane(axes: Any, found: Design, plane: Plane, colours: dict[Any, str]) -> None:
    x_name, y_name = plane.names
    places = {place: cell for cell in found.cells for place in cell.places}
    walls = [float(wall) for wall in plane.walls]
    stacks = sorted({i for i, _ in places})
    xs = [float(plane.stacks[i][0]) for i in stacks]
    left = walls[stacks[0] - 1] if stacks[0] else min(xs) - 1
    right = walls[stacks[-1]] if stacks[-1] < len(walls) else max(xs) + _BEYOND * (max(xs) - left)
    ys = [float(plane.sample(place)[1]) for place in places]
    low, high = _vertical(plane, places, ys)
    cuts = [left, *walls[stacks[0] : stacks[-1]], right]
    for i, a, b in zip(stacks, cuts, cuts[1:], strict=False):
        grid = np.linspace(a, b, _STEPS + 2)[1:-1]
        count = len(plane.stacks[i][1]) - 1
        rows = [(x, h) for x in grid if len(h := plane.heights(float(x))) == count]
        if not rows:
            continue
        width = (b - a) / (_STEPS + 1)
        x = np.array([r[0] for r in rows])
        heights = np.array([r[1] for r in rows]).reshape(len(rows), count)
        x, heights = _to_ends(x, heights, a, b, width)
        for j in range(count + 1):
            cell = places.get((i, j))
            if cell is not None:
                under = heights[:, j - 1] if j else np.full(len(x), low)
                over = heights[:, j] if j < count else np.full(len(x), high)
                axes.fill_between(x, under, over, lw=0, antialiased=False, **_look(cell, colours))
    _draw_borders(axes, found, (left, right), (low, high))
    for cell in found.cells:
        x0, y0 = (float(cell.sample[name]) for name in plane.names)
        if left < x0 < right and low < y0 < high:
            axes.text(
                x0, y0, cell.where.removeprefix("cell "), fontsize=8, color=INK, ha="center", va="center"
            )
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)
    axes.set_xlabel(x_name)
    axes.set_ylabel(y_name)


def _vertical(plane: Plane, places: dict[Any, Cell], ys: list[float]) -> tuple[float, float]:
    """The ends of the second parameter's axis: the ranges, or a little beyond the samples."""
    bounded = all(j for _, j in places)
    lows = [plane.heights(float(plane.stacks[i][0]))[j - 1] for i, j in places if j]
    return (min(lows) if bounded else min(ys) - 1), max(ys)


def _to_ends(x: Any, h: Any, a: float, b: float, width: float) -> tuple[Any, Any]:
    """Curves drawn on to the walls as straight lines."""
    if len(x) < 2:
        return x, h
    first = h[0] + (h[0] - h[1]) / (x[1] - x[0]) * (x[0] - a)
    last = h[-1] + (h[-1] - h[-2]) / (x[-1] - x[-2]) * (b - x[-1])
    near = [x[0] - a < 1.5 * width, b - x[-1] < 1.5 * width]
    if near[0]:
        x, h = np.r_[a, x], np.vstack([first, h])
    if near[1]:
        x, h = np.r_[x, b], np.vstack([h, last])
    return x, h


def _draw_borders(axes: Any, found: Design, across: tuple[float, float], up: tuple[float, float]) -> None:
    """The borders that divide the ranges, as the zeros of their polynomials."""
    x, y = np.meshgrid(np.linspace(*across, 240), np.linspace(*up, 240))
    for part in found.dividing:
        z = part.polynomial.evaluate([x, y])
        axes.contour(x, y, z, levels=[0.0], colors=[INK], linewidths=1.1)
