"""Cusps: numbers from the literature, and scans that follow the singularity curve in floats."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from singsym.classes.solve import solve
from singsym.mechanism import load, loads


def scanned(d2: float, d3: float, d4: float, r2: float) -> list[tuple[float, float]]:
    """(theta2, theta3) at the cusps of an orthogonal 3R arm, by its kinematics written down by hand.

    The tool is at x = d2 + c2 X, y = W, z = -s2 X with X = d3 + d4 c3, W = r2 + d4 s3, up to turns of the
    first joint.  Of the singularity curve d2 s3 + c2 (d3 s3 - r2 c3) = 0 the image in (x^2 + y^2, z) turns
    back at cusps.
    """
    turn = np.linspace(-np.pi, np.pi, 100_001)
    cosine = -np.sin(turn) * d2 / (np.sin(turn) * d3 - np.cos(turn) * r2)
    found = []
    for side in (1, -1):
        with np.errstate(invalid="ignore"):
            other = side * np.arccos(cosine)
        x, w = d3 + d4 * np.cos(turn), r2 + d4 * np.sin(turn)
        image = np.array([(d2 + np.cos(other) * x) ** 2 + w**2, -np.sin(other) * x])
        steps = np.diff(image, axis=1)
        back = np.flatnonzero((steps[:, 1:] * steps[:, :-1]).sum(axis=0) < 0) + 1
        found += list(zip(other[back].tolist(), turn[back].tolist(), strict=True))
    return sorted(found)


@pytest.mark.parametrize(
    ("lengths", "count"),
    [(("1", "2", "3/2", "1"), 4), (("1", "2", "1/2", "1"), 4), (("2", "1", "3", "1/2"), 0)],
    ids=["published", "short tool", "long tool"],
)
def test_cusps_of_orthogonal_arms(lengths: tuple[str, ...], count: int) -> None:
    """Row 16: 4 of the first (Baili, Wenger, Chablat); all where the scan finds them, to its step.

    The first has two more configurations with a tangent null motion, the tool on J1's axis, which are none.
    """
    arm = load("orthogonal-3r").with_parameters(**dict(zip(("d2", "d3", "d4", "r2"), lengths, strict=True)))
    (found,) = solve(arm, "cusps 5", cache=False)
    joints = [w.joints for piece in found.pieces for w in piece.witnesses]
    places = sorted((float(j["J2"]), float(j["J3"])) for j in joints)
    assert not found.undecided
    assert sum(piece.points or 0 for piece in found.pieces) == len(places) == count
    seen = scanned(*(float(Fraction(x)) for x in lengths))
    assert np.allclose(np.reshape(places, (-1, 2)), np.reshape(seen, (-1, 2)), atol=1e-3)


def test_a_mechanism_with_two_assemblies_has_none() -> None:
    """A cusp needs three assemblies over the same inputs; a five-bar has two, this one's rods do not fold.

    With equal rods on coincident cranks the rods turn together: a curve of self-motions, dimension n - 1.
    """
    uneven = load("five-bar").with_parameters(l2=3, l3=4, l1=2, l4=3, d=5)
    assert [s.dimension for s in solve(uneven, "cusps 4", "cusps 5", cache=False)] == [-1, -1]
    (even,) = solve(load("five-bar"), "cusps 4", cache=False)
    assert even.dimension == 1
    assert "self-motions" in even.condition.types


SLICE = """
name = "slice"
inputs = ["P2", "P3"]
output = { velocity = "B2" }

[links]
ground = { points = { A1 = [0, 0], A2 = [15.91, 0], A3 = [0, 10] } }
platform = { sides = { B1B2 = 17.04, B2B3 = 16.54, B3B1 = 20.84 } }
A1B1 = 14.98
cylinder2 = { points = { A2 = [0, 0] }, axes = { u2 = [1, 0] } }
rod2 = { points = { B2 = [0, 0] }, axes = { u2 = [1, 0] } }
cylinder3 = { points = { A3 = [0, 0] }, axes = { u3 = [1, 0] } }
rod3 = { points = { B3 = [0, 0] }, axes = { u3 = [1, 0] } }

[joints]
A1 = "R"
B1 = "R"
A2 = "R"
P2 = { type = "P", links = ["cylinder2", "rod2"], at = ["A2", "B2"], axis = "u2" }
B2 = "R"
A3 = "R"
P3 = { type = "P", links = ["cylinder3", "rod3"], at = ["A3", "B3"], axis = "u3" }
B3 = "R"

[exclusions]
"leg 2 of length zero" = { coincide = ["A2", "B2"] }
"leg 3 of length zero" = { coincide = ["A3", "B3"] }
"""


@pytest.mark.engines
def test_cusps_of_a_platform_at_one_leg_length() -> None:
    """Row 11: the 3-RPR of Innocenti and Parenti-Castelli has six where leg 1 is 14.98 long."""
    (found,) = solve(loads(SLICE), "cusps 4", cache=False)
    assert not found.undecided
    assert sum(piece.points or 0 for piece in found.pieces) == 6
    places = [w.joints for piece in found.pieces for w in piece.witnesses]
    assert len({round(float(j["P2"]), 4) for j in places}) == len(places)


def test_what_cannot_be_asked_is_undecided() -> None:
    """The output has a rotation of the platform, of which the coordinates have no angle."""
    (found,) = solve(load("3rrr"), "cusps 5", cache=False)
    assert found.undecided
    assert "T.w" in found.doubts[0]
    assert "not told apart" in found.condition.types


def test_other_labels_are_refused() -> None:
    """Cusps are those of (4) and (5)."""
    with pytest.raises(KeyError, match="cusps iii"):
        solve(load("2r"), "cusps iii", cache=False)
