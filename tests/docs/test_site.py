"""The docs as a site: it builds without a warning, nothing is missing, and outputs are what pages say."""

from __future__ import annotations

import re
import subprocess
import sys
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import urlsplit

import pytest

import singsym

pytest.importorskip("mkdocs")
pytest.importorskip("markdown_exec")
ROOT = Path(singsym.__file__).parents[1]
pytestmark = [pytest.mark.slow, pytest.mark.engines, pytest.mark.xdist_group("site")]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet"]
    command += ["--config-file", str(ROOT / ".ci" / "mkdocs.yml"), "--site-dir", str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=1500, cwd=ROOT)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def text_of(site: Path, page: str) -> str:
    """The words of a page, without its navigation."""
    html = (site / page / "index.html").read_text(encoding="utf-8")
    main = html[html.index('role="main"') :]
    return " ".join(unescape(re.sub(r"<[^>]+>", "", main)).split())


SAID = {
    "": ["Locks (IO, the input cannot move the output): 2 configurations"],
    # stretched rods of 4 and 4 reach 8, less than 5 + 2 + 2; of 5 and 5 they cannot, nor fold: 5 - 2 - 2 > 0
    "tutorial": [
        "sorter: N = 5, n = 2",
        "No problem found",
        "expected a joint freedom among",
        "Classes 1-3 occur; every other class is proven empty",
        "Goes slack (RO, the output can move with all inputs locked): infinitely many configurations",
        "C, D, E collinear",
        "B, C, D collinear",
        "Goes slack (RO, the output can move with all inputs locked): never (proven)",
        "delta = 0, p = 0, k_I = 0, k_O = 0: regular",
    ],
    "howto/urdf": [
        "-1.5708 is -pi/2",
        "its tip is the only end behind moving joints",
        "N = 3, n = 3",
        "choose what the arm is for",
    ],
    # half a slider-crank with the offset 3/2: AC = 4 or 2, with C above or below
    "howto/couplings": ["Locks (IO, the input cannot move the output): 4 configurations"],
    "howto/own-equations": [
        "1 (RI, IO) 2 configurations",
        "2 (RO, II) 2 configurations",
        "Locks (IO, the input cannot move the output): never",
    ],
    # crank and rod in line, see `tests/certificates/test_table.py`
    "howto/certificates": [
        "feeder: the table is proven in full",
        "RI, IO: occurs, dimension 0, 4 points",
        "number of points of RI, IO is not 5; proven is 4",
    ],
    "howto/cluster": ["Locks (IO", "every other class is proven empty"],
    "howto/latex": ["\\begin", "\\documentclass", "lift.pdf"],
    # B, C, D in line at BD = coupler + 2, while BD is between 3 and 5
    "howto/scripts": ["1 RI, IO", "5/2 slack: yes 2", "7/2 slack: no", "4 slack: no", "verdict", "True"],
    "theory/classes": ["The 21 classes for n = 3 or more", "The 9 classes for n = 1"],
    "theory/velocity-equation": ["L, 4x5"],
    "limits": ["Joint limits and exclusions restrict the results"],
    "notebooks/02-two-dof-linkage": ["12 and 8"],
}


@pytest.mark.parametrize("page", SAID)
def test_outputs_are_what_the_page_says(site: Path, page: str) -> None:
    text = text_of(site, page)
    for words in SAID[page]:
        assert words in text, words


def test_each_class_occurs_in_a_mechanism_of_the_library(site: Path) -> None:
    html = (site / "theory" / "classes" / "index.html").read_text(encoding="utf-8")
    table = html[html.index("<th>mechanisms</th>") :]
    assert len(re.findall(r"<tr>\s*<td[^>]*>\d+</td>\s*<td>[^<]+</td>\s*<td><a ", table)) == 21


class Links(HTMLParser):
    """What a page loads, and where it leads."""

    def __init__(self) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.leads: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        source = given.get("src") or (given.get("href") if tag == "link" else None)
        if source and given.get("rel") != "canonical":
            self.loads.append(source)
        if tag == "a" and given.get("href"):
            self.leads.append(str(given["href"]))


def test_nothing_is_missing_or_loaded_from_elsewhere(site: Path) -> None:
    pages = list(site.rglob("index.html"))
    assert len(pages) > 20
    for page in pages:
        links = Links()
        links.feed(page.read_text(encoding="utf-8"))
        here = [part for part in links.loads if not part.startswith("data:")]
        assert not [part for part in here if urlsplit(part).netloc], page
        here += [part for part in links.leads if not urlsplit(part).scheme]
        for part in filter(None, (urlsplit(part).path for part in here)):
            target = (page.parent / part).resolve()
            assert target.exists(), (page, part)


def test_the_gallery_has_a_picture_of_each_mechanism(site: Path) -> None:
    html = (site / "gallery" / "index.html").read_text(encoding="utf-8")
    for name in singsym.library.names():
        assert f'<figure id="{name}">' in html
        assert (site / "gallery" / f"{name}.svg").read_text(encoding="utf-8").startswith("<svg")


def test_no_formula_is_left_as_latex(site: Path) -> None:
    for page in site.rglob("index.html"):
        assert "arithmatex" not in page.read_text(encoding="utf-8"), page
    theory = site / "theory" / "velocity-equation" / "index.html"
    assert "<math" in theory.read_text(encoding="utf-8")
