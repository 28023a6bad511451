"""Ctrl-C, SIGTERM and killed processes while work is going on: what is printed, and no process left."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import psutil
import pytest

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="process groups and signals of POSIX")


@contextmanager
def classifying(
    mechanism: str, workers: int, folder: Path, *options: str
) -> Iterator[tuple[subprocess.Popen[str], list[psutil.Process]]]:
    """The program at work on a mechanism, and its children once they are at work too."""
    command = [sys.executable, "-m", "singsym", "classify", mechanism, "--workers", str(workers), *options]
    process = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        cwd=Path(__file__).parents[2],
        env={**os.environ, "SINGSYM_CACHE": str(folder)},
        # a test run in the background of a shell ignores Ctrl-C, and so would its children
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        # an engine; or the fork server, its resource tracker and the workers
        expected, end = 1 if workers == 1 else 2 + workers, time.monotonic() + 300
        while len(children := psutil.Process(process.pid).children(recursive=True)) < expected:
            assert time.monotonic() < end
            time.sleep(0.1)
        time.sleep(1)
        yield process, children
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)


def all_end(processes: list[psutil.Process], seconds: float = 10) -> bool:
    """Whether none is left; a zombie that nobody waits for has ended."""
    end = time.monotonic() + seconds
    while left := [p for p in processes if p.is_running() and p.status() != psutil.STATUS_ZOMBIE]:
        if time.monotonic() > end:
            return not left
        time.sleep(0.05)
    return True


@pytest.mark.parametrize("workers", [1, 2])
def test_ctrl_c(workers: int, tmp_path: Path) -> None:
    with classifying("zlatanov-hybrid-3-2", workers, tmp_path) as (process, children):
        os.killpg(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=120)
    assert process.returncode == 130
    assert "it was interrupted" in out
    assert out.count("undecided") >= 21
    assert err.startswith("singsym classify: interrupted during ")
    assert "Traceback" not in err
    assert all_end(children)


@pytest.mark.parametrize("ending", [signal.SIGTERM, signal.SIGKILL])
def test_a_program_that_is_killed_leaves_nothing(ending: signal.Signals, tmp_path: Path) -> None:
    with classifying("zlatanov-hybrid-3-2", 2, tmp_path) as (process, children):
        process.send_signal(ending)
        out, err = process.communicate(timeout=120)
    assert process.returncode == (143 if ending == signal.SIGTERM else -signal.SIGKILL)
    assert ("it was interrupted" in out) == (ending == signal.SIGTERM)
    assert ("interrupted during " in err) == (ending == signal.SIGTERM)
    assert "Traceback" not in err
    assert all_end(children)
    assert not list(tmp_path.glob("*.part"))
