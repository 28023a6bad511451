"""Conditions of redundant arms against numerical ranks of Jacobians that are written down here."""

from __future__ import annotations

import math
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from singsym.conditions.redundant import RedundantChain, redundant_chain
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Choice, Mechanism, define, load
from singsym.mechanism.fileformat import read
from tests.mechanism.urdf.files import joint, write

PLANAR = {
    "inputs": ["A", "B", "C"],
    "links": {"ground": {"points": {"A": [0, 0]}}, "AB": 2, "BC": 2, "CT": 1},
    "joints": {"A": "R", "B": "R", "C": "R"},
}


def unchecked(**keys: Any) -> Mechanism:
    """The mechanism of a file's keys, whose output may have fewer components than there are inputs."""
    mechanism, problems = read(keys)
    assert not problems
    return mechanism


def holds(chain: RedundantChain, values: dict[str, tuple[float, float]]) -> bool:
    """Whether the condition holds at (cosine, sine) of each joint; variables are c and s with its name."""
    ring = chain.equation.space.ring
    point = []
    for name in ring.names:
        c, s = values[name[1:].removeprefix("_")]
        point.append(c if name[0] == "c" else s)
    alternatives = chain.condition.alternatives
    assert alternatives is not None
    return any(all(abs(f.polynomial.evaluate(point)) < 1e-9 for f in a) for a in alternatives)


def test_a_planar_arm_with_a_point() -> None:
    """Rank 1 where all three joints and the tool are in line: sin B = sin C = 0, and nowhere else."""
    arm = unchecked(**PLANAR, output={"velocity": "T"})
    chain = redundant_chain(velocity_equation(arm))
    assert (chain.inputs, chain.outputs) == (3, 2)
    names = chain.equation.space.ring.names
    assert {n[1:].removeprefix("_") for n in names} <= {"A", "B", "C", "1", "2", "3"}
    steps = [0.0, 0.4, math.pi / 2, 2.0, math.pi]
    for b, c in product(steps, steps):
        values = {name: (math.cos(x), math.sin(x)) for name, x in zip("ABC", (0.7, b, c), strict=True)}
        assert holds(chain, values) == (abs(math.sin(b)) < 1e-9 and abs(math.sin(c)) < 1e-9)


AXES = "zyzyzyz"
HEIGHTS = (0.3, 0.0, 0.4, 0.0, 0.5, 0.0, 0.0)


def jacobian(angles: list[float]) -> np.ndarray:
    """An arm S-R-S: axes z, y, z, y, z, y, z, the frame of each joint above the one before."""
    frame, place, columns = np.eye(3), np.zeros(3), []
    for axis, height, angle in zip(AXES, HEIGHTS, angles, strict=True):
        place = place + frame @ [0, 0, height]
        c, s = math.cos(angle), math.sin(angle)
        turn = [[c, -s, 0], [s, c, 0], [0, 0, 1]] if axis == "z" else [[c, 0, s], [0, 1, 0], [-s, 0, c]]
        columns.append((frame @ [0.0, float(axis == "y"), float(axis == "z")], place))
        frame = frame @ np.array(turn)
    return np.array([[*u, *np.cross(u, place - p)] for u, p in columns]).T


@pytest.mark.parametrize(
    ("angles", "lost"),
    [
        ({}, False),
        ({4: 0.0}, True),
        ({2: 0.0}, False),
        ({6: 0.0}, False),
        ({2: 0.0, 6: 0.0}, True),
        ({2: 0.0, 3: math.pi / 2}, True),
        ({2: 0.0, 3: math.pi / 3}, False),
        ({6: math.pi, 5: math.pi / 2}, True),
        ({6: math.pi, 5: math.pi / 4}, False),
    ],
)
def test_an_arm_of_seven_joints(tmp_path: Path, angles: dict[int, float], lost: bool) -> None:
    """Elbow straight; shoulder and wrist both; or one of them with the roll next to it at a right angle."""
    rows = [
        joint(
            "continuous",
            f"l{i}",
            f"l{i + 1}",
            xyz=f"0 0 {h}",
            axis="0 0 1" if a == "z" else "0 1 0",
            name=f"j{i + 1}",
        )
        for i, (a, h) in enumerate(zip(AXES, HEIGHTS, strict=True))
    ]
    chain = redundant_chain(velocity_equation(load(write(tmp_path, *rows), Choice(redundant=True))))
    given = [angles.get(i, 0.3 + 0.37 * i) for i in range(1, 8)]
    assert (np.linalg.matrix_rank(jacobian(given), tol=1e-9) < 6) == lost
    values = {f"j{i}": (math.cos(x), math.sin(x)) for i, x in enumerate(given, 1)}
    values |= {str(i): value for i, value in enumerate(list(values.values()), 1)}
    assert holds(chain, values) == lost


def test_a_tip_that_never_has_all_its_components() -> None:
    """Three slides in one direction, z: vx is possible in no configuration, vz in all."""
    rows = [{"joint": "P"}, {"joint": "P"}, {"joint": "P"}]
    arm = unchecked(dh={"rows": rows}, output={"twist": "link3", "components": ["vx", "vz"]})
    assert redundant_chain(velocity_equation(arm)).condition.everywhere
    always = unchecked(dh={"rows": rows}, output={"twist": "link3", "components": ["vz"]})
    assert redundant_chain(velocity_equation(always)).condition.alternatives == ()


def test_what_is_not_redundant_is_refused() -> None:
    square = define(**{**PLANAR, "output": {"twist": "CT", "at": "T"}})
    with pytest.raises(ValueError, match="more inputs than output components"):
        redundant_chain(velocity_equation(square))
    with pytest.raises(ValueError, match="serial chain"):
        redundant_chain(velocity_equation(load("fourbar")))
