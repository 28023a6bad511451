"""One branch of the search: a part of the configuration space, taken apart into strata and further branches.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2; the order of proofs and splits is singsym's own.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from functools import cached_property

from singsym.classes.strata.finite_parts import defects_of_points
from singsym.classes.strata.ground import Ground, NotEvident
from singsym.classes.strata.occurrence import (
    is_proven_empty,
    points_on,
    restricted,
    samples_of,
)
from singsym.classes.strata.patches import Patch, patches, unsplit
from singsym.classes.strata.ranks import DefectBounds, RankProblem, Stratum, ranked
from singsym.classes.strata.reflections import (
    IDENTITY,
    Reflection,
    compose,
    image,
    keeps,
    permuting,
    representatives,
)
from singsym.classes.taxonomy.types import SingularityType
from singsym.effort import patience
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Certainty, Premises, Verdict
from singsym.elimination import engines
from singsym.polynomials import Equations, Polynomial
from singsym.polynomials.unit_circles import unit_circles
from singsym.varieties.decomposition import decompose
from singsym.varieties.disjoint_parts import disjoint_parts
from singsym.varieties.real.proofs.positive_combinations import is_positive_combination_seen
from singsym.varieties.real.proofs.real_consequences import real_consequences
from singsym.varieties.real.system import RealSystem
from singsym.varieties.splitting import irreducible_factors

MOST_SPLITS = 3
"""So often a part without known points is split by a variable before it is decomposed."""

AT_ONCE = 0.05
"""So much of the usual patience has what is asked of all branches, also of those with known points."""


@dataclass(frozen=True)
class Branch:
    """A part of the configuration space to be decomposed into strata.

    equations: its closed conditions, loop equations included; path: the factors and minors among them, as
        they are printed.
    removed: loci that are left out here, as other branches search them.
    feasible: the exclusions and inequalities of the feasible set Omega (its equations are not used).
    first_matrix, defect_bounds, complete_types: see `ranks.ranked`.
    symmetries: reflections that keep the whole problem; images: those under which this part stands for
        other parts, which are not searched.
    elsewhere: loci whose points another branch counts.
    splits: how often it was split by a variable without knowing a point.
    seconds, memory_mb: the budget of the decomposition.
    """

    problem: RankProblem
    feasible: RealSystem
    equations: Equations
    path: Equations = ()
    removed: tuple[Equations, ...] = ()
    first_matrix: str = "L_O"
    defect_bounds: tuple[tuple[str, int], ...] = ()
    complete_types: tuple[SingularityType, ...] = ()
    symmetries: tuple[Reflection, ...] = (IDENTITY,)
    images: tuple[Reflection, ...] = (IDENTITY,)
    elsewhere: tuple[Equations, ...] = ()
    splits: int = 0
    seconds: float | None = None
    memory_mb: int | None = None

    def unfinished(self, reason: str) -> Explored:
        """Nothing found and nothing to follow, for this reason."""
        return Explored(undecided=(reason,))

    @cached_property
    def kept(self) -> tuple[Reflection, ...]:
        """The symmetries of this part, and of all that is left out here or counted elsewhere.

        Lemma: such a symmetry carries the search of a set in this part over to that of its image, with all
        that is left out and counted elsewhere: no point is counted twice, and none is lost.
        """
        sets = (self.equations, *self.removed)
        own = [r for r in self.symmetries if all(keeps(r, equations) for equations in sets)]
        return permuting(self.elsewhere, own)

    @cached_property
    def admitted(self) -> RealSystem:
        """The feasible set off what other branches search."""
        return replace(self.feasible, exclusions=(*self.feasible.exclusions, *self.removed))

    def part(self, equations: Equations, images: tuple[Reflection, ...]) -> Branch:
        """One of the parts that this branch comes apart into, for all of them that are its images."""
        return replace(self, equations=equations, images=self.with_images(images))

    def with_images(self, images: tuple[Reflection, ...]) -> tuple[Reflection, ...]:
        """Those under which something in this branch stands for others, some of them in it."""
        return tuple(dict.fromkeys(compose(r, other) for r in self.images for other in images))

    def within(
        self,
        locus: Equations,
        removed: tuple[Equations, ...],
        equations: Equations,
        defect_bounds: DefectBounds,
    ) -> Branch:
        """The part of this branch on one more locus, with what is known of the ranks there."""
        path = tuple(dict.fromkeys((*self.path, *locus)))
        known = dict(self.defect_bounds)
        known |= {name: max(defect, known.get(name, 0)) for name, defect in defect_bounds.items()}
        return replace(
            self,
            equations=(*equations, *locus),
            path=path,
            removed=(*self.removed, *removed),
            defect_bounds=tuple(sorted(known.items())),
        )


@dataclass(frozen=True)
class Found:
    """A stratum, the path that led to it, and the reflections under which it stands for other strata."""

    path: Equations
    stratum: Stratum
    images: tuple[Reflection, ...] = (IDENTITY,)


@dataclass(frozen=True)
class Explored:
    """The strata of a branch, the parts of it left to search, and the reasons where there are none yet.

    certainty: how all this is known.
    """

    found: tuple[Found, ...] = ()
    following: tuple[Branch, ...] = ()
    undecided: tuple[str, ...] = ()
    certainty: Certainty = "proven"

    @property
    def provisional(self) -> bool:
        """Whether a larger budget could say more."""
        return bool(self.undecided) or self.certainty != "proven"


def explore(branch: Branch) -> Explored:
    """Take one branch apart and find the ranks on each part: the task that workers run.

    Parts without a feasible real point are left out.
    """
    work = _Exploring(branch)
    try:
        with current().part(branch.seconds, branch.memory_mb):
            if len(parts := disjoint_parts(branch.equations)) > 1:
                chosen = representatives(parts, branch.kept)
                return Explored(following=tuple(branch.part(parts[k], images) for k, images in chosen))
            if (known := _point_by_point(branch)) is not None:
                return known
            work.explore()
    except Undecided as reason:
        work.undecided.append(str(reason))
    return Explored(tuple(work.found), tuple(work.following), tuple(work.undecided), work.premises.certainty)


def explore_patiently(branch: Branch) -> Explored:
    """The same with much time for proofs over Q."""
    with engines.patiently():
        return explore(branch)


def _point_by_point(branch: Branch) -> Explored | None:
    """A branch of finitely many points with the same defects; `None` where it is not seen to be one."""
    system = replace(branch.admitted, equations=branch.equations)
    found = defects_of_points(branch.problem, system, dict(branch.defect_bounds))
    if found is None or len(found.value) > 1:
        return None
    own = [defects for defects in found.value if defects.types not in branch.complete_types]
    strata = (Stratum(branch.equations, d, branch.removed, elsewhere=branch.elsewhere) for d in own)
    parts = tuple(Found(branch.path, s, branch.images) for s in strata)
    return Explored(parts, certainty=found.certainty)


@dataclass
class _Exploring:
    """A branch at work.

    premises: what it rests on that there is nothing else.
    """

    branch: Branch
    found: list[Found] = field(default_factory=list)
    following: list[Branch] = field(default_factory=list)
    undecided: list[str] = field(default_factory=list)
    earlier: list[Equations] = field(default_factory=list)
    premises: Premises = field(default_factory=Premises)
    tried: bool = False
    """Whether all of it was not proven empty in a short time."""

    def explore(self) -> None:
        """Search all patches of the real zeros; none of what is soon seen to be empty."""
        branch = self.branch
        whole = unsplit(branch.equations, branch.feasible.ring)
        system = restricted(branch.admitted, whole)
        with patience.scaled(AT_ONCE):
            forced = self.premises.take(real_consequences(system, system.closed_equations))
        if forced is None:
            return
        equations = (*branch.equations, *forced)
        if forced:
            whole = unsplit(equations, branch.feasible.ring)
            system = restricted(branch.admitted, whole)
        if not points_on(system, whole, 1):
            if is_positive_combination_seen(equations):
                return
            if self.premises.grants(_is_soon_empty(system)):
                return
            self.tried = True
        parts = patches(equations, branch.admitted.nonzero, branch.feasible.ring)
        chosen = representatives([p.generators for p in parts], branch.kept)
        for k, images in chosen:
            self.patch(parts[k], images, alone=len(chosen) == 1)

    def patch(self, patch: Patch, images: tuple[Reflection, ...], *, alone: bool) -> None:
        """Search a patch; from then on its points, and their images, are known to be elsewhere.

        alone: whether there is no other patch, which might have to wait for this one.
        """
        before = list(self.found), list(self.following), list(self.earlier)
        try:
            self._search(patch, images, alone)
        except Undecided:
            if alone:
                raise
            self.found, self.following, self.earlier = before
            self._postpone(patch, images)
        self.earlier += [image(patch.generators, reflection) for reflection in images]

    def _postpone(self, patch: Patch, images: tuple[Reflection, ...]) -> None:
        """A patch as a branch of its own."""
        self.following.append(self._part(images).within((), (), patch.generators, {}))

    def _search(self, patch: Patch, images: tuple[Reflection, ...], alone: bool) -> None:
        """The ranks on a patch as it stands, where points are known of it."""
        system = restricted(self.branch.admitted, patch)
        if () in system.exclusions:
            return
        found = points_on(system, patch)
        if found:
            try:
                self._ranked(Ground(patch, found, system=system), images)
            except NotEvident as doubt:
                self._split(patch, doubt.polynomial, images)
            return
        self._without_points(patch, system, images, alone)

    def _without_points(
        self, patch: Patch, system: RealSystem, images: tuple[Reflection, ...], alone: bool
    ) -> None:
        """A patch of which no point is known: the cheap ways to show that there is none come first."""
        forced = self.premises.take(real_consequences(system, system.closed_equations))
        if forced is None:
            return
        smaller = patches((*patch.generators, *forced), system.nonzero, system.ring, thorough=True)
        if patch.generators not in [p.generators for p in smaller]:
            for part in smaller:
                self.patch(part, images, alone=alone and len(smaller) == 1)
            return
        deciding = _deciding_variable(system) if self.branch.splits < MOST_SPLITS else None
        if not alone:
            quick = is_proven_empty(system, patience.QUICK_EMPTINESS.work, modular=False)
            if not self.premises.grants(quick):
                self._postpone(patch, images)
        elif deciding is not None:
            if self.tried or not self.premises.grants(_is_soon_empty(system)):
                self.branch = replace(self.branch, splits=self.branch.splits + 1)
                self._split(patch, deciding, images)
        elif not self.premises.grants(is_proven_empty(system)):
            self._decomposed(patch, system, images)

    def _decomposed(self, patch: Patch, system: RealSystem, images: tuple[Reflection, ...]) -> None:
        """The ranks on the components of a patch that may have real points."""
        known: tuple[Equations, ...] = ()
        components = decompose(patch.generators, system.nonzero, ring=system.ring, excluded=system.exclusions)
        for component in self.premises.take(components):
            samples = self.premises.take(samples_of(component, system))
            if samples is not None:
                self._ranked(Ground(patch, samples, component), images, known)
                known = (*known, component.generators)

    def _ranked(
        self, ground: Ground, images: tuple[Reflection, ...], known: tuple[Equations, ...] = ()
    ) -> None:
        """The strata of a ground; `known`: other grounds of the same patch, looked at before."""
        branch = self.branch
        part = self._part(images, tuple(image(locus, r) for locus in known for r in images))
        ranks = ranked(
            branch.problem,
            ground,
            branch.admitted,
            branch.first_matrix,
            dict(branch.defect_bounds),
            branch.complete_types,
        )
        found = self.premises.take(ranks)
        if found.stratum is not None:
            loci = (*branch.removed, *found.stratum.loci)
            stratum = replace(found.stratum, loci=loci, elsewhere=part.elsewhere)
            self.found.append(Found(branch.path, stratum, part.images))
        removed: tuple[Equations, ...] = ()
        for whole, defect_bounds in found.loci.items():
            for locus in split_product(whole):
                if not any(set(known) <= set(locus) for known in removed):
                    self.following.append(part.within(locus, removed, ground.equations, defect_bounds))
                    removed = (*removed, locus)

    def _split(self, patch: Patch, polynomial: Polynomial, images: tuple[Reflection, ...]) -> None:
        """A patch as two branches: the zeros of a polynomial, where it has any, and the rest."""
        part = self._part(images)
        certifier = Ground(patch).certifier(self.branch.admitted, ())
        removed: tuple[Equations, ...] = ()
        for factor in split_product((polynomial,)):
            if certifier.reason(*factor) is None:
                self.following.append(part.within(factor, removed, patch.generators, {}))
            removed = (*removed, factor)
        self.following.append(part.within((), removed, patch.generators, {}))

    def _part(self, images: tuple[Reflection, ...], known: tuple[Equations, ...] = ()) -> Branch:
        """The branch with the images of one patch, and with what was looked at before."""
        branch = self.branch
        elsewhere = (*branch.elsewhere, *self.earlier, *known)
        return replace(branch, images=branch.with_images(images), elsewhere=elsewhere)


def _is_soon_empty(system: RealSystem) -> Verdict:
    """Whether a part that can be split further is proven empty; primes will do unless there is patience."""
    if engines.proof_patience() == 1:
        return is_proven_empty(system, patience.SHORT_EMPTINESS.work)
    return is_proven_empty(system, patience.PATIENT_EMPTINESS.work, modular=False)


def _deciding_variable(system: RealSystem) -> Polynomial | None:
    """The variable without which the equations lose most terms, circles aside, if it may be zero or not."""
    ring = system.ring
    known = irreducible_factors(system.nonzero) or frozenset()
    circles = {name for pair in unit_circles(system.equations) for name in pair}
    counts = Counter(
        name
        for p in system.equations
        if len(p) > 3
        for m, _ in p.terms()
        for name, power in zip(ring.names, m, strict=True)
        if power and name in circles and ring.gen(name) not in known
    )
    return ring.gen(max(counts, key=lambda name: (counts[name], name))) if counts else None


def split_product(locus: Equations) -> list[Equations]:
    """One equation as the list of its irreducible factors, several as they are.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> split_product((x**2 * y,))
    [(x,), (y,)]
    """
    if len(locus) != 1:
        return [locus]
    return [(factor,) for factor, _ in locus[0].factors()]
