"""The gallery: every class somewhere, and each mechanism against an independent route.

The independent route: configurations sampled on the loops in floats with the singular values of L, and closed
forms where they are known.  Random mechanisms, against a numerical reference: `tests/laws`.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from math import acos, cos, sin, sqrt
from unittest.mock import ANY

import numpy as np
import pytest

from singsym.classes.classify import Limits, classify
from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import Defects, SingularityType, feasible_classes
from singsym.conditions.conditions import conditions
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import Mechanism, library, load
from singsym.polynomials.compiled_map import numerical_matrix

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

WITHOUT_IIM = {1: 5, 2: 5, 3: 4, 4: 5, 5: 4, 6: 4, 7: 3}
WITH_IIM = {9: 1, 13: 2, 15: 2, 16: 3, 17: 1, 21: 1}
TABLE_2 = WITHOUT_IIM | WITH_IIM
DIMENSIONS = {"zlatanov-hybrid-3-2": TABLE_2}
"""Row 7 of the published results: Table 2 of Zlatanov, Fenton, Benhabib (1998)."""

FOUND = library.occurring()
LONG = () if os.environ.get("SINGSYM_LONG") else ("zlatanov-hybrid-3-2", "3upu-tsai", "3rps")
LONG = ("zlatanov-hybrid", *LONG)
"""Too long for every run of the tests, where they are looked at within a small budget; all but the first with
SINGSYM_LONG=1."""
DECIDED = [name for name, found in FOUND.items() if found.complete and name not in LONG]
NOT_HERE = [name for name, found in FOUND.items() if name not in DECIDED]


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


def test_every_mechanism_says_which_classes_occur() -> None:
    assert sorted(FOUND) == list(library.names())


def test_every_class_has_its_mechanism() -> None:
    """The classes on file are those that the program finds: `test_the_gallery_is_decided`."""
    assert [c.name for c in feasible_classes()] == list(SMALLEST)
    sizes = {m.name: (m.n, m.N) for m in map(load, FOUND)}
    for c in feasible_classes():
        having = {name: sizes[name] for name, found in FOUND.items() if c.number in found.numbers}
        assert having[SMALLEST[c.name]] == min(having.values())


def test_the_smallest_mechanism_has_the_smallest_mobility_that_the_class_allows() -> None:
    """n = 1 for 9 classes, 2 for all others but two, which need 3."""
    for c in feasible_classes():
        smallest = next(n for n in (1, 2, 3) if c in feasible_classes(n))
        assert load(SMALLEST[c.name]).n == smallest


@pytest.mark.slow
@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.xdist_group(n)) for n in DECIDED])
def test_the_gallery_is_decided(
    classified: Classified, name: str, record_property: Callable[[str, object], None]
) -> None:
    """Every verdict is decided, and the classes are those on file, each with a certified configuration.

    Of large parallel robots a bound of a dimension may stay open; then it is said, and the dimension on file
    is reached by a certified point.  Singular values give the same types at the witnesses, and at random
    configurations types that were found.
    """
    result = classified(load(name))
    record_property("gallery", summary(result))
    assert not any(c.verdict.is_undecided for c in result.classes)
    assert not result.undecided or result.equation.n > 2
    found = [c for c in result.classes if c.verdict.is_yes]
    assert tuple(c.singularity_class.number for c in found) == FOUND[name].numbers
    assert all(c.verdict.certainty in ("proven", "certified") for c in found)
    assert {c.singularity_class.number: c.extent.at_least for c in found} == DIMENSIONS.get(name, ANY)
    if name in DIMENSIONS:
        assert all(c.verdict.certainty == "proven" for c in result.classes if c.verdict.is_no)
        assert not any("may be more" in c.verdict.reason for c in found)
    at_witness(result)
    declared = {c.types for c in found}
    for point in sample_configurations(result.equation.space, 40, seed=11, tries=120):
        # far away, where slides run to infinity, singular values say little
        defects = ranks(result.equation, point) if np.abs(point).max() < 20 else None
        assert defects is None or not defects.types or defects.types in declared


@pytest.mark.slow
@pytest.mark.parametrize("name", NOT_HERE)
def test_within_a_small_budget_nothing_contradicts_the_file(
    name: str, record_property: Callable[[str, object], None]
) -> None:
    """A mechanism whose classes are not all known, or take long: what is not found is left undecided."""
    result = classify(load(name), limits=Limits(seconds=3, total=6), cache=False)
    record_property("gallery", summary(result))
    assert result.undecided
    proven_empty = {c.singularity_class.number for c in result.classes if c.verdict.is_no}
    assert not proven_empty & set(FOUND[name].numbers)


def summary(result: Classification) -> list[str]:
    """A row of the table at the end of the run: see `tests/conftest.py`."""
    assert result.mechanism is not None
    numbers: dict[str, list[str]] = {"yes": [], "no": [], "undecided": []}
    for c in result.classes:
        numbers[str(c.verdict.answer)].append(str(c.singularity_class.number))
    answers = (" ".join(numbers["yes"]) or "none", " ".join(numbers["undecided"]))
    pieces = sum(len(c.pieces) for c in result.classes)
    sizes = (str(result.equation.N), str(result.equation.n), f"{result.seconds:.1f}")
    return [result.mechanism.name, *sizes, *answers, str(pieces), " ".join(result.engines)]


def at_witness(result: Classification) -> None:
    names = result.equation.space.ring.names
    for c in result.classes:
        assert len(c.witnesses) > 0 or not c.verdict.is_yes
        for w in c.witnesses:
            point = np.array([w.floats()[name] for name in names])
            defects = ranks(result.equation, point)
            assert defects is None or defects.types == c.types


# -- closed forms ------------------------------------------------------------------------------------------


def test_crank_and_slotted_lever_dead_centres(classified: Classified) -> None:
    """AB perpendicular to BD: the lever is tangent to the crank's circle, its length sqrt(g^2 - r^2)."""
    found = classified(load("crank-slotted-lever"))[SingularityType.RI | SingularityType.IO]
    assert [w.floats()["d_P"] for w in found.witnesses] == pytest.approx([sqrt(3)] * 2)


def test_whitworth_strokes(classified: Classified) -> None:
    """The ram stands still where D, E, F are in line, at EF + DE and EF - DE from D: 4 and 2."""
    found = classified(load("whitworth"))[SingularityType.RI | SingularityType.IO]
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


def test_linear_delta(classified: Classified) -> None:
    """Closed form: (RI, IO) iff a rod is horizontal, (RO, II) iff the rods' directions are coplanar.

    At each witness, and the right dimensions: surfaces that meet in curves.
    """
    result = classified(load("linear-delta"))
    T = SingularityType
    dimensions = {c.types: c.dimension for c in result.classes if c.verdict.is_yes}
    assert dimensions == {T.RI | T.IO: 2, T.RO | T.II: 2, T.RI | T.RO | T.II | T.IO: 1}
    for c in result.classes:
        for w in c.witnesses:
            at = {k: float(v) for k, v in w.points.items()}
            rods = np.array([[at[f"C{i}.{x}"] - at[f"B{i}.{x}"] for x in "xyz"] for i in (1, 2, 3)])
            assert np.linalg.norm(rods, axis=1) == pytest.approx([4, 4, 4])
            assert bool(np.abs(rods[:, 2]).min() < 1e-9) is (T.RI in c.types)
            assert bool(abs(np.linalg.det(rods)) < 1e-9) is (T.RO in c.types)


def test_spherical_5r(classified: Classified) -> None:
    """Closed form: (RO, II) iff det[B C D] = 0, (RI, IO) iff det[A C E] = 0, of the unit axes."""
    result = classified(load("spherical-5r"))
    T = SingularityType
    for kinds, axes in ((T.RO | T.II, "BCD"), (T.RI | T.IO, "ACE")):
        for w in result[kinds].witnesses:
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


def test_peaucellier() -> None:
    """D on the line x = (OA^2 - AC^2) / 4 = 21/4 for OQ = QC = 2; off the folded rhombus nothing is singular.

    OC runs from 3 (A on B, left out) over its largest value 4, where D's speed is that of the inversion.
    """
    equation = velocity_equation(load("peaucellier"))
    place = equation.space.points["D"]
    points = sample_configurations(equation.space, 5, seed=8)
    assert points
    for point in points:
        assert float(place[0].evaluate(list(point))) == pytest.approx(21 / 4, abs=1e-8)
        defects = ranks(equation, point)
        assert defects is None or not defects.types
    assert FOUND["peaucellier"].numbers == ()


def test_stephenson_output_rests_by_the_pole(classified: Classified) -> None:
    """E moves about the coupler's pole, where AB meets CD; G rests where EF passes it (Kennedy's theorem)."""
    found = classified(load("stephenson-six-bar"))[SingularityType.RI | SingularityType.IO]
    assert found.points == 6
    for w in found.witnesses:
        at = {p: np.array([float(w.points[f"{p}.x"]), float(w.points[f"{p}.y"]), 1.0]) for p in "ABCDEF"}
        pole = np.cross(np.cross(at["A"], at["B"]), np.cross(at["C"], at["D"]))
        lines = np.array([pole / np.linalg.norm(pole), at["E"], at["F"]])
        assert np.linalg.det(lines) == pytest.approx(0, abs=1e-9)
