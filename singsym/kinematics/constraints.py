"""Joint limits and exclusions of a mechanism as polynomial conditions: the feasible set Omega.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.4 (the feasible set) and 5.1 (folded legs excluded).
"""

from __future__ import annotations

import re
from dataclasses import replace

import sympy

from singsym.kinematics.dimensions import dimensions
from singsym.kinematics.placement import Placement
from singsym.mechanism.model import Exclusion, Limit, Mechanism
from singsym.mechanism.problems import MechanismError, Problem
from singsym.polynomials import Polynomial

_COORDINATE = re.compile(r"(?P<point>.+)\.(?P<axis>[xyz])$")
_JOINT = re.compile(r"(?P<quantity>cos|sin|length)\((?P<joint>.+)\)$")


def constrained(mechanism: Mechanism, placed: Placement) -> Placement:
    """The placement with the mechanism's limits and exclusions added to its configuration space.

    Raises `MechanismError` for a point or joint quantity that the formulation does not know.
    """
    mechanism = mechanism.resolved
    space = placed.space
    exclusions = list(space.exclusions)
    nonnegative = list(space.nonnegative)
    for exclusion in mechanism.exclusions:
        exclusions.append(_excluded(exclusion, mechanism, placed))
    for limit in mechanism.limits:
        square = _strut_square(limit, placed)
        if square is not None:
            nonnegative += _strut_limits(limit, square, mechanism, placed)
            continue
        value, scale = scaled_value(limit.expression, mechanism, placed)
        if limit.low is not None:
            nonnegative.append(value - scaled_value(limit.low, mechanism, placed)[0] * scale)
        if limit.high is not None:
            nonnegative.append(scaled_value(limit.high, mechanism, placed)[0] * scale - value)
    space = replace(space, exclusions=tuple(exclusions), nonnegative=tuple(nonnegative))
    return replace(placed, space=space)


def _strut_square(limit: Limit, placed: Placement) -> Polynomial | None:
    """The squared length that a limit bounds, where the formulation knows only that of a positive length."""
    matched = _JOINT.match(str(limit.expression)) if limit.expression.is_Symbol else None
    if matched is None or matched["quantity"] != "length" or matched["joint"] not in placed.values:
        return None
    return placed.values[matched["joint"]].square


def _strut_limits(
    limit: Limit, square: Polynomial, mechanism: Mechanism, placed: Placement
) -> list[Polynomial]:
    """low <= length <= high for a positive length, by squares; a lower bound of zero or less says nothing."""
    found = []
    if limit.low is not None and not sympy.sympify(limit.low, strict=True).is_nonpositive:
        found.append(square - scaled_value(limit.low, mechanism, placed)[0] ** 2)
    if limit.high is not None:
        found.append(scaled_value(limit.high, mechanism, placed)[0] ** 2 - square)
    return found


def _excluded(exclusion: Exclusion, mechanism: Mechanism, placed: Placement) -> tuple[Polynomial, ...]:
    if exclusion.expression is not None:
        return (scaled_value(exclusion.expression, mechanism, placed)[0],)
    first, second = (_point(name, placed, mechanism) for name in exclusion.points)
    return tuple(d for d in (a - b for a, b in zip(first, second, strict=True)) if d)


def _point(name: str, placed: Placement, mechanism: Mechanism) -> tuple[Polynomial, ...]:
    if name in placed.space.points:
        return placed.space.points[name]
    known = ", ".join(sorted(placed.space.points))
    raise MechanismError([Problem("exclusions", name, f"a named point: {known}", file=mechanism.origin)])


def scaled_value(
    expression: sympy.Expr, mechanism: Mechanism, placed: Placement
) -> tuple[Polynomial, Polynomial]:
    """An expression as a polynomial over a positive scale."""
    ring = placed.space.ring
    numbers = dimensions(mechanism, placed.space.variables)
    total, scales = ring.zero, ring.one
    for term in sympy.Add.make_args(sympy.expand(expression)):
        value, scale = ring.one, ring.one
        for factor in sympy.Mul.make_args(term):
            base, exponent = factor.as_base_exp() if factor.is_Pow else (factor, sympy.Integer(1))
            if base.is_Symbol and exponent.is_Integer and exponent > 0:
                image, below = _symbol(base.name, mechanism, placed)
                value, scale = value * image ** int(exponent), scale * below ** int(exponent)
            else:
                value = value * ring.convert(numbers.number(factor))
        shared = scales.gcd(scale)
        more, other = scale.exact_quotient(shared), scales.exact_quotient(shared)
        total, scales = total * more + value * other, scales * more
    return total, scales


def _symbol(name: str, mechanism: Mechanism, placed: Placement) -> tuple[Polynomial, Polynomial]:
    """A symbol of a limit or exclusion, with the positive number that divides it."""
    ring = placed.space.ring
    coordinate, quantity = _COORDINATE.match(name), _JOINT.match(name)
    if quantity is not None:
        value = placed.values.get(quantity["joint"])
        found = None
        if value is not None:
            found = {"cos": value.cosine, "sin": value.sine, "length": value.length}[quantity["quantity"]]
        if value is not None and found is not None:
            return found, value.scale if value.scale is not None else ring.one
    elif coordinate is not None:
        place = _point(coordinate["point"], placed, mechanism)
        index = "xyz".index(coordinate["axis"])
        if index < len(place):
            return place[index], ring.one
    elif name in ring.names:
        return ring.gen(name), ring.one
    expected = "a point's coordinate such as A.x, cos(A), sin(A) or length(P) of a joint, or a parameter"
    raise MechanismError([Problem("limits and exclusions", name, expected, file=mechanism.origin)])
