"""Proofs that a polynomial has no zero on the feasible set, and short forms modulo the loop equations.

Source: Zlatanov, Fenton, Benhabib (1998), section 4.2: a passive velocity may be eliminated only where it is
uniquely determined at every feasible configuration.  The proofs are elementary; none found means unknown.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from functools import reduce as fold
from math import inf

from singsym.kinematics.placement import ConfigurationSpace
from singsym.polynomials import Polynomial
from singsym.polynomials.ranges import EVERYTHING, Interval, fraction, meet, polynomial_range, root_above

LONGEST = 400
"""Polynomials with more terms are not treated modulo the equations."""

LONGEST_SUM = 40
"""The sign of longer sums is not looked for."""

Divisors = tuple[tuple[Polynomial, str], ...]
"""Polynomials, each with the variable in which it is divided by it."""


def remainder(polynomial: Polynomial, divisor: Polynomial, name: str) -> Polynomial:
    """The remainder as polynomials in one variable, where the divisor's leading coefficient is rational.

    >>> from singsym.polynomials import Ring
    >>> c, s = Ring(("c", "s")).gens
    >>> remainder(s**3, c**2 + s**2 - 1, "s")
    -c^2*s + s
    """
    ring = polynomial.ring
    if polynomial.degree(name) < divisor.degree(name):
        return polynomial
    # in the order of this ring a power of the variable leads, so that FLINT divides by it
    leading = ring.with_names((name, *(n for n in ring.names if n != name)), "lex")
    divided = divmod(leading.convert(polynomial).value, leading.convert(divisor).value)[1]
    return ring.convert(Polynomial(leading, divided))


@lru_cache(maxsize=2**15)
def divided(polynomial: Polynomial, divisors: Divisors) -> Polynomial:
    """The remainder on division by one after another; many spaces have the same circles."""
    for divisor, name in divisors:
        polynomial = remainder(polynomial, divisor, name)
    return polynomial


def short_text(polynomial: Polynomial, longest: int = 8) -> str:
    """The polynomial as text, cut after some terms with the number of those left out."""
    if len(polynomial) <= longest:
        return str(polynomial)
    first = polynomial.ring.from_dict(dict(polynomial.terms()[:longest]))
    return f"{first} + ... ({len(polynomial) - longest} more terms)"


@dataclass(frozen=True, eq=False)
class Certifier:
    """What the equations, exclusions and inequalities of a configuration space prove about polynomials.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("c", "s"))
    >>> c, s = R.gens
    >>> certifier = Certifier(ConfigurationSpace(R, (c**2 + s**2 - 1,)))
    >>> certifier.reason(c**2 + s**2)
    'equal to 1 on the configuration space'
    >>> certifier.reason(5 + 4 * c)
    'between 1 and 9 on the configuration space'
    >>> certifier.reason(c) is None
    True
    """

    space: ConfigurationSpace

    @cached_property
    def _known(self) -> dict[Polynomial, str | None]:
        return {}

    @cached_property
    def _squares(self) -> tuple[tuple[Polynomial, tuple[str, ...]], ...]:
        """Equations a v^2 + b w^2 + ... = positive constant, with their variables; minimal polynomials."""
        ring = self.space.ring
        found: list[tuple[Polynomial, tuple[str, ...]]] = []
        for constant, relation in zip(ring.constants, ring.relations, strict=True):
            found.append((relation, (constant.name,)))
        fixed = {c.name for c in self.space.ring.constants}
        for equation in self.space.equations:
            names = equation.variables
            pure = all(sum(m) in (0, 2) and max(m) in (0, 2) for m, _ in equation.terms())
            if pure and len(equation) == len(names) + 1 and equation.constant and not fixed & {*names}:
                sign = -1 if equation.constant > 0 else 1
                if all(sign * c > 0 for m, c in equation.terms() if any(m)):
                    found.append((equation * sign, names))
        return tuple(found)

    # -- short forms ---------------------------------------------------------------------------------

    def forms(self, polynomial: Polynomial) -> tuple[Polynomial, ...]:
        """Other polynomials with the same values on the configuration space; the first is a normal form
        modulo the sums of squares, in which equal polynomials on circles and spheres are identical."""
        if len(polynomial) > LONGEST:
            return ()
        return tuple(dict.fromkeys(divided(polynomial, divisors) for divisors in self._divisors))

    def normal_form(self, polynomial: Polynomial) -> Polynomial:
        """The normal form modulo the equations that are sums of squares of variables."""
        return divided(polynomial, self._divisors[0])

    @cached_property
    def _divisors(self) -> tuple[Divisors, Divisors]:
        """For each choice of the variable to remove."""
        last, first = (tuple((e, names[place]) for e, names in self._squares) for place in (-1, 0))
        return last, first

    def shorten(self, polynomial: Polynomial) -> Polynomial:
        """A polynomial with the same values on the configuration space, with fewer terms where one is found.

        Takes away rational multiples of equations as long as it helps; a multiple of an equation is 0.
        """
        if polynomial.total_degree < 2 or len(polynomial) > LONGEST:
            return polynomial
        if polynomial not in self._short:
            best = min((polynomial, *self.forms(polynomial)), key=len)
            while (shorter := self._shorter(best)) is not None:
                best = shorter
            self._short[polynomial] = polynomial.ring.zero if self._is_multiple(best) else best
        return self._short[polynomial]

    @cached_property
    def _short(self) -> dict[Polynomial, Polynomial]:
        return {}

    def _is_multiple(self, polynomial: Polynomial) -> bool:
        names = set(polynomial.variables)
        possible = (e for e in self.space.equations if e and names.issuperset(e.variables))
        return any(e.divides(polynomial) for e in possible)

    def _shorter(self, polynomial: Polynomial) -> Polynomial | None:
        terms = dict(polynomial.terms())
        for equation in self.space.equations:
            for monomial, c in equation.terms():
                if any(monomial) and (own := terms.get(monomial)) is not None:
                    candidate = polynomial - equation * (own / c)
                    if len(candidate) < len(polynomial):
                        return candidate
        return None

    # -- proofs --------------------------------------------------------------------------------------

    def reason(self, polynomial: Polynomial) -> str | None:
        """Why the polynomial has no zero on the feasible set, in words; None where no proof was found."""
        if polynomial.is_constant:
            return f"the constant {polynomial}" if polynomial else None
        if polynomial not in self._known:
            self._known[polynomial] = self._prove(polynomial)
        return self._known[polynomial]

    def _prove(self, polynomial: Polynomial) -> str | None:
        if (found := self._prove_irreducible(polynomial)) is not None:
            return found
        if len(polynomial) > LONGEST:
            return None
        for form in dict.fromkeys((polynomial, self.shorten(polynomial), *self.forms(polynomial))):
            factors = form.factors()
            if len(factors) > 1 or (factors and factors[0][1] > 1):
                reasons = [self._prove_irreducible(f) for f, _ in factors]
                if None not in reasons:
                    parts = [
                        f"{short_text(f)} is {why}" for (f, _), why in zip(factors, reasons, strict=True)
                    ]
                    return "a product: " + "; ".join(parts)
        return self._prove_square(polynomial)

    def _prove_square(self, polynomial: Polynomial) -> str | None:
        """By factors of the square, as in s^2 = (1 - c)(1 + c)."""
        for form in self.forms(polynomial * polynomial) if len(polynomial) <= 10 else ():
            factors = [f for f, _ in form.factors()]
            if len(factors) > 1 and all(self._prove_irreducible(f) for f in factors):
                parts = [f"{short_text(f)}, {self._prove_irreducible(f)}" for f in factors]
                return "a divisor, in the square, of nonzero factors: " + "; ".join(parts)
        return None

    def _prove_irreducible(self, polynomial: Polynomial) -> str | None:
        forms = dict.fromkeys((polynomial, self.shorten(polynomial), *self.forms(polynomial)))
        for form in forms:
            if form.is_constant and form:
                return f"equal to {form} on the configuration space"
        for form in forms:
            if (found := self._divisors_of_nonzero.get(form.primitive())) is not None:
                return found
        for form in forms:
            if len(form) <= LONGEST_SUM and (found := self._sign(form)) is not None:
                return found
        return None

    def _sign(self, polynomial: Polynomial) -> str | None:
        if self._is_positive_sum(polynomial) or self._is_positive_sum(-polynomial):
            return f"{short_text(polynomial)}, whose terms have one sign and do not all vanish"
        if not self._straddles_zero(polynomial):
            low, high = polynomial_range(polynomial, self._bounds)
            if low > 0 or high < 0:
                return f"between {low} and {high} on the configuration space"
        if is_definite(polynomial) or is_definite(-polynomial):
            return f"{short_text(polynomial)}, a sum of squares and a constant"
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
        low = [self._bounds[name][0] for name in self.space.ring.names]
        strict = {p.variables[0] for p in self.space.positive if len(p) == 1 and p.total_degree == 1}
        strict |= {
            p.variables[0]
            for p in self.space.positive
            if len(p.variables) == 1 and p.total_degree == 1 and p.terms()[0][1] > 0 and p.constant <= 0
        }
        return tuple(
            2 if name in strict or bound > 0 else int(bound >= 0)
            for name, bound in zip(self.space.ring.names, low, strict=True)
        )

    @cached_property
    def _bounds(self) -> Mapping[str, Interval]:
        """An interval for each variable: from sums of squares, from limits, from constants."""
        bounds: dict[str, Interval] = dict.fromkeys(self.space.ring.names, EVERYTHING)
        for equation, names in self._squares[len(self.space.ring.constants) :]:
            for name in names:
                square = -fraction(equation.constant) / fraction(equation.coefficient(name, 2).constant)
                root = root_above(square)
                bounds[name] = meet(bounds[name], (-root, root))
        for constant in self.space.ring.constants:
            bounds[constant.name] = (constant.low, constant.high)
        for bound in (*self.space.positive, *self.space.nonnegative):
            names = tuple(set(bound.variables) - {c.name for c in self.space.ring.constants})
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
        low = high = 0.0
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
        return low < -1e-6 and high > 1e-6

    @cached_property
    def _divisors_of_nonzero(self) -> dict[Polynomial, str]:
        """Irreducible polynomials that have no zero where conditions and exclusions hold, and why.

        A real zero of one is a common zero of an exclusion's polynomials where it divides all of them, or a
        sum of their squares that is short enough to be factored, or is such a sum.
        """
        found: dict[Polynomial, str] = {}
        for exclusion in reversed(self.space.exclusions):
            words = "nonzero outside the excluded " + ", ".join(f"{short_text(g, 4)} = 0" for g in exclusion)
            if sum(map(len, exclusion)) <= LONGEST_SUM:
                total = sum((g * g for g in exclusion), start=self.space.ring.zero)
                for form in (total, self.shorten(total), *self.forms(total)):
                    if form:
                        found[form.primitive()] = words
                    if len(form) <= LONGEST_SUM:
                        found |= {f: words for f, _ in form.factors()}
            common = fold(Polynomial.gcd, exclusion, self.space.ring.zero)
            if len(common) <= LONGEST:
                found |= {f: words for f, _ in common.factors()}
        for positive in reversed(self.space.positive):
            words = f"a divisor of {short_text(positive)} > 0"
            found |= dict.fromkeys((positive.primitive(), *(f for f, _ in positive.factors())), words)
        return found


def is_definite(polynomial: Polynomial) -> bool:
    """Whether a polynomial of degree 2 is a sum of squares plus a positive constant, by exact elimination.

    >>> from singsym.polynomials import Ring
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
