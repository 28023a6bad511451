"""Real points of a curve over C that are isolated, by triangles alone."""

from singsym.polynomials import Equations, Ring
from singsym.varieties.real.modules.isolated_points import tangencies
from singsym.varieties.real.points.finite_sets import real_points

RING = Ring(("c", "s", "x", "y", "u", "v"))
C, S, X, Y, U, V = RING.gens


def linkage(rocker: int, second: int) -> Equations:
    """(c, s) at 2 from the origin, (x, y) at 1 from it and `rocker` from (1, 0), (u, v) at 1 from that and
    `second` from (1, 0)."""
    crank = C**2 + S**2 - 4
    first = (X - C) ** 2 + (Y - S) ** 2 - 1, (X - 1) ** 2 + Y**2 - rocker**2
    return crank, *first, (U - X) ** 2 + (V - Y) ** 2 - 1, (U - 1) ** 2 + V**2 - second**2


def touched(rocker: int, second: int) -> Equations:
    found = tangencies(linkage(rocker, second))
    return () if found is None else found.value


def test_a_linkage_that_only_lies_flat_has_its_points() -> None:
    # from (1, 0) the crank's end is 3 away at most, at (-2, 0); a rocker of 4 reaches it with the coupler
    # in line alone, at (-3, 0); (u, v) is at 1 from there and at 4 from (1, 0): a triangle with two places
    assert len(touched(4, 4)) == 1
    found = real_points((*linkage(4, 4), *touched(4, 4))).value
    assert sorted(tuple(map(round, p.floats[:4])) for p in found) == [(-2, 0, -3, 0)] * 2


def test_a_linkage_that_turns_has_none_and_one_that_cannot_close_has_no_point() -> None:
    assert not touched(2, 2)
    assert touched(5, 5) == (RING.one,)  # 3 + 1 is less than 5
    assert touched(4, 6) == (RING.one,)  # it lies flat, and (u, v) is 4 + 1 away at most
