"""Whether two configurations can be joined: against what is known of arms and linkages by hand."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.classes.configuration.at import Analysis, at
from singsym.mechanism import load
from singsym.mechanism.problems import MechanismError
from singsym.motion.numeric import NumericLinkage, numeric
from singsym.motion.regions.joined import joined


def arm_at(a: float, b: float) -> Analysis:
    """The arm of two links at these angles in radians."""
    return at(load("2r"), {"joints": {"A": a, "B": b}})


def over(linkage: NumericLinkage, name: str, q: np.ndarray) -> Analysis:
    """The configuration of a mechanism of the library."""
    return at(load(name), {"variables": dict(zip(linkage.names, q.tolist(), strict=True))})


def test_elbow_up_and_down_cannot_be_joined() -> None:
    """det = l1 l2 sin B: a motion from B > 0 to B < 0 is stretched or folded, whichever way round."""
    found = joined(arm_at(0, 1), arm_at(0, -1))
    assert found.verdict.is_no
    assert found.apart is not None
    assert found.apart.condition == "5"
    assert found.path is None


def test_elbow_up_is_one_region() -> None:
    found = joined(arm_at(0.3, 0.2), arm_at(-2.5, 2.9))
    assert found.verdict.is_yes
    assert found.verdict.certainty == "certified"
    assert found.path is not None
    assert (np.sin(found.path.values["B"]) > 0).all()


def test_a_path_goes_round_what_is_in_the_way() -> None:
    """Between two places of the five-bar on one sheet: no determinant vanishes along the path, densely.

    The determinants are worked out here, from the coordinates of the points.  Rods of 3 on cranks of 2 over a
    base of 1; the angle at E is that of the line from D to E.
    """
    linkage = numeric(load("five-bar"))
    mode = linkage.modes(linkage.inputs)[0]
    ends = [linkage.configurations({"A": a, "E": e}, mode) for a, e in ((0.0, -1.5), (3.0, 2.0))]
    found = joined(*(over(linkage, "five-bar", q) for q in ends))
    assert found.verdict.is_yes
    assert found.path is not None
    assert len(found.path.times) > 2

    def determinants(a: np.ndarray, e: np.ndarray) -> np.ndarray:
        b = 2 * np.array([np.cos(a), np.sin(a)])
        d = np.array([[1.0], [0.0]]) - 2 * np.array([np.cos(e), np.sin(e)])
        middle, gap = (b + d) / 2, d - b
        half = np.hypot(*gap) / 2
        across = np.array([-gap[1], gap[0]]) / (2 * half) * np.sqrt(9 - half**2)
        # C on the side of the mode, which is told from the first configuration
        side = np.sign((ends[0][2:4] - middle[:, 0]) @ across[:, 0])
        c = middle + side * across
        pairs = ((b, c - b), (d - np.array([[1.0], [0.0]]), c - d), (c - b, c - d))
        return np.array([u[0] * v[1] - u[1] * v[0] for u, v in pairs])

    times = np.linspace(0, found.path.times[-1], 5000)
    along = found.path.at(times)
    values = determinants(along["A"], along["E"])
    assert (np.sign(values) == np.sign(values[:, :1])).all()


def test_arcs_of_one_kind_are_told_apart_without_a_sign() -> None:
    """A double rocker moves on two closed curves that are mirror images, cut at eight singular points, as by
    Grashof's rule; both signs are the same on two arcs, of which one is the other turned half round."""
    linkage = numeric(load("double-rocker"))
    given = linkage.sample(60, seed=5)
    signs = np.sign([np.concatenate([linkage.condition(k, q) for k in ("4", "5")]) for q in given])
    same = given[(signs > 0).all(axis=1)]
    near = [q for q in same if np.sign(linkage.joints(q)["D"]) == np.sign(linkage.joints(same[0])["D"])]
    far = [q for q in same if np.sign(linkage.joints(q)["D"]) != np.sign(linkage.joints(same[0])["D"])]
    assert near
    assert far
    found = joined(over(linkage, "double-rocker", near[0]), over(linkage, "double-rocker", far[0]))
    assert found.verdict.is_no
    assert "different arcs" in found.verdict.reason


def test_a_singular_configuration_is_in_no_region() -> None:
    found = joined(arm_at(0, 0), arm_at(0, 1))
    assert found.verdict.is_undecided
    assert "first" in found.verdict.reason


def test_configurations_of_two_mechanisms_are_refused() -> None:
    crank = at(load("slider-crank"), {"joints": {"A": "60 deg", "P": "(1 + sqrt(33)) / 2"}})
    with pytest.raises(MechanismError, match="different mechanisms"):
        joined(crank, arm_at(0, 1))
