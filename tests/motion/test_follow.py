"""Motions followed with proof: times and classes of singularities worked out by hand."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from singsym.classes.configuration.at import at
from singsym.cli import main
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import MechanismError, load
from singsym.motion.follow import FollowedMotion, Passage, follow
from singsym.motion.numeric import numeric
from singsym.motion.trajectory import Trajectory
from singsym.output.motion.follow_page import follow_page, plot_margins
from singsym.output.page import plain
from singsym.polynomials.compiled_map import numerical_matrix

CRANK = {"joints": {"A": 0.3}, "points": {"C": [3.941, 0]}}


def assert_is_null(found: FollowedMotion, passage: Passage) -> None:
    """L m = 0 for the motions that are no restrictions."""
    equation = found.equation
    q = np.array([passage.values[name] for name in equation.space.ring.names])
    L = numerical_matrix(equation.L, q)
    for motion in passage.motions:
        m = np.array([motion.rates.get(c.label, 0.0) for c in equation.columns])
        if not motion.restriction:
            assert L @ m == pytest.approx(0, abs=1e-6)


def test_puma_passes_its_wrist_singularity_on_a_line_of_the_joints() -> None:
    """J5 goes from 0.5 to -0.6 in two seconds: the axes of J4 and J6 are one at t = 2 * 5/11."""
    line = {"J1": [0.3, 0.4], "J2": [0.3, 0.3], "J3": [0.3, 0.3], "J4": [0.3, 0.3], "J6": [0.3, 0.2]}
    found = follow(load("puma560"), Trajectory.of({**line, "J5": [0.5, -0.6]}, [0, 2]))
    assert found.until == 2
    assert found.is_decided
    (wrist,) = found.passages
    assert wrist.kind == "met"
    assert wrist.start <= 10 / 11 <= wrist.end
    assert wrist.end - wrist.start < 1e-8
    assert wrist.types_certified
    assert wrist.singularity_class is not None
    assert wrist.singularity_class.number == 1
    assert {m.type.name for m in wrist.motions} == {"RI", "IO"}
    turned = next(m.rates for m in wrist.motions if m.type.name == "RI")
    assert turned["J4"] == pytest.approx(-turned["J6"])
    assert_is_null(found, wrist)


def test_puma_moves_its_wrist_centre_on_a_straight_line() -> None:
    """The tool point, which is the wrist centre, from one place to another while J5 goes through zero."""
    arm = load("puma560")
    linkage = numeric(arm)
    joints = dict(zip(linkage.inputs, (0.4, -0.5, 0.9, 0.4, 0.4, 0.4), strict=True))
    q = linkage.configurations(joints, ())
    x, y, z = linkage.points(q)["tool"].tolist()
    start = at(arm, {"variables": dict(zip(linkage.names, q.tolist(), strict=True))})
    ways = {"tool.x": [x, x - 0.02], "tool.y": [y, y + 0.03], "tool.z": [z, z], "J4": [0.4, 0.4]}
    found = follow(arm, Trajectory.of({**ways, "J5": [0.4, -0.4], "J6": [0.4, 0.4]}), start=start)
    assert [(p.kind, str(p.types), p.types_certified) for p in found.passages] == [("met", "RI, IO", True)]
    assert found.passages[0].start <= 0.5 <= found.passages[0].end
    ends = linkage.points(found.configurations)["tool"]
    assert ends == pytest.approx(
        np.outer(1 - found.times, [x, y, z]) + np.outer(found.times, ends[-1]), abs=1e-9
    )


def test_a_crank_in_turn_meets_both_dead_points() -> None:
    """One turn from 0.3 rad: at pi, and at 2 pi, of class 1; regular in between, the slide moves 4 to 2."""
    crank = load("slider-crank")
    turn = Trajectory.of({"A": np.linspace(0.3, 0.3 + 2 * math.pi, 5)}, np.linspace(0, 1, 5))
    found = follow(crank, turn, start=at(crank, CRANK))
    assert found.is_decided
    times = [(math.pi - 0.3) / (2 * math.pi), (2 * math.pi - 0.3) / (2 * math.pi)]
    assert [p.kind for p in found.passages] == ["met", "met"]
    for passage, time in zip(found.passages, times, strict=True):
        assert passage.start - 1e-12 <= time <= passage.end + 1e-12
        assert passage.types_certified
    slides = numeric(crank).joints(found.configurations)["P"]
    assert slides.max() == pytest.approx(4, abs=1e-3)
    assert slides.min() == pytest.approx(2, abs=1e-3)


def test_a_slide_cannot_be_driven_beyond_the_dead_point() -> None:
    """From 3.94 to 5: at most 4 is in reach, so that the motion is proven up to there alone."""
    crank = load("slider-crank")
    start = at(crank, CRANK)
    slide = start.joints["P"]
    found = follow(crank, Trajectory.of({"P": [slide, 5.0]}), start=start)
    assert not found.is_decided
    assert found.until == pytest.approx((4 - slide) / (5 - slide), abs=1e-6)
    assert found.until <= (4 - slide) / (5 - slide)
    (end,) = found.passages
    assert (end.kind, str(end.types), end.types_certified) == ("end", "RI, IO", False)
    assert end.words == "AB parallel to slide P"


def test_turning_back_before_is_narrow_and_touching_is_open() -> None:
    """The crank turns back 0.02 rad before its dead point, then just at it."""
    crank = load("slider-crank")
    start = at(crank, CRANK)
    narrow = follow(crank, Trajectory.of({"A": [0.3, 0.02, 0.3]}), start=start)
    assert narrow.is_decided
    (near,) = narrow.passages
    assert (near.kind, near.start, near.condition) == ("narrow", 1.0, "5")
    assert 0 < near.margin < 0.02
    touching = follow(crank, Trajectory.of({"A": [0.3, 0.0, 0.3]}), start=start)
    (open_,) = touching.passages
    assert open_.kind == "open"
    assert open_.start <= 1 <= open_.end
    assert not touching.is_decided
    through = follow(crank, Trajectory.of({"A": [0.3, 0.0, -0.3]}), start=start)
    (met,) = through.passages
    assert met.kind == "met"
    assert met.start <= 1 <= met.end


def test_the_assembly_mode_is_that_of_the_start() -> None:
    """Against closed forms on a coarse grid: the motion is on one mode throughout."""
    five_bar = load("five-bar")
    linkage = numeric(five_bar)
    for mode in linkage.modes(linkage.inputs):
        q = linkage.configurations({"A": 1.6, "E": -2.0}, mode)
        start = at(five_bar, {"variables": dict(zip(linkage.names, q.tolist(), strict=True))})
        found = follow(five_bar, Trajectory.of({"A": [1.6, 2.2], "E": [-2.0, -1.5]}), start=start)
        assert found.until == 1
        values = {"A": 1.6 + 0.6 * found.times, "E": -2 + 0.5 * found.times}
        assert found.configurations == pytest.approx(linkage.configurations(values, mode), abs=1e-8)


def test_what_is_called_regular_has_no_change_of_sign() -> None:
    """Between passages the factors of (4) and (5) keep their signs on samples; one changes at each."""
    five_bar = load("five-bar")
    linkage = numeric(five_bar)
    q = linkage.sample(1, seed=3)[0]
    joints = linkage.joints(q)
    start = at(five_bar, {"variables": dict(zip(linkage.names, q.tolist(), strict=True))})
    ways = {"A": [joints["A"], joints["A"] + 1.5], "E": [joints["E"], joints["E"] - 1.5]}
    found = follow(five_bar, Trajectory.of(ways), start=start)
    assert found.until == 1
    signs = np.sign(linkage.condition("5", found.configurations))
    changes = int((np.abs(np.diff(signs, axis=0)) == 2).sum())
    assert changes == len([p for p in found.passages if p.condition == "5"]) > 0
    assert (np.diff(np.sign(linkage.condition("4", found.configurations)), axis=0) == 0).all()


def test_wrong_trajectories_say_what_is_right(tmp_path: Path) -> None:
    five_bar = load("five-bar")
    with pytest.raises(MechanismError, match="2 beside the time"):
        follow(five_bar, Trajectory.of({"A": [0.0, 1.0]}))
    with pytest.raises(MechanismError, match="tell them apart"):
        follow(five_bar, Trajectory.of({"A": [0.0, 1.0], "E": [0.0, 1.0]}))
    with pytest.raises(MechanismError, match="a configuration to start from"):
        follow(five_bar, Trajectory.of({"C.x": [0.0, 1.0], "C.y": [3.0, 3.0]}))
    with pytest.raises(MechanismError, match="found Z"):
        follow(five_bar, Trajectory.of({"A": [0.0, 1.0], "Z": [0.0, 1.0]}))
    for text, said in (
        ("t,A\n0,1\n", "1 rows"),
        ("t,A\n0,1\n0,2\n", "rising times"),
        ("t,A\n0,x\n1,2\n", "found x; expected a number"),
        ("t,A\n0\n1,2\n", "1 cells"),
        ("A,A\n0,1\n1,2\n", "different names"),
        ("", "0 rows"),
        ("t,A\n0,nan\n1,2\n", "finite numbers"),
    ):
        with pytest.raises(MechanismError, match=said):
            Trajectory.from_csv(text)


def test_which_way_an_angle_goes_has_to_be_clear() -> None:
    """From 3.1 to -3.1 may be nearly a turn back, or across pi, where the crank is in line."""
    crank = load("slider-crank")
    start = at(crank, {"joints": {"A": 3.1, "P": 2.0}})
    with pytest.raises(MechanismError, match=r"A changes by 355\.2 degrees"):
        follow(crank, Trajectory.of({"A": [3.1, -3.1]}), start=start)
    found = follow(crank, Trajectory.of({"A": [3.1, -3.1]}).unwrapped(["A"]), start=start)
    (met,) = found.passages
    assert met.start <= 0.5 <= met.end


def test_the_page_and_the_picture_say_what_was_found() -> None:
    crank = load("slider-crank")
    turn = Trajectory.of({"A": [0.3, 3.4]})
    found = follow(crank, turn, start=at(crank, CRANK))
    page = plain(follow_page("crank", found))
    assert "followed on one assembly mode with proof" in page
    assert "singular" in page
    picture = plot_margins(found)
    assert picture.svg().startswith("<svg")
    assert "1 singularity is met" in picture.description


def test_at_the_shell(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    way, start, picture = tmp_path / "way.csv", tmp_path / "start.toml", tmp_path / "margins.svg"
    way.write_text("t, A deg\n0, 20\n1, 100\n")
    start.write_text("[joints]\nA = '20 deg'\nP = 3.92\n")
    command = ["follow", "slider-crank", str(way), "--config", str(start), "-o", str(picture)]
    assert main(command) == 0
    assert "Proven: no singularity is met." in capsys.readouterr().out
    assert picture.exists()
    assert main([*command, "--format", "json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["decided"] is True
    assert data["proven_until"] == 1
    assert main(["follow", "fourbar", str(way)]) == 2
    assert "--config" in capsys.readouterr().err
    assert main(["follow", "slider-crank", str(tmp_path / "none.csv")]) == 2
    assert "cannot be read" in capsys.readouterr().err
    assert main([*command[:-1], str(tmp_path / "margins.xyz")]) == 2


def test_equations_without_values_are_refused() -> None:
    assert velocity_equation(load("zlatanov-hybrid")).space.parameters
    with pytest.raises(MechanismError, match="no value of a"):
        follow(load("zlatanov-hybrid"), Trajectory.of({"A1": [0.0, 1.0]}))
