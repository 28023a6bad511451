"""Singularity curves in a plane of joint values or of output coordinates, special points marked.

Source: section 3.3 of Zlatanov, Fenton, Benhabib (1998): the loci of (4) and (5) of a 2-DOF mechanism are
curves, their intersections points; curves are traced by varieties/real/curve.py for drawing.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from singsym.classes.result import Classification, ClassResult, Locus
from singsym.effort.budget import Budget
from singsym.kinematics.placement import JointValue
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.model import JointRate
from singsym.output.figures.families import short_equation
from singsym.output.figures.style import DASHES, INK, PALE, SERIES, Floats, Picture, entitle, paper
from singsym.polynomials import Polynomial
from singsym.polynomials.compiled_map import CompiledMap
from singsym.polynomials.gauss_newton import project
from singsym.varieties.real.curves.real_curve import real_curve

_VISIBLE = 1e-3
"""How far a curve may be from its chords, as a part of its extent."""

_SHAPES = "osD^vPX*<>"


@dataclass(frozen=True, eq=False)
class Trace:
    """A locus of dimension 1 with the arcs of its components, rows in the order of the ring's names."""

    locus: Locus
    components: tuple[tuple[Floats, ...], ...]

    @property
    def label(self) -> str:
        """The condition and what it says."""
        return f"({self.locus.condition}) {self.locus.words or short_equation(self.locus.factor)}"


def trace_loci(classification: Classification, seconds: float | None = 20.0) -> tuple[Trace, ...]:
    """The curves among the loci, tracked for drawing; those that take longer than `seconds` are left out."""
    found = []
    space = classification.equation.space
    for locus in classification.loci:
        if locus.dimension == 1 and not space.parameters:
            curve = real_curve((*space.equations, locus.factor), budget=Budget(seconds), drawing=True)
            system = CompiledMap.balanced((*space.equations, locus.factor), space.ring)
            full = [
                tuple(smooth(_with_constants(classification, line), system) for line in c.polylines)
                for c in curve.components
            ]
            if full:
                found.append(Trace(locus, tuple(full)))
    return tuple(found)


def _with_constants(classification: Classification, line: Floats) -> Floats:
    """Vertices with the values of the ring's constants put in."""
    ring = classification.equation.space.ring
    constants = {c.name: float(c.expression) for c in ring.constants}
    columns = iter(line.T)
    full = [np.full(len(line), constants[n]) if n in constants else next(columns) for n in ring.names]
    return np.array(full).T


def smooth(line: Floats, system: CompiledMap, halvings: int = 4) -> Floats:
    """A polyline on the curve of a system with vertices added, until it bends less than can be seen.

    Vertices are the ends of Gauss-Newton from the chords' midpoints; what does not end near by is left out.
    """
    free = [i for i, column in enumerate(line.T) if np.ptp(column) > 0]
    size = float(np.ptp(line, axis=0).max(initial=0.0))
    for _ in range(halvings):
        vertices = [line[0]]
        for start, end in pairwise(line):
            middle = (start + end) / 2
            landed = project(system, middle, free)
            if landed is not None:
                sag, chord = np.linalg.norm(landed - middle), np.linalg.norm(end - start)
                if _VISIBLE * size < sag < chord / 3:
                    vertices.append(landed)
            vertices.append(end)
        if len(vertices) == len(line):
            break
        line = np.array(vertices)
    return line


@dataclass(frozen=True, eq=False)
class Coordinate:
    """A quantity of a configuration by its label: a joint's column, a point's coordinate, a variable."""

    label: str
    equation: VelocityEquation

    @cached_property
    def polynomials(self) -> tuple[Polynomial, ...]:
        """Multiples of cosine and sine of an angle; a length, its square, or a coordinate."""
        space, value = self.equation.space, self.equation.values.get(self.label)
        if isinstance(value, JointValue):
            if value.cosine is not None and value.sine is not None:
                return (value.cosine, value.sine)
            if value.length is not None:
                return (value.length,)
            if value.square is not None:
                return (value.square,)
        name, _, axis = self.label.rpartition(".")
        if name in space.points and axis in ("x", "y", "z"[: len(space.points[name]) - 2]):
            return (space.points[name]["xyz".index(axis)],)
        if self.label in space.ring.names:
            return (space.ring.gen(self.label),)
        known = [*self.equation.values, *(f"{p}.x" for p in space.points), *space.variables]
        raise ValueError(f"coordinate {self.label!r}: expected one of {', '.join(known)}")

    @property
    def is_angle(self) -> bool:
        """Whether it is an angle in radians, from -pi to pi."""
        return len(self.polynomials) == 2

    @cached_property
    def _system(self) -> CompiledMap:
        return CompiledMap(self.polynomials, self.equation.space.ring)

    def at(self, points: Iterable[Floats]) -> Floats:
        """Its values at points given in the order of the ring's names."""
        rows = self._system.values(np.array(list(points)))
        if self.is_angle:
            found: Floats = np.arctan2(rows[:, 1], rows[:, 0])
            return found
        return np.asarray(np.sqrt(rows[:, 0]) if self._is_squared else rows[:, 0], dtype=np.float64)

    def powered(self, values: Floats) -> Floats:
        """What the polynomial is where a length has these values."""
        return values**2 if self._is_squared else values

    @property
    def _is_squared(self) -> bool:
        value = self.equation.values.get(self.label)
        return value is not None and value.square is not None


def input_plane(classification: Classification) -> tuple[str, str] | None:
    """The two inputs of a 2-DOF mechanism, where their values are known."""
    equation = classification.equation
    inputs = [c.label for c in equation.columns if c.role == "input"]
    if len(inputs) != 2 or any(label not in equation.values for label in inputs):
        return None
    return inputs[0], inputs[1]


def output_plane(classification: Classification) -> tuple[str, str] | None:
    """Two coordinates of the output of a 2-DOF mechanism: of its point, or of its joints."""
    mechanism, equation = classification.mechanism, classification.equation
    if mechanism is None or equation.n != 2:
        return None
    labels = []
    for output in mechanism.outputs:
        if isinstance(output, JointRate):
            labels.append(output.column)
        else:
            labels += [f"{output.point}.{c.removeprefix('v')}" for c in output.components if c in _LINEAR]
    known = [label for label in labels if _is_known(label, equation)]
    return (known[0], known[1]) if len(known) == 2 else None


_LINEAR = ("x", "y", "z", "vx", "vy", "vz")


def _is_known(label: str, equation: VelocityEquation) -> bool:
    name, _, axis = label.rpartition(".")
    return label in equation.values or (name in equation.space.points and axis in ("x", "y", "z"))


def plot_curves(
    classification: Classification,
    plane: str | tuple[str, str] = "inputs",
    traces: Sequence[Trace] | None = None,
    *,
    axes: Any = None,
) -> Picture:
    """The singularity curves of a mechanism in a plane, with the points where classes meet.

    plane: "inputs", "outputs", or two labels: joint columns, `B.x` of named points, configuration variables.
    traces: from `trace_loci`, where they are known already.
    axes: of matplotlib, to draw on; None: those of a new figure.
    Raises `ValueError` where the plane is not known or there are no curves.
    """
    axes_of = {"inputs": input_plane, "outputs": output_plane}
    chosen = axes_of[plane](classification) if isinstance(plane, str) and plane in axes_of else plane
    if chosen is None or isinstance(chosen, str):
        raise ValueError(_no_plane(classification, plane))
    traces = trace_loci(classification) if traces is None else traces
    if not traces:
        raise ValueError("no locus is a curve that could be traced: there is nothing to draw")
    across, up = (Coordinate(label, classification.equation) for label in chosen)
    alone = axes is None
    axes = paper(axes, 6.4, 5.6)
    draw_traces(axes, traces, across, up)
    for result, shape in zip(_finite(classification), _SHAPES, strict=False):
        points = [_vector(classification, w.coordinates) for w in result.witnesses]
        label = f"class {result.singularity_class.number} ({result.singularity_class.name})"
        style = {"mfc": "none", "mec": INK, "mew": 1.3, "ls": "none", "zorder": 5}
        axes.plot(across.at(points), up.at(points), shape, ms=6.5, label=label, **style)
    finish_axes(axes, across, up)
    _explain(axes, alone=alone)
    where = {"inputs": "over the inputs", "outputs": "over the output"}.get(str(plane), "")
    title = f"Singularity curves {where}".strip()
    entitle(axes, title, alone=alone)
    described = "; ".join(t.label for t in traces)
    return Picture(axes.figure, title, f"{title}: {chosen[0]} across, {chosen[1]} up. Curves: {described}")


def draw_traces(
    axes: Any, traces: Sequence[Trace], across: Coordinate, up: Coordinate, width: float = 1.7
) -> None:
    """The curves in a plane of two coordinates."""
    for i, trace in enumerate(traces):
        style = {"color": SERIES[i % len(SERIES)], "ls": DASHES[i % len(DASHES)], "lw": width}
        lines = [arc for component in trace.components for arc in component]
        for j, line in enumerate(lines):
            label = trace.label if j == 0 else None
            for x in wrapped(across.at(line), across.is_angle):
                for y in wrapped(up.at(line), up.is_angle):
                    # a curve along which neither coordinate changes is a point of the plane
                    marker = "." if np.ptp(x) + np.ptp(y) < 1e-6 else None
                    axes.plot(x, y, label=label, marker=marker, **style)
                    label = None


def _no_plane(classification: Classification, plane: object) -> str:
    if plane not in ("inputs", "outputs"):
        return f"plane {plane!r}: expected 'inputs', 'outputs' or two labels"
    n = classification.equation.n
    reason = f"has n = {n}" if n != 2 else f"has no two known coordinates of its {plane}"
    return f"curves over the {plane} are for mechanisms of mobility 2: this one {reason}"


def _finite(classification: Classification) -> list[ClassResult]:
    """The classes that are finite sets of known points."""
    return [c for c in classification.classes if c.dimension == 0 and c.witnesses]


def _vector(classification: Classification, coordinates: object) -> Floats:
    names = classification.equation.space.ring.names
    return np.array([float(coordinates[name]) for name in names])  # type: ignore[index]


def wrapped(values: Floats, is_angle: bool) -> list[Floats]:
    """An angle made continuous, in as many copies as are needed to fill the interval from -pi to pi."""
    if not is_angle:
        return [values]
    whole = np.unwrap(values)
    first, last = (round(float(v) / (2 * np.pi)) for v in (whole.min(), whole.max()))
    copies = (whole - 2 * np.pi * turns for turns in range(first - 1, last + 2))
    return [copy for copy in copies if copy.min() <= np.pi and copy.max() >= -np.pi]


def finish_axes(axes: Any, across: Coordinate, up: Coordinate) -> None:
    """Labels, and ticks in multiples of pi for angles."""
    ticks = [(-np.pi, "−π"), (-np.pi / 2, "−π/2"), (0, "0"), (np.pi / 2, "π/2"), (np.pi, "π")]
    for coordinate, axis, limits in ((across, axes.xaxis, axes.set_xlim), (up, axes.yaxis, axes.set_ylim)):
        if coordinate.is_angle:
            axis.set_ticks([t for t, _ in ticks], [name for _, name in ticks])
            limits(-np.pi, np.pi)
        name = f"angle at {coordinate.label}" if coordinate.is_angle else coordinate.label
        axis.set_label_text(name, color=INK)
    if across.is_angle == up.is_angle:
        axes.set_aspect("equal", adjustable="box")
    axes.grid(color=PALE, alpha=0.3, lw=0.6)
    axes.tick_params(colors=INK)
    for spine in axes.spines.values():
        spine.set_color(PALE)


def _explain(axes: Any, *, alone: bool) -> None:
    """The legend below the axes."""
    look = {"fontsize": 8.5, "handlelength": 3.4, "frameon": False, "labelcolor": INK}
    if alone:
        axes.figure.legend(loc="outside lower center", ncols=2, **look)
    else:
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), **look)
