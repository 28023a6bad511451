"""The solution set of one of the conditions (4), (5), (i)-(viii) on the feasible configurations, and cusps.

Source: Zlatanov, Fenton, Benhabib (1998), the propositions of section 2.3: (iii), (vi), (4), (5), (vii),
(viii) are closed; (i), (ii), (iv), (v) compare ranks, and their sets are unions of classes.  Cusps are those
of `singsym.classes.tangency`.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace

from singsym.classes.classify import Limits, classify_inside
from singsym.classes.realisation.certified_configuration import Names, configuration
from singsym.classes.result import Classification, Configuration, Piece
from singsym.classes.running.runner import Interrupted, Runner, running
from singsym.classes.tangency import ROLES, tangencies
from singsym.classes.taxonomy.types import SingularityType
from singsym.classes.unit_border import Border
from singsym.conditions.conditions import Condition, Conditions, conditions
from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.progress import Sink, to
from singsym.effort.verdict import Certainty, Known, Premises, Verdict, weakest
from singsym.elimination.ideal import Ideal
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.model import Mechanism
from singsym.polynomials import Equations
from singsym.varieties.cells import Cell
from singsym.varieties.constructible import ConstructibleSet
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.real.dimension.extent import EMPTY, UNKNOWN, Extent, union
from singsym.varieties.real.dimension.real_dimension import component_dimension
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.proofs.emptiness import is_excluded
from singsym.varieties.real.system import RealSystem

_T = SingularityType
HOLDS = {
    "4": _T.RO | _T.RPM,
    "5": _T.RI | _T.RPM,
    "i": _T.RI,
    "ii": _T.RO,
    "iii": _T.RPM,
    "iv": _T.II,
    "v": _T.IO,
    "vi": _T.IIM,
    "vii": _T.RO | _T.RPM,
    "viii": _T.RI | _T.RPM,
}
"""A condition holds where a configuration has one of these types: k_I > 0 is RO or RPM, k_O > 0 RI or RPM."""

CUSPS = tuple(f"cusps {label}" for label in ROLES)
"""The labels of cusps, of (4) and of (5)."""


@dataclass(frozen=True)
class SolutionPiece:
    """A part of a solution set: the zeros of `basis` off those of the exclusions.

    path: what the condition sets to zero there; complex_dimension: of the ideal, None where not computed;
    extent: its real dimension; points: of a finite piece.
    """

    path: Equations
    basis: Equations
    exclusions: tuple[Equations, ...]
    verdict: Verdict
    complex_dimension: int | None = None
    extent: Extent = UNKNOWN
    points: int | None = None
    witnesses: tuple[Configuration, ...] = ()

    @property
    def dimension(self) -> int | None:
        """The real dimension, -1 when empty, None where it is not known."""
        return self.extent.dimension

    @property
    def is_counted(self) -> bool:
        """Whether the number of points is known, where it may be finite."""
        return self.points is not None or self.extent.at_least > 0


@dataclass(frozen=True)
class Solution:
    """The solution set of a condition, piece by piece, with what is undecided.

    certainty: how it is known that there is no more.
    """

    condition: Condition
    equation: VelocityEquation
    pieces: tuple[SolutionPiece, ...]
    doubts: tuple[str, ...] = ()
    certainty: Certainty = "proven"

    @property
    def verdict(self) -> Verdict:
        """Whether there is a feasible configuration that satisfies the condition."""
        for piece in self.pieces:
            if piece.verdict.is_yes:
                return piece.verdict
        if self.undecided:
            return Verdict.undecided("; ".join(self.doubts))
        return Verdict.no(self.certainty, reason="no feasible configuration satisfies the condition")

    @property
    def undecided(self) -> bool:
        """Whether pieces may be missing, are not known to have real points, or a number is open."""
        extent = self.extent
        finite = extent.dimension == 0
        return extent.dimension is None or (finite and not all(p.is_counted for p in self.pieces))

    @property
    def extent(self) -> Extent:
        """Its real dimension, as far as it is known."""
        return union((p.extent for p in self.pieces), self.doubts)

    @property
    def dimension(self) -> int | None:
        """The real dimension, -1 where there is no piece, None where it is not known."""
        return self.extent.dimension

    @property
    def set(self) -> ConstructibleSet:
        """The solution set as a set, with `&`, `|` and `-`.

        Where it is undecided the set of what was found.
        """
        space = self.equation.space
        cells = tuple(
            Cell(
                Ideal(space.ring, p.basis),
                (*space.exclusions, *p.exclusions),
                space.positive,
                space.nonnegative,
            )
            for p in self.pieces
        )
        return ConstructibleSet(space.ring, cells)


@dataclass(frozen=True)
class LocusTask:
    """A closed part of a solution set to be decomposed: the zeros of `path` on the configuration space."""

    path: Equations
    equations: Equations
    feasible: RealSystem
    names: Names
    seconds: float | None = None
    memory_mb: int | None = None

    def unfinished(self, reason: str) -> Solved:
        """No piece, for this reason."""
        return Solved((), reason)


@dataclass(frozen=True)
class Solved:
    """The pieces of a closed part, why there may be more, and how it is known that there are no others."""

    pieces: tuple[SolutionPiece, ...] = ()
    doubt: str = ""
    certainty: Certainty = "proven"

    @property
    def provisional(self) -> bool:
        """Whether a larger budget could say more."""
        open_pieces = any(piece.verdict.is_undecided for piece in self.pieces)
        return bool(self.doubt) or open_pieces or self.certainty != "proven"


def solve(
    mechanism: Mechanism,
    *labels: str,
    formulation: str = "auto",
    workers: int = 1,
    executor: Executor | None = None,
    limits: Limits | None = None,
    cache: bool = True,
    progress: Sink | None = None,
) -> tuple[Solution, ...]:
    """The solution sets of conditions "4", "5", "i" ... "viii", one each; options as for `classify`.

    "cusps 4", "cusps 5": the configurations where the one null motion is tangent to (4), or (5), off those
    where (4), or (5), crosses itself or is not smooth.  An angle whose turns are all as good is held at 0, as
    the equations of the pieces say.  A piece as large as (4), or (5), is made of self-motions: the inputs, or
    the outputs, rest.  Raises `KeyError` for another label.

    >>> from singsym.mechanism import load
    >>> dead, = solve(load("slider-crank"), "5", cache=False)
    >>> dead.dimension, sum(p.points for p in dead.pieces)
    (0, 2)
    """
    with to(progress):
        return _solved(
            Border.of(mechanism, formulation),
            labels,
            workers=workers,
            executor=executor,
            limits=limits,
            cache=cache,
            mechanism=mechanism,
        )


def solve_equation(
    equation: VelocityEquation,
    *labels: str,
    workers: int = 1,
    executor: Executor | None = None,
    limits: Limits | None = None,
    cache: bool = True,
    progress: Sink | None = None,
    mechanism: Mechanism | None = None,
) -> tuple[Solution, ...]:
    """The same for a velocity equation, such as one of the user's own."""
    with to(progress):
        return _solved(
            Border.around(equation),
            labels,
            workers=workers,
            executor=executor,
            limits=limits,
            cache=cache,
            mechanism=mechanism,
        )


def _solved(
    border: Border,
    labels: Sequence[str],
    *,
    workers: int,
    executor: Executor | None,
    limits: Limits | None,
    cache: bool,
    mechanism: Mechanism | None,
) -> tuple[Solution, ...]:
    """The solution sets, found inside and turned to the user's unit."""
    found = conditions(border.inside)
    outside = found if border.unit == 1 else conditions(border.outside)
    asked = [found[label.removeprefix("cusps ") if label in CUSPS else label] for label in labels]
    limits = limits or Limits()
    budget = Budget(limits.clock, work=limits.total)
    with running(workers, executor, limits.clock, cache) as runner:
        whole: Classification | None = None
        results = []
        for label, condition in zip(labels, asked, strict=True):
            if label in CUSPS:
                solution = _cusps(condition, found, runner, limits, budget)
            elif condition.alternatives is None or condition.everywhere:
                left = replace(limits, clock=None if limits.clock is None else budget.time_left())
                whole = whole or classify_inside(mechanism, border, runner, left)
                solution = _from_classes(condition, whole)
            else:
                solution = _closed(condition, found, runner, limits, budget)
            shown = tuple(map(border.part, solution.pieces))
            seen = solution.condition if label in CUSPS else outside[label]
            results.append(replace(solution, condition=seen, equation=border.outside, pieces=shown))
        if runner.interrupted:
            raise Interrupted(tuple(results))
        return tuple(results)


def _closed(
    condition: Condition, found: Conditions, runner: Runner, limits: Limits, budget: Budget
) -> Solution:
    """The solution set of a condition that says which polynomials vanish."""
    return _solution(condition, found, [(path, ()) for path in condition.polynomials], runner, limits, budget)


def _cusps(
    condition: Condition, found: Conditions, runner: Runner, limits: Limits, budget: Budget
) -> Solution:
    """Where the null motion is tangent to condition (4) or (5)."""
    tangent = replace(
        condition,
        label=f"cusps {condition.label}",
        statement=f"{condition.statement}, its one null motion tangent",
        latex_statement=rf"{condition.latex_statement}\text{{, its one null motion tangent}}",
        types=f"{condition.types}{_not_plain(found.equation.n)}",
        alternatives=None,
    )
    try:
        with current().part(limits.seconds, limits.memory_mb):
            places = tangencies(found.equation, condition.label)
    except Undecided as reason:
        return Solution(tangent, found.equation, (), (str(reason),))
    parts = [(path, place.exclusions) for place in places for path in place.alternatives]
    solution = _solution(tangent, found, parts, runner, limits, budget)
    held = max((len(place.held) for place in places), default=0)
    whole = found.equation.n - 1 + found.equation.space.varying - held
    if any(p.extent.at_least >= whole for p in solution.pieces):
        resting = f"{tangent.types}; of dimension {whole}: self-motions, the {ROLES[condition.label]}s rest"
        solution = replace(solution, condition=replace(tangent, types=resting))
    return solution


def _not_plain(n: int) -> str:
    """What a tangent null motion is where it is not a cusp of a curve, as it is with n = 2."""
    if n == 1:
        return "; with n = 1 there are no cusps: these are dead points of a higher order"
    if n > 2:
        return f"; with n = {n} cuspidal edges, and in these worse points as swallowtails, not told apart"
    return ""


def _solution(
    condition: Condition,
    found: Conditions,
    parts: Sequence[tuple[Equations, tuple[Equations, ...]]],
    runner: Runner,
    limits: Limits,
    budget: Budget,
) -> Solution:
    """The union of closed parts, each off its exclusions.

    They are few: where the time on the clock is limited, each may use all of it.
    """
    seconds = limits.seconds if limits.clock is None else limits.clock
    space = found.equation.space
    names = Names(space.points, found.equation.values)
    tasks = []
    for path, exclusions in parts:
        off = (*space.exclusions, *exclusions)
        feasible = RealSystem(space.ring, (), off, space.positive, space.nonnegative)
        tasks.append(LocusTask(path, space.equations, feasible, names, seconds, limits.memory_mb))
    solved = runner.map(solve_locus, tasks, f"condition ({condition.label})", budget)
    pieces = [
        replace(p, exclusions=exclusions)
        for part, (_, exclusions) in zip(solved, parts, strict=True)
        for p in part.pieces
        if not p.verdict.is_no
    ]
    doubts = [part.doubt for part in solved if part.doubt]
    doubts += [p.verdict.reason for p in pieces if p.verdict.is_undecided]
    known = weakest(*(part.certainty for part in solved))
    return Solution(condition, found.equation, tuple(pieces), tuple(dict.fromkeys(doubts)), known)


def solve_locus(task: LocusTask) -> Solved:
    """Decompose a closed part and find real points on each component: the task that workers run."""
    feasible = task.feasible
    try:
        with current().part(task.seconds, task.memory_mb):
            premises, equations = Premises(), (*task.path, *task.equations)
            components = premises.take(decompose(equations, feasible.nonzero, ring=feasible.ring))
            kept = [c for c in components if not premises.take(is_excluded(c, feasible))]
            pieces = tuple(premises.take(_real(task, component)) for component in kept)
        return Solved(pieces, certainty=premises.certainty)
    except Undecided as reason:
        return Solved((), str(reason))


def _real(task: LocusTask, component: Component) -> Known[SolutionPiece]:
    """What is real of a component; the certainty is that of there being no more."""
    system = replace(task.feasible, equations=component.generators)
    piece = SolutionPiece(
        task.path, component.generators, (), Verdict.undecided("not examined"), component.dimension
    )
    try:
        if component.dimension == 0:
            known = real_points(component.generators)
            points = [p for p in known.value if system.admits(p)]
            if not points:
                return _none(piece, known.certainty)
            shown = tuple(configuration(p, task.names) for p in points)
            found = replace(piece, verdict=Verdict.yes(), points=len(points), witnesses=shown)
            return Known(replace(found, extent=Extent(0, 0)), known.certainty)
        measured = component_dimension(component, system)
    except Undecided as reason:
        unknown = replace(UNKNOWN, open=str(reason))
        return Known(replace(piece, verdict=Verdict.undecided(str(reason)), extent=unknown))
    dimension, witness = measured.value
    if witness is None:
        return _none(piece, measured.certainty)
    verdict = Verdict.yes("proven" if isinstance(witness.point, RealPoint) else "certified")
    shown = (configuration(witness.point, task.names),)
    extent = Extent(dimension, dimension)
    return Known(replace(piece, verdict=verdict, extent=extent, witnesses=shown), measured.certainty)


def _none(piece: SolutionPiece, certainty: Certainty) -> Known[SolutionPiece]:
    verdict = Verdict.no(certainty, reason="no real and feasible point")
    return Known(replace(piece, verdict=verdict, extent=EMPTY), certainty)


def _from_classes(condition: Condition, whole: Classification) -> Solution:
    """The union of the classes whose configurations satisfy the condition."""
    wanted = [c for c in whole.classes if c.types & HOLDS[condition.label]]
    doubts = [c.verdict.reason for c in wanted if c.verdict.is_undecided]
    doubts += [c.extent.open for c in wanted if c.verdict.is_yes and c.dimension is None]
    doubts += [c.open or "not counted" for c in wanted if c.dimension == 0 and c.points is None]
    doubts += [p.verdict.reason for c in wanted for p in c.unsure]
    known = weakest(*(c.verdict.certainty for c in wanted if c.verdict.is_no))
    parts = (p for c in wanted for p in (*c.pieces, *c.unsure))
    pieces = sorted(parts, key=lambda p: (-p.extent.at_least, str(p.path)))
    shown = tuple(map(_as_solution, pieces))
    return Solution(condition, whole.equation, shown, tuple(dict.fromkeys(doubts)), known)


def _as_solution(piece: Piece) -> SolutionPiece:
    return SolutionPiece(
        piece.path,
        piece.basis,
        piece.exclusions,
        piece.verdict,
        None,
        piece.extent,
        piece.points,
        piece.witnesses,
    )
