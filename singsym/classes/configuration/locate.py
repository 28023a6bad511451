"""The configuration near what is given, in floats, and its further digits in mpmath.

Source: Levenberg-Marquardt and Gauss-Newton: Nocedal, Wright, Numerical Optimization (2006), chapter 10;
simplified Newton steps for more digits: Ortega, Rheinboldt, Iterative Solution of Nonlinear Equations in
Several Variables (1970), section 7.1.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import sympy

from singsym.classes.configuration.given_values import Target
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.sampling import NumericalSystem
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial
from singsym.polynomials.sizes import variable_sizes

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_STARTS = 60
_STEPS = 80
_ROUNDING = 1e-15


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


class _Problem:
    """Loops and targets in floats, in variables and equations divided by their sizes.

    free: the indices that may move; sizes: of the variables.
    """

    def __init__(self, equation: VelocityEquation, wanted: Sequence[Target]) -> None:
        import numpy as np

        ring = equation.space.ring
        names = len(ring.names)
        self.equations = (*equation.space.equations, *ring.relations)
        self.targets = wanted
        self.constants = {ring.index(c.name): c.expression for c in ring.constants}
        self.free = [i for i in range(names) if i not in self.constants]
        self.wanted = np.array([float(t.value) for t in wanted])
        self.sizes = sizes_of_coordinates(equation)
        self.target_sizes = self._fitted_to_targets()
        self.loops = self._system(self.equations)
        self.sides = self._system([t.polynomial for t in wanted])
        self.scales = self._system([t.scale for t in wanted])
        self.loop_sizes = _positive(abs(self.loops.coefficients).sum(axis=1))

    def _fitted_to_targets(self) -> Floats:
        """How large each target is; variables are made larger where it is farther away than they can be."""
        import numpy as np

        sides = abs(self._system([t.polynomial for t in self.targets]).coefficients).sum(axis=1)
        scales = abs(self._system([t.scale for t in self.targets]).coefficients).sum(axis=1)
        values = abs(self.wanted) * scales
        widest = [1.0] * len(self.sizes)
        for target, factor in zip(self.targets, (values / _positive(sides)).tolist(), strict=True):
            for name in target.polynomial.variables:
                index = target.polynomial.ring.index(name)
                if index not in self.constants:
                    widest[index] = max(widest[index], factor)
        self.sizes = self.sizes * widest
        return _positive(np.maximum(sides, values))

    def _system(self, polynomials: Sequence[Polynomial]) -> NumericalSystem:
        system = NumericalSystem(polynomials, len(self.sizes))
        system.coefficients *= (self.sizes**system.exponents).prod(axis=1)
        return system

    def start(self) -> Floats:
        import numpy as np

        found = np.zeros(len(self.sizes))
        for index, value in self.constants.items():
            found[index] = float(value)
        return found

    def on_loops(self, y: Floats) -> tuple[Floats, Floats]:
        """Values and slopes of the loop equations."""
        sizes = self.loop_sizes
        return self.loops.values(y) / sizes, self.loops.jacobian(y)[:, self.free] / sizes[:, None]

    def on_targets(self, y: Floats) -> tuple[Floats, Floats]:
        """The same of the given values."""
        sizes = self.target_sizes
        values = self.sides.values(y) - self.wanted * self.scales.values(y)
        slopes = self.sides.jacobian(y) - self.wanted[:, None] * self.scales.jacobian(y)
        return values / sizes, slopes[:, self.free] / sizes[:, None]

    def on_both(self, y: Floats) -> tuple[Floats, Floats]:
        import numpy as np

        (values, slopes), (others, more) = self.on_loops(y), self.on_targets(y)
        return np.concatenate([values, others]), np.vstack([slopes, more])

    def loop_residual(self, y: Floats) -> float:
        return float(abs(self.on_loops(y)[0]).max(initial=0.0))

    def misfit(self, y: Floats) -> float:
        return float(abs(self.on_targets(y)[0]).max(initial=0.0))


def locate(
    equation: VelocityEquation, wanted: Sequence[Target], more: bool = False, seed: int = 0
) -> Located | None:
    """The configuration nearest to the targets, from several starts; None where none was reached.

    Of those that are about as near, a feasible one.  more: whether coordinates are wanted as mpmath numbers
    in the precision of `mpmath.mp`; they are floats where none settle.
    """
    import numpy as np

    problem = _Problem(equation, wanted)
    random = np.random.default_rng(seed)
    ends: list[tuple[float, Floats, Floats]] = []
    for attempt in range(_STARTS):
        y = problem.start()
        y[problem.free] = random.normal(size=len(problem.free)) * (0.3, 1.0, 2.0)[attempt % 3]
        given = _step_down(problem.on_targets, _step_down(problem.on_both, y, problem.free), problem.free)
        end = _onto_loops(problem, given)
        if end is not None:
            ends.append((problem.misfit(end), given, end))
    if not ends:
        return None
    least = min(misfit for misfit, _, _ in ends)
    near = [e for e in ends if e[0] <= max(1e-7, 1.5 * least)]
    near = [e for e in near if is_feasible(equation, e[2] * problem.sizes, problem.sizes)] or near
    misfit, given, point = min(near, key=lambda e: e[0])
    alike: list[Floats] = [point]
    for _, _, other in near:
        if all(abs(other - seen).max() > max(1e-4, 4 * least) for seen in alike):
            alike.append(other)
    rank = numerical_rank(problem.on_both(point)[1], 1e-6).rank
    found = Located(
        tuple((given * problem.sizes).tolist()),
        tuple((point * problem.sizes).tolist()),
        problem.loop_residual(given),
        problem.loop_residual(point),
        float(abs(point - given).max(initial=0.0)),
        misfit,
        len(alike) - 1,
        len(problem.free) - rank,
    )
    return (_refined(problem, found) or found) if more else found


def is_feasible(equation: VelocityEquation, point: Floats, sizes: Floats) -> bool:
    """Whether limits and exclusions allow a point, in floats, up to 1e-9 of what their terms can be.

    sizes: of the coordinates.
    """
    import numpy as np

    space = equation.space
    largest = np.maximum(abs(point), sizes)

    def relative(polynomials: Sequence[Polynomial]) -> Floats:
        system = NumericalSystem(polynomials, len(point))
        most = abs(system.coefficients) @ (largest**system.exponents).prod(axis=1)
        return system.values(point) / _positive(most)

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


def _step_down(system: Callable[[Floats], tuple[Floats, Floats]], y: Floats, free: Sequence[int]) -> Floats:
    """Levenberg-Marquardt from a point, moving the free coordinates only."""
    import numpy as np

    values, slopes = system(y)
    damping = 1e-2
    for _ in range(_STEPS):
        normal = slopes.T @ slopes
        step = np.linalg.solve(normal + damping * np.eye(len(normal)), slopes.T @ values)
        trial = y.copy()
        trial[free] -= step
        fresh, fresh_slopes = system(trial)
        if fresh @ fresh <= values @ values:
            y, values, slopes, damping = trial, fresh, fresh_slopes, max(damping / 8, 1e-14)
            if abs(step).max(initial=0.0) < _ROUNDING:
                break
        else:
            damping *= 6
            if damping > 1e8:
                break
    return y


def _onto_loops(problem: _Problem, y: Floats) -> Floats | None:
    """Gauss-Newton steps of least norm onto the loop equations; None where they do not arrive."""
    import numpy as np

    for _ in range(_STEPS):
        values, slopes = problem.on_loops(y)
        step = np.linalg.lstsq(slopes, values, rcond=1e-9)[0]
        y = y.copy()
        y[problem.free] -= step
        if abs(step).max(initial=0.0) < _ROUNDING:
            break
    return y if np.isfinite(y).all() and problem.loop_residual(y) < 1e-9 else None


# -- more digits -------------------------------------------------------------------------------------


def _refined(problem: _Problem, found: Located) -> Located | None:
    """The same configuration in the precision of `mpmath.mp`; None where its digits do not settle."""
    import mpmath
    import numpy as np

    digits = mpmath.mp.dps
    sizes = problem.sizes
    start = [mpmath.mpf(x) for x in found.given]
    for index, value in problem.constants.items():
        start[index] = number(value)
    wanted = [number(t.value) for t in problem.targets]
    y = np.array(found.given) / sizes

    def misfits(x: Sequence[Any]) -> list[Any]:
        sides = ((t.polynomial.evaluate(x), t.scale.evaluate(x)) for t in problem.targets)
        return [
            (side - value * scale) / size
            for (side, scale), value, size in zip(sides, wanted, problem.target_sizes, strict=True)
        ]

    def loops(x: Sequence[Any]) -> list[Any]:
        pairs = zip(problem.equations, problem.loop_sizes, strict=True)
        return [e.evaluate(x) / size for e, size in pairs]

    slopes = problem.on_both(y)[1]
    start = _settled(lambda x: [*loops(x), *misfits(x)], slopes, start, problem, digits) or start
    given = _settled(misfits, problem.on_targets(y)[1], start, problem, digits)
    if given is None:
        return None
    here = np.array([float(x) for x in given]) / sizes
    point = _settled(loops, problem.on_loops(here)[1], given, problem, digits)
    if point is None:
        return None
    moves = ((a - b) / size for a, b, size in zip(point, given, sizes, strict=True))
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

    inverse = np.linalg.pinv(slopes, rcond=1e-9)
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
