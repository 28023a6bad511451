"""From a stratum to real answers: points, dimension, a certified configuration, or a proof that it is empty.

Source: conditions (i)-(vi) of Zlatanov, Fenton, Benhabib (1998) hold on the stratum; certificates as in
Hauenstein, Sottile, ACM Trans. Math. Softw. 38 (2012) 28.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from flint import arb

from singsym.classes.explore import Found
from singsym.classes.result import Configuration, Equations, Piece
from singsym.elimination.budget import Budget, Undecided
from singsym.elimination.verdict import Verdict
from singsym.kinematics.placement import Coordinates, JointValue
from singsym.varieties.real.box import BoxPoint
from singsym.varieties.real.curve import real_curve
from singsym.varieties.real.dimension import component_dimension, independent, real_dimension
from singsym.varieties.real.intervals import at_precision, evaluate
from singsym.varieties.real.points import RealPoint
from singsym.varieties.real.witness import RealSystem, Witness, find_witness
from singsym.varieties.real.zerodim import NotZeroDimensional, real_points

DIGITS = 15
SEARCHES = 300
"""Random starts in the search for a point of a set given by independent equations."""

_BITS = 80


@dataclass(frozen=True)
class Names:
    """What a configuration is reported in: named points of space, and the joints' values."""

    points: Mapping[str, Coordinates] = field(default_factory=dict)
    joints: Mapping[str, JointValue] = field(default_factory=dict)


@dataclass(frozen=True)
class RealTask:
    """A stratum to be realised on a feasible set, within a budget."""

    found: Found
    feasible: RealSystem
    names: Names
    seconds: float | None = None
    memory_mb: int | None = None


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


def realise(task: RealTask) -> Piece:
    """The real side of one stratum: the task that workers run."""
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
    try:
        with Budget(task.seconds, task.memory_mb):
            if stratum.component is None:
                return _given(piece, system, task.names, stratum.elsewhere)
            if stratum.component.dimension == 0:
                return _finite(piece, real_points(stratum.equations), system, task.names)
            return _positive(piece, component_dimension(stratum.component, system), task.names)
    except Undecided as reason:
        return replace(piece, verdict=Verdict.undecided(str(reason)))


def _given(piece: Piece, system: RealSystem, names: Names, elsewhere: tuple[Equations, ...]) -> Piece:
    """A set given by equations: where their gradients are independent at a point, a manifold near it."""
    dimension = len(system.ring.names) - len(system.closed_equations)
    if dimension <= 0:
        try:
            solutions = [p for p in real_points(piece.basis) if not _lies_in(p, elsewhere)]
            return _finite(piece, solutions, system, names)
        except NotZeroDimensional:
            return _positive(piece, real_dimension(system), names)
    witness = find_witness(system, dimension=dimension, tries=SEARCHES)
    if witness is not None and independent(system.closed_equations, witness.point):
        return _positive(piece, (dimension, witness), names)
    return _positive(piece, real_dimension(system), names)


def _lies_in(point: RealPoint, loci: tuple[Equations, ...]) -> bool:
    return any(all(point.sign(p) == 0 for p in locus) for locus in loci)


def _finite(piece: Piece, solutions: Sequence[RealPoint], system: RealSystem, names: Names) -> Piece:
    points = [p for p in solutions if system.admits(p)]
    if not points:
        verdict = Verdict.no(reason="none of finitely many complex solutions is real and feasible")
        return replace(piece, verdict=verdict, dimension=-1, points=0)
    shown = tuple(configuration(p, names) for p in points)
    return replace(
        piece, verdict=Verdict.yes(), dimension=0, points=len(points), components=len(points), witnesses=shown
    )


def _positive(piece: Piece, found: tuple[int, Witness | None], names: Names) -> Piece:
    dimension, witness = found
    if witness is None:
        verdict = Verdict.no(reason="the equations have no real and feasible solution")
        return replace(piece, verdict=verdict, dimension=-1)
    verdict = Verdict.yes("proven" if isinstance(witness.point, RealPoint) else "certified")
    return replace(
        piece, verdict=verdict, dimension=dimension, witnesses=(configuration(witness.point, names),)
    )


def count(task: CurveTask) -> Counted:
    """The connected components of a real curve, closed up: the task that workers run."""
    with Budget(task.seconds, task.memory_mb):
        curve = real_curve(task.equations)
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
