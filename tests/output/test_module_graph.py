"""Modules as text, data and drawing."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from singsym.cli import main
from singsym.kinematics.modules import driven_modules
from singsym.mechanism import load
from singsym.output.module_graph import module_graph, plot_modules


def test_show_lists_the_modules_of_both_ends(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "five-bar"]) == 0
    text = capsys.readouterr().out
    inputs, outputs = text.split("Modules, driven from the ")[1:]
    assert _cells(inputs.splitlines()[5]) == ["3", "dyad C from B and D", "BC, CD", "Cx, Cy", "1, 2"]
    assert _cells(outputs.splitlines()[4]) == ["2", "dyad B from A and C", "AB, BC", "Bx, By", "1"]


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.split("  ") if cell.strip()]


def test_show_as_data(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "fourbar", "--format", "json"]) == 0
    (crank, dyad) = json.loads(capsys.readouterr().out)["modules"]["from_inputs"]["modules"]
    assert (crank["driven"], dyad["parents"]) == (["A"], [0])
    assert len(dyad["equations"]) == len(dyad["variables"]) == dyad["unknowns"] == 2


def test_arrows_that_others_imply_are_not_drawn() -> None:
    """F hangs on the coupler, and so on the crank: two arrows, not three."""
    found = driven_modules(load("stephenson-six-bar"))["inputs"]
    assert found.modules[2].parents == (0, 1)
    assert sorted(module_graph(found).edges) == [(0, 1), (1, 2)]


def test_the_drawing_says_what_it_shows(tmp_path: Path) -> None:
    picture = plot_modules(driven_modules(load("3rrr")))
    assert "from the outputs: output link platform, then leg 1" in picture.description
    target = tmp_path / "modules.svg"
    assert main(["plot", "fourbar", "--modules", "-o", str(target)]) == 0
    assert target.read_text(encoding="utf-8").count("<svg") == 1
