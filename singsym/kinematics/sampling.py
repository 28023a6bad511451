"""Random real configurations, found numerically: Gauss-Newton steps onto the loop equations.

Source: Gauss-Newton with steps of least norm, see `polynomials.gauss_newton`.
Numbers found here may suggest and illustrate; nothing is concluded from them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singsym.kinematics.placement import ConfigurationSpace
from singsym.polynomials import Polynomial
from singsym.polynomials.sizes import variable_sizes

if TYPE_CHECKING:
    import numpy as np

    from singsym.polynomials.compiled_map import CompiledMap, Floats

# values of inequalities and exclusions that count as zero, over the sizes of their terms
_ZERO, _NEAR_ZERO = 1e-9, 1e-6


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

    from singsym.polynomials.compiled_map import CompiledMap
    from singsym.polynomials.gauss_newton import project

    random = np.random.default_rng(seed)
    size = len(space.ring.names)
    equations = CompiledMap.balanced(space.equations, space.ring)
    sides = CompiledMap((*space.positive, *space.nonnegative), space.ring)
    exclusions = [CompiledMap(group, space.ring) for group in space.exclusions]
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


def _vanish(group: CompiledMap, point: Floats, sizes: Floats) -> bool:
    """Whether all of them are about zero."""
    import numpy as np

    return bool((np.abs(group.values(point)) <= _NEAR_ZERO * group.magnitudes(point, sizes)).all())


class _Ranges:
    """Draws parameters within their open ranges: rejection on the inequalities in parameters alone."""

    def __init__(self, space: ConfigurationSpace, sizes: Floats) -> None:
        from singsym.polynomials.compiled_map import CompiledMap

        names = {*space.parameters, *(c.name for c in space.ring.constants)}
        self.indices = [space.ring.index(name) for name in space.parameters]
        self.sizes = sizes[self.indices]
        self.bounds = CompiledMap([p for p in space.positive if set(p.variables) <= names], space.ring)
        # auxiliary roots and inverses of parameters obey equations among the dimensions alone
        own = [e for e in space.equations if set(e.variables) <= names]
        relations = [e for e in own if set(e.variables) & set(space.parameters)]
        self.relations = CompiledMap.balanced(relations, space.ring)

    def draw(self, point: Floats, random: np.random.Generator) -> bool:
        """Put random parameters into the point; False where none was found."""
        import numpy as np

        from singsym.polynomials.gauss_newton import project

        for attempt in range(200):
            spread = (1.0, 3.0, 10.0, 0.3)[attempt % 4]
            point[self.indices] = np.abs(random.normal(size=len(self.indices))) * spread * self.sizes
            if (self.bounds.values(point) > 0).all():
                if not self.relations.count:
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
