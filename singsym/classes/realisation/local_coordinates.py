"""Local coordinates of the configuration space on the two simplest classes: joint values, or a pose.

Lemma. Let a stratum have inner points in the space where delta = p = k_I = 0, so that the space is a
manifold of dimension n there and L_I is regular. Then the rates of the inputs determine all others: their
values are local coordinates, and take all values of an open set on the stratum; so do almost all values
on the complex zeros of the stratum's equations. Where k_O = 0, the same holds for n joints that lead from
the ground to the output's link: with these at rest there is no output, so nothing moves; and where the
output is the full twist of a link, for its pose: x, y, z of a point, x, y of a second and x of a third
one, not in line with these, are independent on all poses, as are x, y and x in the plane. Parameters are
further coordinates.
Source: Zlatanov, Fenton, Benhabib (1998), (vii), (viii); Schwartz, J. ACM 27 (1980), for the random values.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations
from random import Random

import sympy
from flint import fmpq

from singsym.classes.taxonomy.types import SingularityType
from singsym.effort import chance
from singsym.effort.verdict import Verdict
from singsym.kinematics.loops import path, point_path
from singsym.kinematics.placement import JointValue
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.model import JointRate, Mechanism, PointVelocity, Space, Twist
from singsym.polynomials import Polynomial
from singsym.polynomials.unit_circles import half_angle_point
from singsym.varieties.real.dimension.independent_coordinates import WIDEST, is_missed, random_values

_T = SingularityType
_IN_LINE = 1e-9


def local_coordinates(
    mechanism: Mechanism, equation: VelocityEquation, types: SingularityType
) -> tuple[JointValue, ...]:
    """The values of joints and parameters that are local coordinates near inner points of a class, or none.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> linkage = load("fourbar")
    >>> [len(local_coordinates(linkage, velocity_equation(linkage), _T.RI | t)) for t in (_T.IO, _T.RO)]
    [1, 0]
    """
    ring, found = equation.space.ring, list[JointValue]()
    if types == _T.RI | _T.IO:
        found = _values(equation, [c.label for c in equation.columns if c.role == "input"])
    elif types == _T.RO | _T.II and len(mechanism.outputs) == 1:
        found = _values(equation, _to_the_output(mechanism))
        if len(found) != equation.n:
            found = _pose(mechanism, equation)
    # in a mode of translation a pose has fewer freedoms, and of mountings nothing is known
    if len(found) != equation.n or mechanism.translating or equation.space.mountings:
        return ()
    return (*found, *(JointValue(length=ring.gen(name)) for name in equation.space.parameters))


def _values(equation: VelocityEquation, labels: Sequence[str]) -> list[JointValue]:
    """The values of joints; none where one has none."""
    known = [equation.values[label] for label in labels if label in equation.values]
    return known if len(known) == len(labels) else []


def _to_the_output(mechanism: Mechanism) -> list[str]:
    """Joints with which the output is at rest."""
    (output,) = mechanism.outputs
    if isinstance(output, JointRate):
        return [output.column]
    pointwise = isinstance(output, PointVelocity) and mechanism.space is not Space.SPHERICAL
    way = point_path(mechanism, output.link, output.point) if pointwise else path(mechanism, output.link)
    return [column for joint, _ in way for column in joint.columns]


def _pose(mechanism: Mechanism, equation: VelocityEquation) -> list[JointValue]:
    """Coordinates of points of the output's link that tell its pose, where the output is its full twist."""
    (output,) = mechanism.outputs
    points = equation.space.points
    if not isinstance(output, Twist) or mechanism.space is Space.SPHERICAL:
        return []
    spatial = mechanism.space is Space.SPATIAL
    if len(output.components) != (6 if spatial else 3):
        return []
    own = {link.name: link for link in mechanism.links}[output.link].points
    names = [name for name in own if name in points and _is_one_point(mechanism, name)]
    if not spatial:
        return (
            [JointValue(length=p) for p in (*points[names[0]], points[names[1]][0])] if len(names) > 1 else []
        )
    for one, two, three in combinations(names, 3):
        sides = [sympy.Matrix(own[other]) - sympy.Matrix(own[one]) for other in (two, three)]
        if any(_is_nonzero(mechanism, x) for x in sides[0].cross(sides[1])):
            chosen = (*points[one], *points[two][:2], points[three][0])
            return [JointValue(length=p) for p in chosen]
    return []


def _is_nonzero(mechanism: Mechanism, expression: sympy.Expr) -> bool:
    """Whether an expression in lengths is not zero; False where parameters without a value are in it."""
    known = {sympy.Symbol(p.name): p.value for p in mechanism.parameters if p.value is not None}
    number = sympy.sympify(expression).subs(known)
    return bool(number.is_number and abs(float(number)) > _IN_LINE)


def _is_one_point(mechanism: Mechanism, name: str) -> bool:
    """Whether all points of a name are joined, so that they are one point of space."""
    owners = sum(name in link.points for link in mechanism.links)
    return sum(joint.at == (name, name) for joint in mechanism.joints) >= owners - 1


def are_missed(equations: Sequence[Polynomial], coordinates: Sequence[JointValue]) -> Verdict:
    """Whether the equations have no zero where the coordinates have random values.

    A yes is "modular"; else it is undecided.  Then, but for an unlucky draw, no real part of their zeros has
    these as local coordinates.
    Raises `Undecided`, and `engines.EngineUnavailable` without an engine for it.
    """
    random = chance.random("values of joints", *equations)
    values: dict[str, Polynomial] = {}
    others: list[Polynomial] = []
    for coordinate in coordinates:
        names = _variables(coordinate)
        if names and values.keys().isdisjoint(names):
            values |= random_values(equations[0].ring, names, random)
        else:
            others += _fixed(coordinate, random)
    return is_missed((*equations, *others), values)


def _variables(value: JointValue) -> tuple[str, ...]:
    """The variable that a joint's value is, or those that its cosine and sine are; else none."""
    parts = (value.length,) if value.length is not None else (value.cosine, value.sine)
    if value.square is not None or value.scale is not None or not all(map(_is_variable, parts)):
        return ()
    return tuple(name for p in parts if p is not None for name in p.variables)


def _is_variable(polynomial: Polynomial | None) -> bool:
    return polynomial is not None and any(polynomial == polynomial.ring.gen(n) for n in polynomial.variables)


def _fixed(value: JointValue, random: Random) -> list[Polynomial]:
    """That a joint has a random value: a rational length, or an angle with rational sine and cosine."""
    t = Fraction(random.randint(1, WIDEST), random.randint(1, WIDEST))
    if value.length is not None:
        return [value.length - _rational(value.length, t)]
    if value.square is not None:
        return [value.square - _rational(value.square, t)]
    assert value.cosine is not None
    assert value.sine is not None
    scale = value.cosine.ring.one if value.scale is None else value.scale
    cosine, sine = half_angle_point(t)
    return [
        value.cosine - scale * _rational(scale, cosine),
        value.sine - scale * _rational(scale, sine),
    ]


def _rational(near: Polynomial, number: Fraction) -> Polynomial:
    return near.ring.constant(fmpq(number.numerator, number.denominator))
