"""Reflections: what they keep, and that searching one part of each orbit loses nothing."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from singsym.classes import classify as module
from singsym.classes.classify import classify
from singsym.classes.strata.reflections import IDENTITY, compose, image, reflections, representatives
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.polynomials import Ring
from singsym.polynomials.compiled_map import numerical_matrix
from singsym.varieties.real.points.boxed_point import boxed_point
from singsym.varieties.real.points.certified_point import frozen_points
from singsym.varieties.real.system import RealSystem


@pytest.mark.parametrize("name", ["fourbar", "rssr", "zlatanov-hybrid-3-2"])
def test_ranks_stay_at_reflected_configurations(name: str) -> None:
    """Singular values of L at numerical configurations and at their images."""
    equation = velocity_equation(load(name))
    space = equation.space
    feasible = RealSystem(space.ring, (), space.exclusions, space.positive, space.nonnegative)
    group = reflections(feasible, space.equations, (equation.L,))
    assert group[0] == IDENTITY
    assert len(group) > 1
    for point in sample_configurations(space, 2, seed=3):
        here = np.linalg.svd(numerical_matrix(equation.L, point), compute_uv=False)
        for reflection in group:
            there = [-x if n in reflection else x for n, x in zip(space.ring.names, point, strict=True)]
            assert max(abs(float(e.evaluate(there))) for e in space.equations) < 1e-8
            assert np.linalg.svd(
                numerical_matrix(equation.L, np.array(there)), compute_uv=False
            ) == pytest.approx(here)


def test_a_leg_of_the_hybrid_chain_turns_half_and_bends_the_other_way() -> None:
    """By geometry: about its vertical foot axis, with both link angles taken to their supplements."""
    equation = velocity_equation(load("zlatanov-hybrid-3-2"))
    space = equation.space
    found = reflections(RealSystem(space.ring, (), space.exclusions), space.equations, (equation.L,))
    assert {("c_A1", "c_A2", "c_A23", "s_A1"), ("s_A2", "s_A23", "s_B2", "s_B23", "s_C2", "s_C23")} <= set(
        found
    )


def test_reflections_to_the_members_of_an_orbit_are_closed() -> None:
    """Of the four corners of a square, by a group of eight of which x and (y, z) lead to all."""
    x, y, z = Ring(("x", "y", "z")).gens
    corners = [(x - a, y - b, z**2 - 2) for a in (1, -1) for b in (1, -1)]
    group = [(), ("x",), ("y", "z"), ("x", "y", "z"), ("x", "z"), ("z",), ("x", "y"), ("y",)]
    ((place, images),) = representatives(corners, group)
    assert place == 0
    assert len(images) == len(corners)
    assert {compose(one, two) for one in images for two in images} == set(images)
    # the only corner that is not there has images that are not: what leads to it is not used
    assert [len(images) for _, images in representatives(corners[:3], group)] == [1, 1, 1]


@pytest.mark.parametrize("name", ["five-bar-coupled", "pair-19", "parallelogram"])
def test_the_same_classes_without_reflections(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def summary() -> list[tuple[object, ...]]:
        found = classify(load(name), cache=False)
        return [
            (c.singularity_class.number, str(c.verdict.answer), c.dimension, c.points) for c in found.classes
        ]

    expected = summary()
    monkeypatch.setattr(module, "reflections", lambda *_: (IDENTITY,))
    assert summary() == expected


def test_points_are_reflected_with_their_equations() -> None:
    ring = Ring(("x", "y"))
    x, y = ring.gens
    equations = (x**2 + y**2 - 2, x - y**3)
    for point in (*frozen_points(ring, equations, {}).value, boxed_point(ring, equations, {}, (1.0, 1.0))):
        assert point is not None
        turned = point.reflect(["x"])
        assert turned.floats == (-point.floats[0], point.floats[1])
        assert [turned.sign(p) for p in image(equations, ("x",))] == [0, 0]
    assert frozen_points(ring, equations, {"x": Fraction(1)}).value[0].reflect(["y"]).sign(y + 1) == 0
