"""Arrows of null motions and names of points, for plane drawings: names where links and arrows leave room.

Source: singsym's own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from singsym.output.figures.motions import Moving
from singsym.output.figures.scene import Scene
from singsym.output.figures.style import INK, MOTION, PAPER, Floats

Segment = tuple[Floats, Floats]

_RINGS, _CLEAR = (1.0, 1.35, 1.7), 2.2
"""How far from its place a label may stand, over the usual, and from segments, over the width of a letter."""


def name_groups(names: Mapping[str, Floats], near: float) -> list[tuple[Floats, str]]:
    """Places with a label each; names of places nearer than `near` go together."""
    groups: list[tuple[Floats, list[str]]] = []
    for name, place in names.items():
        short = name.partition(".")[2] or name
        known = next((g for p, g in groups if float(np.abs(p - place).max()) < near), None)
        if known is None:
            groups.append((place, [short]))
        elif short not in known:
            known.append(short)
    return [(place, ", ".join(sorted(group))) for place, group in groups]


def write_names(
    axes: Any,
    groups: Sequence[tuple[Floats, str]],
    segments: Sequence[Segment],
    reach: Callable[[Floats], float],
    letter: float,
) -> list[Floats]:
    """Write labels beside their places, away from segments and from one another; the spots taken.

    reach: how far from a place its label stands.  letter: the width of a letter.
    """
    occupied: list[Segment] = list(segments)
    spots = []
    for place, label in groups:
        half = np.array([0.5 * letter * (len(label) - 1), 0.0])
        spot = _free_spot(place, reach(place), half, occupied, letter)
        axes.annotate(label, spot, ha="center", va="center", fontsize=11, color=INK, zorder=19)
        occupied.append((spot - half, spot + half))
        spots += [spot - half, spot + half]
    return spots


def _free_spot(
    place: Floats, reach: float, half: Floats, segments: Sequence[Segment], letter: float
) -> Floats:
    """The middle of a label of this half width beside a place: the nearest that is clear of all segments.

    Where none is, the one farthest from them.
    """
    best, found = -1.0, place
    for ring in _RINGS:
        for a in np.linspace(0, 2 * np.pi, 16, endpoint=False) + np.pi / 4:
            u = np.array([np.cos(a), np.sin(a)])
            spot = place + ring * reach * u + np.clip(2 * u[0], -1, 1) * half
            letters = (spot - half, spot, spot + half)
            clearance = min((_distance(p, *s) for s in segments for p in letters), default=1.0)
            if clearance > best + 1e-6:
                best, found = clearance, spot
        if best > _CLEAR * letter:
            break
    return found


def _distance(p: Floats, a: Floats, b: Floats) -> float:
    """From a point to a segment."""
    d = b - a
    square = float(d @ d)
    t = 0.0 if square < 1e-18 else min(1.0, max(0.0, float((p - a) @ d) / square))
    return float(np.linalg.norm(p - a - t * d))


def draw_arrows(axes: Any, scene: Scene, moving: Moving, size: float) -> list[Segment]:
    """Velocities of the points as arrows, the longest a quarter of `size`; their ends.

    A velocity towards the reader is a circle with a dot, one away from the reader a circle with a cross.
    """
    shown: list[tuple[Floats, Floats]] = []
    for body in scene.bodies:
        for name, place in body.points.items():
            v = moving.velocities[body.name, name]
            if all(np.abs(place - p).max() + np.abs(v - w).max() > 1e-7 for p, w in shown):
                shown.append((place, v))
    fastest = max((float(np.linalg.norm(v)) for _, v in shown), default=0.0)
    drawn: list[Segment] = []
    colour = MOTION[str(moving.motion.type)]
    for place, v in shown if fastest > 1e-9 else ():
        if float(np.linalg.norm(v)) < 1e-3 * fastest:
            continue
        start, flat = place[:2], v[:2]
        if float(np.linalg.norm(flat)) < 0.12 * fastest and len(v) == 3:
            style = {"mec": colour, "mew": 1.8, "zorder": 18}
            axes.plot(*start, "o", ms=11, mfc=PAPER, **style)
            axes.plot(*start, "o" if v[2] > 0 else "x", ms=3 if v[2] > 0 else 7, mfc=colour, **style)
            drawn.append((start, start))
            continue
        tip = start + flat * (0.25 * size / fastest)
        style = {
            "arrowstyle": "-|>,head_width=0.28,head_length=0.55",
            "color": colour,
            "lw": 2.2,
            "shrinkA": 0,
            "shrinkB": 0,
        }
        axes.annotate("", tip, start, arrowprops=style, zorder=18, annotation_clip=False)
        drawn.append((start, tip))
    return drawn


def draw_later(axes: Any, now: Scene, moving: Moving) -> None:
    """The pose a little later, faint and in the colour of its motion; what has not moved is left out."""
    if moving.later is None:
        return
    look = {"color": MOTION[str(moving.motion.type)], "alpha": 0.28}
    for before, after in zip(now.lines(), moving.later.lines(), strict=True):
        if before.shape != after.shape or float(np.abs(before - after).max()) > 1e-3 * now.size:
            axes.plot(*after[:, :2].T, "-", lw=3, solid_capstyle="round", zorder=1.5, **look)
            axes.plot(*after[:, :2].T, "o", ms=4, mew=0, zorder=1.6, **look)


def set_margins(axes: Any, points: Floats, margin: float) -> None:
    """Limits that leave `margin` around points."""
    low, high = points.min(axis=0), points.max(axis=0)
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
