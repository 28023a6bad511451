"""Numerical real points of a system: they guide choices, they prove nothing.

Source: Gauss-Newton from random starts, see `gauss_newton`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from math import prod

from singsym.effort.chaos import strikes
from singsym.polynomials import Polynomial
from singsym.polynomials.sizes import largest_term
from singsym.polynomials.terms import largest_coefficient, value_at
from singsym.varieties.real.system import RealSystem

NEAR = 1e-3
"""Smaller values of exclusions over their largest terms are taken for zero: as at a fourfold root."""
ROUNDING = 1e-8
"""So much of the largest term of a polynomial may be left at a numerical zero; inequalities so far below zero
are taken to hold."""
STARTS = (4, 56)
"""So many random starts are tried together for numerical points of a set, until there are enough."""
POLISHING = 15
"""Undamped steps after them."""
MOST_POINTS = 8
"""At so many numerical points of a set a regular one is looked for."""
Point = tuple[float, ...]
Points = tuple[Point, ...]


def numerical_points(system: RealSystem, count: int = 3) -> Points:
    """Real points near the solutions of a system, as many as are found quickly, the same at every call.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x",))
    >>> (x,) = R.gens
    >>> numerical_points(RealSystem(R, (x**2 - 4,), positive=(x,)), 1)
    ((2.0,),)
    """
    return tuple(islice(_numerical_points(system), count))


def _numerical_points(system: RealSystem) -> Iterator[Point]:
    import numpy

    from singsym.polynomials.compiled_map import CompiledMap
    from singsym.polynomials.gauss_newton import approach, gauss_newton

    if strikes():
        return
    ring = system.ring
    extended = system.with_slack
    compiled = CompiledMap.balanced(extended.closed_equations, extended.ring)
    random = numpy.random.default_rng(0)
    for number in STARTS:
        starts = random.normal(size=(number, compiled.size)) * 2 * compiled.sizes
        for constant in ring.constants:
            starts[:, ring.index(constant.name)] = float((constant.low + constant.high) / 2)
        for near in approach(compiled, starts):
            x = gauss_newton(compiled, near, POLISHING)
            if x is None:
                continue
            point = tuple(map(float, x[: len(ring.names)]))
            if _is_feasible(point, system, tuple(map(float, compiled.sizes[: len(ring.names)]))):
                yield point


def _is_feasible(point: tuple[float, ...], system: RealSystem, sizes: Sequence[float]) -> bool:
    return (
        all(is_off(point, group, sizes) for group in system.exclusions)
        and all(p.evaluate(point) > 0 and is_large(p, (point,), sizes=sizes) for p in system.positive)
        and all(p.evaluate(point) > -ROUNDING * largest_term(p, sizes) for p in system.nonnegative)
    )


def numerical_codimension(system: RealSystem) -> tuple[int, Point] | None:
    """How many of the equations have independent gradients at some numerical point at most, and the point.

    None without a point.  Where a set has parts of several dimensions, the smallest is looked for.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> numerical_codimension(RealSystem(R, (x**2 + y**2 - 1, x**2 + y**2 - x - 1, x)))[0]
    2
    """
    import numpy

    from singsym.kinematics.numerical_rank import numerical_rank
    from singsym.polynomials.compiled_map import CompiledMap

    equations = system.closed_equations
    compiled = CompiledMap.balanced(equations, system.ring)
    best: tuple[int, Point] | None = None
    for point in islice(_numerical_points(system), MOST_POINTS):
        rank = numerical_rank(compiled.jacobian(numpy.array(point)) * compiled.sizes, 1e-7).rank
        if best is None or rank > best[0]:
            best = rank, point
        if rank == len(equations):
            break
    return best


def is_off(
    point: tuple[float, ...], group: tuple[Polynomial, ...], sizes: Sequence[float] | None = None
) -> bool:
    """Whether some polynomial is not small at a point; sizes: of the variables, see `is_large`."""
    return any(is_large(g, (point,), NEAR, sizes) for g in group)


def is_large(
    polynomial: Polynomial, points: Points, threshold: float = 1e-6, sizes: Sequence[float] | None = None
) -> bool:
    """Whether a polynomial is certainly not small at one of the points.

    Relative to its largest term where all variables have these sizes; to its coefficients without them; and
    more than what is left of the largest terms at the point by rounding.
    """
    coefficient = largest_coefficient(polynomial)
    size = coefficient if sizes is None else largest_term(polynomial, sizes)
    for x in points:
        value = abs(value_at(polynomial, x))
        if value <= threshold * size:
            continue
        at = tuple(map(abs, x))
        most = coefficient * prod(
            max(1.0, a) ** max(d, 0) for a, d in zip(at, polynomial.degrees, strict=True)
        )
        if value > ROUNDING * most or value > ROUNDING * largest_term(polynomial, at):
            return True
    return False
