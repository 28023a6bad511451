"""As few of a set's equations as seem to bound its dimension: shorter to work with, and shared by many sets.

A bound of the zeros of some of the equations is one of the zeros of all.  Numerical points choose which, and
prove nothing.
Source: singsym's own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from singsym.effort.budget import current
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.polynomials import Equations
from singsym.varieties.real.numerical.sampling import Point, is_large, numerical_points
from singsym.varieties.real.system import RealSystem

LOOKED_AT = 6
"""So many numerical points are looked at for parts of too large a dimension, each time."""
_INDEPENDENT = 1e-7


def fewer_equations(system: RealSystem, dimension: int) -> Equations | None:
    """The shortest equations whose zeros seem to have no larger dimension; `None` where it takes all of them.

    Zeros in an exclusion do not count.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> points_of_two_lines = RealSystem(x.ring, (z, x * y - z, x**2 + y**2 + z - 1))
    >>> fewer_equations(points_of_two_lines, 1), fewer_equations(points_of_two_lines, 0)
    ((z, x*y - z), None)
    """
    import numpy as np

    from singsym.polynomials.compiled_map import CompiledMap

    equations = sorted(system.closed_equations, key=lambda p: (len(p), str(p)))
    needed = len(system.ring.names) - dimension
    compiled = CompiledMap.balanced(equations, system.ring)

    def rank(places: Sequence[int], point: Point) -> int:
        return numerical_rank(compiled.jacobian(np.array(point))[list(places)], _INDEPENDENT).rank

    chosen, others = list(range(needed)), list(range(needed, len(equations)))
    while others:
        current().check("equations that bound a dimension")
        some = tuple(equations[k] for k in chosen)
        seen = numerical_points(replace(system, equations=some), LOOKED_AT)
        point = next((x for x in seen if rank(chosen, x) < needed), None)
        if point is None:
            return some
        most = rank(chosen, point)
        smaller = (k for k in others if is_large(equations[k], (point,)) or rank((*chosen, k), point) > most)
        if (more := next(smaller, None)) is None:
            return None
        chosen.append(more)
        others.remove(more)
    return None
