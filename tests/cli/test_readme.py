"""The README's commands exist, its test command is the one that CI runs, and its Python runs as a script."""

import os
import re
import shlex
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from singsym.cli.parser import commands, parser
from tests.mechanism.urdf.files import joint, write

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
COMMANDS = sorted(set(re.findall(r"(?:^ {4}|&& |`)(singsym [a-z][^`&|>\n#]*)", README, re.MULTILINE)))


@pytest.mark.parametrize("command", [c.strip() for c in COMMANDS])
def test_commands_parse(command):
    words = shlex.split(command)[1:]
    if len(words) == 1:
        assert words[0] in {name for name, _, _ in commands()}
    else:
        assert parser().parse_args(words).run is not None


def test_there_are_commands():
    assert len(COMMANDS) > 8


def test_ci_runs_the_test_command():
    commands = re.findall(r"python -m pytest[^`\n]*", README)
    assert commands
    assert all(c.strip() in (ROOT / ".ci" / "run").read_text() for c in commands)


def test_the_python_of_the_readme_is_a_script(tmp_path):
    """As it stands, without a guard of `__main__`, beside a robot's file with the names it speaks of."""
    block = re.search(r"## In Python\n\n((?: {4}.*\n|\n)+)", README)[1]
    (tmp_path / "script.py").write_text(textwrap.dedent(block), encoding="utf-8")
    turning = {"rpy": "1.5707963 0 0", "axis": "0 0 1", "limit": "-2 2"}
    joints = (
        joint("revolute", f"link_{k - 1}", f"link_{k}", name=f"joint_{k}", xyz=f"0 0 0.{k}", **turning)
        for k in range(1, 8)
    )
    write(tmp_path, *joints, joint("fixed", "link_7", "tool0"))
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "SINGSYM_CACHE": str(tmp_path / "cache")}
    done = subprocess.run(
        [sys.executable, "script.py"], cwd=tmp_path, env=environment, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "Classes 1-4 occur; every other class is proven empty" in done.stdout
    assert (tmp_path / "page.html").stat().st_size > 10_000
