"""Scenes of a page that turn and move: shapes and the places they follow, drawn by `viewer.js`.

Source: singsym's own; configurations lie on the tracked curves of varieties/real/curves, or on null motions.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from importlib.resources import files
from itertools import pairwise
from typing import Any

import numpy as np

from singsym.mechanism.model import JointKind, Space
from singsym.output.figures.scene import Body, Mark, Scene, Stage
from singsym.output.figures.style import Floats
from singsym.output.figures.view import viewpoint

_WIDTH, _HEIGHT, _MARGIN = 640, 480, 50
_UNITS = 1000
"""The farthest place from the middle, in the whole numbers that places are written as."""

_SPHERE = 205
"""Pixels from the middle to the farthest place of a scene that turns, where that is as near as the middle."""

_AXIS = 0.12
"""Half of a joint's axis, over the size of the scene."""

_FOOT = "M0 0l-13 22h26zM-20 22h40M-14 22l-7 8M-3 22l-7 8M8 22l-7 8M19 22l-7 8"
_DIAMOND = "M0 -9l9 9l-9 9l-9 -9z"

_Where = Callable[[Scene], Floats]


@dataclass(frozen=True, eq=False)
class Track:
    """Configurations to go through, one a row, with a note for each.

    marks: by the name of a plane, where each is on the plots of it, in their units.
    centred: whether it begins in the middle.
    """

    label: str
    points: Floats
    notes: Sequence[str] = ()
    marks: Mapping[str, Floats] = field(default_factory=dict)
    centred: bool = False


def script() -> str:
    """What moves the scenes of a page."""
    return files("singsym.output.html").joinpath("viewer.js").read_text(encoding="utf-8")


def style() -> str:
    """How they look."""
    return files("singsym.output.html").joinpath("viewer.css").read_text(encoding="utf-8")


def scene_box(stage: Stage, tracks: Sequence[Track], described: str) -> str:
    """A drawing of a mechanism as HTML, with a button, a slider and a choice where there is more than one.

    described: what it shows, for those who cannot see it.
    """
    scenes = [[stage.scene(point) for point in track.points] for track in tracks]
    first = scenes[0][0]
    places = _Places([scene for along in scenes for scene in along])
    shapes = list(_shapes(first, places))
    frames = places.frames()
    moves = np.flatnonzero(np.ptp(frames, axis=0).any(axis=1))
    ends = np.cumsum([len(along) for along in scenes])[:-1]
    data = {
        "flat": first.space is Space.PLANAR,
        "view": _angles(first),
        "fixed": frames[0].tolist(),
        "moving": moves.tolist(),
        "shapes": shapes,
        "tracks": [
            {
                "frames": own[:, moves].reshape(len(own), -1).tolist(),
                **_fit(own, first.space),
                "notes": list(track.notes),
                "marks": {plane: np.round(at, 1).tolist() for plane, at in track.marks.items()},
            }
            for track, own in zip(tracks, np.split(frames, ends), strict=True)
        ],
    }
    text = json.dumps(data, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")
    return (
        f'<div class="scene">{_drawing(first, described)}{_controls(tracks)}'
        f'<script type="application/json">{text}</script></div>'
    )


def _angles(scene: Scene) -> tuple[float, float]:
    """Azimuth and elevation of the view at first."""
    if scene.space is Space.PLANAR:
        return 0.0, 0.0
    view = viewpoint(scene)
    return round(float(np.arctan2(-view[0, 0], view[0, 1])), 3), round(float(np.arcsin(view[2, 2])), 3)


def _drawing(scene: Scene, described: str) -> str:
    """The empty drawing: a frame that can be turned where it is of space."""
    turns = "" if scene.space is Space.PLANAR else ". Arrow keys and dragging turn it, Home turns it back"
    label = escape(f"{described}{turns}", quote=True)
    size = f'viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" aria-label="{label}"'
    if scene.space is Space.PLANAR:
        return f"<svg {size}></svg>"
    origin = f'x1="46" y1="{_HEIGHT - 46}" x2="46" y2="{_HEIGHT - 46}"'
    triad = "".join(f'<line class="triad" {origin}/>' for _ in "xyz")
    triad += "".join(f'<text class="triad">{name}</text>' for name in "xyz")
    middle = f'cx="{_WIDTH / 2:g}" cy="{_HEIGHT / 2:g}" r="{_SPHERE}"'
    sphere = f'<circle class="sphere" {middle}/>' if scene.space is Space.SPHERICAL else ""
    return f'<svg {size} tabindex="0">{triad}{sphere}</svg>'


def _controls(tracks: Sequence[Track]) -> str:
    most = max(len(track.points) for track in tracks)
    if most < 2:
        return ""
    choice = ""
    if len(tracks) > 1:
        options = "".join(f'<option value="{i}">{escape(t.label)}</option>' for i, t in enumerate(tracks))
        choice = f"<p><label>Along <select>{options}</select></label></p>"
    start = len(tracks[0].points) // 2 if tracks[0].centred else 0
    return (
        f'{choice}<p><button type="button">Play</button> <label>Place <input type="range" min="0" '
        f'max="{most - 1}" value="{start}"></label> <output aria-live="off"></output></p>'
    )


def _fit(frames: Any, space: Space) -> dict[str, Any]:
    """What is in the middle of the drawing, and the pixels of a unit there, so that a track has room."""
    every = frames.reshape(-1, 3)
    low, high = every.min(axis=0), every.max(axis=0)
    middle = 0 * low if space is Space.SPHERICAL else (low + high) // 2
    if space is Space.PLANAR:
        room = np.array([_WIDTH, _HEIGHT]) - 2 * _MARGIN
        scale = float((room / np.maximum((high - low)[:2], 1)).min())
    else:
        # a place may come near the reader, where all is larger
        farthest = _UNITS if space is Space.SPHERICAL else np.linalg.norm(every - middle, axis=1).max()
        scale = _SPHERE / max(float(farthest), 1.0)
    return {"middle": middle.tolist(), "scale": round(scale, 4)}


class _Places:
    """Places by number, each as a point in every scene; those that are together in all scenes are one."""

    def __init__(self, scenes: Sequence[Scene]) -> None:
        self._scenes = scenes
        self._found: dict[bytes, int] = {}
        self._rows: list[Floats] = []
        self._small = 1e-5 * scenes[0].size

    def __call__(self, where: _Where) -> int:
        """The number of a place."""
        row = np.zeros((len(self._scenes), 3))
        for k, scene in enumerate(self._scenes):
            place = where(scene)
            row[k, : len(place)] = place
        key = (np.round(row / self._small) + 0.0).tobytes()
        if key not in self._found:
            self._found[key] = len(self._rows)
            self._rows.append(row)
        return self._found[key]

    def frames(self) -> Any:
        """All places in whole numbers, (scenes, places, 3)."""
        places = np.array(self._rows).transpose(1, 0, 2)
        if self._scenes[0].space is Space.SPHERICAL:
            return np.round(_UNITS * places).astype(int)
        every = places.reshape(-1, 3)
        middle = (every.min(axis=0) + every.max(axis=0)) / 2
        radius = float(np.linalg.norm(every - middle, axis=1).max()) or 1.0
        return np.round((places - middle) * _UNITS / radius).astype(int)


# -- shapes --------------------------------------------------------------------------------------------


def _shape(kind: str, style: str, at: Sequence[int], rank: int = 0, **more: Any) -> dict[str, Any]:
    """An SVG element and the places, by number, that it follows; rank: above others of the same place."""
    return {"kind": kind, "style": style, "at": list(at), "rank": rank, **more}


def _shapes(scene: Scene, places: _Places) -> Iterator[dict[str, Any]]:
    """Everything that is drawn, from the back to the front as in a plane."""
    spherical = scene.space is Space.SPHERICAL
    for body, k in sorted(((b, k) for k, b in enumerate(scene.bodies)), key=lambda pair: not pair[0].ground):
        yield from _body(body, k, places, scene.space)
    for k, mark in enumerate(scene.marks):
        yield from _joint(mark, k, places, scene.space, scene.size)
    for k in range(len(scene.outputs)):
        yield _shape("path", "diamond", [places(_output(k))], 9, text=_DIAMOND)
    if spherical:
        named = [(m.joint.name, _end(k, 1.1)) for k, m in enumerate(scene.marks) if m.axes]
    else:
        named = [(name, _named(name)) for name in scene.names]
    for name, where in named:
        yield _shape("text", "name", [places(where)], 10, text=name.partition(".")[2] or name, front=1)


def _body(body: Body, k: int, places: _Places, space: Space) -> Iterator[dict[str, Any]]:
    """A link: a plate, a bar, or arcs of a sphere; the ground of the plane is seen by its feet."""
    if body.ground and space is Space.PLANAR:
        return
    style = "ground" if body.ground else "platform" if body.output else "link"
    if space is Space.SPHERICAL:
        ends = [places(_point(k, name)) for name in body.points]
        for pair in pairwise(ends):
            yield from _bar(style, pair, round=_UNITS)
    elif body.is_plate:
        names = [next(n for n, p in body.points.items() if np.array_equal(p, q)) for q in body.outline]
        yield _shape("polygon", style, [places(_point(k, n)) for n in names])
    elif len(body.places) > 1:
        middle = body.places - body.places.mean(axis=0)
        along = middle @ np.linalg.svd(middle)[2][0]
        ends = [places(_corner(k, int(i))) for i in (along.argmin(), along.argmax())]
        yield from _bar(style, ends)


def _bar(style: str, ends: Sequence[int], **more: Any) -> Iterator[dict[str, Any]]:
    if style == "ground":
        yield _shape("polyline", style, ends, **more)
        return
    for rank, part in enumerate(("gap", "edge", "bar")):
        yield _shape("polyline", f"{style} {part}", ends, rank, **more)


def _joint(mark: Mark, k: int, places: _Places, space: Space, size: float) -> Iterator[dict[str, Any]]:
    role = "input" if mark.active else "output" if mark.output else "passive"
    place = places(_end(k, 1.0) if space is Space.SPHERICAL else lambda s: s.marks[k].place)
    if space is Space.SPHERICAL:
        yield _shape("polyline", f"axis {role}", [places(lambda s: np.zeros(3)), places(_end(k, 1.12))], 3)
    elif mark.joint.kind is JointKind.P:
        yield from _slide(mark, k, role, places, size)
        return
    else:
        if space is not Space.PLANAR and np.abs(mark.place - mark.base).max() > 1e-6:
            yield _shape("polyline", "rod", [places(lambda s: s.marks[k].base), place])
        for i in range(len(mark.axes)):
            long = [places(_beside(k, i, side * 1.5 * _AXIS * size)) for side in (-1, 1)]
            short = [places(_beside(k, i, side * _AXIS * size / 2)) for side in (-1, 1)]
            yield _shape("polyline", f"axis {role}", long, 3)
            yield _shape("polyline", "case", short, 5)
            yield _shape("polyline", f"inner {role}", short, 6)
    if space is Space.PLANAR and mark.grounded:
        yield _shape("path", "foot", [places(lambda s: s.marks[k].base)], 6, text=_FOOT)
    yield _shape("circle", f"pin {role}", [place], 7, radius=5 if mark.axes else 7)


def _slide(mark: Mark, k: int, role: str, places: _Places, size: float) -> Iterator[dict[str, Any]]:
    """A rod from point to point in a case over half of it; a short case alone where they stay together."""
    if np.abs(mark.place - mark.base).max() > 1e-6:
        ends = [places(lambda s: s.marks[k].base), places(lambda s: s.marks[k].place)]
        case = [ends[0], places(lambda s: (s.marks[k].base + s.marks[k].place) / 2)]
        yield _shape("polyline", "rod", ends)
    else:
        case = [places(_beside(k, 0, side * _AXIS * size)) for side in (-1, 1)]
    yield _shape("polyline", "case", case, 5)
    yield _shape("polyline", f"inner {role}", case, 6)


def _output(k: int) -> _Where:
    return lambda scene: scene.outputs[k]


def _named(name: str) -> _Where:
    return lambda scene: scene.names[name]


def _point(k: int, name: str) -> _Where:
    """A point of a link."""
    return lambda scene: scene.bodies[k].points[name]


def _corner(k: int, i: int) -> _Where:
    """A corner of a link."""
    return lambda scene: scene.bodies[k].places[i]


def _beside(k: int, i: int, length: float) -> _Where:
    """A place on an axis of a joint, so far from the joint."""

    def where(scene: Scene) -> Floats:
        mark = scene.marks[k]
        return mark.place + length * mark.axes[i] if i < len(mark.axes) else mark.place

    return where


def _end(k: int, radius: float) -> _Where:
    """Where a joint's axis through the middle of a sphere is, so far from it."""
    return lambda scene: radius * scene.marks[k].axes[0]
