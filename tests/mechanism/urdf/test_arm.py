"""URDF arms against yourdfpy's own forward kinematics in floats."""

import io
import math
import sys
from pathlib import Path

import numpy as np
import pytest
import sympy
import yourdfpy

from singsym.mechanism import Choice, JointKind, Mechanism, MechanismError, check
from singsym.mechanism.urdf import from_urdf
from tests.mechanism import arms
from tests.mechanism.urdf import files

FIVE = Choice(components=("vx", "vy", "vz", "wx", "wy"))
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
    arm = from_urdf(path, FIVE)
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
    arm = from_urdf(write(tmp_path / "arm.urdf", JOINTS[:2]), Choice(components=("vx", "vy")))
    assert arm.joint("joint_0").reference is None
    assert arm.link("link_0").points["o_joint_0"] == (0, 0, sympy.Rational("0.089159"))
    # 1.570796325 is a quarter turn: x of the child is -z of the parent.
    assert arm.link("link_1").axes["z_joint_1"] == (0, 1, 0)
    assert "Angles as multiples of pi: 1.570796325 is pi/2." in arm.description
    every = from_urdf(write(tmp_path / "arm.urdf", JOINTS), FIVE)
    values = [v for link in every.links for p in link.points.values() for v in p]
    assert all(v.is_Rational for v in values)
    assert "Rotated by rational numbers within 1e-06 of the file's: joint-3, joint-5." in every.description


def test_limits(tmp_path: Path) -> None:
    arm = from_urdf(write(tmp_path / "arm.urdf", JOINTS), FIVE)
    # The first joint turns freely, the continuous one has no limits.
    symmetric, slide, offset = arm.limits
    assert symmetric.expression == sympy.Symbol("cos(joint_1)")
    assert math.cos(1.5 + 1e-6) <= symmetric.low <= math.cos(1.5)
    assert (slide.low, slide.high) == (sympy.Rational(-1, 2), sympy.Rational(1, 4))
    # From .5 to 1.5: the condition changes its sign less than 1e-6 beyond either end.
    for angle, inside in ((0.5, True), (1.5, True), (1.0, True), (0.5 - 2e-6, False), (1.5 + 2e-6, False)):
        put = {sympy.Symbol("cos(joint_5)"): math.cos(angle), sympy.Symbol("sin(joint_5)"): math.sin(angle)}
        assert (offset.expression.xreplace(put) >= offset.low) == inside
    assert "Limits of joint_1, joint_5: rounded outwards by at most 1e-6." in arm.description


def test_limits_that_say_little(tmp_path: Path) -> None:
    slide = ("prismatic", "0 0 0", "0 0 0", "0 0 1")

    def arm(kind: tuple[str, ...], limit: str) -> Mechanism:
        return from_urdf(write(tmp_path / "arm.urdf", [(*kind, limit)]), Choice(components=("vz",)))

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
    (bound,) = from_urdf(file, Choice(components=("wz",))).limits
    put = {sympy.Symbol("cos(joint_0)"): 1, sympy.Symbol("sin(joint_0)"): 0}
    assert bound.expression.xreplace(put) == bound.low


def test_a_held_joint_is_part_of_its_links(tmp_path: Path) -> None:
    """With joints at values the tool is where the whole arm, brought to these values, has it."""
    path = write(tmp_path / "arm.urdf", JOINTS)
    held = {"joint-1": "-pi/3", "joint-3": "0.1", "joint-5": 1.25}
    arm = from_urdf(path, Choice(lock=held, components=("vx", "wz")))
    assert [j.name for j in arm.joints] == ["joint_0", "joint_4"]
    assert arm.limits == ()
    values = {"joint_0": 0.4, "joint_1": -math.pi / 3, "joint_3": 0.1, "joint_4": -0.7, "joint_5": 1.25}
    whole = from_urdf(path, FIVE)
    place, frame = arms.tool(whole, values)
    held_place, held_frame = arms.tool(arm, values)
    assert np.allclose(place, held_place, atol=2e-6)
    assert np.allclose(np.linalg.det(held_frame), 1)
    # the last link's frame is another now, but turns with the first joint in the same way
    turned = {**values, "joint_0": 1.4}
    assert np.allclose(
        arms.tool(whole, turned)[1] @ frame.T, arms.tool(arm, turned)[1] @ held_frame.T, atol=2e-6
    )


def test_values_outside_limits_are_not_held(tmp_path: Path) -> None:
    path = write(tmp_path / "arm.urdf", JOINTS)
    for name, value in (("joint-1", "1.6"), ("joint-3", "0.26"), ("joint-5", "0")):
        with pytest.raises(MechanismError, match="within the joint's limits"):
            from_urdf(path, Choice(lock={name: value}))
    with pytest.raises(MechanismError, match="did you mean 'joint-1'"):
        from_urdf(path, Choice(lock={"joint_1": "0"}))
    with pytest.raises(MechanismError, match="either moving or held"):
        from_urdf(path, Choice(lock={"joint-1": "0"}, joints=("joint-1",)))


def test_noise_and_cut_digits_are_said_once(tmp_path: Path) -> None:
    """1e-11 m and 1.5707963 rad are what exporters write for 0 and pi/2; sin 45 degrees is sqrt(2)/2."""
    path = files.write(
        tmp_path,
        files.joint("revolute", "a", "b", xyz="0.10000000001 -2.3e-17 0.0345678", rpy="0 0 0.785398"),
        files.joint("revolute", "b", "c", xyz="0.2 1e-11 0", rpy="1.5707963 0 0", axis="0.70711 0.70711 0"),
        files.joint("revolute", "c", "d", rpy="1.5707963 0 2e-11", axis="0 1e-12 -1"),
    )
    arm = from_urdf(path)
    assert arm.link("a").points["o_to_b"] == (sympy.Rational(1, 10), 0, sympy.Rational("0.0345678"))
    assert arm.link("b").points["o_to_c"] == (sympy.Rational(1, 5), 0, 0)
    half = sympy.sqrt(2) / 2
    assert arm.link("a").axes["x_to_b"] == (-half, half, 0)
    assert arm.link("c").axes["z_to_c"] == (half, half, 0)
    assert arm.link("d").axes["z_to_d"] == (0, 0, -1)
    lines = arm.description.split("\n")
    assert [line for line in lines if line.startswith("Lengths")] == [
        "Lengths without noise: 0.10000000001 is 0.1, -2.3e-17 is 0, 1e-11 is 0."
    ]
    assert [line for line in lines if line.startswith("Angles")] == [
        "Angles as multiples of pi: 0.785398 is pi/4, 1.5707963 is pi/2, 2e-11 is 0."
    ]


def test_an_axis_in_no_simple_direction_is_a_rational_unit_vector(tmp_path: Path) -> None:
    arm = from_urdf(
        files.write(tmp_path, files.joint("revolute", "a", "b", axis="0.0174 0.99985 -0.3")),
        Choice(components=("wz",)),
    )
    axis = arm.link("b").axes["z_to_b"]
    assert all(x.is_Rational for x in axis)
    assert sum(x * x for x in axis) == 1
    norm = math.hypot(0.0174, 0.99985, 0.3)
    assert np.allclose([float(x) * norm for x in axis], [0.0174, 0.99985, -0.3], atol=2e-6)
    assert "within 1e-06 of the file's: to_b" in arm.description


def test_urdf_needs_no_other_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("yourdfpy", "lxml", "lxml.etree"):
        monkeypatch.setitem(sys.modules, name, None)
    assert len(from_urdf(write(tmp_path / "arm.urdf", JOINTS), FIVE).joints) == 5
