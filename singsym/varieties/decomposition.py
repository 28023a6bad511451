"""Decomposition of a variety by splitting, small subrings first, into pieces proven prime where possible.

Source: dynamic splitting after Greuel and Pfister, "A Singular Introduction to Commutative Algebra", §4,
and the order of work measured on linkages: factor, branch, substitute, and extend block by block.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, current
from singsym.effort.patience import SPLITTING
from singsym.effort.progress import Sink, report, to
from singsym.elimination import engines
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import remember
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.irreducibility import Splitting, analyse, independent_variables, leading_exponents
from singsym.varieties.splitting import (
    factor_equations,
    irreducible_factors,
    levels,
    linear_substitution,
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
    >>> decompose([x * y], ring=x.ring)
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

    def contains(self, other: Component) -> bool:
        """Whether V(other) is proven to lie in V(self)."""
        return all(other.vanishes(p) for p in self.generators)

    def vanishes(self, p: Polynomial) -> bool:
        """Whether p is zero on the whole piece (exact)."""
        return self.ideal.contains(p) or (not self.prime and self.ideal.radical_contains(p))


def decompose(
    equations: Sequence[Polynomial],
    nonzero: Sequence[Polynomial] = (),
    *,
    ring: Ring,
    budget: Budget | None = None,
    progress: Sink | None = None,
) -> tuple[Component, ...]:
    """The pieces of V(equations) on which no polynomial of `nonzero` vanishes throughout.

    Their union contains V(equations) minus V(product of nonzero), over the complex numbers, and none contains
    another.  The relations of the ring's algebraic constants count as equations.  Where time ends a piece
    is left as it is, not proven prime or of one dimension.  Raises `Undecided` where the budget ends.

    >>> x, y = Ring(("x", "y")).gens
    >>> decompose([x**2 - y**2, x * y - y], [y], ring=x.ring)
    (Component(y + 1, x - 1 = 0, dimension 0), Component(y - 1, x - 1 = 0, dimension 0))
    """
    forbidden = irreducible_factors(ring.convert(p) for p in nonzero)
    if forbidden is None:
        return ()
    given = (*ring.relations, *(ring.convert(p) for p in equations))
    with current(budget).part(), to(progress):
        full = [_in_ring(piece, ring) for piece in _branch(ring, given, forbidden)]
        return prune(c for c in full if not any(c.vanishes(p) for p in forbidden))


def prune(components: Iterable[Component]) -> tuple[Component, ...]:
    """Leave out every piece that lies in another one; sorted by dimension, highest first."""
    ordered = sorted(components, key=lambda c: (-c.dimension, not c.prime, str(c.generators)))
    kept: list[Component] = []
    for c in ordered:
        if not any(k.contains(c) for k in kept):
            kept.append(c)
    return tuple(kept)


def _in_ring(piece: Component, ring: Ring) -> Component:
    """The cylinder over a piece, in a larger ring, with its Groebner basis as generators."""
    free = len(ring.names) - len(piece.ideal.ring.names)
    ideal = Ideal(ring, tuple(ring.convert(p) for p in piece.generators), piece.ideal.given)
    basis = ideal.groebner_basis()
    return Component(Ideal(ring, basis, ideal.certainty), piece.prime, piece.dimension + free, piece.purity)


# -- branching on the given equations ------------------------------------------------------------------


def _branch(ring: Ring, equations: tuple[Polynomial, ...], nonzero: frozenset[Polynomial]) -> list[Component]:
    """Branch on factors and substitute until every equation is irreducible, then work level by level."""
    current().check("decomposition")
    factored = factor_equations(equations, nonzero)
    if factored is None:
        return []
    if factored and len(factored[-1]) > 1:
        chosen = min((f for f in factored if len(f) > 1), key=lambda f: (-len(f), sum(map(len, f))))
        rest = [_product(f, ring) for f in factored if f is not chosen]
        found: list[Component] = []
        for i, f in enumerate(chosen):
            # The part of V(f) inside an earlier factor is in an earlier branch.
            found += _branch(ring, (*rest, f), nonzero | frozenset(chosen[:i]))
        return found
    single = tuple(f[0] for f in factored)
    substitution = linear_substitution(single)
    if substitution is None:
        return _by_levels(used_ring(ring, single), single, nonzero)
    smaller = ring.with_names(n for n in ring.names if n != substitution.name)
    remaining = irreducible_factors(substitution.apply(nonzero))
    if remaining is None:
        return []
    pieces = _branch(
        smaller,
        tuple(smaller.convert(p) for p in substitution.apply(single)),
        frozenset(smaller.convert(p) for p in remaining),
    )
    return [_lifted(piece, substitution.equation) for piece in pieces]


def _product(factors: Sequence[Polynomial], ring: Ring) -> Polynomial:
    value = ring.one
    for f in factors:
        value = value * f
    return value


def _lifted(piece: Component, equation: Polynomial) -> Component:
    """The graph of a polynomial over a piece: isomorphic to it."""
    names = {*piece.ideal.ring.names, *equation.variables}
    ring = equation.ring.with_names(n for n in equation.ring.names if n in names)
    free = len(ring.names) - len(piece.ideal.ring.names) - 1
    generators = (*(ring.convert(p) for p in piece.generators), ring.convert(equation))
    ideal = Ideal(ring, generators, piece.ideal.given)
    return Component(ideal, piece.prime, piece.dimension + free, piece.purity)


def _by_levels(
    ring: Ring, equations: tuple[Polynomial, ...], nonzero: frozenset[Polynomial]
) -> list[Component]:
    """Decompose the equations of the first few variables, then extend every piece by the next ones."""
    pieces = [Component(Ideal(ring.with_names(()), ()), True, 0, "Cohen-Macaulay")]
    steps = levels(equations)
    for count, level in enumerate(steps):
        report("decompose", f"{len(level.names)} variables, {len(pieces)} pieces", count, len(steps))
        inner = ring.with_names(level.names)
        added = tuple(inner.convert(p) for p in level.equations)
        known = frozenset(inner.convert(p) for p in nonzero if set(p.variables) <= set(level.names))
        found: list[Component] = []
        for piece in pieces:
            base = tuple(inner.convert(p) for p in piece.generators)
            fresh = len(level.names) - len(piece.ideal.ring.names)
            least = piece.dimension + fresh - len(added) if piece.is_pure else 0
            macaulay = piece.purity == "Cohen-Macaulay"
            found += _refine(_System(inner, (*base, *added), known, least, macaulay))
        pieces = list(prune(_in_ring(piece, inner) for piece in found))
    return pieces


# -- one ideal -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _System:
    """Equations to split, and what is known of their zeros outside those of `nonzero`.

    least: no component of the set that is being split has a smaller dimension (Krull: each equation takes
    one at most off a set of a single dimension); the parts below it lie in others and are dropped.  macaulay:
    if `least` is the dimension, the ideal is Cohen-Macaulay (unmixedness theorem).
    """

    ring: Ring
    equations: tuple[Polynomial, ...]
    nonzero: frozenset[Polynomial]
    least: int
    macaulay: bool = False

    def plus(self, p: Polynomial, nonzero: Iterable[Polynomial] = ()) -> _System:
        return _System(self.ring, (*self.equations, p), self.nonzero | frozenset(nonzero), self.least)

    def replaced(self, equations: Iterable[Polynomial], *, same_ideal: bool) -> _System:
        return replace(self, equations=tuple(equations), macaulay=self.macaulay and same_ideal)


def _refine(system: _System) -> tuple[Component, ...]:
    """Split an ideal by factors of its equations, of its basis, and of eliminants, until it is prime."""
    current().check("decomposition")
    key = replace(system, equations=tuple(dict.fromkeys(system.equations)))
    return remember("decompose", key, lambda: _refined(system))


def _refined(system: _System) -> tuple[Component, ...]:
    factored = factor_equations(system.equations, system.nonzero)
    if factored is None:
        return ()
    # many reducible equations come from a basis: take a new one before branching on the next
    if 0 < sum(len(f) > 1 for f in factored) < 3:
        return _by_factors(system, factored[-1])
    single = tuple(_product(f, system.ring) for f in factored)
    unchanged = {p.primitive() for p in system.equations if p} <= set(single)
    system = system.replaced(single, same_ideal=unchanged)
    substitution = linear_substitution(single)
    if substitution is None:
        return _by_basis(system)
    smaller = system.ring.with_names(n for n in system.ring.names if n != substitution.name)
    nonzero = irreducible_factors(substitution.apply(system.nonzero))
    if nonzero is None:
        return ()
    reduced = tuple(smaller.convert(p) for p in substitution.apply(single))
    forbidden = frozenset(smaller.convert(p) for p in nonzero)
    pieces = _refine(_System(smaller, reduced, forbidden, system.least, system.macaulay))
    return tuple(_lifted(piece, substitution.equation) for piece in pieces)


def _by_factors(system: _System, factors: Sequence[Polynomial]) -> tuple[Component, ...]:
    pieces = [p for i, f in enumerate(factors) for p in _refine(system.plus(f, factors[:i]))]
    return prune(_in_ring(piece, system.ring) for piece in pieces)


def _by_basis(system: _System) -> tuple[Component, ...]:
    ideal = Ideal(system.ring, system.equations)
    basis = ideal.groebner_basis()
    if not basis:
        return (Component(ideal, True, len(system.ring.names), "Cohen-Macaulay"),)
    if basis[0].is_constant:
        return ()
    dimension = len(independent_variables(leading_exponents(basis), len(system.ring.names)))
    if dimension < system.least or any(ideal.contains(p) for p in system.nonzero):
        return ()
    factored = factor_equations(basis, system.nonzero)
    if factored is None:
        return ()
    system = system.replaced(basis, same_ideal=True)
    if len(factored[-1]) > 1:
        return _by_factors(system, factored[-1])
    single = {f[0] for f in factored}
    if not single.issuperset(basis):
        return _refine(system.replaced((*basis, *single), same_ideal=False))
    if linear_substitution(basis) is not None:
        return _refine(system)
    return _by_eliminant(system, Ideal(system.ring, basis, ideal.certainty), dimension)


def _by_eliminant(system: _System, ideal: Ideal, dimension: int) -> tuple[Component, ...]:
    ring, proven = system.ring, ideal.certainty == "proven"
    if len(ideal.generators) == 1:
        return (Component(ideal, proven, dimension, "Cohen-Macaulay"),)
    found = _analysed(ideal, system.macaulay and system.least == dimension)
    if found.factors and not any(ideal.contains(f) for f in found.factors):
        pieces = [_in_ring(p, ring) for f in found.factors for p in _refine(system.plus(f))]
        return prune(pieces)
    if not found.prime and (primes := _by_engine(ideal)):
        return primes
    purity: Purity = "Cohen-Macaulay" if found.macaulay else "unmixed"
    if found.beside is not None and found.beside.is_constant:
        return (Component(ideal, proven and found.prime, dimension, purity),)
    if found.beside is not None and len(found.beside) <= _LONGEST_CUT:
        main = _saturated(ideal, found.beside)
        if main is not None:
            prime = found.prime and main.certainty == "proven"
            component = Component(main, prime, dimension, purity)
            return prune((component, *_smaller(system, ideal, component, found.beside)))
    primes = _by_engine(ideal) if found.prime else ()
    return primes or (Component(ideal, False, dimension),)


def _smaller(system: _System, ideal: Ideal, main: Component, beside: Polynomial) -> Iterator[Component]:
    """Pieces that hold the zeros of an ideal outside its main part, all of them zeros of `beside`."""
    # where the main part has the least dimension, what is smaller lies in other branches
    outside = [g for g in main.generators if not ideal.contains(g)] if main.dimension > system.least else []
    for g in outside:
        rest = _saturated(ideal, g)
        apart = system.plus(beside) if rest is None else system.replaced(rest.generators, same_ideal=False)
        for piece in _refine(apart):
            yield _in_ring(piece, system.ring)
        if rest is None:
            return


def _saturated(ideal: Ideal, polynomial: Polynomial) -> Ideal | None:
    """The ideal of the zeros outside those of a polynomial; None where it is not found soon."""
    with attempt("decomposition", SPLITTING.work):
        return ideal.saturate(polynomial)
    return None


def _analysed(ideal: Ideal, unmixed: bool) -> Splitting:
    with attempt("decomposition", SPLITTING.work):
        return analyse(ideal, macaulay=unmixed)
    # what was known before is no less true
    return Splitting(beside=ideal.ring.one, macaulay=True) if unmixed else Splitting()


def _by_engine(ideal: Ideal) -> tuple[Component, ...]:
    """The minimal primes by Singular where it is present and quick, else nothing."""
    if not engines.has("singular"):
        return ()
    with attempt("decomposition", SPLITTING.work):
        primes = ideal.minimal_primes()
        return prune(Component(p, p.certainty == "proven", p.dimension) for p in primes)
    return ()
