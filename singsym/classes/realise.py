"""From a stratum to real answers: points, dimension, a certified configuration, or a proof that it is empty.

Source: conditions (i)-(vi) of Zlatanov, Fenton, Benhabib (1998) hold on the stratum; certificates as in
Hauenstein, Sottile, ACM Trans. Math. Softw. 38 (2012) 28.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace

from flint import arb

from singsym.classes.explore import Found
from singsym.classes.patches import Patch, unsplit
from singsym.classes.presence import is_proven_empty, restricted
from singsym.classes.result import Configuration, Equations, Piece
from singsym.classes.strata import Stratum
from singsym.classes.symmetry import image
from singsym.elimination.attempts import attempt
from singsym.elimination.budget import Budget, Undecided
from singsym.elimination.chance import BY_PRIMES
from singsym.elimination.ideal import Ideal
from singsym.elimination.verdict import Verdict, certainties, weakest
from singsym.kinematics.placement import Coordinates, JointValue
from singsym.varieties.real.box import BoxPoint
from singsym.varieties.real.cartesian import Cartesian
from singsym.varieties.real.curve import real_curve
from singsym.varieties.real.curve_equations import NotACurve
from singsym.varieties.real.cuts import Cut, dimension_by_cuts, seems_at_most
from singsym.varieties.real.dimension import component_dimension, independent, real_dimension
from singsym.varieties.real.intervals import at_precision, evaluate
from singsym.varieties.real.points import RealPoint
from singsym.varieties.real.sampling import numerical_codimension
from singsym.varieties.real.witness import RealSystem, Witness, find_witness
from singsym.varieties.real.zerodim import NotZeroDimensional, real_points

DIGITS = 15
SEARCHES = 300
"""Random starts in the search for a point of a set given by independent equations."""

DIMENSION_SECONDS = 20.0
"""So long the dimension of a set that has a certified point is looked for."""
BOUND_SECONDS, LONG_BOUND_SECONDS = 2.0, 15.0
"""So long a bound is looked for where only a large dimension matters, and once more where none is found."""
DIMENSION_SHARE = 1 / 3
"""Of this time so much is for the dimension itself."""

_BITS = 80


@dataclass(frozen=True)
class Names:
    """What a configuration is reported in: named points of space, and the joints' values."""

    points: Mapping[str, Coordinates] = field(default_factory=dict)
    joints: Mapping[str, JointValue] = field(default_factory=dict)


@dataclass(frozen=True)
class RealTask:
    """A stratum to be realised on a feasible set, within a budget.

    known: a dimension, where only a larger one of the stratum would matter.
    """

    found: Found
    feasible: RealSystem
    names: Names
    seconds: float | None = None
    memory_mb: int | None = None
    known: int | None = None


@dataclass(frozen=True)
class CurveTask:
    """A curve whose connected components are to be counted."""

    equations: Equations
    seconds: float | None = None
    memory_mb: int | None = None


@dataclass(frozen=True)
class Counted:
    """The number of connected components, or None with the reason."""

    components: int | None
    reason: str = ""

    @property
    def provisional(self) -> bool:
        """Whether a larger budget could say more."""
        return self.components is None


@dataclass(frozen=True)
class Realised:
    """What a stratum and its images come to: a piece each."""

    pieces: tuple[Piece, ...]

    @property
    def provisional(self) -> bool:
        """Whether a larger budget could say more."""
        return any(piece.provisional for piece in self.pieces)


Points = tuple[RealPoint | BoxPoint, ...]


def realise(task: RealTask) -> Realised:
    """The real side of one stratum and of its images: the task that workers run."""
    stratum = task.found.stratum
    piece = Piece(
        task.found.path,
        stratum.equations,
        stratum.loci,
        stratum.defects,
        Verdict.undecided("not examined"),
    )
    exclusions = (*task.feasible.exclusions, *stratum.loci)
    system = replace(task.feasible, equations=stratum.equations, exclusions=exclusions)
    points: Points = ()
    if task.known is not None:
        piece = _bounded(piece, system, task.known, BOUND_SECONDS)
        if piece.at_most is not None and piece.at_most <= task.known:
            verdict = Verdict.undecided(f"only a dimension above {task.known} would matter")
            return Realised(tuple(_images(replace(piece, verdict=verdict), points, task)))
    try:
        with Budget(work=task.seconds, memory_mb=task.memory_mb), certainties() as seen:
            piece, points = _realised(piece, system, stratum)
        if piece.verdict.is_no:
            verdict = replace(piece.verdict, certainty=weakest(piece.verdict.certainty, *seen))
            piece = replace(piece, verdict=verdict)
    except Undecided as reason:
        piece = replace(piece, verdict=Verdict.undecided(str(reason)))
        if task.known is not None:
            piece = _bounded(piece, system, task.known, LONG_BOUND_SECONDS)
    return Realised(tuple(_images(piece, points, task)))


def _realised(piece: Piece, system: RealSystem, stratum: Stratum) -> tuple[Piece, Points]:
    component = stratum.component
    if component is None:
        return _given(piece, system, stratum.elsewhere)
    if component.dimension == 0:
        return _finite(piece, real_points(stratum.equations), system, stratum.elsewhere)
    return _positive(piece, component_dimension(component, system))


def _images(piece: Piece, points: Points, task: RealTask) -> Iterator[Piece]:
    """The piece with its configurations for each image; a point that an earlier image has is left out."""
    seen: list[RealPoint] = []
    for reflection in task.found.images:
        own = []
        for point in (p.reflect(reflection) for p in points):
            if piece.points is not None and isinstance(point, RealPoint):
                if any(point.coincides(other) for other in seen):
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
        yield replace(shown, points=len(own), components=len(own)) if piece.points else shown


def _given(piece: Piece, system: RealSystem, elsewhere: tuple[Equations, ...]) -> tuple[Piece, Points]:
    """A set given by equations: where their gradients are independent at a point, a manifold near it."""
    dimension = len(system.ring.names) - len(system.closed_equations)
    if dimension <= 0:
        with suppress(NotZeroDimensional), attempt("finitely many points", share=1 / 3):
            return _finite(piece, real_points(piece.basis), system, elsewhere)
    codimension = numerical_codimension(system)
    patch = unsplit(system.closed_equations, system.ring)
    if codimension is None and is_proven_empty(restricted(system, patch)):
        return _positive(piece, (-1, None))
    if codimension in (None, len(system.closed_equations)):
        witness = find_witness(system, tries=SEARCHES)
        if witness is not None and independent(system.closed_equations, witness.point):
            return _positive(piece, (dimension, witness))
    return _dependent(piece, system, patch)


def _dependent(piece: Piece, system: RealSystem, patch: Patch) -> tuple[Piece, Points]:
    """A set given by dependent equations: its dimension by cuts, else by its components."""
    chart, beside = _charted(system, patch)
    cut = _cut(chart.system)
    if cut is not None and cut.dimension < 0:
        verdict = Verdict.no(cut.certainty, reason="there is no complex solution")
        return replace(piece, verdict=verdict, dimension=-1), ()
    if cut is not None and cut.point is not None and chart.faithful:
        dimension = cut.dimension - beside
        near = _unsolved(chart, patch, cut.point)
        witness = find_witness(system, tries=SEARCHES, dimension=dimension, near=[near])
        if witness is not None:
            found, points = _positive(piece, (dimension, witness))
            if cut.certainty == "modular":
                reason = f"its dimension rests on a Groebner basis {BY_PRIMES}"
                found = replace(found, verdict=replace(found.verdict, reason=reason))
            return found, points
    return _positive(piece, real_dimension(system))


def _unsolved(chart: Cartesian, patch: Patch, witness: Witness) -> tuple[float, ...]:
    """A point of a chart in the variables from before, numerically; those in no equation are zero."""
    values = dict(zip(witness.ring.names, witness.floats, strict=True))
    found = list(chart.before([values.get(name, 0.0) for name in patch.ring.names]))
    solved = {patch.ring.index(name): value.evaluate(found) for name, value in patch.solved.items()}
    return tuple(solved.get(k, x) for k, x in enumerate(found))


def _charted(system: RealSystem, patch: Patch) -> tuple[Cartesian, int]:
    """A set on a patch in few variables, and how many of the ring's it leaves free there."""
    chart = Cartesian.of(restricted(system, patch))
    return chart, len(patch.solved) + chart.left_out


def _bounded(piece: Piece, system: RealSystem, known: int, seconds: float) -> Piece:
    """The piece with a bound of its dimension where one is found soon: the complex one, else `known`."""
    chart, beside = _charted(system, unsplit(system.closed_equations, system.ring))
    equations = chart.system.closed_equations
    with certainties() as seen:
        with attempt("a complex dimension", seconds * DIMENSION_SHARE):
            at_most = Ideal(system.ring, equations).dimension - beside
            return replace(piece, at_most=at_most, bounded=weakest(*seen))
        with attempt("a bound of a dimension", seconds):
            if seems_at_most(system.ring, equations, known + beside):
                return replace(piece, at_most=known, bounded="modular")
    return piece


def _cut(system: RealSystem) -> Cut | None:
    """The dimension by cuts where it is found in time."""
    with attempt("the dimension of a set", DIMENSION_SECONDS):
        return dimension_by_cuts(system)
    return None


def _lies_in(point: RealPoint, loci: tuple[Equations, ...]) -> bool:
    return any(all(point.sign(p) == 0 for p in locus) for locus in loci)


def _finite(
    piece: Piece, solutions: Sequence[RealPoint], system: RealSystem, elsewhere: tuple[Equations, ...]
) -> tuple[Piece, Points]:
    points = tuple(p for p in solutions if system.admits(p) and not _lies_in(p, elsewhere))
    if not points:
        verdict = Verdict.no(reason="none of finitely many complex solutions is real, feasible and new")
        return replace(piece, verdict=verdict, dimension=-1, points=0), ()
    count = len(points)
    return replace(piece, verdict=Verdict.yes(), dimension=0, points=count, components=count), points


def _positive(piece: Piece, found: tuple[int, Witness | None]) -> tuple[Piece, Points]:
    dimension, witness = found
    if witness is None:
        verdict = Verdict.no(reason="the equations have no real and feasible solution")
        return replace(piece, verdict=verdict, dimension=-1), ()
    verdict = Verdict.yes("proven" if isinstance(witness.point, RealPoint) else "certified")
    return replace(piece, verdict=verdict, dimension=dimension), (witness.point,)


def count(task: CurveTask) -> Counted:
    """The connected components of a real curve, closed up: the task that workers run.

    They are not counted where the complex zeros are no curve, as of x^2 + y^2 = 0 in space.
    """
    try:
        with Budget(work=task.seconds, memory_mb=task.memory_mb):
            curve = real_curve(task.equations)
    except NotACurve as reason:
        return Counted(None, str(reason))
    if curve.verdict.is_undecided:
        return Counted(None, curve.verdict.reason)
    return Counted(curve.connected_components)


# -- configurations ----------------------------------------------------------------------------------


def configuration(point: RealPoint | BoxPoint, names: Names) -> Configuration:
    """A point as decimal strings of 15 digits, with a bound on their error.

    Coordinates of the configuration space, of the named points, and joint values: angles in radians.
    """
    box = point.refine(_BITS).box
    with at_precision(_BITS + 64):
        coordinates = dict(zip(point.ring.names, box, strict=True))
        points = {
            f"{name}.{axis}": evaluate(value, box)
            for name, place in names.points.items()
            for axis, value in zip("xyz", place, strict=False)
        }
        joints = {}
        for name, value in names.joints.items():
            found = _joint(value, box)
            if found is not None:
                joints[name] = found
        tables = [_decimals(table) for table in (coordinates, points, joints)]
        radius = max((r for _, r in tables), default=0.0)
    return Configuration(tables[0][0], tables[1][0], tables[2][0], f"{radius:.1e}")


def _joint(value: JointValue, box: tuple[arb, ...]) -> arb | None:
    if value.length is not None:
        return evaluate(value.length, box)
    if value.square is not None:
        return evaluate(value.square, box).sqrt()
    if value.cosine is not None and value.sine is not None:
        sine, cosine = evaluate(value.sine, box), evaluate(value.cosine, box)
        if cosine < 0 and sine.contains(0):
            # atan2 jumps here between pi and -pi, and its ball would hold both
            return arb.pi() + arb.atan2(-sine, -cosine)
        return arb.atan2(sine, cosine)
    return None


def _decimals(table: Mapping[str, arb]) -> tuple[dict[str, str], float]:
    """Rounded midpoints, and a bound on the distance of each from the exact value."""
    shown: dict[str, str] = {}
    worst = 0.0
    for name, value in table.items():
        middle = float(value.mid())
        shown[name] = f"{middle:.{DIGITS}g}" if middle else "0"
        error = abs(value - arb(shown[name]))
        worst = max(worst, float(error.upper()))
    return shown, worst * (1 + 1e-9)
