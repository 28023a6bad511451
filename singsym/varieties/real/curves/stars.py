"""All singular points of a real curve with their half-branches.

Source: the Jacobian criterion; see curve_singular.py and curve_branches.py for the local analysis.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from singsym.effort import chance
from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Known, Premises
from singsym.polynomials import Polynomial
from singsym.varieties.real.curves.arithmetic import Balls, System
from singsym.varieties.real.curves.critical_points import Samples, as_balls, distance_samples, singular_points
from singsym.varieties.real.curves.half_branches import branch_star
from singsym.varieties.real.curves.singular_points import Star, node
from singsym.varieties.real.curves.tracking import kernels
from singsym.varieties.real.curves.tubes import frames, inverses
from singsym.varieties.real.points.exact_point import RealPoint

_SEEDS = 3


def find_stars(
    system: System, equations: Sequence[Polynomial], samples: Samples, seed: int, budget: Budget
) -> Known[tuple[list[Star], Samples]]:
    """The stars at all real singular points, and samples that hold the singular points as well.

    The samples are replaced by those of a distance where a point needs the fibres of one.  Raises `Undecided`
    where the local topology is not proven.
    """
    size = len(system.ring.names)
    balls = as_balls(samples.points, size)
    if is_regular(system, balls).all():
        return Known(([], samples))
    premises = Premises()
    singular = premises.take(singular_points(equations, budget))
    stars: list[Star] = []
    difficult: list[RealPoint] = []
    for point in singular:
        star = node(system, point, as_balls([point.refine(80)], size))
        if star is None:
            difficult.append(point)
        else:
            stars.append(star)
    if not difficult:
        return premises.conclude((stars, samples))
    reason = Undecided("no distance with isolated critical points was found")
    rng = chance.random("distances to singular points", seed)
    for _ in range(_SEEDS):
        try:
            samples = premises.take(distance_samples(equations, difficult[0].floats, rng, budget))
            objective, critical = samples.objective, samples.points
            found = [
                premises.take(branch_star(system, equations, objective, p, critical, budget))
                for p in difficult
            ]
        except Undecided as undecided:
            budget.check("singular points of a curve")
            reason = undecided
            continue
        return premises.conclude(([*stars, *found], samples))
    raise reason


def is_regular(system: System, points: Balls) -> np.ndarray:
    """Whether the Jacobian surely has rank n-1 at the exact points in these balls."""
    count, size = points.mid.shape
    if not count:
        return np.zeros(0, dtype=bool)
    jacobian = system.jacobian(points.mid)
    frame = frames(kernels(system, points.mid))
    square = jacobian @ frame
    precondition = Balls.exact(inverses(square))
    product = precondition.matmul(system.jacobian_balls(points).matmul(Balls.exact(frame)))
    defect = (product - Balls.exact(np.eye(size - 1)[None])).magnitude().sum(axis=2).max(axis=1, initial=0.0)
    return np.asarray(defect < 0.9)
