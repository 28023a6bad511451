"""A spatial or spherical mechanism drawn in perspective, with the axes of its joints.

Source: the drawing manner of Figs 5-12 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from singsym.classes.motions import Motion
from singsym.mechanism.model import JointKind, Space
from singsym.output.plot_scene import Body, Floats, Mark, Scene
from singsym.output.plot_style import INK, INPUT, LINK, MOTION, OUTPUT, PALE, PAPER, PLATFORM

Velocities = Mapping[tuple[str, str], Floats]


def draw_spatial(
    axes: Any, scene: Scene, motions: Sequence[tuple[Motion, Velocities]] = (), names: bool = True
) -> None:
    """Draw a scene, with a null motion's velocities as arrows, onto 3-D matplotlib axes."""
    axes.set_axis_off()
    axes.view_init(elev=24, azim=-62)
    size = scene.size
    if scene.space is Space.SPHERICAL:
        _sphere(axes, scene)
        size = 1.9
    else:
        for body in scene.bodies:
            _body(axes, body)
    for mark in scene.marks:
        _joint(axes, mark, size, scene.space)
    for place in scene.outputs:
        axes.plot(*place.reshape(3, 1), "D", ms=6, mfc=OUTPUT, mec=INK, mew=1, zorder=9)
    if names:
        _names(axes, scene, size)
    for motion, velocities in motions:
        _arrows(axes, scene, motion, velocities, size)
    points = scene.all_points if scene.space is not Space.SPHERICAL else np.array([[-1.15] * 3, [1.15] * 3])
    low, high = points.min(axis=0), points.max(axis=0)
    # flat scenes keep some depth, or the view would be cut at arrows and axes
    middle, half = (low + high) / 2, 0.56 * np.maximum(high - low, 0.4 * size)
    axes.set(xlim=(middle[0] - half[0], middle[0] + half[0]), ylim=(middle[1] - half[1], middle[1] + half[1]))
    axes.set(zlim=(middle[2] - half[2], middle[2] + half[2]))
    axes.set_box_aspect(tuple(half), zoom=1.08)


def _body(axes: Any, body: Body) -> None:
    """A plate for three points or more, a rod for two; the ground as a pale plate."""
    places = body.places
    if len(places) >= 3:
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        fill = PALE if body.ground else PLATFORM if body.output else LINK
        edge = PALE if body.ground else INK
        plate = Poly3DCollection([_outline(places)], fc=fill, ec=edge, lw=1.3)
        plate.set_alpha(0.25 if body.ground else 0.75)
        axes.add_collection3d(plate)
    elif len(places) == 2:
        colour = PALE if body.ground else OUTPUT if body.output else INK
        axes.plot(*places.T, "-", color=colour, lw=4.5 if not body.ground else 1.5, solid_capstyle="round")


def _outline(places: Floats) -> Floats:
    """The corners of a plate in order, seen along its normal."""
    arms = places - places.mean(axis=0)
    u, v = np.linalg.svd(arms)[2][:2]
    found: Floats = places[np.argsort(np.arctan2(arms @ v, arms @ u))]
    return found


def _joint(axes: Any, mark: Mark, size: float, space: Space) -> None:
    """Axes as dash-dotted lines through a short cylinder, slides as telescopes, spherical joints as balls."""
    place = mark.place
    colour = INPUT if mark.active else OUTPUT if mark.output else INK
    u = mark.direction
    if space is Space.SPHERICAL and u is not None:
        _line(axes, np.zeros(3), 1.2 * u, color=colour, lw=1.3, ls="-.")
        axes.plot(*(u.reshape(3, 1)), "o", ms=6, mfc=PAPER, mec=colour, mew=1.6)
        return
    if mark.joint.kind is JointKind.P and u is not None:
        if float(np.linalg.norm(mark.place - mark.base)) > 0.02 * size:
            _line(axes, mark.base, mark.place, color=colour, lw=2)
            _line(axes, mark.base, (mark.base + mark.place) / 2, color=colour, lw=5.5)
        else:
            _line(axes, place - 0.09 * size * u, place + 0.09 * size * u, color=colour, lw=5.5)
        return
    if mark.joint.kind is JointKind.S or u is None:
        axes.plot(*place.reshape(3, 1), "o", ms=7, mfc=colour if mark.active else PALE, mec=INK, mew=1)
        return
    _line(axes, place - 0.14 * size * u, place + 0.14 * size * u, color=colour, lw=1, ls="-.")
    _line(axes, place - 0.035 * size * u, place + 0.035 * size * u, color=colour, lw=8)
    if mark.grounded:
        axes.plot(*place.reshape(3, 1), "^", ms=8, mfc=PAPER, mec=INK, mew=1.2)


def _line(axes: Any, start: Floats, end: Floats, **style: Any) -> None:
    axes.plot(*np.array([start, end]).T, solid_capstyle="butt", **style)


def _sphere(axes: Any, scene: Scene) -> None:
    """Links as arcs of great circles on the unit sphere, between the axes of their joints."""
    for turn in (np.eye(3), np.eye(3)[[0, 2, 1]], np.eye(3)[[2, 1, 0]]):
        t = np.linspace(0, 2 * np.pi, 90)
        circle = np.array([np.cos(t), np.sin(t), 0 * t]).T @ turn
        axes.plot(*circle.T, color=PALE, lw=0.5, alpha=0.7)
    for body in scene.bodies:
        ends = [
            m.direction
            for m in scene.marks
            if m.direction is not None and body.name in (m.joint.first, m.joint.second)
        ]
        for a, b in pairwise(ends):
            t = np.linspace(0, 1, 40)[:, None]
            chord = (1 - t) * a + t * b
            norms = np.linalg.norm(chord, axis=1, keepdims=True)
            arc = chord / np.where(norms < 1e-6, 1.0, norms)
            colour = PALE if body.ground else OUTPUT if body.output else INK
            axes.plot(*arc.T, "-", color=colour, lw=2 if body.ground else 4)


def _names(axes: Any, scene: Scene, size: float) -> None:
    """Names of points beside them; of joints, on the sphere."""
    if scene.space is Space.SPHERICAL:
        places = {m.joint.name: 1.24 * m.direction for m in scene.marks if m.direction is not None}
    else:
        places = {name.partition(".")[2] or name: place for name, place in scene.names.items()}
    groups: list[tuple[Floats, list[str]]] = []
    for name, place in places.items():
        known = next((g for p, g in groups if float(np.abs(p - place).max()) < 1e-4 * size), None)
        if known is None:
            groups.append((place, [name]))
        else:
            known.append(name)
    middle = scene.all_points.mean(axis=0)
    for place, group in groups:
        away = place - middle
        away = away / max(float(np.linalg.norm(away)), 1e-9)
        label = ", ".join(group[:3])
        axes.text(*(place + 0.07 * size * away), label, fontsize=10, color=INK, ha="center", va="center")


def _arrows(axes: Any, scene: Scene, motion: Motion, velocities: Velocities, size: float) -> None:
    shown: list[tuple[Floats, Floats]] = []
    for body in scene.bodies:
        for name, place in body.points.items():
            v = velocities[body.name, name]
            if all(np.abs(place - p).max() + np.abs(v - w).max() > 1e-7 for p, w in shown):
                shown.append((place, v))
    fastest = max((float(np.linalg.norm(v)) for _, v in shown), default=0.0)
    for place, v in shown if fastest > 1e-9 else ():
        if float(np.linalg.norm(v)) > 1e-3 * fastest:
            arrow = v * (0.28 * size / fastest)
            axes.quiver(*place, *arrow, color=MOTION[str(motion.type)], lw=2.2, arrow_length_ratio=0.28)
