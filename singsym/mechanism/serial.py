"""Serial arms from Denavit-Hartenberg rows: links, joints, points and axes of every frame.

Source: Denavit, Hartenberg (1955), the standard convention T = Rz(theta) Tz(d) Tx(a) Rx(alpha);
Craig, Introduction to Robotics, the modified one T = Rx(alpha) Tx(a) Rz(theta) Tz(d).
"""

from __future__ import annotations

from typing import Any

import sympy

from singsym.mechanism.model import Joint, JointKind, Link, Vector
from singsym.mechanism.reader import Reader, kind_of

_ROW = ("joint", "name", "a", "alpha", "d", "theta")


def read_dh(value: Any, reader: Reader) -> tuple[tuple[Link, ...], tuple[Joint, ...]]:
    """The table `dh`: convention, rows, tool (a point in the last frame, named `tool`).

    Links are ground, link1, link2, ...; joints J1, J2, ...; point Oi is the origin of frame i, axis zi its
    z axis.  The angle of an R joint is zero where x(i-1) and x(i) are parallel after the offset `theta`.
    The link moved by a P joint has its frame parallel to the link before, else a link has its DH frame.
    """
    table = reader.table(value, "dh", ("convention", "rows", "tool"))
    convention = table.get("convention", "standard")
    if convention not in ("standard", "modified"):
        reader.report("dh.convention", kind_of(convention), '"standard" or "modified"')
    rows = reader.items(table.get("rows"), "dh.rows")
    if not rows:
        reader.report("dh.rows", "no rows", '{ joint = "R", a = 0, alpha = 90, d = 0 } for every joint')
    points: list[dict[str, Vector]] = [{}]
    axes: list[dict[str, Vector]] = [{}]
    joints = []
    frame = sympy.eye(3)
    for index, given in enumerate(rows, 1):
        place = f"dh.rows[{index - 1}]"
        row = reader.table(given, place, _ROW)
        kind = row.get("joint", "R")
        if kind not in ("R", "P"):
            reader.report(f"{place}.joint", kind_of(kind), '"R" or "P"')
            kind = "R"
        name = reader.name(row.get("name", f"J{index}"), f"{place}.name")
        a, d = (reader.expression(row.get(key, 0), f"{place}.{key}") for key in ("a", "d"))
        alpha, theta = (reader.angle(row.get(key, 0), f"{place}.{key}") for key in ("alpha", "theta"))
        if convention == "modified":
            step = _modified(frame, kind, a, alpha, d, theta)
        else:
            step = _standard(frame, kind, a, alpha, d, theta)
        z, x = (index, index) if convention == "modified" else (index - 1, index)
        for side, link in ((0, index - 1), (1, index)):
            while len(points) <= link:
                points.append({})
                axes.append({})
            # A slide's point differs in its two links: the moving one is the frame that slides.
            label = f"O{z}" if kind == "R" or side == 0 else f"O{z}s"
            points[link][label] = step.points[side]
            axes[link][f"z{z}"] = step.axes[side]
            if kind == "R":
                axes[link][f"x{x}" if side else f"r{x}"] = step.references[side]
        at = (f"O{z}", f"O{z}" if kind == "R" else f"O{z}s")
        reference = (f"r{x}", f"x{x}") if kind == "R" else None
        names = ("ground" if index == 1 else f"link{index - 1}", f"link{index}")
        joints.append(Joint(name, JointKind(kind), *names, at, (f"z{z}", f"z{z}"), reference=reference))
        frame = step.frame
    tool = table.get("tool")
    origin = (sympy.Integer(0),) * 3 if tool is None else reader.vector(tool, "dh.tool")
    if rows:
        points[-1]["tool"] = _tuple(frame * sympy.Matrix(origin))
    links = tuple(
        Link("ground" if i == 0 else f"link{i}", p, u)
        for i, (p, u) in enumerate(zip(points, axes, strict=True))
    )
    return links, tuple(joints)


class _Step:
    """One joint as both its links see it; `frame` turns the new DH frame into the new link's frame."""

    def __init__(self, points: Any, axes: Any, references: Any, frame: sympy.Matrix) -> None:
        self.points = tuple(_tuple(v) for v in points)
        self.axes = tuple(_tuple(v) for v in axes)
        self.references = tuple(_tuple(v) for v in references)
        self.frame = frame


def _standard(
    frame: sympy.Matrix, kind: str, a: sympy.Expr, alpha: sympy.Expr, d: sympy.Expr, theta: sympy.Expr
) -> _Step:
    """The joint turns or slides along z of the frame before; `frame`: that DH frame in its link's."""
    x, z, zero = sympy.Matrix([1, 0, 0]), sympy.Matrix([0, 0, 1]), sympy.zeros(3, 1)
    start = rotation("z", theta) * x
    new = sympy.eye(3) if kind == "R" else frame * rotation("z", theta) * rotation("x", alpha)
    back = new * rotation("x", -alpha)
    here = back * -(a * x + (d * z if kind == "R" else zero))
    before = zero if kind == "R" else frame * d * z
    return _Step((before, here), (frame * z, back * z), (frame * start, new * x), new)


def _modified(
    frame: sympy.Matrix, kind: str, a: sympy.Expr, alpha: sympy.Expr, d: sympy.Expr, theta: sympy.Expr
) -> _Step:
    """The joint turns or slides along z of its own frame; `frame`: the DH frame before in its link's."""
    x, z, zero = sympy.Matrix([1, 0, 0]), sympy.Matrix([0, 0, 1]), sympy.zeros(3, 1)
    tilt = rotation("x", alpha)
    turned = frame * tilt
    new = sympy.eye(3) if kind == "R" else turned * rotation("z", theta)
    before = frame * a * x + turned * d * z
    axes = (turned * z, new * z)
    return _Step((before, zero), axes, (turned * rotation("z", theta) * x, new * x), new)


def rotation(axis: str, angle: sympy.Expr) -> sympy.Matrix:
    """The rotation matrix about x, y or z.

    >>> rotation("z", sympy.pi / 2)
    Matrix([
    [0, -1, 0],
    [1,  0, 0],
    [0,  0, 1]])
    """
    c, s = sympy.cos(angle), sympy.sin(angle)
    if axis == "x":
        return sympy.Matrix([[1, 0, 0], [0, c, -s], [0, s, c]])
    if axis == "y":
        return sympy.Matrix([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def _tuple(vector: Any) -> Vector:
    """A column as a tuple, expanded so that equal coordinates look equal."""
    return tuple(sympy.expand(v) for v in vector)
