"""MJCF files: where bodies are, loops, couplings; against the positions that mujoco itself works out."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy

from singsym.classes.classify import classify
from singsym.classes.configuration.at import at
from singsym.classes.taxonomy.types import SingularityType
from singsym.mechanism import Choice, JointKind, MechanismError, dumps, load, loads
from singsym.mechanism.mjcf import is_mjcf

T = SingularityType
FOUR_BAR = """
<mujoco>
  <compiler angle="degree"/>
  <default><joint axis="0 1 0"/></default>
  <worldbody>
    <body name="crank" euler="0 -90 0">
      <joint name="A"/>
      <body name="rod" pos="1 0 0" euler="0 90 0">
        <joint name="B"/>
        <body name="rocker" pos="4 0 0" euler="0 -90 0"><joint name="C"/><site name="tip" pos="0 0 0"/></body>
      </body>
    </body>
  </worldbody>
  <equality><connect name="D" body1="rocker" anchor="-3 0 0"/></equality>
  <actuator><motor joint="A"/></actuator>
</mujoco>
"""
"""Crank 1, rod 4 and rocker 3, crank and rocker upright at the start: the ground is sqrt(4^2 + 2^2)."""
ROCKER = Choice(components=("wy",))


def write(folder: Path, text: str) -> Path:
    path = folder / "scene.xml"
    path.write_text(text, encoding="utf-8")
    return path


def test_without_the_package_it_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "mujoco", None)
    with pytest.raises(MechanismError, match=r"MJCF.*the Python package mujoco.*singsym\[mjcf\]"):
        load(write(tmp_path, FOUR_BAR))


def test_a_long_beginning_is_passed_over_at_once(tmp_path: Path) -> None:
    """Comments and dashes in any number before the first element: one way to read them, not 2^n."""
    head = "<?xml version='1.0'?>" + "<!-- one -- > -->\n<!-- two ?> -->\n" * 1000
    (tmp_path / "a.xml").write_text(f"{head}<robot/>", encoding="utf-8")
    (tmp_path / "b.xml").write_text(f"{head}<mujoco/>", encoding="utf-8")
    assert (is_mjcf(tmp_path / "a.xml"), is_mjcf(tmp_path / "b.xml")) == (False, True)


class TestWithMujoco:
    """What needs the package."""

    @pytest.fixture(autouse=True)
    def _mujoco(self) -> None:
        pytest.importorskip("mujoco")

    def test_what_mujoco_warns_of_is_not_said(self, tmp_path: Path, recwarn: pytest.WarningsRecorder) -> None:
        load(write(tmp_path, FOUR_BAR.replace("<compiler", "<compiler settotalmass='14'")), ROCKER)
        assert not recwarn.list

    def test_a_loop_is_closed_by_a_ball_joint(self, tmp_path: Path) -> None:
        mechanism = load(write(tmp_path, FOUR_BAR), ROCKER)
        assert [j.kind for j in mechanism.joints] == [JointKind.R] * 3 + [JointKind.S]
        assert mechanism.inputs == ("A",)
        # from A the rod starts 1 above and ends 4 away, the rocker 3 below that
        assert mechanism.link("world").points["o_D"] == (4, 0, -2)
        assert loads(dumps(mechanism), origin=mechanism.origin) == mechanism

    def test_its_classes_are_those_of_the_linkage_in_the_plane(self, tmp_path: Path) -> None:
        """The crank turns fully, as 1 + sqrt(20) < 3 + 4, without dead points; the rocker is at rest where
        crank and rod are in line, which a scan over the crank counts."""
        result = classify(load(write(tmp_path, FOUR_BAR), ROCKER), cache=False)
        assert not result.undecided
        angle = np.linspace(0, 2 * np.pi, 40001) + 1e-3
        D, B = 4 - 2j, np.exp(1j * angle)
        far = abs(D - B)
        along = (far**2 + 16 - 9) / (2 * far)
        in_line = 0
        for side in (1, -1):
            C = B + (D - B) / far * (along + side * 1j * np.sqrt(16 - along**2))
            in_line += int(np.sum(np.diff(np.sign((np.conj(B) * (C - B)).imag)) != 0))
        found = {c.types: (c.dimension, c.points) for c in result.classes if c.verdict.is_yes}
        assert found == {T.RI | T.IO: (0, in_line)}

    def test_a_loop_between_sites(self, tmp_path: Path) -> None:
        """The same loop by a site on each side; what is not active is left aside, and said."""
        text = FOUR_BAR.replace("<worldbody>", '<worldbody><site name="there" pos="4 0 -2"/>')
        text = text.replace('pos="0 0 0"/>', 'pos="0 0 0"/><site name="here" pos="-3 0 0"/>')
        sites = 'site1="here" site2="there"/><connect name="off" body1="rod" anchor="0 0 0" active="false"/>'
        text = text.replace('body1="rocker" anchor="-3 0 0"/>', sites)
        tip = Choice(tip="tip", components=("wy",))
        mechanism = load(write(tmp_path, text), tip)
        plain = load(write(tmp_path, FOUR_BAR), ROCKER)
        assert mechanism.links == plain.links
        assert mechanism.joints == plain.joints
        assert "Left aside: the inactive constraint off." in mechanism.description

    def test_gears(self, tmp_path: Path) -> None:
        """Limits of the follower go to the leader: B = -2 A + 90 deg within -90 and 90 deg."""
        gears = '<joint joint1="B" joint2="A" polycoef="1.5708 -2 0 0 0"/></equality>'
        text = FOUR_BAR.replace("</equality>", gears)
        text = text.replace('name="B"', 'name="B" range="-90 90"')
        (coupling,) = load(write(tmp_path, text), ROCKER).couplings
        assert dict(coupling.terms) == {"B": 1, "A": 2}
        assert coupling.constant == sympy.pi / 2
        (limit,) = load(write(tmp_path, text), ROCKER).limits
        assert {s.name for s in limit.expression.free_symbols} == {"cos(A)", "sin(A)"}

    def test_bodies_are_where_mujoco_has_them(self, tmp_path: Path) -> None:
        """Two joints on a body, a slide on a turned body, a body without joints, a value at the start."""
        text = """
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="base" pos="0.1 0.2 0.3" euler="0.3 -0.7 0.2">
      <body name="arm" pos="0.5 0 0.1" quat="0.5 0.5 0.5 0.5">
        <joint name="q1" axis="0 0 1" pos="0.1 0 0"/>
        <joint name="q2" axis="1 1 0" pos="0 0.2 0" ref="0.4"/>
        <body name="slider" pos="0.3 0.1 0" euler="0 1.0471975511965976 0">
          <joint name="q3" type="slide" axis="0 0.6 0.8"/>
          <body name="hand" euler="1.1 0 0" pos="0 0 0.2">
            <joint name="q4" axis="0 1 0"/><site name="tip" pos="0.1 0.2 0.3"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="q1"/><motor joint="q2"/><motor joint="q3"/><motor joint="q4"/></actuator>
</mujoco>
"""
        import mujoco

        path = write(tmp_path, text.replace("</body>\n            ", "</body>"))
        mechanism = load(path, Choice(components=("vx", "vy", "vz", "wx")))
        spec = mujoco.MjSpec.from_file(str(path))
        spec.compiler.boundmass = spec.compiler.boundinertia = 1
        model = spec.compile()
        data: Any = mujoco.MjData(model)
        data.qpos[:] = values = [0.7, -0.3, 0.25, 1.9]
        mujoco.mj_kinematics(model, data)
        # the second joint is at 0.4 at the start
        given = dict(zip(mechanism.inputs, (0.7, -0.7, 0.25, 1.9), strict=True))
        seen = at(mechanism, {"joints": {name: repr(x) for name, x in given.items()}})
        assert [float(x) for x in seen.points["tool"]] == pytest.approx(data.site_xpos[0], abs=3e-6)
        assert len(values) == len(mechanism.inputs)

    @pytest.mark.parametrize(
        ("old", "new", "words"),
        [
            ("<connect ", "<weld ", "a constraint of type weld; expected connect or joint"),
            ('<motor joint="A"/>', "", "no joint with an actuator; .*motor joint="),
            ('<joint name="A"/>', '<joint name="A" type="free"/>', "a floating body"),
            (
                "</equality>",
                '<joint joint1="B" joint2="A" polycoef="0 1 1 0 0"/></equality>',
                "follows a curve",
            ),
            ("</equality>", '<joint joint1="B" polycoef="0 0 0 0 0"/></equality>', "a joint that is held"),
            ("<mujoco>", "<mujoco><nothing/>", "MJCF, the format of MuJoCo, which mujoco refuses"),
            ("<site ", '<site name="other"/><site ', "tip: found 2 sites; expected a site or a body among"),
        ],
    )
    def test_what_no_mechanism_has_is_named(self, tmp_path: Path, old: str, new: str, words: str) -> None:
        with pytest.raises(MechanismError, match=words):
            load(write(tmp_path, FOUR_BAR.replace(old, new)), ROCKER)

    def test_components_are_asked_for(self, tmp_path: Path) -> None:
        with pytest.raises(MechanismError, match=r"1 input and no output components.*--components vx"):
            load(write(tmp_path, FOUR_BAR))
        mechanism = load(write(tmp_path, FOUR_BAR), Choice(tip="rod", components=("vx",)))
        assert mechanism.outputs[0].link == "rod"
