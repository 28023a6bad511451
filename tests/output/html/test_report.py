"""The report as a page: links, ids, descriptions, nothing from elsewhere, not too large."""

from __future__ import annotations

from collections import Counter
from html.parser import HTMLParser

import pytest
import sympy

from singsym.classes.classify import classify, classify_equation
from singsym.kinematics import SymbolicSpace, from_sympy
from singsym.mechanism import load
from singsym.output.html.mathml import name
from singsym.output.html.report import report


class Page(HTMLParser):
    """Collects the elements of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))


@pytest.fixture(scope="module")
def linkage() -> str:
    return report(classify(load("zlatanov-2dof"), cache=False))


def test_links_lead_somewhere_ids_are_unique_and_nothing_is_loaded(linkage: str) -> None:
    page = Page(linkage)
    ids = Counter(str(a["id"]) for _, a in page.elements if "id" in a)
    assert max(ids.values()) == 1
    for tag, attributes in page.elements:
        for key in ("href", "xlink:href", "src"):
            if key in attributes:
                assert str(attributes[key]).startswith("#"), (tag, attributes)
                assert str(attributes[key])[1:] in ids, (tag, attributes)
    assert "@import" not in linkage
    assert "url(http" not in linkage


def test_figures_are_described_and_formulas_are_mathml(linkage: str) -> None:
    page = Page(linkage)
    drawings = [a for tag, a in page.elements if tag == "svg"]
    # the portrait, nine families of the four classes, two planes of curves, regions, strata
    figures, scenes = 1 + 9 + 2 + 1 + 1, 9 + 1
    assert len(drawings) == figures + scenes
    assert all(a.get("role") == "img" and a.get("aria-label") for a in drawings)
    assert len(linkage.encode()) < 1_000_000
    assert sum(tag == "math" for tag, _ in page.elements) >= 18
    assert all(f'id="class-{number}"' in linkage for number in (1, 2, 3, 4))
    assert all(f'id="proof-{number}"' in linkage for number in range(1, 22))


def test_names_of_determinants() -> None:
    assert (
        name(r"\det[S_{A}]")
        == "<mi>det</mi><mo>[</mo><msub><mi>S</mi><mrow><mi>A</mi></mrow></msub><mo>]</mo>"
    )
    assert name(r"\overrightarrow{PQ} \cdot u").startswith("<mover><mrow><mi>PQ</mi></mrow>")


def test_given_equations_have_a_page_without_figures_of_a_mechanism() -> None:
    c, s = sympy.symbols("c s")
    L = sympy.Matrix([[1, -s]])
    equation = from_sympy(L, [("T", "output"), ("A", "input")], SymbolicSpace([c**2 + s**2 - 1]))
    page = report(classify_equation(None, equation, cache=False))
    assert "Given equations" in page
    assert 'id="class-1"' in page
