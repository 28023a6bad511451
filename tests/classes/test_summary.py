"""The answers at a glance: what is open stays open in them, and every class is spoken of.

The expected lines follow from what is put into a result by hand, or from a known number: a crank-rocker has
two dead centres in each of its two assemblies (Grashof).
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from singsym.classes.classify import classify
from singsym.classes.result import Classification, ClassResult
from singsym.classes.summary import empty_text, shown_classes
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.classes.taxonomy.types import feasible_classes
from singsym.effort.verdict import Verdict
from singsym.mechanism import load, loads
from singsym.output.page import plain
from singsym.output.plain_data import classification_data
from singsym.output.text import classification_page
from singsym.varieties.real.dimension.extent import UNKNOWN, Extent

LATE = "the clock stood still"


@cache
def crank_rocker() -> Classification:
    return classify(load("fourbar"), cache=False)


def with_classes(**changed: dict[str, object]) -> Classification:
    """The crank-rocker with other classes, by their numbers as `c1`."""
    result = crank_rocker()
    classes = tuple(
        replace(c, **changed.get(f"c{c.singularity_class.number}", {}))  # type: ignore[arg-type]
        for c in result.classes
    )
    return replace(result, classes=classes)


OPEN: dict[str, object] = {"verdict": Verdict.undecided(LATE), "extent": UNKNOWN}
MODULAR: dict[str, object] = {"verdict": Verdict.no("modular")}


def answer(result: Classification, kind: T) -> str:
    """What is said of a type, without its explanation."""
    (line,) = (line for line in result.summary if f"({kind.name}, " in line)
    return line.partition("): ")[2]


def test_every_class_is_spoken_of() -> None:
    """Each has IO or RO, of which a line speaks always, or both RPM and IIM."""
    for found in feasible_classes(3):
        assert found.types & (T.IO | T.RO) or found.types == T.RPM | T.IIM


def test_a_crank_rocker_locks_at_four_dead_centres_and_nothing_else() -> None:
    assert crank_rocker().summary == (
        "Locks (IO, the input cannot move the output): 4 configurations (proven)",
        "Goes slack (RO, the output can move with the input locked): never (proven)",
        "Class 1 occurs; every other class is proven empty",
    )
    assert empty_text(crank_rocker()).startswith("Empty: 2, 4, 8, 12-15, 18 (proven); 3, 5-7")


def test_a_mechanism_without_singularities() -> None:
    lines = classify(load("oldham"), cache=False).summary
    assert lines[2] == "No singularity: every class is proven empty"
    assert all(line.endswith("never (proven)") for line in lines[:2])


TWO_PINS = """
inputs = ["A"]
output = { rate = "B" }
[links]
ground = { points = { A = [0, 0], B = [1, 0] } }
bar = { points = { A = [0, 0], B = [1, 0] } }
[joints]
A = "R"
B = "R"
"""


@pytest.mark.parametrize("limits", ["", '[limits]\n"cos(A)" = { max = 0 }'])
def test_what_does_not_move_is_no_mechanism_without_singularities(limits: str) -> None:
    """A bar on two pins in the ground: one configuration, which no equation is about, or none."""
    result = classify(loads(TWO_PINS + limits), cache=False)
    assert result.summary[0].startswith("No configuration is known" if limits else "Moves less than n = 1")
    assert [piece.dimension for piece in result.configuration_space] == ([] if limits else [0])


@pytest.mark.parametrize(
    ("changed", "kind", "expected"),
    [
        # class 4 (RPM, II, IO) is one of IO and RPM, not of RO
        ({"c4": OPEN}, T.IO, "at least 4 configurations (proven); class 4 is open"),
        ({"c4": OPEN}, T.RPM, "undecided; class 4 is open"),
        ({"c4": OPEN}, T.RO, "never (proven)"),
        # 2 (RO, II), 8 (RI, RO, IIM), 12 (RPM, IIM), 14 (RO, RPM, II, IIM)
        ({"c2": OPEN, "c8": OPEN, "c14": OPEN}, T.RO, "undecided; classes 2, 8, 14 are open"),
        ({"c12": OPEN}, T.IIM, "undecided; class 12 is open"),
        ({"c12": OPEN}, T.IO, "4 configurations (proven)"),
        ({"c2": MODULAR}, T.RO, "never (modular, 3 primes)"),
        (
            {"c13": MODULAR},
            T.IO,
            "4 configurations (proven); that there is no more of it rests on random primes",
        ),
        ({"c1": {"points": None, "open": LATE}}, T.IO, "at least 4 configurations (proven)"),
        ({"c1": {"extent": Extent(0, None, open=LATE)}}, T.IO, "at least 4 configurations (proven)"),
        (
            {"c1": {"extent": Extent(1, None, open=LATE)}},
            T.IO,
            "infinitely many configurations (dimension at least 1 of 1, proven)",
        ),
        (
            {"c1": {"extent": Extent(1, 1)}},
            T.IO,
            "a set as large as the configuration space (dimension 1 of 1, proven)",
        ),
        (
            {"c1": {"verdict": Verdict.yes("certified", reason="that there is no more of it rests on luck")}},
            T.IO,
            "4 configurations (certified); that there is no more of it rests on luck",
        ),
    ],
)
def test_nothing_open_sounds_decided(changed: dict[str, dict[str, object]], kind: T, expected: str) -> None:
    assert answer(with_classes(**changed), kind) == expected


def test_parts_that_are_open_are_said() -> None:
    first: ClassResult = crank_rocker()[T.RI | T.IO]
    part = replace(first.pieces[0], verdict=Verdict.undecided(LATE), witnesses=())
    found = with_classes(c1={"unsure": (part,)})
    assert answer(found, T.IO) == "at least 4 configurations (proven); parts of class 1 are open"
    assert found.summary[-1].endswith("further open questions: 1")


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({"c4": OPEN}, "Class 1 occurs; class 4 is open; every other class is proven empty"),
        (
            {"c1": OPEN, "c4": OPEN},
            "Classes 1, 4 are open; every other class is proven empty",
        ),
        ({"c2": MODULAR}, "Class 1 occurs; every other class is empty (2: modular, 3 primes)"),
        (
            {"c1": {"points": None, "open": LATE}},
            "Class 1 occurs; every other class is proven empty; further open questions: 1",
        ),
    ],
)
def test_the_last_line_is_of_all_classes(changed: dict[str, dict[str, object]], expected: str) -> None:
    assert with_classes(**changed).summary[-1] == expected


def test_what_is_open_is_shown_after_what_occurs() -> None:
    """Class 2 before class 4 by its number, after it as it is open."""
    found = with_classes(c2=OPEN, c4={"verdict": Verdict.yes(), "extent": Extent(0, 0), "points": 8})
    assert [c.singularity_class.number for c in shown_classes(found)] == [1, 4, 2]


def test_numbers_that_count_a_free_length_say_so() -> None:
    """A slider-crank with a rod of any length l: of l = r the slider can stay on the crank's centre.

    There d = 0 and d = 2 r cos(angle) cross, at the angles of 90 and -90 degrees: two points.
    """
    result = classify(load("slider-crank").with_parameters(l=None), cache=False)
    assert answer(result, T.IIM) == "2 configurations, each at one value of l (proven)"
    assert answer(result, T.IO) == "a set (dimension 1 of 2, which counts l; proven)"


def test_loci_are_in_names_of_lengths_with_their_values_beside() -> None:
    """A slotted lever stands still where the crank is at right angles to it: g s = d, g = 2 in the file."""
    result = classify(load("crank-slotted-lever"), cache=False)
    assert result.lengths_note == "g = 2"
    page = plain(classification_page(result))
    assert "AB perpendicular to slide P" in page
    assert "; g = 2" in page
    assert "2*s_block" not in page
    found = {locus["factor"]: locus["in_lengths"] for locus in classification_data(result)["loci"]}
    assert found["d_P - 2*s_block"] == "g*s_block - d_P"


def test_points_of_a_double_cover_are_not_called_configurations() -> None:
    result = crank_rocker()
    space = replace(result.equation.space, formulation="quaternion")
    found = replace(result, equation=replace(result.equation, space=space))
    assert answer(found, T.IO) == "4 points of the double cover (proven)"
