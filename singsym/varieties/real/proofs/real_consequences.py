"""What else vanishes at the real zeros of equations, seen without decomposing them.

Source: Choi, Lam, Reznick, Proc. Symp. Pure Math. 58.2 (1995) 103-126, for sums of squares; extreme values as
in `bounds_of_solutions` and `extrema_on_tori`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from singsym.effort.verdict import Known, Premises
from singsym.polynomials import Polynomial
from singsym.polynomials.sums_of_squares import sum_of_squares
from singsym.polynomials.unit_circles import unit_circles
from singsym.varieties.real.bounds_of_solutions import extreme_values, sign_within, solution_bounds
from singsym.varieties.real.proofs.extrema_on_tori import extreme_zeros
from singsym.varieties.real.system import RealSystem


def real_consequences(
    system: RealSystem, equations: Sequence[Polynomial], others: Sequence[Polynomial] = ()
) -> Known[list[Polynomial] | None]:
    """What sums of squares, or values at their bounds, force to vanish; `None` where that cannot be.

    others: further equations, used for bounds and for values at them; of the system only its inequalities
    are used.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("c", "s", "x"))
    >>> c, s, x = R.gens
    >>> real_consequences(RealSystem(R, ()), [c**2 + s**2 - 1, x**2 - 2 * s * x + 1]).value
    [c, s - x]
    """
    forced: list[Polynomial] = []
    for f in combined(equations):
        squares = sum_of_squares(f)
        if squares is None:
            continue
        roots = squares[1]
        if any(r.is_constant for r in roots):
            return Known(None)
        if len(roots) > 1:
            forced.extend(roots)
    together = tuple(dict.fromkeys((*equations, *others)))
    bounds = solution_bounds(system.ring, together)
    if bounds is None or any(sign_within(f, bounds) for f in together):
        return Known(None)
    if any(sign_within(p, bounds) < 0 for p in (*system.positive, *system.nonnegative)):
        return Known(None)
    circles, premises = tuple(unit_circles(together)), Premises()
    for f in together:
        forced += extreme_values(f, bounds)
        forced += premises.take(extreme_zeros(f, circles))
    if system.ring.one in forced:
        return premises.conclude(None)
    return premises.conclude([p for p in dict.fromkeys(forced) if p not in together])


def combined(equations: Sequence[Polynomial]) -> Iterator[Polynomial]:
    """The equations, their sums and differences, and what is left when the constants of two cancel."""
    yield from equations
    if len(equations) <= 12:
        for i, f in enumerate(equations):
            for g in equations[:i]:
                yield f + g
                yield f - g
                if f.constant and g.constant and abs(f.constant) != abs(g.constant):
                    yield f * g.constant - g * f.constant
