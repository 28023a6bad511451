"""From a unit vector and its length to one vector: fewer variables and lower degrees in proofs.

A leg of length q along (c, s), with c^2 + s^2 = 1, ends at (q c, q s); where q is known not to vanish, the
equations can be written in these, and often q itself can go: a point instead of an angle and a length.
Source: singsym's own; see `vectors` for the map.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import hypot

from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Known, Premises, Verdict
from singsym.elimination.elimination_orders import without_zeros_of
from singsym.elimination.engines import EngineUnavailable
from singsym.elimination.ideal import Ideal
from singsym.elimination.modulo_primes import Residues, residues
from singsym.polynomials import Equations, Polynomial
from singsym.polynomials.short_forms import short_forms
from singsym.polynomials.unit_circles import circle, unit_circles
from singsym.varieties.real.numerical.sampling import is_off, numerical_points
from singsym.varieties.real.proofs.vectors import Vector, open_exclusions, size_of
from singsym.varieties.real.system import RealSystem
from singsym.varieties.splitting import used_ring

LONGEST_SUM = 12
"""Sums of squares with more terms are not used as exclusions."""
CLOSED_POINTS = 20
"""So many numerical points are looked at for the exclusions that matter."""
_NO_POINT = "there is no complex solution"
_NOT_SEEN = Verdict.undecided("that there is no complex solution is not seen at once")


@dataclass(frozen=True)
class Cartesian:
    """A system in the same ring with other meanings of some variables, or as it was where that is simpler.

    Its real points are the images of those of the given system; where not `faithful`, there may be more.  An
    exclusion of several polynomials is that of the zeros of the sum of their squares where this is short.
    """

    system: RealSystem
    vectors: tuple[Vector, ...] = ()
    faithful: bool = True

    @classmethod
    def of(cls, system: RealSystem) -> Cartesian:
        """Vectors as long as they make the equations smaller.

        >>> from singsym.polynomials import Ring
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
        best, size = None, sum(map(size_of, self.system.equations))
        for pair in unit_circles(self.system.equations):
            if pair in used:
                continue
            for length in (group[0] for group in self.system.exclusions if len(group) == 1):
                vector = Vector.of(pair, length, self.system)
                if vector is not None and (other := sum(map(vector.size, self.system.equations))) < size:
                    best, size = vector, other
        if best is None:
            return None
        faithful = self.faithful and best.keeps(self.system.exclusions)
        return Cartesian(best.applied(self.system), (*self.vectors, best), faithful)

    def moved(self, polynomial: Polynomial) -> Equations:
        """Polynomials that all vanish on the image of a set exactly if the given one vanishes on the set."""
        parts: Equations = (polynomial,)
        for vector in self.vectors:
            parts = vector.all_parts(parts)
        return parts

    def before(self, point: Sequence[float]) -> tuple[float, ...]:
        """A point of the given system near one of this, numerically; lengths that are left out are positive.

        >>> from singsym.polynomials import Ring
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
    def _needed(self) -> tuple[Equations, ...]:
        """Exclusions that leave out all numerical points of the closed set that are left out at all.

        Such of single polynomials come first.
        """
        single = [(p,) for p in _nonconstant(self.system.nonzero)]
        several = [group for group in self.system.exclusions if len(group) > 1]
        closed = replace(self.system, exclusions=(), positive=(), nonnegative=())
        points = numerical_points(closed, CLOSED_POINTS)
        chosen: list[Equations] = []
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

    def _off(self, nonzero: Equations) -> Ideal:
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

        >>> from singsym.polynomials import Ring
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

        >>> from singsym.polynomials import Ring
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
    excluded: tuple[Equations, ...]

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


def _nonconstant(polynomials: Equations) -> Equations:
    return tuple(p for p in dict.fromkeys(polynomials) if not p.is_constant)


def _vanish_on(ideal: Ideal, polynomials: Equations) -> Known[bool]:
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


def _short_exclusions(system: RealSystem) -> tuple[Equations, ...]:
    """Short exclusions of several polynomials as those of their squares' sum, factor by factor."""
    groups: list[Equations] = []
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
    return open_exclusions(groups, system.ring)
