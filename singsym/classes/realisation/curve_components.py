"""The connected components of the curves among loci and classes, closed up: a task that workers run.

Source: `varieties.real.curve` counts those of a curve; what belongs to other classes is taken out here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations

from singsym.classes.result import Piece
from singsym.classes.taxonomy.types import SingularityType
from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided, current
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Equations
from singsym.varieties.real.curves.equations import NotACurve
from singsym.varieties.real.curves.parts import components_outside
from singsym.varieties.real.curves.real_curve import real_curve
from singsym.varieties.real.modules.curve_components import components_off, parts_of_curve
from singsym.varieties.real.points.exact_point import RealPoint

_CROSSING = "parts of one set may meet, and were counted apart"


@dataclass(frozen=True)
class CurveTask:
    """A curve off some exclusions, and its images under reflections, whose components are to be counted.

    images: the equations of each, the curve first; exclusions: those of each.
    """

    images: tuple[Equations, ...]
    exclusions: tuple[tuple[Equations, ...], ...]
    seconds: float | None = None
    memory_mb: int | None = None

    def unfinished(self, reason: str) -> Counted:
        """No number, for this reason."""
        return Counted(None, reason, True)


@dataclass(frozen=True)
class Counted:
    """The numbers of connected components of a curve and its images, or None with the reason.

    open: whether a larger budget could say more.  Bases modulo primes will do for a number.
    """

    components: tuple[int, ...] | None
    reason: str = ""
    open: bool = False

    @property
    def provisional(self) -> bool:
        """Whether a larger budget could say more."""
        return self.open


def count(task: CurveTask) -> Counted:
    """The connected components of a real curve and of its images, each image by itself, each component once.

    Curves of one image that meet are one component, those of two images that meet are two.
    What of it lies in the exclusions as a whole is left out; on the rest these are finitely many points, that
    are left in, but not where they are components by themselves.
    They are not counted where the complex zeros are no curve, as of x^2 + y^2 = 0 in space.
    """
    budget = current().part(task.seconds, task.memory_mb)
    try:
        with budget:
            numbers = [_components(task.images[0], task.exclusions[0])]
            apart = not any(_share_a_curve(one, other) for one, other in combinations(task.images, 2))
            for k in range(1, len(task.images)):
                earlier = () if apart else task.images[:k]
                numbers.append(
                    numbers[0] if apart else _components(task.images[k], (*task.exclusions[k], *earlier))
                )
            return Counted(tuple(numbers))
    except (NotACurve, Undecided) as reason:
        return Counted(None, str(reason), budget.remaining() == 0.0)


def counted_in_one_way(pieces: Sequence[Piece]) -> list[Piece]:
    """Pieces, of which those that are parts of one set keep their numbers where no two may meet.

    A curve that crosses itself is one component, two that cross are two: in how many a set given by the same
    polynomials was taken apart depends on what was found in time, and no number may.
    """
    sets: dict[tuple[SingularityType, Equations], list[int]] = {}
    for i, piece in enumerate(pieces):
        if piece.dimension == 1 and piece.components:
            sets.setdefault((piece.defects.types, piece.path), []).append(i)
    found = list(pieces)
    for i, j in chain.from_iterable(combinations(own, 2) for own in sets.values()):
        if not _are_apart(pieces[i].basis, pieces[j].basis):
            for k in (i, j):
                found[k] = replace(found[k], components=None, uncounted=_CROSSING, countable=True)
    return found


def _are_apart(one: Equations, other: Equations) -> bool:
    """Whether two sets are shown to have no point in common, over C."""
    with attempt("that two curves do not meet", patience.MEETING.work):
        return Ideal(one[0].ring, (*one, *other)).is_unit().value
    return False


def _share_a_curve(one: Equations, other: Equations) -> bool:
    return Ideal(one[0].ring, (*one, *other)).dimension.value > 0


def _components(equations: Equations, exclusions: tuple[Equations, ...]) -> int:
    """Those of one curve; raises `Undecided`."""
    with attempt("components by modules", share=1 / 2) as budget:
        return components_off(equations, exclusions, budget)
    if (parts := parts_of_curve(equations)) is not None:
        return sum(_components(part, exclusions) for part in parts)
    ideal = Ideal(equations[0].ring, equations)
    curve = real_curve(ideal)
    if curve.verdict.is_undecided:
        raise Undecided(curve.verdict.reason)
    alone = sum(not _lies_in(p, exclusions) for p in curve.isolated_points)
    whole = [group for group in exclusions if (ideal + Ideal(ideal.ring, group)).dimension.value > 0]
    if not whole:
        return len(curve.components) + alone
    rest = ideal
    for group in whole:
        rest = rest.saturate(Ideal(ideal.ring, group)).value
    return components_outside(curve, whole, rest.generators) + alone


def _lies_in(point: RealPoint, loci: tuple[Equations, ...]) -> bool:
    return any(all(point.sign(p) == 0 for p in locus) for locus in loci)
