"""The gallery's index as a page: its links, tables and figures, and what it says of what is missing."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace

import pytest
import sympy

from singsym.classes.classify import Limits, classify, classify_equation
from singsym.kinematics import SymbolicSpace, from_sympy
from singsym.mechanism import load
from singsym.output.gallery_list import kind
from singsym.output.html.gallery import Card, card, index, page_name
from tests.output.html.test_report import Page

NAMES = ("fourbar", "spherical-fourbar", "scara", "oldham")


@pytest.fixture(scope="module")
def cards() -> list[Card]:
    return [card(classify(load(name), cache=False)) for name in NAMES]


def test_links_lead_to_parts_of_the_page_or_to_reports(cards: list[Card]) -> None:
    text = index(cards, len(cards))
    page = Page(text)
    ids = Counter(str(a["id"]) for _, a in page.elements if "id" in a)
    assert max(ids.values()) == 1
    reports = set()
    for _, attributes in page.elements:
        for key in ("href", "xlink:href", "src"):
            file, _, place = str(attributes.get(key) or "").partition("#")
            if file:
                reports.add(file)
            elif place:
                assert place in ids
    assert reports == {page_name(name) for name in NAMES}
    assert "url(http" not in text
    assert "@import" not in text


def test_each_mechanism_has_a_described_figure_and_its_classes(cards: list[Card]) -> None:
    """Four points for the crank-rocker: its follower's limits (Grashof)."""
    page = Page(index(cards, len(cards)))
    drawings = [a for tag, a in page.elements if tag == "svg"]
    assert len(drawings) == len(NAMES)
    assert all(a.get("role") == "img" and a.get("aria-label") for a in drawings)
    (crank_rocker,) = (c for c in cards if c.name == "fourbar")
    assert crank_rocker.found == (1,)
    assert "<td>RI, IO</td><td>0</td><td>4 points</td>" in crank_rocker.body
    assert "Class 1 occurs; every other class is proven empty" in crank_rocker.body
    (coupling,) = (c for c in cards if c.name == "oldham")
    assert coupling.found == ()
    assert "No singularity" in coupling.body


def test_the_overview_marks_what_occurs_and_what_is_open(cards: list[Card]) -> None:
    marked = index([replace(cards[0], open=(2, 3))], 1)
    assert marked.count("●") == 1
    assert marked.count('aria-label="undecided"') == 2


def test_the_index_says_how_much_is_missing(cards: list[Card]) -> None:
    assert "1 of 5 are not classified yet" in index(cards, 5)
    assert "not classified yet" not in index(cards, 4)


def test_undecided_classes_are_named() -> None:
    limits = Limits(seconds=0.001, total=0.001)
    found = card(classify(load("zlatanov-2dof"), limits=limits, cache=False))
    assert found.open
    assert found.undecided
    spans = [
        [int(number) for number in span.split(" to ")]
        for listed in re.findall(r"occurrence of class ((?:[0-9]|, | to )+)", found.body)
        for span in listed.split(", ")
    ]
    assert set(found.open) <= {number for span in spans for number in range(span[0], span[-1] + 1)}


def test_equations_without_a_mechanism_have_no_place() -> None:
    c, s = sympy.symbols("c s")
    equation = from_sympy(
        sympy.Matrix([[1, -s]]), [("T", "output"), ("A", "input")], SymbolicSpace([c**2 + s**2 - 1])
    )
    result = classify_equation(None, equation, cache=False)
    with pytest.raises(ValueError, match="without a mechanism"):
        card(result)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("fourbar", "planar, 1 loop"),
        ("zlatanov-2dof", "planar, 2 loops"),
        ("spherical-5r", "spherical, 1 loop"),
        ("stewart-gough", "spatial, 5 loops"),
        ("puma560", "spatial, serial"),
    ],
)
def test_kind(name: str, expected: str) -> None:
    """Loops by Euler's formula: joints - links + 1."""
    assert kind(load(name)) == expected
