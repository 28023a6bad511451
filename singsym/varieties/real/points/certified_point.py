"""Certified real points of systems of equations, exclusions and inequalities.

Numerical search, then free coordinates frozen at rationals and the rest solved exactly, or proven by a
Krawczyk test where the equations are as many as the unknowns.
Source: Hauenstein, Sottile, ACM Trans. Math. Softw. 38 (2012) 28 (certified solutions).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain
from math import floor, log, prod
from typing import TYPE_CHECKING

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.chaos import strikes
from singsym.effort.verdict import Certainty, Known
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.unit_circles import half_angle_point, unit_circles
from singsym.varieties.real.points.boxed_point import BoxPoint, boxed_point
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import pinned, real_points
from singsym.varieties.real.system import RealSystem

if TYPE_CHECKING:
    from singsym.polynomials.compiled_map import Floats

# denominators tried for the frozen coordinates, nice values first
_DENOMINATORS = (1, 2, 8, 64)
# up to this many solutions by Bezout's bound a point is solved for exactly before a box is tried
_FEW_SOLUTIONS = 64


@dataclass(frozen=True)
class Witness:
    """A certified real point of a system, with the coordinates that were frozen at rationals to find it.

    Both coordinates of a unit vector are frozen together.
    """

    point: RealPoint | BoxPoint
    frozen: tuple[str, ...] = ()

    @property
    def ring(self) -> Ring:
        """The ring of the variables."""
        return self.point.ring

    @property
    def certainty(self) -> Certainty:
        """ "proven" for an exact point, "certified" for a box with one solution inside."""
        return "proven" if isinstance(self.point, RealPoint) else "certified"

    @property
    def box(self) -> tuple[object, ...]:
        """Balls around the coordinates."""
        return self.point.box

    @property
    def floats(self) -> tuple[float, ...]:
        """The coordinates in double precision."""
        return self.point.floats

    @property
    def radius(self) -> float:
        """A bound of their errors."""
        return self.point.radius

    def decimals(self, digits: int = 12) -> dict[str, str]:
        """The coordinates by name to so many digits."""
        return self.point.decimals(digits)

    def sign(self, polynomial: Polynomial) -> int:
        """The sign of a polynomial at the point, decided exactly; see `RealPoint.sign`, `BoxPoint.sign`."""
        return self.point.sign(polynomial)

    def __repr__(self) -> str:
        return f"Witness({self.point!r})"


def find_witness(
    system: RealSystem,
    *,
    seed: int = 0,
    tries: int = 40,
    dimension: int | None = None,
    near: Sequence[Sequence[float]] = (),
    budget: Budget | None = None,
) -> Witness | None:
    """A certified real point of the system, or `None`, which proves nothing.

    dimension: that of the equations' complex zero set, where it is known; else a numerical rank stands in.
    near: points to begin with, about on the zero set.
    Points with small rational coordinates come first.  Raises `BudgetExceeded`.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> find_witness(RealSystem(R, (x**2 + y**2 - 1,), positive=(x, y))).sign(x - y) in (-1, 0, 1)
    True
    """
    budget = current(budget)
    equations = system.closed_equations
    if strikes() or any(f.is_constant for f in equations):
        return None
    for sample in chain(_landed(equations, system.ring, near), samples(system, equations, seed, tries)):
        budget.check("the search for a real point")
        for values in frozen_values(system, equations, sample, dimension):
            budget.check("the search for a real point")
            known = (p.substitute(values) for p in system.positive)
            if any(p.is_constant and p.constant <= 0 for p in known):
                continue
            found = _certified(system, equations, values, sample, budget)
            if found is not None:
                return Witness(found, tuple(values))
    return None


# -- numerical samples -------------------------------------------------------------------------------


def samples(system: RealSystem, equations: Sequence[Polynomial], seed: int, tries: int) -> Iterator[Floats]:
    """Numerical points of the system; inequalities enter with slack variables p = s^2."""
    import numpy as np

    from singsym.polynomials.compiled_map import CompiledMap
    from singsym.polynomials.gauss_newton import gauss_newton

    ring = system.ring
    extended = replace(system, equations=tuple(equations)).with_slack
    wide = extended.ring
    compiled = CompiledMap.balanced(extended.equations, wide)
    sizes = tuple(map(float, compiled.sizes[: len(ring.names)]))
    excluded = [CompiledMap.balanced(group, ring, sizes) for group in system.exclusions]
    random = np.random.default_rng(seed)
    fixed = {ring.index(c.name): float((c.low + c.high) / 2) for c in ring.constants}
    for turn in range(tries):
        start = random.normal(size=len(wide.names)) * (0.7, 1.5, 3.0, 8.0)[turn % 4] * compiled.sizes
        for k, value in fixed.items():
            start[k] = value
        x = gauss_newton(compiled, start) if compiled.count else start
        if x is None:
            continue
        x = x[: len(ring.names)]
        # points that are not accurate, near a double root, come after others
        threshold = 1e-3 if 2 * turn < tries else 1e-6
        if all(float(np.max(np.abs(g.values(x)))) > threshold for g in excluded):
            yield x


def _landed(equations: Sequence[Polynomial], ring: Ring, near: Sequence[Sequence[float]]) -> Iterator[Floats]:
    """Numerical solutions near some points."""
    import numpy as np

    from singsym.polynomials.compiled_map import CompiledMap
    from singsym.polynomials.gauss_newton import gauss_newton

    for point in near:
        x = gauss_newton(CompiledMap.balanced(equations, ring), np.array(point))
        if x is not None:
            yield x


def frozen_values(
    system: RealSystem, equations: Sequence[Polynomial], sample: Floats, dimension: int | None
) -> Iterator[dict[str, Fraction]]:
    """Rationals for as many coordinates as leave finitely many points, coarse ones first.

    A coordinate of a unit vector is held with the other one, at a rational point of the circle.
    """
    from singsym.kinematics.numerical_rank import numerical_rank
    from singsym.polynomials.compiled_map import CompiledMap
    from singsym.polynomials.gauss_newton import Restricted, gauss_newton
    from singsym.varieties.real.numerical.dependent_columns import dependent_columns

    ring = system.ring
    compiled = CompiledMap.balanced(equations, ring)
    slope = compiled.jacobian(sample) * compiled.sizes
    rank = numerical_rank(slope, 1e-7).rank if dimension is None else len(ring.names) - dimension
    dependent = dependent_columns(slope, rank, [ring.index(c.name) for c in ring.constants])
    free = [k for k in range(len(ring.names)) if k not in dependent]
    circles = [pair for pair in unit_circles(equations) if any(ring.index(name) in free for name in pair)]
    seen: set[tuple[Fraction, ...]] = set()
    for denominator in _DENOMINATORS:
        values = {
            ring.names[k]: _rounded(float(sample[k]), denominator / _grid(float(compiled.sizes[k])))
            for k in free
        }
        for pair in circles:
            c, s = (float(sample[ring.index(name)]) for name in pair)
            values |= dict(zip(pair, _on_circle(c, s, denominator), strict=True))
        if tuple(values.values()) in seen:
            continue
        seen.add(tuple(values.values()))
        held = sample.copy()
        held[[ring.index(name) for name in values]] = [float(v) for v in values.values()]
        others = [k for k, name in enumerate(ring.names) if name not in values]
        if gauss_newton(Restricted(compiled, held, others), sample[others]) is not None:
            yield values


def _grid(size: float) -> Fraction:
    """What counts as a whole number for a variable: 1 for sizes from 1/4 to 16, a power of 64 for others.

    >>> _grid(3.0), _grid(1000.0), _grid(0.001)
    (Fraction(1, 1), Fraction(64, 1), Fraction(1, 4096))
    """
    return Fraction(_DENOMINATORS[-1]) ** floor(log(4 * size, _DENOMINATORS[-1]))


def _rounded(number: float, denominator: Fraction | int) -> Fraction:
    return round(number * float(denominator)) / Fraction(denominator)


def _on_circle(c: float, s: float, denominator: int) -> tuple[Fraction, Fraction]:
    """A rational point of the unit circle near another, by the tangent of half the angle.

    >>> _on_circle(0.6, 0.8, 2)
    (Fraction(3, 5), Fraction(4, 5))
    """
    # the angle from the nearer end of the diameter
    end = 1 if c >= 0 else -1
    t = _rounded(s / (1 + abs(c)), denominator)
    cosine, sine = half_angle_point(t)
    return end * cosine, sine


# -- certificates ------------------------------------------------------------------------------------


def _certified(
    system: RealSystem,
    equations: Sequence[Polynomial],
    values: dict[str, Fraction],
    sample: Floats,
    budget: Budget,
) -> RealPoint | BoxPoint | None:
    """An exact point with the frozen values, nearest to the sample; a box for a large square system."""
    ring = system.ring
    left = [f for f in equations if f.substitute(dict(values))]
    if _bezout(left, values) > _FEW_SOLUTIONS and len(left) == len(ring.names) - len(values):
        return _certified_box(system, left, values, sample)
    points: list[RealPoint] = []
    with (
        suppress(NotZeroDimensional),
        attempt("the search for a real point", patience.POINT.work, part_of=budget) as own,
    ):
        # each is a point; whether there are others is no matter
        points = frozen_points(ring, equations, values, own).value
    order = sorted(points, key=lambda p: sum((a - b) ** 2 for a, b in zip(p.floats, sample, strict=True)))
    return next((p for p in order if system.admits(p)), None)


def _bezout(equations: Sequence[Polynomial], values: dict[str, Fraction]) -> int:
    return prod(max(1, f.substitute(dict(values)).total_degree) for f in equations)


def _certified_box(
    system: RealSystem, equations: Sequence[Polynomial], values: dict[str, Fraction], sample: Floats
) -> BoxPoint | None:
    point = boxed_point(system.ring, equations, values, [float(v) for v in sample])
    try:
        known = point is not None and pinned(point, system.ring.constants) and system.admits(point)
        return point if known else None
    except Undecided:
        return None


def frozen_points(
    ring: Ring, equations: Sequence[Polynomial], values: dict[str, Fraction], budget: Budget | None = None
) -> Known[list[RealPoint]]:
    """All real points of the equations with these coordinates at these rationals, exactly.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> frozen_points(R, [x**2 + y**2 - 1], {"x": Fraction(3, 5)}).value
    [RealPoint(x=0.600000, y=-0.800000), RealPoint(x=0.600000, y=0.800000)]
    """
    names = tuple(n for n in ring.names if n not in values)
    smaller = ring.with_names(names)
    if not names:
        zero = all(f.substitute(values).is_zero for f in equations)
        return Known([_rational_point(ring, values)] if zero else [])
    restricted = [smaller.convert(f.substitute(values)) for f in equations]
    points = real_points([*restricted, *smaller.relations] or [smaller.zero], budget)
    return points.map(lambda found: [_lifted(p, ring, values) for p in found])


def _rational_point(ring: Ring, values: dict[str, Fraction]) -> RealPoint:
    point = RealPoint(ring.with_names(()), (0, 1), (1,), (), Fraction(0), Fraction(0))
    return _lifted(point, ring, values)


def _lifted(point: RealPoint, ring: Ring, values: dict[str, Fraction]) -> RealPoint:
    """The point of the whole ring: a frozen coordinate p/q has the numerator p/q times the denominator."""
    common = 1
    for v in values.values():
        common = common * v.denominator
    numerators = []
    for name in ring.names:
        if name in values:
            factor = values[name] * common
            numerators.append(tuple(int(factor) * c for c in point.denominator))
        else:
            numerators.append(tuple(common * c for c in point.numerators[point.ring.index(name)]))
    denominator = tuple(common * c for c in point.denominator)
    return RealPoint(ring, point.minimal, denominator, tuple(numerators), point.low, point.high, point.bits)
