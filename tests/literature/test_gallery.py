"""The gallery: every class somewhere, and each mechanism against an independent route.

The independent route: configurations sampled on the loops in floats with the singular values of L, and closed
forms where they are known.  Planar linkages by intersecting circles: `tests/laws`.
"""

from __future__ import annotations

from collections.abc import Callable
from math import acos, cos, sin, sqrt

import numpy as np
import pytest

from singsym.classes.result import Classification
from singsym.classes.types import Defects, SingularityType, feasible_classes
from singsym.elimination.conditions import conditions
from singsym.kinematics.sampling import numerical_matrix, sample_configurations
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import Mechanism, load
from singsym.mechanism.library import names

Classified = Callable[[Mechanism], Classification]

SMALLEST = {
    "RI, IO": "fourbar",
    "RO, II": "double-rocker",
    "RI, RO, II, IO": "five-bar",
    "RPM, II, IO": "double-rocker-pin",
    "RI, RPM, II, IO": "five-bar-coupled",
    "RO, RPM, II, IO": "pair-6",
    "RI, RO, RPM, II, IO": "pair-7",
    "RI, RO, IIM": "parallelogram",
    "RI, RO, IO, IIM": "pantograph",
    "RI, RO, II, IIM": "pair-10",
    "RI, RO, II, IO, IIM": "pair-11",
    "RPM, IIM": "parallelogram-height",
    "RI, RPM, IO, IIM": "parallelogram-advance",
    "RO, RPM, II, IIM": "scotch-yoke-parallelogram",
    "RPM, II, IO, IIM": "scotch-yoke-advance",
    "RI, RPM, II, IO, IIM": "pair-16",
    "RO, RPM, II, IO, IIM": "pair-17",
    "RI, RO, RPM, IIM": "sarrus",
    "RI, RO, RPM, IO, IIM": "pair-19",
    "RI, RO, RPM, II, IIM": "pair-20",
    "RI, RO, RPM, II, IO, IIM": "pair-21",
}
"""For each class the mechanism of the gallery with the smallest n, then the smallest N, that has it."""

QUICK = [
    "2r",
    "3prr",
    "3rpr",
    "3rrr",
    "stewart-gough-planar",
    "change-point",
    "crank-slotted-lever",
    "double-parallelogram",
    "double-rocker",
    "double-rocker-pin",
    "five-bar",
    "fourbar",
    "oldham",
    "parallelogram",
    "parallelogram-advance",
    "parallelogram-height",
    "pantograph",
    "scotch-yoke-advance",
    "scotch-yoke-parallelogram",
    "slider-crank",
    "cardan",
    "spherical-5r",
    "spherical-fourbar",
    "watt-six-bar",
    "stephenson-six-bar",
    "whitworth",
    "rssr",
    "rccc",
    "sarrus",
]


def ranks(equation: VelocityEquation, point: np.ndarray) -> Defects | None:
    """The defects at a configuration from singular values; None where a gap is not clear."""
    found = {}
    for name in ("L", "L_I", "L_O", "L_p"):
        matrix: np.ndarray = numerical_matrix(getattr(equation, name), point)
        values = np.linalg.svd(matrix, compute_uv=False) if matrix.size else np.zeros(0)
        scaled = values / max(1.0, values[0]) if len(values) else values
        if ((scaled > 1e-9) & (scaled < 1e-6)).any():
            return None
        found[f"rank_{name}"] = int((scaled >= 1e-6).sum())
    return Defects.of_ranks(**found, N=equation.N, n=equation.n)


def test_every_class_has_its_mechanism() -> None:
    assert [c.name for c in feasible_classes()] == list(SMALLEST)
    assert set(SMALLEST.values()) <= set(names())


def test_the_smallest_mechanism_has_the_smallest_mobility_that_the_class_allows() -> None:
    """n = 1 for 9 classes, 2 for all others but two, which need 3."""
    for c in feasible_classes():
        least = next(n for n in (1, 2, 3) if c in feasible_classes(n))
        assert load(SMALLEST[c.name]).n == least


@pytest.mark.slow
@pytest.mark.parametrize("name", list(SMALLEST))
def test_the_class_occurs(classified: Classified, name: str) -> None:
    """Found, with a certified witness at which singular values give the same types; nothing undecided."""
    result = classified(load(SMALLEST[name]))
    assert not result.undecided
    (found,) = (c for c in result.classes if c.singularity_class.name == name)
    assert found.verdict.is_yes
    assert found.verdict.certainty in ("proven", "certified")
    at_witness(result)


def at_witness(result: Classification) -> None:
    names_ = result.equation.space.ring.names
    for c in result.classes:
        assert len(c.witnesses) > 0 or not c.verdict.is_yes
        for w in c.witnesses:
            point = np.array([w.floats()[name] for name in names_])
            defects = ranks(result.equation, point)
            assert defects is None or defects.types == c.types


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_witnesses_and_samples(classified: Classified, name: str) -> None:
    """Singular values at all witnesses, and at random configurations, give classes that are declared."""
    result = classified(load(name))
    assert not result.undecided
    at_witness(result)
    declared = {c.types for c in result.classes if c.verdict.is_yes}
    for point in sample_configurations(result.equation.space, 40, seed=11, tries=120):
        # far away, where slides run to infinity, singular values say little
        defects = ranks(result.equation, point) if np.abs(point).max() < 20 else None
        assert defects is None or not defects.types or defects.types in declared


# -- closed forms ------------------------------------------------------------------------------------------


def test_crank_and_slotted_lever_dead_centres(classified: Classified) -> None:
    """AB perpendicular to BD: the lever is tangent to the crank's circle, its length sqrt(g^2 - r^2)."""
    found = classified(load("crank-slotted-lever")).of(SingularityType.RI | SingularityType.IO)
    assert [w.floats()["d_P"] for w in found.witnesses] == pytest.approx([sqrt(3)] * 2)


def test_whitworth_strokes(classified: Classified) -> None:
    """The ram stands still where D, E, F are in line, at EF + DE and EF - DE from D: 4 and 2."""
    found = classified(load("whitworth")).of(SingularityType.RI | SingularityType.IO)
    assert sorted(w.floats()["d_Q"] for w in found.witnesses) == pytest.approx([2, 4])


@pytest.mark.parametrize("name", ["oldham", "cardan"])
def test_couplings_have_no_singularity(classified: Classified, name: str) -> None:
    """Oldham: equal speeds.  Cardan: the ratio cos b / (1 - sin^2 b cos^2 a) has neither zero nor pole."""
    result = classified(load(name))
    assert not result.undecided
    assert all(c.verdict.is_no for c in result.classes)


def test_rssr_limits_by_its_closure(classified: Classified) -> None:
    """B = (cos a, sin a, 0), C = (2 + 2 cos d, 1, 2 sin d), BC = 3: d turns back where its
    derivative by a vanishes, counted on a fine grid of a, for both branches of d.
    """
    result = classified(load("rssr"))
    found = {c.types: c.points for c in result.classes if c.verdict.is_yes}
    assert found == {SingularityType.RI | SingularityType.IO: 2 * turning_points()}


def turning_points(size: int = 3600) -> int:
    """Sign changes of d' along one branch of the rocker: |B - C|^2 = 9 is linear in cos d."""
    rocker = []
    for i in range(size):
        a = 2 * acos(-1.0) * (i + 0.5) / size
        # (cos a - 2 - 2u)^2 + (sin a - 1)^2 + 4 (1 - u^2) = 9 in u = cos d
        p, q = cos(a) - 2, (sin(a) - 1) ** 2
        u = (p * p + q + 4 - 9) / (4 * p)
        assert abs(u) < 1
        rocker.append(acos(u))
    steps = np.sign(np.diff([*rocker, rocker[0]]))
    return int((steps != np.roll(steps, 1)).sum())


def test_rccc_by_transference(classified: Classified) -> None:
    """The axes' directions close a spherical four-bar: D stands still where a, b, c are coplanar, sin B = 0.

    There the angle ac is the sum or the difference of ab and bc; it must lie between those of ad, dc.
    """
    angles = {"ad": acos(4 / 5), "ab": acos(12 / 13), "bc": acos(3 / 5), "cd": acos(15 / 17)}
    reached = [
        ac
        for ac in (angles["ab"] + angles["bc"], abs(angles["ab"] - angles["bc"]))
        if abs(angles["ad"] - angles["cd"]) < ac < angles["ad"] + angles["cd"]
    ]
    result = classified(load("rccc"))
    found = {c.types: c.points for c in result.classes if c.verdict.is_yes}
    # each such triangle a, c, d comes with its mirror image
    assert found == {SingularityType.RI | SingularityType.IO: 2 * len(reached)}


def test_spherical_5r(classified: Classified) -> None:
    """Closed form: (RO, II) iff det[B C D] = 0, (RI, IO) iff det[A C E] = 0, of the unit axes."""
    result = classified(load("spherical-5r"))
    T = SingularityType
    for kinds, axes in ((T.RO | T.II, "BCD"), (T.RI | T.IO, "ACE")):
        for w in result.of(kinds).witnesses:
            q = w.floats()
            fixed = {"A": (0.0, 0.0, 1.0), "E": (1.0, 0.0, 0.0)}
            rows = [fixed.get(a) or [q[f"{a}{i}"] for i in "xyz"] for a in axes]
            assert np.linalg.det(np.array(rows)) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("name", ["schoenflies", "wrist-offset", "stanford", "7r-locked"])
def test_determinants_of_arms(name: str) -> None:
    """det L_O is a constant times the product of the factors' powers, compared with a numerical Jacobian."""
    forms: dict[str, Callable[[dict[str, float]], float]] = {
        "schoenflies": lambda q: q["s_B"],
        "wrist-offset": lambda q: q["c2"] * q["s3"] * (2 * q["c3"] + 1),
        "stanford": lambda q: q["d3"] ** 2 * q["s2"] * q["s5"],
        "7r-locked": lambda q: (
            q["c3"] * q["s5"] * (2 * q["c2"] + 1.5 * (q["s2"] * q["c3"] + q["c2"] * q["s3"]))
        ),
    }
    equation = velocity_equation(load(name))
    ratios = []
    for point in sample_configurations(equation.space, 6, seed=4):
        q = dict(zip(equation.space.ring.names, map(float, point), strict=True))
        det = np.linalg.det(numerical_matrix(equation.L_O, point))
        ratios.append(det / forms[name](q))
    assert np.abs(ratios) == pytest.approx([abs(ratios[0])] * len(ratios), rel=1e-6)
    assert abs(ratios[0]) > 1e-9


@pytest.mark.parametrize("name", ["schoenflies", "wrist-offset", "stanford"])
def test_serial_arms_have_one_class(classified: Classified, name: str) -> None:
    result = classified(load(name))
    assert not result.undecided
    n = result.equation.n
    assert {c.types: c.dimension for c in result.classes if c.verdict.is_yes} == {
        SingularityType.RI | SingularityType.IO: n - 1
    }


@pytest.mark.parametrize(
    ("name", "inputs", "outputs"),
    [
        ("watt-six-bar", {"B, C, D", "E, F, G"}, {"A, B, C", "D, E, F"}),
        ("double-rocker", {"B, C, D"}, {"A, B, C"}),
        ("pair-10", {"B1, C1, D1", "B2, C2, D2"}, {"A1, B1, C1", "A2, B2, C2"}),
    ],
)
def test_loci_are_pins_in_line(name: str, inputs: set[str], outputs: set[str]) -> None:
    """A crank stops, or a follower rests, exactly where three pins of its dyad are in line (textbook)."""
    found = conditions(velocity_equation(load(name)))
    for label, expected in (("4", inputs), ("5", outputs)):
        assert {f.words for f in found[label].factors} == {f"{pins} collinear" for pins in expected}


@pytest.mark.slow
def test_peaucellier(classified: Classified) -> None:
    """D on the line x = (OA^2 - AC^2) / 4 = 21/4 for OQ = QC = 2; off the folded rhombus nothing is singular.

    OC runs from 3 (A on B, left out) over its largest value 4, where D's speed is that of the inversion.
    """
    equation = velocity_equation(load("peaucellier"))
    place = equation.space.points["D"]
    for point in sample_configurations(equation.space, 5, seed=8):
        assert float(place[0].evaluate(list(point))) == pytest.approx(21 / 4, abs=1e-8)
        defects = ranks(equation, point)
        assert defects is None or not defects.types
    result = classified(load("peaucellier"))
    assert not result.undecided
    assert all(c.verdict.is_no for c in result.classes)


def test_stephenson_output_rests_by_the_pole(classified: Classified) -> None:
    """E moves about the coupler's pole, where AB meets CD; G rests where EF passes it (Kennedy's theorem)."""
    found = classified(load("stephenson-six-bar")).of(SingularityType.RI | SingularityType.IO)
    assert found.points == 6
    for w in found.witnesses:
        at = {p: np.array([float(w.points[f"{p}.x"]), float(w.points[f"{p}.y"]), 1.0]) for p in "ABCDEF"}
        pole = np.cross(np.cross(at["A"], at["B"]), np.cross(at["C"], at["D"]))
        lines = np.array([pole / np.linalg.norm(pole), at["E"], at["F"]])
        assert np.linalg.det(lines) == pytest.approx(0, abs=1e-9)
