"""Zeros of polynomials on proven loops: all of them, or none where it is not proven."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.effort.budget import Budget, Undecided
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.arithmetic import System
from singsym.varieties.real.curves.paths import Chain, prove_chains
from singsym.varieties.real.curves.zeros import Signed, zeros_on

R = Ring(("x", "y"))
x, y = R.gens
CIRCLE = System(R, (x**2 + y**2 - 1,))


def zeros(polynomial: Polynomial) -> Signed:
    turns = np.linspace(0, 2 * np.pi, 25)
    line = np.stack([np.cos(turns), np.sin(turns)], axis=1)
    line[-1] = line[0]
    found = prove_chains(CIRCLE, [Chain(line, (), True)], Budget())
    assert not isinstance(found, str)
    return zeros_on(CIRCLE, found[0], polynomial, Budget(60))


@pytest.mark.parametrize(
    ("polynomial", "count"),
    [(y, 2), (x * y, 4), (y - x**2, 2), (x + y - 3, 0), (2 * y - 1, 2), (16 * x**5 - 20 * x**3 + 5 * x, 10)],
    ids=str,
)
def test_how_many(polynomial: Polynomial, count: int) -> None:
    """Also at vertices of the polyline, as of x y; cos 5 t has ten zeros."""
    found = zeros(polynomial)
    assert len(found.zeros) == count
    assert all(abs(polynomial.evaluate(p.floats)) < 1e-9 for p in found.zeros)


def test_signs_where_there_is_no_zero() -> None:
    assert set(zeros(x + y - 3).signs) == {-1}
    assert set(zeros(x**2 + 1).signs) == {1}


@pytest.mark.parametrize("polynomial", [y - 1, x**2 + y**2 - 1, (y - x) ** 2, R.zero], ids=str)
def test_a_zero_that_is_no_change_of_sign_is_not_decided(polynomial: Polynomial) -> None:
    """A tangent, the circle itself, a double line; zero, the discriminant of a dyad that never opens."""
    with pytest.raises(Undecided):
        zeros(polynomial)
