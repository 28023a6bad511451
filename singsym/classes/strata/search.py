"""The search for all strata: from the configuration space down, locus by locus.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2; every singular configuration lies on the zero set of
det L_I or of det L_O (the Proposition of section 2.3), so the search starts with their factors.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter

from singsym.classes.running.runner import Runner
from singsym.classes.strata.branches import Branch, Explored, Found, explore, explore_patiently
from singsym.classes.strata.ranks import Stratum
from singsym.classes.taxonomy.types import Defects, SingularityType
from singsym.effort.budget import Budget
from singsym.effort.verdict import Certainty, weakest
from singsym.polynomials import Equations
from singsym.varieties.disjoint_parts import disjoint_parts

_T = SingularityType
_SIMPLE = (_T(0), _T.RI | _T.IO, _T.RO | _T.II)
"""The types of strata that are known where (4) and (5) are."""
_PATIENCE = 2
"""So many times as long a part has in a second look."""


@dataclass(frozen=True)
class Exploration:
    """All strata, and the branches that ended without an answer, with their reasons.

    complete_types: those whose strata are all there, whatever is unexplored; certainty: how the others are
        known to be all; modular: types for which that rests on primes in any case.
    """

    found: tuple[Found, ...]
    unexplored: tuple[tuple[Branch, str], ...]
    complete_types: tuple[SingularityType, ...] = ()
    certainty: Certainty = "proven"
    modular: tuple[SingularityType, ...] = ()

    def certainty_of(self, types: SingularityType) -> Certainty:
        """How it is known that there are no more configurations of these types than were found."""
        if types in self.complete_types:
            return "proven"
        return weakest(self.certainty, "modular" if types in self.modular else "proven")

    @property
    def doubts_of_any(self) -> tuple[str, ...]:
        """Why there may be more strata than were found."""
        return tuple(dict.fromkeys(reason for _, reason in self.unexplored))

    def doubts(self, types: SingularityType) -> tuple[str, ...]:
        """Why there may be more configurations of these types than were found."""
        return () if types in self.complete_types else self.doubts_of_any


Loci = tuple[Equations, ...]
"""A closed set as a union: of each tuple, all polynomials vanish."""


@dataclass(frozen=True)
class SingularLoci:
    """Where the four matrices lose rank, by the alternatives of conditions (4), (5), (iii) and (vi).

    Everywhere is one locus without an equation.
    passive, mobility: None where the condition is left as a comparison of ranks.
    """

    inputs: Loci
    outputs: Loci
    passive: Loci | None = None
    mobility: Loci | None = None

    def defects_on(self, locus: Equations) -> dict[str, int]:
        """How far at least the matrices are below full rank on one of the loci.

        Lemma: k_I, k_O >= max(p, delta) (Table 1).
        """
        loci = {"L_p": self.passive, "L": self.mobility, "L_I": self.inputs, "L_O": self.outputs}
        found = {name: 1 for name, own in loci.items() if own is not None and {locus, ()} & set(own)}
        return found | (dict.fromkeys(("L_I", "L_O"), 1) if {"L_p", "L"} & set(found) else {})

    def searched(self, n: int) -> tuple[str, Loci]:
        """Loci outside of which all classes are known without a search, and a matrix to look at first.

        The zeros of (4), or of (5); or those of (iii) and (vi), where they are known and not longer.  First
        those that are smallest if each equation takes one of n freedoms; then the shorter.
        """
        sides = [
            (name, loci) for name, loci in (("L_O", self.outputs), ("L_I", self.inputs)) if () not in loci
        ]
        sides = sides or [("L_O", self.outputs)]
        if self.passive is not None and self.mobility is not None:
            both = tuple(dict.fromkeys((*self.passive, *self.mobility)))
            if _longest(both) <= max(_longest(loci) for _, loci in sides):
                sides.append((sides[0][0], both))

        def cost(side: tuple[str, Loci]) -> tuple[int, int]:
            dimensions = (max(0, n - len(locus)) for locus in side[1])
            return max(dimensions, default=0), sum(len(p) for locus in side[1] for p in locus)

        return min(sides, key=cost)


def _longest(loci: Loci) -> int:
    return max((len(p) for locus in loci for p in locus), default=0)


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
    roots: Sequence[Branch] = (root,)
    if singular is not None:
        found, roots = _started(root, singular)
    complete_types = roots[0].complete_types if roots else ()
    whole = budget or Budget()
    unexplored: list[tuple[Branch, str]] = []
    modular: list[tuple[Branch, Explored]] = []
    for branch, explored in runner.grow(explore, roots, attrgetter("following"), "strata", whole):
        if explored.certainty != "proven":
            modular.append((branch, explored))
        unexplored += [(branch, reason) for reason in explored.undecided]
        found += explored.found
    return Exploration(tuple(found), tuple(unexplored), complete_types, *_proven(modular, runner, whole))


def _proven(
    modular: Sequence[tuple[Branch, Explored]], runner: Runner, budget: Budget
) -> tuple[Certainty, tuple[SingularityType, ...]]:
    """How branches that rest on primes are known, after a second look with much time for proofs.

    An empty one may be taken apart in another way; strata that come up in it, although there is nothing
    modulo primes, leave only their own types in doubt, which come second.
    """
    stage = "strata, proofs over Q"
    empty = [branch for branch, once in modular if once == Explored(certainty=once.certainty)]
    others = [(branch, once) for branch, once in modular if branch not in empty]
    empty = [replace(branch, splits=0, seconds=_longer(branch.seconds)) for branch in empty]
    known: list[Certainty] = []
    types: dict[SingularityType, None] = {}
    for _, part in runner.grow(explore_patiently, empty, attrgetter("following"), stage, budget):
        if part.undecided:
            known.append("modular")
        else:
            known.append(part.certainty)
            types |= dict.fromkeys(f.stratum.defects.types for f in part.found)
    looks = runner.map(explore_patiently, [branch for branch, _ in others], stage, budget)
    for (_, once), again in zip(others, looks, strict=True):
        same = replace(again, certainty=once.certainty) == once
        known.append(again.certainty if same else once.certainty)
    return weakest(*known), tuple(types)


def _longer(seconds: float | None) -> float | None:
    return None if seconds is None else _PATIENCE * seconds


def _started(root: Branch, singular: SingularLoci) -> tuple[list[Found], list[Branch]]:
    """The strata that need no search, and the branches where the others are."""
    found = list(_strata_without_search(root, singular))
    complete_types = tuple(dict.fromkeys((*(part.stratum.defects.types for part in found), *_SIMPLE)))
    matrix, loci = singular.searched(root.problem.n)
    ready = replace(root, first_matrix=matrix, complete_types=complete_types)
    return found, [
        ready.within(locus, loci[:i], root.equations, singular.defects_on(locus))
        for i, locus in enumerate(loci)
    ]


def _strata_without_search(root: Branch, singular: SingularLoci) -> Iterator[Found]:
    """The regular configurations, and the classes without IIM and RPM.

    With k_O = 0 there is neither IIM nor RPM, and the class is (RO, II) by (vii); dually (RI, IO) by (viii).
    Where both (4) and (5) hold, but neither (iii) nor (vi), it is (RI, RO, IO, II).
    """
    inputs, outputs = singular.inputs, singular.outputs
    if () not in (*inputs, *outputs):
        yield Found((), Stratum(root.equations, Defects(0, 0, 0, 0), (*inputs, *outputs)))
    for own, other, defects in (
        (inputs, outputs, Defects(0, 0, 1, 0)),
        (outputs, inputs, Defects(0, 0, 0, 1)),
    ):
        if () in other:
            continue
        paths = [path for path in own if path not in other]
        for i, path in enumerate(paths):
            for equations in disjoint_parts((*root.equations, *path)):
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
        for equations in disjoint_parts((*root.equations, *path)):
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
