"""Work: what sleeps or what others do costs nothing, what engines do costs what it costs them."""

from __future__ import annotations

import gc
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from singsym.effort.budget import Budget, BudgetExceeded
from singsym.effort.processor_time import Meter, worked
from singsym.elimination.engines.process import Child

linux = pytest.mark.skipif(sys.platform != "linux", reason="clocks of other processes are read on Linux")
BUSY = "s = 0\nwhile True: s += 1"
COUNT = "s = 0\nfor i in range(4_000_000): s += i\n"


@contextmanager
def busy_loops(count: int) -> Iterator[None]:
    """Other programs that take what they get of the processors."""
    loops = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(count)]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def test_sleep_is_no_work() -> None:
    budget = Budget().part(work=0.2)
    time.sleep(0.3)
    budget.check()
    assert not budget.is_worked_off()


def test_collecting_the_garbage_of_others_is_no_work() -> None:
    """A full collection looks at all that a process holds, whoever made it."""
    others = [[n] for n in range(1_000_000)]
    before, clock = worked(), time.thread_time()
    gc.collect()
    time.sleep(0.01)
    assert worked() - before < 0.5 * (time.thread_time() - clock)
    assert others


def test_a_computation_is_work() -> None:
    budget = Budget().part(work=0.05)

    def compute() -> None:
        while True:
            budget.check("a test")

    with pytest.raises(BudgetExceeded, match="a test"):
        compute()


def test_time_ends_work_too() -> None:
    part = Budget(0.05).part(work=100)
    time.sleep(0.06)
    assert not part.is_worked_off()
    with pytest.raises(BudgetExceeded):
        part.check()


def test_a_part_is_limited_by_the_work_of_the_whole() -> None:
    whole = Budget(work=5)
    assert (whole.part(work=100).remaining() or 0) <= 5
    assert (whole.part(work=1).remaining() or 0) <= 1


def work_of_a_child() -> float:
    child = Child("a test", [sys.executable, "-c", COUNT])
    child.end_input()
    before = worked()
    child.wait_exit(Budget())
    return worked() - before


@linux
def test_what_a_child_works_is_charged_and_load_changes_little() -> None:
    alone = work_of_a_child()
    with busy_loops(4):
        loaded = work_of_a_child()
    # by the clock it takes three times as long on two processors
    assert 0 < loaded < 2 * alone


@linux
def test_a_child_that_hangs_is_charged_its_time() -> None:
    hanging = subprocess.Popen(["sleep", "60"])
    try:
        time.sleep(0.1)
        meter, before = Meter(hanging.pid), worked()
        time.sleep(0.2)
        meter.charge()
        assert worked() - before >= 0.2
    finally:
        hanging.kill()
        hanging.wait()


@linux
def test_a_child_that_is_gone_is_charged_by_the_clock() -> None:
    child = subprocess.Popen([sys.executable, "-c", ""])
    meter = Meter(child.pid)
    child.wait()
    before = worked()
    time.sleep(0.05)
    meter.charge()
    assert worked() - before >= 0.05
