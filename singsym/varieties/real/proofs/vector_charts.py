"""From a unit vector and its length to one vector: fewer variables and lower degrees in proofs.

A leg of length q along (c, s), with c^2 + s^2 = 1, ends at (q c, q s); where q is known not to vanish, the
equations can be written in these, and often q itself can go: a point instead of an angle and a length.
Source: singsym's own; the map is a quotient by the reflection (c, s, q) -> (-c, -s, -q).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from math import hypot

from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Known, Premises, Verdict
from singsym.elimination.elimination_orders import without_zeros_of
from singsym.elimination.engines import EngineUnavailable
from singsym.elimination.ideal import Ideal
from singsym.elimination.linear_substitution import shortest_substitution
from singsym.elimination.modulo_primes import Residues, residues
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.remainders import remainder
from singsym.polynomials.short_forms import short_forms
from singsym.polynomials.unit_circles import Pair, circle, unit_circles
from singsym.varieties.real.numerical.sampling import is_off, numerical_points
from singsym.varieties.real.system import RealSystem
from singsym.varieties.splitting import used_ring

LONGEST_SUM = 12
"""Sums of squares with more terms are not used as exclusions."""
CLOSED_POINTS = 20
"""So many numerical points are looked at for the exclusions that matter."""
Group = tuple[Polynomial, ...]
_NO_POINT = "there is no complex solution"
_NOT_SEEN = Verdict.undecided("that there is no complex solution is not seen at once")


@dataclass(frozen=True)
class Cartesian:
    """A system in the same ring with other meanings of some variables, or as it was where that is simpler.

    Its real points are the images of those of the given system; where not `faithful`, there may be more.  An
    exclusion of several polynomials is that of the zeros of the sum of their squares where this is short.
    """

    system: RealSystem
    vectors: tuple[_Vector, ...] = ()
    faithful: bool = True

    @classmethod
    def of(cls, system: RealSystem) -> Cartesian:
        """Vectors as long as they make the equations smaller.

        >>> R = Ring(("c", "s", "q", "w"))
        >>> c, s, q, w = R.gens
        >>> leg = RealSystem(R, (c**2 + s**2 - 1, q**2 + w**2 - 1, 2 * s * q + w), exclusions=((q,),))
        >>> Cartesian.of(leg).system.equations
        (c^2 + s^2 + w^2 - 1, 2*s + w)
        """
        found = cls(replace(system, exclusions=_short_exclusions(system)))
        while (simpler := found._simpler()) is not None:
            found = simpler
        return found

    def _simpler(self) -> Cartesian | None:
        used = [vector.pair for vector in self.vectors]
        best, size = None, sum(map(_size, self.system.equations))
        for pair in unit_circles(self.system.equations):
            if pair in used:
                continue
            for length in (group[0] for group in self.system.exclusions if len(group) == 1):
                vector = _Vector.of(pair, length, self.system)
                if vector is not None and (other := sum(map(vector.size, self.system.equations))) < size:
                    best, size = vector, other
        if best is None:
            return None
        faithful = self.faithful and best.keeps(self.system.exclusions)
        return Cartesian(best.applied(self.system), (*self.vectors, best), faithful)

    def moved(self, polynomial: Polynomial) -> Group:
        """Polynomials that all vanish on the image of a set exactly if the given one vanishes on the set."""
        parts: Group = (polynomial,)
        for vector in self.vectors:
            parts = vector.all_parts(parts)
        return parts

    def before(self, point: Sequence[float]) -> tuple[float, ...]:
        """A point of the given system near one of this, numerically; lengths that are left out are positive.

        >>> R = Ring(("c", "s", "q", "w"))
        >>> c, s, q, w = R.gens
        >>> leg = RealSystem(R, (c**2 + s**2 - 1, q**2 + w**2 - 1, 2 * s * q + w), exclusions=((q,),))
        >>> Cartesian.of(leg).before((3.0, 4.0, 0.0, 0.5))
        (0.6, 0.8, 5.0, 0.5)
        """
        found = list(point)
        for vector in reversed(self.vectors):
            c, s, k = (self.system.ring.index(name) for name in (*vector.pair, vector.length))
            if vector.relation is not None:
                found[k] = hypot(found[c], found[s])
            if found[k]:
                found[c], found[s] = found[c] / found[k], found[s] / found[k]
            found[k] = vector.put.evaluate(found)
        return tuple(found)

    @cached_property
    def _needed(self) -> tuple[Group, ...]:
        """Exclusions that leave out all numerical points of the closed set that are left out at all.

        Such of single polynomials come first.
        """
        single = [(p,) for p in _nonconstant(self.system.nonzero)]
        several = [group for group in self.system.exclusions if len(group) > 1]
        closed = replace(self.system, exclusions=(), positive=(), nonnegative=())
        points = numerical_points(closed, CLOSED_POINTS)
        chosen: list[Group] = []
        for groups in (single, several):
            while points:
                reached = [sum(not is_off(x, group) for x in points) for group in groups]
                most = max(reached, default=0)
                if not most:
                    break
                best = groups[reached.index(most)]
                chosen.append(best)
                points = tuple(x for x in points if is_off(x, best))
        return tuple(chosen)

    @cached_property
    def _ideals(self) -> tuple[Ideal, ...]:
        """The zeros off the single exclusions that are needed, and off all of them."""
        needed = tuple(group[0] for group in self._needed if len(group) == 1)
        return tuple(map(self._off, dict.fromkeys((needed, _nonconstant(self.system.nonzero)))))

    def _off(self, nonzero: Group) -> Ideal:
        """The equations with a variable for the inverse of each of some polynomials (Rabinowitsch 1929)."""
        return Ideal(*without_zeros_of(self.system.ring, self.system.closed_equations, *nonzero))

    def based(self, seconds: float) -> tuple[Ideal, ...]:
        """Those of the ideals whose Groebner bases are found in so many seconds."""
        found: list[Ideal] = []
        with attempt("bases that hold polynomials", seconds):
            for ideal in self._ideals:
                ideal.groebner_basis()
                found.append(ideal)
        return tuple(found)

    def vanishes(self, polynomial: Polynomial, ideals: tuple[Ideal, ...]) -> Verdict:
        """Whether a polynomial of the given variables is zero wherever the system holds: yes or undecided."""
        moved = self.moved(polynomial)
        for ideal in ideals:
            inside = ideal.contains(Ideal(ideal.ring, map(ideal.ring.convert, moved)))
            if inside.value:
                return Verdict.yes(inside.certainty, reason="it is in the ideal")
        return Verdict.undecided("it is in no ideal whose basis is known")

    def is_empty(self, seconds: float | None = None) -> Verdict:
        """Whether not even complex points are left: yes, or undecided where that is not seen at once.

        A part may be excluded as a whole: all polynomials of an exclusion vanish on it.  Raises `Undecided`.
        seconds: so long a proof over Q is waited for; then what holds modulo a prime will do.

        >>> R = Ring(("x", "y"))
        >>> x, y = R.gens
        >>> Cartesian.of(RealSystem(R, (x * y,), exclusions=((x, x * y), (y,)))).is_empty().is_yes
        True
        """
        if any(p.is_zero for p in self.system.nonzero):
            return Verdict.yes(reason="everything is excluded")
        for ideal in self._ideals:
            verdict = self._is_off(ideal, seconds)
            if verdict.is_yes:
                return verdict
        return _NOT_SEEN

    def _is_off(self, ideal: Ideal, seconds: float | None) -> Verdict:
        """Whether an ideal has no zero, or none off some exclusion; first modulo a prime.

        Without a proof it takes several primes, modulo which it is so in one and the same way.
        """
        suspected = _Suspected(True, tuple(tuple(map(ideal.ring.convert, g)) for g in self.system.exclusions))
        primes = residues(ideal, (p for group in suspected.excluded for p in group))
        what = "a proof that there is no complex point"
        try:
            suspected = suspected.modulo(next(primes))
        except EngineUnavailable:
            seconds = None
        except Undecided:
            current().check(what)
            return _NOT_SEEN
        if suspected.is_nothing:
            return _NOT_SEEN
        with attempt(what, seconds):
            return suspected.over_rationals(ideal)
        if seconds is None:
            return _NOT_SEEN
        with attempt(what):
            for residue in primes:
                suspected = suspected.modulo(residue)
            if not suspected.is_nothing:
                return Verdict.yes("modular", reason=_NO_POINT)
        return _NOT_SEEN

    @property
    def left_out(self) -> int:
        """How many lengths are left out; their variables are in no equation any more."""
        return sum(vector.relation is not None for vector in self.vectors)

    @property
    def trimmed(self) -> RealSystem:
        """A projection to fewer coordinates: those left out are in one equation only, squared.

        There x^2 + ... = f has real solutions exactly if f >= 0.  Only exclusions that seem to be needed are
        kept, so there may be more points.

        >>> R = Ring(("x", "y", "z"))
        >>> x, y, z = R.gens
        >>> Cartesian(RealSystem(R, (x**2 + y**2 + z - 1, z**2 - 2))).trimmed
        RealSystem(ring=Q[z], equations=(z^2 - 2,), exclusions=(), positive=(), nonnegative=(-z + 1,))
        """
        system = self.system
        exclusions = tuple(group for group in self._needed if group[0] not in system.positive)
        groups = (system.equations, system.positive, system.nonnegative, *exclusions)
        uses = Counter(name for group in groups for p in group for name in p.variables)
        equations, nonnegative = [], list(system.nonnegative)
        for p in system.equations:
            rest = _without_squares(p, {n for n in p.variables if uses[n] == 1})
            if rest is None:
                equations.append(p)
            elif not rest.is_constant or rest.constant < 0:
                nonnegative.append(rest)
        kept = (*equations, *nonnegative, *system.positive, *(g for group in exclusions for g in group))
        ring = used_ring(system.ring, (*kept, *system.ring.relations))
        convert = ring.convert
        return RealSystem(
            ring,
            tuple(map(convert, equations)),
            tuple(tuple(map(convert, group)) for group in exclusions),
            tuple(map(convert, system.positive)),
            tuple(map(convert, nonnegative)),
        )


@dataclass(frozen=True)
class _Suspected:
    """How there may be no zero of an ideal left: it has none, or all polynomials of an exclusion vanish."""

    unit: bool
    excluded: tuple[Group, ...]

    @property
    def is_nothing(self) -> bool:
        return not self.unit and not self.excluded

    def modulo(self, residue: Residues) -> _Suspected:
        """What is so modulo a prime, too."""
        kept = self.excluded if residue.is_unit else tuple(filter(residue.contain, self.excluded))
        return _Suspected(self.unit and residue.is_unit, kept)

    def over_rationals(self, ideal: Ideal) -> Verdict:
        """Whether one of them is so over Q: yes, or undecided."""
        if self.unit and (unit := ideal.is_unit()).value:
            return Verdict.yes(unit.certainty, reason=_NO_POINT)
        for group in self.excluded:
            if (vanish := _vanish_on(ideal, group)).value:
                return Verdict.yes(vanish.certainty, reason=_NO_POINT)
        return _NOT_SEEN


def _without_squares(p: Polynomial, private: set[str]) -> Polynomial | None:
    """f where p = 0 says that a sum of squares of the private variables is f; None where it does not."""
    places = [i for i, name in enumerate(p.ring.names) if name in private]
    own = {m: c for m, c in p.terms() if any(m[i] for i in places)}
    if not own or any(sum(m) != 2 or max(m) != 2 for m in own) or len({c > 0 for c in own.values()}) > 1:
        return None
    rest = p - p.ring.from_dict(own)
    return -rest if next(iter(own.values())) > 0 else rest


def _nonconstant(polynomials: Group) -> Group:
    return tuple(p for p in dict.fromkeys(polynomials) if not p.is_constant)


def _vanish_on(ideal: Ideal, polynomials: Group) -> Known[bool]:
    """Whether polynomials vanish on all zeros: members of the ideal, or 1 = t p without a solution.

    Half of the time is for the first way, which takes one Groebner basis over Q for all.
    """
    known, premises = False, Premises()
    with attempt("a proof that polynomials vanish", share=0.5):
        known = ideal.groebner_basis().is_proven
    for p in polynomials:
        if known and ideal.contains(p).value:
            continue
        off = Ideal(*without_zeros_of(ideal.ring, ideal.generators, p))
        if not premises.take(off.is_unit()):
            return premises.conclude(False)
    return premises.conclude(True)


def _size(p: Polynomial) -> int:
    """The sum of the degrees of its terms."""
    return sum(map(sum, p.value.monoms()))


def _short_exclusions(system: RealSystem) -> tuple[Group, ...]:
    """Short exclusions of several polynomials as those of their squares' sum, factor by factor."""
    groups: list[Group] = []
    circles = tuple(circle(*map(system.ring.gen, pair)) for pair in unit_circles(system.equations))
    for group in system.exclusions:
        total = group[0] if group else system.ring.zero
        if len(group) > 1 and sum(map(len, group)) <= LONGEST_SUM:
            total = sum((g * g for g in group), start=system.ring.zero)
            total = short_forms(system.ring, circles).normal_form(total)
        if total and len(total) <= LONGEST_SUM and (len(group) == 1 or total is not group[0]):
            groups += [(factor,) for factor, _ in total.factors()]
        else:
            groups.append(group)
    return _open(groups, system.ring)


def _open(groups: Iterable[Group], ring: Ring) -> tuple[Group, ...]:
    """Exclusions without those of nothing; (0,) where everything is excluded."""
    kept = (tuple(g for g in group if g) or (ring.zero,) for group in groups)
    return tuple(dict.fromkeys(g for g in kept if not any(p.is_constant and p for p in g)))


@dataclass(frozen=True)
class _Vector:
    """New meanings: of `length`, that of the vector; of `pair`, the unit vector times the length.

    put: the former variable in terms of the length; relation: length^2 + w^2 - 1 where the length is left
    out by it.
    """

    pair: Pair
    length: str
    put: Polynomial
    relation: Polynomial | None = None

    @classmethod
    def of(cls, pair: Pair, length: Polynomial, system: RealSystem) -> _Vector | None:
        if set(pair) & set(length.variables) or (solved := shortest_substitution((length,))) is None:
            return None
        lead = length.coefficient(solved.name, 1).constant
        vector = cls(pair, solved.name, solved.value + length.ring.gen(solved.name) / lead)
        changed = [vector._changed(p) for p in system.equations if len(p) == 3 or not vector._renames(p)]
        for other in (other for other in unit_circles(changed) if vector.length in other):
            short = replace(vector, relation=circle(*map(length.ring.gen, other)))
            signs = (vector._changed(p, even=True) for p in (*system.positive, *system.nonnegative))
            if all(len(short.parts(p)) <= 1 for p in system.equations) and not any(
                vector.length in short._reduced(p).variables for p in signs
            ):
                return short
        return vector

    def applied(self, system: RealSystem) -> RealSystem:
        groups = list(map(self.all_parts, system.exclusions))
        length = system.ring.gen(self.length)
        square = length if self.relation is None else 1 - (self.relation + 1 - length**2)
        groups += [(factor,) for factor, _ in square.factors()]
        positive, nonnegative = (
            tuple(self._reduced(self._changed(p, even=True)) for p in signs)
            for signs in (system.positive, system.nonnegative)
        )
        return RealSystem(
            system.ring,
            self.all_parts(system.equations),
            _open(groups, system.ring),
            positive,
            nonnegative,
        )

    def keeps(self, groups: Iterable[Group]) -> bool:
        """Whether exclusions are the same for both vectors of a length that is left out."""
        return all(len(self.parts(g)) <= 1 for group in groups for g in group)

    def size(self, p: Polynomial) -> int:
        """The sum of the degrees of the terms of the parts of a polynomial."""
        if self.relation is None and self._renames(p):
            return _size_in_vector(p, self.pair, self.length)
        return sum(map(_size, self.parts(p)))

    def all_parts(self, group: Group) -> Group:
        """The parts of several polynomials."""
        return tuple(q for p in group for q in self.parts(p))

    def parts(self, p: Polynomial) -> Group:
        """The polynomial in the new variables; two parts where it holds odd powers of a length left out."""
        changed = self._reduced(self._changed(p))
        if not changed:
            return ()
        if self.relation is None:
            return (changed,)
        even, odd = (changed.coefficient(self.length, k) for k in (0, 1))
        return tuple(q for q in (even, odd) if q)

    def _renames(self, p: Polynomial) -> bool:
        """Whether each term of a polynomial becomes one: nothing is put in for the length there."""
        k = p.ring.index(self.length)
        return p.degrees[k] <= 0 or self.put == p.ring.gens[k]

    def _reduced(self, p: Polynomial) -> Polynomial:
        return p if self.relation is None else remainder(p, self.relation, self.length)

    def _changed(self, p: Polynomial, even: bool = False) -> Polynomial:
        return _in_vector(p, self.pair, self.length, self.put, even)


@lru_cache(maxsize=2**15)
def _size_in_vector(p: Polynomial, pair: Pair, length: str) -> int:
    """The sum of the degrees of the terms of `_in_vector` where nothing is put in for the length."""
    k, i, j = map(p.ring.index, (length, *pair))
    monomials = p.value.monoms()
    shift = max((m[i] + m[j] - m[k] for m in monomials), default=0)
    return sum(sum(m) - m[i] - m[j] + shift for m in monomials)


@lru_cache(maxsize=2**15)
def _in_vector(p: Polynomial, pair: Pair, length: str, put: Polynomial, even: bool) -> Polynomial:
    """A polynomial times a power of a length, in the variables of a vector; an even power where asked for."""
    ring = p.ring
    k, places = ring.index(length), tuple(map(ring.index, pair))
    degrees = p.degrees
    if all(degrees[i] <= 0 for i in (k, *places)):
        return p
    if degrees[k] > 0 and put != ring.gens[k]:
        p = p.substitute({length: put})
        if p.is_zero:
            return p
    terms = p.terms()
    powers = [m[k] - sum(m[i] for i in places) for m, _ in terms]
    shift = -min(powers)
    shift += shift % 2 if even else 0
    moved = {(*m[:k], power + shift, *m[k + 1 :]): c for (m, c), power in zip(terms, powers, strict=True)}
    return ring.from_dict(moved)
