"""L of known mechanisms, and what must not change its ranks."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.kinematics import (
    check_mobility,
    loop_closure,
    sample_configurations,
    velocity_equation,
)
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism import load
from singsym.mechanism.model import JointRate, Mechanism, PointVelocity, Twist
from singsym.polynomials.compiled_map import numerical_matrix
from tests.kinematics.linkages import crane


def ranks(equation: VelocityEquation, point: np.ndarray) -> list[int]:
    parts = (equation.L, equation.L_I, equation.L_O, equation.L_p)
    return [numerical_rank(numerical_matrix(part, point)).rank for part in parts]


def test_the_matrix_of_the_paper() -> None:
    """(6): two rows for the velocity of G, three for the loop A, B, C, D, three for D, E, F, G, C."""
    equation = velocity_equation(load("zlatanov-2dof"))
    assert equation.matrix.shape == (8, 10)
    assert (equation.N, equation.n) == (8, 2)
    assert [c.role for c in equation.columns].count("input") == 2
    pattern = {
        c.label[0] if c.role != "output" else c.label: [
            any(equation.matrix[i, j] for i in block) for block in ((0, 1), (2, 3, 4), (5, 6, 7))
        ]
        for j, c in enumerate(equation.columns)
        if not c.label.startswith("C")
    }
    outputs = [c.label for c in equation.columns if c.role == "output"]
    assert all(pattern[label] == [True, False, False] for label in outputs)
    assert pattern["A"] == pattern["B"] == [False, True, False]
    assert pattern["D"] == [False, True, True]
    assert pattern["G"] in ([False, False, True], [True, False, True])
    assert pattern["E"] == pattern["F"] == [True, False, True]
    at_c = [j for j, c in enumerate(equation.columns) if c.label.startswith("C")]
    assert sorted([bool(equation.matrix[2, j]), bool(equation.matrix[5, j])] for j in at_c) == [
        [False, True],
        [True, False],
    ]
    one, y, x = (
        equation.matrix[i, next(j for j, c in enumerate(equation.columns) if c.label == "B")]
        for i in (2, 3, 4)
    )
    sign = one.constant
    by, bx = equation.space.points["B"][1], equation.space.points["B"][0]
    assert (y * sign, x * sign) == (by, -bx)


def test_the_hybrid_chain_is_18_by_24() -> None:
    equation = velocity_equation(load("zlatanov-hybrid"))
    assert equation.matrix.shape == (18, 24)
    assert (equation.L_I.shape, equation.L_O.shape, equation.L_p.shape) == ((18, 18), (18, 18), (18, 12))


@given(st.permutations(range(8)), st.lists(st.booleans(), min_size=8, max_size=8), st.integers(0, 50))
@settings(max_examples=15, deadline=None)
def test_order_and_sense_of_joints_do_not_change_ranks(
    order: list[int], turned: list[bool], seed: int
) -> None:
    """At random configurations and at points made singular: E, F, G in line."""
    original = load("zlatanov-2dof")
    joints = []
    for i in order:
        joint = original.joints[i]
        if turned[i]:
            joint = replace(joint, first=joint.second, second=joint.first, at=(joint.at[1], joint.at[0]))
        joints.append(joint)
    before = velocity_equation(original)
    after = velocity_equation(replace(original, joints=tuple(joints)))
    p = before.space.points
    E, F, G = (p[name] for name in "EFG")
    line = (F[0] - E[0]) * (G[1] - E[1]) - (F[1] - E[1]) * (G[0] - E[0])
    special = replace(before.space, equations=(*before.space.equations, line))
    for space in (before.space, special):
        (point,) = sample_configurations(space, 1, seed)
        there = np.array([point[before.space.ring.index(name)] for name in after.space.ring.names])
        assert ranks(before, point) == ranks(after, there)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("fourbar", [4, 4, 4, 3]),
        ("five-bar", [5, 5, 5, 3]),
        ("3rrr", [9, 9, 9, 6]),
        ("zlatanov-2dof", [8, 8, 8, 6]),
    ],
)
def test_generic_ranks(name: str, expected: list[int]) -> None:
    found = check_mobility(velocity_equation(load(name)))
    assert list(found.ranks.values()) == expected
    assert found.regular == found.samples == 12
    assert not found.messages


def test_a_stretched_fourbar_loses_the_ranks_it_must() -> None:
    """(g,a,b,c) = (4,1,3.5,3): crank and coupler in line, follower at rest, class (RI, IO)."""
    equation = velocity_equation(load("fourbar"))
    p = equation.space.points
    A, B, C = p["A"], p["B"], p["C"]
    line = (B[0] - A[0]) * (C[1] - A[1]) - (B[1] - A[1]) * (C[0] - A[0])
    dead = replace(equation.space, equations=(*equation.space.equations, line))
    points = sample_configurations(dead, 8, 1)
    found = {tuple(ranks(equation, point)) for point in points}
    assert found == {(4, 4, 3, 3)}


def output_of(mechanism: Mechanism, *outputs: object) -> VelocityEquation:
    return velocity_equation(replace(mechanism, outputs=outputs))  # type: ignore[arg-type]


def test_every_kind_of_output_moves_as_it_says() -> None:
    """T = J * rates of an open chain against differences of its hook's place and of its angles."""
    mechanism = crane()
    twist = output_of(mechanism, Twist("telescope", "hook", ("w", "vx", "vy")))
    point = output_of(mechanism, PointVelocity("telescope", "hook", ("x", "y")), JointRate("A"))
    space = twist.space
    (q,) = sample_configurations(space, 1, 5)
    names, h = space.ring.names, 1e-6
    hook = velocity_place(mechanism)
    index = {name: i for i, name in enumerate(names)}
    for joint, direction in (("X", {"d_X": 1.0}), ("A", None), ("T", {"d_T": 1.0})):
        step = np.zeros(len(names))
        c, s = (index[n] for n in names if n[:2] in ("c_", "s_"))
        if direction is None:
            step[c], step[s] = -q[s], q[c]
        for name, value in (direction or {}).items():
            step[index[name]] = value
        moved = [
            (float(x.evaluate(list(q + h * step))) - float(x.evaluate(list(q - h * step)))) / (2 * h)
            for x in hook
        ]
        column = {c.label: j for j, c in enumerate(twist.columns)}[joint]
        entries = [-float(twist.matrix[i, column].evaluate(list(q))) for i in range(3)]
        assert entries == pytest.approx([1.0 if joint == "A" else 0.0, *moved], abs=1e-7)
        entries = [-float(point.matrix[i, column].evaluate(list(q))) for i in range(3)]
        assert entries == pytest.approx([*moved, 1.0 if joint == "A" else 0.0], abs=1e-7)


def velocity_place(mechanism: Mechanism) -> tuple[object, ...]:
    from singsym.kinematics import place

    return place(mechanism).link_points["telescope", "hook"]


def test_wrong_inputs_outputs_and_mobility_are_told() -> None:
    five = load("five-bar")
    passive = [c for c in five.columns if c not in five.inputs]
    one = check_mobility(velocity_equation(replace(five, inputs=(five.inputs[0],))))
    assert any("1 inputs, expected" in m or "outputs, expected" in m for m in one.messages)
    three = replace(five, mobility=3)
    assert any("only 2 independent motions" in m for m in check_mobility(velocity_equation(three)).messages)
    doubled = output_of(five, JointRate(passive[0]), JointRate(passive[0]))
    assert any("cannot be the outputs" in m for m in check_mobility(doubled).messages)
    rates = output_of(crane(), JointRate("X"), JointRate("X"), JointRate("T"))
    assert any("cannot be the outputs" in m for m in check_mobility(rates).messages)


def test_equations_are_pickled() -> None:
    equation = velocity_equation(load("five-bar"))
    assert pickle.loads(pickle.dumps(equation)) == equation
    assert loop_closure(load("five-bar")) == equation.space
