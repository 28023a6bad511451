"""Scenes as data: what the viewer gets keeps links rigid, and places that are the same are one."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

from singsym.mechanism import load
from singsym.mechanism.model import Space
from singsym.output.figures.poses import portrait, poses_along
from singsym.output.figures.scene import Stage
from singsym.output.html.scenes import Track, scene_box
from singsym.polynomials.compiled_map import numerical_matrix


@pytest.mark.parametrize("name", ["fourbar", "3rrr", "spherical-5r", "orthogonal-3r", "zlatanov-hybrid-3-2"])
def test_bars_keep_their_lengths_in_every_frame(name: str) -> None:
    """Along a feasible motion the ends of each bar stay as far apart, to the rounding of whole numbers."""
    stage = Stage.of(load(name))
    point = portrait(stage)
    motion = np.linalg.svd(numerical_matrix(stage.equation.matrix, point))[2][-1]
    rates = dict(zip([c.label for c in stage.equation.columns], motion, strict=True))
    poses = np.array(poses_along(stage, point, rates, np.linspace(-1, 1, 5)))
    box = scene_box(stage, [Track("", poses, centred=True)], "a motion")
    data = json.loads(re.findall(r'<script type="application/json">(.*?)</script>', box)[0])
    assert data["flat"] == (stage.mechanism.space is Space.PLANAR)
    bars = [shape["at"] for shape in data["shapes"] if shape["style"].endswith(" bar")]
    assert bars
    frames = data["tracks"][0]["frames"]
    assert len(frames) == 5
    whole = []
    for frame in frames:
        places = np.array(data["fixed"], dtype=float)
        places[data["moving"]] = np.reshape(frame, (-1, 3))
        whole.append([float(np.linalg.norm(places[a] - places[b])) for a, b in bars])
    assert np.ptp(np.array(whole), axis=0).max() < 3.0
    assert np.ptp(np.array(frames), axis=0).max() > 50, "and something moves"


def test_places_that_stay_together_are_one() -> None:
    """Four-bar: pins and the ends of bars are A, B, C, D."""
    stage = Stage.of(load("fourbar"))
    box = scene_box(stage, [Track("", portrait(stage)[None])], "a four-bar")
    data = json.loads(re.findall(r'<script type="application/json">(.*?)</script>', box)[0])
    assert len(data["fixed"]) == 4
    assert "<button" not in box
