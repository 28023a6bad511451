"""Proofs that a polynomial has one sign, by elementary inequalities.

Source: singsym's own: sums of terms of one sign, interval arithmetic, completed squares.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cached_property, lru_cache
from math import ceil, floor, inf, isfinite, log10

from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.ranges import EVERYTHING, Interval, fraction, meet, polynomial_range, root_above
from singsym.polynomials.short_forms import ShortForms, short_forms

# relative to the largest term
_ROUNDING = 1e-9

_LONGEST_DENOMINATOR = 1000
"""Bounds with larger ones are printed as decimals."""


@dataclass(frozen=True, eq=False)
class Signs:
    """What equations, p > 0 for each of `positive` and p >= 0 for each of `nonnegative` say of signs.

    >>> R = Ring(("c", "s", "a"))
    >>> c, s, a = R.gens
    >>> known = signs(R, (c**2 + s**2 - 1,), (a,), ())
    >>> known.reason(5 + 4 * c)
    'between 1 and 9 on the configuration space'
    >>> known.reason(a * c**2 + a)
    'c^2*a + a, whose terms have one sign and do not all vanish'
    >>> known.reason(c) is None
    True
    """

    forms: ShortForms
    positive: tuple[Polynomial, ...]
    nonnegative: tuple[Polynomial, ...]

    def reason(self, polynomial: Polynomial) -> str | None:
        """Why the polynomial has one sign and no zero, in words; None where no proof was found."""
        if polynomial not in self._known:
            self._known[polynomial] = self._prove(polynomial)
        return self._known[polynomial]

    @cached_property
    def _known(self) -> dict[Polynomial, str | None]:
        return {}

    def _prove(self, polynomial: Polynomial) -> str | None:
        if self._is_positive_sum(polynomial) or self._is_positive_sum(-polynomial):
            return f"{polynomial.short_text()}, whose terms have one sign and do not all vanish"
        if not self._straddles_zero(polynomial):
            low, high = polynomial_range(polynomial, self._bounds)
            if low > 0 or high < 0:
                return f"between {_shown(low, floor)} and {_shown(high, ceil)} on the configuration space"
        if is_definite(polynomial) or is_definite(-polynomial):
            return f"{polynomial.short_text()}, a sum of squares and a constant"
        return None

    def _is_positive_sum(self, polynomial: Polynomial) -> bool:
        """All terms nonnegative and one of them positive."""
        strict = False
        for exponents, c in polynomial.terms():
            known = [(self._signs[i], e % 2) for i, e in enumerate(exponents) if e]
            signs = [sign if odd else max(sign, 1) for sign, odd in known]
            if c < 0 or 0 in signs:
                return False
            strict = strict or all(s == 2 for s in signs)
        return strict

    @cached_property
    def _signs(self) -> tuple[int, ...]:
        """For each variable: 2 where known positive, 1 where known nonnegative, 0 otherwise."""
        low = [self._bounds[name][0] for name in self.forms.ring.names]
        strict = {p.variables[0] for p in self.positive if len(p) == 1 and p.total_degree == 1}
        strict |= {
            p.variables[0]
            for p in self.positive
            if len(p.variables) == 1 and p.total_degree == 1 and p.leading_term[1] > 0 and p.constant <= 0
        }
        return tuple(
            2 if name in strict or bound > 0 else int(bound >= 0)
            for name, bound in zip(self.forms.ring.names, low, strict=True)
        )

    @cached_property
    def _bounds(self) -> Mapping[str, Interval]:
        """An interval for each variable: from sums of squares, from limits, from constants."""
        bounds: dict[str, Interval] = dict.fromkeys(self.forms.ring.names, EVERYTHING)
        for equation, names in self.forms.squares[len(self.forms.ring.constants) :]:
            for name in names:
                square = -fraction(equation.constant) / fraction(equation.coefficient(name, 2).constant)
                root = root_above(square)
                bounds[name] = meet(bounds[name], (-root, root))
        for constant in self.forms.ring.constants:
            bounds[constant.name] = (constant.low, constant.high)
        for bound in (*self.positive, *self.nonnegative):
            names = tuple(set(bound.variables) - {c.name for c in self.forms.ring.constants})
            if len(names) != 1 or bound.degree(names[0]) != 1:
                continue
            slope = bound.coefficient(names[0], 1)
            if slope.is_constant:
                rest = bound - slope * bound.ring.gen(names[0])
                ends = [-x / fraction(slope.constant) for x in polynomial_range(rest, bounds)]
                limit = (min(ends), inf) if slope.constant > 0 else (-inf, max(ends))
                bounds[names[0]] = meet(bounds[names[0]], limit)
        return bounds

    @cached_property
    def _float_bounds(self) -> tuple[tuple[float, float], ...]:
        return tuple((float(low), float(high)) for low, high in self._bounds.values())

    def _straddles_zero(self, polynomial: Polynomial) -> bool:
        """A first look in floats, which spares exact bounds where they cannot have one sign."""
        low = high = largest = 0.0
        for exponents, c in polynomial.terms():
            ends = [int(c.p) / int(c.q)] * 2
            for (a, b), e in zip(self._float_bounds, exponents, strict=True):
                if e:
                    power = sorted((a ** int(e), b ** int(e)))
                    if e % 2 == 0 and a < 0 < b:
                        power[0] = 0.0
                    products = [x * y if x and y else 0.0 for x in ends for y in power]
                    ends = [min(products), max(products)]
            low, high = low + ends[0], high + ends[1]
            largest = max([largest, *(abs(x) for x in ends if isfinite(x))])
        return low < -_ROUNDING * largest and high > _ROUNDING * largest


def is_definite(polynomial: Polynomial) -> bool:
    """Whether a polynomial of degree 2 is a sum of squares plus a positive constant, by exact elimination.

    >>> x, y = Ring(("x", "y")).gens
    >>> is_definite(x**2 - 2 * x * y + y**2 + 1), is_definite(x**2 - 2 * x + 1)
    (True, False)
    """
    if polynomial.total_degree != 2:
        return False
    names = polynomial.variables
    places = {polynomial.ring.index(name): k for k, name in enumerate(names)}
    size = len(names) + 1
    form = [[Fraction(0)] * size for _ in range(size)]
    for exponents, c in polynomial.terms():
        where = [places[i] for i, e in enumerate(exponents) for _ in range(e)]
        i, j = (*where, size - 1, size - 1)[:2]
        form[i][j] += fraction(c) / 2
        form[j][i] += fraction(c) / 2
    for k in range(size - 1):
        pivot = form[k][k]
        if pivot < 0 or (pivot == 0 and any(form[k][k:])):
            return False
        for i in range(k + 1, size):
            if pivot:
                factor = form[i][k] / pivot
                form[i] = [a - factor * b for a, b in zip(form[i], form[k], strict=True)]
    return form[-1][-1] > 0


@lru_cache(maxsize=32)
def signs(
    ring: Ring,
    equations: tuple[Polynomial, ...],
    positive: tuple[Polynomial, ...],
    nonnegative: tuple[Polynomial, ...],
) -> Signs:
    """Those of a set, one object for equal sets, as it keeps what it found."""
    return Signs(short_forms(ring, equations), positive, nonnegative)


def _shown(bound: Fraction | float, rounded: Callable[[Fraction], int]) -> str:
    """A bound, where it is long as a decimal that is rounded outwards.

    >>> _shown(Fraction(2, 3), floor), _shown(Fraction(-12345678, 10**6 + 3), floor)
    ('2/3', '-12.346')
    """
    if isinstance(bound, float) or bound.denominator <= _LONGEST_DENOMINATOR:
        return str(bound)
    size = 10 ** max(3, 3 - floor(log10(abs(bound))))
    return str(Decimal(rounded(bound * size)) / size)
