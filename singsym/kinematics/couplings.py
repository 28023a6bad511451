"""Coupled joints in the configuration space: what gears and cams say of cosines and sines, or of lengths.

Source: de Moivre's formula: whole multiples of angles are powers of cosine + i sine.

Lemma. On the circles a relation sum a_k theta_k = phi says that a product of powers of the units
u_k = c_k + i s_k is exp(i phi): one equation on a torus, whose derivative along a motion is i exp(i phi)
times sum a_k omega_k. Its real and imaginary part generate the same ideal there, so that a coupling is one
smooth hypersurface, whose tangents have the rates of the velocity equation.

Lemma. So is a cam, l = lift(c, s): its derivative along a motion is that of l minus the lift's derivative
along the circle, times the rate of the angle.

Lemma. In all ways to mount k screws and racks, these ask for nothing: L without k rows, which has at most k
motions more; where L has rank N, exactly k more, and the space of all mountings has dimension n + k.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import prod

import sympy

from singsym.kinematics.constraints import scaled_value
from singsym.kinematics.dimensions import dimensions
from singsym.kinematics.placement import JointValue, Placement
from singsym.mechanism.couplings import Relation, angle_relations, mountings, slide_relations
from singsym.mechanism.model import Mechanism
from singsym.mechanism.problems import MechanismError, Problem
from singsym.polynomials import Polynomial
from singsym.polynomials.short_forms import short_forms
from singsym.polynomials.unit_circles import circle, unit_circles

Complex = tuple[Polynomial, Polynomial]
"""Real and imaginary part."""


def coupled(mechanism: Mechanism, placed: Placement) -> Placement:
    """The placement with the relations of the mechanism's couplings among its equations, and its mountings.

    Raises `MechanismError` for a joint whose value the formulation does not know.
    """
    space = replace(placed.space, mountings=mountings(mechanism))
    if not mechanism.couplings:
        return replace(placed, space=space)
    circles = tuple(circle(*map(space.ring.gen, pair)) for pair in unit_circles(space.equations))
    shorten = short_forms(space.ring, circles).shorten
    found = [shorten(space.ring.reduced(e)).primitive() for e in _equations(mechanism, placed)]
    equations = tuple(dict.fromkeys(e for e in (*space.equations, *found) if e))
    return replace(placed, space=replace(space, equations=equations))


def coupling_rows(mechanism: Mechanism, placed: Placement) -> Iterator[tuple[str, dict[str, Polynomial]]]:
    """The rows of L: a name, and the coefficients of the rates by column label.

    Those of a cam are times a positive number, so that they are polynomials.
    """
    for coupling in mechanism.resolved.couplings:
        found = {column: scaled_value(x, mechanism, placed) for column, x in coupling.terms}
        scale = prod((below for _, below in found.values()), start=placed.space.ring.one)
        row = {column: value * scale.exact_quotient(below) for column, (value, below) in found.items()}
        yield f"coupling {coupling.name}", row


def _equations(mechanism: Mechanism, placed: Placement) -> Iterator[Polynomial]:
    ring = placed.space.ring
    sized = dimensions(mechanism.resolved, placed.space.variables)
    for relation in slide_relations(mechanism):
        total = -sized.number(relation.constant)
        for column, number in relation.terms:
            total = total + sized.number(number) * _length(column, mechanism, placed)
        yield total
    for coupling in mechanism.resolved.couplings:
        if coupling.lift is not None:
            lift, scale = scaled_value(coupling.lift, mechanism, placed)
            yield scale * _length(coupling.terms[0][0], mechanism, placed) - lift
    for relation in angle_relations(mechanism):
        phase = (sized.number(sympy.cos(relation.constant)), sized.number(sympy.sin(relation.constant)))
        yield from _angles(relation, mechanism, placed, phase, (ring.one, ring.zero))


def _angles(
    relation: Relation, mechanism: Mechanism, placed: Placement, phase: Complex, one: Complex
) -> Iterator[Polynomial]:
    """Real and imaginary part of the relation, angles with negative coefficients on the other side."""
    left, right = one, phase
    for column, number in relation.terms:
        value = _known(column, mechanism, placed)
        if value.cosine is None or value.sine is None:
            raise _unknown(column, mechanism, placed)
        unit = _power((value.cosine, value.sine), abs(int(number)), one)
        scale = _power((value.scale or one[0], one[1]), abs(int(number)), one)
        if number < 0:
            unit, scale = scale, unit
        left, right = _product(left, unit), _product(right, scale)
    yield left[0] - right[0]
    yield left[1] - right[1]


def _product(a: Complex, b: Complex) -> Complex:
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]


def _power(base: Complex, exponent: int, one: Complex) -> Complex:
    found = one
    for _ in range(exponent):
        found = _product(found, base)
    return found


def _length(column: str, mechanism: Mechanism, placed: Placement) -> Polynomial:
    value = _known(column, mechanism, placed)
    if value.length is None:
        raise _unknown(column, mechanism, placed)
    return value.length


def _known(column: str, mechanism: Mechanism, placed: Placement) -> JointValue:
    if column not in placed.values:
        raise _unknown(column, mechanism, placed)
    return placed.values[column]


def _unknown(column: str, mechanism: Mechanism, placed: Placement) -> MechanismError:
    found = f"{column}, whose value the {placed.space.formulation} formulation does not know"
    known = f"joints among {', '.join(placed.values) or 'none'}"
    advice = 'write formulation = "joint", which knows the values of most joints'
    return MechanismError([Problem("couplings", found, known, advice, mechanism.origin)])
