"""The mechanisms that come with singsym: one file each, with its source, and one of the classes that occur.

Source: each file's key `source`; the classes are `singsym classify`'s own results.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

_CLASSES = "classes.toml"


@dataclass(frozen=True)
class Occurring:
    """The classes found in a mechanism, by number; `complete` where all others are proven empty."""

    numbers: tuple[int, ...]
    complete: bool


@cache
def names() -> tuple[str, ...]:
    """The names of the library's mechanisms, sorted.

    >>> "zlatanov-2dof" in names()
    True
    """
    entries = (entry.name for entry in files(__name__).iterdir())
    return tuple(sorted(e.removesuffix(".toml") for e in entries if e.endswith(".toml") and e != _CLASSES))


def text(name: str) -> str:
    """The file of a mechanism of the library; raises `FileNotFoundError`."""
    return files(__name__).joinpath(f"{name}.toml").read_text(encoding="utf-8")


@cache
def occurring() -> Mapping[str, Occurring]:
    """What the classification of each mechanism found, kept on file; a test compares it with the program.

    >>> occurring()["zlatanov-2dof"]
    Occurring(numbers=(1, 2, 3, 4), complete=True)
    """
    known = tomllib.loads(files(__name__).joinpath(_CLASSES).read_text(encoding="utf-8"))
    return {
        name: Occurring(tuple(numbers), complete=part == "decided")
        for part, mechanisms in known.items()
        for name, numbers in mechanisms.items()
    }
