"""Ideals modulo a prime: what they say must be so over Q for small coefficients."""

import pytest

from singsym.elimination import engines
from singsym.elimination.engines.registry import over_rationals
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import remember
from singsym.elimination.residues import residue_basis, seems_to_contain
from singsym.polynomials import Ring

R = Ring(("x", "y"))
x, y = R.gens
HYPERBOLA = Ideal(R, (x**2 - 2, x * y - 1))


def test_without_an_engine_nothing_is_ruled_out() -> None:
    with engines.use("flint"):
        assert residue_basis(HYPERBOLA) is None
        assert seems_to_contain((x**2 - 2, 2 * y - x), (x - 2 * y, x**2 - 2))


@pytest.mark.engines
@pytest.mark.skipif(not (engines.has("msolve") or engines.has("singular")), reason="no engine modulo primes")
def test_members_and_others_are_told_apart() -> None:
    basis = residue_basis(HYPERBOLA)
    assert basis is not None
    assert seems_to_contain(basis, (x - 2 * y, x**2 - 2))
    assert seems_to_contain(basis, (R.zero,))
    assert not seems_to_contain(basis, (x - 2 * y, x - y))
    assert residue_basis(Ideal(R, (x, x * y - 1))) == (R.one,)


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
