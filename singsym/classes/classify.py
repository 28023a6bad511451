"""The singularity set of a mechanism and its division into the 21 classes.

Source: Zlatanov, Fenton, Benhabib (1998), section 3: conditions (4), (5) and the six steps of 3.2.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import inf
from typing import TypeVar

from singsym.classes.conclusions import (
    MOST_FREEDOMS,
    at_least,
    classes_of,
    largest_inside,
    locus_of,
    remarks_of,
    with_numbers,
)
from singsym.classes.configuration_space import configuration_space, smoothness
from singsym.classes.findings import Told, tell_conditions
from singsym.classes.realisation.alike import realise_all
from singsym.classes.realisation.certified_configuration import Names
from singsym.classes.realisation.curve_components import Counted, CurveTask, count, counted_in_one_way
from singsym.classes.realisation.local_coordinates import local_coordinates
from singsym.classes.realisation.looks import bounded_by, is_open, known_dimensions, merged
from singsym.classes.realisation.realisation import Realised, RealTask
from singsym.classes.result import Classification, Locus, Piece
from singsym.classes.running.runner import Interrupted, Runner, running
from singsym.classes.strata.branches import Branch, Found
from singsym.classes.strata.ranks import Stratum
from singsym.classes.strata.reflections import image, reflections
from singsym.classes.strata.search import Exploration, search
from singsym.classes.strata.start import feasible_set, rank_problem, singular_loci
from singsym.classes.taxonomy.types import Defects
from singsym.classes.unit_border import Border
from singsym.conditions.conditions import Conditions, conditions
from singsym.conditions.factor import Factor
from singsym.effort import chance, patience
from singsym.effort.budget import Budget, Undecided
from singsym.effort.progress import Sink, to
from singsym.effort.verdict import weakest
from singsym.elimination import engines
from singsym.kinematics.reduction import reduce
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.model import Mechanism
from singsym.polynomials.unit_circles import Pair, unit_circles
from singsym.varieties.real.dimension.extent import Extent, union
from singsym.varieties.real.system import RealSystem

T = TypeVar("T")

SHARES = (0.45, 0.72, 0.9, 1.0)
"""So much of time and work is used up when the search, what is real of the strata, all tasks, and what is
concluded from them end."""


@dataclass(frozen=True)
class Limits:
    """What a classification may use, None without limit.

    seconds, memory_mb: of work (see `processor_time`) and memory for each task (a branch, a stratum, a
    curve); total: seconds of work of all tasks together; clock: seconds on the clock after which every task
    ends, whatever else the machine did.  Almost half of these two is for the search for strata, and the most
    of the rest for what is real of them.
    """

    seconds: float | None = 60.0
    memory_mb: int | None = None
    total: float | None = 3600.0
    clock: float | None = None

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
    progress: Sink | None = None,
) -> Classification:
    """Find the singularity set of a mechanism and all its classes, each with proof, witness or doubt.

    formulation: see `kinematics.formulations.place`; workers: processes, unless an `executor` is given
    (any of `concurrent.futures`, also Dask's or MPI's); limits: budget of each task; cache: use the cache on
    disk, so that an interrupted run goes on where it was; progress: called with an `Event` now and then, once
    a second at least while tasks are under way.  A `KeyboardInterrupt` that it raises does what Ctrl-C does,
    and ends the work; so does any other exception, which passes through.
    Raises `MechanismError` for a mechanism that cannot be placed, and `Interrupted` with what is known on
    a `KeyboardInterrupt` while tasks are under way.

    >>> from singsym.mechanism import load
    >>> result = classify(load("slider-crank"), cache=False)
    >>> [(c.singularity_class, c.points) for c in result.classes if c.verdict.is_yes]
    [(1 (RI, IO), 2)]
    """
    border, limits = Border.of(mechanism, formulation), limits or Limits()
    with to(progress), running(workers, executor, limits.clock, cache) as runner:
        found = classify_inside(mechanism, border, runner, limits)
    return _whole(border.classification(found))


def classify_equation(
    mechanism: Mechanism | None,
    equation: VelocityEquation,
    *,
    workers: int = 1,
    executor: Executor | None = None,
    limits: Limits | None = None,
    cache: bool = True,
    progress: Sink | None = None,
) -> Classification:
    """The same for a velocity equation, such as one of the user's own; see `classify`."""
    border, limits = Border.around(equation), limits or Limits()
    with to(progress), running(workers, executor, limits.clock, cache) as runner:
        found = classify_inside(mechanism, border, runner, limits)
    return _whole(border.classification(found))


def _whole(found: Classification) -> Classification:
    if found.interrupted:
        raise Interrupted(found)
    return found


def classify_inside(
    mechanism: Mechanism | None, border: Border, runner: Runner, limits: Limits
) -> Classification:
    """The same in the unit inside, its configurations with more digits than are reported."""
    started, ends = time.monotonic(), Ends.of(limits)
    found = conditions(border.inside, reduce(border.inside))
    tell_conditions(found, border)
    return _Work(mechanism, found, runner, limits, ends).classification(started)


@dataclass(frozen=True)
class Ends:
    """Budgets that end when the search, what is real of the strata, all tasks, and everything has to end."""

    search: Budget
    pieces: Budget
    tasks: Budget
    all: Budget

    @classmethod
    def of(cls, limits: Limits) -> Ends:
        """Those of the limits from now."""

        def part(whole: float | None, share: float) -> float | None:
            return None if whole is None else share * whole

        return cls(*(Budget(part(limits.clock, s), work=part(limits.total, s)) for s in SHARES))


@dataclass
class _Work:
    """One classification under way."""

    mechanism: Mechanism | None
    conditions: Conditions
    runner: Runner
    limits: Limits
    ends: Ends

    @property
    def equation(self) -> VelocityEquation:
        return self.conditions.equation

    @cached_property
    def feasible(self) -> RealSystem:
        return feasible_set(self.equation.space)

    @cached_property
    def told(self) -> Told:
        """The classes of which points were reported."""
        return Told()

    @cached_property
    def names(self) -> Names:
        return Names(self.equation.space.points, self.equation.values)

    @cached_property
    def circles(self) -> tuple[Pair, ...]:
        """The cosines and sines among the variables."""
        return tuple(unit_circles(self.equation.space.equations))

    def classification(self, started: float) -> Classification:
        problem = rank_problem(self.conditions)
        root = Branch(
            problem,
            self.feasible,
            self.equation.space.equations,
            symmetries=reflections(self.feasible, self.equation.space.equations, problem.matrices.values()),
            seconds=self.limits.seconds,
            memory_mb=self.limits.memory_mb,
        )
        explored = search(root, self.runner, singular_loci(self.conditions), self.ends.search)
        pieces = self._with_components(explored.found, self._pieces(explored.found))
        loci = self._loci(explored, pieces)
        classes = classes_of(explored, pieces, self.equation.n, self._counting)
        asked = partial(smoothness, self.mechanism, self.conditions, classes)
        smooth = self._in_time(asked, ("undecided", "whether it is smooth was not found in time"))
        return Classification(
            self.mechanism,
            self.equation,
            self.conditions.reduction,
            configuration_space(self.mechanism, self.conditions, pieces, classes, smooth),
            loci,
            classes,
            tuple(name for name in engines.allowed() if engines.has(name)),
            time.monotonic() - started,
            chance.seed(),
            remarks_of(self.conditions),
            self.runner.interrupted,
        )

    def _pieces(self, found: Sequence[Found]) -> list[Realised]:
        """The real pieces of all strata; only what may change the answer for its class gets much time.

        After a first look at all, those in doubt get a second one; a last one only those whose class is not
        known to occur, or is known as a curve or points, which are to be counted.
        """
        limits = self.limits
        tasks = [self._task(f, f.stratum.defects.delta) for f in found]
        first, bounding = limits.part(patience.FIRST_LOOK.work), patience.FIRST_BOUND.work
        quick = [replace(task, seconds=first, bounding=bounding) for task in tasks]
        realised = realise_all(self.runner, quick, "real points", self.ends.pieces, self.told.take)
        self._look_again(tasks, realised, limits.part(patience.SECOND_LOOK.work), "real points, second look")
        self._look_again(tasks, realised, limits.seconds, "real points, at length", most=1)
        return realised

    def _task(self, found: Found, delta: int | None) -> RealTask:
        """A stratum to be realised; delta: that of its configurations, where it is known.

        Lemma: a configuration that moves along a set of dimension d has as many independent motions, which
        are n + delta at most, as every motion of the links moves a joint; parameters and mountings may vary.
        """
        limits = self.limits
        task = RealTask(
            found, self.feasible, self.names, limits.seconds, limits.memory_mb, circles=self.circles
        )
        if self.mechanism is None or delta is None:
            return task
        most = self.equation.n + delta + self.equation.space.varying
        coordinates = local_coordinates(self.mechanism, self.equation, found.stratum.defects.types)
        return replace(task, most=most, coordinates=coordinates)

    def _look_again(
        self,
        tasks: Sequence[RealTask],
        realised: list[Realised],
        seconds: float | None,
        stage: str,
        most: float = inf,
    ) -> None:
        """Realise strata in doubt once more, those of classes of unknown or small dimension first.

        Where only a dimension larger than that known of the class would matter, a bound is looked for, and a
        point where none is known.
        most: the largest known dimension of the classes of strata that are looked at.
        """
        known = known_dimensions(piece for part in realised for piece in part.pieces)
        dimensions = [min(known.get(p.defects.types, 0) for p in part.pieces) for part in realised]
        doubtful = [
            i
            for i, part in enumerate(realised)
            if dimensions[i] <= most and any(is_open(p, known.get(p.defects.types)) for p in part.pieces)
        ]
        doubtful.sort(key=lambda i: dimensions[i])
        seen = [any(p.verdict.is_yes for p in part.pieces) for part in realised]
        again = [
            replace(
                tasks[i],
                seconds=seconds if dimensions[i] <= 1 else self.limits.part(patience.LARGER_PART.work),
                known=dimensions[i] if dimensions[i] > 1 else None,
                seen=seen[i],
            )
            for i in doubtful
        ]
        looks = realise_all(self.runner, again, stage, self.ends.pieces, self.told.take)
        for i, part in zip(doubtful, looks, strict=True):
            realised[i] = merged(realised[i], part)

    # -- loci ----------------------------------------------------------------------------------------

    def _loci(self, explored: Exploration, pieces: Sequence[Piece]) -> tuple[Locus, ...]:
        """The real zeros of each factor of (4) and (5) on the configuration space, whatever their class.

        They are bounded by all strata together on which L_I, or L_O, is singular, where these are all found.
        """
        factors = [(label, factor) for label in ("4", "5") for factor in self.conditions[label].factors]
        singular = {label: self._singular(label, explored, pieces) for label, _ in factors}
        limits = [singular[label] for label, _ in factors]
        known = [self._in_time(partial(largest_inside, factor, pieces), None) for _, factor in factors]
        bounded = [
            self.equation.n > 1 and piece is not None and 0 < piece.extent.at_least == limit.dimension
            for piece, limit in zip(known, limits, strict=True)
        ]
        left = [i for i, done in enumerate(bounded) if not done]
        tasks = [
            replace(
                self._task(self._whole(factors[i][1]), None),
                most=limits[i].at_most,
                seconds=self.limits.seconds if known[i] is None else self.limits.part(patience.LOCUS.work),
            )
            for i in left
        ]
        whole = dict(zip(left, realise_all(self.runner, tasks, "loci", self.ends.tasks), strict=True))
        found = []
        for i, piece in enumerate(known):
            if piece is None or not bounded[i]:
                found.append(at_least(bounded_by(whole[i].pieces[0], limits[i]), piece))
            else:
                found.append(replace(piece, extent=limits[i], points=None, components=None))
        curves = [i for i, piece in enumerate(found) if piece.dimension == 1 and self._counting]
        equations = self.equation.space.equations
        counted = self._count([CurveTask(((*equations, factors[i][1].polynomial),), ((),)) for i in curves])
        numbers = dict(zip(curves, counted, strict=True))
        return tuple(
            locus_of(label, factor, found[i], numbers.get(i), self._counting)
            for i, (label, factor) in enumerate(factors)
        )

    def _singular(self, label: str, explored: Exploration, pieces: Sequence[Piece]) -> Extent:
        """How large the zeros of (4), or of (5), are together: where k_I, or k_O, is positive."""
        own = (p for p in pieces if (p.defects.k_I if label == "4" else p.defects.k_O))
        singular = union((p.extent for p in own), explored.doubts_of_any)
        return replace(singular, bounded=weakest(singular.bounded, explored.certainty))

    def _in_time(self, question: Callable[[], T], otherwise: T) -> T:
        """The answer to what is asked in this process, or the other where everything has to end."""
        try:
            with self.ends.all:
                return question()
        except Undecided:
            return otherwise

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
        return self.runner.map(count, limited, "curves", self.ends.tasks)

    # -- classes -------------------------------------------------------------------------------------

    def _with_components(self, found: Sequence[Found], realised: Sequence[Realised]) -> list[Piece]:
        """All pieces; those of classes that are curves with their numbers of components."""
        known = known_dimensions(piece for part in realised for piece in part.pieces)
        own = [
            i
            for i, part in enumerate(realised)
            if self._counting
            and part.pieces
            and (types := part.pieces[0].defects.types)
            and known.get(types) == 1
        ]
        curves = [i for i in own if realised[i].pieces[0].dimension == 1]
        tasks = [self._curve(found[i], realised[i]) for i in curves]
        counted = dict(zip(curves, self._count(tasks), strict=True))
        parts = [with_numbers(part, counted.get(i)) for i, part in enumerate(realised)]
        points = [i for i in own if realised[i].pieces[0].dimension == 0]
        beside = [self._beside(found[i], [p for k in curves for p in realised[k].pieces]) for i in points]
        counted_points = realise_all(self.runner, beside, "points beside curves", self.ends.tasks)
        for i, part in zip(points, counted_points, strict=True):
            numbers = [p.points for p in part.pieces if p.verdict.is_yes]
            number = (
                None
                if any(p.verdict.is_undecided for p in part.pieces)
                else sum(map(int, filter(None, numbers)))
            )
            first, *others = parts[i]
            parts[i] = [replace(first, components=number), *(replace(p, components=0) for p in others)]
        return counted_in_one_way([piece for part in parts for piece in part])

    def _beside(self, found: Found, curves: Sequence[Piece]) -> RealTask:
        """The points of a stratum that are on none of the curves of its class."""
        stratum = found.stratum
        own = tuple(p.basis for p in curves if p.defects.types == stratum.defects.types)
        return self._task(replace(found, stratum=replace(stratum, loci=(*stratum.loci, *own))), None)

    def _curve(self, found: Found, part: Realised) -> CurveTask:
        """A stratum that is a curve, and its images, off what other strata of the same types have."""
        elsewhere = [tuple(image(locus, r) for locus in found.stratum.elsewhere) for r in found.images]
        own = self.equation.space.exclusions
        exclusions = ((*own, *p.exclusions, *e) for p, e in zip(part.pieces, elsewhere, strict=True))
        return CurveTask(tuple(p.basis for p in part.pieces), tuple(exclusions))
