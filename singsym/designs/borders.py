"""Border polynomials: off their zeros the table of classes is locally constant.

A stratum of the family is a set over the space of parameters.  Where its fibres are bounded and smooth of one
dimension, and move smoothly, it is a locally trivial bundle (Ehresmann's lemma; for points a covering), so
that over a connected cell all fibres look alike.  What is projected into the space of parameters, by
elimination: where gradients by the configuration variables depend on each other, where it meets what is
taken out of it or the border of a limit, and a stratum that is there for special values only.  A stratum is
taken as it is where its equations are independent off such a border; else its components are taken.
Source: D. Lazard, F. Rouillier, J. Symb. Comput. 42 (2007) 636-667 (discriminant varieties); C. Ehresmann,
Les connexions infinitesimales dans un espace fibre differentiable (1950); the rest is singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain, combinations

from singsym.classes.strata.branches import Found
from singsym.classes.strata.reflections import IDENTITY, image
from singsym.classes.taxonomy.types import SingularityType, feasible_classes
from singsym.designs.bundles import Bundle
from singsym.designs.families import Family
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Certainty, Premises
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Equations, Polynomial
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.real.curves.critical_points import is_bounded

_ALL = 3
"""A mobility that allows all classes."""

TOGETHER = "fall together"
MEETS = "meets another class"
SPECIAL = "only there"
LIMIT = "at a limit"


@dataclass(frozen=True)
class BorderPart:
    """One irreducible factor of the border, with the types of the strata that it comes from, and why.

    sets: of configurations and parameters, whose projections it is in.
    """

    polynomial: Polynomial
    reasons: tuple[tuple[SingularityType, str], ...]
    sets: tuple[Equations, ...] = field(default=(), repr=False, compare=False)


@dataclass(frozen=True)
class Borders:
    """Where in the space of parameters the table of classes may change.

    parts: factors, in the ring of the parameters; the zeros of other polynomials are no borders.
    open: for types, why it is not proven that nothing else is a border of theirs.
    certainty: of all this.
    """

    parts: tuple[BorderPart, ...]
    open: tuple[tuple[SingularityType, str], ...]
    certainty: Certainty


@dataclass(frozen=True)
class _Wall:
    """A set that does not lie over all of the space of parameters, and why fibres change there."""

    equations: Equations
    projection: Polynomial
    reason: str


def borders(family: Family, seconds: float | None = 60.0) -> Borders:
    """The borders of all strata; seconds: of work for each of them.

    Of the regular configurations only whether there are any, as of all configurations together.
    What comes to no end is open for the types of its stratum; what was found of it before is a border.
    """
    known = family.exploration
    premises = Premises(known.certainty, "modular" if known.modular else "proven")
    doubts: dict[tuple[SingularityType, str], None] = {}
    for kind in feasible_classes(_ALL):
        doubts |= {(kind.types, reason): None for reason in known.doubts(kind.types)}
    bounded = _is_bounded(family)
    walls: list[tuple[SingularityType, _Wall]] = []
    for part in known.found:
        types, own = part.stratum.defects.types, _Walls(family, premises, bounded)
        try:
            with current().part(seconds):
                own.find(part)
        except Undecided as reason:
            doubts[types, str(reason)] = None
        walls += [(types, wall) for wall in own.found]
    return Borders(_parts(walls), tuple(doubts), premises.certainty)


def _parts(walls: Iterable[tuple[SingularityType, _Wall]]) -> tuple[BorderPart, ...]:
    reasons: dict[Polynomial, dict[tuple[SingularityType, str], None]] = {}
    sets: dict[Polynomial, dict[Equations, None]] = {}
    for types, wall in walls:
        for factor, _ in wall.projection.factors():
            reasons.setdefault(factor, {})[types, wall.reason] = None
            sets.setdefault(factor, {})[wall.equations] = None
    return tuple(BorderPart(p, tuple(why), tuple(sets[p])) for p, why in reasons.items())


def _is_bounded(family: Family) -> bool:
    """Whether all configurations are bounded, for parameters in a compact set.

    Lemma: so they are where a sum of quadrics has a leading form in the configuration variables that is
    positive definite and free of parameters: what is left of lower degree is bounded by them.
    """
    ring = family.space.ring
    small = ring.with_names(family.space.variables)
    places = [ring.index(name) for name in small.names]
    quadrics = []
    for p in family.space.equations:
        top = {m: c for m, c in p.terms() if sum(m[i] for i in places) >= 2}
        if top and all(sum(m) == sum(m[i] for i in places) == 2 for m in top):
            quadrics.append(small.convert(ring.from_dict(top)))
    return bool(quadrics) and is_bounded(quadrics)


@dataclass
class _Walls:
    """What is projected of a stratum; every method raises `Undecided`.

    found: the walls so far; they are walls also where no end is come to.
    """

    family: Family
    premises: Premises
    bounded: bool
    found: list[_Wall] = field(default_factory=list)

    def find(self, part: Found) -> None:
        """The walls of a stratum: as one set, or else of its components.

        Lemma: images that it stands for have the same walls.  Where two of them meet, so do it and an image,
        for the images are closed under composition.
        """
        stratum = part.stratum
        removed, images = [*self.family.space.exclusions], list[Equations]()
        if stratum.defects.types:
            removed += [*stratum.loci, *stratum.elsewhere]
            images = [image(stratum.equations, r) for r in part.images if r != IDENTITY]
        with attempt("a stratum as one set", share=0.5):
            self._as_one(stratum.equations, (*removed, *images))
            return
        as_one, self.found = self.found, []
        try:
            self._by_components(stratum.equations, removed, images)
        except Undecided:
            self.found += as_one
            raise

    def _as_one(self, equations: Equations, groups: Sequence[Equations]) -> None:
        family = self.family
        whole = Bundle.of_equations(family.space.ring, family.others, equations)
        if whole.dimension < 0:
            self._wall(whole.equations, SPECIAL, "a part of it has more equations than variables")
        else:
            self._of_bundle(whole, groups, tuple(self._limits()))

    def _by_components(
        self, equations: Equations, removed: Sequence[Equations], images: Sequence[Equations]
    ) -> None:
        """The same of each component; one that is in what is removed is not there, one in an image is."""
        family, ring = self.family, self.family.space.ring
        single = [group[0] for group in removed if len(group) == 1]
        pieces = self.premises.take(decompose(equations, single, ring=ring))
        there = list[Component]()
        for component in pieces:
            left = [self._not_zero(component, group) for group in removed]
            if not all(left):
                continue
            if special := self._projected(component.generators, SPECIAL):
                self.found.append(special)
                continue
            limits = tuple(g for g in self._limits() if self._not_zero(component, (g,)))
            own = Bundle.of_component(component, family.others, equations)
            met = [group for other in images if (group := self._not_zero(component, other))]
            self._of_bundle(own, (*left, *met), limits)
            there.append(component)
        for one, two in combinations(there, 2):
            both = (*one.generators, *two.generators)
            self._wall(both, TOGETHER, "two parts of it meet for all values of the parameters")

    def _of_bundle(self, bundle: Bundle, groups: Sequence[Equations], limits: Sequence[Polynomial]) -> None:
        """The walls of a set that is there for almost all values of the parameters.

        groups: what is taken out of it, or counted with it.
        """
        if not self.bounded:
            raise Undecided("the configurations are not proven bounded by sums of squares")
        singular = "a part of it is singular for all values of the parameters"
        for fold in bundle.folds():
            whole = tuple(dict.fromkeys((*bundle.equations, *fold)))
            self._wall(fold, TOGETHER, singular, whole)
        for face in bundle.faces(limits):
            self._wall(face, LIMIT, "limits do not cut a part of it across for any values")
        for group in groups:
            self._off(bundle, group, limits)

    def _off(self, bundle: Bundle, group: Equations, limits: Sequence[Polynomial]) -> None:
        """Where a group may vanish on an open part of a fibre."""
        sets: Iterator[Equations] = iter((bundle.touches(group),))
        if bundle.dimension and not limits:
            sets = chain(sets, bundle.summits(group, self.family.space.variables))
        found = next(filter(None, (self._projected(own, MEETS) for own in sets)), None)
        if found is None:
            raise Undecided("a part of it was not seen to lie outside another class")
        self.found.append(found)

    def _limits(self) -> Iterator[Polynomial]:
        """Limits of configurations, not those of parameters."""
        space = self.family.space
        return filter(self.family.moves, (*space.positive, *space.nonnegative))

    def _not_zero(self, component: Component, group: Equations) -> Equations:
        """Those of some polynomials that do not vanish on all of a component."""
        return tuple(p for p in group if not self.premises.take(component.vanishes(p)))

    def _wall(
        self, equations: Equations, reason: str, otherwise: str, whole: Equations | None = None
    ) -> None:
        """A set that is projected; whole: a part of it that has all of what changes."""
        found = self._projected(equations, reason)
        if found is None:
            raise Undecided(otherwise)
        self.found.append(found if whole is None else replace(found, equations=whole))

    def _projected(self, equations: Equations, reason: str) -> _Wall | None:
        """A set with a polynomial in the parameters that vanishes on it; None where only zero does."""
        family = self.family
        whole = Ideal(family.space.ring, equations).eliminate(family.others)
        known = self.premises.take(whole).generators
        found = [family.base.convert(p) for p in known if p]
        smallest = min(found, key=lambda p: (p.total_degree, len(p)), default=None)
        return None if smallest is None else _Wall(equations, smallest, reason)
