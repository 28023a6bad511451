"""The program in odd surroundings, as real processes: an answer, or a line that says why not."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import psutil
import pytest

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="streams, limits and signals of POSIX")
ROOT = Path(__file__).parents[2]
ARM = """title = "An arm of two µm"
inputs = ["A", "B"]
output = { velocity = "C" }
[links]
ground = { points = { A = [0, 0] } }
AB = 1
BC = "1/2"
[joints]
A = "R"
B = "R"
"""
QUICK = ("classify", "slider-crank", "--workers", "1")


@pytest.fixture
def surroundings(tmp_path: Path) -> dict[str, str]:
    return {**os.environ, "SINGSYM_CACHE": str(tmp_path / "cache"), "PYTHONPATH": str(ROOT)}


def run(
    arguments: tuple[str, ...],
    environment: dict[str, str],
    before: Callable[[], object] | None = None,
    stdout: int = subprocess.PIPE,
    stderr: int = subprocess.PIPE,
) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "singsym", *arguments]
    return subprocess.run(
        command, stdout=stdout, stderr=stderr, text=True, env=environment, preexec_fn=before, timeout=300
    )


def answer(text: str) -> str:
    """What a command printed, without its last line: the seed and the time."""
    lines = text.splitlines()
    assert re.match(r"Engines: .*; seed \d+; ", lines[-1])
    return "\n".join(lines[:-1])


# -- streams -------------------------------------------------------------------------------------------


def test_a_closed_standard_output(surroundings: dict[str, str]) -> None:
    done = run(("list",), surroundings, before=lambda: os.close(1), stdout=None)
    assert done.returncode == 74
    assert done.stderr == "singsym: standard output is closed, there is nowhere to print to\n"


def test_closed_messages_go_nowhere(surroundings: dict[str, str]) -> None:
    done = run((*QUICK, "--progress"), surroundings, before=lambda: os.close(2), stderr=None)
    assert done.returncode == 0
    assert done.stdout.startswith("Locks")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_a_full_disk_under_the_output(surroundings: dict[str, str]) -> None:
    with open("/dev/full", "w") as full:
        done = run(("list",), surroundings, stdout=full.fileno())
    assert done.returncode == 74
    assert re.fullmatch(r"singsym list: standard output cannot be used: .+\n", done.stderr)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_a_full_disk_under_the_messages(surroundings: dict[str, str]) -> None:
    with open("/dev/full", "w") as full:
        done = run((*QUICK, "--progress"), surroundings, stderr=full.fileno())
    assert done.returncode == 0
    assert done.stdout.startswith("Locks")


def test_a_reader_that_goes_away(surroundings: dict[str, str]) -> None:
    read, write = os.pipe()
    os.close(read)
    done = run(("list",), surroundings, stdout=write)
    os.close(write)
    assert (done.returncode, done.stderr) == (141, "")


@pytest.mark.parametrize(
    "variables",
    [{"PYTHONIOENCODING": "ascii"}, {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}],
)
def test_a_terminal_of_ascii(variables: dict[str, str], surroundings: dict[str, str], tmp_path: Path) -> None:
    """The title has signs that ASCII has not."""
    (tmp_path / "mine.toml").write_text(ARM, encoding="utf-8")
    done = run(("show", str(tmp_path / "mine.toml")), surroundings | variables)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("mine: An arm of two ")


# -- folders and limits --------------------------------------------------------------------------------


@pytest.mark.parametrize("missing", ["HOME", "TMPDIR", "both point nowhere"])
def test_folders_that_are_not_there(missing: str, surroundings: dict[str, str]) -> None:
    del surroundings["SINGSYM_CACHE"]
    if "both" in missing:
        surroundings |= {"HOME": "/nonexistent/home", "TMPDIR": "/nonexistent/tmp"}
    else:
        surroundings.pop(missing, None)
    done = run((*QUICK, "--no-cache"), surroundings)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_file_without_an_end(surroundings: dict[str, str]) -> None:
    done = run(("at", "2r", "--config", "/dev/zero"), surroundings)
    assert done.returncode == 2
    assert "expected a file of at most" in done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="address space is limited on Linux")
@pytest.mark.parametrize(("limit", "soft"), [("RLIMIT_NOFILE", 16), ("RLIMIT_AS", 1_500_000_000)])
def test_few_files_and_little_memory(limit: str, soft: int, surroundings: dict[str, str]) -> None:
    import resource

    kind = getattr(resource, limit)
    done = run(
        ("classify", "slider-crank", "--workers", "2", "--budget", "100"),
        surroundings,
        before=lambda: resource.setrlimit(kind, (soft, soft)),
    )
    assert "Traceback" not in done.stderr
    assert done.returncode in (0, 3)
    assert "class" in done.stdout


# -- other runs ----------------------------------------------------------------------------------------


def test_two_runs_on_one_cache(surroundings: dict[str, str]) -> None:
    command = [sys.executable, "-m", "singsym", *QUICK]
    runs = [
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=surroundings)
        for _ in range(2)
    ]
    ended = [process.communicate(timeout=300) for process in runs]
    assert [process.returncode for process in runs] == [0, 0]
    assert [err for _, err in ended] == ["", ""]
    assert answer(ended[0][0]) == answer(ended[1][0])


def test_a_killed_run_goes_on(tmp_path: Path, surroundings: dict[str, str]) -> None:
    """SIGKILL once some results are kept: the next run answers as if there had been none."""
    cache = tmp_path / "cache"
    command = [sys.executable, "-m", "singsym", "classify", "fourbar", "--workers", "1"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=surroundings)
    end = time.monotonic() + 120
    while process.poll() is None and time.monotonic() < end and not list(cache.glob("*.json.gz")):
        time.sleep(0.002)
    children = psutil.Process(process.pid).children(recursive=True) if process.poll() is None else []
    process.send_signal(signal.SIGKILL)
    process.communicate(timeout=60)
    assert list(cache.glob("*.json.gz"))
    _, alive = psutil.wait_procs(children, timeout=20)
    assert not [p for p in alive if p.status() != psutil.STATUS_ZOMBIE]
    again = run(tuple(command[3:]), surroundings)
    fresh = run((*command[3:], "--no-cache"), surroundings)
    assert (again.returncode, again.stderr) == (fresh.returncode, "")
    assert answer(again.stdout) == answer(fresh.stdout)
