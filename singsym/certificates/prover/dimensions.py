"""A bound of a dimension from above by linear forms, as the leaf `ranks` has it.

Source: the projective dimension theorem (Hartshorne, *Algebraic Geometry*, I.7.2).
"""

from __future__ import annotations

from typing import Any

from flint import fmpq_mpoly, fmpq_mpoly_ctx

from singsym.certificates.checker.polynomials import remainder, ring
from singsym.certificates.checker.sets import RealSet
from singsym.certificates.checker.strata import SCALE, homogeneous
from singsym.certificates.prover.traced_basis import traced_basis
from singsym.effort import chance
from singsym.effort.attempts import attempt
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring

TRIES, PLAIN, SECONDS = 12, 8, 20.0
"""So many choices of forms are tried, first so many in which each has one variable, each for so much work."""
LARGEST = 5
"""Of coefficients of forms."""


def dimension_leaf(at: RealSet, dimension: int) -> dict[str, Any] | None:
    """`forms`, `steps` and `equations` that show a dimension to be no larger; None where none are found."""
    larger = ring([*at.variables, SCALE])
    for k in range(TRIES):
        with attempt("a dimension for a certificate", SECONDS) as budget:
            forms = _forms(at.context, dimension + 1, k, 0 if k < PLAIN else 2)
            start = [homogeneous(f, larger) for f in (*at.equations, *forms) if f]
            led = start[-len(forms) :]
            own = Ring(larger.names())
            rest = [remainder(f, led) for f in start]
            ideal = Ideal(own, [Polynomial(own, f) for f in (*led, *rest) if f])
            leading = ideal.leading_monomials().value
            powers = [tuple(map(int, m)) for m in leading if sum(map(bool, m)) == 1]
            if len(powers) == len(own.names):
                found = traced_basis(start, budget, powers)
                kept = [j for j in range(len(start)) if j not in found.equations]
                data = {"steps": found.steps, "equations": [*kept, *found.equations]}
                return {"forms": [*map(str, forms)], **data}
    return None


def _forms(context: fmpq_mpoly_ctx, count: int, number: int, mixed: int) -> list[fmpq_mpoly]:
    """Random forms, each of a variable of its own, of some of those that are left, and of a constant."""
    draw, gens = chance.random("forms", number, *context.names()), list(context.gens())
    draw.shuffle(gens)
    led, rest = gens[:count], gens[count:]

    def weight() -> int:
        return draw.choice([-1, 1]) * draw.randint(1, LARGEST)

    def others() -> fmpq_mpoly:
        chosen = draw.sample(rest, min(mixed, len(rest)))
        return sum((g * weight() for g in chosen), start=context.constant(weight()))

    return [f + others() for f in led]
