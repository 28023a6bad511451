"""The cache on disk: its keys, what it refuses, and what it does where it cannot read or write."""

from __future__ import annotations

import gzip
import json
import logging
import os
import pickle
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from singsym.classes.running import disk_cache as module
from singsym.classes.running.disk_cache import Cache, cache_folder, user_cache
from singsym.elimination import engines
from singsym.polynomials import Polynomial, Ring

X, Y = Ring(("x", "y")).gens


@dataclass(frozen=True)
class Given:
    """A task."""

    polynomial: Polynomial
    level: int = 0


@dataclass(frozen=True)
class Found:
    """A result that more time could improve where its degree is negative."""

    degree: int
    text: str = ""

    @property
    def provisional(self) -> bool:
        return self.degree < 0


def degree(task: Given) -> Found:
    return Found(task.polynomial.total_degree)


def other(task: Given) -> Found:
    return Found(0)


def bare(task):  # type: ignore[no-untyped-def]
    return Found(0)


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "results")


@pytest.fixture(autouse=True)
def _no_warning_yet() -> Iterator[None]:
    module._reported.clear()
    yield
    module._reported.clear()


def stored(cache: Cache, found: Found = Found(1)) -> module.Entry[Found]:
    """The entry of a task whose result was put there."""
    entry = cache.entry(degree, Given(X))
    assert entry is not None
    cache.put(entry, found)
    return entry


def test_a_result_is_found_again_by_another_process_of_the_same_program(cache: Cache) -> None:
    stored(cache, Found(1, "ä"))
    again = Cache(cache.folder)
    entry = again.entry(degree, Given(X))
    assert entry is not None
    assert again.get(entry) == Found(1, "ä")


def test_provisional_results_are_neither_kept_nor_believed(cache: Cache) -> None:
    entry = stored(cache, Found(-1))
    assert not entry.path.exists()
    forged = stored(cache, Found(1)).path
    data = json.loads(gzip.decompress(forged.read_bytes()))
    data["result"]["shared"] = [[-1, ""]]
    forged.write_bytes(gzip.compress(json.dumps(data).encode()))
    assert cache.get(entry) is None


# -- keys --------------------------------------------------------------------------------------------


def test_keys_depend_on_all_that_a_result_depends_on(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    def key(function: object = degree, task: Given = Given(X), cache: Cache = cache) -> str:
        entry = cache.entry(function, task)  # type: ignore[type-var,arg-type]
        assert entry is not None
        return entry.key

    keys = [key(), key(other), key(task=Given(Y)), key(task=Given(X, 1))]
    with engines.use("flint"):
        keys.append(key())
    larger = Ring(("x", "y", "z"))
    keys.append(key(task=Given(larger.convert(X))))
    rows = engines.status()
    newer = (*rows[:2], replace(rows[2], version="99"), *rows[3:])
    for name, changed in {
        "FORMAT": "another",
        "_digest_of_sources": lambda: "other code",
        "_version": lambda package: "99" if package == "python-flint" else "1",
    }.items():
        with monkeypatch.context() as patch:
            patch.setattr(module, name, changed)
            keys.append(key(cache=Cache(cache.folder)))
    with monkeypatch.context() as patch:
        patch.setattr(engines, "status", lambda: newer)
        keys.append(key(cache=Cache(cache.folder)))
    assert len(set(keys)) == len(keys)
    assert key(cache=Cache(cache.folder)) == keys[0]


def test_the_digest_is_that_of_the_sources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A copy with one more line has another one."""
    folder = tmp_path / "singsym"
    shutil.copytree(Path(module.__file__).parents[2], folder, ignore=shutil.ignore_patterns("__pycache__"))
    digest = module._digest_of_sources.__wrapped__
    before = digest()
    monkeypatch.setattr(module, "__file__", str(folder / "classes" / "running" / "disk_cache.py"))
    assert digest() == before
    with (folder / "polynomials" / "ring.py").open("a") as source:
        source.write("# a comment\n")
    assert digest() != before


# -- entries that are not what they should be --------------------------------------------------------


class Running:
    """What a pickle can do."""

    def __reduce__(self) -> tuple[object, tuple[str]]:
        return os.mkdir, ("made by a pickle",)


def header(entry: module.Entry[Found], **changes: object) -> bytes:
    """A whole entry, with changes."""
    found = {"format": module.FORMAT, "key": entry.key, "result": {"shared": [[7, ""]], "value": 0}}
    return gzip.compress(json.dumps(found | changes).encode())


BAD = {
    "empty": lambda entry, whole: b"",
    "cut": lambda entry, whole: whole[:-9],
    "cut early": lambda entry, whole: whole[:7],
    "a bit": lambda entry, whole: whole[:30] + bytes([whole[30] ^ 4]) + whole[31:],
    "more": lambda entry, whole: whole + b"more",
    "no gzip": lambda entry, whole: gzip.decompress(whole),
    "zeros": lambda entry, whole: bytes(10_000),
    "a pickle": lambda entry, whole: pickle.dumps(Running()),
    "a pickle in gzip": lambda entry, whole: gzip.compress(pickle.dumps(Running())),
    "no text": lambda entry, whole: gzip.compress(b"\xff\xfe\xfd"),
    "no JSON": lambda entry, whole: gzip.compress(b'{"format": '),
    "deep": lambda entry, whole: gzip.compress(b"[" * 100_000),
    "a long number": lambda entry, whole: gzip.compress(b"9" * 10_000),
    "null": lambda entry, whole: gzip.compress(b"null"),
    "a list": lambda entry, whole: gzip.compress(b"[1, 2]"),
    "no header": lambda entry, whole: gzip.compress(b"{}"),
    "another format": lambda entry, whole: header(entry, format="singsym result 1"),
    "another task": lambda entry, whole: header(entry, key="0" * 64),
    "no result": lambda entry, whole: header(entry, result=None),
    "another type": lambda entry, whole: header(entry, result={"shared": [["a", ""]], "value": 0}),
    "too many fields": lambda entry, whole: header(entry, result={"shared": [[7, "", 1]], "value": 0}),
    "in a circle": lambda entry, whole: header(entry, result={"shared": [0], "value": 0}),
}


@pytest.mark.parametrize("kind", BAD)
def test_bad_entries_are_ignored_and_written_anew(
    kind: str, cache: Cache, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    entry = stored(cache)
    assert cache.get(entry) == Found(1)
    entry.path.write_bytes(BAD[kind](entry, entry.path.read_bytes()))
    assert cache.get(entry) is None
    assert not (tmp_path / "made by a pickle").exists()
    cache.put(entry, Found(1))
    assert cache.get(entry) == Found(1)


def test_the_entries_made_here_are_right_but_for_their_fault(cache: Cache) -> None:
    entry = stored(cache)
    entry.path.write_bytes(header(entry))
    assert cache.get(entry) == Found(7)


def test_swapped_entries_are_ignored(cache: Cache) -> None:
    one, two = stored(cache), cache.entry(degree, Given(Y**2))
    assert two is not None
    cache.put(two, Found(2))
    one.path.rename(cache.folder / "between")
    two.path.rename(one.path)
    (cache.folder / "between").rename(two.path)
    assert cache.get(one) is None
    assert cache.get(two) is None


def test_an_entry_that_is_no_file_is_ignored(cache: Cache, caplog: pytest.LogCaptureFixture) -> None:
    entry = stored(cache)
    entry.path.unlink()
    entry.path.mkdir()
    assert cache.get(entry) is None
    cache.put(entry, Found(1))
    assert len(caplog.records) == 1
    assert not list(cache.folder.glob("*.part"))


# -- folders that cannot be written to ---------------------------------------------------------------


def test_what_cannot_be_written_costs_one_warning(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "results"

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    for _ in range(2):
        cache = Cache(folder)
        for level in range(3):
            entry = cache.entry(degree, Given(X, level))
            assert entry is not None
            cache.put(entry, Found(1))
    assert [(r.levelno, r.getMessage()) for r in caplog.records] == [
        (logging.WARNING, f"results are not kept in {folder}: No space left on device")
    ]
    assert list(folder.iterdir()) == []


def test_a_folder_that_is_a_file(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "file").touch()
    for folder in (tmp_path / "file", tmp_path / "file" / "singsym"):
        cache = Cache(folder)
        assert cache.get(stored(cache)) is None
    assert len(caplog.records) == 2


def test_tasks_and_results_of_other_types_are_not_kept(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    assert Cache(tmp_path / "a").entry(bare, Given(X)) is None
    assert Cache(tmp_path / "b").entry(degree, Given(X, "high")) is None  # type: ignore[arg-type]
    stored(Cache(tmp_path / "c"), Found(1, 2))  # type: ignore[arg-type]
    assert len(caplog.records) == 3
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


def test_parts_that_killed_processes_left_are_taken_away(cache: Cache) -> None:
    """Those of an hour ago; another process may be at work on newer ones."""
    cache.folder.mkdir()
    old, new = cache.folder / "tmpold.part", cache.folder / "tmpnew.part"
    old.touch()
    new.touch()
    os.utime(old, (1e9, 1e9))
    stored(cache)
    assert not old.exists()
    assert new.exists()


# -- where it is -------------------------------------------------------------------------------------


@pytest.mark.skipif(sys.platform == "win32", reason="the XDG rules are those of Unix")
@pytest.mark.parametrize(
    ("variables", "place"),
    [
        ({}, "/home/me/.cache/singsym"),
        ({"XDG_CACHE_HOME": "/caches"}, "/caches/singsym"),
        ({"XDG_CACHE_HOME": ""}, "/home/me/.cache/singsym"),
        ({"XDG_CACHE_HOME": "caches"}, "/home/me/.cache/singsym"),
        ({"XDG_CACHE_HOME": "~/caches"}, "/home/me/.cache/singsym"),
        ({"XDG_CACHE_HOME": "/caches", "SINGSYM_CACHE": "/mine"}, "/mine"),
        ({"XDG_CACHE_HOME": "/caches", "SINGSYM_CACHE": ""}, "/caches/singsym"),
        ({"XDG_CACHE_HOME": "/caches", "SINGSYM_CACHE": "mine"}, "/caches/singsym"),
        ({"HOME": "me"}, None),
    ],
)
def test_the_folder(variables: dict[str, str], place: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    """XDG Base Directory Specification: all paths must be absolute; a relative one is ignored."""
    monkeypatch.delenv("SINGSYM_CACHE", raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    for name, value in ({"HOME": "/home/me"} | variables).items():
        monkeypatch.setenv(name, value)
    assert cache_folder() == (None if place is None else Path(place))
    assert (user_cache() is None) == (place is None)


# -- with real processes -----------------------------------------------------------------------------

LIMITED = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
from singsym.cli import main
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="limits of files are those of POSIX")
@pytest.mark.parametrize("fault", ["no space", "a file", "/dev/null"])
def test_the_answer_is_printed_all_the_same(fault: str, tmp_path: Path) -> None:
    """no space: files that may not grow, as on a full disk."""
    (tmp_path / "file").touch()
    place = {"no space": str(tmp_path / "new"), "a file": str(tmp_path / "file"), "/dev/null": "/dev/null"}
    variables = {name: value for name, value in os.environ.items() if name != "SINGSYM_CACHE"}
    program = ["-c", LIMITED] if fault == "no space" else ["-m", "singsym"]
    done = subprocess.run(
        [sys.executable, *program, "classify", "fourbar", "--workers", "1"],
        capture_output=True,
        text=True,
        env={**variables, "XDG_CACHE_HOME": place[fault], "PYTHONDONTWRITEBYTECODE": "1"},
        cwd=Path(__file__).parents[3],
    )
    assert done.returncode == 0
    assert done.stdout.startswith("Locks")
    assert len(done.stderr.splitlines()) == 1
    assert done.stderr.startswith("results are not kept in ")
    assert not list(tmp_path.rglob("*.part"))
