"""Short forms of polynomials modulo equations: other polynomials with the same values where these hold.

Source: singsym's own; division by the equations of circles and spheres, and multiples of the others.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from flint import fmpq

from singsym.polynomials.polynomial import Polynomial
from singsym.polynomials.remainders import Division, division
from singsym.polynomials.ring import Ring

LONGEST = 400
"""Polynomials with more terms are not treated modulo the equations."""


@dataclass(frozen=True, eq=False)
class ShortForms:
    """What the equations of a set make of polynomials.

    >>> R = Ring(("c", "s"))
    >>> c, s = R.gens
    >>> ShortForms(R, (c**2 + s**2 - 1,)).shorten(2 * c**2 + 2 * s**2 + c)
    c + 2
    """

    ring: Ring
    equations: tuple[Polynomial, ...]

    @cached_property
    def squares(self) -> tuple[tuple[Polynomial, tuple[str, ...]], ...]:
        """Equations a v^2 + b w^2 + ... = positive constant, with their variables; minimal polynomials."""
        ring = self.ring
        found: list[tuple[Polynomial, tuple[str, ...]]] = []
        for constant, relation in zip(ring.constants, ring.relations, strict=True):
            found.append((relation, (constant.name,)))
        fixed = {constant.name for constant in ring.constants}
        for equation in self.equations:
            names = equation.variables
            pure = names and all(sum(m) in (0, 2) and max(m) in (0, 2) for m, _ in equation.terms())
            if pure and len(equation) == len(names) + 1 and equation.constant and not fixed & {*names}:
                sign = -1 if equation.constant > 0 else 1
                if all(sign * c > 0 for m, c in equation.terms() if any(m)):
                    found.append((equation * sign, names))
        return tuple(found)

    def forms(self, polynomial: Polynomial) -> tuple[Polynomial, ...]:
        """Other polynomials with the same values; the first is the normal form.

        It is one modulo the sums of squares: equal polynomials on circles and spheres have the same.
        """
        if len(polynomial) > LONGEST:
            return ()
        return tuple(dict.fromkeys(d.remainder(polynomial) for d in self._divisions))

    def normal_form(self, polynomial: Polynomial) -> Polynomial:
        """The normal form modulo the equations that are sums of squares of variables."""
        return self._divisions[0].remainder(polynomial)

    @cached_property
    def _divisions(self) -> tuple[Division, Division]:
        """For each choice of the variable to remove."""
        last, first = (tuple((e, names[place]) for e, names in self.squares) for place in (-1, 0))
        return division(last), division(first)

    def modulo_multiples(self, polynomial: Polynomial) -> Polynomial:
        """The remainder of the normal form modulo sums of rational multiples of the equations' normal forms.

        It has the same value in other terms; two polynomials whose difference is such a sum have the same.

        >>> R = Ring(("x", "y"))
        >>> x, y = R.gens
        >>> forms = ShortForms(R, (x**2 + y - 2, x**2 + x * y - 3))
        >>> forms.modulo_multiples(x * y - y)
        1
        """
        polynomial = self.normal_form(polynomial)
        for monomial, equation in self._echelon:
            if c := polynomial.value[monomial]:
                polynomial = polynomial - equation * c
        return polynomial

    @cached_property
    def _echelon(self) -> tuple[tuple[tuple[int, ...], Polynomial], ...]:
        """Sums of multiples of the normal forms, each with a monomial that is in none of the later."""
        found: list[tuple[tuple[int, ...], Polynomial]] = []
        for rest in map(self.normal_form, self.equations):
            for monomial, known in found:
                if c := rest.value[monomial]:
                    rest = rest - known * c
            if not rest.is_constant:
                monomial, c = rest.leading_term
                found.append((monomial, rest / c))
        return tuple(found)

    def shorten(self, polynomial: Polynomial) -> Polynomial:
        """A polynomial with the same values, with fewer terms where one is found.

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
        return any(names.issuperset(own) and e.divides(polynomial) for e, own in self._variables)

    @cached_property
    def _variables(self) -> tuple[tuple[Polynomial, tuple[str, ...]], ...]:
        return tuple((e, e.variables) for e in self.equations if e)

    def _shorter(self, polynomial: Polynomial) -> Polynomial | None:
        terms = dict(polynomial.terms())
        for equation, monomials in self._monomials:
            for monomial, c in monomials:
                if (own := terms.get(monomial)) is not None:
                    candidate = polynomial - equation * (own / c)
                    if len(candidate) < len(polynomial):
                        return candidate
        return None

    @cached_property
    def _monomials(self) -> tuple[tuple[Polynomial, tuple[tuple[tuple[int, ...], fmpq], ...]], ...]:
        """The equations with their terms, but for the constant ones."""
        return tuple((e, tuple((m, c) for m, c in e.terms() if any(m))) for e in self.equations)


@lru_cache(maxsize=32)
def short_forms(ring: Ring, equations: tuple[Polynomial, ...]) -> ShortForms:
    """Those of these equations, one object for equal ones, as it keeps what it found."""
    return ShortForms(ring, equations)
