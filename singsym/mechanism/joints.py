"""Joints and inputs of a mechanism file.

Source: singsym's own format; k links on one pin are k-1 joints (Zlatanov, Fenton, Benhabib 1998).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy

from singsym.mechanism.model import Joint, JointKind, Link, Space
from singsym.mechanism.reader import Reader, kind_of

_KEYS = ("type", "links", "at", "axis", "pitch", "reference")
_USERS = {"pitch": (JointKind.H,), "reference": (JointKind.R, JointKind.H, JointKind.C)}


def read_joints(value: Any, links: Sequence[Link], reader: Reader) -> tuple[Joint, ...]:
    """The table `joints`, by name; text alone is the type.

    links: by default all that have a point (spherical: an axis) of the joint's name, in file order.
    at, axis: by default the joint's name.
    """
    joints: list[Joint] = []
    for name, entry in reader.table(value, "joints").items():
        place = f"joints.{name}"
        reader.name(name, place)
        if isinstance(entry, str):
            entry = {"type": entry}
        table = reader.table(entry, place, _KEYS, 'a table, or the type as text, as "R"')
        if table or entry == {}:
            joints += _read_joint(name, table, links, place, reader)
    return tuple(joints)


def _read_joint(
    name: str, entry: dict[str, Any], links: Sequence[Link], place: str, reader: Reader
) -> list[Joint]:
    kind = _kind(entry.get("type", "R"), f"{place}.type", reader)
    spherical = reader.space is Space.SPHERICAL
    at = entry.get("at", "O" if spherical else name)
    axis = _axis_default(name, entry, kind, reader)
    useless = [key for key, users in _USERS.items() if kind not in users]
    if axis is None:
        useless.append("axis")
    reader.unused(entry, useless, place, f"a {reader.space} joint {kind}")
    if "links" in entry:
        chain = reader.names(entry["links"], f"{place}.links")
    elif spherical:
        chain = [k.name for k in links if isinstance(axis, str) and axis in k.axes]
    else:
        chain = [k.name for k in links if isinstance(at, str) and at in k.points]
    if len(chain) < 2:
        what = "axis" if spherical else "point"
        found = "links " + ", ".join(chain) if chain else "no links"
        advice = f'name the {what} in each link, or write links = ["one", "other"]'
        # links that could not be read have no points, and were reported as such
        if "links" in entry or not any(p.place.startswith("links.") for p in reader.problems):
            reader.report(place, found, f"two or more links that have the {what} {name}", advice)
        return []
    points = _each(at, len(chain), f"{place}.at", reader)
    axes = None if axis is None else _each(axis, len(chain), f"{place}.axis", reader)
    reference = entry.get("reference")
    zero = None if reference is None else _each(reference, len(chain), f"{place}.reference", reader)
    pitch = reader.expression(entry["pitch"], f"{place}.pitch") if "pitch" in entry else None
    if kind is JointKind.H and pitch is None:
        reader.report(place, "no pitch", "pitch = length per radian")
        pitch = sympy.Integer(1)
    split = len(chain) > 2
    return [
        Joint(
            f"{name}{i + 1}" if split else name,
            kind,
            chain[i],
            chain[i + 1],
            (points[i], points[i + 1]),
            None if axes is None else (axes[i], axes[i + 1]),
            pitch if kind is JointKind.H else None,
            None if zero is None else (zero[i], zero[i + 1]),
        )
        for i in range(len(chain) - 1)
    ]


def _kind(value: Any, place: str, reader: Reader) -> JointKind:
    text = reader.text(value, place)
    if text in JointKind.__members__:
        return JointKind(text)
    if isinstance(value, str):
        reader.report(place, repr(text), f"one of {' '.join(JointKind)}")
    return JointKind.R


def _axis_default(name: str, entry: dict[str, Any], kind: JointKind, reader: Reader) -> Any:
    """The axis as given, or the joint's name where the joint needs one."""
    if kind is JointKind.S or (reader.space is Space.PLANAR and kind is not JointKind.P):
        return None
    if "axis" in entry:
        return entry["axis"]
    if kind is JointKind.U:
        advice = 'write axis = ["u", "v"], u in the first link, v in the second'
        reader.report(f"joints.{name}", "no axis", "a pair of axes at right angles", advice)
    return name


def _each(value: Any, count: int, place: str, reader: Reader) -> list[str]:
    """One name for every link, or one name for all."""
    if isinstance(value, str):
        return [reader.name(value, place)] * count
    if not isinstance(value, (list, tuple)) or len(value) != count:
        found = kind_of(value)
        reader.report(place, found, f"one name for all links, or a list of {count}, one for each link")
        return [""] * count
    return reader.names(value, place)


def read_inputs(value: Any, joints: Sequence[Joint], reader: Reader) -> tuple[str, ...]:
    """The list `inputs` of freedoms: a joint's name stands for all its freedoms."""
    columns = {joint.name: joint.columns for joint in joints}
    labels = reader.texts(value, "inputs")
    return tuple(column for label in labels for column in columns.get(label, (label,)))
