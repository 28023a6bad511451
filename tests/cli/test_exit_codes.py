"""Exit code 3: something is open, a class, a dimension or a number; by every command that classifies."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from singsym.classes import classify as module
from singsym.classes.result import Classification
from singsym.cli import main

SHORT = ["--budget", "0.001", "--workers", "1", "--no-cache"]
WHOLE = ["--workers", "1", "--no-cache"]


@pytest.fixture
def uncounted(monkeypatch: pytest.MonkeyPatch) -> None:
    """All classes decided and all dimensions known, but the number of points of class 1 is not."""
    whole = module.classify

    def without_a_number(*given: object, **options: object) -> Classification:
        found = whole(*given, **options)  # type: ignore[arg-type]
        first, *others = found.classes
        first = replace(first, points=None, components=None, open="not counted in this test")
        return replace(found, classes=(first, *others))

    monkeypatch.setattr(module, "classify", without_a_number)


@pytest.mark.parametrize(
    "command",
    [
        ["classify", "slider-crank"],
        ["classify", "slider-crank", "--format", "json"],
        ["classify", "slider-crank", "--format", "latex"],
        ["report", "slider-crank", "-o", "page.html"],
        ["plot", "slider-crank", "--class", "1", "-o", "figure.svg"],
        ["gallery", "-o", "pages", "--only", "slider-crank"],
    ],
)
def test_an_open_number(
    command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main([*command, *WHOLE]) == 0
    request.getfixturevalue("uncounted")
    assert main([*command, *WHOLE]) == 3


@pytest.mark.parametrize("labels", [["5"], ["i"], ["iii", "vi"]])
def test_a_solution_set_that_is_cut_off(labels: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "zlatanov-2dof", *labels, *SHORT]) == 3
    assert "Undecided: " in capsys.readouterr().out


def test_a_check_that_sees_no_configuration(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Where the search finds none there is no rank to be seen, and nothing is said to be right."""
    monkeypatch.setattr("singsym.kinematics.mobility.sample_configurations", lambda *given: [])
    assert main(["check", "fourbar"]) == 3
    assert "no configuration was found" in capsys.readouterr().out
