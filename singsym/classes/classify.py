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

from singsym.classes.cache import user_cache
from singsym.classes.curves import Counted, CurveTask, count
from singsym.classes.explore import Branch, Found
from singsym.classes.extent import EMPTY, Extent, union
from singsym.classes.processes import processes
from singsym.classes.realise import Names, Realised, RealTask, realise
from singsym.classes.result import Classification, ClassResult, Locus, Piece, conditions_latex
from singsym.classes.search import Exploration, Loci, SingularLoci, search
from singsym.classes.space import configuration_space
from singsym.classes.steps import excluded_in, found_in
from singsym.classes.strata import RankProblem, Stratum
from singsym.classes.symmetry import image, reflections
from singsym.classes.types import Defects, SingularityClass, SingularityType, feasible_classes
from singsym.classes.units import Border
from singsym.classes.work import Runner
from singsym.elimination import engines
from singsym.elimination.budget import Budget
from singsym.elimination.conditions import Conditions, Factor, conditions
from singsym.elimination.verdict import Certainty, Verdict, weakest
from singsym.kinematics.reduction import reduce
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.model import Mechanism
from singsym.varieties.real.witness import RealSystem

FIRST_SECONDS, SECOND_SECONDS = 1.0, 5.0
"""So long each stratum is looked at before it is known whether more time is worth while."""
MOST_FREEDOMS = 2
NOT_COUNTED = f"components of curves are counted for n <= {MOST_FREEDOMS}, and not within inequalities"
BOUND_SECONDS = 30.0
"""So long one is looked at last of which only a larger dimension would matter."""


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
    border = Border.of(mechanism, formulation)
    return border.classification(
        classify_inside(
            mechanism, border.inside, workers=workers, executor=executor, limits=limits, cache=cache
        )
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
    found = classify_inside(
        mechanism, equation, workers=workers, executor=executor, limits=limits, cache=cache
    )
    return Border.around(equation).classification(found)


def classify_inside(
    mechanism: Mechanism | None,
    equation: VelocityEquation,
    *,
    workers: int = 1,
    executor: Executor | None = None,
    limits: Limits | None = None,
    cache: bool = True,
) -> Classification:
    """The same in the unit of the equation, its configurations with more digits than are reported."""
    started = time.monotonic()
    with ExitStack() as stack:
        if executor is None:
            executor = processes(workers)
            if executor is not None:
                stack.enter_context(executor)
        runner = Runner(executor, user_cache() if cache else None)
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
        pieces = self._with_components(explored.found, self._pieces(explored.found))
        loci = self._loci(explored, pieces)
        classes = self._classes(explored, pieces)
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

    def _pieces(self, found: Sequence[Found]) -> list[Realised]:
        """The real pieces of all strata; only what may change the answer for its class gets much time.

        After a first look at all, those in doubt get a second and a last one, which is short where only a
        dimension larger than that known of the class would matter.
        """
        limits = self.limits
        tasks = [self._task(f, f.stratum.defects.delta) for f in found]
        first = [replace(task, seconds=limits.part(FIRST_SECONDS)) for task in tasks]
        realised = self.runner.map(realise, first, "real points")
        self._look_again(tasks, realised, limits.part(SECOND_SECONDS), "real points, second look")
        self._look_again(tasks, realised, limits.seconds, "real points, at length")
        return realised

    def _task(self, found: Found, delta: int | None) -> RealTask:
        """A stratum to be realised; delta: that of its configurations, where it is known.

        Lemma: a configuration that moves along a set of dimension d has as many independent motions, which
        are n + delta at most, as every motion of the links moves a joint; and parameters may vary.
        """
        most = None
        if self.mechanism is not None and delta is not None:
            most = self.equation.n + delta + len(self.equation.space.parameters)
        return RealTask(found, self.feasible, self.names, self.limits.seconds, self.limits.memory_mb, most)

    def _look_again(
        self, tasks: Sequence[RealTask], realised: list[Realised], seconds: float | None, stage: str
    ) -> None:
        """Realise strata in doubt once more, those of classes of unknown or small dimension first."""
        known = _dimensions(piece for part in realised for piece in part.pieces)
        least = [min(known.get(p.defects.types, 0) for p in part.pieces) for part in realised]
        doubtful = [
            i
            for i, part in enumerate(realised)
            if any(_open(p, known.get(p.defects.types)) for p in part.pieces)
        ]
        doubtful.sort(key=lambda i: least[i])
        again = []
        for i in doubtful:
            task = replace(tasks[i], seconds=seconds)
            if least[i] > 1 and not any(p.verdict.is_yes for p in realised[i].pieces):
                task = replace(task, seconds=min(seconds or BOUND_SECONDS, BOUND_SECONDS), known=least[i])
            again.append(task)
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
        """The real zeros of each factor of (4) and (5) on the configuration space, whatever their class.

        They are bounded by all singular strata together, where these are all found.
        """
        factors = [(label, factor) for label in ("4", "5") for factor in self.conditions[label].factors]
        singular = union((p.extent for p in pieces if p.defects.types), explored.doubts_of_any)
        known = [_largest_inside(factor, pieces) for _, factor in factors]
        bounded = [
            self.equation.n > 1 and piece is not None and piece.extent.at_least == singular.dimension
            for piece in known
        ]
        left = [i for i, done in enumerate(bounded) if not done]
        tasks = [self._task(self._whole(factors[i][1]), None) for i in left]
        whole = dict(zip(left, self.runner.map(realise, tasks, "loci"), strict=True))
        found = []
        for i, piece in enumerate(known):
            if piece is None or not bounded[i]:
                found.append(_at_least(whole[i].pieces[0], piece))
            else:
                found.append(replace(piece, extent=singular, points=None, components=None))
        curves = [i for i, piece in enumerate(found) if piece.dimension == 1 and self._counting]
        equations = self.equation.space.equations
        counted = self._count([CurveTask(((*equations, factors[i][1].polynomial),), ((),)) for i in curves])
        numbers = dict(zip(curves, counted, strict=True))
        return tuple(
            _locus(label, factor, found[i], numbers.get(i), self._counting)
            for i, (label, factor) in enumerate(factors)
        )

    def _whole(self, factor: Factor) -> Found:
        equations = (*self.equation.space.equations, factor.polynomial)
        return Found((factor.polynomial,), Stratum(equations, Defects(0, 0, 0, 0)))

    @property
    def _counting(self) -> bool:
        """Whether connected components of curves are counted."""
        space = self.equation.space
        return self.equation.n <= MOST_FREEDOMS and not (space.nonnegative or space.positive)

    def _count(self, tasks: Sequence[CurveTask]) -> list[Counted]:
        """The connected components of curves, closed up."""
        limits = self.limits
        limited = [replace(t, seconds=limits.seconds, memory_mb=limits.memory_mb) for t in tasks]
        return self.runner.map(count, limited, "curves")

    # -- classes -------------------------------------------------------------------------------------

    def _with_components(self, found: Sequence[Found], realised: Sequence[Realised]) -> list[Piece]:
        """All pieces; the curves of classes that are curves with their numbers of components."""
        known = _dimensions(piece for part in realised for piece in part.pieces)
        curves = [
            i
            for i, part in enumerate(realised)
            if self._counting and part.pieces and part.pieces[0].dimension == 1
            if (types := part.pieces[0].defects.types) and known[types] == 1
        ]
        tasks = [self._curve(found[i], realised[i]) for i in curves]
        counted = dict(zip(curves, self._count(tasks), strict=True))
        pieces: list[Piece] = []
        for i, part in enumerate(realised):
            number = counted.get(i, Counted(None))
            for k, piece in enumerate(part.pieces):
                if number.components is not None:
                    piece = replace(piece, components=number.components[k])
                elif number.reason:
                    piece = replace(piece, uncounted=number.reason, countable=number.open)
                pieces.append(piece)
        return pieces

    def _curve(self, found: Found, part: Realised) -> CurveTask:
        """A stratum that is a curve, and its images, off what other strata of the same types have."""
        elsewhere = [tuple(image(locus, r) for locus in found.stratum.elsewhere) for r in found.images]
        own = self.equation.space.exclusions
        exclusions = ((*own, *p.exclusions, *e) for p, e in zip(part.pieces, elsewhere, strict=True))
        return CurveTask(tuple(p.basis for p in part.pieces), tuple(exclusions))

    def _classes(self, explored: Exploration, pieces: Sequence[Piece]) -> tuple[ClassResult, ...]:
        occurring = {p.defects.types for p in pieces if p.verdict.is_yes}
        possible = set(feasible_classes(self.equation.n))
        results = []
        for candidate in feasible_classes():
            if candidate not in possible:
                reason = f"impossible for n = {self.equation.n}, by the inequalities of the four ranks"
                results.append(
                    ClassResult(candidate, Verdict.no(reason=reason), (), EMPTY, None, None, (), "")
                )
                continue
            own = [p for p in pieces if p.defects.types == candidate.types]
            results.append(_class(candidate, occurring, explored, own, self._counting))
        return tuple(results)


def _class(
    candidate: SingularityClass,
    occurring: set[SingularityType],
    explored: Exploration,
    own: Sequence[Piece],
    counting: bool,
) -> ClassResult:
    """What its pieces say of a class, and the doubts about those and about parts that were not searched."""
    present = sorted((p for p in own if p.verdict.is_yes), key=lambda p: (-p.extent.at_least, str(p.path)))
    unexplored = explored.doubts(candidate.types)
    extent = union((p.extent for p in own if not p.verdict.is_no), unexplored)
    known = explored.certainty_of(candidate.types)
    points = components = None
    uncounted = remark = ""
    if present:
        certainty = present[0].verdict.certainty
        verdict = Verdict.yes(certainty, reason=_reservations(extent, known))
        steps: tuple[str, ...] = (found_in(candidate.types),)
        if extent.dimension == 0 or (counting and extent.dimension == 1):
            points, components, uncounted, remark = _counts(extent, own)
        elif extent.dimension == 1:
            remark = NOT_COUNTED
    elif unexplored or any(p.verdict.is_undecided for p in own):
        reasons = [*(p.verdict.reason for p in own if p.verdict.is_undecided), *unexplored]
        verdict = Verdict.undecided("; ".join(dict.fromkeys(reasons)))
        steps = (found_in(candidate.types),)
    else:
        certainty = weakest(known, *(p.verdict.certainty for p in own))
        ruled_out = "; ".join(dict.fromkeys(p.verdict.reason for p in own))
        verdict = Verdict.no(certainty, reason=ruled_out or "no stratum of the four ranks has these types")
        steps, extent = (excluded_in(candidate.types, occurring),), EMPTY
    return ClassResult(
        candidate,
        verdict,
        tuple(present),
        extent,
        points,
        components,
        steps,
        conditions_latex(present),
        uncounted,
        remark,
    )


def _counts(extent: Extent, pieces: Sequence[Piece]) -> tuple[int | None, int | None, str, str]:
    """Points and connected components of a class; or why not, if a larger budget could help, and if not.

    Points of a curve's class that are on no curve of it are components too.
    """
    own = [p for p in pieces if not p.verdict.is_no]
    left = [p for p in own if p.verdict.is_undecided or p.components is None]
    if left:
        reasons = dict.fromkeys(p.uncounted or p.extent.open or p.verdict.reason for p in left)
        said = f"not counted: {'; '.join(reasons)}"
        return (None, None, said, "") if any(p.countable for p in left) else (None, None, "", said)
    total = sum(p.components or 0 for p in own)
    return (total if extent.dimension == 0 else None), total, "", ""


def _largest_inside(factor: Factor, pieces: Sequence[Piece]) -> Piece | None:
    """The largest stratum on whose way down a factor was set to zero, if one is known to have a point."""
    inside = [p for p in pieces if factor.polynomial in p.path and p.verdict.is_yes]
    return max(inside, key=lambda p: p.extent.at_least, default=None)


def _at_least(whole: Piece, inside: Piece | None) -> Piece:
    """A locus of which a stratum inside may show more than it shows by itself."""
    if inside is None or inside.extent.at_least <= whole.extent.at_least:
        return whole
    extent = replace(whole.extent, at_least=inside.extent.at_least)
    return replace(whole, verdict=inside.verdict, extent=extent, witnesses=inside.witnesses)


def _locus(label: str, factor: Factor, piece: Piece, counted: Counted | None, counting: bool) -> Locus:
    components, reason, is_open = piece.components, piece.extent.open, True
    if counted is not None:
        components = None if counted.components is None else counted.components[0]
        reason, is_open = counted.reason, counted.open
    elif piece.dimension == 1 and not counting:
        reason, is_open = NOT_COUNTED, False
    reason = "" if components is not None else reason
    return Locus(
        label,
        factor.polynomial,
        factor.words,
        factor.latex(),
        piece.verdict,
        piece.extent,
        components,
        piece.points,
        reason if is_open else "",
        "" if is_open else reason,
    )


def _dimensions(pieces: Iterable[Piece]) -> dict[SingularityType, int]:
    """The largest dimension of each class that a certified point shows."""
    found: dict[SingularityType, int] = {}
    for piece in pieces:
        if piece.verdict.is_yes:
            types = piece.defects.types
            found[types] = max(piece.extent.at_least, found.get(types, 0))
    return found


def _open(piece: Piece, known: int | None) -> bool:
    """Whether a longer look may change what is known of the class: its dimension, points or components."""
    if piece.verdict.is_no:
        return False
    most = piece.extent.at_most
    if known is None or most is None or most > known:
        return True
    uncounted = known == 0 and piece.points is None
    return uncounted or (piece.verdict.is_undecided and known < 2)


def _reservations(extent: Extent, known: Certainty) -> str:
    """What is not known, or not proven, of a class that occurs; `known`: how it is that there is no more."""
    if extent.dimension is None:
        return f"its dimension is {extent}: {extent.open}"
    if known != "proven":
        return "that there is no more of it rests on random primes"
    if extent.bounded != "proven":
        return "that no part of it has a larger dimension rests on random primes"
    return ""
