"""Running tasks: order, cache, interruption, executors."""

from __future__ import annotations

import time
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import pytest

from singsym.classes.work import Cache, Runner, fingerprint, processes
from singsym.elimination import engines
from singsym.elimination.budget import Budget
from singsym.polynomials import Ring


@dataclass
class Calls:
    """Counts what was really computed."""

    made: list[int]

    def square(self, x: int) -> int:
        self.made.append(x)
        return x * x


@dataclass(frozen=True)
class Doubtful:
    """A result that a larger budget could improve."""

    value: int

    @property
    def provisional(self) -> bool:
        return self.value < 0


CALLS = Calls([])


def counted(x: int) -> int:
    return CALLS.square(x)


def slow_then_fast(x: int) -> int:
    time.sleep(0.05 if x == 0 else 0)
    return x


def doubtful(x: int) -> Doubtful:
    CALLS.made.append(x)
    return Doubtful(x)


def allowed_engines(x: int) -> tuple[str, ...]:
    return engines.allowed()


@pytest.fixture(autouse=True)
def _fresh_calls() -> None:
    CALLS.made.clear()


@pytest.fixture
def threads() -> Iterator[Executor]:
    with ThreadPoolExecutor(2) as pool:
        yield pool


def test_results_keep_the_order_of_tasks(threads: Executor) -> None:
    assert Runner(threads).map(slow_then_fast, range(6), "test") == list(range(6))


def halves(x: int) -> tuple[int, ...]:
    return (x // 2, x - x // 2) if x > 1 else ()


def test_what_follows_from_results_keeps_its_order(threads: Executor, tmp_path: Path) -> None:
    def grown(runner: Runner) -> list[tuple[int, int | None]]:
        return runner.grow(slow_then_fast, [0, 5], halves, "test", Budget())

    alone = [(0, 0), (5, 5), (2, 2), (3, 3), (1, 1), (1, 1), (1, 1), (2, 2), (1, 1), (1, 1)]
    assert grown(Runner()) == alone
    assert grown(Runner(threads, Cache(tmp_path))) == alone
    assert grown(Runner(threads, Cache(tmp_path))) == alone


def test_a_budget_leaves_tasks_without_result() -> None:
    assert Runner().grow(slow_then_fast, [4, 0], halves, "test", Budget(0)) == [
        (4, 4),
        (0, None),
        (2, None),
        (2, None),
    ]


def test_second_run_computes_nothing(tmp_path: Path) -> None:
    runner = Runner(cache=Cache(tmp_path))
    assert runner.map(counted, [1, 2, 3], "test") == [1, 4, 9]
    assert Runner(cache=Cache(tmp_path)).map(counted, [1, 2, 3, 4], "test") == [1, 4, 9, 16]
    assert CALLS.made == [1, 2, 3, 4]


def test_an_interrupted_run_goes_on_where_it_was(tmp_path: Path) -> None:
    def interrupted(x: int) -> int:
        if x == 3:
            raise KeyboardInterrupt
        return counted(x)

    # the cache knows a task by its function's name
    interrupted.__module__, interrupted.__qualname__ = counted.__module__, counted.__qualname__
    with pytest.raises(KeyboardInterrupt):
        Runner(cache=Cache(tmp_path)).map(interrupted, [1, 2, 3, 4], "test")
    assert CALLS.made == [1, 2]
    assert Runner(cache=Cache(tmp_path)).map(counted, [1, 2, 3, 4], "test") == [1, 4, 9, 16]
    assert CALLS.made == [1, 2, 3, 4]


def test_provisional_results_are_not_kept(tmp_path: Path) -> None:
    for _ in range(2):
        Runner(cache=Cache(tmp_path)).map(doubtful, [-1, 1], "test")
    assert CALLS.made == [-1, 1, -1]


def test_a_damaged_entry_is_computed_again(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    Runner(cache=cache).map(counted, [5], "test")
    cache.path(counted, 5).write_bytes(b"not a pickle")
    assert Runner(cache=cache).map(counted, [5], "test") == [25]
    assert CALLS.made == [5, 5]


def test_entries_depend_on_function_task_and_engines(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    with engines.use("flint"):
        alone = cache.path(counted, 1)
    paths = {alone, cache.path(counted, 1), cache.path(counted, 2), cache.path(doubtful, 1)}
    assert len(paths) == 4


def test_engine_choice_reaches_the_workers() -> None:
    pool = processes(2)
    assert pool is not None
    with pool, engines.use("flint"):
        assert Runner(pool).map(allowed_engines, [1, 2], "test") == [("flint",)] * 2


def test_one_worker_needs_no_executor() -> None:
    assert processes(1) is None


def test_fingerprints() -> None:
    x, y = Ring(("x", "y")).gens
    same = fingerprint((x + y, Fraction(1, 2), {"b": 1, "a": None}))
    assert same == fingerprint((y + x, Fraction(1, 2), {"a": None, "b": 1}))
    assert same != fingerprint((x - y, Fraction(1, 2), {"a": None, "b": 1}))
    with pytest.raises(TypeError, match="a task may hold"):
        fingerprint(object())
