"""What is printed in the same words is printed once."""

from __future__ import annotations

from dataclasses import replace

from singsym.classes.solve import SolutionPiece
from singsym.effort.verdict import Verdict
from singsym.output.pieces import alike
from singsym.polynomials import Ring
from singsym.varieties.real.dimension.extent import Extent


def test_components_on_which_the_same_vanishes_share_a_line() -> None:
    """s5 = 0 with c5 = 1 and c5 = -1; a piece whose dimension is open, and another factor, stand apart."""
    c5, s5 = Ring(("c5", "s5")).gens
    one = SolutionPiece((s5,), (s5, c5 - 1), (), Verdict.yes("proven"), extent=Extent(5, 5))
    other = replace(one, basis=(s5, c5 + 1))
    unknown = replace(one, extent=Extent(4, 5))
    elsewhere = replace(one, path=(c5,), basis=(c5,))
    assert alike((one, unknown, other, elsewhere)) == ((one, other), (unknown,), (elsewhere,))
