"""Which equations critical points are computed from."""

from __future__ import annotations

from singsym.elimination.ideal import Ideal
from singsym.polynomials import Ring
from singsym.varieties.decomposition import Component
from singsym.varieties.purity import PurePiece
from singsym.varieties.real.proofs.critical_points import _few_equations


def test_few_equations_stand_for_a_long_basis() -> None:
    """A curve cut out by three equations, whose Groebner basis has more; two of them cut out a surface."""
    ring = Ring(("x", "y", "z", "w"))
    x, y, z, w = ring.gens
    equations = (y - x**2 + z**3 * w, z - y**2 + x * w, w - z**2 + x * y)
    basis = Ideal(ring, equations).groebner_basis().value
    piece = PurePiece.of(Component(Ideal(ring, basis), prime=False, dimension=1, purity="Cohen-Macaulay"))
    assert len(basis) > 6
    assert _few_equations(piece, equations).value == equations
    assert _few_equations(piece, equations[:2]).value == basis
