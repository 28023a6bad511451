"""The configuration near what is given, in floats, and its further digits in mpmath.

Source: least squares and Gauss-Newton, see `polynomials.gauss_newton`; for more digits simplified Newton
steps: Ortega, Rheinboldt, Iterative Solution of Nonlinear Equations in Several Variables (1970), 7.1.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import sympy

from singsym.classes.configuration.given_values import Target
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.sizes import variable_sizes

if TYPE_CHECKING:
    from singsym.polynomials.compiled_map import Floats
    from singsym.polynomials.gauss_newton import Map

_STARTS = 60
_SAME = 1e-10
"""Where least squares end so near to each other, over the sizes of the variables, they are at one point."""
_SMALL = 1e-9
"""Singular values of the loop equations' slopes below so much of the largest count as zero."""


@dataclass(frozen=True)
class Located:
    """A configuration near what was given; coordinates in the order of the ring's names.

    given: the coordinates that have the given values, off the loops as far as these are; point: those of the
    configuration, floats or mpmath numbers.
    The rest is relative to the size of what it is about: before, after: the largest loop equation at `given`
    and at `point`, over the sum of its terms; moved: the largest change of a variable from one to the other;
    misfit: the largest difference between a given value and that of the point.
    others: further configurations that fit as well; open: freedoms that the given values leave.
    """

    given: tuple[Any, ...]
    point: tuple[Any, ...]
    before: float
    after: float
    moved: float
    misfit: float
    others: int
    open: int


class _Targets:
    """How far the given values are from those of a point, over how large they are.

    sizes: of the variables, made larger where a target is farther away than they can be; those of constants
    stay.  scales: how large each target is.
    """

    def __init__(self, wanted: Sequence[Target], ring: Ring, sizes: Floats) -> None:
        import numpy as np

        from singsym.polynomials.compiled_map import CompiledMap

        self.targets = wanted
        self.values = np.array([float(t.value) for t in wanted])
        self._sides = CompiledMap([t.polynomial for t in wanted], ring)
        self._factors = CompiledMap([t.scale for t in wanted], ring)
        origin = np.zeros(len(sizes))
        sides = self._sides.magnitudes(origin, sizes)
        values = abs(self.values) * self._factors.magnitudes(origin, sizes)
        widest = np.ones(len(sizes))
        fixed = {constant.name for constant in ring.constants}
        for target, factor in zip(wanted, (values / _positive(sides)).tolist(), strict=True):
            for name in {*target.polynomial.variables} - fixed:
                index = ring.index(name)
                widest[index] = max(widest[index], factor)
        self.sizes = sizes * widest
        self.scales = _positive(np.maximum(sides, values))

    def __call__(self, points: Floats) -> tuple[Floats, Floats]:
        """The differences at a point, or at many, and their slopes."""
        (sides, slopes), (factors, more) = self._sides(points), self._factors(points)
        values = sides - self.values * factors
        return values / self.scales, (slopes - self.values[:, None] * more) / self.scales[:, None]


class _Together:
    """The values of two maps of the same variables."""

    def __init__(self, first: Map, second: Map) -> None:
        self.first, self.second, self.sizes = first, second, first.sizes

    def __call__(self, points: Floats) -> tuple[Floats, Floats]:
        """Those of the first, then those of the second."""
        import numpy as np

        (values, slopes), (others, more) = self.first(points), self.second(points)
        return np.concatenate([values, others], axis=-1), np.concatenate([slopes, more], axis=-2)


class _Problem:
    """Loops and targets in floats, over the sizes of their terms.

    free: the indices that may move; sizes: of the variables.
    """

    def __init__(self, equation: VelocityEquation, wanted: Sequence[Target]) -> None:
        import numpy as np

        ring, loops = equation.space.ring, equation.compiled_loops
        self.constants = {ring.index(c.name): c.expression for c in ring.constants}
        self.free = [i for i in range(len(ring.names)) if i not in self.constants]
        self.targets = _Targets(wanted, ring, sizes_of_coordinates(equation))
        self.sizes = self.targets.sizes
        terms = loops.magnitudes(np.zeros(len(self.sizes)), self.sizes)
        self.loops = loops.rescaled(self.sizes, _positive(terms))
        self.both = _Together(self.loops, self.targets)

    def start(self) -> Floats:
        """The origin, but for the constants."""
        import numpy as np

        found = np.zeros(len(self.sizes))
        for index, value in self.constants.items():
            found[index] = float(value)
        return found

    def nearest(self, system: Map, points: Floats) -> Floats:
        """The free coordinates of points, one a row, moved to where the system's values are least."""
        from singsym.polynomials.gauss_newton import Restricted, least_squares

        restricted = Restricted(system, self.start(), self.free)
        return restricted.filled(least_squares(restricted, points[:, self.free]))

    def different(self, points: Floats, most: float) -> list[Floats]:
        """Of points those that are farther than this from the ones before."""
        found: list[Floats] = []
        for point in points:
            if all(self.distance(point, other) > most for other in found):
                found.append(point)
        return found

    def scaled_slopes(self, system: Map, point: Floats) -> Floats:
        """The slopes by the free coordinates over their sizes."""
        return (system(point)[1] * self.sizes)[:, self.free]

    def loop_residual(self, point: Floats) -> float:
        """The largest loop equation."""
        return _largest(self.loops.values(point))

    def misfit(self, point: Floats) -> float:
        """The largest difference between a given value and that of the point."""
        return _largest(self.targets(point)[0])

    def distance(self, one: Floats, other: Floats) -> float:
        """The largest change of a variable, over its size."""
        return _largest((one - other) / self.sizes)


def locate(
    equation: VelocityEquation,
    wanted: Sequence[Target],
    more: bool = False,
    seed: int = 0,
    near: Sequence[Any] | None = None,
) -> Located | None:
    """The configuration nearest to the targets, from several starts; None where none was reached.

    Of those that are about as near, a feasible one.  more: whether coordinates are wanted as mpmath numbers
    in the precision of `mpmath.mp`; they are floats where none settle.  near: a point to start from, and from
    there alone.
    """
    import numpy as np

    from singsym.polynomials.gauss_newton import project

    problem = _Problem(equation, wanted)
    ends: list[tuple[float, Floats, Floats]] = []
    starts = np.array([*_starts(problem, seed)] if near is None else [near], dtype=float)
    for given in problem.different(
        problem.nearest(problem.targets, problem.nearest(problem.both, starts)), _SAME
    ):
        end = project(problem.loops, given, problem.free, accuracy=1e-9, cut=_SMALL)
        if end is not None:
            ends.append((problem.misfit(end), given, end))
    if not ends:
        return None
    smallest = min(misfit for misfit, _, _ in ends)
    near = [e for e in ends if e[0] <= max(1e-7, 1.5 * smallest)]
    near = [e for e in near if is_feasible(equation, e[2], problem.sizes)] or near
    misfit, given, point = min(near, key=lambda e: e[0])
    alike = problem.different(np.array([point, *(end for _, _, end in near)]), max(1e-4, 4 * smallest))
    rank = numerical_rank(problem.scaled_slopes(problem.both, point), 1e-6).rank
    found = Located(
        tuple(given.tolist()),
        tuple(point.tolist()),
        problem.loop_residual(given),
        problem.loop_residual(point),
        problem.distance(point, given),
        misfit,
        len(alike) - 1,
        len(problem.free) - rank,
    )
    return (_refined(problem, found) or found) if more else found


def _starts(problem: _Problem, seed: int) -> Iterator[Floats]:
    """Random points, of three spreads in turn."""
    import numpy as np

    random = np.random.default_rng(seed)
    for attempt in range(_STARTS):
        start = problem.start()
        draw = random.normal(size=len(problem.free)) * (0.3, 1.0, 2.0)[attempt % 3]
        start[problem.free] = draw * problem.sizes[problem.free]
        yield start


def is_feasible(equation: VelocityEquation, point: Floats, sizes: Floats) -> bool:
    """Whether limits and exclusions allow a point, in floats, up to 1e-9 of what their terms can be.

    sizes: of the coordinates.
    """
    import numpy as np

    from singsym.polynomials.compiled_map import CompiledMap

    space = equation.space

    def relative(polynomials: Sequence[Polynomial]) -> Floats:
        if not polynomials:
            return np.zeros(0)
        system = CompiledMap(polynomials, space.ring)
        return system.values(point) / _positive(system.magnitudes(point, sizes))

    if (relative((*space.positive, *space.nonnegative)) < -1e-9).any():
        return False
    return all((abs(relative(group)) > 1e-9).any() for group in space.exclusions)


def _positive(sizes: Floats) -> Floats:
    """Sizes to divide by: 1 for what is zero throughout."""
    sizes[sizes == 0] = 1.0
    return sizes


def sizes_of_coordinates(equation: VelocityEquation) -> Floats:
    """How large each variable is, about; 1 for constants."""
    import numpy as np

    space, ring = equation.space, equation.space.ring
    groups = (space.equations, space.positive, space.nonnegative, *space.exclusions, *space.points.values())
    found = np.array(variable_sizes(ring, (p for group in groups for p in group)))
    found[[ring.index(c.name) for c in ring.constants]] = 1.0
    return found


# -- more digits -------------------------------------------------------------------------------------


def _refined(problem: _Problem, found: Located) -> Located | None:
    """The same configuration in the precision of `mpmath.mp`; None where its digits do not settle."""
    import mpmath
    import numpy as np

    digits = mpmath.mp.dps
    targets, equations = problem.targets, problem.loops.polynomials
    start = [mpmath.mpf(x) for x in found.given]
    for index, value in problem.constants.items():
        start[index] = number(value)
    wanted = [number(t.value) for t in targets.targets]

    def misfits(x: Sequence[Any]) -> list[Any]:
        sides = ((t.polynomial.evaluate(x), t.scale.evaluate(x)) for t in targets.targets)
        return [
            (side - value * scale) / size
            for (side, scale), value, size in zip(sides, wanted, targets.scales, strict=True)
        ]

    def loops(x: Sequence[Any]) -> list[Any]:
        pairs = zip(equations, problem.loops.scales, strict=True)
        return [e.evaluate(x) / size for e, size in pairs]

    slopes = problem.scaled_slopes(problem.both, np.array(found.given))
    start = _settled(lambda x: [*loops(x), *misfits(x)], slopes, start, problem, digits) or start
    slopes = problem.scaled_slopes(targets, np.array(found.given))
    given = _settled(misfits, slopes, start, problem, digits)
    if given is None:
        return None
    slopes = problem.scaled_slopes(problem.loops, np.array([float(x) for x in given]))
    point = _settled(loops, slopes, given, problem, digits)
    if point is None:
        return None
    moves = ((a - b) / size for a, b, size in zip(point, given, problem.sizes, strict=True))
    return replace(
        found,
        given=tuple(given),
        point=tuple(point),
        before=_largest(loops(given)),
        after=_largest(loops(point)),
        moved=_largest(moves),
        misfit=_largest(misfits(point)),
    )


def _settled(
    system: Callable[[Sequence[Any]], list[Any]],
    slopes: Floats,
    start: Sequence[Any],
    problem: _Problem,
    digits: int,
) -> list[Any] | None:
    """Newton steps of least norm with the slopes kept; None where they do not come to an end.

    Each step gains about as many digits as the slopes and the start are right to.
    """
    import mpmath
    import numpy as np

    inverse = np.linalg.pinv(slopes, rcond=_SMALL)
    point = list(start)
    for _ in range(digits):
        values = system(point)
        largest = max(map(abs, values), default=mpmath.mpf(0))
        if not largest:
            return point
        step = inverse @ np.array([float(v / largest) for v in values])
        for index, change in zip(problem.free, step, strict=True):
            point[index] -= largest * change * problem.sizes[index]
        if largest * abs(step).max(initial=0.0) < mpmath.mpf(10) ** (3 - digits):
            return point
    return None


def number(value: sympy.Expr) -> Any:
    """An exact number in the precision of `mpmath.mp`."""
    import mpmath

    return mpmath.mpf(str(sympy.N(value, mpmath.mp.dps + 5)))


def _largest(values: Any) -> float:
    return float(max(map(abs, values), default=0.0))
