"""Regions and free boxes against counts and bounds worked out by hand."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace
from itertools import product

import networkx as nx
import numpy as np
import pytest
import sympy

from singsym.classes.configuration.at import at
from singsym.effort import patience
from singsym.effort.budget import Budget, Undecided
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Limit, load, loads
from singsym.mechanism.problems import MechanismError
from singsym.motion.numeric import numeric
from singsym.motion.regions import chart
from singsym.motion.regions.borders import borders, input_space
from singsym.motion.regions.free_box import free_box
from singsym.motion.regions.free_motion import FreeMotions
from singsym.motion.regions.regions import regions
from singsym.motion.regions.result import Region
from singsym.motion.regions.slices import Slices
from singsym.output.motion.regions_page import regions_page

FOUR_BAR = """
name = "bar"
inputs = ["A"]
output = {{ rate = "D" }}

[links]
ground = {{ points = {{ A = [0, 0], D = [{0}, 0] }} }}
AB = {1}
BC = {2}
CD = {3}

[joints]
A = "R"
B = "R"
C = "R"
D = "R"
"""


@pytest.mark.parametrize(
    ("lengths", "count"),
    [
        # a crank that turns round and a rocker: 4 dead centres (RI, IO) on two circuits, so 4 arcs
        (("4", "1", "7/2", "3"), 4),
        # a drag link: nothing is singular, both circuits are whole
        (("1", "3", "7/2", "4"), 2),
        # Grashof's condition fails: one circuit, cut at 2 + 2 points
        (("2", "2", "2", "5"), 4),
    ],
)
def test_arcs_of_four_bars(lengths: tuple[str, ...], count: int) -> None:
    """The singular points of row 1 of the literature list, and circuits by Grashof's rule, cut into arcs."""
    quoted = [f'"{length}"' for length in lengths]
    found = regions(loads(FOUR_BAR.format(*quoted)))
    assert found.verdict.is_yes
    assert found.verdict.certainty == "certified"
    assert len(found.regions) == found.at_least == count


def test_a_limit_is_a_barrier_and_no_singularity() -> None:
    """A slide that may not be behind the crank's pivot has one working side: two arcs, up and down; where the
    length must be 3 or less each is cut short at the limit."""
    limited = regions(load("slider-crank"))
    assert len(limited.regions) == 2
    limit = Limit(sympy.Symbol("length(P)"), low=sympy.Integer(0), high=sympy.Integer(3))
    found = regions(replace(load("slider-crank"), limits=(limit,)))
    assert len(found.regions) == 2
    for region in found.regions:
        assert [b.is_singular for b in region.ends] == [True, False]
        assert "d_P" in region.ends[1].words
        # at the limit (3 - cos A)^2 + sin^2 A = 9, so cos A = 1/6
        angles = np.abs(np.arctan2(region.points[:, 1], region.points[:, 0]))
        assert angles.min() == pytest.approx(math.acos(1 / 6), abs=1e-6)
    assert any("barriers" in block for block in regions_page("s", found) if isinstance(block, str))


def test_a_slide_that_keeps_its_length_positive_has_arcs() -> None:
    """From AC = 3, where cos A = 1/6, to the dead point AC = 4, with the crank up or down."""
    limit = Limit(sympy.Symbol("length(P)"), low=sympy.Integer(3))
    found = regions(replace(load("slider-crank"), limits=(limit,)))
    assert found.verdict.is_yes
    assert len(found.regions) == 2
    for region in found.regions:
        assert [b.is_singular for b in region.ends] == [True, False]
        angles = np.abs(np.arctan2(region.points[:, 1], region.points[:, 0]))
        assert angles.max() == pytest.approx(math.acos(1 / 6), abs=1e-6)


def test_the_arm_of_two_links_has_two_regions() -> None:
    """The determinant is a multiple of sin B: the halves B > 0 and B < 0 of the torus."""
    found = regions(load("2r"), grid=24)
    assert len(found.regions) == found.at_least == 2
    assert found.apart(0, 1).is_yes
    assert found.verdict.is_yes
    assert found.assemblies is not None
    assert (found.assemblies == 1).all()
    for region in found.regions:
        angles = found.axes[1][region.cells[:, 1]]
        assert (np.sign(angles) == np.sign(region.joints["B"])).all()
        assert len(region.cells) == 24 * 12


def _parts_of_the_five_bar(count: int) -> list[tuple[tuple[int, int, int], np.ndarray]]:
    """The signs and the cells of each part of a grid over A and E: cranks of 2, rods of 3, base 1.

    BD < 6, so C is on either side of BD, and on one within a region; ABC and CDE turn left or right.
    """
    turns = -math.pi + (np.arange(count) + 0.5) * 2 * math.pi / count
    a, e = np.meshgrid(turns, turns, indexing="ij")
    b = 2 * np.array([np.cos(a), np.sin(a)])
    d = np.array([1.0, 0.0])[:, None, None] - 2 * np.array([np.cos(e), np.sin(e)])
    middle, gap = (b + d) / 2, d - b
    half = np.hypot(*gap) / 2
    across = np.array([-gap[1], gap[0]]) / (2 * half) * np.sqrt(9 - half**2)
    parts = []
    for side in (1, -1):
        c = middle + side * across
        one = np.sign(b[0] * c[1] - b[1] * c[0])
        two = np.sign((c - d)[0] * d[1] - (c - d)[1] * (d[0] - 1))
        for s, t in product((1, -1), repeat=2):
            cells = np.argwhere((one == s) & (two == t))
            inside = {*map(tuple, cells.tolist())}
            steps = nx.Graph()
            steps.add_nodes_from(inside)
            for i, j in inside:
                ahead = (((i + 1) % count, j), (i, (j + 1) % count))
                steps.add_edges_from(((i, j), k) for k in ahead if k in inside)
            parts += [((side, s, t), turns[np.array([*g])]) for g in nx.connected_components(steps)]
    return parts


def test_the_five_bar_has_ten_regions() -> None:
    """B, C, D are in line only where B is on D.  Each of the 2 x 2 x 2 signs is met, two of them in two
    regions: beside B = D there is a small one, of which this grid shows nothing.

    So many parts has a grid that is fine enough, worked out here.
    """
    mechanism = load("five-bar")
    found = regions(mechanism, grid=24)
    assert found.verdict.is_yes
    assert found.verdict.certainty == "certified"
    assert {r.signs for r in found.regions} == set(product((1, -1), repeat=3))
    parts = _parts_of_the_five_bar(720)
    assert len(found.regions) == found.at_least == len(parts) == 10
    alike = Counter(signs for signs, _ in parts)
    assert sorted(Counter(r.signs for r in found.regions).values()) == sorted(alike.values())
    # cells on borders may be missed
    counts = Counter[tuple[int, ...]]()
    for r in found.regions:
        counts[r.signs] += len(r.cells)
    coarse = Counter[tuple[int, ...]]()
    for signs, cells in _parts_of_the_five_bar(24):
        coarse[signs] += len(cells)
    assert np.abs(np.array(sorted(counts.values())) - sorted(coarse.values())).max() <= 3
    # the lemma: each part is over one of the values at which slices are taken
    motions = FreeMotions(borders(velocity_equation(mechanism)), input_space(velocity_equation(mechanism)))
    held = [s.value for s in Slices(motions.borders, motions.space, 0).slices]
    for _, cells in parts:
        assert min(abs(a - x) for a in cells[:, 0] for x in held) < 2 * math.pi / 720


TWO_LEGS = """
name = "legs"
inputs = ["P", "Q"]
output = { velocity = "C" }

[links]
ground = { points = { A = [0, 0], D = [2, 0] } }
cylinder1 = { points = { A = [0, 0] }, axes = { u = [1, 0] } }
rod1 = { points = { C = [0, 0] }, axes = { u = [1, 0] } }
cylinder2 = { points = { D = [0, 0] }, axes = { w = [1, 0] } }
rod2 = { points = { C = [0, 0] }, axes = { w = [1, 0] } }

[joints]
A = "R"
P = { type = "P", links = ["cylinder1", "rod1"], at = ["A", "C"], axis = "u" }
D = "R"
Q = { type = "P", links = ["cylinder2", "rod2"], at = ["D", "C"], axis = "w" }
C = "R"

[limits]
"length(P)" = { min = 1, max = 3 }
"length(Q)" = { min = 1, max = 3 }
"""


def test_two_legs_within_limits_have_two_regions() -> None:
    """C is in both rings of 1 to 3 about A and D, off the line AD: above it and below are two parts.

    C has no equations; that the legs are bounded by their limits alone is used.
    """
    found = regions(loads(TWO_LEGS), grid=16)
    assert found.verdict.is_yes
    assert len(found.regions) == found.at_least == 2
    assert {np.sign(r.values["Cy"]) for r in found.regions} == {1, -1}


def test_arcs_that_are_not_joined_leave_open_whether_regions_are_all(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(FreeMotions, "joins", lambda *_: 0)
    found = regions(load("spherical-5r"), grid=24)
    assert found.verdict.is_undecided
    assert "not proven" in found.verdict.reason


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        # P moves one dyad alone: its borders are there for all values of A1
        ("pair-20", "along a curve"),
        ("pantograph", "bounded"),
    ],
)
def test_slices_are_not_taken_where_their_lemma_does_not_hold(name: str, reason: str) -> None:
    equation = velocity_equation(load(name))
    with pytest.raises(Undecided, match=reason):
        _ = Slices(borders(equation), input_space(equation), 0).slices


def test_regions_with_the_same_signs_are_apart_by_a_plane() -> None:
    """Two spherical cranks and two rods: a plane holds one crank at a value of a coordinate.

    The configurations on such a plane are worked out in closed form here: none has the signs of both.
    """
    mechanism = load("spherical-5r")
    found = regions(mechanism, grid=24)
    assert len(found.regions) == found.at_least == 6
    assert len({r.signs for r in found.regions}) == 4
    assert found.verdict.is_yes
    linkage = numeric(mechanism)

    def signs(q: np.ndarray) -> tuple[int, ...]:
        return tuple(int(np.sign(x)) for label in ("4", "5") for x in linkage.condition(label, q))

    assert all(signs(np.array([*r.values.values()])) == r.signs for r in found.regions)
    for plane, sides in found.walls:
        one, other = sides.index(1), sides.index(-1)
        assert found.apart(one, other).is_yes
        assert found.regions[one].signs == found.regions[other].signs == plane.signs
        (name,) = plane.polynomial.variables
        # B and D are unit vectors at 60 degrees from the axes z and x, C is perpendicular to both
        places = ["Bx", "By", "Dy", "Dz"]
        held = places.index(name)
        ratio = float(plane.polynomial.substitute(dict.fromkeys(places, 0)).constant) / -(3**0.5 / 2)
        for angle, side, way in product(np.linspace(-math.pi, math.pi, 101), (1, -1), (1, -1)):
            turned = [(math.cos(angle), math.sin(angle))] * 2
            turned[held // 2] = (ratio, side * math.sqrt(1 - ratio**2))[:: 1 - 2 * (held % 2)]
            one, two = (np.array(t) * 3**0.5 / 2 for t in turned)
            b, d = np.array([*one, 0.5]), np.array([0.5, *two])
            c = way * np.cross(b, d) / np.linalg.norm(np.cross(b, d))
            q = np.concatenate([b, d, c, [3**0.5]])
            assert signs(q) != plane.signs


def test_larger_mobilities_are_refused_with_what_there_is_for_them() -> None:
    with pytest.raises(MechanismError, match="free box"):
        regions(load("3rpr"))


def test_all_walls_together_end_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pairs of regions with the same signs grow with the square of their number; each may take long."""
    looked: list[object] = []

    def wall(*own: object) -> None:
        looked.append(own)

    monkeypatch.setattr(chart, "wall", wall)
    alike = tuple(Region({}, {}, (1,), (), np.zeros((1, 2)), np.zeros((1, 2), dtype=int)) for _ in range(4))
    motions = FreeMotions.__new__(FreeMotions)
    assert chart._walls(motions, alike) == ()
    assert len(looked) == 6
    with Budget(work=0.0):
        assert chart._walls(motions, alike) == ()
    assert len(looked) == 6


# -- free boxes --------------------------------------------------------------------------------------


def test_a_free_box_of_the_slider_crank_ends_before_its_dead_points() -> None:
    """These are at 0 and 180 degrees."""
    crank = at(load("slider-crank"), {"joints": {"A": "60 deg", "P": "(1 + sqrt(33)) / 2"}})
    low, high = free_box(crank).inputs["A"]
    assert 0 < low < 0.1
    assert 3.0 < high < math.pi
    fewer = free_box(crank, tests=20)
    assert low <= fewer.inputs["A"][0] < 1 < fewer.inputs["A"][1] <= high


def test_no_sample_in_a_free_box_of_a_platform_is_singular() -> None:
    """Six legs: configurations over random lengths inside have determinants of the legs' lines, worked out
    here, of one sign.  The box reaches a fifth of the way to a singular configuration that a search by
    Lagrange's equations found as the nearest, and that is checked here."""
    platform = load("stewart-gough")
    linkage = numeric(platform)
    heights = {"B1": ["3/5", 1, "21/5"], "B2": ["8/3", 1, 4], "B3": ["17/5", 1, "17/3"]}
    centre = at(platform, {"points": heights})
    found = free_box(centre, tests=280)
    ends = np.array([found.inputs[label] for label in linkage.inputs])
    random = np.random.default_rng(1)
    lengths = random.uniform(ends[:, 0], ends[:, 1], (200, 6))
    start = np.tile([float(centre.values[name]) for name in linkage.names], (200, 1))
    q = linkage.near(dict(zip(linkage.inputs, lengths.T, strict=True)), start)
    assert np.isfinite(q).all()
    places = linkage.points(q)
    values = determinant_of_lines(places)
    assert (np.sign(values) == np.sign(values[0])).all()
    near = [0.42399467, 0.99460559, 4.24311599, 2.34502759, 0.39488728, 3.68536909, 3.33306714]
    singular = linkage.points(np.array([*near, 0.23249397, 5.2211156]))
    assert abs(determinant_of_lines(singular)) < 1e-6 * abs(values[0])
    legs = [np.linalg.norm(singular[f"B{k}"] - singular[f"A{k}"]) for k in range(1, 7)]
    away = np.linalg.norm(np.array(legs) - [centre.joints[label] for label in linkage.inputs])
    assert found.clear * found.length > 0.2 * away
    for name, (low, high) in found.variables.items():
        k = linkage.names.index(name)
        assert ((low <= q[:, k]) & (q[:, k] <= high)).all()


def determinant_of_lines(places: dict[str, np.ndarray]) -> np.ndarray:
    """Of the six legs' lines, in Pluecker's coordinates."""
    lines = []
    for k in range(1, 7):
        base, top = places[f"A{k}"], places[f"B{k}"]
        lines.append(np.concatenate([top - base, np.cross(base, top - base)], axis=-1))
    return np.linalg.det(np.stack(lines, axis=-2))


def test_a_free_box_has_what_was_proven_in_time() -> None:
    """Tests of boxes take longer in larger mechanisms: they end with the work that there is for them, too."""
    crank = at(load("slider-crank"), {"joints": {"A": "60 deg", "P": "(1 + sqrt(33)) / 2"}})
    with patience.scaled(0.0), pytest.raises(MechanismError, match="no box was proven to be free in 0 tests"):
        free_box(crank)


def test_no_box_around_a_singular_configuration() -> None:
    with pytest.raises(MechanismError, match="on a border"):
        free_box(at(load("2r"), {"joints": {"A": 0, "B": 0}}))
