"""Exact vectors of a link's frame: rotations, perpendiculars, and numbers that are nearly zero."""

from __future__ import annotations

import pytest
import sympy

from singsym.kinematics.formulations import local
from singsym.kinematics.formulations.local import Vector

X, Y, Z = local.UNITS
THIRD = sympy.Rational(1, 3)
INCLINED: Vector = (sympy.Rational(3, 5), sympy.Integer(0), sympy.Rational(4, 5))
SKEW: Vector = (THIRD, 2 * THIRD, 2 * THIRD)
DIAGONAL: Vector = (1 / sympy.sqrt(3),) * 3
OPPOSITE = local.times(-1, DIAGONAL)


def test_zero_is_decided_exactly() -> None:
    """(sqrt 2 + sqrt 3)^2 = 5 + 2 sqrt 6; a rational 10^-40 from sqrt 2 is not it."""
    root = sympy.sqrt
    assert local.is_zero(root(2) + root(3) - root(5 + 2 * root(6)))
    near = sympy.Rational(sympy.floor(root(2) * 10**40), 10**40)
    assert not local.is_zero(root(2) - near)
    a = sympy.Symbol("a")
    assert local.is_zero((a**2 - 2) / (a - root(2)) - a - root(2))
    assert not local.is_zero(a - root(2))


@pytest.mark.parametrize("start", [X, Z, SKEW, DIAGONAL])
@pytest.mark.parametrize("end", [X, SKEW, OPPOSITE])
def test_shortest_rotation_takes_one_to_the_other(start: Vector, end: Vector) -> None:
    """Its matrix is orthogonal with determinant 1; its trace is 1 + 2 cos of the angle between them."""
    turn = local.shortest_rotation(start, end)
    assert local.vanishes(local.minus(local.apply(turn, start), end))
    matrix = sympy.Matrix(turn)
    assert (matrix * matrix.T - sympy.eye(3)).applyfunc(sympy.simplify) == sympy.zeros(3, 3)
    assert sympy.simplify(matrix.det()) == 1
    cosine = local.dot(start, end)
    assert local.is_zero(matrix.trace() - 1 - 2 * cosine)


def test_no_rotation_is_needed_for_the_same_direction() -> None:
    assert local.shortest_rotation(SKEW, SKEW) is local.IDENTITY


@pytest.mark.parametrize("axis", [X, Y, Z, SKEW, INCLINED])
def test_perpendiculars_are_right_handed_and_equally_long(axis: Vector) -> None:
    n1, n2 = local.perpendiculars(axis)
    assert local.is_zero(local.dot(n1, axis))
    assert local.is_zero(local.dot(n1, n1) - local.dot(n2, n2))
    assert local.vanishes(local.minus(local.cross(axis, n1), n2))


def test_parallel_and_unit_vectors() -> None:
    assert local.parallel(SKEW, SKEW) == 1
    assert local.parallel(SKEW, local.times(-1, SKEW)) == -1
    assert local.parallel(SKEW, X) == 0
    assert local.unit((sympy.Integer(1), sympy.Integer(2), sympy.Integer(2))) == SKEW
    with pytest.raises(ValueError, match="nonzero vector"):
        local.unit((sympy.Integer(0),) * 3)


def test_coordinates_in_a_skew_basis() -> None:
    """(3, 2, 1) = 1 (1, 0, 0) + 1 (1, 1, 0) + 1 (1, 1, 1); on one vector only what is along it."""
    basis = ((1, 0, 0), (1, 1, 0), (1, 1, 1))
    exact = [tuple(map(sympy.Integer, v)) for v in basis]
    three, two, one = map(sympy.Integer, (3, 2, 1))
    assert local.coordinates(exact, (three, two, one)) == (1, 1, 1)
    assert local.coordinates([SKEW], local.times(6, SKEW)) == (6,)
    assert local.coordinates([SKEW], (three, two, one)) is None


def test_collinear_points() -> None:
    origin: Vector = (sympy.Integer(0),) * 3
    assert local.is_collinear([origin, SKEW, local.times(-5, SKEW), SKEW])
    assert local.is_collinear([SKEW, SKEW])
    assert not local.is_collinear([origin, SKEW, X])
    assert not local.is_collinear([origin, origin, X, Y])
