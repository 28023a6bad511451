"""The command `singsym regions`: what it prints of two configurations, and its exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from singsym.cli import main


def file(folder: Path, angle: str) -> str:
    """A configuration of the arm of two links."""
    path = folder / f"{angle.replace(' ', '')}.toml"
    path.write_text(f'[joints]\nA = 0\nB = "{angle}"\n', encoding="utf-8")
    return str(path)


def test_joined_and_apart(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The elbow is bent to one side at 60 and 120 degrees, to the other at -60."""
    up, more, down = (file(tmp_path, f"{angle} deg") for angle in (60, 120, -60))
    assert main(["regions", "2r", "--from", up, "--to", more, "--format", "json", "--quiet"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["joined"] == "yes"
    assert len(found["path"]["B"]) == 2
    assert main(["regions", "2r", "--from", up, "--to", down, "--quiet"]) == 0
    assert "Not joined" in capsys.readouterr().out


def test_arcs_are_decided(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["regions", "slider-crank", "--quiet"]) == 0
    said = capsys.readouterr().out
    assert "2 regions without singularities, certified" in said
    assert "barriers, not singularities" in said


def test_what_is_missing_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["regions", "2r", "--to", file(tmp_path, "60 deg"), "--quiet"]) == 2
    assert "--to without --from" in capsys.readouterr().err


def test_of_which_configuration_a_box_is_where_values_leave_many(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One angle of two is given: the box is around one of a circle of configurations, which is said."""
    half = tmp_path / "half.toml"
    half.write_text('[joints]\nA = "30 deg"\n', encoding="utf-8")
    assert main(["regions", "2r", "--from", str(half), "--quiet"]) == 0
    note = f"{half}: the given values leave 1 freedom: one of many configurations is shown"
    assert f"Note: {note}." in capsys.readouterr().out
    assert main(["regions", "2r", "--from", str(half), "--format", "json", "--quiet"]) == 0
    assert json.loads(capsys.readouterr().out)["notes"] == [note]
