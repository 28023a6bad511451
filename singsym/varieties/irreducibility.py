"""Proving that an ideal is prime over Q, or finding polynomials along which its variety splits.

Source: G.-M. Greuel, G. Pfister, "A Singular Introduction to Commutative Algebra", §4.2-4.3 (reduction to
dimension zero over independent variables); the lemmas at the functions make it exact at one rational fibre.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations_with_replacement, islice
from math import comb
from random import Random

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz_mat, nmod_mat, nmod_poly

from singsym.effort import chance
from singsym.effort.budget import current
from singsym.effort.verdict import Known, Premises
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Exponents, Polynomial, Ring
from singsym.varieties.real.points.quotient_algebra import Algebra, quotient_algebra, standard_monomials
from singsym.varieties.torsion import NormalForms, off_free, presentation, torsion_support

_LARGEST_FIBRE = 120
_LARGEST_SEARCH = 330
_PRIMES = 8
"""Modulo so many primes polynomials are factored at most, to see them irreducible over Q."""


@dataclass(frozen=True)
class Splitting:
    """What was found: V(I) is the union of the V(I + factor), or the following is known of I, or nothing.

    prime: V(I) has one component of full dimension over Q, and I is radical along it.
    beside: a polynomial that vanishes on no component of full dimension, but on all smaller and on all
    embedded ones; 1 where there are none: then I is unmixed, and prime where `prime`.
    macaulay: I : beside^oo is Cohen-Macaulay; otherwise it is unmixed.
    """

    factors: tuple[Polynomial, ...] = ()
    prime: bool = False
    beside: Polynomial | None = None
    macaulay: bool = False


def leading_exponents(basis: Sequence[Polynomial]) -> list[Exponents]:
    """The exponents of the leading terms."""
    return [p.leading_term[0] for p in basis]


def independent_variables(leads: Sequence[Exponents], count: int) -> tuple[int, ...]:
    """Largest set of variables (indices) with no power product among the leading monomials' multiples.

    Their number is the dimension of the ideal; variables without a pure power are preferred.

    >>> independent_variables([(2, 0, 0), (1, 1, 0)], 3)
    (1, 2)
    """
    supports = {frozenset(i for i, e in enumerate(m) if e) for m in leads}
    minimal = [s for s in supports if not any(t < s for t in supports)]
    pure = {i for s in minimal if len(s) == 1 for i in s}
    free = [i for i in range(count) if i not in pure]
    left_out = _smallest_cover([s - pure for s in minimal if len(s) > 1 and s.isdisjoint(pure)])
    return tuple(i for i in free if i not in left_out)


def _smallest_cover(supports: list[frozenset[int]]) -> frozenset[int]:
    """A smallest set of indices that meets all supports, by branch and bound."""
    best = frozenset[int]().union(*supports)

    def search(left: list[frozenset[int]], chosen: frozenset[int]) -> None:
        nonlocal best
        if not left:
            best = chosen if len(chosen) < len(best) else best
        elif len(chosen) + 1 < len(best):
            for i in sorted(sorted(left, key=len)[0]):
                search([s for s in left if i not in s], chosen | {i})

    search(supports, frozenset())
    return best


@dataclass(frozen=True)
class Coordinates:
    """An ideal in coordinates in which the last `dimension` variables are independent.

    `back` maps a polynomial of these coordinates to the original ring through `images`.
    """

    ring: Ring
    basis: tuple[Polynomial, ...]
    dimension: int
    original: Ring
    images: tuple[tuple[str, Polynomial], ...] = ()

    def back(self, p: Polynomial) -> Polynomial:
        """A polynomial of these coordinates in the original ones."""
        return self.original.convert(p).substitute(dict(self.images))

    @property
    def split(self) -> int:
        """The number of dependent variables, which come first."""
        return len(self.ring.names) - self.dimension

    @property
    def is_finite(self) -> bool:
        """Whether Q[x]/I is a finite module over Q[u]: every dependent variable has a pure power."""
        leads = leading_exponents(self.basis)
        return all(any(m[i] and not any(m[:i] + m[i + 1 :]) for m in leads) for i in range(self.split))

    @property
    def is_free(self) -> bool:
        """Whether no leading monomial involves u; with finiteness the module is free, hence I unmixed."""
        return not any(any(m[self.split :]) for m in leading_exponents(self.basis))


def coordinates(ideal: Ideal, rng: Random) -> Iterator[Known[Coordinates]]:
    """The ideal in its own coordinates, independent variables last, then after small linear changes."""
    ring, premises = ideal.ring, Premises()
    basis = premises.take(ideal.groebner_basis())
    chosen = independent_variables(leading_exponents(basis), len(ring.names))
    last = tuple(ring.names[i] for i in chosen)
    dependent = tuple(n for n in ring.names if n not in last)
    turned = Ring(dependent + last, "degrevlex", ring.constants)
    if turned.names != ring.names:
        basis = premises.take(Ideal(turned, tuple(turned.convert(p) for p in basis)).groebner_basis())
    yield premises.conclude(Coordinates(turned, basis, len(last), ring))
    if not last:
        return
    constants = {c.name for c in ring.constants}
    movable = [n for n in dependent if n not in constants]
    for _ in range(2):
        shift = {
            u: sum((turned.gen(n) * rng.choice((-1, 1, 2)) for n in movable), start=turned.zero) for u in last
        }
        there = {u: turned.gen(u) + s for u, s in shift.items()}
        changed = premises.take(Ideal(turned, tuple(p.substitute(there) for p in basis)).groebner_basis())
        images = tuple((u, ring.convert(turned.gen(u) - s)) for u, s in shift.items())
        yield premises.conclude(Coordinates(turned, changed, len(last), ring, images))


def analyse(ideal: Ideal, *, macaulay: bool = False, seed: int = 0) -> Known[Splitting]:
    """Prove an ideal prime over Q, or split its variety, or find what is beside its main part, or nothing.

    macaulay: whether the ideal is known to be Cohen-Macaulay.

    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> analyse(Ideal(x.ring, (x**2 - 2, y**2 - 2, z))).value.factors
    (x - y, x*y + 2)
    >>> analyse(Ideal(x.ring, (x**2 - 2, y**2 - 3, z))).value.prime
    True
    >>> any(analyse(Ideal(x.ring, (x * z, y * z)), seed=k).value.beside for k in range(4))
    True
    """
    rng = chance.random("splitting", seed)
    best = Splitting(beside=ideal.ring.one, macaulay=True) if macaulay else Splitting()
    premises = Premises()
    for known in coordinates(ideal, rng):
        current().check("decomposition")
        place = premises.take(known)
        found = premises.take(_at_fibre(place, rng))
        if found.factors:
            return premises.conclude(Splitting(tuple(place.back(f).primitive() for f in found.factors)))
        best = replace(best, prime=best.prime or found.prime)
        if best.beside is None and place.is_finite:
            best = replace(best, beside=_beside(place, rng), macaulay=place.is_free or place.dimension == 1)
        if best.prime and best.beside is not None:
            break
    return premises.conclude(best)


def _beside(place: Coordinates, rng: Random) -> Polynomial | None:
    """A polynomial in u that vanishes where the finite module Q[x]/I over Q[u] has torsion; 1 without any.

    Off its zeros the module is torsion-free, so that I is unmixed there; along a curve it is free.
    """
    if place.is_free:
        return place.original.one
    leads = [m[: place.split] for m in leading_exponents(place.basis) if not any(m[place.split :])]
    within = standard_monomials(leads, place.split)
    if place.dimension > 1:
        found = off_free(place.ring, place.basis, within)
        return None if found is None else place.back(found)
    module = presentation(place.ring, place.basis, within)
    if module is None:
        return None
    product, u = place.original.one, place.back(place.ring.gens[-1])
    for coefficients in torsion_support(module, rng):
        factor = place.original.zero
        for c in reversed(coefficients):
            current().check("decomposition")
            factor = factor * u + c
        product *= factor
    return product


def _at_fibre(place: Coordinates, rng: Random) -> Known[Splitting]:
    """One rational fibre u = u0.

    Lemma: if Q[x]/I is finite over Q[u], u is independent modulo I and the algebra of one fibre is a field
    Q(l), then near u0 the module is generated by powers of l (Nakayama) and is Q[u][l]/(m), m irreducible
    as it is so at u0: one component dominates u-space, and it is reduced there.  Where Q[x]/I is finite over
    Q[u], u is independent (as many variables as the dimension), and all components of full dimension
    dominate u-space.
    """
    ring = place.ring
    inner = ring.with_names(ring.names[: place.split])
    if not inner.names:
        return Known(Splitting(prime=True))
    premises = Premises()
    for attempt in range(2):
        values = {
            u: fmpq(rng.randint(2, 9 + 20 * attempt), rng.choice((1, 1, 2)))
            for u in ring.names[place.split :]
        }
        special = tuple(inner.convert(p.substitute(values)) for p in place.basis)
        basis = premises.take(Ideal(inner, tuple(p for p in special if p)).groebner_basis())
        if len(independent_variables(leading_exponents(basis), len(inner.names))) or basis[0].is_constant:
            continue
        if len(standard_monomials(leading_exponents(basis), len(inner.names))) > _LARGEST_FIBRE:
            return premises.conclude(Splitting())
        fibre = quotient_algebra(inner, basis, partial(current().check, "decomposition"))
        may_be_field = True
        for count, form in enumerate(_forms(inner, rng)):
            current().check("decomposition")
            action = _action(fibre, form)
            degree = next(_residues(action)).degree()
            generates = degree == fibre.dimension
            if generates and may_be_field:
                irreducible = _is_irreducible(action)
                if irreducible:
                    return premises.conclude(Splitting(prime=place.is_finite))
                may_be_field = irreducible is None
            if not (generates and may_be_field) and not (count and _is_liftable(place, degree)):
                continue
            factors = action.minpoly().factor()[1]
            if len(factors) == 1 and factors[0][1] == 1:
                if generates:
                    return premises.conclude(Splitting(prime=place.is_finite))
                continue
            may_be_field = may_be_field and not generates
            if not count:
                continue  # a simpler form gives simpler factors
            pieces = _lift(place, ring.convert(form), factors)
            if pieces:
                return premises.conclude(Splitting(pieces))
    return premises.conclude(Splitting())


def _action(fibre: Algebra, form: Polynomial) -> fmpq_mat:
    """Multiplication by a linear form."""
    matrix = fmpq_mat(fibre.dimension, fibre.dimension)
    for exponents, c in form.terms():
        matrix += fibre.matrices[exponents.index(1)] * c
    return matrix


def _residues(action: fmpq_mat) -> Iterator[nmod_poly]:
    """The minimal polynomials modulo random primes: none is of a larger degree than the one over Q."""
    whole, denominator = action.numer_denom()
    for prime in chance.random_primes("fibres", bits=62, avoiding=(int(denominator),)):
        yield (nmod_mat(whole, prime) * pow(int(denominator), -1, prime)).minpoly()


def _is_irreducible(action: fmpq_mat) -> bool | None:
    """Whether the characteristic polynomial is irreducible over Q: by degrees of factors modulo primes.

    Lemma: where it is a product over Q, its factors are such modulo a prime that divides no denominator
    (Gauss), so that their degrees are sums of degrees of irreducible factors there.
    False, which proves nothing: it seems to have a double root.
    """
    size = action.nrows()
    common = set(range(1, size))
    for residue in islice(_residues(action), _PRIMES):
        factors = residue.factor()[1]
        if residue.degree() < size or any(power > 1 for _, power in factors):
            return False
        sums = {0}
        for factor, _ in factors:
            sums |= {known + factor.degree() for known in sums}
        common &= sums
        if not common:
            return True
    return None


def _forms(ring: Ring, rng: Random) -> Iterator[Polynomial]:
    """A random linear form (which separates points), then simple ones."""

    def mixed(width: int) -> Polynomial:
        return sum((g * rng.randint(-width, width) for g in ring.gens), start=ring.gens[-1])

    yield mixed(3)
    yield from ring.gens
    yield from (a - b for a, b in zip(ring.gens, ring.gens[1:], strict=False))
    yield mixed(9)


def _lift(
    place: Coordinates, form: Polynomial, factors: Sequence[tuple[fmpq_poly, int]]
) -> tuple[Polynomial, ...]:
    """Turn the factors of a form's minimal polynomial in a fibre into factors over Q[u], if there are any.

    The eliminant of (u, form) is a multiple of every splitting; each of its factors is irreducible over Q.
    """
    if not place.dimension:
        constant = place.ring.constant
        return tuple(_value([constant(c) for c in f.coeffs()], form, place) for f, _ in factors)
    least = sum(f.degree() * power for f, power in factors)
    eliminant = relation(place.basis, (*place.ring.gens[place.split :], form), least)
    if eliminant is None:
        return ()
    pieces = eliminant.factors()
    if len(pieces) == 1 and pieces[0][1] == 1:
        return ()
    return tuple(_value(_coefficients(p, place), form, place) for p, _ in pieces)


def _coefficients(p: Polynomial, place: Coordinates) -> list[Polynomial]:
    """The coefficients of a polynomial in (u, l) as one in l, the lowest first, in the ring of the place."""
    zeros = (0,) * place.split
    table: dict[int, dict[Exponents, fmpq]] = {}
    for m, c in p.terms():
        table.setdefault(m[-1], {})[(*zeros, *m[:-1])] = c
    return [place.ring.from_dict(table.get(i, {})) for i in range(max(table) + 1)]


def _value(coefficients: Sequence[Polynomial], form: Polynomial, place: Coordinates) -> Polynomial:
    """A polynomial in one variable at a linear form, modulo the ideal: the expanded powers would be long."""
    forms = NormalForms(place.ring, place.basis)
    value = place.ring.zero
    for c in reversed(coefficients):
        current().check("decomposition")
        value = forms.reduce(value * form + c)
    return value


def _is_liftable(place: Coordinates, least: int) -> bool:
    """Whether `_lift` would look for factors where a form's minimal polynomial has such a degree at least."""
    return not place.dimension or _is_searched(place.dimension + 1, least)


def _is_searched(count: int, degree: int) -> bool:
    return comb(degree + count, count) <= _LARGEST_SEARCH


def relation(basis: Sequence[Polynomial], forms: Sequence[Polynomial], least: int = 1) -> Polynomial | None:
    """The polynomial of least total degree that vanishes on `forms` modulo a Groebner basis, or None.

    least: a degree that it has at least.  None where it is too large.  Where the relations are a principal
    ideal it generates them.  It lives in a ring t0, t1, ... of its own.

    >>> x, y = Ring(("x", "y")).gens
    >>> relation((x**2 + y**2 - 1,), (x + y, x - y))
    t0^2 + t1^2 - 2
    """
    ring = basis[0].ring
    forms_modulo = NormalForms(ring, basis)
    own = Ring(tuple(f"t{i}" for i in range(len(forms))))
    exponents: list[Exponents] = [(0,) * len(forms)]
    values = {exponents[0]: ring.one}
    degree = 0
    while _is_searched(len(forms), max(degree + 1, least)):
        degree += 1
        for chosen in combinations_with_replacement(range(len(forms)), degree):
            current().check("relation")
            m = tuple(chosen.count(i) for i in range(len(forms)))
            i = chosen[-1]
            values[m] = forms_modulo.reduce(values[(*m[:i], m[i] - 1, *m[i + 1 :])] * forms[i])
            exponents.append(m)
        found = _dependency([values[m] for m in exponents]) if degree >= least else None
        if found is not None:
            return own.from_dict({m: c for m, c in zip(exponents, found, strict=True) if c}).primitive()
    return None


def _dependency(rows: Sequence[Polynomial]) -> list[fmpq] | None:
    """A linear relation over Q between polynomials, or None."""
    monomials = sorted({m for p in rows for m, _ in p.terms()})
    position = {m: j for j, m in enumerate(monomials)}
    if len(monomials) >= len(rows) and _independent_modulo_prime(rows, position):
        return None
    scales, columns = [], [[0] * len(rows) for _ in monomials]
    for i, p in enumerate(rows):
        whole = p.integer().to_dict() if p else {}
        scales.append(fmpq(whole[p.leading_term[0]]) / p.leading_term[1] if p else fmpq(1))
        for m, c in whole.items():
            columns[position[m]][i] = int(c)
    kernel, nullity = fmpz_mat(columns).nullspace()
    if not nullity:
        return None
    return [fmpq(kernel[i, 0]) * scales[i] for i in range(len(rows))]


def _independent_modulo_prime(rows: Sequence[Polynomial], position: dict[Exponents, int]) -> bool:
    prime = chance.sparing_prime()
    table = [0] * (len(rows) * len(position))
    for i, p in enumerate(rows):
        if not p:
            return False
        for m, c in p.integer().to_dict().items():
            table[i * len(position) + position[m]] = int(c) % prime
    return bool(nmod_mat(len(rows), len(position), table, prime).rank() == len(rows))
