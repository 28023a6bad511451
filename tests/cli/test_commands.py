"""What the commands print, and their exit codes: 0 decided, 3 undecided, 2 usage or bad input."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import mpmath
import pytest

from singsym.cli import main


def data(capsys, *arguments):
    assert main([*arguments, "--format", "json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("SINGSYM_CACHE", str(tmp_path / "cache"))


def test_list_names_the_library(capsys):
    names = [m["name"] for m in data(capsys, "list")]
    assert {"zlatanov-2dof", "zlatanov-hybrid", "puma560", "stewart-gough"} <= set(names)
    assert main(["list"]) == 0
    text = capsys.readouterr().out
    assert all(name in text for name in names)


def test_show_has_the_papers_block_pattern(capsys):
    """(6) of the paper: 8 x 10, the zeros of the output rows and of the two loops."""
    found = data(capsys, "show", "zlatanov-2dof")
    assert (found["N"], found["n"]) == (8, 2)
    assert [len(found["L"]), len(found["L"][0])] == [8, 10]
    labels = [c["label"] for c in found["columns"]]
    zero_in_first_loop = {"T.x", "T.y", "E", "F", "G"}
    for row, entries in zip(found["rows"], found["L"], strict=True):
        if row.startswith("loop 1"):
            assert all(e == "0" for c, e in zip(labels, entries, strict=True) if c in zero_in_first_loop)


def test_show_writes_a_file_that_can_be_read_again(capsys, tmp_path):
    assert main(["show", "zlatanov-2dof", "--format", "toml"]) == 0
    path = tmp_path / "again.toml"
    path.write_text(capsys.readouterr().out)
    assert main(["check", str(path)]) == 0
    assert "No problem found" in capsys.readouterr().out


def test_conditions_of_the_linkage_are_the_papers(capsys):
    """Section 3.3: (vii) BCD or CGF collinear, (viii) ABC, CDG or EFG collinear."""
    found = {c["label"]: c for c in data(capsys, "conditions", "zlatanov-2dof")["conditions"]}
    words = {
        label: {f["words"] for a in found[label]["alternatives"] for f in a} for label in ("vii", "viii")
    }
    assert words["vii"] == {"B, C, D collinear", "C, F, G collinear"}
    assert words["viii"] == {"A, B, C collinear", "C, D, G collinear", "E, F, G collinear"}


def test_conditions_in_names_of_lengths_and_expanded(capsys):
    """The elbow of the PUMA in the letters of its DH table; L is printed when all is asked for."""
    assert main(["conditions", "puma560"]) == 0
    assert "or det[z1 O1O2 O1O4] = a2*(a3*s3 + d4*c3) = 0  (elbow: " in (text := capsys.readouterr().out)
    assert text.endswith("with a2 = 0.4318, a3 = 0.0203, d4 = 0.4318\n")
    found = data(capsys, "conditions", "puma560")
    assert found["lengths"]["a3"] == "203/10000"
    assert found["conditions"][1]["alternatives"][1][0]["in_lengths"] == "a3*s3 + d4*c3"
    assert main(["conditions", "puma560", "--expand"]) == 0
    assert "L, 6x12" in capsys.readouterr().out


def test_solution_sets_in_names_of_lengths(capsys):
    """A slotted lever, pivoted g = 2 from the crank, stands still where d = g s."""
    pieces = data(capsys, "solve", "crank-slotted-lever", "5", "--workers", "1")["solutions"][0]["pieces"]
    assert {(*p["equations"], *p["in_lengths"]) for p in pieces} == {("d_P - 2*s_block", "g*s_block - d_P")}
    assert main(["solve", "crank-slotted-lever", "5", "--workers", "1"]) == 0
    assert "g*s_block - d_P = 0" in capsys.readouterr().out


@pytest.mark.parametrize(("n", "count"), [(1, 9), (2, 19), (3, 21), (6, 21)])
def test_classes_counts_table_1(capsys, n, count):
    assert len(data(capsys, "classes", "--n", str(n))["classes"]) == count
    assert main(["classes", "--n", str(n)]) == 0
    assert f"The {count} classes" in capsys.readouterr().out


def test_classify_the_slider_crank(capsys):
    """Two dead centres, where the crank is in line with the rod: (RI, IO)."""
    found = data(capsys, "classify", "slider-crank", "--workers", "1")
    there = {tuple(c["types"]): c["points"] for c in found["classes"] if c["verdict"] == "yes"}
    assert there == {("RI", "IO"): 2}
    assert len(found["classes"]) == 21
    assert main(["classify", "slider-crank", "--workers", "1"]) == 0
    assert "impossible for n = 1" in capsys.readouterr().out


def test_solve_prints_pieces(capsys):
    found = data(capsys, "solve", "slider-crank", "5", "vi", "i", "--workers", "1")["solutions"]
    assert [s["condition"] for s in found] == ["5", "vi", "i"]
    assert [s["dimension"] for s in found] == [0, -1, 0]
    assert main(["solve", "slider-crank", "5", "--workers", "1"]) == 0
    assert "for instance" in capsys.readouterr().out


def test_at_a_dead_centre(capsys, tmp_path):
    path = tmp_path / "dead.toml"
    path.write_text("[points]\nB = [1, 0]\nC = [4, 0]\n")
    found = data(capsys, "at", "slider-crank", "--config", str(path))
    assert found["exact"]
    assert found["types"] == ["RI", "IO"]
    assert main(["at", "slider-crank", "--config", str(path)]) == 0
    assert "class 1 (RI, IO)" in capsys.readouterr().out


def arm(tmp_path: Path) -> str:
    path = tmp_path / "arm.toml"
    path.write_text(
        'inputs = ["A", "B"]\noutput = { velocity = "T" }\n[links]\nAB = 1\nBT = 1\n'
        'ground = { points = { A = [0, 0] } }\n[joints]\nA = "R"\nB = "R"\n'
    )
    return str(path)


def test_at_a_rank_that_is_unclear(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """An arm of two equal links bent by 1e-7: more than rounding, less than doubles can tell for sure."""
    path = tmp_path / "near.toml"
    path.write_text("[joints]\nA = 0.3\nB = 1e-7\n")
    arguments = ["at", arm(tmp_path), "--config", str(path)]
    assert main(arguments) == 3
    assert "undecided" in capsys.readouterr().out
    assert main([*arguments, "--format", "json"]) == 3
    found = json.loads(capsys.readouterr().out)
    assert "threshold" in found["undecided"]
    assert found["class"] is None
    assert main([*arguments, "--tolerance", "1e-12"]) == 0


def test_more_digits_go_in_and_come_out(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """T = (cos A + cos(A + B), ...) with A = 0 and B = 1e-7 to 30 digits: T.x = 1 + cos B."""
    path = tmp_path / "near.toml"
    path.write_text("[joints]\nA = 0\nB = 1.00000000000000000000000000001e-7\n")
    found = data(capsys, "at", arm(tmp_path), "--config", str(path))
    assert found["types"] == []
    assert found["undecided"] is None
    with mpmath.workdps(40):
        expected = 1 + mpmath.cos(mpmath.mpf("1.00000000000000000000000000001e-7"))
        assert abs(mpmath.mpf(found["points"]["T"][0]) - expected) < mpmath.mpf(10) ** -28


def test_a_configuration_without_an_end_is_refused(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "long.toml"
    path.write_bytes(b" " * 1_000_001)
    for name in (str(path), *(["/dev/zero"] if Path("/dev/zero").exists() else [])):
        assert main(["at", "fourbar", "--config", name]) == 2
        assert "more than 1000000 bytes" in capsys.readouterr().err


def test_new_writes_a_file_once(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "mine"]) == 0
    assert capsys.readouterr().out.strip() == "mine.toml"
    assert main(["check", "mine.toml"]) == 0
    assert main(["new", "mine"]) == 2
    assert "there already" in capsys.readouterr().err
    assert main(["new", "mine", "--force"]) == 0
    assert main(["new", "../mine"]) == 2


def test_plot_and_report_write_files(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["plot", "slider-crank", "-o", "m.svg"]) == 0
    assert main(["plot", "slider-crank", "--class", "1", "-o", "c.png", "--workers", "1"]) == 0
    assert main(["report", "slider-crank", "--workers", "1"]) == 0
    assert capsys.readouterr().out.split() == ["m.svg", "c.png", "slider-crank.html"]
    assert (tmp_path / "m.svg").read_text().lstrip().startswith("<?xml")
    assert (tmp_path / "c.png").read_bytes().startswith(b"\x89PNG")
    assert main(["plot", "slider-crank", "--class", "4", "-o", "c.png", "--workers", "1"]) == 2
    assert main(["plot", "slider-crank", "-o", "none/c.png"]) == 2


def test_what_cannot_be_drawn_is_refused_before_the_work(capsys, tmp_path, monkeypatch):
    """No class has the number 22, no picture the ending `.foo`: nothing is classified or followed."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("singsym.classes.classify.classify", lambda *given, **options: pytest.fail("works"))
    monkeypatch.setattr("singsym.motion.follow.follow", lambda *given, **options: pytest.fail("works"))
    for number in ("0", "22", "x"):
        with pytest.raises(SystemExit) as exit_:
            main(["plot", "slider-crank", "--class", number])
        assert exit_.value.code == 2
        assert "1 to 21" in capsys.readouterr().err
    assert main(["plot", "slider-crank", "--class", "1", "-o", "c.foo"]) == 2
    Path("way.csv").write_text("t,A\n0,0\n1,1\n")
    assert main(["follow", "slider-crank", "way.csv", "-o", "c.foo"]) == 2
    assert capsys.readouterr().err.count("expected a file name that ends in") == 2


def test_freedoms_that_a_start_leaves_are_said(capsys, tmp_path, monkeypatch):
    """The five-bar has two freedoms; A alone leaves one."""
    monkeypatch.chdir(tmp_path)
    Path("way.csv").write_text("t,A deg,E deg\n0,40,120\n1,45,115\n")
    Path("part.toml").write_text('[joints]\nA = "40 deg"\n')
    for options in ([], ["--format", "json"]):
        assert main(["follow", "five-bar", "way.csv", "--config", "part.toml", *options]) in (0, 3)
        said = capsys.readouterr().out
        assert "part.toml: the given values leave 1 freedom" in said
        assert not options or "notes" in json.loads(said)


def test_cusps_and_self_motions(capsys, tmp_path):
    """Both solution sets of cusps; a redundant arm with its hand at rest has a curve of configurations."""
    found = data(capsys, "solve", "orthogonal-3r", "cusps", "--workers", "1")["solutions"]
    assert [(s["condition"], s["verdict"]) for s in found] == [("cusps 4", "no"), ("cusps 5", "yes")]
    arm, here = tmp_path / "arm.toml", tmp_path / "here.toml"
    arm.write_text(
        'name = "arm"\ntitle = "arm"\nsource = "own"\ninputs = ["A", "B", "C"]\noutput = {velocity = "D"}\n'
        "[links]\nground = {points = {A = [0, 0]}}\nAB = 2\nBC = 2\nCD = 1\n"
        '[joints]\nA = "R"\nB = "R"\nC = "R"'
    )
    here.write_text('[joints]\nA = "30 deg"\nB = "60 deg"\nC = 0')
    assert main(["at", str(arm), "--config", str(here)]) == 2
    inputs, outputs = data(capsys, "at", str(arm), "--config", str(here), "--self-motions")["self_motions"]
    assert (inputs["dimension"], outputs["dimension"], outputs["null_motions"]) == (0, 1, 1)
    picture = tmp_path / "curve.svg"
    drawn = ["at", str(arm), "--config", str(here), "--self-motions", "-o", str(picture)]
    assert main(drawn) == 0
    assert "<svg" in picture.read_text()
    here.write_text("[joints]\nA = 0.3")
    assert main(["at", "slider-crank", "--config", str(here), "-o", str(picture)]) == 2
    assert "found -o without --self-motions" in capsys.readouterr().err
    assert main(["at", "slider-crank", "--config", str(here), "--self-motions"]) == 3
    assert "Self-motion undecided, with the inputs at rest" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("chosen", "said"),
    [
        (["--parameters", ","], "found --parameters ','; expected one or two names, as --parameters a,b"),
        (["--values", "a=1", "--values", "a=2"], "found --values a twice; expected all in one"),
        (["--values", "a=-1"], "found the value -1; expected a value above 0"),
    ],
)
def test_what_a_design_cannot_vary_is_said(capsys, chosen, said):
    assert main(["design", "fourbar", *chosen, "--quiet"]) == 2
    assert said in capsys.readouterr().err


def test_set_changes_a_parameter_within_its_range(capsys):
    assert data(capsys, "show", "zlatanov-hybrid", "--set", "a=3/2")["parameters"] == []
    for setting in ("a=3", "b=1", "a", "a=__import__('os')"):
        assert main(["show", "zlatanov-hybrid", "--set", setting]) == 2
        assert capsys.readouterr().err


@pytest.mark.parametrize(
    "text",
    [
        "",
        "x = [",
        "[links]\n",
        'inputs = ["Z"]\noutput = {rate = "Q"}\n[links]\nground = 1\n[joints]\nA = "R"',
    ],
)
def test_bad_files_end_with_a_paragraph(capsys, tmp_path, text):
    path = tmp_path / "bad.toml"
    path.write_text(text)
    for command in ("check", "conditions", "classify", "show"):
        assert main([command, str(path)]) == 2
        captured = capsys.readouterr()
        assert captured.out == ""
        assert "bad.toml" in captured.err
        assert "Traceback" not in captured.err


def test_missing_files_and_binary_configurations(capsys, tmp_path):
    assert main(["check", "no-such-thing"]) == 2
    assert "no-such-thing" in capsys.readouterr().err
    assert main(["check", str(tmp_path / "no.urdf")]) == 2
    (tmp_path / "c.toml").write_bytes(b"\xff\xfe\x00")
    assert main(["at", "fourbar", "--config", str(tmp_path / "c.toml")]) == 2
    assert main(["at", "fourbar", "--config", str(tmp_path)]) == 2
    (tmp_path / "d.toml").write_text("[joints]\nQ = 1")
    assert main(["at", "fourbar", "--config", str(tmp_path / "d.toml")]) == 2
    assert "expected one of A, B, C, D" in capsys.readouterr().err


@pytest.mark.parametrize(
    "arguments",
    [
        ["nonsense"],
        ["classes", "--n", "0"],
        ["solve", "fourbar", "ix"],
        ["classify", "fourbar", "--budget", "-1"],
    ],
)
def test_usage_errors(arguments, capsys):
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert stop.value.code == 2
    assert "usage: singsym" in capsys.readouterr().err


def test_a_budget_too_small_is_undecided(capsys):
    arguments = ["classify", "zlatanov-2dof", "--budget", "0.001", "--workers", "1", "--no-cache"]
    assert main([*arguments, "--format", "json"]) == 3
    found = json.loads(capsys.readouterr().out)
    assert {c["verdict"] for c in found["classes"]} >= {"undecided"}
    assert main(arguments) == 3
    assert "\nOpen\n" in capsys.readouterr().out


def test_help_fits_a_screen_and_engines_are_listed(capsys):
    with pytest.raises(SystemExit):
        main(["--help"])
    assert len(capsys.readouterr().out.splitlines()) <= 48
    assert {e["name"] for e in data(capsys, "engines")} == {"flint", "msolve", "singular", "sympy"}


def test_completion_is_valid_shell(capsys):
    assert main(["completion", "bash"]) == 0
    script = capsys.readouterr().out
    assert "zlatanov-2dof" in script
    assert subprocess.run(["bash", "-n"], input=script, text=True, check=False).returncode == 0


def run(*arguments, **options):
    return subprocess.run(
        [sys.executable, "-m", "singsym", *arguments], capture_output=True, text=True, check=False, **options
    )


def test_characters_that_a_terminal_lacks_are_no_error():
    """The elbow of the PUMA is at angles that are rounded, with a sign that ASCII has not."""
    done = run("conditions", "puma560", env={**os.environ, "PYTHONIOENCODING": "ascii"})
    assert (done.returncode, done.stderr) == (0, "")
    assert "J3 ? -87.3 or 92.7 deg" in done.stdout


def test_a_closed_pipe_is_no_error():
    command = f"{sys.executable} -m singsym list | head -n 1"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert done.stderr == ""


def test_the_commands_that_need_no_solver_load_none():
    """Cold start: what takes long to import stays out until it is needed."""
    code = (
        "import sys; from singsym.cli import main; main(['conditions', 'zlatanov-2dof']); "
        "print([m for m in ('matplotlib', 'rich', 'numpy', 'scipy') if m in sys.modules],"
        " file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stderr.strip() == "[]"


def test_tables_on_a_narrow_terminal_are_whole(monkeypatch, capsys):
    """Every word of the plain table is on the screen of 80 columns as well, nothing cut off with dots."""
    assert main(["classify", "slider-crank", "--workers", "1"]) == 0
    plain = capsys.readouterr().out
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    assert main(["classify", "slider-crank", "--workers", "1"]) == 0
    shown = re.sub(r"\x1b\[[0-9;]*m", "", capsys.readouterr().out)
    assert "…" not in shown
    assert max(map(len, shown.splitlines())) <= 80
    assert {w for w in plain.split() if w.isalpha()} == {w for w in shown.split() if w.isalpha()}


def test_dimensions_that_count_a_parameter_are_said_to(capsys: pytest.CaptureFixture[str]) -> None:
    """With the rod's length left open the two dead centres of a slider-crank are curves."""
    found = data(capsys, "classify", "slider-crank", "--set", "l=", "--no-cache")
    assert found["parameters"] == ["l"]
    assert found["classes"][0]["dimension"] == 1
    assert main(["classify", "slider-crank", "--set", "l=", "--no-cache"]) == 0
    assert "dimensions count l" in capsys.readouterr().out
    assert main(["classify", "slider-crank", "--set", "l=", "--no-cache", "--format", "latex"]) == 0
    assert "dimensions count l" in capsys.readouterr().out
