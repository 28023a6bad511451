"""The search for all strata: how sure it is that there are no more."""

from __future__ import annotations

import pytest

from singsym.classes.running.runner import Runner
from singsym.classes.strata import search as search_module
from singsym.classes.strata.branches import Branch, Explored, Found
from singsym.classes.strata.ranks import RankProblem, Stratum
from singsym.classes.strata.search import search
from singsym.classes.taxonomy.types import Defects
from singsym.effort.verdict import Certainty
from singsym.polynomials import Ring
from singsym.varieties.real.system import RealSystem


@pytest.mark.parametrize(("second", "certainty"), [("proven", "proven"), ("modular", "modular")])
def test_branches_that_rest_on_primes_are_looked_at_again(
    monkeypatch: pytest.MonkeyPatch, second: Certainty, certainty: Certainty
) -> None:
    def first_look(branch: Branch) -> Explored:
        return Explored(certainty="modular")

    def second_look(branch: Branch) -> Explored:
        return Explored(certainty=second)

    monkeypatch.setattr(search_module, "explore", first_look)
    monkeypatch.setattr(search_module, "explore_patiently", second_look)
    ring = Ring(("x",))
    root = Branch(RankProblem({}, 0, 1, 1), RealSystem(ring, ()), ring.gens)
    assert search(root, Runner()).certainty == certainty


def test_a_second_look_that_finds_something_else_proves_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(search_module, "explore", lambda branch: Explored(certainty="modular"))
    monkeypatch.setattr(search_module, "explore_patiently", lambda branch: Explored(undecided=("late",)))
    ring = Ring(("x",))
    root = Branch(RankProblem({}, 0, 1, 1), RealSystem(ring, ()), ring.gens)
    assert search(root, Runner()).certainty == "modular"


def test_what_a_second_look_finds_leaves_its_own_types_in_doubt_only(monkeypatch: pytest.MonkeyPatch) -> None:
    ring = Ring(("x",))
    found = Found((), Stratum(ring.gens, Defects(0, 1, 1, 1)))
    monkeypatch.setattr(search_module, "explore", lambda branch: Explored(certainty="modular"))
    monkeypatch.setattr(search_module, "explore_patiently", lambda branch: Explored((found,)))
    explored = search(Branch(RankProblem({}, 0, 1, 1), RealSystem(ring, ()), ring.gens), Runner())
    assert explored.certainty_of(Defects(0, 1, 1, 1).types) == "modular"
    assert explored.certainty_of(Defects(1, 1, 1, 1).types) == "proven"
