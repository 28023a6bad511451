"""Where a redundant serial chain loses outputs: the rank of its Jacobian, by maximal minors.

Source: Zlatanov, Fenton, Benhabib (1998), the definitions of the types in section 2.2.

A serial chain has L = [1, -J], J with a row for each of m output components and a column for each of more
than m inputs. So L and L_I have rank m in every configuration: with the inputs at rest nothing moves (no RO,
RPM, IIM), and any input velocities are possible (no II). L_O = -J has more columns than rows: some input
velocities leave the output at rest (RI, always), and an output velocity is impossible (IO) exactly where rank
J < m, that is where all minors of m columns vanish.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from math import comb
from typing import TYPE_CHECKING

from singsym.conditions.conditions import MOST_TERMS, Condition
from singsym.conditions.factor import Factor
from singsym.conditions.incidences.incidences import Incidences
from singsym.conditions.named_quantities import PointNames
from singsym.kinematics.nonzero import Certifier
from singsym.minors.determinant import TooManyTerms
from singsym.minors.factored import determinant_factors
from singsym.minors.rank import MANY_MINORS, alternatives
from singsym.polynomials import Polynomial

if TYPE_CHECKING:
    from singsym.kinematics.velocity import VelocityEquation


@dataclass(frozen=True)
class RedundantChain:
    """A serial chain's inputs and outputs by number, and the condition for IO, which is (5) and (viii)."""

    equation: VelocityEquation
    inputs: int
    outputs: int
    condition: Condition

    def __str__(self) -> str:
        return (
            f"Redundant: {self.inputs} inputs, {self.outputs} output components: RI in every configuration, "
            "RO, RPM, II, IIM in none; IO where the rank drops"
        )


def redundant_chain(equation: VelocityEquation) -> RedundantChain:
    """The condition for IO of a serial chain with more inputs than output components.

    Raises `ValueError` for an equation with passive velocities or without redundancy.
    """
    J = equation.L_O
    roles = [column.role for column in equation.columns]
    inputs, outputs = roles.count("input"), roles.count("output")
    if "passive" in roles or J.shape != (outputs, inputs) or inputs <= outputs:
        raise ValueError("the equation is not that of a serial chain with more inputs than output components")
    certifier = Certifier(equation.space)
    names = PointNames(certifier, Incidences(equation, certifier))
    products = _minors(equation, certifier)
    found = None if products is None else alternatives(products, certifier)
    if products == ():
        found = ()
    condition = Condition(
        "5",
        "IO",
        f"rank L_O < {outputs}",
        rf"\operatorname{{rank}} L_O(q) < {outputs}",
        None if found is None else tuple(tuple(Factor.named(p, 1, names) for p in a) for a in found),
        everywhere=products == (),
    )
    return RedundantChain(equation, inputs, outputs, condition)


def _minors(equation: VelocityEquation, certifier: Certifier) -> tuple[tuple[Polynomial, ...], ...] | None:
    """The factors of each maximal minor of L_O that is not zero everywhere; None where they are too large.

    A minor without zeros is an empty product of factors.
    """
    J = equation.L_O
    height, width = J.shape
    if comb(width, height) > MANY_MINORS:
        return None
    found = []
    for columns in combinations(range(width), height):
        try:
            minor = determinant_factors(J.select(columns=columns), certifier, MOST_TERMS)
        except TooManyTerms:
            return None
        if not minor.vanishes:
            found.append(minor.polynomials)
    return tuple(found)
