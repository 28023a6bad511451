"""Squares that add up to zero on a set, as the rule `squares` has them.

Source: sums of squares at sight, or found by `positive_combinations`.
"""

from __future__ import annotations

from flint import fmpq

from singsym.certificates.checker.polynomials import remainder
from singsym.certificates.checker.sets import RealSet
from singsym.elimination.monomial_ideals import minimal
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.sums_of_squares import squares_less_constant
from singsym.varieties.real.proofs.positive_combinations import positive_combination
from singsym.varieties.real.proofs.real_consequences import combined


def vanishing_squares(at: RealSet) -> list[list[str]]:
    """Weights and polynomials whose squares add up to zero on a set, where not all vanish there anyway."""
    ring = Ring(at.variables)
    given, others = ([Polynomial(ring, g) for g in group if g] for group in (at.generators, at.equations))
    # the last ones are a Groebner basis, of which those that are needed tell what is solved for
    led = {f.value.monomial(0): f for f in others}
    positive = positive_combination([led[m] for m in minimal(led)])
    for f in dict.fromkeys((*combined(given), *others, *filter(None, [positive]))):
        _, squares, less = squares_less_constant(f) or (0, (), fmpq(1))
        terms = [*squares, *([(-less, ring.one)] if less < 0 else [])]
        if less <= 0 and any(remainder(root.value, at.equations) for _, root in terms):
            return [[str(weight), str(root)] for weight, root in terms]
    return []
