"""What is no URDF is told what it is; what is wrong with a URDF file is said in a sentence."""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path

import pytest

from singsym.mechanism import Choice, MechanismError, dumps, load, loads
from singsym.mechanism.urdf.robot_file import read_robot
from tests.mechanism.urdf.files import joint, robot

CASES = Path(__file__).parents[2] / "cases"
LINKS = '<link name="a"/><link name="b"/>'
ENDS = '<parent link="a"/><child link="b"/>'


def said(path: Path, text: str) -> str:
    path.write_text(text, encoding="utf-8")
    with pytest.raises(MechanismError) as caught:
        read_robot(path)
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "an empty file"),
        ("no xml", "text that is no XML"),
        ("<robot", "no XML: unclosed token: line 1"),
        ('<?xml version="1.0" encoding="nan"?><robot/>', "no XML: unknown encoding: nan"),
        ("<sdf><model/></sdf>", "rod --file robot.urdf -o robot.urdf"),
        ("<sdf><model/></sdf>", "SDF, the format of Gazebo; expected URDF"),
        ("<sdf><world/></sdf>", "a world in SDF"),
        (
            "<mujoco/>",
            "MJCF, the format of MuJoCo; expected URDF: <robot> with links and joints; singsym.mech",
        ),
        ("<html/>", "XML that starts with <html>"),
        ("<robot><xacro:include filename='x'/></robot>", "run xacro first"),
        (f"<!DOCTYPE r [<!ENTITY x '{LINKS}'>]><robot>&x;</robot>", "the entity 'x'"),
        (f"<robot>{LINKS}<joint type='revolute'>{ENDS}</joint></robot>", "joint number 1: found no name"),
        (f"<robot>{LINKS}<joint name='j'>{ENDS}</joint></robot>", "joint j: found no type"),
        (f"<robot>{LINKS}<joint name='j' type='ball'>{ENDS}</joint></robot>", "the type 'ball'"),
        (f"<robot>{LINKS}<joint name='j' type='revolute'/></robot>", "joint j: found no <parent>"),
        (robot(joint("revolute", "a", "b", xyz="0 0")), 'found <origin xyz="0 0">; expected three numbers'),
        (robot(joint("revolute", "a", "b", rpy="nan 0 0")), "expected three numbers"),
        (robot(joint("revolute", "a", "b", xyz="1e400 0 0")), "expected three numbers"),
        (robot(joint("revolute", "a", "b", axis="0 0 0")), "found the axis 0 0 0; expected a direction"),
        (robot(joint("revolute", "a", "b", limit="x 1")), '<limit lower="x">; expected a number'),
        (f"<robot>{LINKS}{joint('revolute', 'a', 'c')}</robot>", "the child 'c', which is no link"),
        (robot(joint("revolute", "a", "c"), joint("revolute", "b", "c", name="k")), "the child of 2 joints"),
        (robot(joint("revolute", "a", "b"), joint("revolute", "b", "a")), "a circle of parents"),
        (
            robot(joint("revolute", "a", "b"), joint("revolute", "b", "c", name="to_b")),
            "2 joints of this name",
        ),
        (robot(joint("revolute", "a", "b", mimic="")), "<mimic> without a joint"),
    ],
)
def test_one_sentence(tmp_path: Path, text: str, words: str) -> None:
    found = said(tmp_path / "robot.urdf", text)
    assert words in found
    assert len(found) < 400


JUNK = (
    "",
    "nan",
    "1e400",
    "-0",
    "1 2",
    "0 0 0",
    "0.33333333333333331 1e-7 2",
    "x",
    "planar",
    "b",
    "2",
    "1" * 80,
)


def test_whatever_an_attribute_says(tmp_path: Path) -> None:
    """Each attribute with each value: a mechanism that can be written and read, or a `MechanismError`."""
    first = joint("revolute", "a", "b", xyz="0.1 0 0", rpy="0 1.5708 0", axis="0 0 1", limit="-1 2")
    second = joint("prismatic", "b", "c", xyz="0 0.2 0", axis="1 1 0", mimic='joint="to_x" offset="0"')
    text = robot(first, second)
    path = tmp_path / "robot.urdf"
    read = 0
    for place in re.finditer(r'="([^"]*)"', text):
        for word in JUNK:
            path.write_text(text[: place.start(1)] + word + text[place.end(1) :], encoding="utf-8")
            with suppress(MechanismError):
                found = load(path, Choice(components=("vx", "wz")))
                assert loads(dumps(found), origin=str(path)) == found
                read += 1
    assert read > 50


def test_names_of_files(tmp_path: Path) -> None:
    """xacro by its name even without macros; a mechanism of CUIK in a .world file is no XML."""
    assert "xacro arm.xacro > robot.urdf" in said(tmp_path / "arm.xacro", robot(joint("fixed", "a", "b")))
    path = tmp_path / "loops.world"
    path.write_text("[CONSTANTS]\n  l := 1\n", encoding="utf-8")
    with pytest.raises(MechanismError, match=r"a world of CUIK, or .* no XML.*singsym new"):
        load(path)
    path = tmp_path / "robot.txt"
    path.write_text(robot(joint("prismatic", "a", "b", axis="0 0 1")), encoding="utf-8")
    assert load(path).inputs == ("to_b",)


def test_what_does_not_matter_is_passed_over(tmp_path: Path) -> None:
    """Undeclared prefixes, meshes that are not there, commas, blank lines before the declaration, no name."""
    path = tmp_path / "r.urdf"
    visual = "<visual><geometry><mesh/></geometry></visual>"
    path.write_text(
        f"\n<?xml version='1.0'?><robot><link name='a'>{visual}</link><link name='b'/><gz:plugin/>"
        f"<joint name='j' type='revolute'><origin xyz='1, 2, 3'/>{ENDS}</joint></robot>",
        encoding="utf-8",
    )
    found = read_robot(path)
    late = "<robot><link name='a'/></robot>"
    path.write_text(f"<!-- written by hand -->\n<?xml version='1.0'?>{late}", encoding="utf-8")
    assert read_robot(path).links == ("a",)
    assert (found.name, found.joints[0].xyz) == ("r", (1.0, 2.0, 3.0))
    unnamed = load(CASES / "no-robot-name.urdf", Choice(components=("wx",)))
    assert (unnamed.name, unnamed.inputs) == ("no-robot-name", ("j",))
