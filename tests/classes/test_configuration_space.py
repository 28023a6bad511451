"""The pieces of a configuration space where a class is not decided: what may be missing is said."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from singsym.classes.classify import classify
from singsym.classes.configuration_space import configuration_space
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.conditions.conditions import conditions
from singsym.effort.verdict import Verdict
from singsym.mechanism import load
from singsym.varieties.real.dimension.extent import Extent

LATE = "the clock stood still"


def test_a_class_that_is_open_may_be_a_piece_by_itself() -> None:
    """Three cranks and the coupler's rate: (RI, IO) holds everywhere but at two points of another class.

    With nothing known of (RI, IO), the two points are not the whole space.
    """
    mechanism = load(Path(__file__).parent.parent / "cases" / "three-crank-coupler-rate.toml")
    result = classify(mechanism, cache=False)
    assert [piece.dimension for piece in result.configuration_space] == [1]
    still = result[T.RI | T.IO]
    left = replace(still, verdict=Verdict.undecided(LATE), extent=Extent(open=LATE), pieces=())
    classes = [left if c is still else c for c in result.classes]
    pieces = [p for c in classes for p in c.pieces]
    found = configuration_space(mechanism, conditions(result.equation, result.reduction), pieces, classes)
    assert [piece.dimension for piece in found] == [0, None]
    assert found[1].verdict.is_undecided
    assert found[1].extent.open == LATE
    assert "RI, IO" in found[1].remark
    smaller = [replace(left, extent=Extent(-1, -1)) if c is left else c for c in classes]
    assert len(configuration_space(mechanism, conditions(result.equation), pieces, smaller)) == 1
