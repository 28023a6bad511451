"""DH rows against products of homogeneous matrices, multiplied out in floats."""

import math
import random

import numpy as np
import pytest

from singsym.mechanism import MechanismError, define, load
from tests.mechanism import arms


def step(axis: str, angle: float = 0.0, length: float = 0.0) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, :3] = arms.turn(np.eye(3)["xyz".index(axis)], angle)
    matrix[:3, 3] = np.eye(3)["xyz".index(axis)] * length
    return matrix


ROWS = [
    {"joint": "R", "a": 1, "alpha": 90, "d": "1/2", "theta": 30},
    {"joint": "P", "a": "1/3", "alpha": "-60 deg", "d": 2, "theta": "pi/4"},
    {"joint": "R", "a": 0, "alpha": 45, "d": 1},
    {"joint": "P", "a": 1, "alpha": 90},
    {"joint": "R", "a": "3/2", "alpha": 0, "d": "-1/4", "theta": 120},
    {"joint": "R"},
]
NUMBERS = {"1/2": 0.5, "1/3": 1 / 3, "3/2": 1.5, "-1/4": -0.25, "-60 deg": -60, "pi/4": 45}


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_product_of_matrices(convention: str) -> None:
    mechanism = define(
        name="arm", space="spatial", dh={"convention": convention, "rows": ROWS, "tool": ["1/3", 1, 2]}
    )
    draw = random.Random(1)
    values = {f"J{i}": draw.uniform(-3, 3) for i in range(1, 7)}
    product = np.eye(4)
    for i, row in enumerate(ROWS, 1):
        a, alpha, d, theta = (
            float(NUMBERS.get(row.get(k, 0), row.get(k, 0))) for k in ("a", "alpha", "d", "theta")
        )
        alpha, theta, value = math.radians(alpha), math.radians(theta), values[f"J{i}"]
        if row["joint"] == "R":
            theta += value
        else:
            d += value
        first, second = step("z", theta, d), step("x", alpha, a)
        product = product @ (first @ second if convention == "standard" else second @ first)
    place, _ = arms.tool(mechanism, values)
    assert np.allclose(place, (product @ [1 / 3, 1, 2, 1])[:3])


def test_puma_at_rest() -> None:
    # All angles zero: z1 is -y, so d3 goes to -y; alpha3 = -90 turns z3 up again, so d4 goes up.
    place, _ = arms.tool(load("puma560"), {f"J{i}": 0.0 for i in range(1, 7)})
    assert np.allclose(place, [0.4318 + 0.0203, -0.15005, 0.4318])


def test_ur5_at_rest() -> None:
    # At zero the arm lies along -x, the flange d4 + d6 to the side (-y), d5 below the shoulder.
    place, _ = arms.tool(load("ur5"), {f"J{i}": 0.0 for i in range(1, 7)})
    assert np.allclose(place, [-0.425 - 0.39225, -0.10915 - 0.0823, 0.089159 - 0.09465])


def test_two_conventions_agree() -> None:
    # Moving alpha and a one row on turns a standard table into a modified one with the same joint axes.
    rows = [{"a": 1, "alpha": 90, "d": 2}, {"a": "1/2", "alpha": 30, "d": 1}, {"d": 3}]
    moved = [{"d": 2}, {"a": 1, "alpha": 90, "d": 1}, {"a": "1/2", "alpha": 30, "d": 3}]
    values = {"J1": 0.3, "J2": -1.1, "J3": 2.0}
    places = []
    for convention, table in (("standard", rows), ("modified", moved)):
        arm = define(
            space="spatial", output={"velocity": "tool"}, dh={"convention": convention, "rows": table}
        )
        places.append(arms.tool(arm, values)[0])
    assert np.allclose(*places)


def test_bad_rows() -> None:
    with pytest.raises(MechanismError, match="standard"):
        define(space="spatial", dh={"convention": "craig", "rows": ROWS})
    with pytest.raises(MechanismError, match="an angle such as"):
        define(space="spatial", dh={"rows": [{"alpha": "sqrt(2)"}]})
    with pytest.raises(MechanismError, match="no rows"):
        define(space="spatial", dh={"rows": []})
    with pytest.raises(MechanismError, match='"R" or "P"'):
        define(space="spatial", dh={"rows": [{"joint": "S"}]})


def test_bennett_closes() -> None:
    # Bennett: tan(A/2) tan(B/2) = sin((beta + alpha)/2) / sin((beta - alpha)/2), C = -A, D = -B.
    m = load("bennett").resolved
    alpha, beta = math.radians(40), math.radians(75)
    first = 0.7
    ratio = math.sin((beta + alpha) / 2) / math.sin((beta - alpha) / 2)
    second = 2 * math.atan(ratio / math.tan(first / 2))
    product = np.eye(4)
    for name, value in zip("ABCD", (first, second, -first, -second), strict=True):
        joint = m.joint(name)
        ends = []
        for link, point, axis, x in zip(
            (joint.first, joint.second), joint.at, joint.axes, joint.reference, strict=True
        ):
            body = m.link(link)
            z, u = arms.vector(body.axes[axis]), arms.vector(body.axes[x])
            end = np.eye(4)
            end[:3, :3] = np.column_stack([u, np.cross(z, u), z])
            end[:3, 3] = arms.vector(body.points[point])
            ends.append(end)
        product = product @ ends[0] @ step("z", value) @ np.linalg.inv(ends[1])
    assert np.allclose(product, np.eye(4))
