"""Random real configurations, found numerically: Gauss-Newton steps onto the loop equations.

Source: Gauss-Newton with minimum-norm steps: Nocedal, Wright, Numerical Optimization (2006), section 10.3.
Numbers found here may suggest and illustrate; nothing is concluded from them.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from singsym.kinematics.placement import ConfigurationSpace
from singsym.polynomials import Polynomial, PolynomialMatrix
from singsym.polynomials.sizes import variable_sizes

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_STEPS = 60
_TOLERANCE = 1e-12
# values of inequalities and exclusions that count as zero, over the sizes of their terms
_ZERO, _NEAR_ZERO = 1e-9, 1e-6


class NumericalSystem:
    """Polynomials compiled to arrays of exponents and coefficients, for many evaluations in floats."""

    def __init__(self, polynomials: Sequence[Polynomial], size: int) -> None:
        import numpy as np

        self.polynomials = tuple(polynomials)
        monomials: dict[tuple[int, ...], int] = {}
        rows, columns, values = [], [], []
        for i, polynomial in enumerate(polynomials):
            for exponents, c in polynomial.terms():
                key = tuple(int(e) for e in exponents)
                rows.append(i)
                columns.append(monomials.setdefault(key, len(monomials)))
                values.append(int(c.p) / int(c.q))
        self.exponents = np.array(list(monomials), dtype=np.int64).reshape(len(monomials), size)
        self.coefficients = np.zeros((len(polynomials), len(monomials)))
        self.coefficients[rows, columns] = values

    @cached_property
    def sizes(self) -> Floats:
        """How large the variables are, by `variable_sizes`."""
        import numpy as np

        if not self.polynomials:
            return np.ones(self.exponents.shape[1])
        return np.array(variable_sizes(self.polynomials[0].ring, self.polynomials))

    def magnitudes(self, point: Floats, sizes: Floats) -> Floats:
        """Sums of the absolute values of all terms, where no variable is taken for smaller than its size."""
        import numpy as np

        far = np.maximum(np.abs(point), sizes)
        found: Floats = np.abs(self.coefficients) @ (far**self.exponents).prod(axis=1)
        return found

    def values(self, point: Floats) -> Floats:
        """The polynomials' values."""
        found: Floats = self.coefficients @ (point**self.exponents).prod(axis=1)
        return found

    def jacobian(self, point: Floats) -> Floats:
        """The derivatives, one row a polynomial, one column a variable of the ring."""
        import numpy as np

        powers = point**self.exponents
        slopes = self.exponents * point ** np.maximum(self.exponents - 1, 0)
        found = np.zeros((len(self.coefficients), len(point)))
        for j in range(len(point)):
            others = np.delete(powers, j, axis=1).prod(axis=1)
            found[:, j] = self.coefficients @ (slopes[:, j] * others)
        return found


def numerical_matrix(matrix: PolynomialMatrix, point: Floats) -> Floats:
    """A matrix of polynomials at a point given in the order of the ring's names."""
    import numpy as np

    entries = [e for row in matrix.rows for e in row]
    values: Any = NumericalSystem(entries, len(matrix.ring.names)).values(point)
    found: Floats = np.asarray(values).reshape(matrix.shape)
    return found


def sample_configurations(
    space: ConfigurationSpace, count: int, seed: int = 0, tries: int = 400
) -> list[Floats]:
    """Up to `count` random configurations in the feasible set, in the order of the ring's names.

    Parameters take random values in their ranges.  Fewer points come back where `tries` starts did not
    reach more; an empty list proves nothing.

    >>> from singsym.kinematics.velocity import loop_closure
    >>> from singsym.mechanism import load
    >>> len(sample_configurations(loop_closure(load("fourbar")), 2, seed=1))
    2
    """
    import numpy as np

    random = np.random.default_rng(seed)
    size = len(space.ring.names)
    equations = NumericalSystem(space.equations, size)
    sides = NumericalSystem((*space.positive, *space.nonnegative), size)
    exclusions = [NumericalSystem(group, size) for group in space.exclusions]
    known = {space.ring.index(c.name): _root(c) for c in space.ring.constants}
    dimensions = {space.ring.index(name) for name in space.parameters}
    free = [i for i in range(size) if i not in known and i not in dimensions]
    sizes = np.array(variable_sizes(space.ring, _all_polynomials(space)))
    ranges = _Ranges(space, sizes)
    found: list[Floats] = []
    for attempt in range(tries):
        if len(found) == count:
            break
        point = random.normal(size=size) * sizes * (0.3, 1.0, 3.0)[attempt % 3]
        for index, value in known.items():
            point[index] = value
        if not ranges.draw(point, random):
            continue
        landed = project(equations, point, free)
        if landed is None or (sides.values(landed) < -_ZERO * sides.magnitudes(landed, sizes)).any():
            continue
        if any(_vanish(group, landed, sizes) for group in exclusions):
            continue
        found.append(landed)
    return found


def _all_polynomials(space: ConfigurationSpace) -> tuple[Polynomial, ...]:
    """Equations, conditions and coordinates of points: what tells how large the variables are."""
    groups = (*space.exclusions, *space.points.values())
    return (*space.equations, *space.positive, *space.nonnegative, *(p for group in groups for p in group))


def _vanish(group: NumericalSystem, point: Floats, sizes: Floats) -> bool:
    """Whether all of them are about zero."""
    import numpy as np

    return bool((np.abs(group.values(point)) <= _NEAR_ZERO * group.magnitudes(point, sizes)).all())


def project(equations: NumericalSystem, point: Floats, free: list[int]) -> Floats | None:
    """The end of Gauss-Newton from a point, moving the free coordinates only; None where it stalls.

    Values count against the sizes of their equations' terms, steps against the sizes of the variables.
    """
    import numpy as np

    sizes = equations.sizes
    for _ in range(_STEPS):
        scale = equations.magnitudes(point, sizes)
        scale[scale == 0] = 1.0
        residual = equations.values(point) / scale
        if float(np.abs(residual).max(initial=0.0)) < _TOLERANCE:
            return point
        jacobian = equations.jacobian(point)[:, free] * sizes[free] / scale[:, np.newaxis]
        step = np.linalg.lstsq(jacobian, residual, rcond=1e-10)[0] * sizes[free]
        point = point.copy()
        point[free] -= step
        if not np.isfinite(point).all():
            return None
    return None


class _Ranges:
    """Draws parameters within their open ranges: rejection on the inequalities in parameters alone."""

    def __init__(self, space: ConfigurationSpace, sizes: Floats) -> None:
        names = {*space.parameters, *(c.name for c in space.ring.constants)}
        size = len(space.ring.names)
        self.indices = [space.ring.index(name) for name in space.parameters]
        self.sizes = sizes[self.indices]
        self.bounds = NumericalSystem([p for p in space.positive if set(p.variables) <= names], size)
        # auxiliary roots and inverses of parameters obey equations among the dimensions alone
        own = [e for e in space.equations if set(e.variables) <= names]
        self.relations = NumericalSystem([e for e in own if set(e.variables) & set(space.parameters)], size)

    def draw(self, point: Floats, random: np.random.Generator) -> bool:
        """Put random parameters into the point; False where none was found."""
        import numpy as np

        for attempt in range(200):
            spread = (1.0, 3.0, 10.0, 0.3)[attempt % 4]
            point[self.indices] = np.abs(random.normal(size=len(self.indices))) * spread * self.sizes
            if (self.bounds.values(point) > 0).all():
                if not len(self.relations.coefficients):
                    return True
                landed = project(self.relations, point, self.indices)
                if landed is not None and (self.bounds.values(landed) > 0).all():
                    point[:] = landed
                    return True
        return False


def _root(constant: Any) -> float:
    """An algebraic constant as a float, by bisection in its interval."""
    low, high = constant.low, constant.high

    def value(x: Any) -> Any:
        return sum(c * x**i for i, c in enumerate(constant.minimal))

    sign = value(low) > 0
    for _ in range(80):
        middle = (low + high) / 2
        if (value(middle) > 0) == sign:
            low = middle
        else:
            high = middle
    return float((low + high) / 2)
