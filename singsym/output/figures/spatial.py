"""A spatial or spherical mechanism as it is seen from a viewpoint: cylinders for axes, balls, telescopes.

Source: the drawing manner of Figs 5-12 of Zlatanov, Fenton, Benhabib (1998).
Scenes and velocities come in the coordinates of the view: to the right, up, towards the reader.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from singsym.mechanism.model import JointKind, Space
from singsym.output.figures.labels import (
    Segment,
    draw_arrows,
    draw_later,
    name_groups,
    set_margins,
    write_names,
)
from singsym.output.figures.motions import Moving
from singsym.output.figures.planar import draw_foot
from singsym.output.figures.scene import Body, Mark, Scene, distinct
from singsym.output.figures.style import (
    INK,
    INPUT,
    LINK,
    MOTION,
    OUTPUT,
    PALE,
    PAPER,
    PLATFORM,
    Floats,
)

_RADIUS, _HALF, _REACH = 0.022, 0.04, 0.11
"""A revolute joint's cylinder and axis, as fractions of the size of the scene."""

_FRONT = 15
"""The drawing order of what is in front of all links."""

_ARC = 48
"""Points of an arc on the sphere."""


def draw_spatial(axes: Any, scene: Scene, view: Floats, motions: Sequence[Moving] = ()) -> None:
    """Draw a scene, with null motions as arrows and as faint later poses, onto plane matplotlib axes.

    view: the rotation to the coordinates of the view, one a row; a triad shows the axes of the ground in it.
    """
    spherical = scene.space is Space.SPHERICAL
    size = 2.2 if spherical else float(np.ptp(scene.all_points[:, :2], axis=0).max())
    depth = _Depth(scene)
    if spherical:
        _sphere(axes)
    for moving in motions:
        if spherical:
            _later_arcs(axes, scene, moving)
        else:
            draw_later(axes, scene, moving)
    for body in scene.bodies:
        if body.is_plate and not spherical:
            _plate(axes, body, depth(body.places))
        else:
            for line in _arcs(body) if spherical else (body.places,):
                _rod(axes, body, line, depth(line), depth.nearness(line))
    if not spherical:
        _feet(axes, scene, size)
    for mark in scene.marks:
        order = _FRONT if spherical else _order(mark, scene, depth)
        _joint(axes, mark, size, order, spherical)
    for place in scene.outputs:
        axes.plot(*place[:2], "D", ms=7, mfc=OUTPUT, mec=INK, mew=1, zorder=17)
    arrows = [a for moving in motions for a in draw_arrows(axes, scene, moving, size)]
    spots = _names(axes, scene, size, arrows)
    reached = [scene.all_points[:, :2], *(np.array(a) for a in arrows), *(s[None] for s in spots)]
    reached += [np.array([m.place[:2] + s * _REACH * size * u[:2] for s in (-1, 1)]) for m, u in _axes(scene)]
    if spherical:
        reached.append(np.array([[-1.0, -1.0], [1.0, 1.0]]))
    if not spherical:
        reached += [m.later.all_points[:, :2] for m in motions if m.later is not None]
    whole = np.concatenate(reached)
    set_margins(axes, whole, 0.06 * size)
    _triad(axes, view, whole)


def _triad(axes: Any, view: Floats, drawn: Floats) -> None:
    """The axes of the ground as the view shows them, in the emptiest corner."""
    low, high = drawn.min(axis=0), drawn.max(axis=0)
    corners = [(x, y) for x in (0.08, 0.92) for y in (0.08, 0.92)]
    spots = [low + np.array(corner) * (high - low) for corner in corners]
    corner = corners[int(np.argmax([np.linalg.norm(drawn - spot, axis=1).min() for spot in spots]))]
    far = {"annotation_clip": False, "zorder": 0.5}
    for name, along in zip("xyz", view.T, strict=True):
        tip, letter = 22 * along[:2], 29 * along[:2] + (0 if np.hypot(*along[:2]) > 0.3 else 7)
        style = {"arrowstyle": "-|>", "color": PALE, "lw": 1.2, "shrinkA": 0, "shrinkB": 0}
        ends = {"xycoords": "axes fraction", "textcoords": "offset points", **far}
        axes.annotate("", corner, tip, arrowprops={**style, "arrowstyle": "<|-"}, **ends)
        axes.annotate(name, corner, letter, fontsize=8, color=PALE, ha="center", va="center", **ends)


class _Depth:
    """The drawing order of places: from 3 at the back to 13 in front."""

    def __init__(self, scene: Scene) -> None:
        heights = scene.all_points[:, 2]
        self._low, self._range = float(heights.min()), max(float(np.ptp(heights)), 1e-9)

    def __call__(self, places: Floats) -> float:
        return 3 + 10 * self.nearness(places)

    def nearness(self, places: Floats) -> float:
        """From 0 at the back to 1 in front."""
        return (float(np.mean(np.atleast_2d(places)[:, 2])) - self._low) / self._range


def _order(mark: Mark, scene: Scene, depth: _Depth) -> float:
    """In front of the links of all joints at its place; inputs and outputs in front of other joints there."""
    here = [m for m in scene.marks if np.abs(m.place - mark.place).max() < 1e-6 * scene.size]
    links = {name for m in here for name in m.links}
    ends = [depth(b.places) for b in scene.bodies if b.name in links and len(b.places) > 1]
    return max([depth(mark.place), *ends]) + (0.5 if mark.active or mark.output else 0.05)


def _axes(scene: Scene) -> Iterator[tuple[Mark, Floats]]:
    """The axes that are drawn as lines."""
    if scene.space is not Space.SPHERICAL:
        yield from ((m, u) for m in scene.marks if m.joint.kind is not JointKind.P for u in m.axes)


# -- links ---------------------------------------------------------------------------------------------


def _plate(axes: Any, body: Body, order: float) -> None:
    """A link with corners that are not on a line; the ground hatched, behind everything."""
    fill = PLATFORM if body.output else LINK
    corners = body.outline[:, :2].T
    if body.ground:
        axes.fill(*corners, fc="none", ec=PALE, lw=0.7, hatch="///", alpha=0.45, zorder=1)
    else:
        axes.fill(*corners, fc=fill, ec=INK, lw=1.4, joinstyle="round", alpha=0.85, zorder=order)


def _rod(axes: Any, body: Body, line: Floats, order: float, nearness: float) -> None:
    """A link along a line or an arc, wider where it is near, with a gap in what it crosses; ground thin."""
    if len(line) < 2:
        return
    fill, ends = PLATFORM if body.output else LINK, line[:, :2].T
    if body.ground:
        axes.plot(*ends, "-", color=PALE, lw=1.2, zorder=1)
    else:
        wide = 4.6 + 3.4 * nearness
        axes.plot(*ends, "-", color=PAPER, lw=wide + 3, solid_capstyle="butt", zorder=order - 0.01)
        axes.plot(*ends, "-", color=INK, lw=wide, solid_capstyle="round", zorder=order)
        axes.plot(*ends, "-", color=fill, lw=wide - 2.2, solid_capstyle="round", zorder=order + 0.01)


def _arcs(body: Body) -> Iterator[Floats]:
    """A link of a spherical mechanism: arcs of great circles between its axes."""
    for a, b in pairwise(body.points.values()):
        t = np.linspace(0, 1, _ARC)[:, None]
        chord = (1 - t) * a + t * b
        norms = np.linalg.norm(chord, axis=1, keepdims=True)
        yield chord / np.where(norms < 1e-6, 1.0, norms)


def _later_arcs(axes: Any, scene: Scene, moving: Moving) -> None:
    """The links of a spherical mechanism a little later, faint, where they have moved."""
    if moving.later is None:
        return
    look = {"color": MOTION[str(moving.motion.type)], "alpha": 0.28, "lw": 3, "zorder": 1.5}
    for before, after in zip(scene.bodies, moving.later.bodies, strict=True):
        if any(np.abs(after.points[n] - p).max() > 1e-3 for n, p in before.points.items()):
            for line in _arcs(after):
                axes.plot(*line[:, :2].T, "-", solid_capstyle="round", **look)


def _sphere(axes: Any) -> None:
    """The outline of the unit sphere and its centre."""
    t = np.linspace(0, 2 * np.pi, 120)
    axes.plot(np.cos(t), np.sin(t), color=PALE, lw=0.8, zorder=0)
    axes.plot(0, 0, "o", ms=3, color=PALE, zorder=0)


# -- joints --------------------------------------------------------------------------------------------


def _feet(axes: Any, scene: Scene, size: float) -> None:
    """A foot with hatching under each joint of the ground, where the ground is no plate."""
    plates = [b for b in scene.bodies if b.ground and b.is_plate]
    places = [m.base for m in scene.marks if m.grounded]
    if not plates and places:
        for place in distinct(places):
            draw_foot(axes, place[:2] - np.array([0.0, _RADIUS * size]), size)


def _joint(axes: Any, mark: Mark, size: float, order: float, spherical: bool) -> None:
    colour = INPUT if mark.active else OUTPUT if mark.output else INK
    fill = colour if mark.active or mark.output else PAPER
    if spherical and mark.direction is not None:
        _line(axes, 0 * mark.direction, 1.12 * mark.direction, color=colour, lw=1.1, ls="-.", zorder=2)
        axes.plot(*mark.direction[:2], "o", ms=8, mfc=fill, mec=INK, mew=1.3, zorder=order)
    elif mark.joint.kind is JointKind.P and mark.direction is not None:
        _slide(axes, mark, size, order - 0.1)
    elif mark.direction is None:
        axes.plot(*mark.place[:2], "o", ms=9, mfc=fill, mec=INK, mew=1.3, zorder=order)
        axes.plot(*(mark.place[:2] + 0.004 * size * np.array([-1, 1])), "o", ms=2, color=PALE, zorder=order)
    else:
        if float(np.linalg.norm(mark.place - mark.base)) > 0.02 * size:
            _line(axes, mark.base, mark.place, color=INK, lw=2.4, zorder=order - 0.4)
        for u in mark.axes:
            reach = _REACH * size * u
            line = {"color": colour, "lw": 1.1, "ls": "-.", "zorder": order - 0.3}
            _line(axes, mark.place - reach, mark.place + reach, **line)
            half = _HALF * size * (1.6 if mark.joint.kind is JointKind.C else 1.0)
            _cylinder(axes, mark.place, u, half, _RADIUS * size, fc=fill, zorder=order)


def _cylinder(axes: Any, middle: Floats, u: Floats, half: float, radius: float, **style: Any) -> None:
    """A cylinder about an axis: its far end, its side, its near end."""
    from matplotlib.patches import Ellipse

    towards = u if u[2] > 0 else -u
    across = np.array([-u[1], u[0]])
    length = float(np.linalg.norm(across))
    across = across / length if length > 1e-9 else np.array([1.0, 0.0])
    far, near = (middle[:2] + s * half * towards[:2] for s in (-1, 1))
    angle = float(np.degrees(np.arctan2(across[1], across[0])))
    ends = {"width": 2 * radius, "height": 2 * radius * abs(float(u[2])), "angle": angle}
    axes.add_patch(Ellipse((float(far[0]), float(far[1])), ec=INK, lw=1.1, **ends, **style))
    corners = [far + radius * across, near + radius * across, near - radius * across, far - radius * across]
    axes.fill(*np.array(corners).T, ec="none", **style)
    for side in (corners[:2], corners[2:]):
        axes.plot(*np.array(side).T, color=INK, lw=1.1, zorder=style["zorder"])
    axes.add_patch(Ellipse((float(near[0]), float(near[1])), ec=INK, lw=1.1, **ends, **style))


def _slide(axes: Any, mark: Mark, size: float, order: float) -> None:
    """A telescope between its points, or a block where they are together."""
    colour = INPUT if mark.active else OUTPUT if mark.output else LINK
    u = mark.axes[0]
    apart = float(np.linalg.norm(mark.place - mark.base)) > 0.05 * size
    start, end = (
        (mark.base, mark.place) if apart else (mark.place - 0.12 * size * u, mark.place + 0.12 * size * u)
    )
    _line(axes, start, end, color=INK, lw=2.4, zorder=order)
    low, high = (start, (start + end) / 2) if apart else (start + (end - start) / 4, end - (end - start) / 4)
    _line(axes, low, high, color=INK, lw=8.5 if apart else 13, zorder=order + 0.01)
    _line(
        axes,
        low + 0.004 * size * u,
        high - 0.004 * size * u,
        color=colour,
        lw=6.2 if apart else 10.5,
        zorder=order + 0.02,
    )


def _line(axes: Any, start: Floats, end: Floats, **style: Any) -> None:
    axes.plot(*np.array([start, end])[:, :2].T, solid_capstyle="butt", **style)


# -- names ---------------------------------------------------------------------------------------------


def _names(axes: Any, scene: Scene, size: float, arrows: Sequence[Segment]) -> list[Floats]:
    """Names of points, or of axes on the sphere, beside links, axes and arrows; the spots taken."""
    if scene.space is Space.SPHERICAL:
        named = {m.joint.name: m.direction for m in scene.marks if m.direction is not None}
    else:
        named = dict(scene.names)
    segments: list[Segment] = list(arrows)
    for body in scene.bodies:
        if len(body.places) > 1 and not (body.ground and body.is_plate):
            corners = body.places[:, :2]
            segments += list(zip(corners, np.roll(corners, -1, axis=0), strict=True))
    for mark, u in _axes(scene):
        reach = _REACH * size * u[:2]
        segments.append((mark.place[:2] - reach, mark.place[:2] + reach))
    segments += [(m.base[:2], m.place[:2]) for m in scene.marks if scene.space is not Space.SPHERICAL]
    groups = name_groups({name: place[:2] for name, place in named.items()}, 0.02 * size)
    return write_names(axes, groups, segments, lambda _: 0.07 * size, 0.02 * size)
