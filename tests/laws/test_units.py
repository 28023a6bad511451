"""A law: a mechanism times k has the same singularities, and the same way is taken to find them.

Source: dimensional analysis.  The mechanisms are written out with all their lengths times k; nothing of the
code under test scales them.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import isclose

import pytest

from singsym.classes.classify import classify
from singsym.classes.result import Classification
from singsym.classes.unit_border import Border
from singsym.kinematics.mobility import check_mobility
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Mechanism, loads

FACTORS = (Fraction(1, 1000), Fraction(2), Fraction(7, 3), Fraction(1000))


def four_bar(k: Fraction) -> Mechanism:
    return loads(f"""
name = "four-bar"
inputs = ["A"]
output = {{ rate = "D" }}
[links]
ground = {{ points = {{ A = [0, 0], D = ["{4 * k}", 0] }} }}
AB = "{2 * k}"
BC = "{3 * k}"
CD = "{4 * k}"
[joints]
A = "R"
B = "R"
C = "R"
D = "R"
""")


def five_bar(k: Fraction) -> Mechanism:
    """At k = 100 the lengths 200, 300, 300, 200 on a base of 100, as of a robot in millimetres."""
    return loads(f"""
name = "five-bar"
inputs = ["A", "E"]
output = {{ velocity = "C" }}
[links]
ground = {{ points = {{ A = [0, 0], E = ["{k}", 0] }} }}
AB = "{2 * k}"
BC = "{3 * k}"
CD = "{3 * k}"
DE = "{2 * k}"
[joints]
A = "R"
B = "R"
C = "R"
D = "R"
E = "R"
""")


def slider_crank(k: Fraction) -> Mechanism:
    """With an offset, a limit of the slide, and an exclusion that is no power of a length."""
    return loads(f"""
name = "slider-crank"
inputs = ["A"]
output = {{ rate = "P" }}
[links]
ground = {{ points = {{ A = [0, 0], O = [0, "{k / 2}"] }}, axes = {{ x = [1, 0] }} }}
AB = "{k}"
BC = "{3 * k}"
slider = {{ points = {{ C = [0, 0] }}, axes = {{ x = [1, 0] }} }}
[joints]
A = "R"
B = "R"
C = "R"
[joints.P]
type = "P"
links = ["ground", "slider"]
at = ["O", "C"]
axis = "x"
[limits]
"length(P)" = {{ min = 0, max = "{5 * k}" }}
[exclusions]
"a wall" = {{ zero = "C.x - {7 * k}" }}
""")


def arm(k: Fraction) -> Mechanism:
    return loads(f"""
name = "arm"
space = "spatial"
inputs = ["J1", "J2", "J3"]
output = {{ velocity = "tool" }}
[dh]
rows = [
  {{ a = "{k}", alpha = 90 }},
  {{ a = "{3 * k / 2}", alpha = 90 }},
  {{ a = "{2 * k}", d = "{k / 5}" }},
]
""")


KINDS = [four_bar, five_bar, slider_crank, arm]


def facts(found: Classification) -> tuple[object, ...]:
    """What does not depend on the unit: classes, dimensions, counts, components, words."""
    classes = [
        (c.types, c.verdict.answer, c.verdict.certainty, c.dimension, c.points, c.components)
        for c in found.classes
    ]
    loci = [(x.condition, x.words, x.verdict.answer, x.dimension, x.points, x.components) for x in found.loci]
    return classes, loci, [(p.dimension, p.smooth) for p in found.configuration_space]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("k", FACTORS)
def test_the_same_question_is_asked_inside(kind: Callable[[Fraction], Mechanism], k: Fraction) -> None:
    """So that the same work is done, whatever the unit."""
    one, other = Border.of(kind(Fraction(1))), Border.of(kind(k))
    assert other.unit == k * one.unit
    assert other.inside == one.inside


@pytest.mark.parametrize("kind", KINDS)
def test_same_classes_in_any_unit(kind: Callable[[Fraction], Mechanism]) -> None:
    expected = classify(kind(Fraction(1)), cache=False)
    assert any(c.verdict.is_yes for c in expected.classes)
    for k in (Fraction(1, 1000), Fraction(700, 3)):
        found = classify(kind(k), cache=False)
        assert facts(found) == facts(expected)
        pairs = zip(expected.classes, found.classes, strict=True)
        witnesses = [pair for a, b in pairs for pair in zip(a.witnesses, b.witnesses, strict=True)]
        for one, other in witnesses:
            error = 1.01 * (float(other.radius) + float(k) * float(one.radius))
            for name, value in one.points.items():
                assert isclose(float(other.points[name]), float(k) * float(value), abs_tol=error)


@pytest.mark.parametrize("k", [Fraction(7, 3), Fraction(100)])
def test_loci_and_witnesses_are_in_the_users_unit(k: Fraction) -> None:
    """B, C, D are collinear where (C - B) x (D - B) = 0; there the witnesses of the loci's classes are."""
    found = classify(five_bar(k), cache=False)
    (locus,) = (x for x in found.loci if x.condition == "4")
    assert locus.words == "B, C, D collinear"
    ring = locus.factor.ring
    Bx, By, Cx, Cy, Dx, Dy = (ring.gen(name) for name in ("Bx", "By", "Cx", "Cy", "Dx", "Dy"))
    area = (Cx - Bx) * (Dy - By) - (Cy - By) * (Dx - Bx)
    assert locus.factor.primitive() == area.primitive()
    for result in found.classes:
        for witness in result.witnesses:
            v = {name: float(value) for name, value in witness.coordinates.items()}
            rod = (v["Cx"] - v["Bx"]) ** 2 + (v["Cy"] - v["By"]) ** 2
            assert isclose(rod, 9 * float(k) ** 2, rel_tol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_random_configurations_in_any_unit(kind: Callable[[Fraction], Mechanism]) -> None:
    """Random configurations are regular, in the user's own unit as well."""
    for k in (Fraction(1), *FACTORS):
        mobility = check_mobility(velocity_equation(kind(k)))
        assert (mobility.samples, mobility.regular) == (12, 12)
