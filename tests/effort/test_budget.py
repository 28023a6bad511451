"""Budgets, verdicts and progress."""

from __future__ import annotations

import pickle
import time

import pytest

from singsym.effort import progress
from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, BudgetExceeded, Cancelled, current
from singsym.effort.verdict import Answer, Verdict, weakest


def test_a_part_ends_with_the_whole() -> None:
    whole = Budget(0.05, 100)
    part = whole.part(work=10, memory_mb=500)
    assert part.memory_mb == 100
    time.sleep(0.06)
    with pytest.raises(BudgetExceeded, match="a test"):
        part.check("a test")
    assert whole.remaining() == 0


def test_without_limits() -> None:
    budget = Budget()
    assert budget.remaining() is None
    assert budget.part().remaining() is None
    budget.check()


def test_the_enclosing_budget_holds() -> None:
    with Budget(5) as outer:
        assert current() is outer
        with Budget(1) as inner:
            assert current() is inner
            assert current(outer) is outer
        assert current() is outer
    assert current().remaining() is None


def test_cancelled_from_outside() -> None:
    stop: list[bool] = []
    budget = Budget(cancelled=lambda: bool(stop)).part(work=60)
    budget.check()
    stop.append(True)
    with pytest.raises(Cancelled):
        budget.check()


def test_pickled_budgets_keep_what_is_left() -> None:
    assert 0 < (pickle.loads(pickle.dumps(Budget(10))).remaining() or 0) <= 10


def test_verdicts() -> None:
    yes = Verdict.yes("modular", engine="msolve", reason="1 is in the ideal")
    assert str(yes) == "yes (modular, 3 primes by msolve): 1 is in the ideal"
    assert (~yes).answer is Answer.NO
    assert (~Verdict.undecided("x")).is_undecided
    assert weakest() == "proven"
    assert weakest("modular", "certified", "proven") == "modular"
    with pytest.raises(TypeError):
        bool(yes)


def test_progress_goes_to_the_sink_in_force() -> None:
    events: list[progress.Event] = []
    progress.report("nobody listens")
    with progress.to(events.append), progress.to(None):
        progress.report("decompose", "BCD", 1, 5)
    progress.report("nobody listens")
    assert [str(e) for e in events] == ["decompose: BCD (1 of 5)"]


def test_work_that_says_nothing_new_can_be_ended_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """The last event comes again, not more often than that; what the sink raises is no open question."""
    seen: list[progress.Event] = []

    def sink(event: progress.Event) -> None:
        seen.append(event)
        if len(seen) == 3:
            raise KeyboardInterrupt

    monkeypatch.setattr(progress, "BEAT", 0.02)
    started = time.monotonic()

    def work() -> None:
        progress.beat()
        progress.report("search", done=1, total=2)
        while time.monotonic() < started + 10:
            with attempt("a proof"):
                current().check("a long loop")

    with progress.to(sink), pytest.raises(KeyboardInterrupt):
        work()
    assert seen == [progress.Event("search", "", 1, 2)] * 3
    assert 0.04 <= time.monotonic() - started < 5
