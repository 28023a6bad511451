"""Two looks at a stratum: what the first has shown stays, whatever the second comes to."""

from __future__ import annotations

from dataclasses import replace

from singsym.classes.realisation.looks import is_open, known_dimensions, merged
from singsym.classes.realisation.realisation import Realised
from singsym.classes.result import Piece
from singsym.classes.taxonomy.types import Defects
from singsym.effort.verdict import Verdict
from singsym.varieties.real.dimension.extent import Extent

LATE = Verdict.undecided("the clock stood still")
SEEN = Piece((), (), (), Defects(0, 0, 0, 1), Verdict.yes(), Extent(1, 3, open="no bound was found"))
UNSEEN = replace(SEEN, verdict=LATE, extent=Extent(-1, 3))


def test_a_point_stays_known_and_the_smaller_bound_is_taken() -> None:
    (found,) = merged(Realised((SEEN,)), Realised((replace(UNSEEN, extent=Extent(-1, 2)),))).pieces
    assert found.verdict.is_yes
    assert (found.extent.at_least, found.extent.at_most) == (1, 2)


def test_a_bound_of_the_first_look_stays_where_the_second_ends_without_an_answer() -> None:
    before = replace(UNSEEN, extent=Extent(-1, 1, "modular"))
    (found,) = merged(Realised((before,)), Realised((UNSEEN,))).pieces
    assert found.verdict.is_undecided
    assert (found.extent.at_most, found.extent.bounded) == (1, "modular")


def test_an_answer_of_the_second_look_is_taken() -> None:
    empty = replace(SEEN, verdict=Verdict.no(), extent=Extent(-1, -1))
    assert merged(Realised((UNSEEN,)), Realised((empty,))).pieces == (empty,)


def test_a_part_without_a_known_point_is_open_whatever_its_class_is_known_to_be() -> None:
    assert is_open(UNSEEN, known=3)
    assert is_open(SEEN, known=2)
    assert not is_open(SEEN, known=3)
    assert not is_open(replace(SEEN, verdict=Verdict.no()), known=None)


def test_only_certified_points_make_a_class_known() -> None:
    larger = replace(SEEN, extent=Extent(2, 2))
    assert known_dimensions([UNSEEN]) == {}
    assert known_dimensions([SEEN, larger, UNSEEN]) == {SEEN.defects.types: 2}
