"""From a stratum to real answers: points, dimension, a certified configuration, or a proof that it is empty.

Source: conditions (i)-(vi) of Zlatanov, Fenton, Benhabib (1998) hold on the stratum; certificates as in
Hauenstein, Sottile, ACM Trans. Math. Softw. 38 (2012) 28.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import chain

from singsym.classes.realisation.certified_configuration import Names, configuration
from singsym.classes.realisation.dimension_bounds import (
    larger_parts,
    off_borders,
)
from singsym.classes.realisation.disjoint_pieces import in_parts
from singsym.classes.realisation.finite_sets import (
    CertifiedPoints,
    admitted,
    finitely_many,
    isolated_points,
)
from singsym.classes.realisation.upper_bounds import charted, upper_bound
from singsym.classes.result import Piece
from singsym.classes.strata.branches import Found
from singsym.classes.strata.occurrence import is_proven_empty, restricted
from singsym.classes.strata.patches import Patch, unsplit
from singsym.classes.strata.reflections import image
from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Known, Premises, Verdict, weakest
from singsym.kinematics.placement import JointValue
from singsym.polynomials import Equations
from singsym.polynomials.unit_circles import Pair
from singsym.varieties.disjoint_parts import disjoint_parts
from singsym.varieties.real.dimension.extent import EMPTY, Extent
from singsym.varieties.real.dimension.hyperplane_cuts import Cut, dimension_by_cuts
from singsym.varieties.real.dimension.real_dimension import (
    Dimension,
    component_dimension,
    independent,
    real_dimension,
)
from singsym.varieties.real.numerical.sampling import numerical_codimension
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.certified_point import Witness, find_witness
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.proofs.critical_points import sample_points
from singsym.varieties.real.proofs.positive_combinations import is_positive_combination_seen
from singsym.varieties.real.proofs.vector_charts import Cartesian
from singsym.varieties.real.system import RealSystem

SEARCHES = 300
"""Random starts in the search for a point of a set given by independent equations."""


@dataclass(frozen=True)
class RealTask:
    """A stratum to be realised on a feasible set, within a budget.

    most: a bound of the real dimension, if there is one; coordinates: local ones of the space wherever the
    stratum has that dimension (see `local_coordinates`); circles: variables that are cosine and sine of an
    angle; known: a dimension, where only a larger one of the stratum would matter; seen: whether a point of
    it is known; bounding: work for a bound of the dimension once it is known from below, None without limit.
    """

    found: Found
    feasible: RealSystem
    names: Names
    seconds: float | None = None
    memory_mb: int | None = None
    most: int | None = None
    coordinates: tuple[JointValue, ...] = ()
    circles: tuple[Pair, ...] = ()
    known: int | None = None
    seen: bool = False
    bounding: float | None = None

    def unfinished(self, reason: str) -> Realised:
        """A piece for each image of the stratum, undecided for this reason."""
        return images(_piece(self, reason), (), self)


@dataclass(frozen=True)
class Realised:
    """What a stratum and its images come to: a piece each."""

    pieces: tuple[Piece, ...]

    @property
    def provisional(self) -> bool:
        """Whether a larger budget could say more."""
        return any(piece.provisional for piece in self.pieces)


def examined(task: RealTask) -> tuple[Piece, CertifiedPoints]:
    """What one stratum comes to, without its images, and the points that show it."""
    stratum = task.found.stratum
    piece = _piece(task, "not examined")
    exclusions = (*task.feasible.exclusions, *stratum.loci)
    system = replace(task.feasible, equations=stratum.equations, exclusions=exclusions)
    points: CertifiedPoints = ()
    try:
        with current().part(task.seconds, task.memory_mb):
            if task.known is None:
                return _realised(piece, system, task)
            if not task.seen:
                with attempt("a point of a stratum", share=1 / 2):
                    piece, points = _realised(piece, system, task)
            return _above(piece, points, system, task)
    except Undecided as reason:
        left = _left_open(piece, reason)
        return replace(left, verdict=piece.verdict) if points else left, points


def _above(
    piece: Piece, points: CertifiedPoints, system: RealSystem, task: RealTask
) -> tuple[Piece, CertifiedPoints]:
    """A piece with what is found of it above a known dimension, or that there is nothing."""
    known, most = max(task.known or 0, piece.extent.at_least), piece.extent.at_most
    if most is not None and most <= known:
        return piece, points
    for larger, witness in larger_parts(off_borders(system), known):
        piece, points = _known(piece, Extent(larger, most), witness)
        known = larger
    if known == most:
        return piece, points
    bound = _bound(system, known, task)
    reason = f"that there is no part of a dimension above {known} was not proven in time"
    if bound is not None:
        reason = f"only a dimension above {known} would matter"
        extent = replace(piece.extent, at_most=bound.value, bounded=bound.certainty)
        piece = replace(piece, extent=extent)
    verdict = piece.verdict if points else Verdict.undecided(reason)
    return replace(piece, verdict=verdict, extent=replace(piece.extent, open=reason)), points


def _piece(task: RealTask, reason: str) -> Piece:
    """What a stratum comes to as long as nothing more is known of it, for this reason."""
    stratum = task.found.stratum
    verdict, extent = Verdict.undecided(reason), Extent(-1, task.most, open=reason)
    return Piece(task.found.path, stratum.equations, stratum.loci, stratum.defects, verdict, extent)


def _realised(piece: Piece, system: RealSystem, task: RealTask) -> tuple[Piece, CertifiedPoints]:
    stratum = task.found.stratum
    component = stratum.component
    if component is None:
        return _given(piece, system, task)
    if component.dimension == 0:
        solutions = real_points(stratum.equations)
        return _finite(piece, solutions.map(lambda found: admitted(found, system, stratum.elsewhere)))
    return _counted(*_exactly(piece, component_dimension(component, system)), system, stratum.elsewhere)


def images(piece: Piece, points: CertifiedPoints, task: RealTask) -> Realised:
    """The piece with its points for each image of the stratum; one that an earlier image has is left out."""
    seen: list[RealPoint | BoxPoint] = []
    pieces: list[Piece] = []
    for reflection in task.found.images:
        own = []
        for point in (p.reflect(reflection) for p in points):
            if piece.points is not None:
                if any(_are_one(point, other) for other in seen):
                    continue
                seen.append(point)
            own.append(point)
        if piece.points and not own:
            continue
        shown = replace(
            piece,
            path=image(piece.path, reflection),
            basis=image(piece.basis, reflection),
            exclusions=tuple(image(group, reflection) for group in piece.exclusions),
            witnesses=tuple(configuration(p, task.names) for p in own),
        )
        pieces.append(replace(shown, points=len(own), components=len(own)) if piece.points else shown)
    return Realised(tuple(pieces))


def _given(piece: Piece, system: RealSystem, task: RealTask) -> tuple[Piece, CertifiedPoints]:
    """A set given by equations, by its disjoint parts where it is seen to have some."""
    parts = [replace(system, equations=own) for own in disjoint_parts(system.equations)]
    return in_parts([_in_time(piece, part, task) for part in parts])


def _in_time(piece: Piece, part: RealSystem, task: RealTask) -> tuple[Piece, CertifiedPoints]:
    """A part; if it is not decided, what is known of the others stays."""
    try:
        return _given_in_one(piece, part, task)
    except Undecided as reason:
        return _left_open(piece, reason), ()


def _left_open(piece: Piece, reason: Undecided) -> Piece:
    extent = replace(piece.extent, open=str(reason))
    return replace(piece, verdict=Verdict.undecided(str(reason)), extent=extent)


def _given_in_one(piece: Piece, system: RealSystem, task: RealTask) -> tuple[Piece, CertifiedPoints]:
    """A set given by equations: where their gradients are independent at a point, a manifold near it."""
    elsewhere = task.found.stratum.elsewhere
    dimension = len(system.ring.names) - len(system.closed_equations)
    if dimension <= 0:
        points = finitely_many(system, task.found)
        if points is not None:
            return _finite(piece, points)
    codimension = numerical_codimension(system)
    if dimension > 0 and (codimension is None or codimension[0] != len(system.closed_equations)):
        isolated = isolated_points(system, task.found)
        if isolated is not None:
            return _finite(piece, isolated)
    if codimension is None and is_positive_combination_seen(system.closed_equations):
        return _exactly(piece, Known((-1, None)))
    patch = unsplit(system.closed_equations, system.ring)
    if codimension is None:
        empty = is_proven_empty(restricted(system, patch))
        if empty.is_yes:
            return _exactly(piece, Known((-1, None), empty.certainty))
    if codimension is None or codimension[0] == len(system.closed_equations):
        near = [codimension[1]] if codimension else []
        witness = find_witness(off_borders(system), tries=SEARCHES, near=near)
        if witness is not None and independent(system.closed_equations, witness.point):
            return _counted(*_bounded(piece, system, (dimension, witness), task), system, elsewhere)
    return _counted(*_singular(piece, system, patch), system, elsewhere)


def _bounded(
    piece: Piece, system: RealSystem, known: tuple[int, Witness], task: RealTask
) -> tuple[Piece, CertifiedPoints]:
    """A set with a certified point, near which it has a dimension: is there a part with a larger one?"""
    most, (dimension, witness) = piece.extent.at_most, known
    found, points = _known(piece, Extent(dimension, most), witness)
    try:
        with current().part(task.bounding):
            for larger, other in chain([known], larger_parts(off_borders(system), dimension)):
                found, points = _known(piece, Extent(larger, most), other)
                if larger == most:
                    return found, points
                if (bound := _bound(system, larger, task)) is not None:
                    extent = Extent(larger, bound.value, bound.certainty)
                    return replace(found, extent=extent), points
            return _by_components(piece, system)
    except Undecided as reason:
        return replace(found, extent=replace(found.extent, open=str(reason))), points


def _singular(piece: Piece, system: RealSystem, patch: Patch) -> tuple[Piece, CertifiedPoints]:
    """A set of which no regular point is known; a manifold in it shows that it occurs, with a dimension."""
    inside = next(larger_parts(off_borders(system), 0), None)
    if inside is None:
        return _dependent(piece, system, patch)
    most, (dimension, witness) = piece.extent.at_most, inside
    found, points = _known(piece, Extent(dimension, most), witness)
    if dimension == most:
        return found, points
    try:
        return _dependent(piece, system, patch)
    except Undecided as reason:
        return replace(found, extent=replace(found.extent, open=str(reason))), points


def _dependent(piece: Piece, system: RealSystem, patch: Patch) -> tuple[Piece, CertifiedPoints]:
    """A set given by dependent equations: its dimension by cuts, else by its components."""
    chart, beside = charted(system, patch)
    cut = _cut(chart.system)
    if cut is not None and cut.value.dimension < 0:
        verdict = Verdict.no(cut.certainty, reason="there is no complex solution")
        return replace(piece, verdict=verdict, extent=EMPTY), ()
    point = None if cut is None else cut.value.point
    if cut is not None and point is not None and chart.faithful and _is_inside(point, chart.system):
        dimension = cut.value.dimension - beside
        near = _unsolved(chart, patch, point)
        witness = find_witness(system, tries=SEARCHES, dimension=dimension, near=[near])
        if witness is not None:
            return _known(piece, Extent(dimension, dimension, cut.certainty), witness)
    return _by_components(piece, system)


def _is_inside(witness: Witness, system: RealSystem) -> bool:
    """Whether no inequality is an equality at a point, so that the set is all of the zeros near it."""
    return all(witness.sign(witness.ring.convert(p)) > 0 for p in system.nonnegative if p)


def _by_components(piece: Piece, system: RealSystem) -> tuple[Piece, CertifiedPoints]:
    return _exactly(piece, real_dimension(system))


def _unsolved(chart: Cartesian, patch: Patch, witness: Witness) -> tuple[float, ...]:
    """A point of a chart in the variables from before, numerically; those in no equation are zero."""
    values = dict(zip(witness.ring.names, witness.floats, strict=True))
    found = list(chart.before([values.get(name, 0.0) for name in patch.ring.names]))
    solved = {patch.ring.index(name): value.evaluate(found) for name, value in patch.solved.items()}
    return tuple(solved.get(k, x) for k, x in enumerate(found))


def _bound(system: RealSystem, dimension: int, task: RealTask) -> Known[int] | None:
    """A bound of the dimension of a set, where it is one."""
    coordinates = task.coordinates if task.most == dimension + 1 else ()
    return upper_bound(system, dimension, task.feasible, task.circles, coordinates)


def _cut(system: RealSystem) -> Known[Cut] | None:
    """The dimension by cuts where it is found in time."""
    with attempt("the dimension of a set", patience.DIMENSION.work):
        return dimension_by_cuts(system)
    return None


def _are_one(one: RealPoint | BoxPoint, two: RealPoint | BoxPoint) -> bool:
    """Whether two points, found in the same way, are the same; raises `Undecided` where boxes do not tell."""
    if isinstance(one, RealPoint) and isinstance(two, RealPoint):
        return one.coincides(two)
    return isinstance(one, BoxPoint) and isinstance(two, BoxPoint) and one.coincides(two)


def _finite(piece: Piece, solutions: Known[CertifiedPoints]) -> tuple[Piece, CertifiedPoints]:
    """A set of these points."""
    points, known = solutions.value, solutions.certainty
    if not points:
        verdict = Verdict.no(
            known, reason="none of finitely many complex solutions is real, feasible and new"
        )
        return replace(piece, verdict=verdict, extent=EMPTY, points=0, components=0), ()
    count = len(points)
    boxed = any(isinstance(p, BoxPoint) for p in points)
    found = replace(
        piece,
        verdict=Verdict.yes("certified" if boxed else "proven"),
        extent=Extent(0, 0, known),
        points=count,
        components=count,
    )
    return found, points


def _exactly(piece: Piece, found: Known[Dimension]) -> tuple[Piece, CertifiedPoints]:
    """A set whose real dimension is known, with a point of it where there is one."""
    (dimension, witness), known = found.value, found.certainty
    if witness is None:
        verdict = Verdict.no(known, reason="the equations have no real and feasible solution")
        return replace(piece, verdict=verdict, extent=EMPTY), ()
    return _known(piece, Extent(dimension, dimension, known), witness)


def _known(piece: Piece, extent: Extent, witness: Witness) -> tuple[Piece, CertifiedPoints]:
    verdict = Verdict.yes("proven" if isinstance(witness.point, RealPoint) else "certified")
    return replace(piece, verdict=verdict, extent=extent), (witness.point,)


def _counted(
    piece: Piece, points: CertifiedPoints, system: RealSystem, elsewhere: tuple[Equations, ...]
) -> tuple[Piece, CertifiedPoints]:
    """The same with all points where the real dimension is 0, although there may be more complex zeros.

    Where no inequality is an equality, each is a connected component of the equations' zeros off the
    exclusions, and sample points meet all of them; else of the zeros with those equalities.
    """
    if piece.dimension != 0 or piece.points is not None:
        return piece, points
    try:
        samples = _samples(system, system.exclusion_polynomials, system.nonnegative)
    except Undecided as reason:
        return replace(piece, extent=replace(piece.extent, open=f"points not counted: {reason}")), points
    distinct: list[RealPoint] = []
    for point in samples.value:
        if not any(point.coincides(other) for other in distinct):
            distinct.append(point)
    known = weakest(piece.extent.bounded, samples.certainty)
    return _finite(piece, Known(admitted(distinct, system, elsewhere), known))


def _samples(system: RealSystem, nonzero: Equations, borders: Equations) -> Known[tuple[RealPoint, ...]]:
    """A point on each connected component of the zeros, and of those on one border, on two, and so on."""
    premises = Premises()
    found = premises.take(sample_points(system.ring, system.closed_equations, nonzero=nonzero))
    for k, border in enumerate(borders if found else ()):
        on_it = replace(system, equations=(*system.equations, border))
        found = (*found, *premises.take(_samples(on_it, nonzero, borders[k + 1 :])))
    return premises.conclude(found)
