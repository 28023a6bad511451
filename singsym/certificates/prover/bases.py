"""Groebner bases as the rule `derive` has them.

Source: an engine finds the leading monomials, `traced_basis` the steps.
"""

from __future__ import annotations

from typing import Any

from singsym.certificates.checker.rules import derive
from singsym.certificates.checker.sets import RealSet
from singsym.certificates.prover.traced_basis import traced_basis
from singsym.certificates.prover.tree import Node
from singsym.effort.budget import current
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring


def is_based(node: Node) -> bool:
    """Whether the equations of a set hold a Groebner basis of their ideal."""
    return node.based == len(node.at.equations)


def basis_steps(at: RealSet, known: int) -> dict[str, Any]:
    """The rule `derive` to a Groebner basis, and the equations there are where they are not all of it.

    known: so many of the first equations may hold a basis of their own ideal.
    """
    own = Ring(at.variables)
    ideal = Ideal(own, [Polynomial(own, e) for e in at.equations if e])
    target = [tuple(map(int, m)) for m in ideal.leading_monomials().value]
    found = traced_basis(at.equations, current(), target, known)
    if {*target} - {tuple(map(int, e.monomial(0))) for e in found.basis}:
        found = traced_basis(at.equations, current(), target)
    is_unit = bool(found.basis) and found.basis[0].is_constant()
    kept = [] if is_unit else [k for k in range(len(at.equations)) if k not in found.equations]
    return {"steps": found.steps, "equations": [*kept, *found.equations]}


def has_zeros(at: RealSet) -> bool:
    """Whether the equations of a set that excludes nothing have complex zeros."""
    own = Ring(at.variables)
    return not at.units and Ideal(own, [Polynomial(own, e) for e in at.equations if e]).dimension.value >= 0


def based(at: RealSet, known: int = 0) -> tuple[RealSet, dict[str, Any]]:
    """The set with a Groebner basis, and the steps to it; known: as `basis_steps` has it."""
    steps = basis_steps(at, known)
    return derive(at, steps)[0], steps
