"""A polynomial over Q in the named variables of a ring, on FLINT's `fmpq_mpoly`.

Source: FLINT (https://flintlib.org), through python-flint.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from math import factorial
from typing import TYPE_CHECKING, Any, Union

from flint import fmpq, fmpq_mpoly, fmpz, fmpz_mpoly

if TYPE_CHECKING:
    import sympy

    from singsym.polynomials.ring import Ring

Rational = int | Fraction | fmpz | fmpq
Operand = Union["Polynomial", int, Fraction, fmpz, fmpq]
Exponents = tuple[int, ...]
"""Of a monomial, one for each variable of the ring."""


def as_fmpq(number: Rational) -> fmpq:
    """The FLINT rational equal to an `int`, `Fraction`, `fmpz` or `fmpq`.

    >>> as_fmpq(Fraction(1, 2))
    1/2
    """
    if isinstance(number, fmpq):
        return number
    if isinstance(number, Fraction):
        return fmpq(number.numerator, number.denominator)
    return fmpq(number)


class Polynomial:
    """An immutable element of a `Ring`: hashable, picklable, compared by value.

    Arithmetic accepts ints, Fractions and FLINT rationals beside polynomials of the same ring.
    A polynomial of another ring raises `ValueError`; convert it with `ring.convert` first.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> (x + y) * (x - y)
    x^2 - y^2
    >>> (x**2 - y**2).factors()
    [(x + y, 1), (x - y, 1)]
    """

    __slots__ = ("_degrees", "_hash", "_integer", "_terms", "_text", "ring", "value")

    ring: Ring
    value: fmpq_mpoly
    # made when they are asked for
    _degrees: tuple[int, ...]
    _hash: int
    _integer: fmpz_mpoly
    _terms: tuple[tuple[int, int, tuple[int, ...]], ...]
    _text: str

    def __init__(self, ring: Ring, value: fmpq_mpoly) -> None:
        object.__setattr__(self, "ring", ring)
        object.__setattr__(self, "value", value)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a Polynomial is immutable: {name} cannot be set")

    def __reduce__(self) -> tuple[Any, ...]:
        terms = tuple((m, int(c.p), int(c.q)) for m, c in self.terms())
        return _rebuild, (self.ring, terms)

    # -- arithmetic ------------------------------------------------------------------------------

    def _operand(self, other: Operand) -> fmpq_mpoly | fmpq:
        if isinstance(other, Polynomial):
            if other.ring is not self.ring and other.ring != self.ring:
                raise ValueError(
                    f"polynomials of different rings, {self.ring!r} and {other.ring!r}: "
                    "convert one with ring.convert"
                )
            return other.value
        return as_fmpq(other)

    def __add__(self, other: Operand) -> Polynomial:
        return Polynomial(self.ring, self.value + self._operand(other))

    __radd__ = __add__

    def __sub__(self, other: Operand) -> Polynomial:
        return Polynomial(self.ring, self.value - self._operand(other))

    def __rsub__(self, other: Operand) -> Polynomial:
        return Polynomial(self.ring, self._operand(other) - self.value)

    def __mul__(self, other: Operand) -> Polynomial:
        return Polynomial(self.ring, self.value * self._operand(other))

    __rmul__ = __mul__

    def __truediv__(self, number: Rational) -> Polynomial:
        return Polynomial(self.ring, self.value * (1 / as_fmpq(number)))

    def __neg__(self) -> Polynomial:
        return Polynomial(self.ring, -self.value)

    def __pow__(self, exponent: int) -> Polynomial:
        return Polynomial(self.ring, self.value**exponent)

    def exact_quotient(self, divisor: Polynomial) -> Polynomial:
        """`self / divisor`; raises `ArithmeticError` where the division leaves a remainder."""
        quotient, remainder = divmod(self.value, self._operand(divisor))
        if remainder:
            raise ArithmeticError(f"{divisor} does not divide {self}")
        return Polynomial(self.ring, quotient)

    def divides(self, other: Polynomial) -> bool:
        """Whether `other` is a multiple of this polynomial."""
        own, others = self.value.degrees(), other.value.degrees()
        if other and any(a > b for a, b in zip(own, others, strict=True)):
            return False
        return not divmod(other.value, self.value)[1]

    def gcd(self, other: Polynomial) -> Polynomial:
        """The monic greatest common divisor."""
        return Polynomial(self.ring, self.value.gcd(other.value))

    # -- comparison ------------------------------------------------------------------------------

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Polynomial):
            same = self.ring is other.ring or self.ring == other.ring
            return same and bool(self.value == other.value)
        if isinstance(other, (int, Fraction, fmpz, fmpq)):
            return bool(self.value == as_fmpq(other))
        return NotImplemented

    def __hash__(self) -> int:
        try:
            return self._hash
        except AttributeError:
            # of three terms, since all would take longer than most that is done with a long polynomial
            terms = len(self.value)
            places = (0, terms // 2, terms - 1) if terms else ()
            known = tuple((self.value.monomial(k), self.value.coefficient(k)) for k in places)
            object.__setattr__(self, "_hash", hash((self.ring.names, terms, known)))
            return self._hash

    # -- inspection ------------------------------------------------------------------------------

    def terms(self) -> list[tuple[tuple[int, ...], fmpq]]:
        """Pairs (exponents, coefficient), leading term first."""
        return list(self.value.terms())

    @property
    def leading_term(self) -> tuple[tuple[int, ...], fmpq]:
        """The first of `terms`; IndexError for zero."""
        return self.value.monomial(0), self.value.coefficient(0)

    def __len__(self) -> int:
        return len(self.value)

    @property
    def is_zero(self) -> bool:
        """Whether it is the zero polynomial."""
        return bool(self.value.is_zero())

    @property
    def is_constant(self) -> bool:
        """Whether no variable is in it."""
        return bool(self.value.is_constant())

    @property
    def constant(self) -> fmpq:
        """The constant term."""
        return self.value[(0,) * len(self.ring.names)]

    @property
    def total_degree(self) -> int:
        """Total degree; -1 for the zero polynomial."""
        return int(self.value.total_degree())

    @property
    def degrees(self) -> tuple[int, ...]:
        """The degree in each variable of the ring (-1 throughout for zero)."""
        try:
            return self._degrees
        except AttributeError:
            object.__setattr__(self, "_degrees", tuple(map(int, self.value.degrees())))
            return self._degrees

    @property
    def variables(self) -> tuple[str, ...]:
        """The names that occur, in the order of the ring."""
        return tuple(name for name, d in zip(self.ring.names, self.degrees, strict=True) if d > 0)

    def degree(self, name: str) -> int:
        """The degree in one variable."""
        return self.degrees[self.ring.index(name)]

    def coefficient(self, name: str, power: int) -> Polynomial:
        """The coefficient of `name**power`, a polynomial in the other variables.

        >>> from singsym.polynomials import Ring
        >>> x, y = Ring(("x", "y")).gens
        >>> (x * y + 3 * x + y**2).coefficient("x", 1)
        y + 3
        """
        i, value = self.ring.index(name), self.value
        for _ in range(power):
            value = value.derivative(i)
        return Polynomial(self.ring, value.subs({name: 0}) / factorial(power))

    # -- operations ------------------------------------------------------------------------------

    def derivative(self, name: str) -> Polynomial:
        """The partial derivative by one variable."""
        return Polynomial(self.ring, self.value.derivative(self.ring.index(name)))

    def factors(self) -> list[tuple[Polynomial, int]]:
        """Primitive irreducible factors over Q with multiplicities, constants dropped, sorted."""
        return list(_factors(self))

    def squarefree_part(self) -> Polynomial:
        """The product of the distinct irreducible factors, primitive."""
        product = self.ring.one
        for factor, _ in self.value.factor_squarefree()[1]:
            product = product * Polynomial(self.ring, factor)
        return product.primitive()

    def primitive(self) -> Polynomial:
        """The multiple with coprime integer coefficients and a positive leading one."""
        coefficients = self.value.coeffs()
        numerator, denominator = fmpz(0), fmpz(1)
        for c in coefficients:
            numerator, denominator = numerator.gcd(c.p), denominator.lcm(c.q)
        if not coefficients or (coefficients[0] > 0 and numerator == denominator == 1):
            return self
        scale = fmpq(denominator, numerator)
        return Polynomial(self.ring, self.value * (scale if coefficients[0] > 0 else -scale))

    def integer(self) -> fmpz_mpoly:
        """The primitive integer multiple as FLINT's `fmpz_mpoly`, for engines."""
        try:
            return self._integer
        except AttributeError:
            value = self.primitive().value
            terms = zip(value.monoms(), (c.p for c in value.coeffs()), strict=True)
            object.__setattr__(self, "_integer", self.ring.integer_context.from_dict(dict(terms)))
            return self._integer

    def reflect(self, names: Collection[str]) -> Polynomial:
        """The polynomial with the signs of these variables changed.

        >>> from singsym.polynomials import Ring
        >>> x, y = Ring(("x", "y")).gens
        >>> (x + x * y).reflect(["x", "y"])
        x*y - x
        """
        places = [self.ring.index(name) for name in names]
        terms = {m: -c if sum(m[i] for i in places) % 2 else c for m, c in self.terms()}
        return self.ring.from_dict(terms)

    def rename(self, names: Mapping[str, str]) -> Polynomial:
        """The polynomial with other variables of the ring in place of these; no two become one.

        >>> from singsym.polynomials import Ring
        >>> x, y = Ring(("x", "y")).gens
        >>> (x**2 - y).rename({"x": "y", "y": "x"})
        y^2 - x
        """
        moved = [(i, self.ring.index(names[n])) for i, n in enumerate(self.ring.names) if n in names]
        terms = {}
        for m, c in self.terms():
            exponents = [0 if n in names else e for n, e in zip(self.ring.names, m, strict=True)]
            for i, k in moved:
                exponents[k] += m[i]
            terms[tuple(exponents)] = c
        return self.ring.from_dict(terms)

    def substitute(self, values: Mapping[str, Operand]) -> Polynomial:
        """Replace variables by polynomials or rationals of the same ring, all at once.

        >>> from singsym.polynomials import Ring
        >>> x, y = Ring(("x", "y")).gens
        >>> (x**2 + y).substitute({"x": y, "y": 1})
        y^2 + 1
        """
        if not values:
            return self
        images = list(self.ring.context.gens())
        for name, value in values.items():
            image = self._operand(value)
            images[self.ring.index(name)] = (
                image if isinstance(image, fmpq_mpoly) else self.ring.context.constant(image)
            )
        return Polynomial(self.ring, self.value.compose(*images, ctx=self.ring.context))

    def evaluate(self, values: Sequence[Any]) -> Any:
        """The value at a point given in the order of the ring's names.

        Works in any commutative arithmetic that mixes with ints: `float`, `complex`, `Fraction`,
        `fmpq`, `arb`, `acb`, `mpmath` and NumPy arrays.  Coefficients enter as p/q.
        """
        total: Any = None
        for p, q, places in self._table:
            term: Any = values[places[0]] if places else values[0] * 0 + p if values else p
            for i in places[1:]:
                term = term * values[i]
            if places and p != 1:
                term = term * p
            if q != 1:
                term = term / q
            total = term if total is None else total + term
        return 0 if total is None else total

    @property
    def _table(self) -> tuple[tuple[int, int, tuple[int, ...]], ...]:
        """Of each term numerator, denominator and the places of its variables, as often as they are there."""
        try:
            return self._terms
        except AttributeError:
            terms = ((c, tuple(i for i, e in enumerate(m) for _ in range(e))) for m, c in self.terms())
            table = tuple((int(c.p), int(c.q), places) for c, places in terms)
            object.__setattr__(self, "_terms", table)
            return self._terms

    def to_sympy(self) -> sympy.Expr:
        """The same polynomial as an expanded SymPy expression, with the ring's constants put in.

        >>> from singsym.polynomials import Ring
        >>> x, y = Ring(("x", "y")).gens
        >>> ((x + y) ** 2).to_sympy()
        x**2 + 2*x*y + y**2
        """
        import sympy

        terms = []
        for exponents, c in self.terms():
            powers = [s**e for s, e in zip(self.ring.symbols, exponents, strict=True) if e]
            terms.append(sympy.Mul(sympy.Rational(int(c.p), int(c.q)), *powers))
        return sympy.Add(*terms)

    # -- display ---------------------------------------------------------------------------------

    def __repr__(self) -> str:
        if not hasattr(self, "_text"):
            object.__setattr__(self, "_text", str(self.value))
        return self._text

    def short_text(self, longest: int | None = 8) -> str:
        """The polynomial as a person writes it, cut after `longest` terms, with the number of those left out.

        Constants are written as what they are, in degrees below those of their minimal polynomials.

        >>> from singsym.polynomials import Ring
        >>> x, y = Ring(("x", "y")).gens
        >>> ((x + y) ** 3).short_text(2)
        'x^3 + 3*x^2*y + ... (2 more terms)'
        """
        ring, value = self.ring, self.ring.reduced(self)
        left_out = 0 if longest is None else max(0, len(value) - longest)
        if left_out:
            value = ring.from_dict(dict(value.terms()[:longest]))
        shown = str(value)
        for constant in ring.constants:
            if constant.text:
                single = re.fullmatch(r"\w+(\([^()]*\))?", constant.text)
                root = constant.text if single else f"({constant.text})"
                shown = re.sub(rf"\b{re.escape(constant.name)}\b", root.replace("**", "^"), shown)
        return f"{shown} + ... ({left_out} more terms)" if left_out else shown

    def __bool__(self) -> bool:
        return not self.is_zero


@lru_cache(maxsize=2**15)
def _factors(polynomial: Polynomial) -> tuple[tuple[Polynomial, int], ...]:
    """See `Polynomial.factors`; kept, because equal polynomials are made again and again."""
    irreducible, rest = None, polynomial
    if len(polynomial) >= MANY_TERMS and 1 in polynomial.degrees:
        irreducible, rest = first_degree_parts(polynomial, polynomial.degrees.index(1))
    found = [(Polynomial(polynomial.ring, factor).primitive(), k) for factor, k in rest.value.factor()[1]]
    if irreducible is not None:
        found.append((irreducible, 1))
    return tuple(sorted(found, key=lambda pair: (len(pair[0]), pair[0].total_degree, str(pair[0]))))


MANY_TERMS = 100
"""Polynomials with fewer terms are factored as they are."""


def first_degree_parts(polynomial: Polynomial, place: int) -> tuple[Polynomial, Polynomial]:
    """The irreducible factor that holds a variable of first degree, primitive, and what is left without it.

    Lemma (Gauss): a x + b with coprime a, b is irreducible.  Their common divisor is soon found, where to
    factor the whole may take seconds.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> first_degree_parts((x * y - z**2) * (y**2 - 1), 0)
    (x*y - z^2, y^2 - 1)
    """
    ring, lead = polynomial.ring, polynomial.value.derivative(place)
    tail = polynomial.value - lead * ring.gens[place].value
    common = Polynomial(ring, lead.gcd(tail))
    return polynomial.exact_quotient(common).primitive(), common


def _rebuild(ring: Ring, terms: tuple[tuple[tuple[int, ...], int, int], ...]) -> Polynomial:
    return ring.from_dict({m: fmpq(p, q) for m, p, q in terms})


Equations = tuple[Polynomial, ...]
"""Polynomials that vanish together."""
