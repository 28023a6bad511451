"""Bounds of real dimensions from above and from below, on sets whose dimension is known."""

from __future__ import annotations

import pytest

from singsym.classes.realisation import dimension_bounds
from singsym.classes.realisation.dimension_bounds import (
    bound_above,
    is_bounded,
    larger_parts,
    off_borders,
    points_off_exclusions,
)
from singsym.effort.budget import Undecided
from singsym.effort.verdict import Known, Verdict
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.polynomials import Ring
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y", "z"))
x, y, z = R.gens
PLANE_AND_LINE = (x * y, x * z)
"""The plane x = 0 and the x axis."""


@pytest.mark.engines
def test_a_bound_is_not_below_a_part_of_the_set() -> None:
    """The plane is of dimension 2: no bound of 1 or 0, whatever the line is."""
    system = RealSystem(R, PLANE_AND_LINE)
    for dimension in (0, 1):
        assert bound_above(system, dimension) is None
        assert not is_bounded(system, dimension)
    found = bound_above(system, 2)
    assert found is not None
    assert (found.value, found.certainty) == (2, "proven")
    assert is_bounded(system, 2)


def test_a_dimension_is_no_bound_below_itself_though_nothing_was_seen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Where hyperplanes give no answer in time, the complex dimension 2 is a bound of 2, and not of 1."""

    def late(*given: object) -> Verdict:
        raise Undecided("no time")

    monkeypatch.setattr(dimension_bounds, "seems_at_most", late)
    system = RealSystem(R, PLANE_AND_LINE)
    assert bound_above(system, 1) is None
    assert bound_above(system, 2) == Known(2)


@pytest.mark.engines
def test_what_an_exclusion_takes_out_does_not_count() -> None:
    """Without the plane x = 0 the line is left; without the line's points y = z = 0 the plane is."""
    line = RealSystem(R, PLANE_AND_LINE, exclusions=((x,),))
    assert bound_above(line, 1) is not None
    assert is_bounded(line, 1)
    assert bound_above(line, 0) is None
    assert bound_above(RealSystem(R, PLANE_AND_LINE, exclusions=((y, z),)), 1) is None


@pytest.mark.engines
def test_variables_in_no_equation_do_not_count_where_it_is_said() -> None:
    """x = y = 0 with z beside is a point in (x, y)."""
    system = RealSystem(R, (x, y))
    assert bound_above(system, 0) is None
    assert bound_above(system, 0, beside=1) is not None
    assert is_bounded(system, 0, beside=1)


def test_inequalities_are_strict_off_borders_but_where_they_are_equations() -> None:
    """On y = 0 the inequality y >= 0 is an equality throughout, x >= 1 only at a point."""
    half = off_borders(RealSystem(R, (y,), positive=(z,), nonnegative=(x - 1, y)))
    assert half.positive == (z, x - 1)
    assert half.nonnegative == ()


def test_points_off_exclusions() -> None:
    """On x^2 = x the plane x = 0 is excluded, and y^2 = 2, z = 0: two points; without the exclusion four."""
    equations = (x**2 - x, y**2 - 2, z)
    found = points_off_exclusions(RealSystem(R, equations, exclusions=((x,),))).value
    assert sorted(round(p.floats[1], 4) for p in found) == [-1.4142, 1.4142]
    assert all(p.sign(x - 1) == 0 for p in found)
    assert len(points_off_exclusions(RealSystem(R, equations)).value) == 4
    with pytest.raises(NotZeroDimensional):
        points_off_exclusions(RealSystem(R, PLANE_AND_LINE))


def test_a_larger_part_is_found_with_a_point_on_it() -> None:
    """The plane beside the line, at a point with x = 0; nothing larger in the plane, nor in a curve."""
    found = list(larger_parts(RealSystem(R, PLANE_AND_LINE), 1))
    assert [dimension for dimension, _ in found] == [2]
    assert all(witness.point.sign(x) == 0 for _, witness in found)
    assert list(larger_parts(RealSystem(R, PLANE_AND_LINE), 2)) == []
    assert list(larger_parts(RealSystem(R, (y - x**2, z - x**3)), 1)) == []


def test_no_larger_part_where_it_is_excluded() -> None:
    assert list(larger_parts(RealSystem(R, PLANE_AND_LINE, exclusions=((x,),)), 1)) == []
