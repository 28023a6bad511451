"""The house: no room is too wide, each says what it is for, and each file what is inside and from where."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import singsym
from singsym.elimination.engines.base import Engine

ROOT = Path(singsym.__file__).parent
ROOMS = sorted(p.parent for p in ROOT.rglob("__init__.py"))
FILES = sorted(ROOT.rglob("*.py"))
WIDEST = 16
"""Modules in a room."""
LONGEST = 420
"""Lines of a module."""


@pytest.mark.parametrize("room", ROOMS, ids=lambda room: str(room.relative_to(ROOT.parent)))
def test_a_room_is_not_too_wide(room: Path) -> None:
    assert len([p for p in room.glob("*.py") if p.name != "__init__.py"]) <= WIDEST


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(ROOT)))
def test_a_file_is_short_and_says_what_is_inside(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    assert text.count("\n") <= LONGEST
    assert ast.get_docstring(ast.parse(text))


def test_everything_public_has_a_docstring() -> None:
    """Functions and classes of modules, and methods of public classes; engines have those of `Engine`."""
    known = {name for name in vars(Engine) if not name.startswith("_")}
    missing = []
    for file in FILES:
        tree = ast.parse(file.read_text(encoding="utf-8"))
        classes = [n for n in tree.body if isinstance(n, ast.ClassDef) and not n.name.startswith("_")]
        for holder in (tree, *classes):
            inherited = known if getattr(holder, "name", "").endswith("Engine") else set()
            missing += [
                f"{file.relative_to(ROOT)}: {node.name}"
                for node in holder.body
                if isinstance(node, ast.FunctionDef | ast.ClassDef)
                and not (node.name.startswith("_") or node.name in inherited or ast.get_docstring(node))
            ]
    assert not missing, "\n".join(missing)
