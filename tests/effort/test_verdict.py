"""Values that say how they are known: nobody takes the certainty for granted, and the weakest one is kept."""

from __future__ import annotations

import pytest

from singsym.effort.verdict import Certainty, Known, Premises, Verdict, weakest

ORDER: tuple[Certainty, ...] = ("proven", "certified", "modular", "undecided")


@pytest.mark.parametrize("value", [True, False, (), (1,), 0])
def test_what_is_known_is_not_taken_for_its_value(value: object) -> None:
    """A False that is known would be true, were it asked as any other object is."""
    known = Known(value)
    with pytest.raises(TypeError):
        bool(known)
    with pytest.raises(TypeError):
        any([known])
    with pytest.raises(TypeError):
        iter(known)  # type: ignore[call-overload]
    with pytest.raises(TypeError):
        len(known)  # type: ignore[arg-type]
    assert known != value


def test_a_value_and_what_follows_from_it_are_equally_known() -> None:
    assert Known((1, 2), "modular").map(len) == Known(2, "modular")
    assert Known(3).is_proven
    assert not Known(3, "certified").is_proven


@pytest.mark.parametrize("first", ORDER)
@pytest.mark.parametrize("second", ORDER)
def test_a_conclusion_is_as_certain_as_its_weakest_premise(first: Certainty, second: Certainty) -> None:
    """In this order of the certainties, whichever comes first."""
    expected = ORDER[max(ORDER.index(first), ORDER.index(second))]
    premises = Premises()
    assert premises.conclude(0).is_proven
    assert [premises.take(Known(1, first)), premises.take(Known(2, second))] == [1, 2]
    assert premises.conclude("both") == Known("both", expected)
    assert Premises(first).pass_on(Known(2, second)) == Known(2, expected)
    assert weakest(first, second) == expected


def test_only_a_yes_is_a_premise() -> None:
    premises = Premises()
    assert not premises.grants(Verdict.no("modular"))
    assert not premises.grants(Verdict.undecided("no time"))
    assert premises.certainty == "proven"
    assert premises.grants(Verdict.yes("certified"))
    assert premises.certainty == "certified"
