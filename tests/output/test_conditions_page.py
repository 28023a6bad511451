"""The page of conditions: it fits a screen, says each thing once, and has everything when asked for it."""

from __future__ import annotations

import re
from functools import cache

import pytest

from singsym.conditions.conditions import Conditions, conditions
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.output.citations import cited
from singsym.output.conditions_latex import listed_latex
from singsym.output.conditions_page import conditions_page, conditions_text
from singsym.output.page import plain


@cache
def found(name: str) -> Conditions:
    return conditions(velocity_equation(load(name)))


@pytest.mark.parametrize(
    "name",
    [
        *("zlatanov-2dof", "zlatanov-hybrid", "fourbar", "3rrr", "3rpr", "stewart-gough", "puma560", "ur5"),
        *("orthogonal-3r", "linear-delta", "tests/cases/jansen-leg.toml"),
        pytest.param("spherical-3rrr", marks=pytest.mark.slow),
    ],
)
def test_a_page_fits_a_screen(name: str) -> None:
    """40 lines, with the name of the mechanism and an empty line before the page."""
    assert len(plain(conditions_page(found(name))).splitlines()) <= 38


def test_vii_and_viii_refer_to_4_and_5() -> None:
    text = conditions_text(found("zlatanov-2dof"))
    assert "(vii) L_I is singular: RO or RPM, II or IIM; as (4)" in text
    assert "(viii) L_O is singular: RI or RPM, IO or IIM; as (5)" in text


def test_comparisons_of_ranks_say_what_they_come_to() -> None:
    """(vii), (viii) of section 2.3: off (iii) those of (5) are RI and of (4) RO; off (vi) IO and II."""
    text = conditions_text(found("zlatanov-2dof"))
    for label, twin, off in (("i", 5, "iii"), ("ii", 4, "iii"), ("iv", 4, "vi"), ("v", 5, "vi")):
        (line,) = (line for line in text.splitlines() if line.startswith(f"({label}) "))
        assert line.endswith(f"; as ({twin}) off ({off}); on it the ranks decide")
    lines = conditions_text(found("stewart-gough")).splitlines()
    ends = {line.split()[0]: line.partition("; ")[2] for line in lines if line.startswith("(")}
    assert [ends[f"({label})"] for label in ("i", "ii", "iv", "v")] == [
        "in no configuration",
        "as (4)",
        "as (4)",
        "in no configuration",
    ]


def test_iim_of_the_hybrid_chain_is_said_as_in_the_paper() -> None:
    """Section 5.3.2, step 1: screws A and C reciprocal to their legs, A - C reciprocal to the third."""
    lines = conditions_text(found("zlatanov-hybrid")).splitlines()
    place = lines.index("(vi) rank L < 18: IIM")
    both = "screws reciprocal to B1 B2 B3 B4 and to C1 C2 C3 C4, not both 0,"
    assert lines[place + 1] == f"  if {both} have a sum reciprocal to A1 A2 A3 A4"


def test_rpm_of_the_linkage_is_said_as_in_the_paper() -> None:
    """Section 3.3, step 2: BCD and CDG are collinear."""
    lines = conditions_text(found("zlatanov-2dof")).splitlines()
    place = lines.index("(iii) rank L_p < 6: RPM")
    assert lines[place + 1] == "  if B, C, D collinear and C, D, G collinear"


@pytest.mark.parametrize("name", ["zlatanov-2dof", "3rrr", "3upu-tsai"])
def test_each_polynomial_is_printed_once_and_each_name_is_explained(name: str) -> None:
    text = conditions_text(found(name), expand=True)
    factors = {f.polynomial: f for c in found(name) for f in c.all_factors}
    for factor in factors.values():
        if len(factor.polynomial) > 3:
            assert text.count(factor.text()) == 1
    defined = re.findall(r"(?:if|or|where) (f\d+) = (?!f\d|0)", text)
    assert sorted(defined) == sorted(set(re.findall(r"\bf\d+\b", text)))
    assert len(defined) == len(set(defined))


def test_what_is_cut_says_how_to_see_it() -> None:
    short, long = (conditions_text(found("3rrr"), expand=e) for e in (False, True))
    assert "more terms" in short
    assert short.endswith("What is cut here, --expand prints")
    assert "more terms" not in long
    assert "--expand" not in long


def test_matrices_and_pivots_are_there_when_all_is_asked_for() -> None:
    pages = [plain(conditions_page(found("fourbar"), expand=expand)) for expand in (False, True)]
    for part in ("L, 4x5", "L, reduced, 1x2", "D by row output D, pivot -1"):
        assert [part in page for page in pages] == [False, True]


def test_factors_that_were_taken_away_are_counted() -> None:
    page = plain(conditions_page(found("stewart-gough")))
    units = len(found("stewart-gough")["5"].units)
    assert f"without {units} factors that vanish nowhere" in page


def test_names_are_the_same_in_latex() -> None:
    names = set(cited(found("3rrr")).numbers.values())
    text = listed_latex(found("3rrr"), expand=True)
    assert {int(k) for k in re.findall(r"f_\{(\d+)\}", text)} == names
    assert "as (4)." in text
