"""Progress of a classification, and its end by what is told of it, with and without processes."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from singsym.classes.classify import classify, classify_equation
from singsym.classes.solve import solve
from singsym.effort.progress import Event
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load


class Enough(Exception):
    """What a sink ends the work by."""


def test_stages_come_in_their_order_and_reach_their_ends() -> None:
    events: list[Event] = []
    classify(load("slider-crank"), cache=False, progress=events.append)
    stages = list(dict.fromkeys(e.stage for e in events if e.total))
    # conditions are decomposed before, where the process does not remember them from another test
    assert [s for s in stages if s != "decompose"][:2] == ["strata", "real points"]
    for stage in stages:
        last = [e for e in events if e.stage == stage][-1]
        assert last.done == last.total
    assert all(e.total != 0 for e in events)
    assert all(0 <= e.done <= e.total for e in events if e.done is not None and e.total is not None)


def test_what_is_found_is_told_as_it_comes() -> None:
    """Conditions before any task, then classes; at the end all that occur, as in the result."""
    events: list[Event] = []
    result = classify(load("zlatanov-2dof"), cache=False, progress=events.append)
    first = next(e for e in events if e.stage == "strata")
    assert [about for about, _ in first.findings] == ["(4)", "(5)"]
    assert dict(first.findings)["(4)"] == "B, C, D collinear; or C, F, G collinear"
    last = dict(events[-1].findings)
    there = {str(c.singularity_class) for c in result.classes if c.verdict.is_yes}
    assert there == {about for about in last if about[0] != "("}
    assert last["1 (RI, IO)"] == "occurs, dimension 1 at least"
    numbers = [len(e.findings) for e in events]
    assert numbers == sorted(numbers)


def test_equations_and_conditions_tell_of_it_too() -> None:
    told: list[Event] = []
    classify_equation(None, velocity_equation(load("slider-crank")), cache=False, progress=told.append)
    assert any(e.stage == "strata" for e in told)
    solved: list[Event] = []
    solve(load("slider-crank"), "5", cache=False, progress=solved.append)
    assert any("(5)" in e.stage for e in solved)


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("kind", [Enough, KeyboardInterrupt])
def test_what_a_sink_raises_ends_the_work(
    kind: type[BaseException], workers: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The hybrid chain takes minutes; two seconds after the search for strata began it is called off."""
    monkeypatch.setenv("SINGSYM_CACHE", str(tmp_path))
    began: list[float] = []

    def sink(event: Event) -> None:
        if event.stage == "strata" and event.total:
            began.append(time.monotonic())
        if began and time.monotonic() > began[0] + 2:
            raise kind

    with pytest.raises(kind):
        classify(load("zlatanov-hybrid-3-2"), workers=workers, progress=sink)
    assert time.monotonic() - began[0] < 15
