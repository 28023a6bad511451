"""The pieces of a configuration space where a class is not decided: what may be missing is said."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from singsym.classes.classify import classify
from singsym.classes.configuration_space import (
    _is_complete_intersection,
    configuration_space,
    smoothness,
)
from singsym.classes.result import Piece
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.conditions.conditions import conditions
from singsym.effort.verdict import Known, Verdict
from singsym.elimination.ideal import Ideal
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load, loads
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
    given = conditions(result.equation, result.reduction)
    (found,) = configuration_space(mechanism, given, pieces, classes, smoothness(mechanism, given, classes))
    assert found.dimension is None
    assert found.verdict.is_undecided
    assert LATE in found.extent.open
    assert "RI, IO" in found.remark
    smaller = [replace(left, extent=Extent(-1, -1)) if c is left else c for c in classes]
    assert len(configuration_space(mechanism, given, pieces, smaller, ("undecided", ""))) == 1


def test_an_over_constrained_linkage_with_more_tangents_than_motions() -> None:
    """A parallelogram whose coupler's middle goes round (2, 0) at 2, and a bar of 3 from (2, -1) to it.

    The two circles touch in (2, 2) only, from inside: the linkage is rigid there and yet has a velocity.  The
    antiparallelogram's middle does not reach the bar's circle.
    """
    points = "points = { A = [0, 0], D = [4, 0], E = [2, -1] }"
    coupler = "points = { B = [0, 0], C = [4, 0], F = [2, 0] }"
    joints = "\n".join(f'{name} = "R"' for name in "ABCDEF")
    shaky = loads(
        'name = "shaky"\ninputs = ["A"]\noutput = { rate = "D" }\nmobility = 1\n'
        f"[links]\nground = {{ {points} }}\ncoupler = {{ {coupler} }}\n"
        f"AB = 2\nCD = 2\nEF = 3\n[joints]\n{joints}"
    )
    (space,) = classify(shaky, cache=False).configuration_space
    assert (space.dimension, space.smooth) == (0, "undecided")


def test_small_parts_of_the_space_itself_are_not_called_pieces_of_it() -> None:
    """The four-bar's curve with its singular points, found without a condition: they lie on the curve."""
    mechanism = load("fourbar")
    result = classify(mechanism, cache=False)
    given = conditions(result.equation, result.reduction)
    whole = [Piece((), s.basis, (), s.defects, s.verdict, s.extent) for s in result.configuration_space]
    points = [replace(p, path=()) for c in result.classes for p in c.pieces]
    found = configuration_space(mechanism, given, [*whole, *points], result.classes, ("yes", ""))
    assert [piece.dimension for piece in found] == [1, None]
    assert found[1].verdict.is_undecided
    assert "RI, IO" in found[1].remark


def test_where_all_is_open_the_largest_class_known_is_not_the_space() -> None:
    """The regular configurations may not have been found yet."""
    mechanism = load("fourbar")
    result = classify(mechanism, cache=False)
    given = conditions(result.equation, result.reduction)
    unknown = {"verdict": Verdict.undecided(LATE), "extent": Extent(open=LATE)}
    classes = [c if c.verdict.is_yes else replace(c, **unknown) for c in result.classes]
    pieces = [p for c in result.classes for p in c.pieces]
    (found,) = configuration_space(mechanism, given, pieces, classes, ("undecided", ""))
    assert found.dimension is None
    assert found.verdict.is_undecided


def test_a_chain_of_dyads_is_a_complete_intersection_without_a_basis(monkeypatch: pytest.MonkeyPatch) -> None:
    """A crank with four dyads, each over the one before: fibre by fibre a curve, off finitely many points.

    C1 G1 = C1 C2 are as long, so that the second dyad may turn freely where C1 is G2: a circle, no surface.
    """
    text = """name = "four dyads"
inputs = ["A"]
output = { rate = "G4" }
[links]
ground = { points = { A = [0, 0], G1 = [6, -1], G2 = [7, 1], G3 = [7, 0], G4 = [2, 1] } }
AP = 5
PC1 = 6
C1G1 = 3
C1C2 = 3
C2G2 = 3
C2C3 = 5
C3G3 = 7
C3C4 = 7
C4G4 = 3
[joints]
"""
    joints = "\n".join(
        f'{name} = "R"' for name in ("A", "P", *(f"{p}{k}" for k in range(1, 5) for p in "CG"))
    )

    class Refused(Ideal):
        @property
        def dimension(self) -> Known[int]:
            raise AssertionError("no basis of all loop equations is needed")

    given = conditions(velocity_equation(loads(text + joints)))
    monkeypatch.setattr("singsym.classes.configuration_space.Ideal", Refused)
    assert _is_complete_intersection(given)
