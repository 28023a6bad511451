"""Dimensions between two bounds: a union is known only where nothing may be larger."""

from __future__ import annotations

from singsym.varieties.real.dimension.extent import EMPTY, Extent, union


def test_a_union_is_as_large_as_its_largest_part() -> None:
    assert union([Extent(1, 1), Extent(2, 2)]) == Extent(2, 2)
    assert union([EMPTY, EMPTY]) == EMPTY
    assert union([]) == EMPTY


def test_a_part_without_a_bound_leaves_the_union_open_unless_it_is_smaller() -> None:
    assert union([Extent(2, 2), Extent(-1, 2, open="late")]).dimension == 2
    found = union([Extent(2, 2), Extent(0, 3, open="late")])
    assert (found.at_least, found.at_most, found.dimension, found.open) == (2, 3, None, "late")
    assert union([Extent(2, 2), Extent(0, None, open="late")]).at_most is None


def test_what_was_not_searched_may_be_larger() -> None:
    found = union([Extent(2, 2)], ["a branch is open"])
    assert (found.at_least, found.at_most, found.dimension) == (2, None, None)
    assert found.open == "a branch is open"


def test_a_bound_that_rests_on_primes_makes_the_union_rest_on_them() -> None:
    assert union([Extent(2, 2), Extent(1, 2, "modular")]).bounded == "modular"
    assert union([Extent(2, 2), Extent(1, 1, "modular")]).bounded == "proven"
