"""A mechanism that a slider moves along its singularity curves: frames as SVG points, a few lines of script.

Source: singsym's own; the frames lie on the tracked curves of varieties/real/curve.py.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from singsym.mechanism.model import JointKind, Space
from singsym.output.figures.curves import Coordinate, Trace
from singsym.output.figures.scene import Scene, Stage
from singsym.output.figures.style import Floats
from singsym.output.figures.view import viewpoint

FRAMES = 72
"""Configurations along each arc."""

_WIDTH, _HEIGHT, _MARGIN = 640, 480, 45
_FOOT = "M0 0l-13 22h26zM-20 22h40M-14 22l-7 8M-3 22l-7 8M8 22l-7 8M19 22l-7 8"
_DIAMOND = "M0 -9l9 9l-9 9l-9 -9z"


@dataclass(frozen=True)
class _Shape:
    """An SVG element and the places, by index, that it follows; `text`: a label, or the outline of a path."""

    kind: str
    style: str
    places: tuple[int, ...]
    text: str = ""


def motion(stage: Stage, traces: Sequence[Trace]) -> str:
    """The slider with its drawing as HTML; "" where there is no curve."""
    arcs = [
        (f"{trace.label}, part {k} of {len(trace.components)}", arc)
        for trace in traces
        for k, component in enumerate(trace.components, 1)
        for arc in component
        if len(arc) > 1
    ]
    if not arcs:
        return ""
    sampled = [(label, _resampled(arc)) for label, arc in arcs]
    first_scene = stage.scene(sampled[0][1][0])
    view = np.eye(2) if first_scene.space is Space.PLANAR else viewpoint(first_scene)[:2]
    shapes = _shapes(first_scene)
    projected = [np.array([_places(stage.scene(p)) @ view.T for p in points]) for _, points in sampled]
    curves = []
    inputs = [
        Coordinate(label, stage.equation)
        for label in stage.mechanism.inputs
        if label in stage.equation.values
    ]
    for (label, points), places in zip(sampled, projected, strict=True):
        pixels = _fitted(places)
        values = [c.at(points) * (180 / np.pi if c.is_angle else 1) for c in inputs]
        notes = [
            ", ".join(
                f"{c.label} = {v[i]:.1f}{'°' if c.is_angle else ''}"
                for c, v in zip(inputs, values, strict=True)
            )
            for i in range(len(points))
        ]
        frames = pixels.reshape(len(points), -1).round().astype(int).tolist()
        curves.append({"label": label, "frames": frames, "notes": notes})
    drawing = "".join(_element(s, curves[0]["frames"][0]) for s in shapes)
    options = "".join(f'<option value="{i}">{escape(str(c["label"]))}</option>' for i, c in enumerate(curves))
    data = json.dumps(curves, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")
    return (
        '<div class="motion">'
        f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" '
        f'aria-label="The mechanism on a singularity curve">{drawing}</svg>'
        f'<p><label>Curve <select class="curve">{options}</select></label></p>'
        '<p><label>Place on it <input class="place" type="range" min="0" '
        f'max="{FRAMES - 1}" value="0"></label> '
        f'<output aria-live="polite">{escape(str(curves[0]["notes"][0]))}</output></p>'
        f'<script type="application/json">{data}</script></div>'
    )


SCRIPT = """
for (const box of document.querySelectorAll('.motion')) {
  const curves = JSON.parse(box.querySelector('script').textContent);
  const curve = box.querySelector('.curve'), place = box.querySelector('.place');
  const draw = () => {
    const c = curves[curve.value], f = c.frames[place.value], names = [];
    for (const e of box.querySelectorAll('[data-at]')) {
      const at = e.dataset.at.split(' ').map(i => [f[2 * i], f[2 * i + 1]]);
      const set = (x, y) => { e.setAttribute(x, at[0][0]); e.setAttribute(y, at[0][1]); };
      if (e.tagName === 'circle') set('cx', 'cy');
      else if (e.tagName === 'text') {
        // names of one place stand side by side
        const here = names.filter(([x, y]) => Math.hypot(x - at[0][0], y - at[0][1]) < 14);
        names.push([...at[0], e.textContent.length]);
        set('x', 'y');
        e.setAttribute('dx', here.reduce((all, [, , length]) => all + 12 * length + 8, 12));
      }
      else if (e.tagName === 'path') e.setAttribute('transform', `translate(${at[0]})`);
      else e.setAttribute('points', at.map(p => p.join()).join(' '));
    }
    box.querySelector('output').textContent = c.notes[place.value];
  };
  curve.addEventListener('change', draw);
  place.addEventListener('input', draw);
  draw();
}
"""


def _resampled(line: Floats) -> Floats:
    """So many vertices of a polyline at even distances."""
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = np.linspace(0, along[-1], FRAMES)
    return np.array([np.interp(wanted, along, column) for column in line.T]).T


def _places(scene: Scene) -> Floats:
    """All places that shapes follow: corners of links, joints, ends of slides and axes, outputs, names."""
    places = [p for body in scene.bodies for p in body.points.values()]
    places += [m.place for m in scene.marks]
    half = 0.06 * scene.size
    for mark in scene.marks:
        shift = half * mark.direction if mark.direction is not None else 0 * mark.place
        places += [mark.place - shift, mark.place + shift]
    return np.array([*places, *scene.outputs, *scene.names.values()])


def _shapes(scene: Scene) -> list[_Shape]:
    """What is drawn, in the order of `_places`."""
    shapes: list[_Shape] = []
    index = 0
    for body in scene.bodies:
        corners = tuple(range(index, index + len(body.points)))
        index += len(corners)
        if body.ground and scene.space is Space.PLANAR:
            continue
        style = "ground" if body.ground else "platform" if body.output else "link"
        if len(corners) > 2:
            shapes.append(_Shape("polygon", style, corners))
        elif len(corners) == 2:
            shapes += [
                _Shape("polyline", f"{style} edge", corners),
                _Shape("polyline", f"{style} bar", corners),
            ]
    marks = index
    ends = marks + len(scene.marks)
    for k, mark in enumerate(scene.marks):
        role = "input" if mark.active else "output" if mark.output else "passive"
        if mark.direction is not None:
            kind = "slider" if mark.joint.kind is JointKind.P else "axis"
            shapes.append(_Shape("polyline", f"{kind} {role}", (ends + 2 * k, ends + 2 * k + 1)))
        fixed = " fixed" if mark.grounded else ""
        if fixed and scene.space is Space.PLANAR and mark.joint.kind is not JointKind.P:
            shapes.append(_Shape("path", "foot", (marks + k,), _FOOT))
        shapes.append(_Shape("circle", f"pin {role}{fixed}", (marks + k,)))
    outputs = ends + 2 * len(scene.marks)
    for k in range(len(scene.outputs)):
        shapes.append(_Shape("path", "diamond", (outputs + k,), _DIAMOND))
    names = outputs + len(scene.outputs)
    for k, name in enumerate(scene.names):
        shapes.append(_Shape("text", "name", (names + k,), name.partition(".")[2] or name))
    return shapes


def _fitted(places: Floats) -> Floats:
    """Places of all frames of an arc in pixels, the mechanism in the middle."""
    flat = places.reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    room = np.array([_WIDTH, _HEIGHT]) - 2 * _MARGIN
    scale = float((room / np.maximum(high - low, 1e-9)).min())
    found: Floats = np.array([_WIDTH, _HEIGHT]) / 2 + (places - (low + high) / 2) * (scale, -scale)
    return found


def _element(shape: _Shape, frame: Sequence[int]) -> str:
    at = [(frame[2 * i], frame[2 * i + 1]) for i in shape.places]
    data = " ".join(map(str, shape.places))
    start = f'<{shape.kind} class="{shape.style}" data-at="{data}"'
    if shape.kind == "circle":
        return f'{start} cx="{at[0][0]}" cy="{at[0][1]}" r="7"/>'
    if shape.kind == "path":
        return f'{start} d="{shape.text}" transform="translate({at[0][0]},{at[0][1]})"/>'
    if shape.kind == "text":
        return f'{start} x="{at[0][0]}" y="{at[0][1]}" dx="12" dy="-10">{escape(shape.text)}</text>'
    return f'{start} points="{" ".join(f"{x},{y}" for x, y in at)}"/>'
