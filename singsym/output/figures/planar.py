"""A planar mechanism drawn with the standard symbols: hatched ground, pins, sliders, bars and plates.

Source: the drawing manner of Figs 1-4 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from singsym.mechanism.model import JointKind
from singsym.output.figures.labels import (
    Segment,
    draw_arrows,
    draw_later,
    name_groups,
    set_margins,
    write_names,
)
from singsym.output.figures.motions import Moving
from singsym.output.figures.scene import Body, Mark, Scene, distinct
from singsym.output.figures.style import (
    INK,
    INPUT,
    LINK,
    OUTPUT,
    PALE,
    PAPER,
    PLATFORM,
    Floats,
)


def draw_planar(axes: Any, scene: Scene, motions: Sequence[Moving] = ()) -> None:
    """Draw a scene, with null motions as arrows and as faint later poses, onto matplotlib axes."""
    size = scene.size
    for moving in motions:
        draw_later(axes, scene, moving)
    plates = [b for b in scene.bodies if not b.ground and b.is_plate]
    bars = [b for b in scene.bodies if not b.ground and len(b.places) >= 2 and not b.is_plate]
    for body in plates:
        _plate(axes, body)
    # shorter bars on top and thinner, so that links in line stay apart
    for rank, body in enumerate(sorted(bars, key=_length, reverse=True)):
        _bar(axes, body, 9.5 - 5.0 * rank / max(len(bars) - 1, 1))
    for mark in scene.marks:
        if mark.joint.kind is JointKind.P:
            _slider(axes, mark, size)
    grounded = [m for m in scene.marks if m.grounded and m.joint.kind is not JointKind.P]
    for place in distinct(m.base for m in grounded):
        draw_foot(axes, place, size)
    for mark in scene.marks:
        if mark.joint.kind is not JointKind.P:
            axes.plot(*mark.place, "o", ms=6.5, mfc=PAPER, mec=INK, mew=1.3, zorder=6)
    _roles(axes, scene, size)
    reached = [scene.all_points]
    arrows: list[Segment] = []
    for moving in motions:
        shown = draw_arrows(axes, scene, moving, size)
        arrows += shown
        reached += [tip.reshape(1, 2) for _, tip in shown]
        reached += [] if moving.later is None else [moving.later.all_points]
    _names(axes, scene, arrows)
    set_margins(axes, np.concatenate(reached), 0.17 * size)


def _length(body: Body) -> float:
    return float(np.ptp(body.places, axis=0).max())


def _plate(axes: Any, body: Body) -> None:
    fill = PLATFORM if body.output else LINK
    axes.fill(*body.outline.T, fc=fill, ec=INK, lw=1.4, joinstyle="round", zorder=2, alpha=0.9)


def _bar(axes: Any, body: Body, width: float) -> None:
    places = body.places
    middle = places - places.mean(axis=0)
    along = middle @ np.linalg.svd(middle)[2][0]
    ends = places[[int(along.argmin()), int(along.argmax())]]
    fill = PLATFORM if body.output else LINK
    order = 3 + 0.1 * (10 - width)
    axes.plot(*ends.T, "-", color=INK, lw=width, solid_capstyle="round", zorder=order)
    axes.plot(*ends.T, "-", color=fill, lw=width - 2, solid_capstyle="round", zorder=order + 0.01)


def draw_foot(axes: Any, place: Floats, size: float) -> None:
    """A triangle on a hatched line below a pin."""
    h = 0.055 * size
    x, y = place
    axes.fill([x, x - 0.7 * h, x + 0.7 * h], [y, y - h, y - h], fc=PAPER, ec=INK, lw=1.2, zorder=2.5)
    _hatching(axes, np.array([x - 1.1 * h, y - h]), np.array([x + 1.1 * h, y - h]), h)


def _hatching(axes: Any, start: Floats, end: Floats, h: float) -> None:
    """A fixed line with strokes on its right-hand side."""
    axes.plot(*np.array([start, end]).T, "-", color=INK, lw=1.2, zorder=2.4)
    along = (end - start) / np.linalg.norm(end - start)
    normal = np.array([along[1], -along[0]])
    count = max(3, round(float(np.linalg.norm(end - start)) / (0.45 * h)))
    for t in np.linspace(0.08, 0.98, count):
        foot = start + t * (end - start)
        tip = foot + 0.4 * h * (normal - along)
        axes.plot(*np.array([foot, tip]).T, "-", color=PALE, lw=0.9, zorder=2.3)


def _slider(axes: Any, mark: Mark, size: float) -> None:
    """A block on a guide; a telescope where both links move and their points lie apart."""
    if mark.direction is None:
        return
    u = mark.direction
    v = np.array([-u[1], u[0]])
    h = 0.05 * size
    reach = mark.place - mark.base
    if not mark.grounded and float(np.linalg.norm(reach)) > 0.02 * size:
        middle = mark.base + 0.55 * reach
        axes.plot(*np.array([mark.base, mark.place]).T, "-", color=INK, lw=2.2, zorder=2.9)
        axes.plot(*np.array([mark.base, middle]).T, "-", color=INK, lw=8, zorder=2.95, solid_capstyle="butt")
        axes.plot(*np.array([mark.base, middle]).T, "-", color=LINK, lw=6, zorder=2.96, solid_capstyle="butt")
        return
    corners = [
        mark.place + a * 1.5 * h * u + b * 0.8 * h * v for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))
    ]
    axes.fill(*np.array(corners).T, fc=LINK, ec=INK, lw=1.3, zorder=2.8)
    if mark.grounded:
        side = -v if v[1] > 0 else v
        start, end = (mark.place + s * 4 * h * u + 0.8 * h * side for s in (-1, 1))
        if np.cross(np.append(end - start, 0), np.append(side, 0))[2] > 0:
            start, end = end, start
        _hatching(axes, start, end, h)


def _roles(axes: Any, scene: Scene, size: float) -> None:
    """Inputs as turning or sliding double arrows, the output as a diamond."""
    from matplotlib.patches import Arc

    r = 0.07 * size
    for mark in scene.marks:
        if not (mark.active or mark.output):
            continue
        colour = INPUT if mark.active else OUTPUT
        if mark.joint.kind is JointKind.P and mark.direction is not None:
            middle = (mark.base + mark.place) / 2 if not mark.grounded else mark.place
            side = np.array([-mark.direction[1], mark.direction[0]]) * 0.08 * size
            tips = [middle + side + s * r * mark.direction for s in (-1, 1)]
            style = {"arrowstyle": "<->", "color": colour, "lw": 1.8, "shrinkA": 0, "shrinkB": 0}
            axes.annotate("", tips[1], tips[0], arrowprops=style, zorder=8)
            continue
        axes.add_patch(
            Arc(
                (float(mark.place[0]), float(mark.place[1])),
                2 * r,
                2 * r,
                theta1=35,
                theta2=325,
                color=colour,
                lw=1.8,
                zorder=5,
            )
        )
        a = np.deg2rad(325)
        tip = mark.place + r * np.array([np.cos(a), np.sin(a)])
        back = tip - 0.02 * size * np.array([-np.sin(a), np.cos(a)])
        style = {"arrowstyle": "-|>", "color": colour, "lw": 1.8, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", tip + (tip - back), back, arrowprops=style, zorder=8)
    for place in scene.outputs:
        axes.plot(*place, "D", ms=6, mfc=OUTPUT, mec=INK, mew=1, zorder=7)


def _names(axes: Any, scene: Scene, arrows: Sequence[Segment]) -> None:
    """The names of points, those of one place together, away from the links and arrows that meet there."""
    size = scene.size

    def reach(place: Floats) -> float:
        here = [m for m in scene.marks if float(np.abs(m.place - place).max()) < 1e-6]
        wide = any(_is_turned(m) or (m.grounded and m.joint.kind is JointKind.P) for m in here)
        return (0.115 if wide else 0.075) * size

    groups = name_groups(scene.names, 0.02 * size)
    write_names(axes, groups, [*arrows, *_segments(scene)], reach, 0.02 * size)


def _is_turned(mark: Mark) -> bool:
    """Whether a turning arrow is drawn around it."""
    return (mark.active or mark.output) and mark.joint.kind is not JointKind.P


def _segments(scene: Scene) -> list[Segment]:
    """Lines along links, grounds and sliders, where names do not go."""
    segments: list[Segment] = []
    for body in scene.bodies:
        if not body.ground:
            corners = body.outline
            segments += list(zip(corners, np.roll(corners, -1, axis=0), strict=True))
    for mark in scene.marks:
        if mark.joint.kind is JointKind.P and mark.direction is not None:
            side = np.array([-mark.direction[1], mark.direction[0]]) * 0.06 * scene.size
            middle = mark.place if mark.grounded else (mark.base + mark.place) / 2
            for shift in (-side, 0 * side, side):
                u = 0.1 * scene.size * mark.direction
                segments.append((middle + shift - u, middle + shift + u))
            if not mark.grounded:
                segments.append((mark.base, mark.place))
        elif mark.grounded:
            segments.append((mark.base, mark.base - np.array([0.0, 0.09 * scene.size])))
    return segments
