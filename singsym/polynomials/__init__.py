"""The ring of a problem, its polynomials and matrices: SymPy at the surface, FLINT below."""

from singsym.polynomials.matrix import PolynomialMatrix
from singsym.polynomials.polynomial import Polynomial, Rational, as_fmpq
from singsym.polynomials.ring import AlgebraicConstant, Ring

__all__ = ["AlgebraicConstant", "Polynomial", "PolynomialMatrix", "Rational", "Ring", "as_fmpq"]
