"""Groebner bases with their steps: the checker follows them, and what is known beforehand saves some."""

from __future__ import annotations

from dataclasses import replace

from singsym.certificates.checker.polynomials import polynomial, ring
from singsym.certificates.checker.rules import derive
from singsym.certificates.checker.sets import statement
from singsym.certificates.prover.traced_basis import traced_basis
from singsym.effort.budget import Budget

EMPTY = {
    "variables": [],
    "constants": [],
    "equations": [],
    "exclusions": [],
    "positive": [],
    "nonnegative": [],
    "L": [],
    "roles": [],
    "N": 0,
    "n": 0,
}


def test_a_basis_and_one_polynomial_more() -> None:
    """The twisted cubic, whose quadrics are a basis (Cox, Little, O'Shea, 1.4), cut by z = 1: x^3 = 1.

    Its pairs lead nowhere new: with them or without, the basis is the same, and the steps are no more.
    """
    names = ["x", "y", "z"]
    context = ring(names)
    given = [polynomial(f, context) for f in ("x^2 - y", "x*y - z", "y^2 - x*z", "z - 1")]
    at = replace(statement(EMPTY | {"variables": names}).whole, equations=tuple(given))
    plain = traced_basis(given, Budget())
    found = traced_basis(given, Budget(), based=3)
    assert (
        set(map(str, found.basis)) == set(map(str, plain.basis)) == {"z - 1", "x^2 - y", "x*y - 1", "y^2 - x"}
    )
    assert len(found.steps) <= len(plain.steps)
    for basis in (plain, found):
        kept = [*range(4), *(k for k in basis.equations if k >= 4)]
        (there,) = derive(at, {"steps": basis.steps, "equations": kept})
        assert {*map(str, basis.basis)} <= {*map(str, there.equations)}
