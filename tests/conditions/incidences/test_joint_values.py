"""Values of joints: well-known angles by hand, others by the signs of the polynomial on the circle."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.conditions.incidences.joint_values import joint_roots
from singsym.kinematics.placement import JointValue
from singsym.polynomials import Polynomial, Ring

RING = Ring(("c", "s", "d", "x"))
c, s, d, x = RING.gens
VALUES = {"J": JointValue(c, s, RING.one), "P": JointValue(length=d)}


def words(polynomial: Polynomial) -> str | None:
    found = joint_roots(polynomial, VALUES)
    return None if found is None else found.words


@pytest.mark.parametrize(
    ("polynomial", "said"),
    [
        (s, "J = 0 or 180 deg"),
        (c, "J = -90 or 90 deg"),
        (c - s, "J = -135 or 45 deg"),
        (c + 1, "J = 180 deg"),
        (2 * s - 1, "J = 30 or 150 deg"),
        (2 * c**2 - 1, "J = -135, -45, 45 or 135 deg"),
        (d - 3, "P = 3"),
        (d**2 - 2, "P ≈ -1.4142 or 1.4142"),
        (3 * c + 4 * s, "tan J = -3/4, J ≈ -36.9 or 143.1 deg"),
        (3 * c - 1, "cos J = 1/3, J ≈ -70.5 or 70.5 deg"),
        (3 * s + 1, "sin J = -1/3, J ≈ -160.5 or -19.5 deg"),
    ],
)
def test_exact_and_rounded_values(polynomial: Polynomial, said: str) -> None:
    """tan 36.87 = 3/4, cos 70.53 = 1/3, sin 19.47 = 1/3; what is rounded has a sign of its own."""
    assert words(polynomial) == said


@pytest.mark.parametrize("polynomial", [c + x, c * d, 3 * c + 5, d**2 + 1, RING.one, x])
def test_no_joint_alone_or_no_value(polynomial: Polynomial) -> None:
    assert words(polynomial) is None


@pytest.mark.parametrize(
    "polynomial", [3 * c + 4 * s - 1, 5 * c**2 - s, 2 * c * s - c + 7 * s, 7 * c + s + 3]
)
def test_against_the_signs_on_the_circle(polynomial: Polynomial) -> None:
    """All changes of sign on a fine grid, and no others."""
    angles = np.linspace(-180, 180, 720001) + 1e-7
    places = [np.cos(np.radians(angles)), np.sin(np.radians(angles)), 0 * angles, 0 * angles]
    signs = np.sign(polynomial.evaluate(places))
    crossings = angles[:-1][signs[:-1] != signs[1:]]
    found = joint_roots(polynomial, VALUES)
    assert found is not None
    assert found.rounded
    assert [float(value) for value in found.values] == pytest.approx(list(crossings), abs=0.0505)
