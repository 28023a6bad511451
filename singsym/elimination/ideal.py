"""Ideals of polynomial rings over Q: Groebner bases, membership, dimension, elimination, decomposition.

Source: D. Cox, J. Little, D. O'Shea, Ideals, Varieties, and Algorithms; engines as in `engines`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial

from flint import fmpz_mpoly_vec

from singsym.effort.attempts import cut_short
from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.verdict import Known, Premises, Verdict, weakest
from singsym.elimination import engines, monomial_ideals
from singsym.elimination.basis import Basis, canonical, groebner_basis
from singsym.elimination.elimination_orders import eliminate, without_zeros_of
from singsym.elimination.engines.division import remainder
from singsym.elimination.linear_substitution import substitute_solved
from singsym.elimination.memo import is_known, remember
from singsym.elimination.minimal_primes import minimal_primes
from singsym.polynomials import Polynomial, Ring


@dataclass(frozen=True, init=False)
class Ideal:
    """The ideal of a ring that some polynomials generate.

    `==` compares generators; `equals` compares ideals.  Every method takes an optional `budget` (else that of
    the enclosing `with Budget(...)` holds) and raises `Undecided` where no engine comes to an answer.
    Answers are `Known`: "proven", or "modular" where a Groebner basis rests on random primes.
    The relations of a ring's algebraic constants are not added: they are part of the equations.

    >>> x, y = Ring(("x", "y")).gens
    >>> I = Ideal(x.ring, (x**2 + y**2 - 1, x - y))
    >>> I.dimension, I.contains(2 * y**2 - 1).value
    (Known(value=0, certainty='proven'), True)
    """

    ring: Ring
    generators: tuple[Polynomial, ...]

    def __init__(self, ring: Ring, generators: Iterable[Polynomial] = ()) -> None:
        object.__setattr__(self, "ring", ring)
        object.__setattr__(self, "generators", tuple(generators))
        for g in self.generators:
            if g.ring != ring:
                raise ValueError(f"{g} is in {g.ring!r}, not in {ring!r}: convert it with ring.convert")

    def __repr__(self) -> str:
        shown = [str(g) for g in self.generators[:6]]
        if len(self.generators) > 6:
            shown.append(f"... {len(self.generators) - 6} more")
        return f"Ideal({', '.join(shown) or '0'})"

    def _repr_latex_(self) -> str:
        import sympy

        inside = ", ".join(sympy.latex(g.to_sympy()) for g in self.generators) or "0"
        return rf"$\left\langle {inside} \right\rangle$"

    # -- Groebner basis --------------------------------------------------------------------------

    def _canonical(self) -> tuple[Polynomial, ...]:
        return canonical(self.ring, self.generators)

    @property
    def _key(self) -> tuple[Ring, frozenset[Polynomial]]:
        return self.ring, frozenset(self._canonical())

    def _basis(self, budget: Budget | None = None) -> Known[Basis]:
        return groebner_basis(self.ring, self.generators, budget)

    def _graded_basis(self, budget: Budget | None = None) -> Known[Basis]:
        """A basis for a degree order, from which dimension and degree are read."""
        if self.ring.order != "lex":
            return self._basis(budget)
        graded = self.ring.with_names(self.ring.names, "degrevlex")
        return groebner_basis(graded, list(map(graded.convert, self.generators)), budget)

    def groebner_basis(self, budget: Budget | None = None) -> Known[tuple[Polynomial, ...]]:
        """The reduced Groebner basis in the ring's order, primitive, smallest leading monomial first."""
        return self._basis(budget).map(lambda basis: basis.polynomials)

    def leading_monomials(self, budget: Budget | None = None) -> Known[tuple[tuple[int, ...], ...]]:
        """The exponents of the leading monomials of the Groebner basis."""
        return self._basis(budget).map(Basis.leading_monomials)

    @property
    def engine(self) -> str:
        """Who computed the Groebner basis."""
        return self._basis().value.engine

    # -- membership ------------------------------------------------------------------------------

    def reduce(self, polynomial: Polynomial, budget: Budget | None = None) -> Known[Polynomial]:
        """The normal form up to a non-zero scalar: zero exactly for the members.

        >>> x, y = Ring(("x", "y")).gens
        >>> Ideal(x.ring, (2 * x - 1,)).reduce(4 * x * y + y).value
        y
        """
        self._same_ring(polynomial)
        return self._basis(budget).map(lambda basis: basis.reduce(polynomial))

    def normal_form(self, polynomial: Polynomial, budget: Budget | None = None) -> Known[Polynomial]:
        """The remainder on division by the Groebner basis.

        >>> x, y = Ring(("x", "y")).gens
        >>> Ideal(x.ring, (2 * x - 1,)).normal_form(4 * x * y + y).value
        3*y
        """
        self._same_ring(polynomial)
        premises = Premises()
        basis = premises.take(self._basis(budget))
        if not polynomial or not basis.polynomials:
            return premises.conclude(polynomial)
        if basis.is_unit:
            return premises.conclude(self.ring.zero)
        # a further variable, which nothing reduces, carries the scalar through the division
        tagged = self.ring.with_names((*self.ring.names, _fresh(self.ring)))
        vector = fmpz_mpoly_vec(
            [tagged.convert(p).integer() for p in basis.polynomials], tagged.integer_context
        )
        start = tagged.convert(polynomial) + tagged.gens[-1]
        terms = remainder(start.integer(), vector).to_dict()
        tag = (0,) * len(self.ring.names)
        scalar = terms.pop((*tag, 1))
        return premises.conclude(self.ring.from_dict({m[:-1]: c for m, c in terms.items()}) / scalar)

    def contains(self, other: Polynomial | Ideal, budget: Budget | None = None) -> Known[bool]:
        """Whether a polynomial, or every element of an ideal, is in this ideal."""
        members = other.generators if isinstance(other, Ideal) else (other,)
        generators, premises = set(self._canonical()), Premises()
        left = (p for p in members if p and p.primitive() not in generators)
        inside = all(premises.take(self.reduce(p, budget)).is_zero for p in left)
        return premises.conclude(inside)

    def equals(self, other: Ideal, budget: Budget | None = None) -> Known[bool]:
        """Whether the two are the same ideal, however generated."""
        self._same_ring(other)
        one, two = self.groebner_basis(budget), other.groebner_basis(budget)
        return Known(one.value == two.value, weakest(one.certainty, two.certainty))

    def radical_contains(self, other: Polynomial | Ideal, budget: Budget | None = None) -> Known[bool]:
        """Whether a power of the polynomial (of every element) is in the ideal: it vanishes on all zeros.

        >>> x, y = Ring(("x", "y")).gens
        >>> Ideal(x.ring, (x**2, x * y)).radical_contains(x).value
        True
        """
        budget = current(budget)
        members = other.generators if isinstance(other, Ideal) else (other,)
        premises = Premises()
        for p in members:
            self._same_ring(p)
            if p and not premises.take(self._vanishes(p, budget)):
                return premises.conclude(False)
        return premises.conclude(True)

    def _vanishes(self, polynomial: Polynomial, budget: Budget) -> Known[bool]:
        key = (self._key, polynomial.primitive())

        def compute() -> Known[bool]:
            reduced, premises = polynomial.squarefree_part(), Premises()
            if is_known("groebner", self._key, budget):
                reduced = premises.take(self._basis(budget)).reduce(reduced)
                if not reduced:
                    return premises.conclude(True)
                reduced = min(reduced.squarefree_part(), polynomial.squarefree_part(), key=len)
            if reduced.is_constant:
                return premises.pass_on(self.is_unit(budget))
            off = Ideal(*without_zeros_of(self.ring, self.generators, reduced))
            return premises.pass_on(off.is_unit(budget))

        return remember("vanishes", key, compute, budget)

    def is_unit(self, budget: Budget | None = None) -> Known[bool]:
        """Whether the ideal contains 1: there is no zero, not even a complex one."""
        return self._core(budget).map(lambda core: core[0].is_unit)

    def unit_verdict(self, budget: Budget | None = None) -> Verdict:
        """`is_unit` with how it is known; undecided, with the reason, instead of an exception."""
        try:
            core = self._core(budget)
        except Undecided as failure:
            cut_short("a unit ideal")
            return Verdict.undecided(str(failure))
        basis = core.value[0]
        if basis.is_unit:
            return Verdict.yes(core.certainty, engine=basis.engine, reason="1 is in the ideal")
        return Verdict.no(core.certainty, engine=basis.engine, reason="1 is not in the ideal")

    def _core(self, budget: Budget | None = None) -> Known[tuple[Basis, int]]:
        """A Groebner basis that has the same quotient ring, and how many variables it lives in."""
        premises = Premises()
        if is_known("groebner", self._key, budget) and self.ring.order != "lex":
            return premises.conclude((premises.take(self._basis(budget)), len(self.ring.names)))

        def compute() -> Known[tuple[Basis, int]]:
            graded = self.ring.with_names(self.ring.names, "degrevlex")
            generators = list(map(graded.convert, self._canonical()))
            rest, made = substitute_solved(generators)
            basis = premises.take(groebner_basis(graded, rest, budget))
            return premises.conclude((basis, len(self.ring.names) - len(made)))

        return remember("core", self._key, compute, budget)

    # -- dimension -------------------------------------------------------------------------------

    @property
    def dimension(self) -> Known[int]:
        """The complex dimension of the zero set; -1 for the unit ideal."""
        count = len(self.ring.names)

        def from_core(core: tuple[Basis, int]) -> int:
            basis, variables = core
            found = monomial_ideals.independent_sets_dimension(basis.leading_monomials(), count)
            return found if found < 0 else found - (count - variables)

        return self._core().map(from_core)

    @property
    def degree(self) -> Known[int]:
        """The degree of the top-dimensional part, counted with multiplicity; 0 for the unit ideal."""
        leading = self._graded_basis().map(Basis.leading_monomials)
        return leading.map(partial(monomial_ideals.degree, variables=len(self.ring.names)))

    @property
    def is_zero_dimensional(self) -> Known[bool]:
        """Whether there are finitely many zeros, and one at least."""
        return self.dimension.map(lambda dimension: dimension == 0)

    @property
    def vector_space_dimension(self) -> Known[int]:
        """The number of complex zeros with multiplicity; raises `ValueError` where they are not finite."""
        dimension = self.dimension.value
        if dimension > 0:
            raise ValueError(f"an ideal of dimension {dimension} has infinitely many zeros")
        leading = self._core().map(lambda core: core[0].leading_monomials())
        return leading.map(partial(monomial_ideals.degree, variables=len(self.ring.names)))

    # -- algebra ---------------------------------------------------------------------------------

    def __add__(self, other: Ideal | Polynomial) -> Ideal:
        """The ideal generated by both."""
        self._same_ring(other)
        more = other.generators if isinstance(other, Ideal) else (other,)
        return Ideal(self.ring, dict.fromkeys((*self.generators, *more)))

    def __mul__(self, other: Ideal) -> Ideal:
        """The ideal generated by the products."""
        self._same_ring(other)
        products = dict.fromkeys(f * g for f in self.generators for g in other.generators)
        return Ideal(self.ring, products)

    def intersect(self, other: Ideal, budget: Budget | None = None) -> Known[Ideal]:
        """The common elements.

        >>> x, y = Ring(("x", "y")).gens
        >>> Ideal(x.ring, (x,)).intersect(Ideal(x.ring, (y,))).value
        Ideal(x*y)
        """
        self._same_ring(other)
        budget = current(budget)
        for small, large in ((self, other), (other, self)):
            inside = large.is_unit(budget)
            if not inside.value:
                inside = large.contains(small, budget)
            if inside.value:
                return Known(small, inside.certainty)
        name = _fresh(self.ring)
        larger = self.ring.with_names((name, *self.ring.names), "degrevlex")
        t = larger.gens[0]
        both = [t * larger.convert(f) for f in self._canonical()]
        both += [(1 - t) * larger.convert(g) for g in other._canonical()]
        return self._from(eliminate(larger, both, {name}, budget))

    def eliminate(self, names: Iterable[str], budget: Budget | None = None) -> Known[Ideal]:
        """The elements free of these variables, as an ideal of the same ring (see `restrict`).

        >>> t, x, y = Ring(("t", "x", "y")).gens
        >>> Ideal(t.ring, (x - t**2, y - t**3)).eliminate({"t"}).value
        Ideal(x^3 - y^2)
        """
        chosen = set(names)
        for name in chosen:
            self.ring.index(name)
        graded = self.ring.with_names(self.ring.names, "degrevlex")
        generators = list(map(graded.convert, self._canonical()))
        return self._from(eliminate(graded, generators, chosen, current(budget)))

    def restrict(self, ring: Ring) -> Ideal:
        """The same generators in a ring that has their variables; raises `KeyError` for a missing one."""
        return Ideal(ring, tuple(ring.convert(g) for g in self.generators))

    def saturate(self, other: Polynomial | Ideal, budget: Budget | None = None) -> Known[Ideal]:
        """The ideal of the zeros outside the zero set of `other`: f with f g^k in the ideal for some k.

        >>> x, y = Ring(("x", "y")).gens
        >>> Ideal(x.ring, (x**2 * y, x * y**2)).saturate(x).value
        Ideal(y)
        """
        self._same_ring(other)
        budget, premises = current(budget), Premises()
        if isinstance(other, Ideal):
            parts = [premises.take(self.saturate(g, budget)) for g in other._canonical()]
            return premises.pass_on(intersection(self.ring, parts, budget))
        if not other:
            return Known(Ideal(self.ring, (self.ring.one,)))
        result = self
        for factor, _ in other.factors():
            result = premises.take(result._saturated_by(factor, budget))
        return premises.conclude(result)

    def _saturated_by(self, factor: Polynomial, budget: Budget) -> Known[Ideal]:
        graded = self.ring.with_names(self.ring.names, "degrevlex")
        generators = list(map(graded.convert, self._canonical()))
        larger, system = without_zeros_of(graded, generators, graded.convert(factor))
        try:
            return self._from(eliminate(larger, system, {larger.names[0]}, budget))
        except engines.EngineFailure:
            task = engines.Task("saturate", graded, tuple(generators), (graded.convert(factor),))
            answer = engines.ask(task, budget)
            return self._from(answer.known.map(lambda ideals: ideals[0]))

    def quotient(self, other: Polynomial | Ideal, budget: Budget | None = None) -> Known[Ideal]:
        """The f with f g in the ideal for every g in `other`.

        >>> x, y = Ring(("x", "y")).gens
        >>> Ideal(x.ring, (x**2 * y,)).quotient(x).value
        Ideal(x*y)
        """
        self._same_ring(other)
        premises = Premises()
        if isinstance(other, Ideal):
            parts = [premises.take(self.quotient(g, budget)) for g in other._canonical()]
            return premises.pass_on(intersection(self.ring, parts, budget))
        if not other:
            return Known(Ideal(self.ring, (self.ring.one,)))
        common = premises.take(self.intersect(Ideal(self.ring, (other,)), budget))
        return premises.conclude(Ideal(self.ring, (g.exact_quotient(other) for g in common.generators)))

    def minimal_primes(self, budget: Budget | None = None) -> Known[tuple[Ideal, ...]]:
        """The minimal primes over the ideal, () for the unit ideal.

        Principal, linear and zero ideals need no engine; others need Singular, and raise
        `engines.EngineUnavailable` without it (see `varieties.decomposition`, which splits).
        """
        found = minimal_primes(self.ring, self._canonical(), current(budget))
        return found.map(lambda primes: tuple(Ideal(self.ring, prime) for prime in primes))

    def radical(self, budget: Budget | None = None) -> Known[Ideal]:
        """The polynomials of which a power is in the ideal."""
        premises = Premises()
        primes = premises.take(self.minimal_primes(budget))
        return premises.pass_on(intersection(self.ring, primes, budget))

    # -- helpers ---------------------------------------------------------------------------------

    def _from(self, generators: Known[tuple[Polynomial, ...]]) -> Known[Ideal]:
        return generators.map(
            lambda found: Ideal(self.ring, canonical(self.ring, map(self.ring.convert, found)))
        )

    def _same_ring(self, other: Polynomial | Ideal) -> None:
        if other.ring != self.ring:
            raise ValueError(f"{other!r} is in {other.ring!r}, not in {self.ring!r}: convert it first")


def intersection(ring: Ring, ideals: Iterable[Ideal], budget: Budget | None = None) -> Known[Ideal]:
    """The common elements of ideals; the whole ring of none.

    >>> x, y = Ring(("x", "y")).gens
    >>> intersection(x.ring, (Ideal(x.ring, (g,)) for g in (x, y, x * y))).value
    Ideal(x*y)
    """
    premises, common = Premises(), Ideal(ring, (ring.one,))
    for ideal in ideals:
        common = premises.take(common.intersect(ideal, budget))
    return premises.conclude(common)


def _fresh(ring: Ring) -> str:
    """A name that the ring does not have."""
    return next(name for k in range(len(ring.names) + 1) if (name := f"t{k}") not in ring.names)
