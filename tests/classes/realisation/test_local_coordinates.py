"""Local coordinates of the space: strata that are open parts of it are never missed by random values."""

from __future__ import annotations

import pytest

from singsym.classes.realisation.local_coordinates import are_missed, local_coordinates
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.conditions.conditions import conditions
from singsym.effort.chance import use_seed
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load


@pytest.mark.engines
@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize(("name", "count"), [("3rrr", 3), ("spherical-3rrr", 3), ("five-bar", 2)])
def test_the_space_itself_is_met_and_the_loci_are_missed(name: str, count: int, seed: int) -> None:
    """Of these robots no factor vanishes on a whole component: each locus has dimension n - 1."""
    mechanism = load(name)
    equation = velocity_equation(mechanism)
    found = conditions(equation)
    with use_seed(seed):
        for label, types in (("5", T.RI | T.IO), ("4", T.RO | T.II)):
            values = local_coordinates(mechanism, equation, types)
            assert len(values) == count
            assert are_missed(equation.space.equations, values).is_undecided
            for locus in found[label].polynomials:
                assert are_missed((*equation.space.equations, *locus), values).is_yes


@pytest.mark.engines
def test_a_leg_that_turns_freely_is_met() -> None:
    """With platform and base congruent, C1 = A1, C2 = A2 and C3 = A3 leaves all three inputs free."""
    from pathlib import Path

    mechanism = load(Path(__file__).parents[2] / "cases" / "3rrr-congruent.toml")
    equation = velocity_equation(mechanism)
    values = local_coordinates(mechanism, equation, T.RI | T.IO)
    for locus in conditions(equation)["5"].polynomials:
        assert are_missed((*equation.space.equations, *locus), values).is_undecided


def test_other_classes_have_none() -> None:
    mechanism = load("five-bar")
    equation = velocity_equation(mechanism)
    assert local_coordinates(mechanism, equation, T.RI | T.RO | T.IO | T.II) == ()
