"""URDF files and the options that choose parts of a mechanism, at the shell."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from singsym.cli import main
from tests.mechanism.urdf.files import arm, joint, write

ROBOT = [*arm(6), joint("fixed", "l6", "tool0"), joint("revolute", "l2", "lamp", axis="1 0 0", limit="-1 1")]


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SINGSYM_CACHE", str(tmp_path / "cache"))


def failed(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(list(arguments)) == 2
    found = capsys.readouterr()
    assert found.out == ""
    return found.err


def test_show_lists_chains_and_limits(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Where no chain is clear too; with a tip the mechanism follows."""
    path = str(write(tmp_path, *ROBOT))
    assert main(["show", path]) == 0
    text = capsys.readouterr().out
    assert "tool0  6" in text
    assert "-1 to 1" in text
    assert "Not yet a mechanism to be analysed" in text
    assert "--tip tool0" in text
    assert main(["show", path, "--tip", "tool0"]) == 0
    text = capsys.readouterr().out
    assert "Chain from l0 to tool0, 6 moving joints: as asked for." in text
    assert "Output: the twist of l6 at tool" in text
    assert main(["show", path, "--format", "json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert [tip["link"] for tip in data["robot"]["tips"]] == ["tool0", "lamp"]
    assert "2 chains" in data["problem"]
    assert main(["show", path, "--tip", "tool0", "--format", "json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert (data["n"], data["robot"]["joints"][-1]["limits"]) == (6, [-1, 1])
    # what is asked for and is not there is a fault, as is a form that robots do not have
    assert "no link" not in failed(capsys, "show", path, "--tip", "hand")
    assert "2 chains" in failed(capsys, "show", path, "--format", "toml")
    assert "2 chains" in failed(capsys, "conditions", path)


def test_parts_of_a_robot(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = str(write(tmp_path, *ROBOT))
    options = ["--tip", "tool0", "--base", "l1", "--lock", "to_l2=30 deg", "--lock", "to_l3=0.5"]
    assert main(["show", path, *options, "--components", "vx,vz", "--components", "wy"]) == 0
    text = capsys.readouterr().out
    assert "Output: the twist of l6 at tool (vx, vz, wy)" in text
    assert "Locked: to_l2 at pi/6." in text
    assert main(["show", path, "--tip", "tool0", "--joints", "to_l1,to_l2,to_l3"]) == 0
    assert "Inputs: to_l1, to_l2, to_l3\n" in capsys.readouterr().out
    assert "as --lock elbow=0" in failed(capsys, "show", path, "--lock", "to_l1")
    assert "as --lock elbow=0" in failed(capsys, "show", path, "--lock", "to_l1=")


def test_a_redundant_arm(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Seven joints: conditions by the rank; the classes only with a joint held, and that call is named."""
    path = str(write(tmp_path, *arm(7)))
    assert main(["conditions", path]) == 0
    text = capsys.readouterr().out
    assert text.count("RI in every configuration") == 1
    assert "(5) rank L_O < 6: IO" in text
    assert main(["conditions", path, "--format", "json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert (data["everywhere"], [c["label"] for c in data["conditions"]]) == (["RI"], ["5"])
    assert main(["conditions", path, "--format", "latex"]) == 0
    assert r"\operatorname{rank} L_O(q) < 6" in capsys.readouterr().out
    for command in ("classify", "check", "plot"):
        assert "--lock to_l3=0; `singsym conditions`" in failed(capsys, command, path)
    assert main(["conditions", path, "--lock", "to_l3=0"]) == 0
    assert "(viii) L_O is singular" in capsys.readouterr().out


def test_a_planar_arm_with_a_point(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Three joints and two components: held at its last joint it is an arm of two, straight or folded."""
    path = tmp_path / "3r.toml"
    path.write_text(
        'inputs = ["A", "B", "C"]\noutput = { velocity = "T" }\n[links]\n'
        'ground = { points = { A = [0, 0] } }\nAB = 2\nBC = 2\nCT = 1\n[joints]\nA = "R"\nB = "R"\nC = "R"\n',
        encoding="utf-8",
    )
    assert "hold an input, as --lock C=0" in failed(capsys, "classify", str(path))
    assert main(["classify", str(path), "--lock", "C=0", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    there = [(c["types"], c["components"]) for c in found["classes"] if c["verdict"] == "yes"]
    assert there == [(["RI", "IO"], 2)]
    assert main(["conditions", str(path), "--components", "w,vx,vy"]) == 0
    assert "4*s_B" in capsys.readouterr().out


def test_other_files_of_robots(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, text, words in (
        ("a.sdf", "<sdf/>", "SDF, the format of Gazebo"),
        ("a.xml", "<mujoco/>", "MJCF, the format of MuJoCo"),
        ("a.xacro", "<robot/>", "xacro a.xacro > robot.urdf"),
        ("a.world", "joints", "text that is no XML"),
        ("a.urdf", "<robot><link name='a'/></robot>", "no moving joint"),
    ):
        (tmp_path / name).write_text(text, encoding="utf-8")
        assert words in failed(capsys, "classify", str(tmp_path / name))
