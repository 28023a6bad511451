"""Outputs, limits and exclusions of a mechanism file.

Source: singsym's own format; the feasible set Omega is section 2.4 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy

from singsym.mechanism.arcs import exact_arc
from singsym.mechanism.expressions import Quantities, parse
from singsym.mechanism.model import (
    Exclusion,
    Joint,
    JointRate,
    Limit,
    Link,
    Output,
    PointVelocity,
    Space,
    Twist,
)
from singsym.mechanism.problems import MechanismError
from singsym.mechanism.reader import Reader, kind_of

TWISTS = {
    Space.PLANAR: ("w", "vx", "vy"),
    Space.SPHERICAL: ("wx", "wy", "wz"),
    Space.SPATIAL: ("wx", "wy", "wz", "vx", "vy", "vz"),
}
ANGULAR = {"R": ("",), "H": ("",), "C": ("angle",), "U": ("angle1", "angle2"), "E": ("angle",)}
SLIDING = {"P": ("",), "C": ("slide",), "E": ("x", "y")}


def coordinates(space: Space) -> tuple[str, ...]:
    """Names of a point's coordinates."""
    return ("x", "y") if space is Space.PLANAR else ("x", "y", "z")


def quantities(space: Space, links: Sequence[Link], joints: Sequence[Joint]) -> Quantities:
    """What limits and exclusions may speak of."""

    def columns(freedoms: Mapping[str, tuple[str, ...]]) -> frozenset[str]:
        named = [(j.name, f) for j in joints for f in freedoms.get(j.kind.value, ())]
        return frozenset(f"{name}.{f}" if f else name for name, f in named)

    points = frozenset(p for link in links for p in link.points)
    return Quantities(columns(ANGULAR), columns(SLIDING), points, coordinates(space))


def read_outputs(value: Any, links: Sequence[Link], reader: Reader) -> tuple[Output, ...]:
    """The key `output`: a table, or a list of tables."""
    if isinstance(value, (list, tuple)):
        return tuple(_read_output(v, f"output[{i}]", links, reader) for i, v in enumerate(value))
    return (_read_output(value, "output", links, reader),)


def _read_output(value: Any, place: str, links: Sequence[Link], reader: Reader) -> Output:
    entry = reader.table(value, place, ("twist", "velocity", "rate", "link", "at", "components"))
    kinds = [key for key in ("twist", "velocity", "rate") if key in entry]
    if len(kinds) != 1:
        expected = 'one of { twist = "LINK" }, { velocity = "POINT" }, { rate = "JOINT" }'
        reader.report(place, kind_of(value) if not kinds else " and ".join(kinds), expected)
        return JointRate("")
    what = reader.text(entry[kinds[0]], f"{place}.{kinds[0]}")
    idle = {"twist": ("link",), "velocity": ("at",), "rate": ("link", "at", "components")}
    reader.unused(entry, idle[kinds[0]], place, kinds[0])
    if kinds[0] == "rate":
        return JointRate(what)
    given = entry.get("components")
    chosen = None if given is None else tuple(reader.texts(given, f"{place}.components"))
    if chosen == ():
        reader.report(f"{place}.components", "an empty list", "one component or more")
    if kinds[0] == "twist":
        body = next((link for link in links if link.name == what), None)
        default = next(iter(body.points), "") if body is not None else ""
        point = reader.text(entry.get("at", default), f"{place}.at")
        return Twist(what, point, chosen or TWISTS[reader.space])
    carriers = [link.name for link in links if what in link.points]
    if not carriers:
        reader.report(place, f"the point {what!r}", "a point of some link")
    link = reader.text(entry.get("link", carriers[0] if carriers else ""), f"{place}.link")
    return PointVelocity(link, what, chosen or coordinates(reader.space))


def read_limits(value: Any, known: Quantities, reader: Reader) -> tuple[Limit, ...]:
    """The table `limits`: expression = [low, high], or { min = low } or { max = high }."""
    limits = []
    for text, bounds in reader.table(value, "limits").items():
        place = f"limits.{text}"
        if isinstance(bounds, Mapping):
            ends = reader.table(bounds, place, ("min", "max"))
            pair = [ends.get("min"), ends.get("max")]
        else:
            pair = reader.items(bounds, place)
        if len(pair) != 2 or pair == [None, None]:
            reader.report(place, kind_of(bounds), "[low, high], { min = low } or { max = high }")
            continue
        subject = moving_polynomial(text, known, place, reader)
        name = str(subject)
        if subject.is_Symbol and name.startswith("angle("):
            limits.append(_angle_limit(name[6:-1], pair, place, reader))
            continue
        low, high = (None if b is None else reader.expression(b, place) for b in pair)
        if low is not None and high is not None and (high - low).is_negative:
            reader.report(place, f"[{low}, {high}]", "the lower bound first")
        limits.append(Limit(subject, low, high))
    return tuple(limits)


def _angle_limit(column: str, pair: list[Any], place: str, reader: Reader) -> Limit:
    """low <= angle <= high, in cosine and sine."""
    low, high = (reader.angle(bound, place) if bound is not None else None for bound in pair)
    if low is None or high is None or not (high - low).is_nonnegative or not (2 * sympy.pi > high - low):
        found = kind_of(pair)
        reader.report(
            place, found, "[low, high], growing by less than a full turn, as [-90, 90] or [0, 2*pi/3]"
        )
        return Limit(sympy.Integer(0))
    return exact_arc(column, low, high)


def read_exclusions(value: Any, known: Quantities, reader: Reader) -> tuple[Exclusion, ...]:
    """The table `exclusions`: words = { coincide = ["A", "A0"] } or { zero = "expression" }."""
    exclusions = []
    for words, entry in reader.table(value, "exclusions").items():
        place = f"exclusions.{words}"
        read = reader.table(entry, place, ("coincide", "zero"))
        if set(read) == {"coincide"}:
            points = tuple(reader.names(read["coincide"], place))
            exclusions.append(Exclusion("coincide", points, words=words))
        elif set(read) == {"zero"}:
            if not (text := reader.text(read["zero"], place)):
                continue
            subject = moving_polynomial(text, known, place, reader)
            if subject.is_Symbol and str(subject).startswith("angle("):
                reader.report(place, text, "cos(JOINT) and sin(JOINT), in which conditions are polynomials")
            exclusions.append(Exclusion("zero", expression=subject, words=words))
        else:
            found = kind_of(entry)
            reader.report(place, found, '{ coincide = ["A", "B"] } or { zero = "expression" }')
    return tuple(exclusions)


def moving_polynomial(text: str, known: Quantities, place: str, reader: Reader) -> sympy.Expr:
    """A polynomial in coordinates and joint quantities, or the angle of a joint alone."""
    try:
        read = parse(text, reader.parameters, quantities=known, place=place, file=reader.file)
    except MechanismError as error:
        reader.problems.extend(error.problems)
        return sympy.Integer(0)
    spoken = [s for s in read.free_symbols if s.name not in reader.parameters]
    if not spoken:
        reader.report(place, text, "something that moves, as cos(A), length(P) or a coordinate C.x")
    elif not read.is_polynomial(*spoken):
        reader.report(place, text, f"a polynomial in {', '.join(sorted(s.name for s in spoken))}")
    elif not read.is_Symbol and any(s.name.startswith("angle(") for s in spoken):
        reader.report(place, text, "angle(JOINT) alone, or cos(JOINT) and sin(JOINT)")
    return read
