"""A configuration over a number field: its coordinates, and the kernels of L and its submatrices there.

Source: number fields by a primitive element, in SymPy (https://docs.sympy.org, sympy.polys.matrices).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy

from singsym.classes.configuration.given_values import Target
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import PolynomialMatrix

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


def exact_kernels(equation: VelocityEquation, values: Mapping[str, sympy.Expr]) -> dict[str, Floats] | None:
    """Bases of the kernels of L, L_I, L_O and L_p, one vector a row, worked out over the field of the values.

    The vectors' entries are floats; their number is exact.  None where the loops do not close exactly.
    """
    from sympy.polys.constructor import construct_domain

    given = [values[name] for name in equation.space.ring.names]
    if not given or not all(v.is_algebraic for v in given):
        return None
    domain, elements = construct_domain(given, extension=True)
    if not (domain.is_ZZ or domain.is_QQ or domain.is_Algebraic):
        return None
    numbers = domain.get_field()
    point = [numbers.convert_from(e, domain) for e in elements]
    if any(e.evaluate(point) for e in equation.space.equations):
        return None
    matrices = {"L": equation.L, "L_I": equation.L_I, "L_O": equation.L_O, "L_p": equation.L_p}
    return {name: _kernel(matrix, point, numbers) for name, matrix in matrices.items()}


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
        return float(Fraction(int(element.numerator), int(element.denominator)))
    import mpmath

    with mpmath.workdps(_DIGITS):
        generator = mpmath.mpf(str(sympy.N(numbers.ext.as_expr(), _DIGITS)))
        total = mpmath.mpf(0)
        for c in element.to_list():
            total = total * generator + mpmath.mpf(int(c.numerator)) / int(c.denominator)
        return float(total)
