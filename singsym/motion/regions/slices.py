"""Curves in a surface of configurations, of which each region meets one: slices at values of an input.

Lemma: let V be the real zeros of m - 2 equations in m variables, bounded within limits, in which the Jacobian
determinant D of the equations and both inputs has no zero off the borders; let h be an input, and U a region.
Let S hold the values of h wherever on V (a) two borders meet, (b) one border g vanishes together with the
Jacobian determinant of the equations, g and h, (c) all polynomials of a hole vanish.  Then between two
neighbours in S the values of h in U are all or none, and some are there; so U meets a slice h = t with one t
from each interval, and as U is open in V, it holds a whole piece of that slice between borders, an arc.
Proof: D has no zero in U, so h is open there, and its values are an open set that is not empty.  Let t be an
end of it, not in S.  By compactness there is p in the closure of U with h(p) = t, not in U as h is open
there.  So p is on a border, for where none vanishes a neighbourhood of p in V is in U; by (a) and (c) on one
border g and in no hole.  By (b) V is a surface at p with g and h as coordinates, and h maps each of the two
sides of g near p onto an interval around t.  One of them is in U, so that t is no end.
Source: singsym's own, after the slices of a cylindrical decomposition, Collins (1975), and of roadmaps,
Canny, The Complexity of Robot Motion Planning (1988).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property, reduce
from itertools import combinations

from flint import arb

from singsym.designs.line import roots, samples
from singsym.effort.budget import Undecided
from singsym.effort.verdict import Certainty, Premises
from singsym.elimination.ideal import Ideal
from singsym.kinematics.placement import ConfigurationSpace
from singsym.minors.determinant import determinant
from singsym.motion.coordinates import Coordinates
from singsym.motion.drives import DrivenSystem, driven_system
from singsym.motion.regions.borders import Borders
from singsym.polynomials import Equations, Polynomial, PolynomialMatrix, Ring
from singsym.polynomials.compiled_map import CompiledMap, Floats
from singsym.polynomials.unit_circles import half_angle_point
from singsym.varieties.real.curves.critical_points import is_bounded

_HALF_ANGLE = Ring(("t",))
"""t = tan(q / 2), so that rational t give rational points of the circle."""


@dataclass(frozen=True, eq=False)
class Slice:
    """A curve of configurations, in the variables that are left where one input is held.

    space: all configurations; equations: of the curve, in the ring of these variables; solved: the others.
    held: of an angle the cosine and the sine, or a length; none where the configurations are a curve already.
    """

    space: ConfigurationSpace
    equations: Equations
    ring: Ring
    label: str = ""
    held: tuple[Fraction, ...] = ()
    solved: Mapping[str, Polynomial] = field(default_factory=dict)

    @classmethod
    def whole(cls, space: ConfigurationSpace) -> Slice:
        """A curve of configurations itself."""
        return cls(space, space.equations, space.ring)

    @cached_property
    def places(self) -> tuple[int, ...]:
        """Where the variables that are left are among all."""
        return tuple(map(self.space.ring.index, self.ring.names))

    @cached_property
    def _all(self) -> CompiledMap:
        return CompiledMap([self.restricted(x) for x in self.space.ring.gens], self.ring)

    def restricted(self, polynomial: Polynomial) -> Polynomial:
        """A polynomial on the curve."""
        return self.ring.convert(polynomial.substitute(self.solved)) if self.solved else polynomial

    def lifted(self, point: Floats) -> Floats:
        """The values of all variables, of those that are left."""
        return self._all.values(point)

    @property
    def value(self) -> float:
        """About the value that is held: in radians, or a length."""
        return math.atan2(self.held[1], self.held[0]) if len(self.held) == 2 else float(self.held[0])

    def is_at(self, values: arb) -> bool:
        """Whether the value that is held is among some: radians or lengths."""
        own = [arb(x.numerator) / x.denominator for x in self.held]
        if len(own) == 1:
            return bool(values.contains(own[0]))
        turned = arb.atan2(own[1], own[0])
        turns = round(float((values - turned).mid()) / (2 * math.pi))
        return bool(values.contains(turned + 2 * turns * arb.pi()))


class Slices:
    """Values of one input such that each region has one of them; raises `Undecided` where that is not proven.

    number: of the input.  certainty: of all that was found out.
    """

    def __init__(self, borders: Borders, inputs: Coordinates, number: int) -> None:
        self.borders, self.inputs, self.number = borders, inputs, number
        self.space = borders.equation.space
        self._premises = Premises()
        fixed = {c.name for c in self.space.ring.constants}
        self._free = tuple(name for name in self.space.ring.names if name not in fixed)
        self._relations = self.space.ring.relations
        self._own = tuple(p for p in self.space.equations if p not in self._relations)

    @property
    def certainty(self) -> Certainty:
        """How it is known that no region is without one."""
        return self._premises.certainty

    @cached_property
    def slices(self) -> tuple[Slice, ...]:
        """One in each interval."""
        self._check()
        return tuple(self._slice(held) for held in self._values())

    def _check(self) -> None:
        """What the lemma supposes of all configurations."""
        if self.borders.unwritten:
            raise Undecided(f"condition ({self.borders.unwritten[0]}) is not written out as one equation")
        if len(self._own) != len(self._free) - 2:
            raise Undecided("the configurations have not two variables more than equations")
        if not is_bounded(self.space.equations, (*self.space.positive, *self.space.nonnegative)):
            raise Undecided("the configurations are not proven bounded by sums of squares, nor by limits")
        dependent = self._jacobian(*(value.rate(self._slopes) for value in self.inputs.values))
        off = math.prod((b.polynomial for b in self.borders.singular), start=self.space.ring.one)
        singular = Ideal(self.space.ring, (*self._own, *self._relations, dependent))
        if not self._premises.take(singular.radical_contains(off)):
            raise Undecided("the inputs are not proven to be coordinates wherever (4) and (5) do not hold")

    def _slopes(self, polynomial: Polynomial) -> tuple[Polynomial, ...]:
        return tuple(polynomial.derivative(x) for x in self._free)

    def _jacobian(self, *rates: Sequence[Polynomial]) -> Polynomial:
        rows = (*map(self._slopes, self._own), *rates)
        return determinant(PolynomialMatrix.of(self.space.ring, rows))

    def _special(self) -> Iterator[Equations]:
        """The sets of which the input's values are in S, beside the equations of all configurations."""
        polynomials = [b.polynomial for b in self.borders.all]
        yield from combinations(polynomials, 2)
        own = self.inputs.values[self.number].rate(self._slopes)
        for p in polynomials:
            yield p, self._jacobian(self._slopes(p), own)
        yield from self.borders.holes

    @cached_property
    def _system(self) -> DrivenSystem:
        label, value = self.inputs.labels[self.number], self.inputs.values[self.number]
        return driven_system(self.borders.equation, [label], {label: value})

    def _values(self) -> Iterator[tuple[Fraction, ...]]:
        """A value in each interval between neighbours in S: the cosine and sine of an angle, or a length."""
        drive = self._system.drives[0]
        found, at_half_turn = [], False
        for special in self._special():
            known = self._projected(special)
            if not drive.is_angle:
                found.append(reduce(Polynomial.gcd, known))
                continue
            found.append(reduce(Polynomial.gcd, map(self._halved, known)))
            turned = dict(zip(drive.names, (-1, 0), strict=True))
            at_half_turn |= all(p.substitute(turned).is_zero for p in known)
        between = samples(roots(found, "t" if drive.is_angle else drive.names[0]))
        if not drive.is_angle:
            is_square = self.inputs.values[self.number].length is None
            yield from ((t,) for t in between if t > 0 or not is_square)
            return
        for t in between if at_half_turn or len(between) == 1 else between[1:]:
            yield half_angle_point(t)

    def _projected(self, special: Equations) -> list[Polynomial]:
        """Polynomials in the input's value alone that vanish on a set."""
        system, names = self._system, self._system.drives[0].names
        ring = system.ring
        whole = (*system.loops, *ring.relations, *system.drives[0].equations, *map(ring.convert, special))
        known = self._premises.take(Ideal(ring, whole).eliminate({*ring.names} - {*names})).generators
        circle = sum((ring.gen(x) ** 2 for x in names), start=-ring.one)
        found = [p for p in known if p and not (len(names) == 2 and circle.divides(p))]
        if not found:
            raise Undecided("borders are special along a curve on which the input is not held")
        return found

    def _halved(self, polynomial: Polynomial) -> Polynomial:
        """A polynomial in the cosine and the sine, at t = tan(q / 2), times a power of 1 + t^2."""
        (t,), ring, degree = _HALF_ANGLE.gens, polynomial.ring, polynomial.total_degree
        places = [ring.index(name) for name in self._system.drives[0].names]
        total = _HALF_ANGLE.zero
        for monomial, c in polynomial.terms():
            i, j = (monomial[k] for k in places)
            total += _HALF_ANGLE.constant(c) * (1 - t**2) ** i * (2 * t) ** j * (1 + t**2) ** (degree - i - j)
        return total

    def _slice(self, held: tuple[Fraction, ...]) -> Slice:
        """The curve at a value; what its linear equations tell is put in."""
        ring, drive = self.space.ring, self._system.drives[0]
        values = dict(zip(drive.names, held, strict=True))
        given = [ring.convert(p.substitute(values)) for p in drive.equations]
        linear = [p for p in self._own if p.total_degree == 1]
        basis = self._premises.take(Ideal(ring, (*given, *linear, *self._relations)).groebner_basis())
        solved = dict[str, Polynomial]()
        for p in basis:
            monomial, c = p.leading_term
            if sum(monomial) == 1 and (name := ring.names[monomial.index(1)]) in self._free:
                solved[name] = ring.gen(name) - p / c
        left = ring.with_names(name for name in ring.names if name not in solved)
        own = (left.reduced(left.convert(p.substitute(solved))) for p in (*given, *self._own))
        equations = (*filter(None, own), *left.relations)
        return Slice(self.space, equations, left, drive.label, held, solved)
