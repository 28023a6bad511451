"""Engines that die, hang, lie or print rubbish, as real processes: nothing wrong is said, nothing hangs."""

from __future__ import annotations

import contextlib
import os
import signal
import stat
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path

import psutil
import pytest

from singsym.effort import patience
from singsym.effort.budget import Budget, BudgetExceeded, Cancelled, Undecided
from singsym.elimination import engines
from singsym.elimination.engines import registry
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Ring

pytestmark = pytest.mark.skipif(os.name != "posix", reason="processes are killed with POSIX signals")
MSOLVE, SINGULAR = registry.msolve.path(), registry.singular.path()
needs_msolve = pytest.mark.skipif(not MSOLVE, reason="msolve is not installed")
needs_singular = pytest.mark.skipif(not SINGULAR, reason="Singular is not installed")

R = Ring(("x", "y", "z"))
x, y, z = R.gens
SMALL = (x**2 + y * z - 1, y**2 + x * z - 2, z**2 + x * y - 3)


def script(tmp_path: Path, body: str) -> str:
    """An executable Python program."""
    path = tmp_path / "engine"
    path.write_text(f"#!{sys.executable}\n" + textwrap.dedent(body))
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return str(path)


def gone(pid: int) -> bool:
    """Whether a process ends within five seconds (a zombie nobody waits for has ended)."""
    for _ in range(100):
        try:
            if psutil.Process(pid).status() == psutil.STATUS_ZOMBIE:
                return True
        except psutil.NoSuchProcess:
            return True
        time.sleep(0.05)
    return False


def kill_when_busy(find: object, times: int = 1) -> threading.Thread:
    """Kill -9 each process that `find` shows, a moment after it started to work."""
    assert callable(find)

    def hunt() -> None:
        killed: set[int] = set()
        end = time.monotonic() + 20
        while len(killed) < times and time.monotonic() < end:
            pid = find()
            if pid and pid not in killed:
                time.sleep(0.2)
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
                    killed.add(pid)
            time.sleep(0.01)

    thread = threading.Thread(target=hunt, daemon=True)
    thread.start()
    return thread


def worker() -> int | None:
    return registry.flint.worker.process_id


# -- killed ----------------------------------------------------------------------------------------


def test_flint_killed_once_starts_again(katsura) -> None:
    system = katsura(6)
    hunter = kill_when_busy(worker)
    with engines.use("flint"):
        assert Ideal(*system).vector_space_dimension.value == 64
    hunter.join()


@needs_msolve
def test_flint_killed_twice_hands_over(cyclic) -> None:
    hunter = kill_when_busy(worker, times=2)
    ideal = Ideal(*cyclic(6))
    assert ideal.vector_space_dimension.value == 156
    assert "msolve" in ideal.engine
    hunter.join()


def test_flint_alone_killed_twice_is_undecided(cyclic) -> None:
    hunter = kill_when_busy(worker, times=2)
    with engines.use("flint"), pytest.raises(engines.EngineFailure, match="flint: died"):
        Ideal(*cyclic(7)).groebner_basis()
    hunter.join()


@needs_singular
def test_singular_killed_while_it_works(cyclic) -> None:
    def singular() -> int | None:
        child = registry.singular._child
        return child.process.pid if child is not None and child.running else None

    hunter = kill_when_busy(singular, times=2)
    with engines.use("singular"):
        with pytest.raises(engines.EngineFailure, match="singular: died"):
            Ideal(*cyclic(7)).groebner_basis()
        hunter.join()
        assert Ideal(R, SMALL).degree.value == 8


# -- lies and rubbish ------------------------------------------------------------------------------

LIES = {
    "one generator more": "text = text.replace('[', '[1*x1^1-7,\\n', 1)",
    "one generator less": "text = text.replace('[', '[', 1).rsplit(',', 1)[0] + ']:\\n'",
    "a wrong coefficient": "text = text.replace('2', '5')",
    "the unit ideal": "text = text[: text.index('[')] + '[1]:\\n'",
    "the zero ideal": "text = text[: text.index('[')] + '[]:\\n'",
    "the inputs": "text = text[: text.index('[')] + '[' + source.split('\\n', 2)[2].strip() + ']:\\n'",
    "half an answer": "text = text[: len(text) // 2]",
    "nothing": "text = ''",
    "prose": "text = 'Segmentation fault'",
    "another order of variables": "text = text.replace('x1, x2', 'x2, x1')",
}


@needs_msolve
@pytest.mark.parametrize("lie", LIES)
@pytest.mark.parametrize("size", ["small", "large"])
def test_a_wrapper_of_msolve_that_lies(
    lie: str, size: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, katsura
) -> None:
    """It lies about bases over Q and modulo a prime alike; large: FLINT is no help in the check."""
    body = f"""
        import subprocess, sys
        arguments = sys.argv[1:]
        code = subprocess.call([{MSOLVE!r}, *arguments])
        target = arguments[arguments.index("-o") + 1]
        source = open(arguments[arguments.index("-f") + 1]).read()
        text = open(target).read()
        {LIES[lie]}
        open(target, "w").write(text)
        sys.exit(code)
    """
    monkeypatch.setenv("SINGSYM_MSOLVE", script(tmp_path, body))
    system = (R, SMALL) if size == "small" else katsura(6)
    with engines.use("flint"):
        expected = Ideal(*system).groebner_basis().value
    with engines.use("msolve"):
        if size == "small" or registry.singular.available() or lie != "one generator more":
            with pytest.raises(engines.EngineFailure):
                Ideal(*system).groebner_basis()
    with engines.use("msolve", "flint"):
        ideal = Ideal(*system)
        assert ideal.groebner_basis().value == expected
        assert ideal.engine in ("flint", "flint, linear algebra")


SINGULAR_LIES = {
    "one generator more": "line = line.replace('I', 'I\\nP x1-7')",
    "a generator lost": "line = '' if line.startswith('P') and '^2' in line else line",
    "an error message": "line = '   ? something went wrong\\n' if line.startswith('P') else line",
    "rubbish": "line = line.replace('P', 'P foo(')",
    "the unit ideal": "line = 'P 1\\n' if line.startswith('P') else line",
}


@needs_singular
@pytest.mark.parametrize("lie", SINGULAR_LIES)
def test_a_wrapper_of_singular_that_lies(lie: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    body = f"""
        import subprocess, sys
        child = subprocess.Popen([{SINGULAR!r}, *sys.argv[1:]], stdout=subprocess.PIPE, text=True)
        for line in child.stdout:
            {SINGULAR_LIES[lie]}
            sys.stdout.write(line)
            sys.stdout.flush()
    """
    monkeypatch.setenv("SINGSYM_SINGULAR", script(tmp_path, body))
    ideal = Ideal(R, (x * y * (z - 1), z * (x**2 - 2)))
    with engines.use("singular"), pytest.raises(Undecided):
        Ideal(R, SMALL).groebner_basis()
    with engines.use("flint", "singular"), pytest.raises(Undecided):
        ideal.minimal_primes()
    assert Ideal(R, SMALL).degree.value == 8


@needs_singular
def test_a_component_left_out_is_noticed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    body = f"""
        import subprocess, sys
        child = subprocess.Popen([{SINGULAR!r}, *sys.argv[1:]], stdout=subprocess.PIPE, text=True)
        pieces = 0
        for line in child.stdout:
            pieces += line == "I\\n"
            if line[0] not in "IP" or pieces > 1:
                sys.stdout.write(line)
            sys.stdout.flush()
    """
    monkeypatch.setenv("SINGSYM_SINGULAR", script(tmp_path, body))
    ideal = Ideal(R, (x * y * (z - 1), z * (x**2 - 2)))
    with engines.use("flint", "singular"), pytest.raises(engines.EngineFailure, match="component is missing"):
        ideal.minimal_primes()


@pytest.mark.parametrize("program", ["import sys; sys.exit(1)", "print('no')"])
def test_broken_engines_leave_the_time_to_flint(
    program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, katsura
) -> None:
    """FLINT has a moment at first, then the others, which fail, then FLINT has the rest."""
    monkeypatch.setenv("SINGSYM_SINGULAR", script(tmp_path, program))
    monkeypatch.setenv("SINGSYM_MSOLVE", script(tmp_path, program))
    monkeypatch.setitem(patience.FIRST, "flint", patience.Patience(0.01, "msolve is asked"))
    ideal = Ideal(*katsura(6))
    assert ideal.vector_space_dimension.value == 64
    assert (ideal.groebner_basis().certainty, ideal.engine) == ("proven", "flint")


# -- pipes, time, memory ---------------------------------------------------------------------------

DEAF = {
    "it never reads": "import time\ntime.sleep(600)",
    "it fills its pipe and never reads": "import time\nprint('x' * 10**6, flush=True)\ntime.sleep(600)",
    "it prints for ever": "while True: print('x' * 1000)",
    "it ends at once": "",
    "it closes its pipe and stays": "import os, time\nos.close(1)\ntime.sleep(600)",
}


@pytest.mark.parametrize("manner", DEAF)
def test_a_full_pipe_blocks_nobody(manner: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "engine"
    program.write_text(f"#!{sys.executable}\n{DEAF[manner]}\n")
    program.chmod(0o755)
    monkeypatch.setenv("SINGSYM_SINGULAR", str(program))
    monkeypatch.setenv("SINGSYM_MSOLVE", str(program))
    long = sum((x**i * y**j * (7**90 + i) for i in range(40) for j in range(40)), start=R.zero)
    for name in ("singular", "msolve"):
        start = time.monotonic()
        with engines.use(name), pytest.raises(Undecided):
            Ideal(R, (long + z**2, z**3 - x * y)).groebner_basis(Budget(1))
        assert time.monotonic() - start < 4


@pytest.mark.parametrize("name", ["flint", "sympy", "msolve", "singular"])
def test_one_second_is_one_second(name: str, cyclic) -> None:
    if not registry._ENGINES[name].available():
        pytest.skip(f"{name} is not installed")
    before = set(psutil.Process().children(recursive=True))
    start = time.monotonic()
    with engines.use(name), pytest.raises(BudgetExceeded):
        Ideal(*cyclic(8)).groebner_basis(Budget(1))
    assert time.monotonic() - start < 2
    assert all(gone(p.pid) for p in set(psutil.Process().children(recursive=True)) - before)
    assert Ideal(*cyclic(8)).unit_verdict(Budget(0.3)).is_undecided


def test_called_off_from_outside(cyclic) -> None:
    stop = threading.Event()
    threading.Timer(0.3, stop.set).start()
    with engines.use("flint"), pytest.raises(Cancelled):
        Ideal(*cyclic(7)).groebner_basis(Budget(cancelled=stop.is_set))


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="memory is watched through /proc")
def test_memory_has_a_limit(cyclic) -> None:
    with engines.use("sympy"), pytest.raises(Undecided, match="MB"):
        Ideal(*cyclic(6)).groebner_basis(Budget(30, memory_mb=20))


def test_no_engine_at_all(monkeypatch: pytest.MonkeyPatch, cyclic) -> None:
    monkeypatch.setenv("SINGSYM_SINGULAR", "/nowhere/Singular")
    monkeypatch.setenv("SINGSYM_MSOLVE", "")
    rows = {row.name: row for row in engines.status()}
    assert rows["flint"].found
    assert not rows["singular"].found
    assert not rows["msolve"].found
    assert "singsym engines --install" in rows["msolve"].how_to_get
    assert Ideal(R, SMALL).degree.value == 8
    assert Ideal(*cyclic(6)).unit_verdict(Budget(1)).is_undecided
    with engines.use("singular"), pytest.raises(engines.EngineUnavailable, match="singular cannot"):
        Ideal(R, SMALL).groebner_basis()
    with pytest.raises(engines.EngineUnavailable, match="engines --install"):
        Ideal(R, (x**2 - 2, y**2 - 2, z**2 - x * y)).minimal_primes()


# -- the parent ends -------------------------------------------------------------------------------

WORK = """
import sys, threading
from singsym.effort import patience
from singsym.elimination import engines
from singsym.elimination.engines import registry
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Ring
R = Ring(tuple("abcdefgh"))
c, n, rows = R.gens, 8, []
for length in range(1, n):
    row = R.zero
    for i in range(n):
        p = R.one
        for j in range(length):
            p = p * c[(i + j) % n]
        row = row + p
    rows.append(row)
rows.append(c[0]*c[1]*c[2]*c[3]*c[4]*c[5]*c[6]*c[7] - 1)
print("ready", flush=True)
with engines.use(sys.argv[1]):
    Ideal(R, rows).groebner_basis()
"""


@pytest.mark.parametrize("ending", [signal.SIGKILL, signal.SIGINT])
@pytest.mark.parametrize("name", ["flint", "msolve", "singular"])
def test_children_end_with_their_parent(name: str, ending: signal.Signals) -> None:
    if not registry._ENGINES[name].available():
        pytest.skip(f"{name} is not installed")
    if ending == signal.SIGKILL and not sys.platform.startswith("linux"):
        pytest.skip("only Linux kills the children of a killed parent")
    parent = subprocess.Popen(
        [sys.executable, "-c", WORK, name],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # a test run in the background of a shell ignores Ctrl-C, and so would its children
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        assert parent.stdout is not None
        assert parent.stdout.readline() == "ready\n"
        for _ in range(100):
            if children := psutil.Process(parent.pid).children(recursive=True):
                break
            time.sleep(0.05)
        time.sleep(0.3)
        assert children
        parent.send_signal(ending)
        _, errors = parent.communicate(timeout=10)
        assert all(gone(child.pid) for child in children)
        assert ending == signal.SIGKILL or "KeyboardInterrupt" in errors
    finally:
        parent.kill()
