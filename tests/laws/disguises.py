"""The same mechanism in another guise: turned, mirrored, in another unit, in another order, renamed.

Source: congruence and similarity of figures; each function gives a mechanism whose configurations correspond
one to one to those of the given one, with the same velocities up to a change of basis.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import sympy

from singsym.mechanism import Coupling, JointKind, JointRate, Limit, Link, Mechanism, Space
from singsym.mechanism.model import Vector

Disguise = Callable[[Mechanism], Mechanism]
Turn = Callable[[Vector], Vector]


def reordered(mechanism: Mechanism) -> Mechanism:
    """Links and joints listed backwards."""
    return replace(mechanism, links=mechanism.links[::-1], joints=mechanism.joints[::-1])


def renamed(mechanism: Mechanism) -> Mechanism:
    """Points with other names, in another alphabetical order; joints keep theirs."""
    names = sorted({name for link in mechanism.links for name in link.points}, reverse=True)
    new = {name: f"Q{i}" for i, name in enumerate(names)}
    symbols = {sympy.Symbol(f"{name}.{x}"): sympy.Symbol(f"{new[name]}.{x}") for name in names for x in "xyz"}
    return replace(
        mechanism,
        links=tuple(Link(k.name, {new[n]: x for n, x in k.points.items()}, k.axes) for k in mechanism.links),
        joints=tuple(replace(j, at=(new[j.at[0]], new[j.at[1]])) for j in mechanism.joints),
        outputs=tuple(
            o if isinstance(o, JointRate) else replace(o, point=new.get(o.point, o.point))
            for o in mechanism.outputs
        ),
        exclusions=tuple(
            replace(
                e,
                points=tuple(new[p] for p in e.points),
                expression=None if e.expression is None else e.expression.xreplace(symbols),
            )
            for e in mechanism.exclusions
        ),
        limits=tuple(replace(t, expression=t.expression.xreplace(symbols)) for t in mechanism.limits),
    )


def scaled(factor: Fraction) -> Disguise:
    """All lengths times a factor; a bound on a length alone too, in other expressions lengths are divided."""
    k = sympy.Rational(factor.numerator, factor.denominator)

    def put(mechanism: Mechanism) -> Mechanism:
        m = mechanism.resolved
        points = {f"{name}.{x}" for link in m.links for name in link.points for x in "xyz"}

        def unscaled(expression: sympy.Expr) -> sympy.Expr:
            return expression.xreplace({s: s / k for s in expression.free_symbols if _is_length(s, points)})

        def limit(t: Limit) -> Limit:
            if t.expression.is_Symbol and _is_length(t.expression, points):
                return Limit(t.expression, *(None if x is None else k * x for x in (t.low, t.high)))
            return replace(t, expression=sympy.expand(unscaled(t.expression)))

        return replace(
            m,
            links=tuple(
                Link(a.name, {n: tuple(k * x for x in p) for n, p in a.points.items()}, a.axes)
                for a in m.links
            ),
            joints=tuple(replace(j, pitch=None if j.pitch is None else k * j.pitch) for j in m.joints),
            limits=tuple(map(limit, m.limits)),
            exclusions=tuple(
                e if e.expression is None else replace(e, expression=unscaled(e.expression))
                for e in m.exclusions
            ),
            couplings=tuple(_coupling(c, m, k, 1) for c in m.couplings),
        )

    return put


def _coupling(coupling: Coupling, mechanism: Mechanism, length: sympy.Rational, turn: int) -> Coupling:
    """With lengths times a factor, and angles times 1 or -1; of a rack the radius is both."""
    if coupling.lift is not None:
        (follower, _), (driver, _) = coupling.terms
        sine, slide = sympy.Symbol(f"sin({driver})"), sympy.Symbol(f"length({driver})")
        lift = length * coupling.lift.subs({sine: turn * sine, slide: slide / length}, simultaneous=True)
        return Coupling.cam(coupling.name, follower, driver, sympy.expand(lift))
    slides = [mechanism.joint(column.split(".")[0]).kind is JointKind.P for column, _ in coupling.terms]
    if coupling.constant is not None:
        return replace(coupling, constant=(length if all(slides) else turn) * coupling.constant)
    pairs = zip(coupling.terms, slides, strict=True)
    return replace(coupling, terms=tuple((c, x if slide else length * turn * x) for (c, x), slide in pairs))


def _is_length(symbol: sympy.Symbol, points: set[str]) -> bool:
    return symbol.name in points or symbol.name.startswith("length(")


def mirrored(mechanism: Mechanism) -> Mechanism:
    """The last coordinate of every frame reversed: y in the plane, z in space."""

    def turn(x: Vector) -> Vector:
        return (*x[:-1], -x[-1])

    last = "y" if mechanism.space is Space.PLANAR else "z"

    def image(symbol: sympy.Symbol) -> sympy.Expr:
        odd = symbol.name.startswith("sin(") or symbol.name.endswith(f".{last}")
        return -symbol if odd else symbol

    joints = tuple(replace(j, pitch=None if j.pitch is None else -j.pitch) for j in mechanism.joints)
    couplings = tuple(_coupling(c, mechanism, sympy.Integer(1), -1) for c in mechanism.couplings)
    return _moved(replace(mechanism, joints=joints, couplings=couplings), turn, image)


def turned(mechanism: Mechanism) -> Mechanism | None:
    """All frames turned by the angle of (3/5, 4/5) about z; None where an output or input tells x from y."""
    c, s = sympy.Rational(3, 5), sympy.Rational(4, 5)
    for output in mechanism.outputs:
        if not isinstance(output, JointRate):
            kinds = {name[:-1] for name in output.components if name[-1] in "xy"}
            if any(not {f"{k}x", f"{k}y"} <= set(output.components) for k in kinds):
                return None
    if any(label.split(".")[-1] in ("x", "y") for label in mechanism.inputs):
        return None
    if any(isinstance(o, JointRate) and "." in o.column for o in mechanism.outputs):
        return None

    def turn(x: Vector) -> Vector:
        return (c * x[0] - s * x[1], s * x[0] + c * x[1], *x[2:])

    def image(symbol: sympy.Symbol) -> sympy.Expr:
        point, _, axis = symbol.name.rpartition(".")
        x, y = sympy.Symbol(f"{point}.x"), sympy.Symbol(f"{point}.y")
        if not point or axis not in "xy":
            return symbol
        return c * x + s * y if axis == "x" else c * y - s * x

    return _moved(mechanism, turn, image)


def _moved(mechanism: Mechanism, turn: Turn, image: Callable[[sympy.Symbol], sympy.Expr]) -> Mechanism:
    """Every link's frame moved by one orthogonal map, and expressions of points and joints with it."""
    m = mechanism.resolved
    known = {f"{name}.{x}" for link in m.links for name in link.points for x in "xyz"}
    known |= {f"sin({j.name})" for j in m.joints}

    def moved(expression: sympy.Expr) -> sympy.Expr:
        return expression.xreplace({s: image(s) for s in expression.free_symbols if s.name in known})

    def frame(link: Link) -> Link:
        points, axes = ({n: turn(x) for n, x in part.items()} for part in (link.points, link.axes))
        return Link(link.name, points, axes)

    return replace(
        m,
        links=tuple(map(frame, m.links)),
        limits=tuple(replace(t, expression=moved(t.expression)) for t in m.limits),
        exclusions=tuple(
            e if e.expression is None else replace(e, expression=moved(e.expression)) for e in m.exclusions
        ),
    )


SCALES = (Fraction(1, 1000), Fraction(2), Fraction(7, 3), Fraction(1000))
DISGUISES: dict[str, Callable[[Mechanism], Mechanism | None]] = {
    "turned": turned,
    "mirrored": mirrored,
    "reordered": reordered,
    "renamed": renamed,
    **{f"scaled by {k}": scaled(k) for k in SCALES},
}
