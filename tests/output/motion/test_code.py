"""Code for controllers: run, compiled where there is a compiler, and compared with the compiled functions."""

from __future__ import annotations

import ctypes
import math
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from singsym.cli import main
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load, loads
from singsym.motion.numeric import NumericLinkage, numeric
from singsym.output.motion.code import code

STRICT = ("cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-shared", "-fPIC")
FAR = """
name = "far"
inputs = ["A", "E"]
output = { velocity = "C" }

[links]
ground = { points = { A = [0, 0], E = [3, 0] } }
AB = 2
BC = RODS
CD = RODS
DE = 2

[joints]
A = "R"
B = "R"
C = "R"
D = "R"
E = "R"
"""
NAMES = ("zlatanov-2dof", "spherical-fourbar", "puma560", "3rrr", "slider-crank")


def free(linkage: NumericLinkage) -> list[int]:
    constants = {c.name for c in linkage.equation.space.ring.constants}
    return [k for k, name in enumerate(linkage.names) if name not in constants]


@pytest.mark.parametrize("name", NAMES)
def test_python_gives_the_same_numbers(name: str) -> None:
    linkage = numeric(load(name))
    there: dict[str, Any] = {}
    exec(code(linkage.equation, "python", name), there)
    point = linkage.sample(1, seed=2)[0]
    q = point[free(linkage)].tolist()
    assert there["L"](q) == pytest.approx(linkage.L(point).ravel(), abs=1e-12)
    assert there["condition_5"](q) == pytest.approx(linkage.condition("5", point), abs=1e-9)
    assert ("condition_4" in there) == (name != "puma560")
    if name == "3rrr":
        assert "configuration" not in there
        return
    joints = linkage.joints(point)
    values = [float(joints[label]) for label in linkage.inputs]
    modes = linkage.modes(linkage.inputs)
    ends = linkage.configurations(dict(zip(linkage.inputs, values, strict=True)))
    for mode, end in zip(modes, ends, strict=True):
        if np.isfinite(end).all():
            assert there["configuration"](values, mode) == pytest.approx(end[free(linkage)], abs=1e-12)


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
@pytest.mark.parametrize("name", NAMES)
def test_c_compiles_without_a_warning_and_gives_the_same_numbers(name: str, tmp_path: Path) -> None:
    linkage = numeric(load(name))
    source, library = tmp_path / "linkage.c", tmp_path / "linkage.so"
    source.write_text(code(linkage.equation, "c", name))
    subprocess.run([*STRICT, "-o", library, source, "-lm"], check=True)
    functions = ctypes.CDLL(str(library))
    point = linkage.sample(1, seed=2)[0]
    q = point[free(linkage)]
    found = (ctypes.c_double * linkage.L(point).size)()
    prefix = "linkage_3rrr" if name == "3rrr" else name.replace("-", "_")
    functions[f"{prefix}_L"]((ctypes.c_double * len(q))(*q), found)
    assert list(found) == pytest.approx(linkage.L(point).ravel(), abs=1e-12)


def test_parameters_are_arguments(tmp_path: Path) -> None:
    """At a = 5/4 they give what the mechanism with that length gives."""
    mechanism = load("zlatanov-hybrid")
    there: dict[str, Any] = {}
    exec(code(velocity_equation(mechanism), "python", "hybrid"), there)
    assert there["PARAMETERS"] == ("a",)
    assert "configuration" not in there
    linkage = numeric(mechanism.with_parameters(a="5/4"))
    point = linkage.sample(1, seed=2)[0]
    q, expected = point[free(linkage)], linkage.L(point).ravel()
    assert there["loops"](q, [1.25]) == pytest.approx([0] * len(there["loops"](q, [1.25])), abs=1e-9)
    assert there["L"](q, [1.25]) == pytest.approx(expected, abs=1e-12)
    if shutil.which("cc") is None:
        return
    source, library = tmp_path / "linkage.c", tmp_path / "linkage.so"
    source.write_text(code(velocity_equation(mechanism), "c", "hybrid"))
    subprocess.run([*STRICT, "-o", library, source, "-lm"], check=True)
    found = (ctypes.c_double * len(expected))()
    given = (ctypes.c_double * 1)(1.25)
    ctypes.CDLL(str(library)).hybrid_L((ctypes.c_double * len(q))(*q), given, found)
    assert list(found) == pytest.approx(expected, abs=1e-12)


def test_where_a_mode_has_no_configuration_it_is_not_a_number() -> None:
    """The rods of a five-bar do not reach from crank to crank: B and D are 7 apart, at most 6 would do."""
    text = FAR.replace("RODS", "3")
    there: dict[str, Any] = {}
    exec(code(velocity_equation(loads(text)), "python", "far"), there)
    assert np.isnan(there["configuration"]([math.pi, math.pi], (1,))).all()
    assert np.isfinite(there["configuration"]([0.0, 0.0], (1,))).all()


def test_a_name_cannot_end_its_comment() -> None:
    equation = velocity_equation(load("fourbar"))
    there: dict[str, Any] = {}
    exec(code(equation, "python", '"""\nraise ValueError\n"""'), there)
    assert there["VARIABLES"]
    assert "*/ x" not in code(equation, "c", "*/ x")


def test_export_at_the_shell(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", "fourbar", "--to", "c"]) == 0
    assert "void fourbar_L(const double q[4]" in capsys.readouterr().out
    assert main(["export", "zlatanov-hybrid"]) == 0
    assert "def L(q, parameters):" in capsys.readouterr().out
