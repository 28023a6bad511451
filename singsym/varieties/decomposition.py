"""Decomposition of a variety by splitting, small subrings first, into pieces proven prime where possible.

Source: dynamic splitting after Greuel and Pfister, "A Singular Introduction to Commutative Algebra", §4,
and the order of work measured on linkages: factor, branch, substitute, and extend block by block.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Literal

from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, current
from singsym.effort.patience import SPLITTING
from singsym.effort.progress import Sink, report, to
from singsym.effort.verdict import Known, Premises, weakest
from singsym.elimination import engines
from singsym.elimination.ideal import Ideal
from singsym.elimination.linear_substitution import Substitution, shortest_substitution
from singsym.elimination.memo import remember
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.varieties.coordinates import independent_variables, leading_exponents
from singsym.varieties.soon import analysed, holds_one, holds_powers_of_one, is_inside, saturated
from singsym.varieties.splitting import (
    factor_equations,
    irreducible_factors,
    levels,
    used_ring,
)

_LONGEST_CUT = 300
"""An ideal is not taken apart along a longer polynomial, which would take too long to factor."""

Purity = Literal["unknown", "unmixed", "Cohen-Macaulay"]
"""What is proven of the primary components of an ideal: unmixed ones have all one dimension, and so none is
embedded; Cohen-Macaulay ideals are unmixed."""


@dataclass(frozen=True)
class Component:
    """A piece of a variety: its ideal, whether that is proven prime over Q, and its dimension.

    The dimension is the largest one; a piece where neither prime nor purity is proven may hold smaller
    components beside it, which need not be in other pieces.  What needs a single dimension takes a
    `PurePiece` (see `purity`).

    >>> x, y = Ring(("x", "y")).gens
    >>> decompose([x * y], ring=x.ring).value
    (Component(x = 0, dimension 1), Component(y = 0, dimension 1))
    """

    ideal: Ideal
    prime: bool
    dimension: int
    purity: Purity = field(default="unknown", compare=False)

    @property
    def generators(self) -> tuple[Polynomial, ...]:
        """Generators of the ideal."""
        return self.ideal.generators

    @property
    def is_pure(self) -> bool:
        """Whether all components over C are proven to have the dimension.

        Those of a prime over Q are conjugate to each other.
        """
        return self.prime or self.purity != "unknown"

    def __repr__(self) -> str:
        shown = ", ".join(map(str, self.generators[:3])) or "0"
        more = f", ... ({len(self.generators)} generators)" if len(self.generators) > 3 else ""
        doubt = "" if self.prime else ", not proven prime"
        return f"Component({shown}{more} = 0, dimension {self.dimension}{doubt})"

    def contains(self, other: Component) -> Known[bool]:
        """Whether V(other) is seen to lie in V(self)."""
        premises = Premises()
        return premises.conclude(all(premises.take(other.vanishes(p)) for p in self.generators))

    def vanishes(self, p: Polynomial) -> Known[bool]:
        """Whether p is zero on the whole piece (exact)."""
        inside = self.ideal.contains(p)
        if inside.value or self.prime:
            return inside
        known = self.ideal.radical_contains(p)
        return Known(known.value, weakest(inside.certainty, known.certainty))


def decompose(
    equations: Sequence[Polynomial],
    nonzero: Sequence[Polynomial] = (),
    *,
    ring: Ring,
    excluded: Sequence[Equations] = (),
    budget: Budget | None = None,
    progress: Sink | None = None,
) -> Known[tuple[Component, ...]]:
    """The pieces of V(equations) on which no polynomial of `nonzero` vanishes throughout.

    excluded: sets that do not count, each given by several polynomials; pieces soon seen to lie in one are
        left out.
    With those sets, their union contains V(equations) minus V(product of nonzero), over the complex numbers,
    and none contains another.  The relations of the ring's algebraic constants count as equations.  Where
    time ends a piece is left as it is, not proven prime or of one dimension.  Raises `Undecided` where the
    budget ends.

    >>> x, y = Ring(("x", "y")).gens
    >>> decompose([x**2 - y**2, x * y - y], [y], ring=x.ring).value
    (Component(y + 1, x - 1 = 0, dimension 0), Component(y - 1, x - 1 = 0, dimension 0))
    """
    forbidden = irreducible_factors(ring.convert(p) for p in nonzero)
    if forbidden is None:
        return Known(())
    premises = Premises()
    given = (*ring.relations, *(ring.convert(p) for p in equations))
    several = frozenset(tuple(map(ring.convert, group)) for group in excluded if len(group) > 1)
    with current(budget).part(), to(progress):
        pieces = premises.take(_branch(ring, given, forbidden, several))
        full = [premises.take(_in_ring(piece, ring)) for piece in pieces]
        kept = [
            c
            for c in full
            if not any(premises.take(c.vanishes(p)) for p in forbidden)
            and not premises.take(holds_one(c.ideal, several))
        ]
        return premises.pass_on(prune(kept))


def prune(components: Iterable[Component]) -> Known[tuple[Component, ...]]:
    """Leave out every piece that lies in another one; sorted by dimension, highest first."""
    ordered = sorted(components, key=lambda c: (-c.dimension, not c.prime, str(c.generators)))
    kept: list[Component] = []
    premises = Premises()
    for c in ordered:
        if not any(premises.take(k.contains(c)) for k in kept):
            kept.append(c)
    return premises.conclude(tuple(kept))


def _in_ring(piece: Component, ring: Ring) -> Known[Component]:
    """The cylinder over a piece, in a larger ring, with its Groebner basis as generators."""
    free = len(ring.names) - len(piece.ideal.ring.names)
    premises = Premises()
    basis = premises.take(Ideal(ring, map(ring.convert, piece.generators)).groebner_basis())
    turned = Component(Ideal(ring, basis), piece.prime, piece.dimension + free, piece.purity)
    return premises.conclude(turned)


def _all_in_ring(pieces: Iterable[Component], ring: Ring) -> Known[tuple[Component, ...]]:
    """The cylinders over pieces that lie in no other one."""
    premises = Premises()
    return premises.pass_on(prune([premises.take(_in_ring(piece, ring)) for piece in pieces]))


# -- branching on the given equations ------------------------------------------------------------------


def _branch(
    ring: Ring, equations: Equations, nonzero: frozenset[Polynomial], excluded: frozenset[Equations]
) -> Known[list[Component]]:
    """Branch on factors and substitute until every equation is irreducible, then work level by level."""
    current().check("decomposition")
    factored = factor_equations(equations, nonzero)
    if factored is None:
        return Known([])
    premises = Premises()
    if factored and len(factored[-1]) > 1:
        chosen = min((f for f in factored if len(f) > 1), key=lambda f: (-len(f), sum(map(len, f))))
        rest = [_product(f, ring) for f in factored if f is not chosen]
        found: list[Component] = []
        for i, f in enumerate(chosen):
            # The part of V(f) inside an earlier factor is in an earlier branch.
            found += premises.take(_branch(ring, (*rest, f), nonzero | frozenset(chosen[:i]), excluded))
        return premises.conclude(found)
    single = tuple(f[0] for f in factored)
    substitution = shortest_substitution(single)
    if substitution is None:
        return _by_levels(used_ring(ring, single), single, nonzero, excluded)
    smaller = ring.with_names(n for n in ring.names if n != substitution.name)
    remaining = irreducible_factors(substitution.apply(nonzero))
    if remaining is None:
        return Known([])
    equations = tuple(smaller.convert(p) for p in substitution.apply(single))
    forbidden = frozenset(smaller.convert(p) for p in remaining)
    groups = _substituted(excluded, substitution, smaller)
    pieces = premises.take(_branch(smaller, equations, forbidden, groups))
    return premises.conclude([_lifted(piece, substitution.equation) for piece in pieces])


def _product(factors: Sequence[Polynomial], ring: Ring) -> Polynomial:
    value = ring.one
    for f in factors:
        value = value * f
    return value


def _lifted(piece: Component, equation: Polynomial) -> Component:
    """The graph of a polynomial over a piece: isomorphic to it."""
    names = {*piece.ideal.ring.names, *equation.variables}
    ring = equation.ring.subring(names)
    free = len(ring.names) - len(piece.ideal.ring.names) - 1
    generators = (*(ring.convert(p) for p in piece.generators), ring.convert(equation))
    return Component(Ideal(ring, generators), piece.prime, piece.dimension + free, piece.purity)


def _substituted(
    groups: frozenset[Equations], substitution: Substitution, smaller: Ring
) -> frozenset[Equations]:
    return frozenset(tuple(map(smaller.convert, substitution.apply(group))) for group in groups)


def _by_levels(
    ring: Ring, equations: Equations, nonzero: frozenset[Polynomial], excluded: frozenset[Equations]
) -> Known[list[Component]]:
    """Decompose the equations of the first few variables, then extend every piece by the next ones."""
    pieces = [Component(Ideal(ring.with_names(()), ()), True, 0, "Cohen-Macaulay")]
    steps, premises = levels(equations), Premises()
    for count, level in enumerate(steps):
        report("decompose", f"{len(level.names)} variables, {len(pieces)} pieces", count, len(steps))
        inner = ring.with_names(level.names)
        added = tuple(inner.convert(p) for p in level.equations)
        known = frozenset(inner.convert(p) for p in nonzero if set(p.variables) <= set(level.names))
        inside = [g for g in excluded if {n for p in g for n in p.variables} <= set(level.names)]
        outside = frozenset(tuple(map(inner.convert, group)) for group in inside)
        found: list[Component] = []
        for piece in pieces:
            base = tuple(inner.convert(p) for p in piece.generators)
            fresh = len(level.names) - len(piece.ideal.ring.names)
            smallest = piece.dimension + fresh - len(added) if piece.is_pure else 0
            macaulay = piece.purity == "Cohen-Macaulay"
            system = _System(inner, (*base, *added), known, smallest, macaulay, outside)
            found += premises.take(_refine(system))
        pieces = list(premises.take(_all_in_ring(found, inner)))
    report("decompose", f"{len(pieces)} pieces", len(steps), len(steps))
    return premises.conclude(pieces)


# -- one ideal -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _System:
    """Equations to split, and what is known of their zeros outside those of `nonzero` and of `excluded`.

    smallest: no component of the set that is being split has a smaller dimension (Krull: each equation takes
    one at most off a set of a single dimension); the parts below it lie in others and are dropped.  macaulay:
    if `smallest` is the dimension, the ideal is Cohen-Macaulay (unmixedness theorem).
    """

    ring: Ring
    equations: tuple[Polynomial, ...]
    nonzero: frozenset[Polynomial]
    smallest: int
    macaulay: bool = False
    excluded: frozenset[Equations] = frozenset()

    def plus(self, p: Polynomial, nonzero: Iterable[Polynomial] = ()) -> _System:
        more = self.replaced((*self.equations, p), same_ideal=False)
        return replace(more, nonzero=self.nonzero | frozenset(nonzero))

    def replaced(self, equations: Iterable[Polynomial], *, same_ideal: bool) -> _System:
        return replace(self, equations=tuple(equations), macaulay=self.macaulay and same_ideal)


def _refine(system: _System) -> Known[tuple[Component, ...]]:
    """Split an ideal by factors of its equations, of its basis, and of eliminants, until it is prime."""
    current().check("decomposition")
    key = replace(system, equations=tuple(dict.fromkeys(system.equations)))
    return remember("decompose", key, lambda: _refined(system))


def _refined(system: _System) -> Known[tuple[Component, ...]]:
    factored = factor_equations(system.equations, system.nonzero)
    if factored is None:
        return Known(())
    # many reducible equations come from a basis: take a new one before branching on the next
    if 0 < sum(len(f) > 1 for f in factored) < 3:
        return _by_factors(system, factored[-1])
    single = tuple(_product(f, system.ring) for f in factored)
    unchanged = {p.primitive() for p in system.equations if p} <= set(single)
    system = system.replaced(single, same_ideal=unchanged)
    substitution = shortest_substitution(single)
    if substitution is None:
        return _by_basis(system)
    smaller = system.ring.with_names(n for n in system.ring.names if n != substitution.name)
    nonzero = irreducible_factors(substitution.apply(system.nonzero))
    if nonzero is None:
        return Known(())
    reduced = tuple(smaller.convert(p) for p in substitution.apply(single))
    forbidden = frozenset(smaller.convert(p) for p in nonzero)
    premises = Premises()
    groups = _substituted(system.excluded, substitution, smaller)
    inner = replace(system, ring=smaller, equations=reduced, nonzero=forbidden, excluded=groups)
    pieces = premises.take(_refine(inner))
    return premises.conclude(tuple(_lifted(piece, substitution.equation) for piece in pieces))


def _by_factors(system: _System, factors: Sequence[Polynomial]) -> Known[tuple[Component, ...]]:
    premises = Premises()
    pieces = [p for i, f in enumerate(factors) for p in premises.take(_refine(system.plus(f, factors[:i])))]
    return premises.pass_on(_all_in_ring(pieces, system.ring))


def _by_basis(system: _System) -> Known[tuple[Component, ...]]:
    ideal, premises = Ideal(system.ring, system.equations), Premises()
    basis = premises.take(ideal.groebner_basis())
    if not basis:
        whole = Component(ideal, True, len(system.ring.names), "Cohen-Macaulay")
        return premises.conclude((whole,))
    if basis[0].is_constant:
        return premises.conclude(())
    dimension = len(independent_variables(leading_exponents(basis), len(system.ring.names)))
    left_out = (*((p,) for p in system.nonzero), *system.excluded)
    if dimension < system.smallest or premises.take(holds_one(ideal, left_out)):
        return premises.conclude(())
    factored = factor_equations(basis, system.nonzero)
    if factored is None:
        return premises.conclude(())
    system = system.replaced(basis, same_ideal=True)
    single = {f[0] for f in factored}
    if len(factored[-1]) > 1:
        found = _by_factors(system, factored[-1])
    elif not single.issuperset(basis):
        found = _refine(system.replaced((*basis, *single), same_ideal=False))
    elif shortest_substitution(basis) is not None:
        found = _refine(system)
    else:
        found = _by_eliminant(system, premises.conclude(Ideal(system.ring, basis)), dimension)
    return premises.pass_on(found)


def _by_eliminant(system: _System, given: Known[Ideal], dimension: int) -> Known[tuple[Component, ...]]:
    """The pieces of an ideal given by its Groebner basis; none is called prime without a proof of that."""
    premises = Premises()
    ideal = premises.take(given)
    premises.rest_on(ideal.groebner_basis().certainty)
    proven = premises.certainty == "proven"
    if len(ideal.generators) == 1:
        return premises.conclude((Component(ideal, proven, dimension, "Cohen-Macaulay"),))
    if premises.take(holds_powers_of_one(ideal, system.excluded)):
        return premises.conclude(())
    found = premises.take(analysed(ideal, system.macaulay and system.smallest == dimension))
    if found.factors and not any(premises.take(ideal.contains(f)) for f in found.factors):
        parts = premises.take(_along(system, ideal, found.factors))
        pieces = [p for part in parts for p in premises.take(_refine(part))]
        return premises.pass_on(_all_in_ring(pieces, system.ring))
    if not found.prime and premises.take(is_inside(ideal, system.excluded)):
        return premises.conclude(())
    if not found.prime and (primes := premises.take(_by_engine(given))):
        return premises.conclude(primes)
    purity: Purity = "Cohen-Macaulay" if found.macaulay else "unmixed"
    if found.beside is not None and found.beside.is_constant:
        return premises.conclude((Component(ideal, proven and found.prime, dimension, purity),))
    if found.beside is not None and len(found.beside) <= _LONGEST_CUT:
        main = saturated(ideal, found.beside)
        if main is not None:
            basis = main.value.groebner_basis()
            prime = found.prime and given.is_proven and main.is_proven and basis.is_proven
            component = Component(premises.take(main), prime, dimension, purity)
            others = premises.take(_smaller(system, ideal, component, found.beside))
            return premises.pass_on(prune((component, *others)))
    primes = premises.take(_by_engine(given)) if found.prime else ()
    return premises.conclude(primes or (Component(ideal, False, dimension),))


def _along(system: _System, ideal: Ideal, factors: Sequence[Polynomial]) -> Known[tuple[_System, ...]]:
    """Systems that together hold the zeros of an ideal in which a power of a product of factors is.

    An ideal plus a factor is often a part with smaller ones beside it. Where these do not count, the zeros of
    each factor outside the others are taken, and those that two have in common.
    """
    plain = tuple(map(system.plus, factors))
    premises = Premises()
    if premises.take(ideal.dimension) > system.smallest:
        return Known(plain)
    apart = list[_System]()
    for f in factors:
        outside = saturated(ideal, _product([g for g in factors if g is not f], system.ring))
        if outside is None:
            return Known(plain)
        apart.append(system.replaced((*premises.take(outside).generators, f), same_ideal=False))
    common = (system.plus(f).plus(g) for f, g in combinations(factors, 2))
    return premises.conclude((*apart, *common))


def _smaller(
    system: _System, ideal: Ideal, main: Component, beside: Polynomial
) -> Known[tuple[Component, ...]]:
    """Pieces that hold the zeros of an ideal outside its main part, all of them zeros of `beside`."""
    premises, found = Premises(), list[Component]()
    # where the main part has the smallest dimension, what is smaller lies in other branches
    for g in main.generators if main.dimension > system.smallest else ():
        if premises.take(ideal.contains(g)):
            continue
        rest = saturated(ideal, g)
        apart = system.plus(beside)
        if rest is not None:
            apart = system.replaced(premises.take(rest).generators, same_ideal=False)
        pieces = premises.take(_refine(apart))
        found += [premises.take(_in_ring(piece, system.ring)) for piece in pieces]
        if rest is None:
            break
    return premises.conclude(tuple(found))


def _by_engine(ideal: Known[Ideal]) -> Known[tuple[Component, ...]]:
    """The minimal primes by Singular where it is present and quick, else nothing."""
    if not engines.has("singular"):
        return Known(())
    with attempt("decomposition", SPLITTING.work):
        premises, found = Premises(), list[Component]()
        for prime in premises.take(premises.take(ideal).minimal_primes()):
            basis, dimension = prime.groebner_basis(), premises.take(prime.dimension)
            premises.rest_on(basis.certainty)
            found.append(Component(prime, ideal.is_proven and basis.is_proven, dimension))
        return premises.pass_on(prune(found))
    return Known(())
