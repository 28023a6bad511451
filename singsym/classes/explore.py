"""The search for all strata: from the configuration space down, locus by locus.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2; every singular configuration lies on the zero set of
det L_I or of det L_O (the Proposition of section 2.3), so the search starts with their factors.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from singsym.classes.strata import Ground, RankProblem, Stratum, stratum
from singsym.classes.types import Defects
from singsym.classes.work import Runner
from singsym.elimination.budget import Budget, Undecided
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.real.emptiness import is_empty_over_reals
from singsym.varieties.real.witness import RealSystem
from singsym.varieties.real.zerodim import real_points

Equations = tuple[Polynomial, ...]


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
    """All strata, and the branches that ended without an answer, with their reasons."""

    found: tuple[Found, ...]
    unexplored: tuple[tuple[Branch, str], ...]


def explore(branch: Branch) -> Explored:
    """Decompose one branch and find the ranks on each component: the task that workers run.

    Components without a feasible real point are left out.
    """
    feasible = branch.feasible
    nonzero = [*(e[0] for e in feasible.exclusions if len(e) == 1), *feasible.positive]
    strata = []
    try:
        with Budget(branch.seconds, branch.memory_mb):
            for component in decompose((*branch.path, *branch.equations), nonzero, ring=feasible.ring):
                samples = _samples(component, feasible)
                if samples is not None:
                    strata.append(stratum(branch.problem, Ground(component, samples)))
    except Undecided as reason:
        return Explored((), str(reason))
    return Explored(tuple(strata))


def _samples(component: Component, feasible: RealSystem) -> tuple[tuple[float, ...], ...] | None:
    """Real points of a component, numerical ones that only guide; None where it is proven to have none."""
    if any(all(component.vanishes(g) for g in group) for group in feasible.exclusions):
        return None
    if component.dimension == 0:
        points = [p for p in real_points(component.ideal) if feasible.admits(p)]
        return tuple(p.floats for p in points) or None
    found = numerical_points(component.ideal)
    if not found and is_empty_over_reals(replace(feasible, equations=component.generators)).is_yes:
        return None
    return found


def numerical_points(ideal: Ideal, count: int = 3) -> tuple[tuple[float, ...], ...]:
    """Real points near V(ideal), as many as are found quickly; they guide, they prove nothing."""
    import numpy

    from singsym.varieties.real.search import Compiled, gauss_newton

    compiled = Compiled((*ideal.generators, *ideal.ring.relations), ideal.ring)
    random = numpy.random.default_rng(0)
    found: list[tuple[float, ...]] = []
    for _ in range(8 * count):
        start = random.normal(size=len(ideal.ring.names)) * 2
        for constant in ideal.ring.constants:
            start[ideal.ring.index(constant.name)] = float((constant.low + constant.high) / 2)
        x = gauss_newton(compiled, start)
        if x is not None:
            found.append(tuple(map(float, x)))
        if len(found) == count:
            break
    return tuple(found)


Loci = Sequence[Equations]
"""A closed set as a union: of each tuple, all polynomials vanish."""


def search(root: Branch, runner: Runner, singular: tuple[Loci, Loci] | None = None) -> Exploration:
    """All strata of a branch, level by level; every level's branches are independent tasks.

    singular: the loci of (4) and (5) where they are known: then the strata with k_I = 0 or k_O = 0 are
        written down at once (conditions (vii), (viii)), and only the intersections are searched.
    The result does not depend on the runner's executor: branches keep their order.
    """
    found: dict[Equations, Found] = {}
    frontier: Sequence[Branch] = (root,)
    if singular is not None:
        found = {part.stratum.equations: part for part in _simple_strata(root, *singular)}
        frontier = _intersections(root, *singular)
    unexplored: list[tuple[Branch, str]] = []
    visited = {frozenset(branch.path) for branch in frontier}
    level = 0
    while frontier:
        level += 1
        results = runner.map(explore, frontier, f"strata, level {level}")
        following: list[Branch] = []
        for branch, explored in zip(frontier, results, strict=True):
            if explored.undecided:
                unexplored.append((branch, explored.undecided))
            for part in explored.strata:
                if _covered(branch, part) or part.equations in found:
                    continue
                found[part.equations] = Found(branch.path, part)
                following.extend(_children(branch, part, visited))
        frontier = following
    return Exploration(tuple(found.values()), tuple(unexplored))


def _simple_strata(root: Branch, inputs: Loci, outputs: Loci) -> Iterator[Found]:
    """The regular configurations, and the zeros of (4) without (5) and of (5) without (4).

    With k_O = 0 there is neither IIM nor RPM, and the class is (RO, II); dually.
    """
    yield Found(
        (), Stratum(root.equations, Defects(0, 0, 0, 0), {"L_I": tuple(inputs), "L_O": tuple(outputs)})
    )
    cases = ((inputs, outputs, "L_O", Defects(0, 0, 1, 0)), (outputs, inputs, "L_I", Defects(0, 0, 0, 1)))
    for own, other, name, defects in cases:
        for path in own:
            if path not in other:
                yield Found(path, Stratum((*root.equations, *path), defects, {name: tuple(other)}))


def _intersections(root: Branch, inputs: Loci, outputs: Loci) -> list[Branch]:
    """The parts of the zeros of (4) and (5) that together hold all configurations with k_I and k_O > 0."""
    common = [path for path in inputs if path in outputs]
    paths = [frozenset(path) for path in common]
    ordered = list(common)
    for one in inputs:
        for two in outputs:
            path = tuple(dict.fromkeys((*one, *two)))
            if not any(known <= frozenset(path) for known in paths):
                paths.append(frozenset(path))
                ordered.append(path)
    return [replace(root, path=path) for path in ordered]


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
