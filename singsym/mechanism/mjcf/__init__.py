"""Mechanisms with closed loops from MJCF files, which the package mujoco reads.

Source: the MJCF reference (https://mujoco.readthedocs.io).
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from singsym.mechanism.checks import check
from singsym.mechanism.choices import Choice, with_components
from singsym.mechanism.locking import locked
from singsym.mechanism.mjcf.assembly import TOOL, assembled
from singsym.mechanism.mjcf.model_file import FORMAT, read_scene
from singsym.mechanism.model import Mechanism, Space, Twist
from singsym.mechanism.outputs import TWISTS
from singsym.mechanism.problems import MechanismError

_ROOT = re.compile(rb"(?:\xef\xbb\xbf)?(?>\s|<\?.*?\?>|<!--.*?-->)*+<mujoco[\s/>]", re.DOTALL)


def is_mjcf(path: str | Path) -> bool:
    """Whether the first element of a file is that of MJCF."""
    with Path(path).open("rb") as stream:
        return _ROOT.match(stream.read(100_000)) is not None


def from_mjcf(path: str | Path, choice: Choice | None = None) -> Mechanism:
    """The mechanism of all bodies of an MJCF file: joints with actuators are the inputs.

    Bodies without joints are part of their parents; `connect` is a ball joint, `joint` a coupling.

    choice: its tip is a site, or a body, by default the only site; its components are of the tip's twist.
    Numbers become exact as those of URDF files do; anchors of loops meet exactly at the start.
    Raises `MechanismError` for what the file lacks or has too much of, `OSError` where it cannot be read.
    """
    choice = choice or Choice()
    scene = read_scene(path)
    if not any(body.joints for body in scene.bodies):
        raise scene.fault("file", f"{FORMAT}, without joints", "joints between bodies")
    if choice.base is not None:
        found, advice = f"--base {choice.base}", "leave it out"
        raise scene.fault("base", found, "the world as ground, of an MJCF file", advice)
    if not scene.inputs:
        advice = 'write <actuator><motor joint="NAME"/></actuator>'
        raise scene.fault("file", "no joint with an actuator", "actuators of the inputs", advice)
    tips = [*scene.sites, *(body.name for body in scene.bodies[1:])]
    tip = choice.tip or (tips[0] if len(scene.sites) == 1 else "")
    if tip not in tips:
        found = repr(tip) if tip else f"{len(scene.sites)} sites"
        advice = f"choose one, as --tip {tips[0]}"
        raise scene.fault("tip", found, f"a site or a body among {', '.join(tips[:24])}", advice)
    mechanism, link = assembled(scene, tip)
    twist = TWISTS[Space.SPATIAL]
    mechanism = replace(mechanism, outputs=(Twist(link, TOOL, twist),))
    mechanism = locked(mechanism, choice.held(mechanism.inputs, scene.file))
    n = len(mechanism.inputs)
    if choice.components:
        mechanism = with_components(mechanism, choice.components)
    elif n != len(twist):
        found, expected = (
            f"{n} input{'s' * (n != 1)} and no output components",
            f"{n} names among {', '.join(twist)}",
        )
        advice = f"choose what it is for, as --components {','.join(('vx', 'vy', 'vz', 'wz', 'wx')[:n])}"
        raise scene.fault("components", found, expected, advice)
    if problems := check(mechanism, choice.redundant):
        raise MechanismError(problems)
    return mechanism
