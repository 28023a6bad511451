"""Certified points of positive-dimensional systems."""

import pickle
from fractions import Fraction

import numpy as np
import pytest

from singsym.elimination.ideal import Ideal
from singsym.polynomials import AlgebraicConstant, Ring
from singsym.varieties.decomposition import Component
from singsym.varieties.purity import PurePiece
from singsym.varieties.real.dimension.real_dimension import local_dimension
from singsym.varieties.real.points.certified_point import _certified_box, find_witness
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y", "z"))
x, y, z = R.gens


@pytest.mark.parametrize("triple", ["ABC", "BCD", "CDG", "CGF", "EFG"])
def test_each_curve_of_the_linkage_has_a_certified_point(linkage, triple):
    equations = (*linkage.loops, linkage.determinant(triple))
    above = linkage.ring.gen("Cy")
    system = RealSystem(linkage.ring, equations, positive=(above,))
    found = find_witness(system)
    assert found is not None
    assert all(found.sign(f) == 0 for f in equations)
    assert found.sign(above) == 1
    assert len(found.frozen) == 1 or found.frozen == ("Bx", "By")  # one angle is given
    curve = PurePiece.of(Component(Ideal(linkage.ring, equations), prime=False, dimension=1))
    assert local_dimension(found, curve) == 1


def test_exclusions_leave_their_points_out():
    system = RealSystem(R, (x * z, y * z), exclusions=((z,),))
    found = find_witness(system)
    assert found is not None
    assert found.sign(z) != 0
    assert found.sign(x) == found.sign(y) == 0


def test_no_equations_at_all():
    found = find_witness(RealSystem(R, (), positive=(x - 3, -y)))
    assert found is not None
    assert found.sign(x - 3) == 1


def test_constants_keep_their_value():
    ring = Ring(("x", "y", "s"), constants=(AlgebraicConstant("s", (-3, 0, 1), Fraction(1), Fraction(2)),))
    a, b, s = ring.gens
    found = find_witness(RealSystem(ring, (a**2 + b**2 - s,)))
    assert found is not None
    assert found.sign(s) == 1
    assert "s" not in found.frozen
    assert find_witness(RealSystem(ring, (a**2 + b**2 + s,)), tries=5) is None


def test_a_box_around_a_conjugate_is_refused():
    """x = s = -sqrt(3) solves the equations, with a conjugate of the constant sqrt(3)."""
    ring = Ring(("x", "s"), constants=(AlgebraicConstant("s", (-3, 0, 1), Fraction(1), Fraction(2)),))
    a, s = ring.gens
    system = RealSystem(ring, (a - s,))
    equations = system.closed_equations
    assert _certified_box(system, equations, {}, np.array([1.7, 1.7])) is not None
    assert _certified_box(system, equations, {}, np.array([-1.7, -1.7])) is None


def test_a_witness_can_be_pickled():
    found = find_witness(RealSystem(R, (x**2 + y**2 + z**2 - 1,)))
    assert found is not None
    assert pickle.loads(pickle.dumps(found)) == found


def test_a_singular_point_is_not_called_smooth():
    from singsym.varieties.real.points.finite_sets import real_points

    (node,) = real_points([x, y, z]).value
    axes = PurePiece.of(Component(Ideal(R, (x * y, z)), prime=False, dimension=1))
    assert local_dimension(node, axes) is None
