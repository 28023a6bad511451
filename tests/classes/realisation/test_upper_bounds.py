"""The order in which bounds of dimensions are tried, on a set that is known by hand."""

from __future__ import annotations

import pytest

from singsym.classes.realisation import upper_bounds
from singsym.classes.realisation.upper_bounds import upper_bound
from singsym.effort.verdict import Known
from singsym.polynomials import Equations, Ring
from singsym.varieties.real.system import RealSystem

x, y, z = Ring(("x", "y", "z")).gens
ANYWHERE = RealSystem(x.ring, ())
POINTS = (z, x * y - z, x**3 + y**5 + 7 * x - y + z - 1)
"""Of the two lines z = x y = 0 some points."""


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[Equations]:
    """The equations of which a bound is asked, where each answer is that there is none."""
    found: list[Equations] = []

    def none(equations: Equations) -> None:
        found.append(equations)

    monkeypatch.setattr(upper_bounds, "dimension_bound", none)
    monkeypatch.setattr(upper_bounds, "is_bounded", lambda *_: False)
    monkeypatch.setattr(upper_bounds, "is_dimension_at_most", lambda *_: Known(False))
    return found


@pytest.mark.engines
def test_fewer_equations_are_looked_at_first(asked: list[Equations]) -> None:
    """Two of them leave lines, which is enough for 1; what random values say of these rests on primes."""
    system = RealSystem(x.ring, POINTS)
    assert upper_bound(system, 1, ANYWHERE) == Known(1, "modular")
    assert asked == [POINTS[:2], POINTS]


def test_a_bound_of_fewer_equations_is_no_bound_below_the_dimension() -> None:
    """The points are of dimension 0, the lines are not."""
    system = RealSystem(x.ring, POINTS[:2])
    assert upper_bound(system, 0, ANYWHERE) is None
    assert upper_bound(system, 1, ANYWHERE) == Known(1)
