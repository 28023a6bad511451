"""All assemblies over given values in closed form, by square roots, at many values at once.

Source: dyads as the meeting of a line and a conic, Hunt, Kinematic Geometry of Mechanisms (1978), ch. 7; the
order of the steps is the block triangular form.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import product
from typing import Any, Protocol

import numpy as np

from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.arithmetic import Arithmetic, Array, Function, Roots
from singsym.motion.drives import DrivenSystem, driven_system
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.block_form import Module, block_form
from singsym.varieties.real.modules.assemblies import Dyad, dyad

Mode = tuple[int, ...]
"""A sign for each square root: that of the functional determinant of a step, which keeps it on a motion."""

_CLOSED = 1e-6
"""Loop equations over the sums of their terms that are left open by more do not close."""


class Step(Protocol):
    """One module, solved in closed form."""

    @property
    def unknowns(self) -> tuple[str, ...]:
        """The names that it determines."""

    @property
    def has_root(self) -> bool:
        """Whether there are two solutions, told apart by a sign."""

    def solved(self, at: Callable[[Polynomial], Array], sign: Any, numbers: Roots) -> list[Array]:
        """The unknowns; `at` gives the values of polynomials in the parents."""


@dataclass(frozen=True)
class LinearStep:
    """As many equations of first degree as unknowns: matrix times unknowns = side."""

    unknowns: tuple[str, ...]
    matrix: tuple[tuple[Polynomial, ...], ...]
    side: tuple[Polynomial, ...]
    has_root = False

    def solved(self, at: Callable[[Polynomial], Array], sign: Any, numbers: Roots) -> list[Array]:
        """See `Step`; not a number where the equations are dependent."""
        size = len(self.unknowns)
        entries = np.stack([at(e) for row in self.matrix for e in row], axis=-1)
        sides = np.stack([at(e) for e in self.side], axis=-1)
        found = numbers.solved(entries.reshape(*entries.shape[:-1], size, size), sides)
        return [found[..., k] for k in range(size)]


@dataclass(frozen=True)
class RootStep:
    """One unknown and an equation of second degree, the coefficients with the constant one first."""

    unknowns: tuple[str, ...]
    coefficients: tuple[Polynomial, Polynomial, Polynomial]
    has_root = True

    def solved(self, at: Callable[[Polynomial], Array], sign: Any, numbers: Roots) -> list[Array]:
        """See `Step`; the sign is that of the equation's derivative."""
        constant, first, second = map(at, self.coefficients)
        return [_root(constant, first, second, sign, numbers)]


@dataclass(frozen=True)
class DyadStep:
    """Two unknowns on a line and on a conic."""

    dyad: Dyad
    has_root = True

    @property
    def unknowns(self) -> tuple[str, ...]:
        """See `Step`."""
        return self.dyad.unknowns

    def solved(self, at: Callable[[Polynomial], Array], sign: Any, numbers: Roots) -> list[Array]:
        """See `Step`; the sign is that of the derivative of the conic along the line."""
        zero = next(iter(self.dyad.conic.values())).ring.zero
        a, b, c = (at(self.dyad.line.get(m, zero)) for m in ((1, 0), (0, 1), (0, 0)))
        f00, f10, f01, f20, f11, f02 = (
            at(self.dyad.conic.get(m, zero)) for m in ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
        )
        square = a * a + b * b
        with np.errstate(divide="ignore", invalid="ignore"):
            x, y = (_over(-c * e, square) for e in (a, b))
        constant = f00 + f10 * x + f01 * y + f20 * x * x + f11 * x * y + f02 * y * y
        slope = (f10 + 2 * f20 * x + f11 * y) * b - (f01 + 2 * f02 * y + f11 * x) * a
        t = _root(constant, slope, f20 * b * b - f11 * a * b + f02 * a * a, sign, numbers)
        return [x + t * b, y - t * a]


def _root(c: Array, b: Array, a: Array, sign: Any, numbers: Roots) -> Array:
    """The root of a t^2 + b t + c at which the derivative has this sign."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return _over(sign * numbers.root(b * b - 4 * a * c) - b, 2 * a)


def _over(above: Array, below: Array) -> Array:
    """A quotient; not a number where the divisor is zero."""
    safe = np.where(below == 0, 1, below)
    return np.where(below == 0, float("nan"), above / safe)


@dataclass(frozen=True, eq=False)
class Forward:
    """The configurations over given values, one for each mode where it can be assembled.

    steps: in the order in which they are solved.
    """

    equation: VelocityEquation
    system: DrivenSystem
    steps: tuple[Step, ...]
    numbers: Arithmetic

    @cached_property
    def modes(self) -> tuple[Mode, ...]:
        """All choices of signs, one for each step with a root, in the order of the steps."""
        return tuple(product((1, -1), repeat=sum(step.has_root for step in self.steps)))

    @cached_property
    def roots(self) -> tuple[str, ...]:
        """For each sign of a mode the unknowns of its step."""
        return tuple(", ".join(step.unknowns) for step in self.steps if step.has_root)

    def at(self, values: Mapping[str, Array], mode: Mode) -> Array:
        """The configurations (..., variables) over values by label; not numbers where there is none."""
        return self._closed(self._solved(values, mode))

    def _solved(self, values: Mapping[str, Array], mode: Mode) -> Array:
        ring, signs = self.system.ring, iter(mode)
        arrays = np.broadcast_arrays(*values.values()) if values else [self.numbers.array(0.0)]
        point = np.zeros((*arrays[0].shape, len(ring.names)), self.numbers.array(0.0).dtype)
        for constant in ring.constants:
            point[..., ring.index(constant.name)] = self.numbers.array(constant.expression)
        for drive, value in zip(self.system.drives, arrays, strict=True):
            parts = (self.numbers.cosine(value), self.numbers.sine(value)) if drive.is_angle else (value,)
            for name, part in zip(drive.names, parts, strict=True):
                point[..., ring.index(name)] = part
        for step, functions in zip(self.steps, self._functions, strict=True):
            sign = next(signs) if step.has_root else 1
            with self.numbers.precision():
                found = step.solved(partial(functions.value, point), sign, self.numbers)
            for name, array in zip(step.unknowns, found, strict=True):
                point[..., ring.index(name)] = array
        return point[..., : len(self.equation.space.ring.names)]

    @cached_property
    def _functions(self) -> list[_Compiled]:
        return [_Compiled(self.numbers, self.system.ring) for _ in self.steps]

    def _closed(self, points: Array) -> Array:
        """The same, not numbers where a loop is open: equations beyond the square systems may not hold."""
        loops, ring = self.equation.space.equations, self.equation.space.ring
        values = self.numbers.compiled(loops, ring)(points).astype(np.float64)
        flat = points.astype(np.float64).reshape(-1, len(ring.names))
        sizes = self.equation.compiled_loops.magnitudes(flat, np.zeros(len(ring.names)))[:, : len(loops)]
        closed = np.asarray(np.abs(values) <= _CLOSED * sizes.reshape(values.shape) + _CLOSED**2).all(axis=-1)
        return np.where(np.expand_dims(closed, -1), points, float("nan"))


class _Compiled(dict[Polynomial, Function]):
    """Functions of single polynomials, each made when it is first asked for."""

    def __init__(self, numbers: Arithmetic, ring: Ring) -> None:
        super().__init__()
        self.numbers, self.ring = numbers, ring

    def value(self, point: Array, p: Polynomial) -> Array:
        """The value of one polynomial."""
        return self[p](point)[..., 0]

    def __missing__(self, p: Polynomial) -> Function:
        self[p] = self.numbers.compiled((p,), self.ring)
        return self[p]


def forward(equation: VelocityEquation, labels: Sequence[str], numbers: Arithmetic) -> Forward:
    """What solves the loops over given values in closed form; raises `MechanismError` where nothing does.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> found = forward(velocity_equation(load("slider-crank")), ["A"], Arithmetic())
    >>> found.roots, found.at({"A": np.array([0.0])}, (1,)).tolist()
    (('d_P',), [[1.0, 0.0, 4.0]])
    """
    system = driven_system(equation, labels)
    fixed = {*system.ring.names} - {*system.unknowns}
    order = block_form((*(e for d in system.drives for e in d.equations), *system.loops), fixed)
    found: list[Step] = []
    for module in order.modules:
        step = _step(module)
        if step is None:
            names = ", ".join(module.unknowns)
            expected = "modules of one or two unknowns; give a configuration near by instead"
            raise MechanismError([Problem("forward", f"{names} to be solved for at once", expected)])
        found.append(step)
    determined = {name for step in found for name in step.unknowns}
    if open_names := [name for name in system.unknowns if name not in determined]:
        expected = f"values that determine {', '.join(open_names)} too"
        raise MechanismError([Problem("forward", f"values of {', '.join(labels) or 'nothing'}", expected)])
    return Forward(equation, system, tuple(found), numbers)


def _step(module: Module) -> Step | None:
    """The closed form of a module, None where it has none of those here."""
    zero = module.equations[0].ring.zero
    if all(_degree(p, module.unknowns) == 1 for p in module.equations):
        matrix = tuple(tuple(p.derivative(n) for n in module.unknowns) for p in module.equations)
        side = tuple(-p.substitute(dict.fromkeys(module.unknowns, zero)) for p in module.equations)
        return LinearStep(module.unknowns, matrix, side)
    if len(module.unknowns) == 1:
        (name,), (p,) = module.unknowns, module.equations
        if p.degree(name) != 2:
            return None
        return RootStep((name,), (p.coefficient(name, 0), p.coefficient(name, 1), p.coefficient(name, 2)))
    found = dyad(module)
    return None if found is None else DyadStep(found)


def _degree(p: Polynomial, names: Sequence[str]) -> int:
    """The degree in these names together."""
    places = [p.ring.index(name) for name in names]
    return max((sum(m[i] for i in places) for m, _ in p.terms()), default=0)
