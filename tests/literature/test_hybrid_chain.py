"""Row 7 of the published results: the hybrid chain of Zlatanov, Fenton, Benhabib (1998), section 5, Table 2.

The independent route: configurations placed by the paper's geometry, or sampled where loci of
(4) and (5) meet, with the singular values of L.  Table 2 has 13 classes: here 1 to 7, 9, 13, 15, 16,
17 and 21.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from numpy.typing import NDArray

from singsym.classes.taxonomy.types import feasible_classes
from singsym.conditions.conditions import conditions
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import load
from singsym.polynomials.compiled_map import CompiledMap
from tests.literature.test_gallery import ranks

Vector = NDArray[np.float64]

SIDE = 1.5
UP = np.array([0.0, 0.0, 1.0])


@pytest.fixture(scope="module")
def chain() -> VelocityEquation:
    return velocity_equation(load("zlatanov-hybrid-3-2"))


def feet(equation: VelocityEquation) -> dict[str, Vector]:
    rest = np.zeros(len(equation.space.ring.names))
    rest[equation.space.ring.index("sqrt3")] = np.sqrt(3)
    places = {leg: equation.space.points[f"{leg}0"] for leg in "ABC"}
    return {leg: np.array([float(p.evaluate(list(rest))) for p in at]) for leg, at in places.items()}


def class_at(equation: VelocityEquation, at: dict[str, Vector], ways: dict[str, Vector] | None = None) -> int:
    """The number of the class where the platform's points are `at`; 0 where it is regular.

    ways: the horizontal direction in which a leg folds, where its point is above the foot.  A leg has two
    links of length 1 in the vertical plane of its direction.
    """
    found = {"sqrt3": np.sqrt(3)}
    for leg, foot in feet(equation).items():
        span = at[leg] - foot
        flat = np.array([*span[:2], 0.0])
        way = (ways or {}).get(leg, flat)
        way = way / np.linalg.norm(way)
        reach, height = float(span @ way), float(span[2])
        size = np.hypot(reach, height)
        assert np.allclose(span, reach * way + height * UP)
        middle, half = np.arctan2(height, reach), np.arccos(min(size / 2, 1.0))
        angles = {"1": np.arctan2(way[1], way[0]), "2": middle + half, "23": middle - half}
        for joint, angle in angles.items():
            found |= {f"c_{leg}{joint}": np.cos(angle), f"s_{leg}{joint}": np.sin(angle)}
    point = np.array([found[name] for name in equation.space.ring.names])
    closed = CompiledMap(equation.space.equations, equation.space.ring).values(point)
    assert np.abs(closed).max() < 1e-12
    defects = ranks(equation, point)
    assert defects is not None
    return number(defects.types)


def number(types: object) -> int:
    return next((c.number for c in feasible_classes() if c.types == types), 0)


def above(equation: VelocityEquation, height: float) -> dict[str, Vector]:
    return {leg: foot + height * UP for leg, foot in feet(equation).items()}


def across(direction: Vector) -> Vector:
    """The way in which a leg folds whose hinges have a horizontal direction."""
    return np.cross(direction, UP)


def turned(equation: VelocityEquation, pair: str, height: float, angle: float) -> dict[str, Vector]:
    """Two points at a height above their feet, the third turned about their line out of the horizontal."""
    at = above(equation, height)
    (third,) = set("ABC") - set(pair)
    p, q = (at[leg] for leg in pair)
    arm = at[third] - (p + q) / 2
    at[third] = (p + q) / 2 + np.cos(angle) * arm + np.sin(angle) * np.linalg.norm(arm) * UP
    return at


def along(equation: VelocityEquation, pair: str) -> dict[str, Vector]:
    """The two legs fold so that their hinges lie along the line of their feet, as in Fig. 7."""
    p, q = (feet(equation)[leg] for leg in pair)
    return dict.fromkeys(pair, across(q - p))


def aside(ways: dict[str, Vector], leg: str) -> dict[str, Vector]:
    """One leg folds in another direction, as in step 3.5."""
    return {**ways, leg: ways[leg] + np.array([0.2, 0.3, 0.0])}


def test_the_placement_is_the_mechanisms(chain: VelocityEquation) -> None:
    """Feet on an equilateral triangle; somewhere in its middle nothing is singular."""
    places = list(feet(chain).values())
    assert [np.linalg.norm(p - q) for p, q in combinations(places, 2)] == pytest.approx([SIDE] * 3)
    at = {leg: p + np.array([0.3, 0.2, 1.1]) for leg, p in feet(chain).items()}
    assert class_at(chain, at) == 0


@pytest.mark.parametrize("meeting", [(0.4, -0.3), (2.0, 1.0), (-1.0, 0.5)])
def test_fig_6_three_singular_subchains(chain: VelocityEquation, meeting: tuple[float, float]) -> None:
    """Step 3.3 c: all points above their feet, the hinges' lines through one point D: class 16."""
    D = np.array([*meeting, 0.0])
    ways = {leg: across(D - foot) for leg, foot in feet(chain).items()}
    assert class_at(chain, above(chain, 0.9), ways) == 16
    assert class_at(chain, above(chain, 0.9), aside(ways, "C")) == 5, "step 3.5"


@pytest.mark.parametrize(("pair", "expected"), [("BC", 15), ("AB", 13), ("AC", 13)])
def test_fig_7_two_singular_subchains(chain: VelocityEquation, pair: str, expected: int) -> None:
    """Steps 3.3 a and b: two points above their feet with hinges along their line, the platform turned."""
    assert class_at(chain, turned(chain, pair, 0.9, 0.3), along(chain, pair)) == expected


@pytest.mark.parametrize(("pair", "expected"), [("BC", 17), ("AC", 21)])
def test_the_platform_upright(chain: VelocityEquation, pair: str, expected: int) -> None:
    """Steps 3.3 d and e, Fig. 10 and the second set of Fig. 9: the platform's plane holds two feet."""
    assert class_at(chain, turned(chain, pair, 1.0, -np.pi / 2), along(chain, pair)) == expected


@pytest.mark.parametrize(("leg", "expected"), [("C", 4), ("B", 6)])
def test_fig_10_with_one_subchain_aside(chain: VelocityEquation, leg: str, expected: int) -> None:
    """Step 3.5 and the erratum on it: (RPM, RO, II, IO) where B is turned; where C is, (RPM, II, IO)."""
    at = turned(chain, "BC", 1.0, -np.pi / 2)
    assert class_at(chain, at, aside(along(chain, "BC"), leg)) == expected


def test_fig_9_all_six_types(chain: VelocityEquation) -> None:
    """Step 3.3 e: subchains A and B singular as in Fig. 7, and C0 in the plane of the platform."""
    height = 0.9
    slope = np.arctan2(-height, SIDE * np.sqrt(3) / 2)
    at, ways = turned(chain, "AB", height, slope), along(chain, "AB")
    assert class_at(chain, at, ways) == 21
    assert class_at(chain, at, aside(ways, "A")) == 7, "step 3.5; the erratum: it is A that is turned, not C"


@pytest.mark.parametrize("angle", [0.2, 1.0, 2.5])
def test_fig_8_three_stretched_subchains(chain: VelocityEquation, angle: float) -> None:
    """Step 3.4: the platform in the base plane, moved by two links' length in any direction: class 9."""
    moved = 2 * np.array([np.cos(angle), np.sin(angle), 0.0])
    assert class_at(chain, {leg: foot + moved for leg, foot in feet(chain).items()}) == 9


def sampled(equation: VelocityEquation) -> Iterator[int]:
    """Classes at random configurations where some, up to three, of the factors of (4) and (5) vanish."""
    found = conditions(equation)
    loci = list(dict.fromkeys(f.polynomial for label in ("4", "5") for f in found[label].factors))
    for count in range(4):
        for chosen in combinations(loci, count):
            space = replace(equation.space, equations=(*equation.space.equations, *chosen))
            for point in sample_configurations(space, 2, seed=count, tries=8):
                defects = ranks(equation, point)
                if defects is not None:
                    yield number(defects.types)


@pytest.mark.slow
def test_classes_without_iim(chain: VelocityEquation) -> None:
    """Steps 3.5 and 6: classes 1 to 7, and no other turns up where loci meet at random."""
    assert set(sampled(chain)) == {0, 1, 2, 3, 4, 5, 6, 7}
