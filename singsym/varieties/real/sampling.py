"""Numerical real points of a system: they guide choices, they prove nothing.

Source: Gauss-Newton from random starts, see `search`.
"""

from __future__ import annotations

from singsym.elimination.chaos import strikes
from singsym.polynomials import Polynomial
from singsym.varieties.real.witness import RealSystem

NEAR = 1e-3
"""Smaller values of exclusions with coefficients of size 1 are taken for zero: as at a fourfold root."""
STARTS = (4, 56)
"""So many random starts are tried together for numerical points of a set, until there are enough."""
POLISHING = 15
"""Undamped steps after them."""
Points = tuple[tuple[float, ...], ...]


def numerical_points(system: RealSystem, count: int = 3) -> Points:
    """Real points near the solutions of a system, as many as are found quickly, the same at every call.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x",))
    >>> (x,) = R.gens
    >>> numerical_points(RealSystem(R, (x**2 - 4,), positive=(x,)), 1)
    ((2.0,),)
    """
    import numpy

    from singsym.varieties.real.search import Compiled, approach, gauss_newton

    if strikes():
        return ()
    ring = system.ring
    extended = system.with_slack
    compiled = Compiled(extended.closed_equations, extended.ring)
    random = numpy.random.default_rng(0)
    found: list[tuple[float, ...]] = []
    for number in STARTS:
        starts = random.normal(size=(number, compiled.size)) * 2
        for constant in ring.constants:
            starts[:, ring.index(constant.name)] = float((constant.low + constant.high) / 2)
        for near in approach(compiled, starts):
            x = gauss_newton(compiled, near, POLISHING)
            if x is None:
                continue
            point = tuple(map(float, x[: len(ring.names)]))
            if (
                all(is_off(point, group) for group in system.exclusions)
                and all(p.evaluate(point) > 0 and is_large(p, (point,)) for p in system.positive)
                and all(p.evaluate(point) > -1e-9 for p in system.nonnegative)
            ):
                found.append(point)
            if len(found) == count:
                return tuple(found)
    return tuple(found)


def numerical_codimension(system: RealSystem) -> int | None:
    """How many of the equations have independent gradients at a numerical point; None without a point.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> numerical_codimension(RealSystem(R, (x**2 + y**2 - 1, x**2 + y**2 - x - 1, x)))
    2
    """
    import numpy

    from singsym.varieties.real.search import Compiled, numerical_rank

    points = numerical_points(system, 1)
    if not points:
        return None
    _, slope = Compiled(system.closed_equations, system.ring)(numpy.array(points[0]))
    return numerical_rank(slope)


def is_off(point: tuple[float, ...], group: tuple[Polynomial, ...]) -> bool:
    """Whether some polynomial is not small at a point."""
    return any(is_large(g, (point,), NEAR) for g in group)


def is_large(polynomial: Polynomial, points: Points, least: float = 1e-6) -> bool:
    """Whether a polynomial is certainly not small at one of the points, relative to its coefficients."""
    size = max((abs(float(c.p) / float(c.q)) for _, c in polynomial.terms()), default=0.0)
    return any(abs(polynomial.evaluate(x)) > least * size for x in points)
