"""All zeros of a polynomial on proven arcs of a curve, and its sign on arcs without one.

Source: interval Newton in one parameter (Neumaier, Interval Methods for Systems of Equations, 1990, ch. 5):
between two signs there is one zero where the derivative along the arc keeps its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from singsym.effort.budget import Budget, Undecided
from singsym.polynomials import Polynomial
from singsym.varieties.real.curves.arithmetic import EPSILON, Balls, System
from singsym.varieties.real.curves.critical_points import as_balls
from singsym.varieties.real.curves.paths import Chain, halved, prove_chains
from singsym.varieties.real.curves.tubes import MARGIN, Tubes, location
from singsym.varieties.real.points.boxed_point import BoxPoint, boxed_point

_HALVINGS = 24
_MOST_OPEN = 500
"""Where more tubes than this, or than half of all, are open after `_SOON` halvings, it seems to be zero."""
_SOON = 3
_OPEN = 0
"""Nothing is known of a tube; else a sign, 1 or -1, or that the polynomial rises, 2, or falls, -2."""


@dataclass(frozen=True, eq=False)
class Signed:
    """A loop with the signs of a polynomial on its tubes, and the zeros between them in order.

    signs: 1 or -1, and 0 on the tubes around a zero.
    """

    chain: Chain
    signs: np.ndarray
    zeros: tuple[BoxPoint, ...]


def zeros_on(system: System, loop: Chain, polynomial: Polynomial, budget: Budget) -> Signed:
    """All zeros on a proven loop; none of them may be one of the polynomial's derivative along the loop.

    Raises `Undecided` where that is not proven.

    >>> import numpy as np
    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> circle = System(x.ring, (x**2 + y**2 - 1,))
    >>> turns = np.linspace(0, 2 * np.pi, 41)
    >>> line = np.stack([np.cos(turns), np.sin(turns)], axis=1)
    >>> line[-1] = line[0]
    >>> (loop,) = prove_chains(circle, [Chain(line, (), True)], Budget())
    >>> [p.decimals(3) for p in zeros_on(circle, loop, 2 * y - 1, Budget()).zeros]
    [{'x': '0.866', 'y': '0.500'}, {'x': '-0.866', 'y': '0.500'}]
    """
    if not polynomial:
        raise Undecided("a polynomial is zero, on a curve and elsewhere")
    form = _compiled(polynomial)
    for halvings in range(_HALVINGS):
        budget.check("zeros on a curve")
        if loop.tubes is None:
            raise Undecided("zeros on a curve that is not proven")
        kinds = _kinds(form, loop.tubes)
        runs, left = _runs(kinds)
        if not left.any():
            zeros = tuple(_zero(system, polynomial, loop, run) for run in runs)
            return Signed(loop, np.where(np.abs(kinds) == 1, kinds, 0), zeros)
        if halvings >= _SOON and left.sum() > min(_MOST_OPEN, len(left) / 2):
            break
        proven = prove_chains(system, [halved(system, loop, left)], budget)
        if isinstance(proven, str):
            raise Undecided(f"zeros on a curve: {proven}")
        (loop,) = proven
    raise Undecided(f"the zeros of {polynomial.short_text()} on a curve are not apart")


@lru_cache(maxsize=64)
def _compiled(polynomial: Polynomial) -> System:
    return System(polynomial.ring, (polynomial,))


@np.errstate(all="ignore")
def _kinds(form: System, tubes: Tubes) -> np.ndarray:
    """For each tube the sign of the polynomial on its arc, whether it rises or falls there, or neither."""
    reach = np.abs(tubes.step) * (0.5 + MARGIN) + np.abs(tubes.frame).sum(axis=2) * tubes.radius[:, None]
    box = Balls(tubes.center, reach * (1 + 1e-12))
    value = form.map.precise(tubes.center)
    gradient = form.jacobian_balls(box)
    change = (gradient.magnitude()[:, 0, :] * reach).sum(axis=1) * (1 + 64 * EPSILON)
    middle = value.mid[:, 0]
    found = np.where(np.abs(middle) > value.rad[:, 0] + change, np.sign(middle), 0.0)
    along = gradient.matmul(Balls.exact(tubes.step[:, :, None]))
    bend = np.linalg.norm(gradient.magnitude()[:, 0, :], axis=1) * tubes.slope * (1 + 64 * EPSILON)
    rate = along.mid[:, 0, 0]
    moves = np.abs(rate) > along.rad[:, 0, 0] + bend
    return np.where(found != 0, found, np.where(moves, 2 * np.sign(rate), _OPEN)).astype(int)


def _runs(kinds: np.ndarray) -> tuple[list[np.ndarray], np.ndarray]:
    """Runs of tubes with one zero each, and the tubes of which it is not known.

    Between two tubes with signs the polynomial has one zero where it only rises, or only falls, and the
    signs differ; where they agree it cannot do so all the way.
    """
    count = len(kinds)
    left = np.zeros(count, dtype=bool)
    signed = np.flatnonzero(np.abs(kinds) == 1)
    if not len(signed):
        return [], ~left
    runs = []
    for k, start in enumerate(signed):
        end = signed[(k + 1) % len(signed)] + (count if k + 1 == len(signed) else 0)
        between = np.arange(start + 1, end) % count
        before, after = kinds[start], kinds[end % count]
        if not len(between):
            continue
        if before != after and (kinds[between] == 2 * after).all():
            runs.append(between)
        else:
            left[between] = True
    return runs, left


def _zero(system: System, polynomial: Polynomial, loop: Chain, run: np.ndarray) -> BoxPoint:
    """The zero in a run of tubes: a solution in one of them, which is on its arc."""
    tubes = loop.tubes
    assert tubes is not None
    own = tubes.take(run)
    ends = np.concatenate([own.start, own.end[-1:]])
    values = _compiled(polynomial).values(ends)[:, 0]
    for k in np.argsort(np.abs(values)):
        point = boxed_point(system.ring, (*system.equations, polynomial), {}, tuple(map(float, ends[k])))
        if point is not None and _is_inside(own, point):
            return point
    raise Undecided(f"no zero of {polynomial.short_text()} is certified where it changes its sign")


def _is_inside(tubes: Tubes, point: BoxPoint) -> bool:
    inside, _ = location(tubes, as_balls([point], len(point.ring.names)))
    return bool(inside.any())
