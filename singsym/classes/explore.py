"""The search for all strata: from the configuration space down, locus by locus.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2; every singular configuration lies on the zero set of
det L_I or of det L_O (the Proposition of section 2.3), so the search starts with their factors.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from operator import attrgetter

from singsym.classes.patches import Patch, patches, unsplit
from singsym.classes.presence import (
    QUICK_SECONDS,
    SHORT_SECONDS,
    is_proven_empty,
    points_on,
    restricted,
    samples_of,
)
from singsym.classes.strata import Ground, Least, NotEvident, RankProblem, Stratum, ranked
from singsym.classes.symmetry import IDENTITY, Reflection, compose, image, keeps, representatives
from singsym.classes.types import Defects, SingularityType
from singsym.classes.work import Runner
from singsym.elimination import engines
from singsym.elimination.budget import Budget, Undecided
from singsym.elimination.verdict import Certainty, certainties, weakest
from singsym.polynomials import Polynomial
from singsym.varieties.circles import unit_circles
from singsym.varieties.decomposition import decompose
from singsym.varieties.real.consequences import real_consequences
from singsym.varieties.real.witness import RealSystem
from singsym.varieties.splitting import irreducible_factors

_T = SingularityType
_SIMPLE = (_T(0), _T.RI | _T.IO, _T.RO | _T.II)
"""The types of strata that are known where (4) and (5) are."""
Equations = tuple[Polynomial, ...]
MOST_SPLITS = 3
"""So often a part without known points is split by a variable before it is decomposed."""


@dataclass(frozen=True)
class Branch:
    """A part of the configuration space to be decomposed into strata.

    equations: its closed conditions, loop equations included; path: the factors and minors among them, as
        they are printed.
    away: loci that other branches search, left out here.
    feasible: the exclusions and inequalities of the feasible set Omega (its equations are not used).
    first, least, evident: see `strata.ranked`.
    symmetries: reflections that keep the whole problem; images: those under which this part stands for
        other parts, which are not searched.
    elsewhere: sets that other branches search; their points are not counted here.
    splits: how often it was split by a variable without knowing a point.
    seconds, memory_mb: the budget of the decomposition.
    """

    problem: RankProblem
    feasible: RealSystem
    equations: Equations
    path: Equations = ()
    away: tuple[Equations, ...] = ()
    first: str = "L_O"
    least: tuple[tuple[str, int], ...] = ()
    evident: tuple[SingularityType, ...] = ()
    symmetries: tuple[Reflection, ...] = (IDENTITY,)
    images: tuple[Reflection, ...] = (IDENTITY,)
    elsewhere: tuple[Equations, ...] = ()
    splits: int = 0
    seconds: float | None = None
    memory_mb: int | None = None

    @cached_property
    def kept(self) -> tuple[Reflection, ...]:
        """The symmetries of this part."""
        sets = (self.equations, *self.away)
        return tuple(r for r in self.symmetries if all(keeps(r, equations) for equations in sets))

    @cached_property
    def admitted(self) -> RealSystem:
        """The feasible set off what other branches search."""
        return replace(self.feasible, exclusions=(*self.feasible.exclusions, *self.away))

    def within(
        self, locus: Equations, away: tuple[Equations, ...], equations: Equations, least: Least
    ) -> Branch:
        """The part of this branch on one more locus, with what is known of the ranks there."""
        path = tuple(dict.fromkeys((*self.path, *locus)))
        known = dict(self.least)
        known |= {name: max(defect, known.get(name, 0)) for name, defect in least.items()}
        return replace(
            self,
            equations=(*equations, *locus),
            path=path,
            away=(*self.away, *away),
            least=tuple(sorted(known.items())),
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
        return bool(self.undecided)


@dataclass(frozen=True)
class Exploration:
    """All strata, and the branches that ended without an answer, with their reasons.

    evident: types whose strata are all there, whatever is unexplored; certainty: how the others are known to
        be all; modular: types for which that rests on primes in any case.
    """

    found: tuple[Found, ...]
    unexplored: tuple[tuple[Branch, str], ...]
    evident: tuple[SingularityType, ...] = ()
    certainty: Certainty = "proven"
    modular: tuple[SingularityType, ...] = ()

    def certainty_of(self, types: SingularityType) -> Certainty:
        """How it is known that there are no more configurations of these types than were found."""
        if types in self.evident:
            return "proven"
        return weakest(self.certainty, "modular" if types in self.modular else "proven")

    def doubts(self, types: SingularityType) -> tuple[str, ...]:
        """Why there may be more configurations of these types than were found."""
        if types in self.evident:
            return ()
        return tuple(dict.fromkeys(reason for _, reason in self.unexplored))


def explore(branch: Branch) -> Explored:
    """Take one branch apart and find the ranks on each part: the task that workers run.

    Parts without a feasible real point are left out.
    """
    with certainties() as seen:
        found = _explored(branch)
    return replace(found, certainty=weakest(*seen))


def explore_patiently(branch: Branch) -> Explored:
    """The same with much time for proofs over Q."""
    with engines.patiently():
        return explore(branch)


def _explored(branch: Branch) -> Explored:
    work = _Exploring(branch)
    try:
        with Budget(branch.seconds, branch.memory_mb):
            whole = unsplit(branch.equations, branch.feasible.ring)
            system = restricted(branch.admitted, whole)
            if not points_on(system, whole, 1) and is_proven_empty(system, SHORT_SECONDS, modular=_hasty()):
                return Explored()
            parts = patches(branch.equations, branch.admitted.nonzero, branch.feasible.ring)
            chosen = list(representatives([p.generators for p in parts], branch.kept))
            for k, images in chosen:
                work.patch(parts[k], images, alone=len(chosen) == 1)
    except Undecided as reason:
        work.undecided.append(str(reason))
    return Explored(tuple(work.found), tuple(work.following), tuple(work.undecided))


@dataclass
class _Exploring:
    """A branch at work."""

    branch: Branch
    found: list[Found] = field(default_factory=list)
    following: list[Branch] = field(default_factory=list)
    undecided: list[str] = field(default_factory=list)
    earlier: list[Equations] = field(default_factory=list)

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
        forced = real_consequences(system, system.closed_equations)
        if forced is None:
            return
        smaller = patches((*patch.generators, *forced), system.nonzero, system.ring, thorough=True)
        if patch.generators not in [p.generators for p in smaller]:
            for part in smaller:
                self.patch(part, images, alone=alone and len(smaller) == 1)
            return
        deciding = _deciding_variable(system) if self.branch.splits < MOST_SPLITS else None
        if not alone:
            if not is_proven_empty(system, QUICK_SECONDS, modular=False):
                self._postpone(patch, images)
        elif deciding is not None:
            if not is_proven_empty(system, SHORT_SECONDS, modular=_hasty()):
                self.branch = replace(self.branch, splits=self.branch.splits + 1)
                self._split(patch, deciding, images)
        elif not is_proven_empty(system):
            self._decomposed(patch, system, images)

    def _decomposed(self, patch: Patch, system: RealSystem, images: tuple[Reflection, ...]) -> None:
        """The ranks on the components of a patch that may have real points."""
        known: tuple[Equations, ...] = ()
        for component in decompose(patch.generators, system.nonzero, ring=system.ring):
            samples = samples_of(component, system)
            if samples is not None:
                self._ranked(Ground(patch, samples, component), images, known)
                known = (*known, component.generators)

    def _ranked(
        self, ground: Ground, images: tuple[Reflection, ...], known: tuple[Equations, ...] = ()
    ) -> None:
        """The strata of a ground; `known`: other grounds of the same patch, looked at before."""
        branch = self.branch
        part = self._part(images, known)
        found = ranked(
            branch.problem, ground, branch.admitted, branch.first, dict(branch.least), branch.evident
        )
        if found.stratum is not None:
            loci = (*branch.away, *found.stratum.loci)
            stratum = replace(found.stratum, loci=loci, elsewhere=part.elsewhere)
            self.found.append(Found(branch.path, stratum, part.images))
        taken: tuple[Equations, ...] = ()
        for whole, least in found.loci.items():
            for locus in split_product(whole):
                if not any(set(known) <= set(locus) for known in taken):
                    self.following.append(part.within(locus, taken, ground.equations, least))
                    taken = (*taken, locus)

    def _split(self, patch: Patch, polynomial: Polynomial, images: tuple[Reflection, ...]) -> None:
        """A patch as two branches: the zeros of a polynomial and the rest."""
        part = self._part(images)
        taken: tuple[Equations, ...] = ()
        for factor in split_product((polynomial,)):
            self.following.append(part.within(factor, taken, patch.generators, {}))
            taken = (*taken, factor)
        self.following.append(part.within((), taken, patch.generators, {}))

    def _part(self, images: tuple[Reflection, ...], known: tuple[Equations, ...] = ()) -> Branch:
        """The branch with the images of one patch, and with what was looked at before."""
        branch = self.branch
        all_images = tuple(dict.fromkeys(compose(r, other) for r in branch.images for other in images))
        return replace(branch, images=all_images, elsewhere=(*branch.elsewhere, *self.earlier, *known))


def _hasty() -> bool:
    """Whether an answer that rests on primes will do for the time being."""
    return engines.proof_patience() == 1


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


Loci = tuple[Equations, ...]
"""A closed set as a union: of each tuple, all polynomials vanish."""


@dataclass(frozen=True)
class SingularLoci:
    """Where the four matrices lose rank, by the alternatives of conditions (4), (5), (iii) and (vi).

    passive, mobility: None where the condition is left as a comparison of ranks.
    """

    inputs: Loci
    outputs: Loci
    passive: Loci | None = None
    mobility: Loci | None = None


def search(
    root: Branch, runner: Runner, singular: SingularLoci | None = None, budget: Budget | None = None
) -> Exploration:
    """All strata of a branch; a branch is searched as soon as the one that it follows from has been.

    singular: where known, the strata that need no search are written down at once, as steps (4)-(6) of the
        paper do, and only the zeros of (4) or of (5) are searched.
    budget: of the whole search; what is left when it is used up comes back unexplored.
    The result does not depend on the runner's executor: branches keep their order.
    """
    found: list[Found] = []
    first: Sequence[Branch] = (root,)
    if singular is not None:
        found, first = _started(root, singular)
    evident = first[0].evident if first else ()
    whole = budget or Budget()
    unexplored: list[tuple[Branch, str]] = []
    modular: list[tuple[Branch, Explored]] = []
    for branch, explored in runner.grow(explore, first, attrgetter("following"), "strata", whole):
        if explored is None:
            unexplored.append((branch, f"the budget of {whole.seconds:g} s for the search is used up"))
            continue
        if explored.certainty != "proven":
            modular.append((branch, explored))
        unexplored += [(branch, reason) for reason in explored.undecided]
        found += explored.found
    return Exploration(tuple(found), tuple(unexplored), evident, *_proven(modular, runner, whole))


def _proven(
    modular: Sequence[tuple[Branch, Explored]], runner: Runner, budget: Budget
) -> tuple[Certainty, tuple[SingularityType, ...]]:
    """How branches that rest on primes are known, after a second look with much time for proofs.

    An empty one may be taken apart in another way; strata that come up in it, although there is nothing
    modulo primes, leave only their own types in doubt, which come second.
    """
    stage = "strata, proofs over Q"
    empty = [branch for branch, first in modular if first == Explored(certainty=first.certainty)]
    others = [(branch, first) for branch, first in modular if branch not in empty]
    empty = [replace(branch, splits=0) for branch in empty]
    known: list[Certainty] = []
    types: dict[SingularityType, None] = {}
    for _, part in runner.grow(explore_patiently, empty, attrgetter("following"), stage, budget):
        if part is None or part.undecided:
            known.append("modular")
        else:
            known.append(part.certainty)
            types |= dict.fromkeys(f.stratum.defects.types for f in part.found)
    seconds = runner.map_within(explore_patiently, [branch for branch, _ in others], stage, budget)
    for (_, first), second in zip(others, seconds, strict=True):
        same = second is not None and replace(second, certainty=first.certainty) == first
        known.append(second.certainty if second is not None and same else first.certainty)
    return weakest(*known), tuple(types)


def _started(root: Branch, singular: SingularLoci) -> tuple[list[Found], list[Branch]]:
    """The strata that need no search, and the branches where the others are."""
    found = list(_evident_strata(root, singular))
    evident = tuple(dict.fromkeys((*(part.stratum.defects.types for part in found), *_SIMPLE)))
    first, loci = min(
        (("L_O", singular.outputs), ("L_I", singular.inputs)),
        key=lambda side: sum(len(p) for locus in side[1] for p in locus),
    )
    ready = replace(root, first=first, evident=evident)
    return found, [ready.within(locus, loci[:i], root.equations, {first: 1}) for i, locus in enumerate(loci)]


def _evident_strata(root: Branch, singular: SingularLoci) -> Iterator[Found]:
    """The regular configurations, and the classes without IIM and RPM.

    With k_O = 0 there is neither IIM nor RPM, and the class is (RO, II) by (vii); dually (RI, IO) by (viii).
    Where both (4) and (5) hold, but neither (iii) nor (vi), it is (RI, RO, IO, II).
    """
    inputs, outputs = singular.inputs, singular.outputs
    regular = Stratum(root.equations, Defects(0, 0, 0, 0), (*inputs, *outputs))
    yield Found((), regular)
    for own, other, defects in (
        (inputs, outputs, Defects(0, 0, 1, 0)),
        (outputs, inputs, Defects(0, 0, 0, 1)),
    ):
        paths = [path for path in own if path not in other]
        for i, path in enumerate(paths):
            equations = (*root.equations, *path)
            yield Found(path, Stratum(equations, defects, other, elsewhere=tuple(paths[:i])))
    if singular.passive is None or singular.mobility is None:
        return
    searched = (*singular.passive, *singular.mobility)
    paths = [
        path
        for path in _intersections(inputs, outputs)
        if not any(set(locus) <= set(path) for locus in searched)
    ]
    for i, path in enumerate(paths):
        equations = (*root.equations, *path)
        yield Found(path, Stratum(equations, Defects(0, 0, 1, 1), searched, elsewhere=tuple(paths[:i])))


def _intersections(one: Loci, two: Loci) -> list[Equations]:
    """The common zeros of two unions of loci as a union, without those that lie in others by their paths."""
    paths = [path for path in one if path in two]
    for first in one:
        for second in two:
            path = tuple(dict.fromkeys((*first, *second)))
            if not any(set(known) <= set(path) for known in paths):
                paths.append(path)
    return paths


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
