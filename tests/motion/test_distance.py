"""Distances to singularities: against lengths and angles worked out by hand."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from singsym.classes.configuration.at import at
from singsym.cli import main
from singsym.mechanism import load
from singsym.motion.coordinates import joint_space
from singsym.motion.distance import SingularityDistance, clear_radius, singularity_distance
from singsym.motion.numeric import numeric


def crank_at(degrees: int) -> SingularityDistance:
    """The slider-crank, crank 1 and rod 3, with its slide to the right."""
    crank = load("slider-crank")
    x = math.cos(math.radians(degrees)) + math.sqrt(9 - math.sin(math.radians(degrees)) ** 2)
    return singularity_distance(at(crank, {"joints": {"A": f"{degrees} deg", "P": x}}))


@pytest.mark.parametrize(("degrees", "way"), [(60, 1.0), (100, -1.0)])
def test_a_slider_crank_is_singular_at_its_dead_points_alone(degrees: int, way: float) -> None:
    """At 0 and 180 degrees, where the slide is at 4 and at 2."""
    found = crank_at(degrees)
    angle = math.radians(min(degrees, 180 - degrees))
    near = found.joint["RI"]
    assert near.distance == pytest.approx(angle, abs=1e-9)
    assert near.distance >= angle - 1e-15
    assert near.certified
    assert near.types_certified
    assert near.types.names == ("RI", "IO")
    assert near.away == pytest.approx({"A": way})
    x = math.cos(math.radians(degrees)) + math.sqrt(9 - math.sin(math.radians(degrees)) ** 2)
    assert found.output["RI"].distance == pytest.approx(4 - x if degrees < 90 else x - 2, abs=1e-7)
    assert found.clear is not None
    assert 0.02 < found.clear < angle
    assert {*found.joint} == {"RI", "IO"}


def test_pumas_elbow_shoulder_and_wrist_by_its_determinant() -> None:
    """det J = -a2 s5 (a3 s3 + d4 c3) (a2 c2 + a3 c23 - d4 s23): the wrist is straight at J5 = 0, and the
    elbow where tan(J3) = -d4/a3, nearest in J3 alone."""
    arm = load("puma560")
    joints = {"J1": 0.3, "J2": 0.4, "J3": 0.5, "J4": 0.6, "J5": 0.1, "J6": 0.8}
    found = singularity_distance(at(arm, {"joints": joints}))
    near = found.joint["IO"]
    assert near.distance == pytest.approx(0.1, abs=1e-9)
    assert near.away == pytest.approx({label: float(label == "J5") for label in joints}, abs=1e-9)
    assert near.joints["J5"] == pytest.approx(0, abs=1e-9)
    assert near.certified
    assert found.clear is not None
    assert 0.02 < found.clear <= 0.1
    assert not found.output
    assert "rotations" in found.remarks[0]


def test_no_sample_contradicts_the_bounds() -> None:
    """Near the five-bar's configuration no sampled one is singular within `clear`; the nearest one is.

    Factors of (4) and (5) change no sign over configurations on the same assembly mode, a grid of inputs.
    """
    five_bar = load("five-bar")
    linkage = numeric(five_bar)
    mode = linkage.modes(linkage.inputs)[0]
    q = linkage.configurations({"A": 1.6, "E": -2.0}, mode)
    start = dict(zip(linkage.names, q.tolist(), strict=True))
    found = singularity_distance(at(five_bar, {"variables": start}))
    assert found.clear is not None
    r = found.clear
    a, e = np.meshgrid(np.linspace(1.6 - r, 1.6 + r, 15), np.linspace(-2 - r, -2 + r, 15))
    around = linkage.configurations({"A": a, "E": e}, mode)
    for label in ("4", "5"):
        values = linkage.condition(label, around)
        assert ((values > 0).all(axis=(0, 1)) | (values < 0).all(axis=(0, 1))).all()
    near = found.joint["RI"]
    assert near.distance > r
    there = np.array([near.values[name] for name in linkage.names])
    assert np.abs(linkage.condition("5", there)).min() < 1e-9
    away = {label: near.away[label] * near.distance for label in ("A", "E")}
    assert near.joints["A"] == pytest.approx(1.6 - away["A"], abs=1e-6)
    assert near.joints["E"] == pytest.approx(-2.0 - away["E"], abs=1e-6)


def test_a_singular_configuration_is_its_own_nearest() -> None:
    found = crank_at(0)
    assert found.joint["RI"].distance < 1e-9
    assert found.joint["RI"].certified
    assert found.clear is None


def test_nothing_is_clear_about_a_singular_configuration() -> None:
    crank = load("slider-crank")
    equation = numeric(crank).equation
    joint = joint_space(equation, 1.0)
    assert joint is not None
    assert clear_radius(equation, joint, np.array([1.0, 0.0, 4.0]), 0.5) is None


def test_at_the_shell(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    here = tmp_path / "here.toml"
    here.write_text('[joints]\nA = "60 deg"\nP = 3.3722813232690143\n')
    assert main(["at", "slider-crank", "--config", str(here), "--distance"]) == 0
    page = capsys.readouterr().out
    assert "Proven: no singularity while the inputs keep nearer than" in page
    assert "1.0472" in page
    assert main(["at", "slider-crank", "--config", str(here), "--distance", "--format", "json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["nearest"]["joint"]["IO"]["certified"] is True
    assert main(["at", "slider-crank", "--config", str(here), "--format", "json"]) == 0
    assert "nearest" not in json.loads(capsys.readouterr().out)
