"""Functions of arrays: against single configurations, geometry by hand, and mpmath."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.scaling import scaled_matrix
from singsym.mechanism import MechanismError, load
from singsym.motion.numeric import NumericLinkage, numeric

LINKAGES = ("zlatanov-2dof", "five-bar", "puma560", "spherical-fourbar", "slider-crank", "scara", "3rrr")


@pytest.mark.parametrize("name", LINKAGES)
def test_ranks_are_those_of_single_configurations(name: str) -> None:
    """Random configurations, and some near singular ones, where determinants do not settle the ranks."""
    linkage = numeric(load(name))
    q = linkage.sample(12, seed=3)
    q = np.concatenate([q, singular(linkage, q[:4])])
    found = linkage.ranks(q)
    for k, point in enumerate(q):
        parts = scaled_matrix(linkage.equation, point).submatrices()
        expected = {part: numerical_rank(m, 1e-8, size=1.0).rank for part, m in parts.items()}
        assert {part: int(ranks[k]) for part, ranks in found.items()} == expected


def singular(linkage: NumericLinkage, q: np.ndarray) -> np.ndarray:
    """Configurations where the first factor of (5) vanishes, by Newton's method."""
    from singsym.polynomials.compiled_map import CompiledMap
    from singsym.polynomials.gauss_newton import gauss_newton

    space = linkage.equation.space
    equations = (*space.equations, *space.ring.relations, linkage.factors("5")[0].polynomial)
    system = CompiledMap.balanced(equations, space.ring)
    found = [x for point in q if (x := gauss_newton(system, point)) is not None]
    return np.array(found).reshape(len(found), q.shape[1])


def test_singular_configurations_are_met_at_all() -> None:
    """Of the five-bar's first factor of (5) the rank of L_O is one short: the crank is in line."""
    linkage = numeric(load("five-bar"))
    q = singular(linkage, linkage.sample(6, seed=1))
    assert len(q)
    assert set(linkage.ranks(q)["L_O"].tolist()) == {4}
    assert set(linkage.ranks(q)["L_I"].tolist()) <= {4, 5}


def test_not_a_configuration_has_no_ranks() -> None:
    linkage = numeric(load("fourbar"))
    q = np.stack([linkage.sample(1)[0], np.full(4, np.nan)])
    assert linkage.ranks(q)["L_p"].tolist() == [3, -1]


def test_five_bars_assemblies_by_hand() -> None:
    """Cranks of 2 upright at x = 0 and 1, rods of 3: C at x = 1/2, sqrt(9 - 1/4) above or below y = 2.

    The link DE points from D to E, so that its crank is upright at E = -90 degrees.
    """
    linkage = numeric(load("five-bar"))
    q = linkage.configurations({"A": np.pi / 2, "E": -np.pi / 2})
    low, high = sorted(linkage.points(q)["C"].tolist(), key=lambda place: place[1])
    assert low == pytest.approx([0.5, 2 - 8.75**0.5])
    assert high == pytest.approx([0.5, 2 + 8.75**0.5])
    assert linkage.joints(q)["A"] == pytest.approx(np.full(2, np.pi / 2))


@pytest.mark.parametrize(
    "name", ["zlatanov-2dof", "five-bar", "puma560", "spherical-fourbar", "five-bar-coupled"]
)
def test_every_configuration_is_one_of_the_assemblies(name: str) -> None:
    linkage = numeric(load(name))
    q = linkage.sample(8, seed=2)
    joints = linkage.joints(q)
    found = linkage.configurations({label: joints[label] for label in linkage.inputs})
    assert np.nanmin(np.abs(found - q).max(axis=-1), axis=0) == pytest.approx(0, abs=1e-7)
    assert np.nanmax(np.abs(linkage.loops(found))) < 1e-9


def test_a_mode_is_kept_on_a_motion() -> None:
    """The sign of the dyad's determinant: C goes round without a jump where the crank turns, l1 + d < l2."""
    linkage = numeric(load("fourbar"))
    turn = np.linspace(-np.pi, np.pi, 2000)
    for mode in linkage.modes(["A"]):
        q = linkage.configurations({"A": turn}, mode)
        assert np.abs(np.diff(q, axis=0)).max() < 0.02


def test_values_of_points_determine_a_configuration_too() -> None:
    """Inverse kinematics of the five-bar: two elbows at each crank, four working modes."""
    linkage = numeric(load("five-bar"))
    q = linkage.sample(1, seed=5)
    place = linkage.points(q)["C"][0]
    found = linkage.configurations({"C.x": place[0], "C.y": place[1]})
    assert len(found) == 4
    assert np.nanmin(np.abs(found - q[0]).max(axis=-1)) < 1e-9


def test_newton_from_near_by_finds_what_has_no_closed_form() -> None:
    linkage = numeric(load("3rrr"))
    q = linkage.sample(3, seed=4)
    joints = linkage.joints(q)
    values = {label: joints[label] for label in linkage.inputs}
    assert linkage.near(values, q + 1e-3) == pytest.approx(q, abs=1e-9)
    with pytest.raises(MechanismError, match="C1x, C1y, c_platform, s_platform to be solved for at once"):
        linkage.configurations(values)


def test_high_precision_is_the_same_with_more_digits() -> None:
    linkage, precise = numeric(load("zlatanov-2dof")), numeric(load("zlatanov-2dof"), dps=50)
    mode = linkage.modes(linkage.inputs)[0]
    exact = precise.configurations({"A": "-2", "E": "-29/10"}, mode)
    rough = linkage.configurations({"A": -2.0, "E": -2.9}, mode)
    assert exact.astype(float) == pytest.approx(rough, abs=1e-14)
    assert max(map(abs, precise.loops(exact))) < mpmath.mpf(10) ** -48
    assert precise.ranks(exact) == linkage.ranks(rough)
    assert precise.condition("5", exact).astype(float) == pytest.approx(linkage.condition("5", rough))
    back = precise.near({"A": "-2", "E": "-29/10"}, rough)
    assert max(map(abs, back - exact)) < mpmath.mpf(10) ** -45


def test_matrices_are_the_polynomial_ones() -> None:
    linkage = numeric(load("slider-crank"))
    q = linkage.sample(2)
    for name in ("L", "L_I", "L_O", "L_p"):
        expected = [getattr(linkage.equation, name).evaluate(point.tolist()) for point in q]
        assert getattr(linkage, name)(q) == pytest.approx(np.array(expected, dtype=float))


def test_wrong_questions_say_what_is_right() -> None:
    linkage = numeric(load("five-bar"))
    with pytest.raises(ValueError, match=r"found an array \(3,\); expected \(\.\.\., 6\) of Bx"):
        linkage.ranks([1.0, 2.0, 3.0])
    with pytest.raises(MechanismError, match="found Z"):
        linkage.configurations({"Z": 0.0})
    with pytest.raises(MechanismError, match="values that determine"):
        linkage.configurations({"A": 0.0})
    with pytest.raises(MechanismError, match="one of"):
        linkage.configurations({"A": 0.0, "E": 0.0}, (1, 1, 1))
    with pytest.raises(MechanismError, match="no value of a"):
        numeric(load("zlatanov-hybrid"))
