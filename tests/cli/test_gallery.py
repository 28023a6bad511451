"""`singsym list` and `singsym gallery`: what they print and write, and what an interruption leaves."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import pytest

from singsym.classes.result import Classification
from singsym.cli import gallery, main
from singsym.mechanism import library


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SINGSYM_CACHE", str(tmp_path / "cache"))


def test_list_shows_kind_size_source_and_classes(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list", "--format", "json"]) == 0
    listed = {m["name"]: m for m in json.loads(capsys.readouterr().out)}
    assert list(listed) == list(library.names())
    linkage = listed["zlatanov-2dof"]
    assert (linkage["kind"], linkage["N"], linkage["n"]) == ("planar, 2 loops", 8, 2)
    assert linkage["classes"] == [1, 2, 3, 4]
    assert linkage["complete"]
    assert all(m["source"] for m in listed.values())
    assert main(["list"]) == 0
    rows = capsys.readouterr().out.splitlines()
    (row,) = (line for line in rows if line.startswith("zlatanov-2dof:"))
    assert row == "zlatanov-2dof: planar, 2 loops, N = 8, n = 2; classes 1 2 3 4"
    assert any("Zlatanov, Fenton, Benhabib" in line for line in rows)


def test_pages_and_index(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "new" / "pages"
    command = ["gallery", "-o", str(folder), "--workers", "1", "--only", "fourbar", "scara"]
    assert main([*command, "--only", "fourbar"]) == 0
    captured = capsys.readouterr()
    assert captured.out.strip() == str(folder / "index.html")
    assert [line.split(",")[0] for line in captured.err.splitlines()] == ["1 of 2: fourbar", "2 of 2: scara"]
    assert sorted(p.name for p in folder.iterdir()) == ["fourbar.html", "index.html", "scara.html"]
    index = (folder / "index.html").read_text(encoding="utf-8")
    for target in ("fourbar.html#class-1", "scara.html"):
        assert f'href="{target}"' in index
    assert 'id="class-1"' in (folder / "fourbar.html").read_text(encoding="utf-8")


def test_an_interruption_leaves_what_is_done_and_the_same_command_goes_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    command = ["gallery", "-o", str(tmp_path), "--workers", "1", "--only", "fourbar", "scara"]
    whole = gallery.classified

    def stopped(chosen: argparse.Namespace) -> Classification:
        if chosen.mechanism == "scara":
            raise KeyboardInterrupt("strata")
        return whole(chosen)

    monkeypatch.setattr(gallery, "classified", stopped)
    assert main(command) == 130
    message = capsys.readouterr().err
    assert (
        "interrupted during strata; finished parts are kept: the same command goes on from there" in message
    )
    assert "1 of 2 are not classified yet" in (tmp_path / "index.html").read_text(encoding="utf-8")
    kept = set((tmp_path / "cache").iterdir())
    monkeypatch.setattr(gallery, "classified", whole)
    assert main(command) == 0
    assert "not classified yet" not in (tmp_path / "index.html").read_text(encoding="utf-8")
    assert kept <= set((tmp_path / "cache").iterdir())


def test_what_is_undecided_ends_with_3(tmp_path: Path) -> None:
    command = ["gallery", "-o", str(tmp_path), "--workers", "1", "--budget", "0.001", "--no-cache"]
    assert main([*command, "--only", "zlatanov-2dof"]) == 3


def test_names_and_folders_that_are_wrong(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["gallery", "-o", str(tmp_path), "--only", "fourbat"]) == 2
    assert "did you mean fourbar?" in capsys.readouterr().err
    file = tmp_path / "file"
    file.write_text("")
    assert main(["gallery", "-o", str(file), "--workers", "1", "--only", "scara"]) == 2
    assert "cannot be written" in capsys.readouterr().err
