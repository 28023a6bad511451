"""A configuration over a number field: its coordinates, and the kernels of L and its submatrices there.

Source: number fields by a primitive element, in SymPy (https://docs.sympy.org, sympy.polys.matrices).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import TYPE_CHECKING, Any

import sympy
from flint import fmpz_poly

from singsym.classes.configuration.given_values import Target
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.polynomials.ring import AlgebraicConstant
from singsym.polynomials.sizes import largest_term
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.roots import real_roots

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_DIGITS = 60


def exact_values(equation: VelocityEquation, wanted: Sequence[Target]) -> dict[str, sympy.Expr] | None:
    """The exact value of every name of the ring, where what is given yields it by linear equations alone.

    None where a name stays open; whether the loops close is not examined.
    """
    ring = equation.space.ring
    known: dict[sympy.Symbol, sympy.Expr] = {}
    for constant in ring.constants:
        known[sympy.Symbol(constant.name)] = constant.expression
    waiting = [t.polynomial.to_sympy() - t.value * t.scale.to_sympy() for t in wanted if t.value.is_number]
    waiting += [e.to_sympy() for e in equation.space.equations]
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


@dataclass(frozen=True)
class ExactPoint:
    """A configuration over a number field.

    numbers: the field, as a domain of SymPy; coordinates: elements of it, in the order of the ring's names.
    """

    equation: VelocityEquation
    numbers: Any
    coordinates: tuple[Any, ...]

    @classmethod
    def of(cls, equation: VelocityEquation, values: Mapping[str, sympy.Expr]) -> ExactPoint | None:
        """From the values of all names; None where one is not algebraic, or a loop does not close exactly."""
        from sympy.polys.constructor import construct_domain

        given = [values[name] for name in equation.space.ring.names]
        if not given or not all(v.is_algebraic for v in given) or not _may_close(equation, given):
            return None
        domain, elements = construct_domain(given, extension=True)
        if not (domain.is_ZZ or domain.is_QQ or domain.is_Algebraic):
            return None
        numbers = domain.get_field()
        point = tuple(numbers.convert_from(e, domain) for e in elements)
        return (
            None
            if any(e.evaluate(point) for e in equation.space.equations)
            else cls(equation, numbers, point)
        )

    def kernel(self, matrix: PolynomialMatrix) -> Floats:
        """A basis of the kernel of a matrix here, one vector a row, in floats; their number is exact."""
        return _kernel(matrix, self.coordinates, self.numbers)

    @cached_property
    def real_point(self) -> RealPoint:
        """The same over the ring with one name more, a number that generates the field, as a constant."""
        ring, name = self.equation.space.ring, "number field"
        minimal: tuple[int, ...] = (0, 1)
        low, high = Fraction(-1), Fraction(1)
        if self.numbers.is_Algebraic:
            integers = [int(c) for c in self.numbers.ext.minpoly.clear_denoms(convert=True)[1].all_coeffs()]
            minimal = tuple(reversed(integers))
            near = Fraction(str(sympy.N(self.numbers.ext.as_expr(), _DIGITS)))
            low, high = min(
                real_roots(fmpz_poly(list(minimal))), key=lambda ends: max(ends[0] - near, near - ends[1])
            )
        generator = AlgebraicConstant(name, minimal, low, high)
        wide = Ring((*ring.names, name), ring.order, (*ring.constants, generator))
        lists = [_coefficients(x, self.numbers) for x in self.coordinates]
        common = lcm(*(c.denominator for own in lists for c in own))
        rows = [tuple(int(c * common) for c in own) for own in lists]
        return RealPoint(wide, minimal, (common,), (*rows, (0, common)), low, high, 0).refine(64)

    def number(self, polynomial: Polynomial) -> Any:
        """The value of a polynomial of this ring, or of that of `real_point`, as a number of the field."""
        more = () if polynomial.ring == self.equation.space.ring else (self._generator,)
        return self.numbers.convert(polynomial.evaluate((*self.coordinates, *more)))

    @property
    def _generator(self) -> Any:
        return self.numbers.unit if self.numbers.is_Algebraic else self.numbers.zero

    def value(self, polynomial: Polynomial) -> Polynomial:
        """The value of a polynomial here, as a polynomial in the constant of `real_point`."""
        return self._written(self.number(polynomial))

    def _written(self, number: Any) -> Polynomial:
        ring = self.real_point.ring
        parts = enumerate(_coefficients(number, self.numbers))
        return sum((ring.gens[-1] ** k * c for k, c in parts), start=ring.zero)

    def sign(self, number: Any) -> int:
        """The sign of a number of the field."""
        return self.real_point.sign(self._written(number))

    def null_space(self, rows: Sequence[Sequence[Any]]) -> list[list[Any]]:
        """A basis of the kernel of a matrix of numbers, one vector a row."""
        from sympy.polys.matrices import DomainMatrix

        found = DomainMatrix([list(r) for r in rows], (len(rows), len(rows[0])), self.numbers).nullspace()
        return [list(row) for row in found.to_list()]

    def product(self, one: Sequence[Sequence[Any]], other: Sequence[Sequence[Any]]) -> list[list[Any]]:
        """The product of two matrices of numbers."""
        columns = list(zip(*other, strict=True))
        zero = self.numbers.zero
        return [[sum((a * b for a, b in zip(r, c, strict=True)), zero) for c in columns] for r in one]


def _may_close(equation: VelocityEquation, given: Sequence[sympy.Expr]) -> bool:
    """Whether the loops close to many digits, before a field is looked for, which may take long."""
    import mpmath

    with mpmath.workdps(_DIGITS):
        point = [mpmath.mpf(str(sympy.N(v, _DIGITS))) for v in given]
        sizes = [max(1.0, abs(float(x))) for x in point]
        left = ((abs(e.evaluate(point)), largest_term(e, sizes)) for e in equation.space.equations)
        return all(value < size * mpmath.mpf(10) ** (-_DIGITS // 2) for value, size in left)


def exact_kernels(equation: VelocityEquation, values: Mapping[str, sympy.Expr]) -> dict[str, Floats] | None:
    """Bases of the kernels of L, L_I, L_O and L_p, one vector a row; None where there is no such point."""
    point = ExactPoint.of(equation, values)
    if point is None:
        return None
    matrices = {"L": equation.L, "L_I": equation.L_I, "L_O": equation.L_O, "L_p": equation.L_p}
    return {name: point.kernel(matrix) for name, matrix in matrices.items()}


def _coefficients(element: Any, numbers: Any) -> list[Fraction]:
    """Of an element of a field by powers of its generator, constant first."""
    own = list(reversed(element.to_list())) if numbers.is_Algebraic else [element]
    return [Fraction(int(c.numerator), int(c.denominator)) for c in own]


def _kernel(matrix: PolynomialMatrix, point: Sequence[Any], numbers: Any) -> Floats:
    import numpy as np
    from sympy.polys.matrices import DomainMatrix

    if not matrix.shape[0]:
        return np.eye(matrix.width)
    if not matrix.width:
        return np.zeros((0, 0))
    rows = [[numbers.convert(e) for e in row] for row in matrix.evaluate(point)]
    reduced, pivots = DomainMatrix(rows, matrix.shape, numbers).rref()
    free = [j for j in range(matrix.width) if j not in pivots]
    entries = reduced.to_list()
    found = np.zeros((len(free), matrix.width))
    for k, j in enumerate(free):
        found[k, j] = 1.0
        found[k, list(pivots)] = [-_float(entries[i][j], numbers) for i in range(len(pivots))]
    return found


def _float(element: Any, numbers: Any) -> float:
    if not numbers.is_Algebraic:
        return float(_coefficients(element, numbers)[0])
    import mpmath

    with mpmath.workdps(_DIGITS):
        generator = mpmath.mpf(str(sympy.N(numbers.ext.as_expr(), _DIGITS)))
        total = mpmath.mpf(0)
        for c in reversed(_coefficients(element, numbers)):
            total = total * generator + mpmath.mpf(c.numerator) / c.denominator
        return float(total)
