"""Solution sets of conditions against those of the paper's section 3.3 and against each other."""

from dataclasses import replace

import pytest

from singsym.classes.solve import HOLDS, SolutionPiece, Solved, solve
from singsym.classes.taxonomy.types import feasible_defects
from singsym.effort.verdict import Verdict
from singsym.mechanism import load


def test_conditions_hold_where_the_types_say():
    """k_I > 0 exactly where a configuration has RO or RPM, k_O > 0 where it has RI or RPM."""
    for n in (1, 2, 3):
        for d in feasible_defects(n):
            assert (d.k_I > 0) == bool(d.types & HOLDS["4"])
            assert (d.k_O > 0) == bool(d.types & HOLDS["5"])


def test_the_linkage_of_section_3_3():
    """RPM at 8 configurations, no IIM, and (4) of dimension 1."""
    passive, increased, inputs = solve(load("zlatanov-2dof"), "iii", "vi", "4", cache=False)
    assert sum(p.points for p in passive.pieces) == 8
    assert increased.verdict.is_no
    assert inputs.dimension == 1
    assert not inputs.undecided


def test_sets_are_sets():
    """For the slider-crank all of (5) is (i), since there is no RPM."""
    closed, open_, none = solve(load("slider-crank"), "5", "i", "4", cache=False)
    assert sum(p.points for p in closed.pieces) == sum(p.points for p in open_.pieces) == 2
    assert (closed.set - open_.set).is_empty("real").is_yes
    assert (closed.set & none.set).is_empty("real").is_yes


def test_an_unknown_condition():
    with pytest.raises(KeyError, match="viii"):
        solve(load("fourbar"), "ix")


def test_a_part_with_an_undecided_piece_is_provisional() -> None:
    piece = SolutionPiece((), (), (), Verdict.yes())
    assert not Solved((piece,)).provisional
    assert Solved((piece, replace(piece, verdict=Verdict.undecided("no time")))).provisional
