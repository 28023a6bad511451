"""Processes that die, fail, or are left behind: real ones."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import Future
from pathlib import Path

import psutil
import pytest

from singsym.classes.running.processes import Processes, WorkerDied

posix = pytest.mark.skipif(os.name != "posix", reason="processes are killed with POSIX signals")


@pytest.fixture
def two() -> Iterator[Processes]:
    with Processes(2) as executor:
        yield executor


def square(x: int) -> int:
    return x * x


def killed(x: int) -> int:
    os.kill(os.getpid(), signal.SIGKILL)
    return x


def ended(x: int) -> int:
    os._exit(x)


def killed_once(trace: str) -> str:
    """Ends its first process, and leaves a file that says so."""
    if not os.path.exists(trace):
        Path(trace).touch()
        os._exit(1)
    return "done"


def failing(x: int) -> int:
    raise ValueError(f"no {x}")


def test_results_and_exceptions(two: Processes) -> None:
    futures = [two.submit(square, x) for x in range(6)]
    bad = two.submit(failing, 7)
    assert [f.result() for f in futures] == [0, 1, 4, 9, 16, 25]
    with pytest.raises(ValueError, match="no 7") as raised:
        bad.result()
    assert "in failing" in raised.value.__notes__[0]


@posix
def test_only_the_call_of_a_dead_process_is_lost(two: Processes) -> None:
    first = [two.submit(killed, 1), two.submit(square, 3), two.submit(ended, 5)]
    others = [two.submit(square, x) for x in range(4)]
    with pytest.raises(WorkerDied, match="was killed by SIGKILL"):
        first[0].result()
    with pytest.raises(WorkerDied, match="ended with exit code 5"):
        first[2].result()
    assert first[1].result() == 9
    assert [f.result() for f in others] == [0, 1, 4, 9]


def test_a_second_try(two: Processes, tmp_path: Path) -> None:
    assert two.submit(killed_once, str(tmp_path / "trace")).result() == "done"


def test_an_exception_ends_the_processes_at_once(tmp_path: Path) -> None:
    futures: list[Future[None]] = []

    def interrupted() -> None:
        with Processes(2) as executor:
            futures.extend(executor.submit(asleep, str(tmp_path)) for _ in range(4))
            while len(list(tmp_path.iterdir())) < 2:
                time.sleep(0.05)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert all(f.cancelled() or isinstance(f.exception(5), WorkerDied) for f in futures)
    assert not any(alive(int(trace.name)) for trace in tmp_path.iterdir())


def asleep(folder: str) -> None:
    """Sleeps, and leaves a file with the number of its process."""
    Path(folder, str(os.getpid())).touch()
    time.sleep(600)


def test_no_call_after_the_end() -> None:
    executor = Processes(2)
    executor.shutdown()
    with pytest.raises(RuntimeError, match="shut down"):
        executor.submit(square, 1)


MODULE = """
import os, sys, time

def busy(path, holding):
    open(os.path.join(path, str(os.getpid())), "w").close()
    if holding:
        return bool(3 ** (10 ** 9))
    time.sleep(600)
"""

SCRIPT = """
import sys
from busyness import busy
from singsym.classes.running.processes import Processes

print("begun", flush=True)
with Processes(2) as executor:
    for future in [executor.submit(busy, sys.argv[1], sys.argv[2] == "holding") for _ in range(2)]:
        future.result()
"""


def script(folder: Path) -> list[str]:
    """The command of a program with two busy workers, without a guard of its own work."""
    path = folder / "program.py"
    path.write_text(SCRIPT)
    (folder / "busyness.py").write_text(MODULE)
    (folder / "busy").mkdir()
    return [sys.executable, str(path), str(folder / "busy")]


@posix
@pytest.mark.parametrize("ending", ["SIGKILL", "SIGTERM"])
@pytest.mark.parametrize("work", ["sleeping", "holding"])
def test_nothing_outlives_a_killed_parent(tmp_path: Path, ending: str, work: str) -> None:
    """holding: a call that lets no other thread of Python run, as those of FLINT do."""
    if work == "holding" and sys.platform != "linux":
        pytest.skip("only Linux ends processes in the midst of such a call")
    command = script(tmp_path)
    program = subprocess.Popen([*command, work], start_new_session=True)
    try:
        while len(list((tmp_path / "busy").iterdir())) < 2:
            assert program.poll() is None
            time.sleep(0.05)
        children = {child.pid for child in psutil.Process(program.pid).children(recursive=True)}
        assert {int(trace.name) for trace in (tmp_path / "busy").iterdir()} <= children
        program.send_signal(getattr(signal, ending))
        program.wait(10)
        end = time.monotonic() + 20
        while any(map(alive, children)):
            assert time.monotonic() < end
            time.sleep(0.05)
    finally:
        program.kill()


def alive(number: int) -> bool:
    """Whether a process is there; a zombie that nobody waits for has ended."""
    try:
        return bool(psutil.Process(number).status() != psutil.STATUS_ZOMBIE)
    except psutil.NoSuchProcess:
        return False


def test_a_script_without_a_guard_is_run_once(tmp_path: Path) -> None:
    """Its workers do not run it again, and classify a mechanism as one process does."""
    path = tmp_path / "program.py"
    path.write_text(
        "import singsym\n"
        "print('begun')\n"
        "result = singsym.classify(singsym.load('slider-crank'), workers=2, cache=False)\n"
        "print(result[1].points)\n"
    )
    done = subprocess.run([sys.executable, str(path)], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout.split(), done.stderr) == (0, ["begun", "2"], "")
