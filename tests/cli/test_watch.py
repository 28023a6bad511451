"""What is said while commands work: a bar on a terminal, lines, nothing; and how far the work is."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from singsym.cli import main
from singsym.cli.parser import commands, parser
from singsym.cli.watch import Lines, Pace
from singsym.effort.progress import Event
from singsym.output.gallery_list import WIDTH


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SINGSYM_CACHE", str(tmp_path / "cache"))


# -- how far the work is -------------------------------------------------------------------------------


def test_what_is_left_counts_only_what_was_done_while_it_was_watched() -> None:
    """4 of 10 come from the cache at once; then one takes 6 s, so that the 5 others may take 30 s."""
    pace = Pace()
    pace.tell(Event("strata", "", 4, 10), 0.0)
    assert pace.left(3.0) is None
    assert pace.words(3.0) == "4 of 10"
    pace.tell(Event("engine", "groebner of 3 polynomials"), 4.0)
    pace.tell(Event("strata", "", 5, 10), 6.0)
    assert pace.left(6.0) == 30.0
    pace.tell(Event("loci", "", 0, 2), 7.0)
    assert pace.words(8.0) == "0 of 2"


def test_the_same_stage_again_begins_anew() -> None:
    pace = Pace()
    for done, now in ((0, 0.0), (3, 3.0), (0, 10.0), (1, 12.0)):
        pace.tell(Event("curves", "", done, 3), now)
    assert pace.left(12.0) == 4.0


def test_nothing_is_said_of_no_tasks() -> None:
    pace, lines = Pace(), Lines()
    pace.tell(Event("curves", "", 0, 0), 1.0)
    assert pace.words(1.0) == ""
    assert "0 of 0" not in lines.line(Event("curves", "", 0, 0), 1.0)


def test_lines_are_few_and_all_of_them_are_more() -> None:
    events = [Event("strata", "", i, 100) for i in range(100)] + [
        Event("engine", "x"),
        Event("loci", "", 0, 1),
    ]
    events += [Event("curve", "segments", 3)]
    few, many = Lines(), Lines(everything=True)
    assert sum(bool(few.line(e, 0.1 * i)) for i, e in enumerate(events)) == 3
    assert sum(bool(many.line(e, 0.1 * i)) for i, e in enumerate(events)) == len(events)


# -- what is printed -----------------------------------------------------------------------------------


def test_lines_off_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    work = ["classify", "slider-crank", "--workers", "1"]
    assert main(work) == 0
    usual = capsys.readouterr()
    assert usual.err == ""
    assert main([*work, "--no-cache", "--progress"]) == 0
    told = capsys.readouterr()
    lines = told.err.splitlines()
    assert [re.sub(r"^\d+ s: ", "", line) for line in lines] == [
        "(4): BC perpendicular to slide P",
        "(5): AB parallel to slide P; or AC perpendicular to slide P",
        "strata, 0 of 2",
        "real points, 0 of 6",
        "1 (RI, IO): occurs",
        "loci, 0 of 3",
    ]
    assert "0 of 0" not in told.err
    assert main([*work, "--no-cache", "--verbose"]) == 0
    assert len(capsys.readouterr().err.splitlines()) > len(lines)


def test_quiet_leaves_errors(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "mine", "--quiet"]) == 0
    assert capsys.readouterr().err == ""
    assert main(["new", "mine", "--quiet"]) == 2
    assert "there already" in capsys.readouterr().err


def test_one_way_of_talking_at_a_time(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["classify", "fourbar", "--quiet", "--verbose"])
    assert "not allowed with" in capsys.readouterr().err
    assert "--progress" in {name: options for name, options, _ in commands()}["solve"]


@pytest.mark.skipif(sys.platform == "win32", reason="terminals of POSIX")
def test_the_bar_on_a_terminal_counts_and_never_nothing() -> None:
    import pty

    master, slave = pty.openpty()
    command = [sys.executable, "-m", "singsym", "classify", "slider-crank", "--workers", "1"]
    done = subprocess.run(
        command, stdout=subprocess.DEVNULL, stderr=slave, cwd=Path(__file__).parents[2], timeout=120
    )
    os.set_blocking(master, False)
    seen = os.read(master, 1 << 20).decode()
    os.close(master)
    os.close(slave)
    assert done.returncode == 0
    assert re.search(r"[1-9] of [1-9]", seen)
    assert "1 (RI, IO)" in seen
    assert "0/0" not in seen
    assert "0 of 0" not in seen


# -- commands ------------------------------------------------------------------------------------------


def test_an_unknown_command_names_the_others(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["clasify", "fourbar"])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert "no command 'clasify'; did you mean classify?" in said
    assert all(name in said for name, _, _ in commands())
    assert max(map(len, said.splitlines())) <= 80


def test_help_keeps_names_as_they_are() -> None:
    shown = {
        c: a.description
        for s in parser()._actions
        if isinstance(s.choices, dict)
        for c, a in s.choices.items()
    }
    assert shown["show"] == "A mechanism's joints, loop equations, L and modules."
    assert "HTML" in shown["report"]
    assert "Table 1" in shown["classes"]


def test_the_list_fits_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list"]) == 0
    assert max(map(len, capsys.readouterr().out.splitlines())) <= WIDTH


def test_the_cache_is_shown_and_cleared(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    def shown(*options: str) -> tuple[int, int]:
        assert main(["cache", "--format", "json", *options]) == 0
        found = json.loads(capsys.readouterr().out)
        assert found["folder"] == str(tmp_path / "cache")
        return found["results"], found["bytes"]

    assert shown() == (0, 0)
    assert main(["classify", "slider-crank", "--workers", "1"]) == 0
    capsys.readouterr()
    stored = list((tmp_path / "cache").iterdir())
    assert shown() == (len(stored), sum(p.stat().st_size for p in stored))
    assert stored
    (tmp_path / "cache" / "mine.json.gz").write_text("not singsym's")
    assert main(["cache", "--clear"]) == 0
    assert f"Cleared {len(stored)} results" in capsys.readouterr().err
    assert [p.name for p in (tmp_path / "cache").iterdir()] == ["mine.json.gz"]
    assert shown() == (0, 0)
