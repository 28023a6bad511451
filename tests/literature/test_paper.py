"""Row 6 of the published results: the linkage of Zlatanov, Fenton, Benhabib (1998), section 3.3."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable
from fractions import Fraction

from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType
from singsym.elimination.ideal import Ideal
from singsym.mechanism import Mechanism, load
from singsym.output.sheet.steps import steps_latex

Classified = Callable[[Mechanism], Classification]
T = SingularityType


def test_classes(classified: Classified) -> None:
    """Section 3.3, Step 6, and the erratum on it: 8 points with RPM, 12 (not 8) points of two curves."""
    result = classified(load("zlatanov-2dof"))
    assert not result.undecided
    found = {c.types: (c.dimension, c.points) for c in result.classes if c.verdict.is_yes}
    assert found == {
        T.RI | T.IO: (1, None),
        T.RO | T.II: (1, None),
        T.RI | T.RO | T.II | T.IO: (0, 12),
        T.RPM | T.II | T.IO: (0, 8),
    }


def test_no_increased_mobility(classified: Classified) -> None:
    """Section 3.3, Step 1: "there are no IIM-type configurations"; so the configuration space is smooth."""
    result = classified(load("zlatanov-2dof"))
    assert all(c.verdict.is_no for c in result.classes if T.IIM in c.types)
    assert [space.smooth for space in result.configuration_space] == ["yes"]


def test_the_steps_as_section_3_3_tells_them(classified: Classified) -> None:
    """Step 1 finds nothing, step 2 eight configurations by two determinants; 3.5 makes them a class."""
    body = steps_latex(classified(load("zlatanov-2dof")))
    steps = dict(re.findall(r"\\item\[([\d.]+)\] (.*)", body))
    assert list(steps) == ["1", "2", "3.2", "3.5", "4", "5", "6"]
    assert steps["1"] == "IIM, condition (vi): none."
    assert steps["2"].startswith("RPM, condition (iii): 8 configurations")
    assert steps["2"].endswith(r"Where B, C, D collinear \emph{and} C, D, G collinear.")
    assert "RI and RPM: none; RO and RPM: none; RI and RO and RPM: none" in steps["3.2"]
    assert "(RPM, II, IO): 8 configurations" in steps["3.5"]
    assert "(RI, RO, II, IO): 12 configurations" in steps["6"]


def test_components_of_the_five_curves(classified: Classified) -> None:
    """Section 3.3, Step 4 and 5, and the erratum on CGF: 4 components, where three are printed."""
    loci = classified(load("zlatanov-2dof")).loci
    assert {(locus.condition, locus.words): locus.components for locus in loci} == {
        ("4", "B, C, D collinear"): 4,
        ("4", "C, F, G collinear"): 4,
        ("5", "A, B, C collinear"): 2,
        ("5", "C, D, G collinear"): 4,
        ("5", "E, F, G collinear"): 2,
    }


def test_where_the_twelve_points_are(classified: Classified) -> None:
    """The erratum: with c the cosine of DC's angle, 4 points each at c = -1/4, -7/20, -5/16, exactly."""
    twelve = classified(load("zlatanov-2dof"))[T.RI | T.RO | T.II | T.IO]
    expected = [Fraction(-1, 4), Fraction(-7, 20), Fraction(-5, 16)]
    counted: Counter[Fraction] = Counter()
    for piece in twelve.pieces:
        ideal = Ideal(piece.basis[0].ring, piece.basis)
        C_x = ideal.ring.gen("Cx")
        values = [c for c in expected if ideal.radical_contains(C_x - (1 + 2 * c)).value]
        if len(values) == 1:
            counted[values[0]] += piece.points or 0
        else:
            for w in piece.witnesses:
                counted[min(expected, key=lambda c: abs(1 + 2 * c - Fraction(w.floats()["Cx"])))] += 1
    assert counted == dict.fromkeys(expected, 4)


def test_which_lines_meet_at_the_twelve_points(classified: Classified) -> None:
    """The erratum: ABC with CGF at -1/4, CGF with CDG at -7/20, CGF with EFG at -5/16; none with BCD."""
    twelve = classified(load("zlatanov-2dof"))[T.RI | T.RO | T.II | T.IO]
    seen = {}
    for w in twelve.witnesses:
        at = {name: (float(w.points[f"{name}.x"]), float(w.points[f"{name}.y"])) for name in "ABCDEFG"}
        lines = {t for t in ("BCD", "CFG", "ABC", "CDG", "EFG") if abs(_area(*(at[p] for p in t))) < 1e-9}
        seen[round((at["C"][0] - 1) / 2, 9)] = lines
    assert seen == {-0.25: {"ABC", "CFG"}, -0.35: {"CFG", "CDG"}, -0.3125: {"CFG", "EFG"}}


def _area(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
