"""Conditions (vi) and (4) by legs: the paper's words, screws by hand, and the rank of L at random values."""

from __future__ import annotations

import math
import random
import re
from dataclasses import replace

import numpy as np
import pytest
import sympy
from flint import fmpq, fmpq_mat

from singsym.conditions.equilibrium import Equilibrium, equilibrium
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import load
from singsym.minors.rank import rank_at

MECHANISMS = [
    *("zlatanov-2dof", "zlatanov-hybrid", "3rrr", "3rps", "linear-delta", "stewart-gough", "ten-bar"),
    *("fourbar", "sarrus", "tests/cases/jansen-leg.toml"),
]


def choices(equation: VelocityEquation, found: Equilibrium, point: list[fmpq], inputs: bool) -> int:
    """How many independent choices of screws there are: from the joints of the legs and the signs alone."""
    rows = equation.matrix.evaluate(point)
    loops: dict[str, list[int]] = {}
    for i, label in enumerate(equation.rows):
        if label.startswith("loop"):
            loops.setdefault(label.rpartition(" ")[0], []).append(i)
    size, free = len(next(iter(loops.values()))), len(found.free)
    spins = [i for i, label in enumerate(equation.rows) if label.startswith("no idle spin")]
    carried = {
        name: signs for names, signs in zip(found.joints, found.carried, strict=True) for name in names
    }
    demands = []
    for j, column in enumerate(equation.columns):
        if column.role == "output" or (column.role == "input" and not inputs):
            continue
        blocks = [[rows[i][j] for i in own] for own in loops.values()]
        screw = next((block for block in blocks if any(block)), [fmpq(0)] * size)
        signs = carried.get(column.label.split(".")[0], (0,) * free)
        demands.append([*(s * e for s in signs for e in screw), *(rows[i][j] for i in spins)])
    return size * free + len(spins) - int(fmpq_mat(demands).rank())


@pytest.mark.parametrize("inputs", [True, False])
@pytest.mark.parametrize("name", MECHANISMS)
def test_the_choices_of_screws_are_what_l_lacks_in_rank(name: str, inputs: bool) -> None:
    """At values from -1, 0, 1, also off the loops: as many as rows of L, or L_I, are dependent."""
    equation = velocity_equation(load(name))
    found = equilibrium(equation, inputs)
    assert found is not None
    matrix = equation.L if inputs else equation.L_I
    draw, lacking = random.Random(name), set()
    for _ in range(12):
        point = [fmpq(draw.choice((-1, 0, 0, 1))) for _ in equation.space.ring.names]
        lacks = matrix.shape[0] - rank_at(matrix, point)
        # a spin row that vanishes at these values is a choice of its own in both counts
        assert choices(equation, found, point, inputs) == lacks
        lacking.add(lacks > found.surplus)
    assert True in lacking


def test_there_is_none_without_loops_and_with_couplings() -> None:
    assert equilibrium(velocity_equation(load("puma560"))) is None
    assert equilibrium(velocity_equation(load("schoenflies"))) is None


SIDE = 1.9
FEET = {"A": (0.0, 0.0), "B": (SIDE, 0.0), "C": (SIDE / 2, SIDE * math.sqrt(3) / 2)}


def leg_screws(foot: tuple[float, float], turn: float, lower: float, upper: float) -> np.ndarray:
    """The six joint screws (w; v) of a leg of the hybrid chain of section 5.1, from its drawing."""
    base = np.array([*foot, 0.0])
    out, level = np.array([math.cos(turn), math.sin(turn), 0]), np.array([-math.sin(turn), math.cos(turn), 0])
    up = np.array([0, 0, 1.0])
    knee = base + math.cos(lower) * out - math.sin(lower) * up
    end = knee + math.cos(upper) * out - math.sin(upper) * up
    lines = [(up, base), (level, base), (level, knee), *((axis, end) for axis in np.eye(3))]
    return np.array([np.concatenate([w, np.cross(p, w)]) for w, p in lines])


def iim_choices(angles: dict[str, tuple[float, float, float]]) -> int:
    """How many screws of B and C, reciprocal to their legs, have a sum reciprocal to A, section 5.3.2."""
    a, b, c = (leg_screws(FEET[leg], *angles[leg]) for leg in "ABC")
    zero = np.zeros((6, 6))
    demands = np.block([[b, zero], [zero, c], [a, a]])
    return 12 - int(np.linalg.matrix_rank(demands, tol=1e-9))


def rank_of_l(angles: dict[str, tuple[float, float, float]]) -> int:
    equation = velocity_equation(load("zlatanov-hybrid").with_parameters(a="19/10"))
    values = {}
    for leg, (turn, lower, upper) in angles.items():
        for name, angle in ((f"{leg}1", turn), (f"{leg}2", lower), (f"{leg}23", upper)):
            values |= {sympy.Symbol(f"c_{name}"): math.cos(angle), sympy.Symbol(f"s_{name}"): math.sin(angle)}
    numbers = np.array(equation.L.to_sympy().subs(values).evalf(), dtype=float)
    return int(np.linalg.matrix_rank(numbers, tol=1e-9))


def over_the_feet(turns: dict[str, float]) -> dict[str, tuple[float, float, float]]:
    """Each point over its foot, on the axis of the first joint, as in Fig. 6."""
    return {leg: (turn, -0.8, math.pi + 0.8) for leg, turn in turns.items()}


def shifted() -> dict[str, tuple[float, float, float]]:
    """Fig. 8: the legs stretched, of length 2, in one plane with both triangles: parallel to each other."""
    return dict.fromkeys(FEET, (0.4, 0.0, 0.0))


def turned() -> dict[str, tuple[float, float, float]]:
    """The legs stretched in the plane again, one triangle turned about the centre: the lines do not meet."""
    centre = np.mean(list(FEET.values()), axis=0)
    angle = 2 * math.asin(math.sqrt(3) / SIDE)
    rotation = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    found = {}
    for leg, foot in FEET.items():
        x, y = centre + rotation @ (np.array(foot) - centre) - np.array(foot)
        assert math.hypot(x, y) == pytest.approx(2)
        found[leg] = (math.atan2(y, x), 0.0, 0.0)
    return found


def concurrent() -> dict[str, tuple[float, float, float]]:
    """Fig. 6: the axes of the second joints meet in a point D of the base plane."""
    d = (0.3, 0.7)
    return over_the_feet({leg: math.atan2(-(d[0] - x), d[1] - y) for leg, (x, y) in FEET.items()})


@pytest.mark.parametrize(
    ("angles", "expected"),
    [
        (shifted(), 1),
        (concurrent(), 1),
        (over_the_feet({"A": 0.2, "B": 1.3, "C": 2.9}), 0),
        (turned(), 0),
    ],
    ids=["Fig. 8", "Fig. 6", "over the feet, axes not concurrent", "stretched, lines not concurrent"],
)
def test_iim_of_the_hybrid_chain_by_screws_from_the_drawing(
    angles: dict[str, tuple[float, float, float]], expected: int
) -> None:
    """Section 5.3.2, step 1: both figures are IIM; forces along stretched legs need lines that meet."""
    assert iim_choices(angles) == expected
    assert rank_of_l(angles) == 18 - expected


def test_words_name_each_joint_and_each_free_screw_once() -> None:
    equation = velocity_equation(load("ten-bar"))
    found = equilibrium(equation)
    assert found is not None
    listed = found.words.partition("follows: ")[2].split("; ")
    screws = [part.partition(" to ")[0] for part in listed]
    assert screws[: len(found.free)] == [f"w{i}" for i in range(1, len(found.free) + 1)]
    assert all(re.fullmatch(r"w\d( [+-] w\d)+", screw) for screw in screws[len(found.free) :])
    joints = [joint for part in listed for joint in part.partition(" to ")[2].split()]
    assert sorted(joints) == sorted(c.label for c in equation.columns if c.role != "output")


def test_loops_without_a_common_joint_bear_a_screw_each() -> None:
    """Two linkages side by side: L drops in rank where it does for one of them, so both are named."""
    found = equilibrium(velocity_equation(load("pair-10")))
    assert found is not None
    assert "w1 to A1 B1 C1 D1; w2 to A2 B2 C2 D2" in found.words


def test_of_a_joint_that_drives_in_part_only_the_passive_column_asks() -> None:
    """Four cylindric joints, the slide of one driven: for L_I its angle alone is among the joints."""
    found = equilibrium(velocity_equation(replace(load("rccc"), inputs=("B.slide",))), inputs=False)
    assert found is not None
    assert found.words == "a screw other than 0 is reciprocal to A B.angle C D"
