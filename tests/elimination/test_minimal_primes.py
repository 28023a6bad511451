"""Minimal primes of ideals that are taken apart by hand."""

from __future__ import annotations

import pytest

from singsym.effort.budget import Budget
from singsym.elimination import engines
from singsym.elimination.ideal import Ideal
from singsym.elimination.minimal_primes import minimal_primes
from singsym.polynomials import Polynomial, Ring

R = Ring(("x", "y", "z"))
x, y, z = R.gens


@pytest.mark.engines
@pytest.mark.skipif(not engines.has("singular"), reason="Singular is not installed")
@pytest.mark.parametrize(
    ("generators", "expected"),
    [
        ((x * y,), [(x,), (y,)]),
        ((x * y, y * z, z * x), [(x, y), (y, z), (z, x)]),
        ((x**2 - y**2, x * z), [(x, y), (x - y, z), (x + y, z)]),
        ((x**2 + 1, x**2 - x), []),
        ((x**2 - 2, y**2 - 2), [(x**2 - 2, x - y), (x**2 - 2, x + y)]),
    ],
)
def test_minimal_primes(generators: tuple[Polynomial, ...], expected: list[tuple[Polynomial, ...]]) -> None:
    """The third: x = +-y; with x = 0 both are (x, y), a line, else z = 0."""
    found = [Ideal(R, p) for p in minimal_primes(R, generators, Budget()).value]
    wanted = [Ideal(R, p) for p in expected]
    assert len(found) == len(wanted)
    assert all(any(p.equals(q).value for q in found) for p in wanted)
