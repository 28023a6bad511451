"""Rows 15 and 21 of the published results: five-bar linkages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType
from singsym.conditions.conditions import conditions
from singsym.elimination.ideal import Ideal
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Mechanism, load

Classified = Callable[[Mechanism], Classification]


@pytest.mark.parametrize(("lengths", "folded_degree"), [((2, 3, 3, 2, 1), 4), ((2, 3, 4, 3, 5), 6)])
def test_type_2_locus_of_the_end_point_is_a_sextic(lengths: tuple[int, ...], folded_degree: int) -> None:
    """Row 15: with rods BC, CD stretched, C moves on one irreducible curve of degree 6.

    The rods are in line folded as well, so that B, C, D collinear gives another factor: a sextic too, or for
    equal rods (B on D, anywhere about it) two circles conjugate over Q, a quartic.
    """
    named = dict(zip(("l1", "l2", "l3", "l4", "d"), lengths, strict=True))
    equation = velocity_equation(load("five-bar").with_parameters(**named))
    (in_line,) = conditions(equation)["4"].factors
    assert in_line.words == "B, C, D collinear"
    ring = equation.space.ring
    closed = Ideal(ring, (*equation.space.equations, in_line.polynomial))
    (curve,) = closed.eliminate(("Bx", "By", "Dx", "Dy")).value.generators
    assert sorted((p.total_degree, k) for p, k in curve.factors()) == sorted([(6, 1), (folded_degree, 1)])
    reach = sum((ring.gen(f"B{i}") - ring.gen(f"D{i}")) ** 2 for i in "xy") - (lengths[1] + lengths[2]) ** 2
    (stretched,) = (closed + reach).eliminate(("Bx", "By", "Dx", "Dy")).value.radical().value.generators
    assert stretched.total_degree == 6
    assert [k for _, k in stretched.factors()] == [1]
    assert set(stretched.variables) == {"Cx", "Cy"}


def test_classes_of_the_five_bar(classified: Classified) -> None:
    """Row 15: type 1 where a crank and its rod are in line, type 2 where the rods are, both in points.

    Both by hand for (2, 3, 3, 2) on 1: AC is 1 or 5 with A, B, C in line, and DE likewise.
    """
    result = classified(load("five-bar"))
    assert not result.undecided
    T = SingularityType
    assert {c.types: c.dimension for c in result.classes if c.verdict.is_yes} == {
        T.RI | T.IO: 1,
        T.RO | T.II: 1,
        T.RI | T.RO | T.II | T.IO: 0,
    }


def test_equilateral_pentagon_is_smooth(classified: Classified) -> None:
    """Row 21: the configuration space is a smooth surface, and no configuration has IIM.

    Five equal sides never lie flat: an odd number of unit steps to and fro does not close.
    """
    result = classified(load("pentagon"))
    assert not result.undecided
    assert [(s.dimension, s.smooth) for s in result.configuration_space] == [(2, "yes")]
    assert all(c.verdict.is_no for c in result.classes if SingularityType.IIM in c.types)
