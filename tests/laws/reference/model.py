"""A mechanism's data as floats: bodies, joints, inputs and outputs, in units of its own size.

Source: the conventions of `singsym.mechanism.model`, whose objects are read and nothing else of singsym.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from tests.laws.reference.bodies import Array, Model, Output, Pair, rotation

_TWIST = ("wx", "wy", "wz", "vx", "vy", "vz")
_PLANAR = {"w": "wz"}


def _vector(values: Iterable[Any]) -> Array:
    found = [float(x) for x in values]
    return np.array(found + [0.0] * (3 - len(found)))


def model(mechanism: Any) -> Model:
    """The reference's model; raises `NotImplementedError` for joints H and E, limits, and modes.

    mechanism: a `singsym.Mechanism` whose parameters all have values.
    """
    m = mechanism.resolved
    if m.limits or m.translating or m.parameters:
        raise NotImplementedError("limits, modes or symbolic dimensions")
    links = sorted(m.links, key=lambda link: link.name != m.ground)
    number = {link.name: i for i, link in enumerate(links)}
    raw = [{name: _vector(x) for name, x in link.points.items()} for link in links]
    sizes = [np.linalg.norm(x - y) for named in raw for x in named.values() for y in named.values()]
    unit = float(np.mean([s for s in sizes if s > 0] or [1.0]))
    points = tuple({name: x / unit for name, x in named.items()} for named in raw)
    axes = tuple(
        {name: x / np.linalg.norm(x) for name, x in ((n, _vector(v)) for n, v in link.axes.items())}
        for link in links
    )
    pairs = tuple(_pair(joint, number, points, axes) for joint in m.joints)
    excluded = tuple(e.points for e in m.exclusions if e.points)
    if len(excluded) < len(m.exclusions):
        raise NotImplementedError("exclusions by expressions")
    return Model(
        str(m.space),
        tuple(link.name for link in links),
        points,
        axes,
        pairs,
        m.inputs,
        tuple(_output(output, number, points) for output in m.outputs),
        tuple(_idle(pairs)),
        excluded,
        unit,
        m.columns,
        m.n,
    )


def _pair(joint: Any, number: dict[str, int], points: Any, axes: Any) -> Pair:
    i, j = number[joint.first], number[joint.second]
    u = v = np.array([0.0, 0.0, 1.0])
    if joint.axes is not None:
        u, v = axes[i][joint.axes[0]], axes[j][joint.axes[1]]
    turn = np.cross(v, u)
    if u @ v < -1 + 1e-12:
        raise NotImplementedError("a slide along opposite directions of two frames")
    sine = np.linalg.norm(turn)
    angle = float(np.arctan2(sine, u @ v))
    turned = rotation(turn / sine * angle if sine > 0 else turn)
    at = [points[k].get(name, np.zeros(3)) for k, name in zip((i, j), joint.at, strict=True)]
    return Pair(joint.name, str(joint.kind), i, j, *at, u, v, turned)


def _output(output: Any, number: dict[str, int], points: Any) -> Output:
    if hasattr(output, "column"):
        return Output(0, np.zeros(3), (), (output.column,))
    body = number[output.link]
    pointwise = all(c in "xyz" for c in output.components)
    names = [f"v{c}" if pointwise else _PLANAR.get(c, c) for c in output.components]
    point = points[body].get(output.point, np.zeros(3))
    return Output(body, point, tuple(_TWIST.index(name) for name in names))


def _idle(pairs: tuple[Pair, ...]) -> Iterable[tuple[int, Array]]:
    """Rods between two spherical joints, and struts whose two parts slide along the line between theirs."""

    def of(body: int) -> list[Pair]:
        return [pair for pair in pairs if body in (pair.i, pair.j)]

    def end(pair: Pair, body: int) -> Array:
        return pair.p if pair.i == body else pair.q

    bodies = {b for pair in pairs for b in (pair.i, pair.j)} - {0}
    for body in sorted(bodies):
        own = of(body)
        if len(own) == 2 and {pair.kind for pair in own} == {"S"}:
            gap = end(own[0], body) - end(own[1], body)
            if np.linalg.norm(gap) > 0:
                yield body, gap / np.linalg.norm(gap)
    for slide in pairs:
        if slide.kind != "P" or 0 in (slide.i, slide.j):
            continue
        rest = [[pair for pair in of(body) if pair is not slide] for body in (slide.i, slide.j)]
        if all(len(r) == 1 and r[0].kind == "S" for r in rest):
            offsets = [
                np.cross(end(r[0], body) - at, u)
                for r, body, at, u in zip(
                    rest, (slide.i, slide.j), (slide.p, slide.q), (slide.u, slide.v), strict=True
                )
            ]
            if max(np.abs(x).max() for x in offsets) < 1e-9:
                yield slide.i, slide.u
