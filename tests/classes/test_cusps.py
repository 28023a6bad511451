"""Cusps: numbers from the literature, and from scans that follow the singularity curve in floats."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.classes.solve import solve
from singsym.mechanism import Mechanism, load, loads


def arm_scan(d2: float, d3: float, d4: float, r2: float) -> list[tuple[float, float]]:
    """(theta2, theta3) of the cusps of an orthogonal 3R arm, by kinematics written down by hand.

    The tool is at x = d2 + c2 X, y = W, z = -s2 X with X = d3 + d4 c3, W = r2 + d4 s3; in (x^2 + y^2, z) the
    map of the two angles folds along a curve, and cusps are where the fold's image turns back.
    """
    t = np.linspace(-np.pi, np.pi, 200_001)
    cosine = -np.sin(t) * d2 / (np.sin(t) * d3 - np.cos(t) * r2)
    found = []
    for side in (1, -1):
        with np.errstate(invalid="ignore"):
            a = side * np.arccos(cosine)
        x, w = d3 + d4 * np.cos(t), r2 + d4 * np.sin(t)
        image = np.array([(d2 + np.cos(a) * x) ** 2 + w**2, -np.sin(a) * x])
        steps = np.diff(image, axis=1)
        ends = (steps[:, 1:] * steps[:, :-1]).sum(axis=0) < 0
        found += [(float(a[k + 1]), float(t[k + 1])) for k in np.flatnonzero(ends)]
    return sorted(found)


@pytest.mark.parametrize(("d2", "d3", "d4", "r2"), [(1, 2, "3/2", 1), (1, 2, "1/2", 1), (2, 1, 3, "1/2")])
def test_cusps_of_orthogonal_arms(d2: object, d3: object, d4: object, r2: object) -> None:
    """Row 16: the first has 4 (Baili, Wenger, Chablat); all as their scans say, where the tool is off J1."""
    lengths = {"d2": d2, "d3": d3, "d4": d4, "r2": r2}
    arm = load("orthogonal-3r").with_parameters(**lengths)
    (found,) = solve(arm, "cusps 5", cache=False)
    seen = arm_scan(*(float(eval(str(x))) for x in lengths.values()))
    print(seen, [(p.points, p.path) for p in found.pieces])
