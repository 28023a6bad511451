"""The report as a page: links, ids, descriptions, nothing from elsewhere, not too large."""

from __future__ import annotations

import re
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path

import pytest
import sympy

from singsym.certificates.prover.writing import Certificate, certificate
from singsym.classes.classify import classify, classify_equation
from singsym.kinematics import SymbolicSpace, from_sympy
from singsym.mechanism import load
from singsym.output.html.mathml import name
from singsym.output.html.report import report

pytestmark = pytest.mark.xdist_group("report")


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


@pytest.mark.engines
def test_each_class_is_linked_to_the_lines_that_prove_it(tmp_path: Path) -> None:
    """A four-bar of 2, 4, 5 on 6 has class 1 in four points, see `tests/certificates/test_table.py`."""
    result = classify(load("fourbar"), cache=False)
    made = certificate(result)
    file = made.write(tmp_path / "fourbar.cert")
    text = result.report(tmp_path / "page.html", file).read_text(encoding="utf-8")
    leaves = {k: line for k, line in enumerate(made.lines, 1) if line.get("rule") == "points"}
    page = Page(text)
    ids = {a["id"] for _, a in page.elements if "id" in a}
    assert {f"line-{k}" for k in range(3, len(made.lines) + 1)} <= ids
    there = [c for c in result.classes if c.verdict.is_yes]
    row = text.split('id="equations"')[0].split("The classes</h3>")[1]
    found = {int(k) for k in re.findall(r'href="#line-(\d+)"', row)}
    assert found <= set(leaves)
    assert len(there) == 1 <= len(found)
    counts = [int(k) for k in re.findall(r"(\d+) real points? \(RI, IO\)", text)]
    assert sum(counts) == there[0].points
    assert "proves the table in full" in text
    assert 'href="#certificate"' in text.split('id="proof-2"')[1].split("</section>")[0]


@pytest.mark.engines
def test_a_certificate_of_another_mechanism_is_refused(tmp_path: Path) -> None:
    result = classify(load("slider-crank"), cache=False)
    file = certificate(classify(load("2r"), cache=False)).write(tmp_path / "2r.cert")
    with pytest.raises(ValueError, match="other equations"):
        report(result, file)


@pytest.mark.engines
def test_what_a_certificate_leaves_open_is_said(tmp_path: Path) -> None:
    result = classify(load("fourbar"), cache=False)
    file = Certificate(certificate(result).lines[:-1]).write(tmp_path / "short")
    text = report(result, file)
    assert "proves a part of the table" in text
    assert "is left open" in text
