"""Results of tasks on disk, as entries that cannot run code and that only the same program reads.

Source: the XDG Base Directory Specification, https://specifications.freedesktop.org/basedir-spec; an entry is
JSON, as `json_codec` writes it, compressed (RFC 1952).
"""

from __future__ import annotations

import gzip
import hashlib
import json
import logging
import os
import re
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar, get_type_hints

from singsym.classes.running.json_codec import Mismatch, decode, encode
from singsym.elimination import engines

log = logging.getLogger("singsym")

FORMAT = "singsym result 2"
_LARGEST = 1 << 28
"""Longer entries, in bytes, are neither written nor read."""
_ABANDONED_SECONDS = 3600.0
"""A part of an entry that is older belongs to a process that was killed."""
_ENTRY = re.compile(r"[0-9a-f]{64}\.json\.gz")
_LIBRARIES = ("python-flint", "numpy", "sympy", "mpmath", "networkx")
"""What results depend on beside the engines."""

_reported: set[Path] = set()
"""Folders that a warning told of: one is enough."""


class Result(Protocol):
    """What a task comes to."""

    @property
    def provisional(self) -> bool:
        """Whether more time could say more: then it is not kept."""
        ...


T = TypeVar("T")
R = TypeVar("R", bound=Result)


@dataclass(frozen=True)
class Entry(Generic[R]):
    """Where the result of a task is, or will be.

    key: a digest of everything that it depends on; result: its type hint.
    """

    path: Path
    key: str
    result: Any


class Cache:
    """Results of tasks as files of a folder, one each, written whole or not at all.

    An entry that cannot be read is as if it were not there, whatever is wrong with it.  Where one cannot be
    written, a warning says so, and nothing more is written.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.writable, self.prepared = True, False

    @cached_property
    def versions(self) -> list[str]:
        """Those of the program here."""
        return versions()

    def entry(self, function: Callable[[T], R], task: T) -> Entry[R] | None:
        """The entry of a task, which the annotations of its function say the types of.

        None where the task is of another type, after a warning.
        """
        try:
            given, result = _types(function)
            name = f"{function.__module__}.{function.__qualname__}"
            parts = [FORMAT, name, engines.allowed(), self.versions, encode(task, given)]
        except (Mismatch, TypeError) as error:
            self._give_up(error)
            return None
        key = hashlib.sha256(json.dumps(parts).encode()).hexdigest()
        return Entry(self.folder / f"{key}.json.gz", key, result)

    def get(self, entry: Entry[R]) -> R | None:
        """The stored result, or None."""
        try:
            if not entry.path.is_file():
                return None
            with gzip.open(entry.path) as stream:
                found = json.loads(stream.read(_LARGEST))
            if (found["format"], found["key"]) != (FORMAT, entry.key):
                return None
            result: R = decode(found["result"], entry.result)
        except Exception as error:
            # damage takes many forms: of the file, of the text, and whatever a type says to wrong parts
            log.debug("%s is ignored: %r", entry.path, error)
            return None
        return None if result.provisional else result

    def put(self, entry: Entry[R], result: R) -> None:
        """Store a result, unless it is provisional."""
        if result.provisional or not self.writable:
            return
        try:
            data = {"format": FORMAT, "key": entry.key, "result": encode(result, entry.result)}
            text = json.dumps(data, separators=(",", ":")).encode()
            if len(text) < _LARGEST:
                self._write(entry.path, gzip.compress(text, compresslevel=5, mtime=0))
        except Exception as error:
            self._give_up(error)

    def sizes(self) -> list[int]:
        """The sizes of all entries in bytes, of whatever version of singsym; raises `OSError`."""
        return [path.stat().st_size for path in self._files()]

    def clear(self) -> int:
        """Take all entries away, and say how many there were; raises `OSError`."""
        files = self._files()
        for path in files:
            path.unlink(missing_ok=True)
        return len(files)

    def _files(self) -> list[Path]:
        """The files that are entries by their names; nothing else in the folder is singsym's."""
        return sorted(p for p in self.folder.glob("*.json.gz") if _ENTRY.fullmatch(p.name))

    def _write(self, path: Path, data: bytes) -> None:
        if not self.prepared:
            self.folder.mkdir(parents=True, exist_ok=True)
            _sweep(self.folder)
            self.prepared = True
        handle, name = tempfile.mkstemp(dir=self.folder, suffix=".part")
        try:
            with os.fdopen(handle, "wb") as stream:
                stream.write(data)
            os.replace(name, path)
        finally:
            Path(name).unlink(missing_ok=True)

    def _give_up(self, error: Exception) -> None:
        self.writable = False
        reason = error.strerror if isinstance(error, OSError) else error
        if self.folder not in _reported:
            _reported.add(self.folder)
            log.warning("results are not kept in %s: %s", self.folder, reason)


def versions() -> list[str]:
    """Of singsym, to its last line, and of all that its results depend on."""
    libraries = [f"{name} {_version(name)}" for name in ("singsym", *_LIBRARIES)]
    return [_digest_of_sources(), *libraries, *(f"{row.name} {row.version}" for row in engines.status())]


def cache_folder() -> Path | None:
    """Where results are kept: `SINGSYM_CACHE`, else `singsym` in the user's folder for caches.

    A variable that is empty or holds a relative path is as if it were not set.  None without a home folder.

    >>> cache_folder().name
    'singsym'
    """
    chosen = _absolute("SINGSYM_CACHE")
    if chosen is not None:
        return chosen
    base = _absolute("LOCALAPPDATA" if sys.platform == "win32" else "XDG_CACHE_HOME")
    if base is None:
        try:
            base = Path.home() / ".cache"
        except RuntimeError:
            return None
    return base / "singsym" if base.is_absolute() else None


def user_cache() -> Cache | None:
    """The cache in the user's folder, where there is one."""
    folder = cache_folder()
    return None if folder is None else Cache(folder)


def _absolute(variable: str) -> Path | None:
    path = Path(os.environ.get(variable, ""))
    return path if path.is_absolute() else None


def _sweep(folder: Path) -> None:
    """Take away what killed processes left of entries."""
    for part in folder.glob("tmp*.part"):
        with suppress(OSError):
            if time.time() - part.stat().st_mtime > _ABANDONED_SECONDS:
                part.unlink()


@cache
def _types(function: Callable[..., Any]) -> tuple[Any, Any]:
    """The type hints of a function's only argument and of its result."""
    hints = get_type_hints(function)
    result = hints.pop("return", None)
    if len(hints) != 1 or result is None:
        raise TypeError(f"{function.__qualname__} is not annotated with one argument and a result")
    return next(iter(hints.values())), result


@cache
def _digest_of_sources() -> str:
    """The digest of singsym as it is here: a working copy never reads what older code wrote."""
    found = hashlib.sha256()
    for path in sorted(Path(__file__).parents[2].rglob("*.py")):
        found.update(path.read_bytes())
    return found.hexdigest()


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""
