"""Running tasks: order, budgets, interruption, executors, workers that die."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import nullcontext
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

import pytest

from singsym.classes.running.disk_cache import Cache
from singsym.classes.running.processes import Processes
from singsym.classes.running.runner import Runner, running
from singsym.effort.budget import Budget, current
from singsym.elimination import engines


@dataclass(frozen=True)
class Number:
    """A number, or why there is none."""

    value: int
    doubt: str = ""

    @property
    def provisional(self) -> bool:
        return bool(self.doubt)


@dataclass(frozen=True)
class Given:
    """A task: a number."""

    value: int

    def unfinished(self, reason: str) -> Number:
        return Number(-1, reason)


MADE: list[int] = []


def squared(task: Given) -> Number:
    MADE.append(task.value)
    return Number(task.value**2)


def slow_then_fast(task: Given) -> Number:
    time.sleep(0.05 if task.value == 0 else 0)
    return Number(task.value)


def allowed_engines(task: Given) -> Number:
    return Number(len(engines.allowed()))


def killed(task: Given) -> Number:
    """Kills its own process where the number is odd."""
    if task.value % 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return Number(task.value)


def busy(task: Given) -> Number:
    """Works for a fifth of a second, unless no work is left."""
    end = time.thread_time() + 0.2
    while time.thread_time() < end and current().remaining() != 0.0:
        pass
    return Number(task.value)


def slow_if_odd(task: Given) -> Number:
    time.sleep(100 * (task.value % 2))
    return Number(task.value)


def same(task: Given) -> Number:
    return Number(task.value)


def without_memory(task: Given) -> Number:
    if task.value == 1:
        raise MemoryError
    return Number(task.value)


def given(*values: int) -> list[Given]:
    return [Given(value) for value in values]


def halves(number: Number) -> list[Given]:
    x = number.value
    return given(x // 2, x - x // 2) if x > 1 else []


@pytest.fixture(autouse=True)
def _fresh() -> None:
    MADE.clear()


@pytest.fixture
def threads() -> Iterator[Executor]:
    with ThreadPoolExecutor(2) as pool:
        yield pool


def test_results_keep_the_order_of_tasks(threads: Executor) -> None:
    found = Runner(threads).map(slow_then_fast, given(*range(6)), "test")
    assert [number.value for number in found] == list(range(6))


def test_what_follows_from_results_keeps_its_order(threads: Executor, tmp_path: Path) -> None:
    def grown(runner: Runner) -> list[tuple[int, int]]:
        found = runner.grow(slow_then_fast, given(0, 5), halves, "test", Budget())
        return [(task.value, number.value) for task, number in found]

    alone = [(0, 0), (5, 5), (2, 2), (3, 3), (1, 1), (1, 1), (1, 1), (2, 2), (1, 1), (1, 1)]
    assert grown(Runner()) == alone
    assert grown(Runner(threads, Cache(tmp_path))) == alone
    assert grown(Runner(threads, Cache(tmp_path))) == alone


def test_a_budget_leaves_tasks_unfinished() -> None:
    """What is not begun in time says why."""
    found = Runner().grow(slow_then_fast, given(4, 0), halves, "halving", Budget(0))
    assert [(task.value, number.value) for task, number in found] == [(4, -1), (0, -1)]
    assert {number.doubt for _, number in found} == {"the budget of 0 s for halving is used up"}


@pytest.mark.parametrize("workers", [1, 2])
def test_a_budget_of_work_is_used_up_by_all_tasks_together(workers: int) -> None:
    """Of ten tasks of 0.2 s each, 0.5 s of work allow three, and some that begin meanwhile."""
    with nullcontext() if workers == 1 else Processes(workers) as pool:
        found = Runner(pool).map(busy, given(*range(10)), "test", Budget(work=0.5))
    assert 3 <= sum(not number.doubt for number in found) <= 6


def test_nothing_that_follows_is_lost_by_an_interruption() -> None:
    """Wherever it comes, all tasks that are not done are named: here while the halves of 6 are told."""

    def halved(number: Number) -> list[Given]:
        if number.value == 6:
            raise KeyboardInterrupt
        return halves(number)

    found = Runner().grow(same, given(2, 6), halved, "halving", Budget())
    named = [task.value for task, number in found if number.doubt]
    assert 6 in named
    assert {1, 2} >= {task.value for task, number in found} - {6}


def test_what_does_not_heed_the_time_is_ended(tmp_path: Path) -> None:
    """A task that sleeps for minutes is ended soon after its time, and the next stage has workers again."""
    started = time.monotonic()
    with Processes(2) as pool:
        runner = Runner(pool)
        assert runner.map(slow_if_odd, given(6, 8), "starting processes") == [Number(6), Number(8)]
        first, second = runner.map(slow_if_odd, given(1, 2), "sleeping", Budget(1))
        assert (first.doubt, second) == ("the budget of 1 s for sleeping is used up", Number(2))
        assert runner.map(slow_if_odd, given(2, 4), "again") == [Number(2), Number(4)]
    assert time.monotonic() - started < 30


def test_an_interrupted_run_goes_on_where_it_was(tmp_path: Path) -> None:
    def interrupted(task: Given) -> Number:
        if task.value == 3:
            raise KeyboardInterrupt
        return squared(task)

    # the cache knows a task by its function's name
    interrupted.__module__, interrupted.__qualname__ = squared.__module__, squared.__qualname__
    runner = Runner(cache=Cache(tmp_path))
    partial = runner.map(interrupted, given(1, 2, 3, 4), "test")
    assert MADE == [1, 2]
    assert [number.doubt for number in partial] == ["", "", *["it was interrupted"] * 2]
    assert runner.map(squared, given(5), "later")[0].doubt == "it was interrupted"
    assert MADE == [1, 2]
    found = Runner(cache=Cache(tmp_path)).map(squared, given(1, 2, 3, 4), "test")
    assert [number.value for number in found] == [1, 4, 9, 16]
    assert MADE == [1, 2, 3, 4]


def where(task: Given) -> Number:
    """The process that does it."""
    return Number(os.getpid())


def test_one_worker_needs_no_process_of_its_own_unless_it_may_have_to_be_ended() -> None:
    for clock, same in ((None, True), (60.0, False)):
        with running(1, None, clock, cache=False) as runner:
            assert (runner.map(where, given(1), "test") == [Number(os.getpid())]) == same


def test_workers_are_asked_when_there_is_work_for_them() -> None:
    """0.2 s for each task: one is done here before 0.1 s are used up, the others elsewhere."""
    with Processes(2) as pool:
        runner = Runner(pool, alone=0.1)
        runner.map(busy, given(1), "test")
        assert Number(os.getpid()) not in runner.map(where, given(*range(4)), "test")
        assert Runner(pool, alone=0.1).map(where, given(1, 2), "test") == [Number(os.getpid())] * 2


def test_engine_choice_reaches_the_workers() -> None:
    with Processes(2) as pool, engines.use("flint"):
        assert Runner(pool).map(allowed_engines, given(1, 2), "test") == [Number(1)] * 2


@pytest.mark.skipif(os.name != "posix", reason="processes are killed with POSIX signals")
def test_a_task_whose_worker_dies_ends_with_the_reason(tmp_path: Path) -> None:
    """Others go on, and what was not done is not kept."""
    with Processes(2) as pool:
        found = Runner(pool, Cache(tmp_path)).map(killed, given(0, 1, 2, 4), "test")
    assert [number.value for number in found] == [0, -1, 2, 4]
    assert "killed by SIGKILL" in found[1].doubt
    assert len(list(tmp_path.iterdir())) == 3


@pytest.mark.skipif(os.name != "posix", reason="processes are killed with POSIX signals")
def test_a_pool_that_breaks_as_a_whole_is_no_traceback() -> None:
    """Python's own: it refuses all that comes after, too."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        first = Runner(pool).map(killed, given(1), "test")
        second = Runner(pool).map(killed, given(2), "test")
        assert [number.value for number in (*first, *second)] == [-1, -1]
        with pytest.raises(BrokenExecutor):
            pool.submit(abs, 1)


def test_a_task_without_memory_ends_with_the_reason(threads: Executor) -> None:
    for runner in (Runner(), Runner(threads)):
        found = runner.map(without_memory, given(0, 1, 2), "test")
        assert [number.value for number in found] == [0, -1, 2]
        assert found[1].doubt == "the memory was used up"
