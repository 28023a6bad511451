"""What is remembered: never what more time would have made better, as soon as there is more time."""

from __future__ import annotations

import pytest

from singsym.effort.attempts import attempt, cut_short, hurries
from singsym.effort.budget import Budget, Undecided
from singsym.effort.chaos import chaos
from singsym.effort.patience import scaled
from singsym.elimination.memo import is_known, remember


def asked(count: list[int], *, hurried: bool) -> int:
    """How often a question was computed when it is asked now, in a hurry or not."""

    def compute() -> int:
        count[0] += 1
        if hurried:
            cut_short("a proof")
        return count[0]

    return remember("a test", 1, compute)


def test_an_answer_with_all_the_time_it_takes_stays() -> None:
    count = [0]
    with Budget(10):
        assert asked(count, hurried=False) == 1
    assert asked(count, hurried=False) == 1
    assert is_known("a test", 1)


def test_an_answer_of_a_hurry_is_looked_for_again_with_more_time() -> None:
    count = [0]
    with Budget(10):
        assert asked(count, hurried=True) == 1
        assert asked(count, hurried=True) == 1
    with Budget(5), hurries() as cut:
        assert asked(count, hurried=True) == 1
    assert cut == ["a proof"]
    with Budget(20):
        assert not is_known("a test", 1)
        assert asked(count, hurried=True) == 2
    assert asked(count, hurried=False) == 3
    with Budget(5):
        assert asked(count, hurried=True) == 3


def test_the_budget_of_the_computation_counts_not_the_one_around() -> None:
    def compute() -> str:
        cut_short("a proof")
        return "hurried"

    with Budget(100):
        remember("another test", 1, compute, Budget(1))
        assert remember("another test", 1, lambda: "again") == "again"


def test_what_chaos_cut_short_is_not_kept() -> None:
    count = [0]
    with chaos(1, 0.0):
        assert [asked(count, hurried=True) for _ in range(2)] == [1, 2]
    assert asked(count, hurried=False) == 3


def test_patience_is_part_of_the_question() -> None:
    count = [0]
    with scaled(0.5):
        asked(count, hurried=False)
    assert asked(count, hurried=False) == 2


@pytest.mark.parametrize(("work", "left", "cut"), [(0.0, None, []), (0.0, 100, []), (None, 100, ["a proof"])])
def test_only_what_more_time_around_would_change_is_a_hurry(
    work: float | None, left: float | None, cut: list[str]
) -> None:
    """An attempt ends by its own allowance, the same at any time, or by what is left around it."""
    with hurries() as seen, Budget(left), attempt("a proof", work, share=0.0 if work is None else 1.0) as own:
        own.check()
        pytest.fail("there was time left")
    assert seen == cut


def test_another_failure_counts_as_a_hurry() -> None:
    with hurries() as seen, attempt("a proof", 100):
        raise Undecided("an engine died")
    assert seen == ["a proof"]
