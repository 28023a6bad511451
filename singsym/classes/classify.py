"""The singularity set of a mechanism and its division into the 21 classes.

Source: Zlatanov, Fenton, Benhabib (1998), section 3: conditions (4), (5) and the six steps of 3.2.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf

from singsym.classes.explore import Branch, Found
from singsym.classes.realise import Counted, CurveTask, Names, Realised, RealTask, count, realise
from singsym.classes.result import Classification, ClassResult, Locus, Piece
from singsym.classes.search import Exploration, Loci, SingularLoci, search
from singsym.classes.space import configuration_space
from singsym.classes.steps import excluded_in, found_in
from singsym.classes.strata import RankProblem, Stratum
from singsym.classes.symmetry import reflections
from singsym.classes.types import Defects, SingularityClass, SingularityType, feasible_classes
from singsym.classes.work import Cache, Runner, cache_folder, processes
from singsym.elimination import engines
from singsym.elimination.attempts import attempt
from singsym.elimination.budget import Budget
from singsym.elimination.conditions import Conditions, Factor, conditions, polynomial_latex
from singsym.elimination.ideal import Ideal
from singsym.elimination.verdict import Certainty, Verdict, weakest
from singsym.kinematics.reduction import reduce
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism.model import Mechanism
from singsym.polynomials import Polynomial
from singsym.varieties.real.witness import RealSystem

MEMBERSHIP_SECONDS = 5.0
FIRST_SECONDS, SECOND_SECONDS = 0.5, 2.0
"""So long each stratum is looked at before it is known whether more time is worth while."""


@dataclass(frozen=True)
class Limits:
    """What a classification may use, None without limit.

    seconds, memory_mb: of work (see `work`) and memory for each task (a branch, a stratum, a curve); total:
    seconds of time for the search for strata.
    """

    seconds: float | None = 60.0
    memory_mb: int | None = None
    total: float | None = 1800.0

    def part(self, seconds: float) -> float:
        """So many seconds, or those of a task where they are fewer."""
        return seconds if self.seconds is None else min(seconds, self.seconds)


def classify(
    mechanism: Mechanism,
    *,
    formulation: str = "auto",
    workers: int = 1,
    executor: Executor | None = None,
    limits: Limits | None = None,
    cache: bool = True,
) -> Classification:
    """Find the singularity set of a mechanism and all its classes, each with proof, witness or doubt.

    formulation: see `kinematics.formulations.place`; workers: processes, unless an `executor` is given
    (any of `concurrent.futures`, also Dask's or MPI's); limits: budget of each task; cache: use the cache on
    disk, so that an interrupted run goes on where it was.
    Raises `MechanismError` for a mechanism that cannot be placed.

    >>> from singsym.mechanism import load
    >>> result = classify(load("slider-crank"), cache=False)
    >>> [(c.singularity_class, c.points) for c in result.classes if c.verdict.is_yes]
    [(1 (RI, IO), 2)]
    """
    return classify_equation(
        mechanism,
        velocity_equation(mechanism, formulation),
        workers=workers,
        executor=executor,
        limits=limits,
        cache=cache,
    )


def classify_equation(
    mechanism: Mechanism | None,
    equation: VelocityEquation,
    *,
    workers: int = 1,
    executor: Executor | None = None,
    limits: Limits | None = None,
    cache: bool = True,
) -> Classification:
    """The same for a velocity equation, such as one of the user's own; see `classify`."""
    started = time.monotonic()
    with ExitStack() as stack:
        if executor is None:
            executor = processes(workers)
            if executor is not None:
                stack.enter_context(executor)
        runner = Runner(executor, Cache(cache_folder()) if cache else None)
        work = _Work(mechanism, conditions(equation, reduce(equation)), runner, limits or Limits())
        return work.classification(started)


@dataclass
class _Work:
    """One classification under way."""

    mechanism: Mechanism | None
    conditions: Conditions
    runner: Runner
    limits: Limits

    @property
    def equation(self) -> VelocityEquation:
        return self.conditions.equation

    @cached_property
    def feasible(self) -> RealSystem:
        space = self.equation.space
        return RealSystem(space.ring, (), space.exclusions, space.positive, space.nonnegative)

    @cached_property
    def names(self) -> Names:
        return Names(self.equation.space.points, self.equation.values)

    def problem(self) -> RankProblem:
        """The four matrices of the reduced velocity equation."""
        matrices = {name: self.conditions.matrix(name) for name in ("L", "L_I", "L_O", "L_p")}
        return RankProblem(matrices, self.conditions.reduction.constant, self.equation.N, self.equation.n)

    def classification(self, started: float) -> Classification:
        problem = self.problem()
        root = Branch(
            problem,
            self.feasible,
            self.equation.space.equations,
            symmetries=reflections(self.feasible, self.equation.space.equations, problem.matrices.values()),
            seconds=self.limits.seconds,
            memory_mb=self.limits.memory_mb,
        )
        explored = search(root, self.runner, self._singular_loci(), Budget(self.limits.total))
        pieces = self._pieces(explored.found)
        loci = self._loci(explored, pieces)
        classes = self._classes(explored, pieces, loci)
        return Classification(
            self.mechanism,
            self.equation,
            self.conditions.reduction,
            configuration_space(self.mechanism, self.conditions, pieces, classes),
            loci,
            classes,
            tuple(name for name in engines.allowed() if engines.has(name)),
            time.monotonic() - started,
        )

    def _pieces(self, found: Sequence[Found]) -> list[Piece]:
        """The real pieces of all strata; only what may change the answer for its class gets much time.

        After a first look at all, those in doubt get a second one; a last one only those whose class is not
        known to occur, or is known as a curve or points, which are to be counted.
        """
        limits = self.limits
        tasks = [RealTask(f, self.feasible, self.names, None, limits.memory_mb) for f in found]
        first = [replace(task, seconds=limits.part(FIRST_SECONDS)) for task in tasks]
        realised = self.runner.map(realise, first, "real points")
        self._look_again(tasks, realised, limits.part(SECOND_SECONDS), "real points, second look")
        self._look_again(tasks, realised, limits.seconds, "real points, at length", most=1)
        return [piece for part in realised for piece in part.pieces]

    def _look_again(
        self,
        tasks: Sequence[RealTask],
        realised: list[Realised],
        seconds: float | None,
        stage: str,
        most: float = inf,
    ) -> None:
        """Realise strata in doubt once more, those of classes of unknown or small dimension first.

        most: the largest known dimension of the classes of strata that are looked at.
        """
        known = _dimensions(piece for part in realised for piece in part.pieces)
        least = [min(known.get(p.defects.types, 0) for p in part.pieces) for part in realised]
        doubtful = [
            i
            for i, part in enumerate(realised)
            if least[i] <= most and any(_open(p, known.get(p.defects.types)) for p in part.pieces)
        ]
        doubtful.sort(key=lambda i: least[i])
        again = [
            replace(tasks[i], seconds=seconds, known=least[i] if least[i] > 1 else None) for i in doubtful
        ]
        for i, part in zip(doubtful, self.runner.map(realise, again, stage), strict=True):
            realised[i] = part

    def _singular_loci(self) -> SingularLoci | None:
        """The alternatives of (4), (5), (iii) and (vi), where they are known and not everything."""
        found = [self._alternatives(label) for label in ("4", "5", "iii", "vi")]
        inputs, outputs, passive, mobility = found
        return None if inputs is None or outputs is None else SingularLoci(inputs, outputs, passive, mobility)

    def _alternatives(self, label: str) -> Loci | None:
        condition = self.conditions[label]
        if condition.alternatives is None or condition.everywhere:
            return None
        return condition.polynomials

    # -- loci ----------------------------------------------------------------------------------------

    def _loci(self, explored: Exploration, pieces: Sequence[Piece]) -> tuple[Locus, ...]:
        factors = [(label, factor) for label in ("4", "5") for factor in self.conditions[label].factors]
        if self.equation.n == 1:
            whole = self.runner.map(realise, [self._whole(f) for _, f in factors], "loci")
            return tuple(
                self._finite_locus(label, f, found.pieces[0])
                for (label, f), found in zip(factors, whole, strict=True)
            )
        loci = [self._locus(label, factor, explored, pieces) for label, factor in factors]
        curves = [i for i, locus in enumerate(loci) if locus.dimension == 1]
        equations = self.equation.space.equations
        tasks = [
            CurveTask((*equations, loci[i].factor), self.limits.seconds, self.limits.memory_mb)
            for i in curves
        ]
        if self.equation.space.nonnegative or self.equation.space.positive:
            tasks, curves = [], []
        for i, counted in zip(curves, self.runner.map(count, tasks, "curves"), strict=True):
            loci[i] = _with_components(loci[i], counted)
        return tuple(loci)

    def _whole(self, factor: Factor) -> RealTask:
        """All real zeros of a factor, whatever their class."""
        equations = (*self.equation.space.equations, factor.polynomial)
        found = Found((factor.polynomial,), Stratum(equations, Defects(0, 0, 0, 0)))
        return RealTask(found, self.feasible, self.names, self.limits.seconds, self.limits.memory_mb)

    def _finite_locus(self, label: str, factor: Factor, piece: Piece) -> Locus:
        polynomial, points = factor.polynomial, piece.points
        return Locus(
            label, polynomial, factor.words, factor.latex(), piece.verdict, piece.dimension, points, points
        )

    def _locus(self, label: str, factor: Factor, explored: Exploration, pieces: Sequence[Piece]) -> Locus:
        """What the pieces on which this factor vanishes say of its zero set."""
        inside = _largest(factor.polynomial, pieces)
        doubts = [reason for branch, reason in explored.unexplored if factor.polynomial in branch.path]
        doubts += [p.verdict.reason for p in pieces if factor.polynomial in p.path and p.verdict.is_undecided]
        dimension = max((p.dimension for p in inside if p.dimension is not None), default=-1)
        verdict = Verdict.yes() if dimension >= 0 else Verdict.no(reason="no real point")
        if doubts and dimension < self.equation.n - 1:
            verdict = Verdict.undecided("; ".join(dict.fromkeys(doubts)))
        points = _counted(inside) if dimension == 0 else None
        return Locus(
            label,
            factor.polynomial,
            factor.words,
            factor.latex(),
            verdict,
            None if verdict.is_undecided else dimension,
            points,
            points,
        )

    # -- classes -------------------------------------------------------------------------------------

    def _classes(
        self, explored: Exploration, pieces: Sequence[Piece], loci: Sequence[Locus]
    ) -> tuple[ClassResult, ...]:
        occurring = {p.defects.types for p in pieces if p.verdict.is_yes}
        possible = set(feasible_classes(self.equation.n))
        results = []
        for candidate in feasible_classes():
            if candidate not in possible:
                reason = f"impossible for n = {self.equation.n}, by the inequalities of the four ranks"
                results.append(
                    ClassResult(candidate, Verdict.no(reason=reason), (), None, None, None, (), "")
                )
                continue
            results.append(self._class(candidate, occurring, explored, pieces, loci))
        return tuple(results)

    def _class(
        self,
        candidate: SingularityClass,
        occurring: set[SingularityType],
        explored: Exploration,
        pieces: Sequence[Piece],
        loci: Sequence[Locus],
    ) -> ClassResult:
        own = [p for p in pieces if p.defects.types == candidate.types]
        present = sorted(
            (p for p in own if p.verdict.is_yes), key=lambda p: (-(p.dimension or 0), str(p.path))
        )
        dimension = max((p.dimension for p in present if p.dimension is not None), default=None)
        doubts = [p.verdict.reason for p in own if _in_doubt(p, dimension)]
        doubts += explored.doubts(candidate.types)
        known = explored.certainty_of(candidate.types)
        if present:
            certainty = present[0].verdict.certainty
            verdict = Verdict.yes(certainty, reason=_reservations(own, doubts, known))
            steps: tuple[str, ...] = (found_in(candidate.types),)
        elif doubts:
            verdict = Verdict.undecided("; ".join(dict.fromkeys(doubts)))
            steps = (found_in(candidate.types),)
        else:
            ruled_out = [p.verdict.reason for p in own]
            certainty = weakest(known, *(p.verdict.certainty for p in own))
            reason = "; ".join(dict.fromkeys(ruled_out)) or "no stratum of the four ranks has these types"
            verdict = Verdict.no(certainty, reason=reason)
            steps = (excluded_in(candidate.types, occurring),)
        points = _counted(present) if dimension == 0 and not doubts else None
        return ClassResult(
            candidate,
            verdict,
            tuple(present),
            dimension,
            points,
            _components(present, loci) if dimension == 1 else points,
            steps,
            conditions_latex(present),
        )


def _largest(polynomial: Polynomial, pieces: Sequence[Piece]) -> list[Piece]:
    """The pieces of largest dimension on which a polynomial vanishes: all of them where they are points."""
    known = [p for p in pieces if p.dimension is not None and p.dimension >= 0]
    for piece in sorted(known, key=lambda p: (-(p.dimension or 0), polynomial not in p.path)):
        if piece.dimension == 0:
            return [p for p in known if p.dimension == 0 and _vanishes(polynomial, p)]
        if _vanishes(polynomial, piece):
            return [piece]
    return []


def _vanishes(polynomial: Polynomial, piece: Piece) -> bool:
    """Whether a polynomial vanishes on a piece: by its path, or as a member of its ideal.

    A witness where it is large rules it out; a membership that takes long is not waited for.
    """
    if polynomial in piece.path:
        return True
    places = [[float(w.coordinates[name]) for name in polynomial.ring.names] for w in piece.witnesses]
    if any(abs(polynomial.evaluate(x)) > 1e-6 for x in places):
        return False
    with attempt("membership", MEMBERSHIP_SECONDS):
        return Ideal(polynomial.ring, piece.basis).contains(polynomial)
    return False


def _counted(pieces: Sequence[Piece]) -> int | None:
    """The points of finite pieces together; None where those of one were not counted."""
    if any(p.points is None and p.dimension == 0 for p in pieces):
        return None
    return sum(p.points or 0 for p in pieces)


def _with_components(locus: Locus, counted: Counted) -> Locus:
    verdict = locus.verdict
    if counted.components is None:
        verdict = replace(verdict, reason=f"components not counted: {counted.reason}")
    return replace(locus, components=counted.components, verdict=verdict)


def _dimensions(pieces: Iterable[Piece]) -> dict[SingularityType, int]:
    """The largest known dimension of pieces of each class."""
    found: dict[SingularityType, int] = {}
    for piece in pieces:
        if piece.verdict.is_yes and piece.dimension is not None:
            types = piece.defects.types
            found[types] = max(piece.dimension, found.get(types, 0))
    return found


def _in_doubt(piece: Piece, known: int | None) -> bool:
    """Whether a piece may change what is known of its class: dimension, points or connected components."""
    if not piece.verdict.is_undecided and piece.dimension is not None:
        return False
    return known is None or known < 2 or piece.at_most is None or piece.at_most > known


def _open(piece: Piece, known: int | None) -> bool:
    """Whether a longer look may be worth while: also at points that are to be counted."""
    uncounted = piece.verdict.is_yes and piece.dimension == 0 and piece.points is None
    return _in_doubt(piece, known) or (uncounted and known == 0)


def _reservations(pieces: Iterable[Piece], doubts: Sequence[str], known: Certainty) -> str:
    """What is not known, or not proven, of a class that occurs; `known`: how it is that there is no more."""
    if doubts:
        return f"there may be more of it: {'; '.join(dict.fromkeys(doubts))}"
    if known != "proven":
        return "that there is no more of it rests on random primes"
    if any(p.verdict.is_undecided and p.bounded != "proven" for p in pieces):
        return "that no part of it has a larger dimension rests on random primes"
    return ""


def _components(pieces: Sequence[Piece], loci: Sequence[Locus]) -> int | None:
    """Components of a one-dimensional class, each locus counted by itself and closed up."""
    paths = {p.path for p in pieces if p.dimension == 1}
    total = 0
    for path in paths:
        counted = [locus.components for locus in loci if path == (locus.factor,)]
        if not counted or counted[0] is None:
            return None
        total += counted[0]
    return total


def conditions_latex(pieces: Sequence[Piece]) -> str:
    """The equations and inequations of a class as LaTeX: the factors on the way to each piece."""
    lines: dict[str, None] = {}
    for piece in pieces:
        equal = [f"{polynomial_latex(p)} = 0" for p in piece.path]
        unequal = [_nonzero_latex(e) for e in piece.exclusions]
        lines[r",\; ".join((*equal, *unequal))] = None
    return r" \quad\text{or}\quad ".join(lines)


def _nonzero_latex(exclusion: tuple[Polynomial, ...]) -> str:
    if len(exclusion) == 1:
        factors = [p for p, _ in exclusion[0].factors()]
        if len(factors) > 1:
            return r",\; ".join(f"{polynomial_latex(p)} \\ne 0" for p in factors)
        return f"{polynomial_latex(exclusion[0])} \\ne 0"
    listed = ", ".join(polynomial_latex(p, 6) for p in exclusion)
    return rf"\left({listed}\right) \ne 0"
