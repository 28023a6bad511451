"""Joints of serial chains held at a value: the two links become one.

Source: singsym's own; the pose of a joint's second link is that of `Joint` in `singsym.mechanism.model`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

import networkx
import sympy

from singsym.mechanism.arcs import multiple_of_pi, rational_point
from singsym.mechanism.expressions import expression, is_angle
from singsym.mechanism.model import Joint, JointKind, JointRate, Limit, Link, Mechanism, Output, Space, Vector
from singsym.mechanism.problems import MechanismError, Problem


def locked(mechanism: Mechanism, values: Mapping[str, Any]) -> Mechanism:
    """The mechanism with some of its input joints R and P held; values in radians, or in its lengths.

    A value that is no multiple of pi is a rational point of the circle within 1e-6, which `description` says.
    Raises `MechanismError` for joints in loops or couplings, of other kinds or no inputs, and values outside
    the limits.

    >>> from singsym.mechanism import load
    >>> locked(load("2r"), {"B": "90 deg"}).link("AB").points
    {'A': (0, 0), 'B': (l1, 0), 'C': (l1, l2)}
    """
    for name, value in values.items():
        mechanism = _without(mechanism, name, value)
    return mechanism


def _without(mechanism: Mechanism, name: str, value: Any) -> Mechanism:
    place, file = f"lock {name}", mechanism.origin
    joint = next((j for j in mechanism.joints if j.name == name), None)
    if joint is None or name not in mechanism.inputs or joint.kind not in (JointKind.R, JointKind.P):
        free = [j.name for j in mechanism.joints if j.kind in (JointKind.R, JointKind.P)]
        expected = f"an input joint R or P among {', '.join(n for n in free if n in mechanism.inputs)}"
        raise MechanismError([Problem(place, repr(name), expected, file=file)])
    if coupled := next((c for c in mechanism.couplings if name in dict(c.terms)), None):
        found, advice = f"a joint of the coupling {coupled.name}", "in the file, write its two links as one"
        raise MechanismError([Problem(place, found, "a joint that none other follows", advice, file)])
    rest = mechanism.graph.copy()
    rest.remove_edge(joint.first, joint.second, key=name)
    beyond = networkx.node_connected_component(rest, joint.second)
    if joint.first in beyond:
        advice = "in the file, write its two links as one"
        raise MechanismError(
            [Problem(place, "a joint of a closed loop", "one of a serial chain", advice, file)]
        )
    number = expression(value, place=place, file=file)
    if not number.is_number or not number.is_real:
        raise MechanismError([Problem(place, str(value), "a number", file=file)])
    put, note = _quantities(joint, number)
    turn, shift = _pose(mechanism, joint, put)
    keep, gone = joint.first, joint.second
    if mechanism.ground in beyond:
        beyond = set(rest) - beyond
        keep, gone = gone, keep
        turn, shift = turn.T, -turn.T * shift
    merged, points, axes = _merged(mechanism, joint, keep, gone, turn, shift)
    links = tuple(
        merged if k.name == keep else _turned(k, turn, mechanism.space) if k.name in beyond else k
        for k in mechanism.links
        if k.name != gone
    )

    def moved(other: Joint) -> Joint:
        ends = (other.first, other.second)
        return replace(
            other,
            first=keep if other.first == gone else other.first,
            second=keep if other.second == gone else other.second,
            at=_renamed(other.at, ends, gone, points),
            axes=other.axes and _renamed(other.axes, ends, gone, axes),
            reference=other.reference and _renamed(other.reference, ends, gone, axes),
        )

    def output(given: Output) -> Output:
        if isinstance(given, JointRate) or given.link != gone:
            return given
        return replace(given, link=keep, point=points.get(given.point, given.point))

    return replace(
        mechanism,
        links=links,
        joints=tuple(moved(other) for other in mechanism.joints if other is not joint),
        inputs=tuple(label for label in mechanism.inputs if label != name),
        outputs=tuple(output(given) for given in mechanism.outputs),
        limits=tuple(_limits(mechanism, put, place, value)),
        exclusions=tuple(
            e if e.expression is None else replace(e, expression=e.expression.xreplace(put))
            for e in mechanism.exclusions
        ),
        mobility=None if mechanism.mobility is None else mechanism.mobility - 1,
        translating=tuple(link for link in mechanism.translating if link != gone),
        description="\n".join(part for part in (mechanism.description.strip(), note) if part),
    )


def _quantities(joint: Joint, value: sympy.Expr) -> tuple[dict[sympy.Symbol, sympy.Expr], str]:
    """The joint's cosine and sine, or its length, and what is to be said of it."""
    name = joint.name
    if joint.kind is JointKind.P:
        return {sympy.Symbol(f"length({name})"): value}, f"Locked: {name} at {value}."
    note = f"Locked: {name} at {value}."
    angle = value if is_angle(value) else multiple_of_pi(float(value)) if value.is_Rational else None
    if angle is None:
        c, s = rational_point(Fraction(repr(float(value))), up=True)
        note = f"Locked: {name} at {value}, to 1e-6."
    else:
        c, s = sympy.cos(angle), sympy.sin(angle)
    return {sympy.Symbol(f"cos({name})"): c, sympy.Symbol(f"sin({name})"): s}, note


def _pose(
    mechanism: Mechanism, joint: Joint, put: Mapping[sympy.Symbol, sympy.Expr]
) -> tuple[sympy.Matrix, sympy.Matrix]:
    """Rotation and translation from the frame of the joint's second link to that of its first."""
    first, second = mechanism.link(joint.first), mechanism.link(joint.second)
    up = (sympy.Integer(0), sympy.Integer(0), sympy.Integer(1))
    pair = [up, up] if joint.axes is None else [first.axes[joint.axes[0]], second.axes[joint.axes[1]]]
    a, b = (_column(v) for v in pair)
    if joint.reference is None:
        turn = _shortest(b, a, mechanism, joint)
    else:
        x, y = _column(first.axes[joint.reference[0]]), _column(second.axes[joint.reference[1]])
        turn = sympy.Matrix.hstack(x, a.cross(x), a) * sympy.Matrix.hstack(y, b.cross(y), b).T
    p, q = _column(first.points[joint.at[0]]), _column(second.points[joint.at[1]])
    if joint.kind is JointKind.P:
        p = p + put[sympy.Symbol(f"length({joint.name})")] * a
    else:
        c, s = (put[sympy.Symbol(f"{f}({joint.name})")] for f in ("cos", "sin"))
        turn = (c * sympy.eye(3) + s * _cross(a) + (1 - c) * a * a.T) * turn
    turn = turn.applyfunc(sympy.expand)
    return turn, (p - turn * q).applyfunc(sympy.expand)


def _shortest(b: sympy.Matrix, a: sympy.Matrix, mechanism: Mechanism, joint: Joint) -> sympy.Matrix:
    """The shortest rotation that takes b to a."""
    cosine, across = sympy.expand(b.dot(a)), _cross(b.cross(a))
    if cosine == -1:
        if mechanism.space is Space.PLANAR:
            return sympy.diag(-1, -1, 1)
        found, expected = "axes that point against each other", "a reference, which says where its angle is 0"
        raise MechanismError([Problem(f"lock {joint.name}", found, expected, file=mechanism.origin)])
    turn = sympy.eye(3) + across + across * across / (1 + cosine)
    return turn.applyfunc(lambda x: sympy.radsimp(sympy.expand(x)))


def _merged(
    mechanism: Mechanism, joint: Joint, keep: str, gone: str, turn: sympy.Matrix, shift: sympy.Matrix
) -> tuple[Link, dict[str, str], dict[str, str]]:
    """The link that both become, and the new names of the other's points and axes."""
    kept, lost = mechanism.link(keep), mechanism.link(gone)
    size = 2 if mechanism.space is Space.PLANAR else 3
    points, axes = dict(kept.points), dict(kept.axes)
    renamed: list[dict[str, str]] = []
    for home, given, offset in ((points, lost.points, shift), (axes, lost.axes, sympy.zeros(3, 1))):
        names: dict[str, str] = {}
        for name, vector in given.items():
            place = _vector(turn * _column(vector) + offset, size)
            new = name
            while new in home and home[new] != place:
                new += "_"
            names[name] = new
            home[new] = place
        renamed.append(names)
    return Link(keep, points, axes), renamed[0], renamed[1]


def _turned(link: Link, turn: sympy.Matrix, space: Space) -> Link:
    """A link beyond, in a frame that is turned with the one it hangs on, so that zeros stay what they are."""
    size = 2 if space is Space.PLANAR else 3
    points, axes = (
        {name: _vector(turn * _column(v), size) for name, v in named.items()}
        for named in (link.points, link.axes)
    )
    return Link(link.name, points, axes)


def _limits(
    mechanism: Mechanism, put: Mapping[sympy.Symbol, sympy.Expr], place: str, value: Any
) -> list[Limit]:
    """The limits that are left; raises `MechanismError` where the value is outside one."""
    left = []
    for limit in mechanism.limits:
        new = replace(limit, expression=limit.expression.xreplace(put))
        if new.expression.free_symbols:
            left.append(new)
            continue
        below = new.low is not None and (new.expression - new.low).is_negative
        above = new.high is not None and (new.high - new.expression).is_negative
        if below or above:
            expected = "a value within the joint's limits"
            raise MechanismError(
                [Problem(place, str(value), expected, "hold it at another", mechanism.origin)]
            )
    return left


def _renamed(
    pair: tuple[str, str], ends: tuple[str, str], gone: str, names: Mapping[str, str]
) -> tuple[str, str]:
    first, second = (names.get(n, n) if end == gone else n for n, end in zip(pair, ends, strict=True))
    return first, second


def _cross(a: sympy.Matrix) -> sympy.Matrix:
    """The matrix of the product a x."""
    x, y, z = a
    return sympy.Matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def _column(vector: Vector) -> sympy.Matrix:
    return sympy.Matrix([*vector, *(sympy.Integer(0),) * (3 - len(vector))])


def _vector(column: sympy.Matrix, size: int) -> Vector:
    return tuple(sympy.expand(x) for x in list(column)[:size])
