"""The ring of a problem, its polynomials and matrices: SymPy at the surface, FLINT below."""

from singsym.polynomials.matrix import PolynomialMatrix
from singsym.polynomials.polynomial import Equations, Exponents, Polynomial, Rational, as_fmpq
from singsym.polynomials.ring import AlgebraicConstant, Ring

__all__ = [
    "AlgebraicConstant",
    "Equations",
    "Exponents",
    "Polynomial",
    "PolynomialMatrix",
    "Rational",
    "Ring",
    "as_fmpq",
]
