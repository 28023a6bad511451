"""The curves of self-motions, in a plane of joint values or of coordinates, or as the paths of points.

Source: curves as `singsym.classes.configuration.self_motions` traces them; what is drawn are their polylines.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from singsym.classes.configuration.self_motions import SelfMotion
from singsym.kinematics.velocity import VelocityEquation
from singsym.output.figures.curves import Coordinate, finish_axes, wrapped
from singsym.output.figures.style import INK, SERIES, Floats, Picture, canvas
from singsym.output.pieces import counted
from singsym.varieties.real.curves.real_curve import CurveComponent

_STILL = 1e-6
"""A coordinate that changes by no more is at rest."""


def plot_self_motions(found: Sequence[SelfMotion], plane: tuple[str, str] | None = None) -> Picture:
    """The curves of configurations that keep the inputs, or the outputs, a panel for each.

    found: from `self_motions`; a ring marks the configuration that was given.  plane: what is drawn across
    and up, as ("A", "B") or ("C.x", "C.y"); by default the two joints whose values change the most, or else
    two coordinates of points.
    Raises `ValueError` where no curve was traced, or a label is not known.
    """
    drawn = [(m, m.curve.value, m.equation) for m in found if m.curve is not None and m.equation is not None]
    if not drawn:
        why = "; ".join(dict.fromkeys(str(m) for m in found))
        raise ValueError(f"no curve of a self-motion was traced: there is nothing to draw ({why})")
    figure = canvas(5.4 * len(drawn) + 0.6, 5.4)
    panels = figure.subplots(1, len(drawn), squeeze=False).ravel()
    said = []
    for panel, (motion, curve, equation) in zip(panels, drawn, strict=True):
        said.append(_draw(panel, motion, curve, equation, plane))
    title = "Self-motions through a configuration"
    figure.suptitle(title, fontsize=11, color=INK)
    return Picture(figure, title, f"{title}: {'; '.join(said)}")


def _draw(
    panel: Any,
    motion: SelfMotion,
    curve: CurveComponent,
    equation: VelocityEquation,
    plane: tuple[str, str] | None,
) -> str:
    """One curve in its plane, and what is seen in words."""
    lines = [_in_order(equation, curve.names, line) for line in curve.polylines]
    here = np.array([[motion.point[name] for name in equation.space.ring.names]])
    across, up = (Coordinate(label, equation) for label in plane or _moving_most(equation, lines))
    for line in lines:
        for x in wrapped(across.at(line), across.is_angle):
            for y in wrapped(up.at(line), up.is_angle):
                panel.plot(x, y, color=SERIES[0], lw=1.8)
    ring = {"mfc": "none", "mec": INK, "mew": 1.4, "ls": "none", "zorder": 5}
    panel.plot(across.at(here), up.at(here), "o", ms=7, **ring)
    finish_axes(panel, across, up)
    size = "closed" if curve.closed else counted(curve.ends, "end") + " at infinity"
    panel.set_title(f"the {motion.held} at rest: a curve, {size}", fontsize=9, color=INK)
    return f"with the {motion.held} at rest a curve, {size}, {across.label} across, {up.label} up"


def _in_order(equation: VelocityEquation, names: Sequence[str], line: Floats) -> Floats:
    """Vertices with the ring's names in their order, constants with their values."""
    fixed = {c.name: float(c.expression) for c in equation.space.ring.constants}
    columns = dict(zip(names, line.T, strict=True))
    full = [columns.get(n, np.full(len(line), fixed.get(n, 0.0))) for n in equation.space.ring.names]
    return np.array(full).T


def _moving_most(equation: VelocityEquation, lines: Sequence[Floats]) -> tuple[str, str]:
    """The two joints that change the most, of equal ones the first, else two coordinates of points."""
    places = (
        f"{name}.{axis}"
        for name, own in equation.space.points.items()
        for axis, _ in zip("xyz", own, strict=False)
    )
    for labels in (equation.values, places):
        ranges = {label: _range(Coordinate(label, equation), lines) for label in labels}
        moving = sorted((x for x in ranges if ranges[x] > _STILL), key=lambda x: -round(ranges[x], 6))
        if len(moving) > 1:
            return moving[0], moving[1]
    names = equation.space.variables
    return names[0], names[min(1, len(names) - 1)]


def _range(coordinate: Coordinate, lines: Sequence[Floats]) -> float:
    """How much it changes on the way; an angle all round."""
    values = [coordinate.at(line) for line in lines]
    if coordinate.is_angle:
        values = [np.unwrap(own) for own in values]
    return max(float(np.ptp(own)) for own in values)
