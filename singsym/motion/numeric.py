"""A linkage as compiled functions of arrays: L, conditions, ranks, joints, and configurations over values.

Source: Zlatanov, Fenton, Benhabib (1998), (1)-(5); the bound by which most ranks are seen without singular
values: Piazza, Politi, An upper bound for the condition number of a matrix in spectral norm, J. Comput. Appl.
Math. 143 (2002) 141-144.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.scaling import scaled_matrix
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.arithmetic import Arithmetic, Array
from singsym.motion.drives import driven_system
from singsym.motion.forward import Forward, Mode, forward
from singsym.motion.newton import Newton
from singsym.polynomials import PolynomialMatrix

if TYPE_CHECKING:
    from singsym.conditions.factor import Factor
    from singsym.mechanism.model import Mechanism

_MATRICES = ("L", "L_I", "L_O", "L_p")
_TOGETHER = 512
"""So many configurations fit into the processor's cache (measured)."""


@dataclass(frozen=True, eq=False)
class NumericLinkage:
    """Functions of configurations q, arrays (..., variables) in the order of `names`.

    numbers: doubles, or mpmath numbers in arrays of objects.  They find and illustrate; they prove nothing.
    Lengths are in the mechanism's unit, angles in radians.
    """

    equation: VelocityEquation
    numbers: Arithmetic = field(default_factory=Arithmetic)

    @property
    def names(self) -> tuple[str, ...]:
        """The variables, and constants such as sqrt2, in the order of q's last axis."""
        return self.equation.space.ring.names

    @property
    def inputs(self) -> tuple[str, ...]:
        """The labels of the input joints."""
        return tuple(c.label for c in self.equation.columns if c.role == "input")

    # -- matrices and conditions ---------------------------------------------------------------------

    def L(self, q: Any) -> Array:
        """The matrix of (1), (..., rows, columns)."""
        return self._matrix("L", q)

    def L_I(self, q: Any) -> Array:
        """L without the input columns, (2)."""
        return self._matrix("L_I", q)

    def L_O(self, q: Any) -> Array:
        """L without the output columns, (3)."""
        return self._matrix("L_O", q)

    def L_p(self, q: Any) -> Array:
        """The passive columns of L."""
        return self._matrix("L_p", q)

    def _matrix(self, name: str, q: Any) -> Array:
        if name not in self._compiled:
            matrix: PolynomialMatrix = getattr(self.equation, name)
            entries = [e for row in matrix.rows for e in row]
            self._compiled[name] = self.numbers.compiled(entries, matrix.ring), matrix.shape
        function, shape = self._compiled[name]
        points = self._points(q)
        found: Array = function(points)
        return found.reshape(*points.shape[:-1], *shape)

    def loops(self, q: Any) -> Array:
        """What is left of the loop equations, (..., equations): zero where q is a configuration."""
        found: Array = self._function("loops", self.equation.space.equations)(self._points(q))
        return found

    def factors(self, label: str) -> tuple[Factor, ...]:
        """The factors of a condition, whose values `condition` gives; none where it holds nowhere.

        label: as "4" or "5".  Raises `MechanismError` where the condition is no product of polynomials.
        """
        found = self.equation.conditions[label]
        if found.alternatives is None or any(len(a) > 1 for a in found.alternatives):
            expected = "a condition that is one equation: (4) or (5) where the determinant can be written out"
            raise MechanismError([Problem("condition", f"({label}): {found.statement}", expected)])
        return found.factors

    def condition(self, label: str, q: Any) -> Array:
        """The values of the factors of a condition, (..., factors)."""
        found: Array = self._function(label, [f.polynomial for f in self.factors(label)])(self._points(q))
        return found

    def _function(self, name: str, polynomials: Sequence[Any]) -> Any:
        if name not in self._compiled:
            self._compiled[name] = self.numbers.compiled(polynomials, self.equation.space.ring)
        return self._compiled[name]

    @cached_property
    def _compiled(self) -> dict[str, Any]:
        return {}

    def ranks(self, q: Any, tolerance: float = 1e-8) -> dict[str, Array]:
        """The ranks of L, L_I, L_O and L_p, scaled to pure numbers: singular values above `tolerance` count.

        As `kinematics.numerical_rank.numerical_rank(part, tolerance, size=1)` of each configuration; -1
        where the configuration is not a number.
        """
        points = self._points(q)
        flat = points.reshape(-1, points.shape[-1])
        real = np.flatnonzero(np.isfinite(flat.astype(np.float64)).all(axis=-1))
        found = {name: np.full(len(flat), -1) for name in _MATRICES}
        ranks = self._fast_ranks if self.numbers.dps is None else self._slow_ranks
        for start in range(0, len(real), _TOGETHER):
            places = real[start : start + _TOGETHER]
            for name, own in ranks(flat[places], tolerance).items():
                found[name][places] = own
        return {name: own.reshape(points.shape[:-1]) for name, own in found.items()}

    def _fast_ranks(self, points: Array, tolerance: float) -> dict[str, Array]:
        """In doubles; singular values only where determinants do not show full ranks."""
        parts = scaled_matrix(self.equation, points).submatrices()
        found = {name: np.full(len(points), min(part.shape[1:])) for name, part in parts.items()}
        left = np.flatnonzero(~_surely_regular(parts, tolerance))
        if left.size:
            for name, part in parts.items():
                values = np.linalg.svd(part[left], compute_uv=False)
                found[name][left] = (values > tolerance).sum(axis=-1)
        return found

    def _slow_ranks(self, points: Array, tolerance: float) -> dict[str, Array]:
        """In mpmath numbers, one configuration after the other."""
        found = {name: np.zeros(len(points), dtype=np.int64) for name in _MATRICES}
        with self.numbers.precision():
            for place, point in enumerate(points):
                parts = scaled_matrix(self.equation, point.tolist()).submatrices()
                for name, part in parts.items():
                    found[name][place] = numerical_rank(part, tolerance, size=1.0).rank
        return found

    # -- configurations ------------------------------------------------------------------------------

    def points(self, q: Any) -> dict[str, Array]:
        """The coordinates of the named points of space, (..., 2) or (..., 3)."""
        points = self._points(q)
        named = self.equation.space.points.items()
        return {name: self._function(f"point {name}", place)(points) for name, place in named}

    def joints(self, q: Any) -> dict[str, Array]:
        """The joints' values by column label: angles above -pi and up to pi, lengths."""
        points, found = self._points(q), {}
        for label, value in self.equation.values.items():
            if value.cosine is not None and value.sine is not None:
                parts = self._function(f"joint {label}", (value.cosine, value.sine))(points)
                found[label] = self.numbers.angle(parts[..., 1], parts[..., 0])
            elif value.square is not None:
                found[label] = self.numbers.root(
                    self._function(f"joint {label}", (value.square,))(points)[..., 0]
                )
            elif value.length is not None:
                found[label] = self._function(f"joint {label}", (value.length,))(points)[..., 0]
        return found

    def configurations(self, values: Mapping[str, Any], mode: Mode | None = None) -> Array:
        """The configurations over values of joints and coordinates of points, in closed form.

        values: by label, as {"A": angles, "E": angles} or {"G.x": x, "G.y": y}: numbers or arrays.
        mode: one of `modes(values)`, the result is (..., variables); without one it has a first axis of all
        modes.  Not numbers where a mode cannot be assembled.
        Raises `MechanismError` where square roots are not enough, as for a 3-RRR; `near` works there too.
        """
        given = {label: self.numbers.array(v) for label, v in values.items()}
        solver = self.solver(tuple(given))
        if mode is not None:
            if mode not in solver.modes:
                found, expected = str(mode), f"one of {', '.join(map(str, solver.modes))}"
                raise MechanismError([Problem("mode", found, expected)])
            return solver.at(given, mode)
        return np.stack([solver.at(given, mode) for mode in solver.modes])

    def modes(self, labels: Sequence[str] | Mapping[str, Any]) -> tuple[Mode, ...]:
        """The assembly modes over values of these labels: a sign for each module that has two solutions.

        A motion that keeps away from the singularities of these modules keeps its mode.
        """
        return self.solver(tuple(labels)).modes

    def solver(self, labels: tuple[str, ...]) -> Forward:
        """The closed form over values of these labels; raises `MechanismError` where there is none."""
        if labels not in self._solvers:
            self._solvers[labels] = forward(self.equation, labels, self.numbers)
        return self._solvers[labels]

    @cached_property
    def _solvers(self) -> dict[tuple[str, ...], Forward]:
        return {}

    def near(self, values: Mapping[str, Any], q: Any) -> Array:
        """The configurations with these values that Newton's method reaches from q, (..., variables).

        values: by label as for `configurations`, of as many configurations as q has.  Not numbers where it
        does not arrive.
        """
        system = driven_system(self.equation, tuple(values))
        given = {label: self.numbers.array(v) for label, v in values.items()}
        return Newton(system, self.numbers).onto(given, self._points(q))

    def sample(self, count: int, seed: int = 0) -> Array:
        """Up to `count` random configurations, (B, variables); see `kinematics.sampling`."""
        found = sample_configurations(self.equation.space, count, seed)
        return self.numbers.array(np.array(found).reshape(len(found), len(self.names)))

    def _points(self, q: Any) -> Array:
        points = q if isinstance(q, np.ndarray) and q.dtype != np.int64 else self.numbers.array(q)
        if self.numbers.dps is not None and points.dtype != object:
            points = self.numbers.array(points)
        if points.shape[-1:] != (len(self.names),):
            found, expected = (
                f"an array {points.shape}",
                f"(..., {len(self.names)}) of {', '.join(self.names)}",
            )
            raise ValueError(f"configurations: found {found}; expected {expected}")
        return points


def numeric(mechanism: Mechanism, *, dps: int | None = None, formulation: str = "auto") -> NumericLinkage:
    """A mechanism's velocity equation as functions of arrays, in doubles or to `dps` decimal digits.

    Raises `MechanismError` for symbolic parameters: give them values.

    >>> from singsym.mechanism import load
    >>> crank = numeric(load("slider-crank"))
    >>> crank.names, crank.modes(["A"]), crank.configurations({"A": 0.0}, (1,)).tolist()
    (('Bx', 'By', 'd_P'), ((1,), (-1,)), [1.0, 0.0, 4.0])
    >>> {name: int(rank) for name, rank in crank.ranks([1.0, 0.0, 4.0]).items()}
    {'L': 4, 'L_I': 4, 'L_O': 3, 'L_p': 3}
    """
    return numeric_equation(velocity_equation(mechanism, formulation), dps=dps)


def numeric_equation(equation: VelocityEquation, *, dps: int | None = None) -> NumericLinkage:
    """The same for a velocity equation."""
    if equation.space.parameters:
        found, expected = ", ".join(equation.space.parameters), "values, as mechanism.with_parameters(a=2)"
        raise MechanismError([Problem("parameters", f"no value of {found}", expected)])
    return NumericLinkage(equation, Arithmetic(dps))


def _surely_regular(parts: Mapping[str, Array], tolerance: float) -> Array:
    """Where both square matrices L_I and L_O have full rank, and with them L and L_p, by determinants alone.

    The smallest singular value is at least |det| over the product of the others, which is largest where they
    are equal; columns more, or rows as many, do not make it smaller.
    """
    sure = np.ones(len(parts["L"]), dtype=bool)
    for name in ("L_I", "L_O"):
        part = parts[name]
        size = part.shape[-1]
        if part.shape[-2] != size or not size:
            return np.zeros_like(sure)
        mean = (part**2).sum(axis=(-2, -1)) / max(1, size - 1)
        sure &= np.abs(np.linalg.det(part)) > 2 * tolerance * mean ** ((size - 1) / 2)
    return sure
