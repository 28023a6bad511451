"""Files of robots that others have written: each gets an answer, or a sentence that says why not.

SINGSYM_ROBOTS names a folder of such files; without it there is nothing to test. Conditions have
SINGSYM_ROBOT_SECONDS for each file, 60 if not said.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

FOLDER = os.environ.get("SINGSYM_ROBOTS", "")
SECONDS = float(os.environ.get("SINGSYM_ROBOT_SECONDS", "60"))
SUFFIXES = (".urdf", ".xacro", ".sdf", ".world", ".mjcf")
SENTENCE = re.compile(r"singsym (show|conditions): .+: found .+; expected .+", re.DOTALL)
ADVICE = re.compile(r" as ((?:--[a-z]+ [^\s;,]+ ?)+)")
STEPS = 6


def outcome(command: str, file: Path, options: list[str]) -> tuple[str, str]:
    """An answer, a sentence, no end within `SECONDS`, or a fault; and what was said."""
    call = [sys.executable, "-m", "singsym", command, str(file), *options]
    try:
        done = subprocess.run(call, capture_output=True, text=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return "no end", ""
    if done.returncode == 0 and done.stdout and not done.stderr:
        return ("sentence" if "Not yet a mechanism" in done.stdout else "answer"), ""
    if done.returncode == 2 and not done.stdout and SENTENCE.fullmatch(done.stderr.strip()):
        return "sentence", done.stderr
    return f"fault of {command} {file} {options}: {done.stderr.strip()[-300:]}", ""


def followed(file: Path) -> str:
    """What conditions say once all is chosen as the sentences advise, or which they are without advice."""
    options: list[str] = []
    for _ in range(STEPS):
        found, said = outcome("conditions", file, options)
        advice = ADVICE.search(said)
        if advice is None:
            return found
        options += advice[1].split()
    return f"fault of conditions {file}: advice without end: {options}"


def public_files() -> list[Path]:
    """The files, each once, whatever packages it is in."""
    found = sorted(path for path in Path(FOLDER).rglob("*") if path.suffix.lower() in SUFFIXES)
    return list({path.read_bytes(): path for path in found}.values())


@pytest.mark.slow
@pytest.mark.skipif(not FOLDER, reason="SINGSYM_ROBOTS names no folder of files")
@pytest.mark.parametrize("command", ["show", "conditions", "advice followed"])
def test_every_file_ends_in_an_answer_or_a_sentence(
    command: str, record_property: Callable[[str, object], None]
) -> None:
    files = public_files()
    assert files
    outcomes = Counter(followed(f) if "advice" in command else outcome(command, f, [])[0] for f in files)
    print(command, dict(outcomes))
    record_property(command, dict(outcomes))
    assert not [found for found in outcomes if found.startswith("fault")]
    assert outcomes["no end"] <= len(files) // 20
