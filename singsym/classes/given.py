"""What is given of a configuration: joint values, points, variables; and the configuration near it.

Source: Levenberg-Marquardt and Gauss-Newton: Nocedal, Wright, Numerical Optimization (2006), chapter 10.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import sympy

from singsym.kinematics.sampling import NumericalSystem
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.expressions import DecimalText
from singsym.mechanism.problems import MechanismError, Problem
from singsym.mechanism.reader import Reader
from singsym.polynomials import Polynomial

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_STARTS = 60


@dataclass(frozen=True)
class Given:
    """Values by column label (angles in radians), by point (None: coordinate not given), by variable."""

    joints: Mapping[str, sympy.Expr] = field(default_factory=dict)
    points: Mapping[str, tuple[sympy.Expr | None, ...]] = field(default_factory=dict)
    variables: Mapping[str, sympy.Expr] = field(default_factory=dict)

    @classmethod
    def from_toml(cls, text: str, file: str = "") -> Given:
        """From the tables `joints`, `points`, `variables` of a file; raises `MechanismError`.

        Numbers and text as in mechanism files; angles such as "30 deg" or "pi/6", a bare number in radians.

        >>> Given.from_toml('[joints]\\nA = "30 deg"').joints
        {'A': pi/6}
        """
        try:
            data = tomllib.loads(text, parse_float=DecimalText)
        except (tomllib.TOMLDecodeError, RecursionError, ValueError) as error:
            raise MechanismError([Problem("file", f"no TOML: {error}", "TOML", file=file)]) from None
        return cls.of(data, file)

    @classmethod
    def of(cls, data: Mapping[str, Any], file: str = "") -> Given:
        """The same from a dict of the three tables."""
        reader = Reader(file)
        tables = reader.table(data, "file", ("joints", "points", "variables"))
        joints = reader.table(tables.get("joints", {}), "joints")
        points = reader.table(tables.get("points", {}), "points")
        variables = reader.table(tables.get("variables", {}), "variables")
        found = cls(
            {k: reader.expression(v, f"joints.{k}") for k, v in joints.items()},
            {
                k: tuple(reader.expression(x, f"points.{k}") for x in reader.items(v, f"points.{k}"))
                for k, v in points.items()
            },
            {k: reader.expression(v, f"variables.{k}") for k, v in variables.items()},
        )
        if not (joints or points or variables):
            reader.report("file", "no values", "values in [joints], [points] or [variables]")
        if reader.problems:
            raise MechanismError(reader.problems)
        return found


@dataclass(frozen=True)
class Target:
    """That polynomial = value * scale."""

    label: str
    polynomial: Polynomial
    scale: Polynomial
    value: sympy.Expr


def targets(given: Given, equation: VelocityEquation, file: str = "") -> tuple[Target, ...]:
    """What is given, as equations in the variables; raises `MechanismError` for unknown names."""
    space = equation.space
    one = space.ring.one
    found: list[Target] = []
    problems: list[Problem] = []

    def unknown(place: str, name: str, known: Sequence[str]) -> None:
        problems.append(Problem(place, name, f"one of {', '.join(known) or 'none'}", file=file))

    for name, value in given.variables.items():
        if name in space.ring.names:
            found.append(Target(name, space.ring.gen(name), one, value))
        else:
            unknown("variables", name, (*space.variables, *space.parameters))
    for name, place in given.points.items():
        coordinates = space.points.get(name, ())
        if len(place) != len(coordinates):
            if coordinates:
                expected = f"{len(coordinates)} coordinates"
                problems.append(Problem(f"points.{name}", f"{len(place)}", expected, file=file))
            else:
                unknown("points", name, tuple(space.points))
            continue
        for axis, p, v in zip("xyz", coordinates, place, strict=False):
            if v is not None:
                found.append(Target(f"{name}.{axis}", p, one, v))
    for name, value in given.joints.items():
        if name in equation.values:
            found += _joint_targets(name, equation, value)
        else:
            unknown("joints", name, tuple(equation.values))
    if problems:
        raise MechanismError(problems)
    return tuple(found)


def _joint_targets(name: str, equation: VelocityEquation, value: sympy.Expr) -> Iterator[Target]:
    joint, one = equation.values[name], equation.space.ring.one
    if joint.length is not None:
        yield Target(name, joint.length, one, value)
    elif joint.square is not None:
        yield Target(name, joint.square, one, value**2)
    elif joint.cosine is not None and joint.sine is not None:
        scale = joint.scale if joint.scale is not None else one
        yield Target(f"cos({name})", joint.cosine, scale, sympy.cos(value))
        yield Target(f"sin({name})", joint.sine, scale, sympy.sin(value))


# -- exact -------------------------------------------------------------------------------------------


def exact_values(equation: VelocityEquation, wanted: Sequence[Target]) -> dict[str, sympy.Expr] | None:
    """The exact value of every name of the ring, where what is given yields it by linear equations alone.

    None where a name stays open; whether the loops close is not examined.
    """
    ring = equation.space.ring
    known: dict[sympy.Symbol, sympy.Expr] = {}
    for constant in ring.constants:
        known[sympy.Symbol(constant.name)] = constant.expression
    waiting = [
        ring.to_sympy(t.polynomial) - t.value * ring.to_sympy(t.scale) for t in wanted if t.value.is_number
    ]
    waiting += [ring.to_sympy(e) for e in equation.space.equations]
    progress = True
    while progress:
        progress = False
        for expression in waiting:
            left = expression.xreplace(known)
            if len(left.free_symbols) == 1:
                (symbol,) = left.free_symbols
                polynomial = sympy.Poly(left, symbol)
                if polynomial.degree() == 1:
                    slope, offset = polynomial.all_coeffs()
                    known[symbol] = -offset / slope
                    progress = True
    values = {name: known.get(sympy.Symbol(name)) for name in ring.names}
    if any(v is None for v in values.values()):
        return None
    return {name: v for name, v in values.items() if v is not None}


# -- numerical ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Located:
    """A configuration near what was given.

    point: in the order of the ring's names; before: the largest loop equation at the given values (as far as
    they reach); after: at the point; moved: the largest change of a variable on the way.
    others: further configurations that fit as well; open: freedoms that the given values leave.
    misfit: the largest difference between a given value and that of the point.
    """

    point: tuple[float, ...]
    before: float
    after: float
    moved: float
    misfit: float
    others: int
    open: int


class _Problem:
    """Loops and targets in floats; free: the indices that may move."""

    def __init__(self, equation: VelocityEquation, wanted: Sequence[Target]) -> None:
        import numpy as np

        ring = equation.space.ring
        names = len(ring.names)
        self.loops = NumericalSystem((*equation.space.equations, *ring.relations), names)
        self.sides = NumericalSystem([t.polynomial for t in wanted], names)
        self.scales = NumericalSystem([t.scale for t in wanted], names)
        self.wanted = np.array([float(t.value) for t in wanted])
        self.start = np.zeros(names)
        fixed = set()
        for constant in ring.constants:
            index = ring.index(constant.name)
            self.start[index] = float(constant.expression)
            fixed.add(index)
        self.free = [i for i in range(names) if i not in fixed]
        self.extent = size(equation)

    def misfits(self, x: Floats) -> Floats:
        return self.sides.values(x) - self.wanted * self.scales.values(x)

    def slopes(self, x: Floats) -> Floats:
        return self.sides.jacobian(x) - self.wanted[:, None] * self.scales.jacobian(x)

    def both(self, x: Floats, weight: float) -> tuple[Floats, Floats]:
        import numpy as np

        values = np.concatenate([self.loops.values(x), weight * self.misfits(x)])
        slopes = np.vstack([self.loops.jacobian(x), weight * self.slopes(x)])
        return values, slopes[:, self.free]


def locate(equation: VelocityEquation, wanted: Sequence[Target], seed: int = 0) -> Located | None:
    """The configuration nearest to the targets, from several starts; None where none was reached.

    Of those that are about as near, a feasible one.
    """
    import numpy as np

    problem = _Problem(equation, wanted)
    extent = size(equation)
    random = np.random.default_rng(seed)
    spread = max(extent, float(np.abs(problem.wanted).max(initial=0.0)))
    ends: list[tuple[float, Floats, Floats]] = []
    for attempt in range(_STARTS):
        x = problem.start.copy()
        x[problem.free] = random.normal(size=len(problem.free)) * spread * (0.3, 1.0, 2.0)[attempt % 3]
        given = _step_down(problem, _step_down(problem, x, 1.0), None)
        end = _onto_loops(problem, given)
        if end is not None:
            ends.append((float(np.abs(problem.misfits(end)).max(initial=0.0)), given, end))
    if not ends:
        return None
    least = min(misfit for misfit, _, _ in ends)
    near = [e for e in ends if e[0] <= max(1e-7 * extent, 1.5 * least)]
    near = [e for e in near if is_feasible(equation, e[2])] or near
    misfit, given, point = min(near, key=lambda e: e[0])
    alike: list[Floats] = [point]
    for _, _, other in near:
        if all(np.abs(other - seen).max() > max(1e-4 * extent, 4 * least) for seen in alike):
            alike.append(other)
    _, slopes = problem.both(point, 1.0)
    singular = np.linalg.svd(slopes, compute_uv=False)
    rank = int((singular > 1e-6 * float(singular[0])).sum())
    return Located(
        tuple(map(float, point)),
        float(np.abs(problem.loops.values(given)).max(initial=0.0)),
        float(np.abs(problem.loops.values(point)).max(initial=0.0)),
        float(np.abs(point - given).max(initial=0.0)),
        misfit,
        len(alike) - 1,
        len(problem.free) - rank,
    )


def size(equation: VelocityEquation) -> float:
    """A length to compare with: the root of the largest constant term of the loop equations; 1 without any.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> size(velocity_equation(load("slider-crank")))
    3.0
    """
    constants = [abs(e.constant) for e in equation.space.equations]
    return max((float(int(c.p) / int(c.q)) ** 0.5 for c in constants if c), default=1.0)


def is_feasible(equation: VelocityEquation, point: Floats) -> bool:
    """Whether limits and exclusions allow a point, in floats."""
    import numpy as np

    space = equation.space
    names = len(space.ring.names)
    signs = NumericalSystem((*space.positive, *space.nonnegative), names).values(point)
    if (signs < -1e-9 * size(equation)).any():
        return False
    return all(
        np.abs(NumericalSystem(group, names).values(point)).max(initial=0.0) > 1e-9
        for group in space.exclusions
    )


def _step_down(problem: _Problem, x: Floats, weight: float | None) -> Floats:
    """Levenberg-Marquardt on loops and targets together, or on the targets alone (weight None)."""
    import numpy as np

    def at(y: Floats) -> tuple[Floats, Floats]:
        if weight is None:
            return problem.misfits(y), problem.slopes(y)[:, problem.free]
        return problem.both(y, weight)

    values, slopes = at(x)
    damping = 1e-2
    for _ in range(80):
        normal = slopes.T @ slopes
        step = np.linalg.solve(normal + damping * np.eye(len(normal)), slopes.T @ values)
        y = x.copy()
        y[problem.free] -= step
        fresh, fresh_slopes = at(y)
        if fresh @ fresh <= values @ values:
            x, values, slopes, damping = y, fresh, fresh_slopes, max(damping / 8, 1e-14)
            if np.abs(step).max(initial=0.0) < 1e-14:
                break
        else:
            damping *= 6
            if damping > 1e8:
                break
    return x


def _onto_loops(problem: _Problem, x: Floats) -> Floats | None:
    """Gauss-Newton steps of least norm onto the loop equations; None where they do not arrive."""
    import numpy as np

    for _ in range(80):
        values = problem.loops.values(x)
        slopes = problem.loops.jacobian(x)[:, problem.free]
        step = np.linalg.lstsq(slopes, values, rcond=1e-9)[0]
        x = x.copy()
        x[problem.free] -= step
        if np.abs(step).max(initial=0.0) < 1e-15:
            break
    reached = float(np.abs(problem.loops.values(x)).max(initial=0.0))
    return (
        x if np.isfinite(x).all() and reached < 1e-9 * (1 + float(np.abs(x).max(initial=0.0)) ** 2) else None
    )
