"""Regions free of singularities over the inputs, in the workspace, and as arcs of a configuration curve.

Source: regions as in `singsym.motion.regions`; what is drawn is their numerical part.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import Any

import numpy as np

from singsym.classes.result import Classification
from singsym.mechanism.problems import MechanismError
from singsym.motion.regions.regions import regions_equation
from singsym.motion.regions.result import Region, Regions
from singsym.output.figures.curves import Coordinate, Trace, draw_traces, finish_axes
from singsym.output.figures.style import INK, OUTPUT, PALE, SERIES, Floats, Picture, canvas, paper

MOST = 11
"""The largest regions, which are drawn."""
_FEW = 0.01
"""A part of the cells, those on borders, in which an assembly may have been missed."""


def regions_over_inputs(classification: Classification) -> Regions | None:
    """The regions of a mechanism with two inputs of known values; None for others."""
    if classification.equation.n != 2 or classification.equation.space.parameters:
        return None
    try:
        return regions_equation(classification.equation, seed=classification.seed)
    except MechanismError:
        return None


def plot_regions(
    found: Regions, plane: tuple[str, str] | None = None, traces: Sequence[Trace] = ()
) -> Picture:
    """The regions of a mechanism with one or two inputs.

    plane: for n = 2 two coordinates of points or joints in which regions are shaded, as ("C.x", "C.y") for a
    workspace; by default the inputs.  For n = 1 what is drawn across and up; by default the input and the
    output's value.  traces: singularity curves to draw on top, from `trace_loci`.
    Raises `ValueError` where there is no region, or a label is not known.
    """
    if not found.regions:
        raise ValueError(f"there are no regions to draw: {found.verdict.reason}")
    if not found.axes:
        return _plot_arcs(found, plane)
    return _plot_plane(found, plane or (found.inputs[0], found.inputs[1]), plane is None, traces)


def _plot_arcs(found: Regions, plane: tuple[str, str] | None) -> Picture:
    """Arcs in a plane, each in its colour."""
    equation = found.equation
    if plane is None:
        outputs = [c.label.removeprefix("T.") for c in equation.columns if c.role == "output"]
        places = [f"{name}.{axis}" for name in equation.space.points for axis in "xy"]
        known = [label for label in (*outputs, *equation.values, *places) if label not in found.inputs]
        plane = found.inputs[0], next((k for k in known if k in equation.values), places[-1])
    across, up = (Coordinate(label, equation) for label in plane)
    axes = paper(None, 6.4, 5.0)
    for number, region in enumerate(found.regions, 1):
        x, y = _unbroken(across.at(region.points), across), _unbroken(up.at(region.points), up)
        axes.plot(x, y, color=SERIES[(number - 1) % len(SERIES)], lw=2.2, label=f"region {number}")
    finish_axes(axes, across, up)
    axes.figure.legend(loc="outside lower center", ncols=4, fontsize=8.5, frameon=False, labelcolor=INK)
    title = "Singularity-free regions"
    axes.set_title(title, fontsize=11, color=INK)
    described = f"{len(found.regions)} arcs; {plane[0]} across, {plane[1]} up"
    return Picture(axes.figure, title, f"{title}: {described}")


def _unbroken(values: Floats, coordinate: Coordinate) -> Floats:
    """Without the line from one side of the plane to the other where an angle goes round."""
    if coordinate.is_angle:
        values = values.copy()
        values[1:][np.abs(np.diff(values)) > np.pi] = np.nan
    return values


def _plot_plane(found: Regions, plane: tuple[str, str], is_inputs: bool, traces: Sequence[Trace]) -> Picture:
    """A panel of all assemblies where the plane is that of the inputs, then one for each region."""
    shown = found.regions[:MOST]
    count = len(shown) + is_inputs
    columns = min(4, count)
    rows = -(-count // columns)
    figure = canvas(2.6 * columns, 2.75 * rows + 0.5)
    panels = list(figure.subplots(rows, columns, squeeze=False).ravel())
    across, up = (Coordinate(label, found.equation) for label in plane)
    numbers, cells = np.unique(_assemblies(found), return_counts=True)
    counts = [int(n) for n, size in zip(numbers, cells, strict=True) if n and size > _FEW * cells.sum()]
    if is_inputs:
        for n in counts:
            _shade(panels[0], found, _assemblies(found) >= n, PALE, 0.3)
        draw_traces(panels[0], traces, across, up, width=0.9)
        darker = " (darker: more)" if len(counts) > 1 else ""
        head = f"assemblies: {', '.join(map(str, counts)) or 'none'}{darker}"
        panels[0].set_title(head, fontsize=9, color=INK)
    for number, (panel, region) in enumerate(zip(panels[int(is_inputs) :], shown, strict=False), 1):
        over = np.zeros(tuple(map(len, found.axes)))
        over[tuple(region.cells.T)] = 1
        if is_inputs:
            _shade(panel, found, over > 0, OUTPUT, 0.55)
        else:
            _fill(panel, found, region, across, up)
        panel.set_title(f"region {number}: {100 * over.mean():.0f} % of inputs", fontsize=9, color=INK)
    for panel in panels[:count]:
        finish_axes(panel, across, up)
    for panel in panels[1:count]:
        # the same axes as those of the first
        panel.set(xlabel="", ylabel="")
        panel.tick_params(labelbottom=not is_inputs, labelleft=not is_inputs)
    for panel in panels[count:]:
        panel.axis("off")
    where = "the inputs" if is_inputs else f"{plane[0]} and {plane[1]}"
    title = f"{'Assemblies and s' if is_inputs else 'S'}ingularity-free regions over {where}"
    figure.suptitle(title, fontsize=11, color=INK)
    more = len(found.regions) - len(shown)
    rest = f", {more} smaller ones are left out" if more else ""
    most = max(counts, default=0)
    described = f"{len(found.regions)} regions found{rest}; up to {most} assembl{'y' if most == 1 else 'ies'}"
    return Picture(figure, title, f"{title}: {described}")


def _assemblies(found: Regions) -> Floats:
    return np.zeros((1, 1)) if found.assemblies is None else found.assemblies


def _fill(panel: Any, found: Regions, region: Region, across: Coordinate, up: Coordinate) -> None:
    """The image of a region in a plane, cell by cell; where it covers a cell twice it is left out."""
    from matplotlib.collections import PolyCollection

    over: dict[tuple[int, ...], list[int]] = defaultdict(list)
    for node, cell in enumerate(region.cells.tolist()):
        over[tuple(cell)].append(node)
    places = np.column_stack([across.at(region.points), up.at(region.points)])
    round_ = [Coordinate(label, found.equation).is_angle for label in found.inputs]
    sizes = [len(axis) for axis in found.axes]
    quads = []
    for i, j in over:
        corners = [(i + a, j + b) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        if round_[0] or i + 1 < sizes[0]:
            corners = [(a % sizes[0], b % sizes[1] if round_[1] else b) for a, b in corners]
            nodes = [over.get(corner, []) for corner in corners]
            if all(len(own) == 1 for own in nodes):
                quads.append(places[[own[0] for own in nodes]])
    whole = np.array(quads).reshape(-1, 4, 2)
    look: dict[str, Any] = {
        "facecolor": OUTPUT,
        "edgecolor": OUTPUT,
        "alpha": 0.35,
        "lw": 0.2,
        "rasterized": True,
    }
    panel.add_collection(PolyCollection(list(whole), **look))
    panel.autoscale_view()


def _shade(axes: Any, found: Regions, inside: Any, colour: str, alpha: float) -> None:
    """The cells where something holds, as one area, to the borders of the plane."""
    padded = np.pad(np.asarray(inside, dtype=float), 1, mode="edge")
    steps = [axis[1] - axis[0] for axis in found.axes]
    x, y = (
        np.concatenate([[axis[0] - h], axis, [axis[-1] + h]])
        for axis, h in zip(found.axes, steps, strict=True)
    )
    axes.contourf(x, y, padded.T, levels=[0.5, 2.0], colors=[colour], alpha=alpha)
    axes.set(
        xlim=(x[0] + steps[0] / 2, x[-1] - steps[0] / 2), ylim=(y[0] + steps[1] / 2, y[-1] - steps[1] / 2)
    )
    axes.tick_params(labelsize=7, colors=PALE)
