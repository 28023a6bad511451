"""Proofs that a polynomial has no zero on the feasible set, and short forms modulo the loop equations.

Source: Zlatanov, Fenton, Benhabib (1998), section 4.2: a passive velocity may be eliminated only where it is
uniquely determined at every feasible configuration.  The proofs are elementary; none found means unknown.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from functools import reduce as fold

from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.signs import Signs, signs
from singsym.polynomials import Polynomial
from singsym.polynomials.short_forms import LONGEST, ShortForms, short_forms

LONGEST_SUM = 40
"""The sign of longer sums is not looked for."""

LONGEST_ROOT = 3
"""Nor are the factors of the squares of longer polynomials."""


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
    def _forms(self) -> ShortForms:
        return short_forms(self.space.ring, self.space.equations)

    @cached_property
    def _signs(self) -> Signs:
        space = self.space
        return signs(space.ring, space.equations, space.positive, space.nonnegative)

    # -- short forms ---------------------------------------------------------------------------------

    def forms(self, polynomial: Polynomial) -> tuple[Polynomial, ...]:
        """See `ShortForms.forms`."""
        return self._forms.forms(polynomial)

    def normal_form(self, polynomial: Polynomial) -> Polynomial:
        """See `ShortForms.normal_form`."""
        return self._forms.normal_form(polynomial)

    def modulo_multiples(self, polynomial: Polynomial) -> Polynomial:
        """See `ShortForms.modulo_multiples`."""
        return self._forms.modulo_multiples(polynomial)

    def shorten(self, polynomial: Polynomial) -> Polynomial:
        """See `ShortForms.shorten`."""
        return self._forms.shorten(polynomial)

    # -- proofs --------------------------------------------------------------------------------------

    def reason(self, polynomial: Polynomial) -> str | None:
        """Why the polynomial has no zero on the feasible set, in words; None where no proof was found."""
        if polynomial.is_constant:
            return f"the constant {polynomial}" if polynomial else None
        if polynomial not in self._known:
            self._known[polynomial] = self._prove(polynomial)
        return self._known[polynomial]

    @cached_property
    def _known(self) -> dict[Polynomial, str | None]:
        return {}

    def _prove(self, polynomial: Polynomial) -> str | None:
        if (found := self._prove_irreducible(polynomial)) is not None:
            return found
        if len(polynomial) > LONGEST:
            return None
        for form in self._all_forms(polynomial):
            factors = form.factors()
            if len(factors) > 1 or (factors and factors[0][1] > 1):
                reasons = self._all_proven([f for f, _ in factors])
                if reasons:
                    parts = [
                        f"{f.short_text()} is {why}" for (f, _), why in zip(factors, reasons, strict=True)
                    ]
                    return "a product: " + "; ".join(parts)
        return self._prove_square(polynomial)

    def _prove_square(self, polynomial: Polynomial) -> str | None:
        """By factors of the square, as in s^2 = (1 - c)(1 + c)."""
        if len(polynomial) > LONGEST_ROOT:
            return None
        for form in self.forms(polynomial * polynomial):
            factors = [f for f, _ in form.factors()]
            reasons = self._all_proven(factors)
            if len(factors) > 1 and reasons:
                parts = [f"{f.short_text()}, {why}" for f, why in zip(factors, reasons, strict=True)]
                return "a divisor, in the square, of nonzero factors: " + "; ".join(parts)
        return None

    def _all_proven(self, factors: list[Polynomial]) -> list[str]:
        """Why each of some irreducible polynomials has no zero; none where that is not proven of all."""
        reasons: list[str] = []
        for factor in factors:
            if (why := self._prove_irreducible(factor)) is None:
                return []
            reasons.append(why)
        return reasons

    def _prove_irreducible(self, polynomial: Polynomial) -> str | None:
        if polynomial not in self._irreducible:
            self._irreducible[polynomial] = self._proof(self._all_forms(polynomial))
        return self._irreducible[polynomial]

    @cached_property
    def _irreducible(self) -> dict[Polynomial, str | None]:
        return {}

    def _all_forms(self, polynomial: Polynomial) -> tuple[Polynomial, ...]:
        return tuple(dict.fromkeys((polynomial, self.shorten(polynomial), *self.forms(polynomial))))

    def _proof(self, forms: tuple[Polynomial, ...]) -> str | None:
        """Why a polynomial with these forms has no zero, without factors."""
        short = (self._forms.modulo_multiples(form) for form in forms if len(form) <= LONGEST_SUM)
        for form in (*forms, *short):
            if form.is_constant and form:
                return f"equal to {form} on the configuration space"
        for form in forms:
            if (found := self._divisors_of_nonzero.get(form.primitive())) is not None:
                return found
        for form in forms:
            if len(form) <= LONGEST_SUM and (found := self._signs.reason(form)) is not None:
                return found
        return None

    @cached_property
    def _divisors_of_nonzero(self) -> dict[Polynomial, str]:
        """Irreducible polynomials that have no zero where conditions and exclusions hold, and why."""
        found: dict[Polynomial, str] = {}
        for exclusion in reversed(self.space.exclusions):
            found |= _nonzero_outside(exclusion, self._forms)
        for positive in reversed(self.space.positive):
            words = f"a divisor of {positive.short_text()} > 0"
            found |= dict.fromkeys((positive.primitive(), *(f for f, _ in positive.factors())), words)
        return found


@lru_cache(maxsize=2**10)
def _nonzero_outside(exclusion: tuple[Polynomial, ...], forms: ShortForms) -> dict[Polynomial, str]:
    """Irreducible polynomials that have no zero outside an exclusion, and why.

    A real zero of one is a common zero of the exclusion's polynomials where it divides all of them, or a
    sum of their squares that is short enough to be factored, or is such a sum.
    """
    found: dict[Polynomial, str] = {}
    words = "nonzero outside the excluded " + ", ".join(f"{g.short_text(4)} = 0" for g in exclusion)
    if sum(map(len, exclusion)) <= LONGEST_SUM:
        total = sum((g * g for g in exclusion), start=forms.ring.zero)
        for form in (total, forms.shorten(total), *forms.forms(total)):
            if form:
                found[form.primitive()] = words
            if len(form) <= LONGEST_SUM:
                found |= {f: words for f, _ in form.factors()}
    common = fold(Polynomial.gcd, exclusion, forms.ring.zero)
    if len(common) <= LONGEST:
        found |= {f: words for f, _ in common.factors()}
    return found
