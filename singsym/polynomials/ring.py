"""The ring of a problem: named variables over Q, with the real algebraic constants among them.

Source: the border between SymPy and FLINT; FLINT (https://flintlib.org), SymPy (https://sympy.org).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

import sympy
from flint import Ordering, fmpq, fmpq_mpoly_ctx, fmpz_mpoly_ctx

from singsym.polynomials.polynomial import Polynomial, Rational, as_fmpq

_ORDERINGS = {"degrevlex": Ordering.degrevlex, "lex": Ordering.lex, "deglex": Ordering.deglex}


@dataclass(frozen=True)
class AlgebraicConstant:
    """A real root of an irreducible polynomial over Q, told apart from its conjugates by an interval.

    name: the variable that stands for it in a ring.
    minimal: coefficients of its minimal polynomial, constant term first.
    low, high: rationals between which it is the only real root.
    latex: how it is printed; text: its SymPy expression as a string, for display.

    >>> AlgebraicConstant("sqrt3", (-3, 0, 1), Fraction(1), Fraction(2), r"\\sqrt{3}", "sqrt(3)")
    sqrt3
    """

    name: str
    minimal: tuple[int, ...]
    low: Fraction
    high: Fraction
    latex: str = field(default="", compare=False)
    text: str = field(default="", compare=False)

    def __repr__(self) -> str:
        return self.name

    @property
    def expression(self) -> sympy.Expr:
        """The constant as a SymPy number."""
        return _root(self.minimal, self.low, self.high)


@lru_cache(maxsize=1000)
def _root(minimal: tuple[int, ...], low: Fraction, high: Fraction) -> sympy.Expr:
    x = sympy.Symbol("x")
    polynomial = sympy.Poly(list(reversed(minimal)), x)
    for index, root in enumerate(polynomial.real_roots()):
        if sympy.Rational(low) <= root <= sympy.Rational(high):
            return sympy.rootof(polynomial, index) if polynomial.degree() > 2 else root
    raise ValueError(f"no real root of {polynomial} between {low} and {high}")


@dataclass(frozen=True)
class Ring:
    """Q[names], with a monomial order; `constants` are those names that stand for fixed real numbers.

    Two rings are equal when names, order and constants are.

    >>> R = Ring(("x", "y"))
    >>> R.from_sympy(sympy.Symbol("x") ** 2 / 2 + 1)
    1/2*x^2 + 1
    """

    names: tuple[str, ...]
    order: str = "degrevlex"
    constants: tuple[AlgebraicConstant, ...] = ()

    def __repr__(self) -> str:
        return f"Q[{', '.join(self.names)}]"

    def __reduce__(self) -> tuple[Any, ...]:
        texts = tuple((c.latex, c.text) for c in self.constants)
        return _unpickled, (self.names, self.order, self.constants, texts)

    # -- FLINT's contexts ------------------------------------------------------------------------

    @cached_property
    def context(self) -> fmpq_mpoly_ctx:
        """FLINT's context for rational coefficients."""
        return fmpq_mpoly_ctx.get(self.names, _ORDERINGS[self.order])

    @cached_property
    def integer_context(self) -> fmpz_mpoly_ctx:
        """FLINT's context for integer coefficients."""
        return fmpz_mpoly_ctx.get(self.names, _ORDERINGS[self.order])

    @cached_property
    def _indices(self) -> dict[str, int]:
        return {name: i for i, name in enumerate(self.names)}

    def index(self, name: str) -> int:
        """The position of a variable; raises `KeyError` naming the ring's variables."""
        try:
            return self._indices[name]
        except KeyError:
            raise KeyError(f"{name!r} is not a variable of {self!r}") from None

    # -- elements --------------------------------------------------------------------------------

    @cached_property
    def gens(self) -> tuple[Polynomial, ...]:
        """The variables as polynomials, in order."""
        return tuple(Polynomial(self, g) for g in self.context.gens())

    def gen(self, name: str) -> Polynomial:
        """One variable as a polynomial."""
        return self.gens[self.index(name)]

    @cached_property
    def zero(self) -> Polynomial:
        """The zero polynomial."""
        return self.constant(0)

    @cached_property
    def one(self) -> Polynomial:
        """The constant polynomial 1."""
        return self.constant(1)

    def constant(self, number: Rational) -> Polynomial:
        """A rational as a constant polynomial."""
        return Polynomial(self, self.context.constant(as_fmpq(number)))

    def from_dict(self, terms: Mapping[tuple[int, ...], Rational]) -> Polynomial:
        """The polynomial with these coefficients by exponents."""
        return Polynomial(self, self.context.from_dict({m: as_fmpq(c) for m, c in terms.items()}))

    # -- SymPy -----------------------------------------------------------------------------------

    def from_sympy(self, expression: Any) -> Polynomial:
        """A SymPy expression or number, polynomial in the ring's names and constants.

        Raises `ValueError` for anything else, naming the offending part; text is not parsed.
        """
        if isinstance(expression, str):
            raise ValueError(f"a SymPy expression is expected, not the text {expression!r}")
        expression = sympy.sympify(expression, strict=True)
        replacements = {c.expression: sympy.Symbol(c.name) for c in self.constants}
        if replacements:
            expression = expression.xreplace(replacements)
        symbols = [sympy.Symbol(name) for name in self.names]
        by_name = {s: sympy.Symbol(s.name) for s in expression.free_symbols}
        expression = expression.xreplace(by_name)
        unknown = expression.free_symbols - set(symbols)
        if unknown:
            raise ValueError(f"{sorted(map(str, unknown))} not among the variables of {self!r}")
        try:
            polynomial = sympy.Poly(expression, *symbols, domain="QQ")
        except (sympy.PolynomialError, sympy.CoercionFailed) as error:
            raise ValueError(f"{expression} is not a polynomial over Q in {self!r}: {error}") from None
        return self.from_dict({m: fmpq(int(c.p), int(c.q)) for m, c in polynomial.terms() if c})

    @cached_property
    def symbols(self) -> tuple[sympy.Expr, ...]:
        """A SymPy symbol for each name, and the number itself for a constant."""
        known = {c.name: c.expression for c in self.constants}
        return tuple(known.get(name, sympy.Symbol(name)) for name in self.names)

    # -- other rings -----------------------------------------------------------------------------

    def with_names(self, names: Iterable[str], order: str | None = None) -> Ring:
        """A ring in these names; constants of this ring among them stay constants."""
        kept = tuple(names)
        constants = tuple(c for c in self.constants if c.name in kept)
        return Ring(kept, order or self.order, constants)

    def subring(self, names: Collection[str]) -> Ring:
        """The ring in those of its names that are among these, in its order.

        >>> Ring(("x", "y", "z")).subring({"z", "x"}).names
        ('x', 'z')
        """
        return self.with_names(name for name in self.names if name in names)

    def convert(self, polynomial: Polynomial) -> Polynomial:
        """The polynomial as an element of this ring; raises `KeyError` where a variable is missing.

        >>> x, y = Ring(("x", "y")).gens
        >>> Ring(("y", "z")).convert(y + 1)
        y + 1
        """
        if polynomial.ring is self or polynomial.ring == self:
            return polynomial
        for name in polynomial.variables:
            self.index(name)
        return Polynomial(self, polynomial.value.project_to_context(self.context))

    @cached_property
    def relations(self) -> tuple[Polynomial, ...]:
        """The minimal polynomials of the ring's algebraic constants: zero wherever the ring is used."""
        return tuple(
            sum((self.gen(c.name) ** i * k for i, k in enumerate(c.minimal)), start=self.zero)
            for c in self.constants
        )

    def reduced(self, polynomial: Polynomial) -> Polynomial:
        """The same value, in each constant of a degree below that of its minimal polynomial.

        >>> root = AlgebraicConstant("r", (-3, 0, 1), Fraction(1), Fraction(2))
        >>> R = Ring(("x", "r"), constants=(root,))
        >>> x, r = R.gens
        >>> R.reduced((x + r) ** 2)
        x^2 + 2*x*r + 3
        """
        for constant, relation in zip(self.constants, self.relations, strict=True):
            if polynomial.degree(constant.name) >= len(constant.minimal) - 1:
                polynomial = Polynomial(self, divmod(polynomial.value, relation.value)[1])
        return polynomial


@lru_cache(maxsize=1000)
def _unpickled(
    names: tuple[str, ...],
    order: str,
    constants: tuple[AlgebraicConstant, ...],
    texts: tuple[tuple[str, str], ...],
) -> Ring:
    """One ring for all tasks of a process: polynomials of the same ring are compared faster.

    texts: how the constants are printed, which is no part of their equality.
    """
    return Ring(names, order, constants)
