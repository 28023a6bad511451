"""The mechanisms that come with singsym: one file each, with its source.

Source: each file's key `source`.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files


@cache
def names() -> tuple[str, ...]:
    """The names of the library's mechanisms, sorted.

    >>> "zlatanov-2dof" in names()
    True
    """
    entries = files(__name__).iterdir()
    return tuple(sorted(e.name.removesuffix(".toml") for e in entries if e.name.endswith(".toml")))


def text(name: str) -> str:
    """The file of a mechanism of the library; raises `FileNotFoundError`."""
    return files(__name__).joinpath(f"{name}.toml").read_text(encoding="utf-8")
