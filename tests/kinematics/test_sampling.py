"""Random configurations: as large as the mechanism, whatever numbers its equations contain."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from singsym.kinematics.mobility import check_mobility
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import loop_closure, velocity_equation
from singsym.mechanism import load
from singsym.mechanism.units import scaled


def test_constants_such_as_roots_of_large_numbers_are_no_lengths() -> None:
    """The platform of 3rpr has the root of 4264957983 in it, and pins some 10 apart.

    With starts 65306 away the three pins of the platform are one point to 4 digits, and rows of L alike.
    """
    found = check_mobility(velocity_equation(load("3rpr")))
    assert (found.samples, found.regular) == (12, 12)
    space = loop_closure(load("3rpr"))
    for point in sample_configurations(space, 4):
        assert abs(point[space.ring.index("B1x")]) < 500


@pytest.mark.parametrize("k", [Fraction(1, 1000), Fraction(1000)])
def test_configurations_grow_with_the_mechanism(k: Fraction) -> None:
    """The same starts, so the same configurations, times k where they are lengths."""
    mechanism = load("slider-crank")
    for one, other in zip(
        sample_configurations(loop_closure(mechanism), 5),
        sample_configurations(loop_closure(scaled(mechanism, k)), 5),
        strict=True,
    ):
        assert np.allclose(other, float(k) * one, rtol=1e-6, atol=0)
