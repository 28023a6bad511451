"""The README's commands exist, and its test command is the one that CI runs."""

import re
import shlex
from pathlib import Path

import pytest

from singsym.cli.parser import commands, parser

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
