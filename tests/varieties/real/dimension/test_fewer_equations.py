"""Fewer equations that are enough for a bound, on sets that are known by hand."""

from __future__ import annotations

from singsym.polynomials import Ring
from singsym.varieties.real.dimension.fewer_equations import fewer_equations
from singsym.varieties.real.system import RealSystem

x, y, z = Ring(("x", "y", "z")).gens
LONG = x**3 + y**3 + z**3 + x * y * z - 5 * x + 7 * y - 2


def test_the_shortest_are_enough_for_a_larger_dimension() -> None:
    """A line with one more equation has points; for a dimension of 1 the line will do, for 2 a plane."""
    points = RealSystem(x.ring, (LONG, x - y, z + x))
    assert fewer_equations(points, 0) is None
    assert fewer_equations(points, 1) == (x + z, x - y)
    assert fewer_equations(points, 2) == (x + z,)


def test_an_equation_is_taken_that_leaves_a_larger_part_out() -> None:
    """x y = x z = 0 is a plane and a line: x + y = 1 leaves a line of the plane, and a point."""
    system = RealSystem(x.ring, (x * y, x * z, x + y - 1, LONG))
    assert fewer_equations(system, 1) == (x * y, x * z, x + y - 1)


def test_a_part_that_is_excluded_does_not_count() -> None:
    """Off x = 0 the line y = z = 0 is left."""
    system = RealSystem(x.ring, (x * y, x * z, LONG), exclusions=((x,),))
    assert fewer_equations(system, 1) == (x * y, x * z)
