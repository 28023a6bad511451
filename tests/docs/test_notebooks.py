"""The notebooks teach: they import public names, check in hidden cells, and are stored with what they print.

That they run without errors is tested by nbmake, which collects the notebooks themselves.
"""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

import nbformat
import pytest

import singsym

NOTEBOOKS = sorted(Path(singsym.__file__).parents[1].joinpath("notebooks").glob("*.ipynb"))
HIDDEN = "remove-cell"
LARGEST = 500_000
"""Bytes of a notebook with its pictures."""


def cells(path: Path) -> list[Any]:
    return [cell for cell in nbformat.read(path, 4).cells if cell.cell_type == "code"]


def is_hidden(cell: Any) -> bool:
    hidden = HIDDEN in cell.metadata.get("tags", [])
    assert hidden == bool(cell.metadata.get("jupyter", {}).get("source_hidden")), cell.source
    return hidden


def asserts(cell: Any) -> bool:
    return any(isinstance(node, ast.Assert) for node in ast.walk(ast.parse(cell.source)))


def named(path: Path) -> str:
    return path.stem


@pytest.mark.parametrize("path", NOTEBOOKS, ids=named)
def test_of_singsym_only_public_names_are_imported(path: Path) -> None:
    for cell in cells(path):
        for node in ast.walk(ast.parse(cell.source)):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("singsym"):
                assert node.module == "singsym"
                assert {alias.name for alias in node.names} <= set(singsym.__all__)
            if isinstance(node, ast.Import):
                assert not [alias.name for alias in node.names if alias.name.startswith("singsym.")]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=named)
def test_checks_are_in_hidden_cells_and_nothing_else_is(path: Path) -> None:
    found = cells(path)
    assert {is_hidden(cell) for cell in found} == {True, False}
    for cell in found:
        assert asserts(cell) == is_hidden(cell), cell.source


@pytest.mark.parametrize("path", NOTEBOOKS, ids=named)
def test_it_is_stored_with_its_outputs(path: Path) -> None:
    assert path.stat().st_size <= LARGEST
    assert [cell.execution_count for cell in cells(path)] == list(range(1, len(cells(path)) + 1))
    for cell in cells(path):
        assert "execution" not in cell.metadata, "times of a run change with each"
        kinds = {(output.output_type, output.get("name")) for output in cell.outputs}
        assert not kinds & {("error", None), ("stream", "stderr")}
        assert not (is_hidden(cell) and cell.outputs), cell.source


def test_the_last_line_of_a_visible_cell_is_shown() -> None:
    """A value at the end of a cell, or a printed line, has an output."""
    for path in NOTEBOOKS:
        for cell in cells(path):
            last = ast.parse(cell.source).body[-1]
            if isinstance(last, ast.Expr) and not is_hidden(cell):
                assert cell.outputs, (path.stem, cell.source)
