"""A trajectory followed on its assembly mode: singularities that are met, or narrowly passed, and margins.

Source: singularities by conditions (4) and (5) of Zlatanov, Fenton, Benhabib (1998), of which one holds at
each; margins by the smallest singular values, Eckart, Young (1936).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from singsym.classes.configuration.at import Analysis, at_equation
from singsym.classes.configuration.null_motions import Motion, null_motions, numerical_kernels
from singsym.classes.taxonomy.types import Defects, SingularityClass, SingularityType, class_of
from singsym.effort import progress
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.scaling import scaled_matrix
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism.model import Mechanism
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.continuation import Continuation, MotionPiece
from singsym.motion.drives import driven_system
from singsym.motion.enclosures import certified_defects, sure_sign
from singsym.motion.loci import SingularLocus, determinant_loci
from singsym.motion.trajectory import Trajectory
from singsym.polynomials.compiled_map import CompiledMap, Floats
from singsym.polynomials.gauss_newton import gauss_newton

EXACT = 1e-9
"""Times of singularities are found within so much of the whole time."""
NARROW = 0.05
"""Smallest singular values, of L_I and L_O in pure numbers, below which a passage is narrow."""
_SAMPLES = 400
_FOLD = 0.05
"""Of the variables' sizes: a singularity is looked for no farther from where a motion ends."""
Span = tuple[float, float, bool]
"""Start, end, and whether something surely vanishes there."""
_ROUNDING = 1e-6
"""Singular values below this count as zero, where ranks are numerical."""


@dataclass(frozen=True)
class Passage:
    """A singularity on the way, or a place that is near one.

    kind: "met": proven to be singular at a time from `start` to `end`; "narrow": regular, a margin is
    least; "open": whether it is singular is not decided; "end": the motion is not proven to go on.
    types: certified where `types_certified`, else by numerical ranks; none for a narrow passage.
    words: what vanishes or is small; margin: the smallest singular value of the matrix that loses rank.
    values: of the variables, in floats; motions: the null motions there.
    """

    kind: str
    start: float
    end: float
    condition: str
    types: SingularityType
    types_certified: bool
    words: str
    margin: float
    values: Mapping[str, float]
    motions: tuple[Motion, ...]

    @property
    def singularity_class(self) -> SingularityClass | None:
        """The class of the types; None where there are none."""
        return class_of(self.types)


@dataclass(frozen=True)
class FollowedMotion:
    """What is known of a trajectory on an assembly mode.

    labels: what is driven; until: up to this time the motion is proven to go on, by `pieces` boxes.
    passages: in the order of time; off them L_I and L_O are proven to be regular up to `until`, unless
    conditions in `unwritten` say otherwise.
    times, configurations, margins: samples (B,), (B, variables) and by matrix L_I, L_O (B,), numerical.
    """

    equation: VelocityEquation
    labels: tuple[str, ...]
    start: float
    end: float
    until: float
    pieces: int
    passages: tuple[Passage, ...]
    times: Floats
    configurations: Floats
    margins: Mapping[str, Floats]
    unwritten: tuple[str, ...]

    @property
    def is_decided(self) -> bool:
        """Whether the whole motion is proven, and whether each place of it is singular is known."""
        return self.until == self.end and not self.unwritten and all(p.kind != "open" for p in self.passages)


def follow(
    mechanism: Mechanism,
    trajectory: Trajectory,
    *,
    start: Analysis | None = None,
    formulation: str = "auto",
    narrow: float = NARROW,
) -> FollowedMotion:
    """Follow a trajectory of as many joints or coordinates as the mobility.

    Limits and exclusions are not looked at on the way; what is proven holds where they allow the motion.
    start: a configuration near which the motion begins, as `at` gives it; needed where several have the first
    values.  narrow: margins below it are reported.
    Raises `MechanismError` for labels that are not there or too few, for angles that change by more than half
    a turn from row to row, and where no configuration or more than one has the first values.

    >>> from singsym.mechanism import load
    >>> turn = Trajectory.of({"J5": [0.5, -0.5], **{f"J{k}": [0.3, 0.3] for k in (1, 2, 3, 4, 6)}})
    >>> wrist = follow(load("puma560"), turn)
    >>> [(p.kind, round(p.start, 6), str(p.types), p.types_certified) for p in wrist.passages]
    [('met', 0.5, 'RI, IO', True)]
    """
    equation = velocity_equation(mechanism, formulation) if start is None else start.equation
    return follow_equation(equation, trajectory, start=start, narrow=narrow)


def follow_equation(
    equation: VelocityEquation,
    trajectory: Trajectory,
    *,
    start: Analysis | None = None,
    narrow: float = NARROW,
) -> FollowedMotion:
    """The same for a velocity equation."""
    system = driven_system(equation, trajectory.labels)
    if len(trajectory.labels) != equation.n:
        found = f"{len(trajectory.labels)} columns: {', '.join(trajectory.labels)}"
        raise MechanismError([Problem("trajectory", found, f"{equation.n} beside the time, as the mobility")])
    for drive in system.drives:
        change = float(np.abs(np.diff(trajectory.values[drive.label])).max())
        if drive.is_angle and change > np.pi:
            found = f"{drive.label} changes by {np.degrees(change):.4g} degrees from one row to the next"
            expected = (
                "half a turn at most, so that it is clear which way: more rows, or Trajectory.unwrapped"
            )
            raise MechanismError([Problem("trajectory", found, expected)])
    point = _first(equation, trajectory, start)
    return _Following(equation, Continuation(equation, system, trajectory), narrow).result(point)


def _first(equation: VelocityEquation, trajectory: Trajectory, start: Analysis | None) -> Floats:
    """The configuration at the first row, numerically."""
    joints, points = dict[str, float](), dict[str, float]()
    for label, values in trajectory.values.items():
        (joints if label in equation.values else points)[label] = float(values[0])
    given: dict[str, dict[str, object]] = {"joints": dict(joints), "points": {}}
    if start is None and not points:
        start = at_equation(equation, given)
        if start.located is not None and start.located.others:
            found = f"{start.located.others + 1} configurations with the values of its first row"
            expected = "one: tell them apart by a configuration to start from (--config)"
            raise MechanismError([Problem("trajectory", found, expected)])
    if start is None:
        expected = "a configuration to start from (--config)"
        raise MechanismError([Problem("trajectory", f"coordinates {', '.join(points)}", expected)])
    return np.array([float(start.values[name]) for name in equation.space.ring.names])


class _Following:
    """The parts of the answer."""

    def __init__(self, equation: VelocityEquation, way: Continuation, narrow: float) -> None:
        self.equation, self.way, self.narrow = equation, way, narrow
        self.loci, self.unwritten = determinant_loci(equation)
        times = way.trajectory.times
        self.start, self.end = float(times[0]), float(times[-1])
        self.exact = EXACT * (self.end - self.start)

    def result(self, point: Floats) -> FollowedMotion:
        """The motion from a configuration at its start."""
        first = self.way.near(self.start, point)
        if not np.isfinite(first).all():
            given = "values in its first row that no configuration near the start has"
            raise MechanismError([Problem("trajectory", given, "values that one has")])
        pieces: list[MotionPiece] = []
        spans: list[list[Span]] = [[] for _ in self.loci]
        for piece in self.way.pieces(first):
            progress.report("follow", f"until {piece.end:.4g} of {self.end:.4g}")
            pieces.append(piece)
            for own, locus in zip(spans, self.loci, strict=True):
                own += self.way.zeros(piece, locus.polynomials[0], self.exact)
        until = pieces[-1].end if pieces else self.start
        times, points = self._samples(pieces, first, until)
        margins = self._margins(points)
        passages: list[Passage] = []
        for own, locus in zip(spans, self.loci, strict=True):
            passages += self._met(own, locus, pieces, times, points)
        if until < self.end:
            passages.append(self._ended(until, points[-1]))
        passages += self._narrow(times, points, margins, passages)
        passages.sort(key=lambda p: p.start)
        return FollowedMotion(
            self.equation,
            self.way.trajectory.labels,
            self.start,
            self.end,
            until,
            len(pieces),
            tuple(passages),
            times,
            points,
            margins,
            self.unwritten,
        )

    def _met(
        self,
        spans: Sequence[Span],
        locus: SingularLocus,
        pieces: Sequence[MotionPiece],
        times: Floats,
        points: Floats,
    ) -> Iterator[Passage]:
        """The passages of one locus; where spans that are not sure border on each other they are one.

        A polynomial with other signs at both ends vanishes in between.
        """
        (polynomial,) = locus.polynomials
        for start, end, sure in _joined(spans):
            sample = points[int(np.searchsorted(times, start, side="right")) - 1]
            near = self.way.near((start + end) / 2, sample)
            near = near if np.isfinite(near).all() else sample
            if not sure and self.start < start and end < self.end:
                beside = self.exact * np.array([-1.0, 1.0]) + (start, end)
                boxes = [self.way.on_motion(pieces, t, t, self.way.near(t, near)) for t in beside.tolist()]
                signs = [0 if box is None else sure_sign(polynomial, box) for box in boxes]
                sure = signs[0] * signs[1] < 0
            box = self.way.on_motion(pieces, start, end, near) if sure else None
            defects = None if box is None else certified_defects(self.equation, box.box, locus.bounds)
            kind = "met" if sure else "open"
            yield self._passage(kind, start, end, locus.label, locus.words, near, defects)

    def _ended(self, until: float, point: Floats) -> Passage:
        """Where the motion is not proven to go on: the nearest singularity, numerically, if one is near."""
        ring, best = self.equation.space.ring, (_FOLD, point, "", "nothing singular is seen near by")
        for locus in self.loci:
            equations = (*self.equation.space.equations, *ring.relations, *locus.polynomials)
            system = CompiledMap.balanced(equations, ring)
            landed = gauss_newton(system, point)
            if landed is not None:
                away = float(np.abs((landed - point) / system.sizes).max())
                best = min(best, (away, landed, locus.label, locus.words), key=lambda found: found[0])
        _, there, label, words = best
        return self._passage("end", until, until, label, words, there)

    def _passage(
        self,
        kind: str,
        start: float,
        end: float,
        condition: str,
        words: str,
        point: Floats,
        defects: Defects | None = None,
    ) -> Passage:
        scaled = scaled_matrix(self.equation, point)
        seen = {name: numerical_rank(m, _ROUNDING, size=1.0) for name, m in scaled.submatrices().items()}
        N, n = self.equation.N, self.equation.n
        known = defects
        if known is None:
            ranks = {name: found.rank for name, found in seen.items()}
            known = Defects.of_ranks(ranks["L"], ranks["L_I"], ranks["L_O"], ranks["L_p"], N, n)
        feasible = known.is_feasible(n) and kind != "narrow"
        types = known.types if feasible else SingularityType(0)
        motions: tuple[Motion, ...] = ()
        if feasible and types:
            kernels = numerical_kernels(scaled, seen, known.ranks(N, n))
            motions = null_motions(self.equation, kernels, scaled.units, types)
        return Passage(
            kind,
            start,
            end,
            condition,
            types,
            defects is not None,
            words,
            min(
                _smallest(found.singular_values, N) for name, found in seen.items() if name in ("L_I", "L_O")
            ),
            dict(zip(self.equation.space.ring.names, point.tolist(), strict=True)),
            motions,
        )

    # -- numerical -----------------------------------------------------------------------------------

    def _samples(self, pieces: Sequence[MotionPiece], first: Floats, until: float) -> tuple[Floats, Floats]:
        """Times up to the end of what is proven, and configurations there."""
        grid = np.linspace(self.start, self.end, _SAMPLES)
        rows = self.way.trajectory.times
        times = np.unique([*grid[grid <= until], *rows[rows <= until], until])
        ends = np.array([piece.end for piece in pieces])
        found, point = [], first
        for time in times.tolist():
            place = int(np.searchsorted(ends, time))
            if place < len(pieces):
                point = self.way.middle(pieces[place].first)
            point = self.way.near(time, point)
            found.append(point)
        return times, np.array(found)

    def _margins(self, points: Floats) -> dict[str, Floats]:
        parts = scaled_matrix(self.equation, points).submatrices()
        found = {}
        for name in ("L_I", "L_O"):
            values = np.linalg.svd(parts[name], compute_uv=False)
            full = values.shape[1] >= self.equation.N
            found[name] = values[:, self.equation.N - 1] if full else np.zeros(len(points))
        return found

    def _narrow(
        self, times: Floats, points: Floats, margins: Mapping[str, Floats], known: Sequence[Passage]
    ) -> Iterator[Passage]:
        """Least margins that are small, of which no singularity is met between the samples beside them."""
        for label, name in (("4", "L_I"), ("5", "L_O")):
            values = margins[name]
            for k in range(1, len(times) - 1):
                if not (values[k] < self.narrow and values[k - 1] >= values[k] < values[k + 1]):
                    continue
                if any(times[k - 1] <= p.end and p.start <= times[k + 1] for p in known):
                    continue
                words = self._smallest_factor(label, points[k])
                time = float(times[k])
                found = self._passage("narrow", time, time, label, words, points[k])
                yield found

    def _smallest_factor(self, label: str, point: Floats) -> str:
        """What the factor says that is smallest over the sum of its terms."""
        own = [locus for locus in self.loci if locus.label == label]
        if not own:
            return ""
        factors = CompiledMap([locus.polynomials[0] for locus in own], self.equation.space.ring)
        sizes = np.abs(factors.values(point)) / factors.magnitudes(point, self._tiny)
        return own[int(np.argmin(sizes))].words

    @cached_property
    def _tiny(self) -> Floats:
        return np.full(len(self.equation.space.ring.names), 1e-300)


def _smallest(values: Sequence[float], full: int) -> float:
    return values[full - 1] if len(values) >= full else 0.0


def _joined(spans: Sequence[Span]) -> list[Span]:
    """Spans in order, those that are not sure and border on each other as one."""
    found: list[Span] = []
    for start, end, sure in sorted(spans):
        if found and not sure and not found[-1][2] and start <= found[-1][1]:
            found[-1] = (found[-1][0], end, False)
        else:
            found.append((start, end, sure))
    return found
