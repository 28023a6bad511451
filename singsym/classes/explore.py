"""The search for all strata: from the configuration space down, locus by locus.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2; every singular configuration lies on the zero set of
det L_I or of det L_O (the Proposition of section 2.3), so the search starts with their factors.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from singsym.classes.patches import Patch, patches
from singsym.classes.strata import Ground, NotEvident, RankProblem, Samples, Stratum, patch_stratum, stratum
from singsym.classes.types import Defects, SingularityType
from singsym.classes.work import Runner
from singsym.elimination.budget import Budget, Undecided
from singsym.polynomials import Polynomial
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.real.emptiness import is_empty_over_reals
from singsym.varieties.real.witness import RealSystem
from singsym.varieties.real.zerodim import real_points

_T = SingularityType
Equations = tuple[Polynomial, ...]
STARTS = 60
"""Random starts for numerical points of a set."""


@dataclass(frozen=True)
class Branch:
    """A closed part of the configuration space to be decomposed into strata.

    equations: the loop equations; path: the factors and minors that vanish there besides.
    feasible: the exclusions and inequalities of the feasible set Omega (its equations are not used).
    covered: matrices whose loci of lower rank in this branch are searched by another one.
    seconds, memory_mb: the budget of the decomposition.
    """

    problem: RankProblem
    feasible: RealSystem
    equations: Equations
    path: Equations = ()
    covered: tuple[str, ...] = ()
    seconds: float | None = None
    memory_mb: int | None = None


@dataclass(frozen=True)
class Explored:
    """The strata of a branch, or the reason why there are none yet."""

    strata: tuple[Stratum, ...] = ()
    undecided: str = ""

    @property
    def provisional(self) -> bool:
        """Whether a larger budget could say more."""
        return bool(self.undecided)


@dataclass(frozen=True)
class Found:
    """A stratum and the path that led to it."""

    path: Equations
    stratum: Stratum


@dataclass(frozen=True)
class Exploration:
    """All strata, and the branches that ended without an answer, with their reasons.

    evident: the strata with k_I = 0 or k_O = 0 are all there, whatever is unexplored.
    """

    found: tuple[Found, ...]
    unexplored: tuple[tuple[Branch, str], ...]
    evident: bool = False

    def doubts(self, types: SingularityType) -> tuple[str, ...]:
        """Why there may be more configurations of these types than were found."""
        if self.evident and types in (_T.RI | _T.IO, _T.RO | _T.II):
            return ()
        return tuple(dict.fromkeys(reason for _, reason in self.unexplored))


def explore(branch: Branch) -> Explored:
    """Take one branch apart and find the ranks on each part: the task that workers run.

    Parts without a feasible real point are left out.
    """
    feasible = branch.feasible
    nonzero = [*(e[0] for e in feasible.exclusions if len(e) == 1), *feasible.positive]
    strata: list[Stratum] = []
    try:
        with Budget(branch.seconds, branch.memory_mb):
            for patch in patches((*branch.path, *branch.equations), nonzero, feasible.ring):
                strata += _patch_strata(branch, patch, nonzero)
    except Undecided as reason:
        return Explored((), str(reason))
    return Explored(tuple(strata))


def _patch_strata(branch: Branch, patch: Patch, nonzero: Sequence[Polynomial]) -> Iterator[Stratum]:
    """The stratum of a patch as it stands; where that is not evident, those of its components."""
    feasible = branch.feasible
    if any(all(patch.restrict(g).is_zero for g in group) for group in feasible.exclusions):
        return
    independent = len(patch.generators) + len(feasible.ring.relations) < len(feasible.ring.names)
    found = numerical_points(feasible, patch.generators) if independent else ()
    if found:
        try:
            yield patch_stratum(branch.problem, patch, feasible, found)
            return
        except NotEvident:
            pass
    for component in decompose(patch.generators, nonzero, ring=feasible.ring):
        samples = _samples(component, feasible)
        if samples is not None:
            yield stratum(branch.problem, Ground(component, samples))


def _samples(component: Component, feasible: RealSystem) -> Samples | None:
    """Real points of a component, numerical ones that only guide; None where it is proven to have none."""
    if any(all(component.vanishes(g) for g in group) for group in feasible.exclusions):
        return None
    if component.dimension == 0:
        points = [p for p in real_points(component.ideal) if feasible.admits(p)]
        return tuple(p.floats for p in points) or None
    found = numerical_points(feasible, component.generators)
    if not found and is_empty_over_reals(replace(feasible, equations=component.generators)).is_yes:
        return None
    return found


def numerical_points(feasible: RealSystem, equations: Equations, count: int = 3) -> Samples:
    """Real points near the zeros of the equations and off the exclusions, as many as are found quickly."""
    import numpy

    from singsym.varieties.real.search import Compiled, gauss_newton

    ring = feasible.ring
    compiled = Compiled((*equations, *ring.relations), ring)
    random = numpy.random.default_rng(0)
    found: list[tuple[float, ...]] = []
    for _ in range(STARTS):
        start = random.normal(size=len(ring.names)) * 2
        for constant in ring.constants:
            start[ring.index(constant.name)] = float((constant.low + constant.high) / 2)
        x = gauss_newton(compiled, start)
        if x is None:
            continue
        point = tuple(map(float, x))
        if all(any(abs(g.evaluate(point)) > 1e-6 for g in group) for group in feasible.exclusions) and all(
            p.evaluate(point) > -1e-9 for p in (*feasible.positive, *feasible.nonnegative)
        ):
            found.append(point)
        if len(found) == count:
            break
    return tuple(found)


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
    """All strata of a branch, level by level; every level's branches are independent tasks.

    singular: where known, the strata that need no search are written down at once, as steps (4)-(6) of the
        paper do, and only {1} and {2} are searched, or where these are not known, (4) and (5) together.
    budget: of the whole search; what is left when it is used up comes back unexplored.
    The result does not depend on the runner's executor: branches keep their order.
    """
    found: dict[Equations, Found] = {}
    frontier: Sequence[Branch] = (root,)
    if singular is not None:
        found = {part.stratum.equations: part for part in _evident_strata(root, singular)}
        frontier = [replace(root, path=path) for path in _to_search(singular)]
    whole = budget or Budget()
    unexplored: list[tuple[Branch, str]] = []
    visited = {frozenset(branch.path) for branch in frontier}
    level = 0
    while frontier:
        level += 1
        results = runner.map_within(explore, frontier, f"strata, level {level}", whole)
        following: list[Branch] = []
        for branch, explored in zip(frontier, results, strict=True):
            if explored is None:
                unexplored.append((branch, f"the budget of {whole.seconds:g} s for the search is used up"))
                continue
            if explored.undecided:
                unexplored.append((branch, explored.undecided))
            for part in explored.strata:
                if _covered(branch, part) or part.equations in found:
                    continue
                found[part.equations] = Found(branch.path, part)
                following.extend(_children(branch, part, visited))
        frontier = following
    return Exploration(tuple(found.values()), tuple(unexplored), singular is not None)


def _evident_strata(root: Branch, singular: SingularLoci) -> Iterator[Found]:
    """The regular configurations, and the classes without IIM and RPM.

    With k_O = 0 there is neither IIM nor RPM, and the class is (RO, II) by (vii); dually (RI, IO) by (viii).
    Where both (4) and (5) hold, but neither (iii) nor (vi), it is (RI, RO, IO, II).
    """
    inputs, outputs = singular.inputs, singular.outputs
    regular = Stratum(root.equations, Defects(0, 0, 0, 0), {"L_I": inputs, "L_O": outputs})
    yield Found((), regular)
    for own, other, name, defects in (
        (inputs, outputs, "L_O", Defects(0, 0, 1, 0)),
        (outputs, inputs, "L_I", Defects(0, 0, 0, 1)),
    ):
        paths = [path for path in own if path not in other]
        for i, path in enumerate(paths):
            equations = (*root.equations, *path)
            yield Found(path, Stratum(equations, defects, {name: other}, elsewhere=tuple(paths[:i])))
    if singular.passive is None or singular.mobility is None:
        return
    taken_out = {"L": singular.mobility, "L_p": singular.passive}
    searched = (*singular.passive, *singular.mobility)
    paths = [
        path
        for path in _intersections(inputs, outputs)
        if not any(set(locus) <= set(path) for locus in searched)
    ]
    for i, path in enumerate(paths):
        equations = (*root.equations, *path)
        yield Found(path, Stratum(equations, Defects(0, 0, 1, 1), taken_out, elsewhere=tuple(paths[:i])))


def _to_search(singular: SingularLoci) -> list[Equations]:
    """Closed sets that together hold all configurations of type IIM or RPM."""
    if singular.passive is None or singular.mobility is None:
        return _intersections(singular.inputs, singular.outputs)
    paths = dict.fromkeys((*singular.passive, *singular.mobility))
    return [path for path in paths if not any(set(other) < set(path) for other in paths)]


def _intersections(one: Loci, two: Loci) -> list[Equations]:
    """The common zeros of two unions of loci as a union, without those that lie in others by their paths."""
    paths = [path for path in one if path in two]
    for first in one:
        for second in two:
            path = tuple(dict.fromkeys((*first, *second)))
            if not any(set(known) <= set(path) for known in paths):
                paths.append(path)
    return paths


def _covered(branch: Branch, part: Stratum) -> bool:
    """Whether the part lies wholly in a locus that another branch searches."""
    return "L_I" in branch.covered and part.defects.k_I > 0


def _children(branch: Branch, part: Stratum, visited: set[frozenset[Polynomial]]) -> list[Branch]:
    """The branches where the ranks of a stratum drop; a product is split into its factors."""
    defects = part.defects
    fresh = []
    for name in sorted(part.loci):
        if name in branch.covered:
            continue
        regular = defects.k_I == 0 and defects.k_O == 0
        covered = ("L_I",) if regular and name == "L_O" else ()
        for equations in (e for locus in part.loci[name] for e in split_product(locus)):
            path = tuple(dict.fromkeys((*branch.path, *equations)))
            if frozenset(path) in visited:
                continue
            visited.add(frozenset(path))
            fresh.append(replace(branch, path=path, covered=covered))
    return fresh


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
