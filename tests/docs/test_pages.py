"""The pages of the docs: commands, options, names and mechanisms that they show are there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import singsym
from singsym.cli.parser import commands

ROOT = Path(singsym.__file__).parents[1]
DOCS = ROOT / "singsym" / "docs"
PAGES = sorted(DOCS.rglob("*.md"))
TEXTS = [*PAGES, ROOT / "README.md"]
NAV = (ROOT / ".ci" / "mkdocs.yml").read_text(encoding="utf-8").partition("nav:")[2].partition("\nmark")[0]
FILE = re.compile(r'^```(\w+) title="([\w.-]+)"\n(.*?)^```$', re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"(?:^ {4}|^\$ |`|&& )singsym ([a-z]+)((?: [^`&;|#\n]*)?)", re.MULTILINE)
KNOWN = {name: {*options, "--version"} for name, options, _ in commands()}


def name_of(page: Path) -> str:
    return str(page.relative_to(ROOT))


@pytest.mark.parametrize("page", TEXTS, ids=name_of)
def test_commands_and_their_options_are_there(page: Path) -> None:
    for command, rest in COMMAND.findall(page.read_text(encoding="utf-8")):
        assert command in KNOWN, f"singsym {command}"
        for option in re.findall(r"(?<= )--[\w-]+", rest):
            assert option in KNOWN[command], f"singsym {command} {option}"


def test_commands_are_seen() -> None:
    found = COMMAND.findall("    singsym new a && singsym chekc a --wrong\n")
    assert found == [("new", " a "), ("chekc", " a --wrong")]


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_names_of_the_library_are_public(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    for name in re.findall(r"(?<![\w./-])singsym\.(?!__)(\w+)(?=[(`, )])", text):
        assert name in singsym.__all__, name


@pytest.mark.parametrize(
    "page", [p for p in PAGES if FILE.search(p.read_text(encoding="utf-8"))], ids=name_of
)
def test_mechanisms_of_a_page_are_sound(page: Path) -> None:
    for kind, name, text in FILE.findall(page.read_text(encoding="utf-8")):
        if kind == "toml" and "[links]" in text:
            singsym.loads(text, origin=name)


def test_each_page_is_in_the_contents_once() -> None:
    listed = re.findall(r": (\S+\.md)$", NAV, re.MULTILINE)
    notebooks = {f"notebooks/{p.stem}.md" for p in (ROOT / "notebooks").glob("*.ipynb")}
    written = {str(p.relative_to(DOCS)) for p in PAGES}
    assert sorted(listed) == sorted({*written, *notebooks, "gallery.md"})
