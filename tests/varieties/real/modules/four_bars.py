"""Four-bars as equations: crank on the origin, rocker on the x axis."""

from __future__ import annotations

from singsym.polynomials import Equations, Ring

RING = Ring(("c", "s", "x", "y"))
C, S, X, Y = RING.gens


def four_bar(crank: int, coupler: int, rocker: int, base: int) -> Equations:
    """The crank's tip (c, s), and (x, y), where coupler and rocker meet."""
    return (
        C**2 + S**2 - crank**2,
        (X - C) ** 2 + (Y - S) ** 2 - coupler**2,
        (X - base) ** 2 + Y**2 - rocker**2,
    )
