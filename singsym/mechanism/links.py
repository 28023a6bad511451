"""Links of a mechanism file: named points and axes, or a length, three sides, an arc.

Source: singsym's own format; law of cosines for triangles.
"""

from __future__ import annotations

import re
from numbers import Rational
from typing import Any

import sympy

from singsym.mechanism.model import Link, Space, Vector
from singsym.mechanism.reader import Reader, kind_of

_KEYS = ("points", "axes", "length", "sides", "mirror", "arc")
_PARTS = re.compile(r"[A-Z][0-9]*")


def read_links(value: Any, reader: Reader) -> tuple[Link, ...]:
    """The table `links`; a number or an expression alone is the length of a link between two points."""
    links = []
    for name, entry in reader.table(value, "links").items():
        place = f"links.{name}"
        reader.name(name, place)
        short = "arc" if reader.space is Space.SPHERICAL else "length"
        if isinstance(entry, (str, Rational, float, sympy.Expr)):
            entry = {short: entry}
        expected = f"a table such as {{ points = {{ ... }} }}, or the {short}"
        table = reader.table(entry, place, _KEYS, expected)
        links.append(_read_link(name, table, place, reader) if table or entry == {} else Link(name, {}, {}))
    return tuple(links)


def _read_link(name: str, entry: dict[str, Any], place: str, reader: Reader) -> Link:
    points: dict[str, Vector] = {}
    axes: dict[str, Vector] = {}
    shapes = [key for key in ("length", "sides", "arc") if key in entry]
    if len(shapes) > 1:
        reader.report(place, " and ".join(shapes), "only one of length, sides and arc")
    if "length" in entry:
        points = _binary(name, entry, place, reader)
    elif "sides" in entry:
        points = _triangle(entry, place, reader)
    elif "arc" in entry:
        axes = _arc(name, entry, place, reader)
    elif "points" in entry:
        points = reader.vectors(entry["points"], f"{place}.points")
    if "axes" in entry and "arc" not in entry:
        axes = reader.vectors(entry["axes"], f"{place}.axes")
    if reader.space is Space.SPHERICAL and not points:
        points = {"O": (sympy.Integer(0),) * 3}
    if "mirror" in entry and ("sides" not in entry or not isinstance(entry["mirror"], bool)):
        reader.report(f"{place}.mirror", kind_of(entry["mirror"]), "mirror = true beside sides")
    if "sides" in entry:
        reader.unused(entry, ("points",), place, "sides")
    if not points and not axes and not {"length", "sides", "arc"} & entry.keys():
        reader.report(place, "no points", "points, a length or sides", "write points = { A = [0, 0] }")
    return Link(name, points, axes)


def _ends(name: str, given: Any, place: str, reader: Reader) -> tuple[str, str]:
    """The two points or axes that a link joins: listed, or read off its name (AB, A0A)."""
    parts = reader.names(given, place) if given is not None else _PARTS.findall(name)
    if len(parts) == 2 and (given is not None or "".join(parts) == name):
        return parts[0], parts[1]
    listed = "points" if reader.space is not Space.SPHERICAL else "axes"
    advice = f'write {listed} = ["A", "B"], or name the link by them, as AB'
    reader.report(place, f"the link {name!r}" if given is None else str(parts), f"two {listed}", advice)
    return "A", "B"


def _binary(name: str, entry: dict[str, Any], place: str, reader: Reader) -> dict[str, Vector]:
    length = reader.length(entry["length"], f"{place}.length")
    first, second = _ends(name, entry.get("points"), f"{place}.points", reader)
    zero = sympy.Integer(0)
    return {first: (zero,) * reader.size, second: (length,) + (zero,) * (reader.size - 1)}


def _triangle(entry: dict[str, Any], place: str, reader: Reader) -> dict[str, Vector]:
    """Points from three sides: the first side on the x axis, the third point above it, below if mirrored."""
    place = f"{place}.sides"
    table = reader.table(entry["sides"], place)
    sides = {}
    order: list[str] = []
    for key, value in table.items():
        ends = _PARTS.findall(key)
        if len(ends) != 2 or "".join(ends) != key:
            reader.report(place, repr(key), "sides named by their two points, as AB")
            return {}
        before = len(reader.problems)
        length = reader.length(value, f"{place}.{key}")
        if len(reader.problems) > before:
            return {}
        sides[frozenset(ends)] = length
        order += [end for end in ends if end not in order]
    if len(table) != 3 or len(sides) != 3 or len(order) != 3:
        reader.report(place, ", ".join(table), "the three sides of a triangle, as { AB = 3, BC = 4, CA = 5 }")
        return {}
    a, b, c = order
    base, left, right = sides[frozenset((a, b))], sides[frozenset((a, c))], sides[frozenset((b, c))]
    x = (base**2 + left**2 - right**2) / (2 * base)
    squared = left**2 - x**2
    if squared.is_number and squared.is_negative:
        found = f"sides {base}, {right}, {left}"
        reader.report(place, found, "sides each no longer than the other two together")
        return {}
    height = sympy.sqrt(squared)
    zero = sympy.Integer(0)
    depth = (zero,) * (reader.size - 2)
    top = -height if entry.get("mirror") is True else height
    return {a: (zero, zero, *depth), b: (base, zero, *depth), c: (x, top, *depth)}


def _arc(name: str, entry: dict[str, Any], place: str, reader: Reader) -> dict[str, Vector]:
    angle = reader.angle(entry["arc"], f"{place}.arc")
    first, second = _ends(name, entry.get("axes"), f"{place}.axes", reader)
    zero, one = sympy.Integer(0), sympy.Integer(1)
    return {first: (zero, zero, one), second: (sympy.sin(angle), zero, sympy.cos(angle))}
