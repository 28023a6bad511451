"""URDF arms against yourdfpy's own forward kinematics in floats."""

import importlib.util
import io
import math
import sys
from pathlib import Path

import numpy as np
import pytest
import sympy
import yourdfpy

from singsym.mechanism import JointKind, Mechanism, MechanismError, check
from singsym.mechanism.urdf import from_urdf, rational_rotation

_spec = importlib.util.spec_from_file_location("arms", Path(__file__).with_name("arms.py"))
assert _spec is not None
assert _spec.loader is not None
arms = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(arms)

JOINTS = [
    ("revolute", "0 0 0.089159", "0 0 0", "0 0 1", "-6.2831853 6.2831853"),
    ("revolute", "0 0.13585 0", "0 1.570796325 0", "0 1 0", "-1.5 1.5"),
    ("fixed", "0.1 0.2 0.3", "1.5708 0 -1.5708", "", ""),
    ("prismatic", "0 -0.1197 0.425", "0.3 -0.7 1.1", "0 0 1", "-0.5 0.25"),
    ("continuous", "0 0 0.39225", "0 1.570796325 0", "0.6 0.8 0", ""),
    ("revolute", "0 0.093 0", "0.25 0 0", "1 1 1", "0.5 1.5"),
    ("fixed", "0 0.0823 0", "0 0 1.570796325", "", ""),
]


def write(path: Path, joints: list[tuple[str, ...]], extra: str = "") -> Path:
    links = "".join(f'<link name="link-{i}"/>' for i in range(len(joints) + 1))
    body = ""
    for i, (kind, xyz, rpy, axis, limit) in enumerate(joints):
        low, high = limit.split() if limit else ("", "")
        body += f'<joint name="joint-{i}" type="{kind}"><origin xyz="{xyz}" rpy="{rpy}"/>'
        body += f'<parent link="link-{i}"/><child link="link-{i + 1}"/>'
        body += f'<axis xyz="{axis}"/>' if axis else ""
        body += f'<limit lower="{low}" upper="{high}" effort="1" velocity="1"/>' if limit else ""
        body += "</joint>"
    path.write_text(f'<?xml version="1.0"?><robot name="arm">{links}{body}{extra}</robot>', encoding="utf-8")
    return path


def test_forward_kinematics(tmp_path: Path) -> None:
    path = write(tmp_path / "arm.urdf", JOINTS)
    arm = from_urdf(path, components=["vx", "vy", "vz", "wx", "wy"])
    assert [j.kind for j in arm.joints] == [JointKind.R, JointKind.R, JointKind.P, JointKind.R, JointKind.R]
    assert check(arm) == ()
    values = {j.name: v for j, v in zip(arm.joints, (0.3, -1.2, 0.2, 2.0, 1.0), strict=True)}
    robot = yourdfpy.URDF.load(
        io.BytesIO(path.read_bytes()), load_meshes=False, build_collision_scene_graph=False
    )
    robot.update_cfg({name.replace("_", "-"): v for name, v in values.items()})
    expected = robot.get_transform("link-7", "link-0")
    place, _ = arms.tool(arm, values)
    assert np.allclose(place, expected[:3, 3], atol=2e-5)


def test_dimensions_are_the_decimals_as_spelled(tmp_path: Path) -> None:
    arm = from_urdf(write(tmp_path / "arm.urdf", JOINTS[:2]), components=["vx", "vy"])
    assert arm.joint("joint_0").reference is None
    assert arm.link("link_0").points["o_joint_0"] == (0, 0, sympy.Rational("0.089159"))
    # 1.570796325 is a quarter turn: x of the child is -z of the parent.
    assert arm.link("link_1").axes["z_joint_1"] == (0, 1, 0)
    assert "quarter turns" in arm.description
    every = from_urdf(write(tmp_path / "arm.urdf", JOINTS), components=["vx", "vy", "vz", "wx", "wy"])
    values = [v for link in every.links for p in link.points.values() for v in p]
    assert all(v.is_Rational for v in values)
    assert "rational rotation" in every.description


def test_limits(tmp_path: Path) -> None:
    arm = from_urdf(write(tmp_path / "arm.urdf", JOINTS), components=["vx", "vy", "vz", "wx", "wy"])
    # The first joint turns freely, the continuous one has no limits.
    symmetric, slide, offset = arm.limits
    assert symmetric.expression == sympy.Symbol("cos(joint_1)")
    assert math.cos(1.5 + 1e-6) <= symmetric.low <= math.cos(1.5)
    assert (slide.low, slide.high) == (sympy.Rational(-1, 2), sympy.Rational(1, 4))
    # From .5 to 1.5: the condition changes its sign less than 1e-6 beyond either end.
    for angle, inside in ((0.5, True), (1.5, True), (1.0, True), (0.5 - 2e-6, False), (1.5 + 2e-6, False)):
        put = {sympy.Symbol("cos(joint_5)"): math.cos(angle), sympy.Symbol("sin(joint_5)"): math.sin(angle)}
        assert (offset.expression.xreplace(put) >= offset.low) == inside
    assert "Limits of joint_5: 0.5 is rounded outwards by at most 1e-6" in arm.description


def test_limits_that_say_little(tmp_path: Path) -> None:
    slide = ("prismatic", "0 0 0", "0 0 0", "0 0 1")

    def arm(kind: tuple[str, ...], limit: str) -> Mechanism:
        return from_urdf(write(tmp_path / "arm.urdf", [(*kind, limit)]), components=["vz"])

    turning = ("revolute", *slide[1:])
    # Exporters write 0 and 0 where no limit was set.
    for kind in (slide, turning):
        unset = arm(kind, "0 0")
        assert unset.limits == ()
        assert "Limits of joint_0: left out, as both are 0." in unset.description
        with pytest.raises(MechanismError, match="the lower limit first"):
            arm(kind, "1 0.5")
    assert arm(turning, "-3.5 3.5").limits == arm(turning, "0 inf").limits == ()
    assert arm(turning, "-3.1416 3.1416").limits == ()
    (half,) = arm(slide, "0 inf").limits
    assert (half.low, half.high) == (0, None)
    # A limit that is not given is 0, as the specification has it.
    file = write(tmp_path / "arm.urdf", [(*turning, "1 2.5")])
    file.write_text(file.read_text(encoding="utf-8").replace('lower="1.0"', "").replace('lower="1"', ""))
    (bound,) = from_urdf(file, components=["wz"]).limits
    put = {sympy.Symbol("cos(joint_0)"): 1, sympy.Symbol("sin(joint_0)"): 0}
    assert bound.expression.xreplace(put) == bound.low


def test_refused(tmp_path: Path) -> None:
    path = tmp_path / "arm.urdf"
    with pytest.raises(FileNotFoundError):
        from_urdf(path)
    branch = (
        '<joint name="b" type="fixed"><parent link="link-0"/><child link="side"/></joint><link name="side"/>'
    )
    with pytest.raises(MechanismError, match="2 last links"):
        from_urdf(write(path, JOINTS[:2], branch))
    arm = from_urdf(path, tip="link-2", components=["vx", "vz"])
    assert "Left aside: the joints b" in arm.description
    with pytest.raises(MechanismError, match="a link that a joint moves"):
        from_urdf(path, tip="nothing")
    with pytest.raises(MechanismError, match="2 names among"):
        from_urdf(write(path, JOINTS[:2]))
    with pytest.raises(MechanismError, match="floating"):
        from_urdf(write(path, [("floating", "0 0 0", "0 0 0", "0 0 1", "")]))
    path.write_text("no xml", encoding="utf-8")
    with pytest.raises(MechanismError):
        from_urdf(path)
    with pytest.raises(MechanismError, match="a direction"):
        from_urdf(write(path, [("continuous", "0 0 0", "0 0 0", "0 0 0", "")]))


def test_rational_rotation_is_exact() -> None:
    turn = rational_rotation(arms.turn(np.array([2 / 3, -1 / 3, 2 / 3]), 2.0).tolist())
    assert turn * turn.T == sympy.eye(3)
    assert turn.det() == 1
    assert np.allclose(
        np.array(turn.tolist(), dtype=float), arms.turn(np.array([2 / 3, -1 / 3, 2 / 3]), 2.0), atol=1e-5
    )


def test_without_yourdfpy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "yourdfpy", None)
    with pytest.raises(ImportError, match=r"singsym\[urdf\]"):
        from_urdf(tmp_path / "arm.urdf")


def test_what_a_file_lacks_is_said_in_a_sentence(tmp_path: Path) -> None:
    unnamed = Path(__file__).parent.parent / "cases" / "no-robot-name.urdf"
    assert from_urdf(unnamed, components=["wz"]).name == "no-robot-name"
    path = tmp_path / "arm.urdf"
    link, joint = '<link name="a"/><link name="b"/>', '<parent link="a"/><child link="b"/>'
    for text, found in (
        ("", "no XML"),
        ("<robot", "line 1"),
        ("<sdf/>", "<sdf>"),
        (f"<robot>{link}<joint type='revolute'>{joint}</joint></robot>", "KeyError: 'name'"),
        (f"<robot>{link}<joint name='j' type='revolute'/></robot>", "AttributeError"),
        (f"<!DOCTYPE r [<!ENTITY x '{link}'>]><robot>&x;</robot>", "0 last links"),
    ):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(MechanismError, match=found):
            from_urdf(path)
    # Names with undeclared prefixes, and meshes that are not there, are passed over.
    visual = "<visual><geometry><mesh/></geometry></visual>"
    path.write_text(
        f"<robot name='r'><link name='a'>{visual}</link><link name='b'/><gz:plugin/>"
        f"<joint name='j' type='revolute'>{joint}</joint></robot>",
        encoding="utf-8",
    )
    assert from_urdf(path, components=["wz"]).name == "r"
