"""Ideals modulo a prime: what they say must be so over Q for small coefficients."""

from random import Random

import pytest

from singsym.effort import chance
from singsym.effort.chance import PRIMES
from singsym.elimination import engines
from singsym.elimination.engines.registry import over_rationals
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import remember
from singsym.elimination.modulo_primes import residues
from singsym.polynomials import Ring

R = Ring(("x", "y"))
x, y = R.gens
needs_engine = pytest.mark.skipif(
    not (engines.has("msolve") or engines.has("singular")), reason="no engine modulo primes"
)
HYPERBOLA = Ideal(R, (x**2 - 2, x * y - 1))


def test_without_an_engine_there_are_none() -> None:
    with engines.use("flint"), pytest.raises(engines.EngineUnavailable):
        next(residues(HYPERBOLA))


@needs_engine
def test_members_and_others_are_told_apart() -> None:
    found = list(residues(HYPERBOLA))
    assert len({residue.prime for residue in found}) == PRIMES
    for residue in found:
        assert residue.contain((x - 2 * y, x**2 - 2))
        assert residue.contain((R.zero,))
        assert not residue.contain((x - 2 * y, x - y))
        assert not residue.is_unit
    assert all(residue.is_unit for residue in residues(Ideal(R, (x, x * y - 1))))


@needs_engine
def test_primes_divide_no_coefficient(monkeypatch: pytest.MonkeyPatch) -> None:
    """p x = 1 has a solution, but not modulo p, and so have y = p x and so on; all draw the same."""
    monkeypatch.setattr(chance, "random", lambda *about: Random(1))
    for p in [residue.prime for residue in residues(Ideal(R, (x,)))]:
        for equations in ((p * x - 1, y), (y / p - 1, x - 1), (y - p, x * y - 1)):
            found = list(residues(Ideal(R, equations)))
            assert p not in [residue.prime for residue in found]
            assert not any(residue.is_unit for residue in found)


@pytest.mark.parametrize("short", [False, True])
def test_a_basis_over_the_rationals(short: bool) -> None:
    """x^2 = 2 and x y = 1 give x = 2 y and 2 y^2 = 1."""
    basis = over_rationals(engines.Task("groebner", R, HYPERBOLA.generators), 1.0, short)
    assert basis is not None
    assert set(basis) == {x - 2 * y, 2 * y**2 - 1}


def test_patience_is_remembered_apart() -> None:
    assert remember("patience", 1, lambda: "hasty") == "hasty"
    with engines.patiently():
        assert remember("patience", 1, lambda: "patient") == "patient"
    assert remember("patience", 1, lambda: "neither") == "hasty"
