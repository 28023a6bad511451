"""Files of robots that others have written: each gets an answer, or a sentence that says why not.

SINGSYM_ROBOTS names a folder of such files; without it there is nothing to test. Conditions have
SINGSYM_ROBOT_SECONDS for each file, 20 if not said.
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
SECONDS = float(os.environ.get("SINGSYM_ROBOT_SECONDS", "20"))
SUFFIXES = (".urdf", ".xacro", ".sdf", ".world", ".mjcf")
SENTENCE = re.compile(r"singsym (show|conditions): .+: found .+; expected .+", re.DOTALL)


def outcome(command: str, file: Path) -> str:
    """An answer, a sentence, no end within `SECONDS`, or anything else, which is a fault."""
    call = [sys.executable, "-m", "singsym", command, str(file)]
    try:
        done = subprocess.run(call, capture_output=True, text=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return "no end"
    if done.returncode == 0 and done.stdout and not done.stderr:
        return "sentence" if "Not yet a mechanism" in done.stdout else "answer"
    if done.returncode == 2 and not done.stdout and SENTENCE.fullmatch(done.stderr.strip()):
        return "sentence"
    return f"fault of {command} {file}: {done.stderr.strip()[-300:]}"


@pytest.mark.slow
@pytest.mark.skipif(not FOLDER, reason="SINGSYM_ROBOTS names no folder of files")
@pytest.mark.parametrize("command", ["show", "conditions"])
def test_every_file_ends_in_an_answer_or_a_sentence(
    command: str, record_property: Callable[[str, object], None]
) -> None:
    files = sorted(path for path in Path(FOLDER).rglob("*") if path.suffix.lower() in SUFFIXES)
    assert files
    outcomes = Counter(outcome(command, file) for file in files)
    print(command, dict(outcomes))
    record_property(command, dict(outcomes))
    assert not [found for found in outcomes if found.startswith("fault")]
    assert outcomes["no end"] <= len(files) // 20
