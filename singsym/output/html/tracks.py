"""The ways that scenes of a report go: along singularity curves, and along null motions.

Source: singsym's own; Figs 2-4 of Zlatanov, Fenton, Benhabib (1998) show null motions as arrows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from singsym.classes.configuration.null_motions import Motion
from singsym.output.figures.curves import Coordinate, Trace
from singsym.output.figures.motions import WORDS
from singsym.output.figures.poses import poses_along
from singsym.output.figures.scene import Stage
from singsym.output.figures.style import Floats, Picture
from singsym.output.html.scenes import Track

FRAMES, MOST_FRAMES = 48, 600
"""Configurations along each arc, and on all arcs together."""

_STEPS = tuple(np.linspace(-1, 1, 13))


def motion_tracks(stage: Stage, point: Floats, motions: Sequence[Motion]) -> list[Track]:
    """Along each null motion, both ways, as far as the mechanism follows it with its links rigid."""
    found = []
    for motion in motions:
        poses = poses_along(stage, point, motion.rates, _STEPS)
        if poses:
            found.append(Track(WORDS[motion.type], np.array(poses), centred=True))
    return found


def curve_tracks(
    stage: Stage, traces: Sequence[Trace], plots: Mapping[str, tuple[Picture, tuple[str, str]]]
) -> list[Track]:
    """Along each arc of the singularity curves, with the inputs' values and the marks on plots of planes.

    plots: pictures by the name of their plane, with the labels of its coordinates.
    """
    arcs = [
        (f"{trace.label}, part {k} of {len(trace.components)}", arc)
        for trace in traces
        for k, component in enumerate(trace.components, 1)
        for arc in component
        if len(arc) > 1
    ]
    count = max(12, min(FRAMES, MOST_FRAMES // max(len(arcs), 1)))
    inputs = [
        Coordinate(label, stage.equation)
        for label in stage.mechanism.inputs
        if label in stage.equation.values
    ]
    found = []
    for label, arc in arcs:
        points = _resampled(arc, count)
        marks = {}
        for plane, (picture, chosen) in plots.items():
            x, y = (Coordinate(name, stage.equation).at(points) for name in chosen)
            marks[plane] = picture.places(x, y)
        found.append(Track(label, points, _notes(inputs, points), marks))
    return found


def _notes(inputs: Sequence[Coordinate], points: Floats) -> list[str]:
    """The values of the inputs in degrees and lengths."""
    values = [c.at(points) * (180 / np.pi if c.is_angle else 1) for c in inputs]
    units = ["°" if c.is_angle else "" for c in inputs]
    return [
        ", ".join(f"{c.label} = {v[i]:.1f}{unit}" for c, v, unit in zip(inputs, values, units, strict=True))
        for i in range(len(points))
    ]


def _resampled(line: Floats, count: int) -> Floats:
    """So many vertices of a polyline at even distances."""
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = np.linspace(0, along[-1], count)
    return np.array([np.interp(wanted, along, column) for column in line.T]).T
