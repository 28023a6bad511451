"""One configuration: its four ranks, defects, types, class and null motions.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.2 (types by null motions) and 2.3 (types by ranks).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from singsym.classes.configuration.exact_configuration import exact_kernels, exact_values
from singsym.classes.configuration.given_values import DOUBLE_DIGITS, Given, Target, targets
from singsym.classes.configuration.locate import Located, is_feasible, locate, number, sizes_of_coordinates
from singsym.classes.configuration.null_motions import Motion, null_motions, numerical_kernels
from singsym.classes.taxonomy.types import Defects, SingularityClass, SingularityType, class_of
from singsym.kinematics.numerical_rank import NumericalRank, gap_below, numerical_rank
from singsym.kinematics.scaling import Scaled, scaled_matrix
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism.model import Mechanism
from singsym.mechanism.problems import MechanismError, Problem

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_MOST_THRESHOLD = 1e-3
_MOST_DIGITS = 500


@dataclass(frozen=True)
class MatrixReport:
    """A matrix at a configuration: its rank, the full rank, singular values and the gap below the rank.

    Singular values are those of L scaled to pure numbers, as `kinematics.scaling.scaled_matrix` says: unit
    joint screws, lengths over the characteristic length.
    distance: the smallest singular value of those that a regular configuration has.  By Eckart and Young that
    is how far the scaled matrix is from the nearest one of too low a rank.  It depends neither on the unit of
    length nor on the frame, changes continuously with the configuration, and is zero where the rank is low;
    infinite for a matrix without columns that a regular configuration has.
    """

    rank: int
    full: int
    singular_values: tuple[float, ...]
    distance: float
    gap: float


@dataclass(frozen=True)
class Analysis:
    """What is known of one configuration.

    values, points, joints: the configuration examined, in floats, or in mpmath numbers where it is given to
    more digits; digits: how many they hold.  exact: whether ranks are exact.
    located: how the given values were brought onto the loops, None where they were exact.
    threshold: singular values below it count as zero (not used where exact).
    length: the characteristic length by which lengths were divided.
    undecided: why the ranks are not to be trusted; empty where they are.
    """

    equation: VelocityEquation
    values: Mapping[str, Any]
    points: Mapping[str, tuple[Any, ...]]
    joints: Mapping[str, Any]
    digits: int
    exact: bool
    located: Located | None
    matrices: Mapping[str, MatrixReport]
    threshold: float
    length: float
    motions: tuple[Motion, ...]
    remarks: tuple[str, ...]
    undecided: str

    @property
    def ranks(self) -> dict[str, int]:
        """The four ranks."""
        return {name: report.rank for name, report in self.matrices.items()}

    @property
    def defects(self) -> Defects:
        """(delta, p, k_I, k_O)."""
        return _defects(self.equation, self.ranks)

    @property
    def types(self) -> SingularityType:
        """The types of the configuration; none where it is regular."""
        return self.defects.types

    @property
    def singularity_class(self) -> SingularityClass | None:
        """Its class; None where it is regular or undecided."""
        return None if self.undecided else class_of(self.types)


def at(
    mechanism: Mechanism,
    given: Given | Mapping[str, Any],
    *,
    formulation: str = "auto",
    tolerance: float | None = None,
    file: str = "",
    near: Analysis | None = None,
) -> Analysis:
    """Examine the configuration of a mechanism with these joint values, points or variables.

    given: a `Given`, or a dict of dicts as {"points": {"B": [0.6, 0.8]}}.  Exact where the values satisfy the
    loop equations exactly, else the configuration nearest to them, with numerical ranks: in double precision,
    or as precisely as the values are written where that is more.
    tolerance: singular values below it count as zero, by default by how well the values fit the loops.
    near: an earlier analysis of the same mechanism.  The configuration is then looked for from there alone,
    on the same assembly mode where the step is small, numerically, and many times faster.
    Raises `MechanismError` for names that are not there, or where no configuration is near.

    >>> from singsym.mechanism import load
    >>> found = at(load("slider-crank"), {"points": {"B": [0, 1], "C": ["sqrt(8)", 0]}})
    >>> found.exact, str(found.types)
    (True, 'regular')
    """
    equation = velocity_equation(mechanism, formulation) if near is None else near.equation
    return at_equation(equation, given, tolerance=tolerance, file=file, near=near)


def at_equation(
    equation: VelocityEquation,
    given: Given | Mapping[str, Any],
    *,
    tolerance: float | None = None,
    file: str = "",
    near: Analysis | None = None,
) -> Analysis:
    """The same for a velocity equation."""
    read = given if isinstance(given, Given) else Given.of(given, file)
    wanted = targets(read, equation, file)
    if near is not None:
        start = [near.values[name] for name in equation.space.ring.names]
        return _numerical_analysis(equation, wanted, read.digits, tolerance, file, start)
    values = exact_values(equation, wanted)
    kernels = None if values is None else exact_kernels(equation, values)
    if values is not None and kernels is not None:
        expressions = [values[name] for name in equation.space.ring.names]
        return _exact_analysis(equation, expressions, kernels)
    return _numerical_analysis(equation, wanted, read.digits, tolerance, file)


# -- exact -------------------------------------------------------------------------------------------


def _exact_analysis(
    equation: VelocityEquation, values: Sequence[Any], kernels: Mapping[str, Floats]
) -> Analysis:
    """Ranks from exact kernels; singular values with as many digits as they need to show those ranks."""
    import numpy as np

    ranks = {name: kernel.shape[1] - len(kernel) for name, kernel in kernels.items()}
    digits = DOUBLE_DIGITS
    while True:
        with _precision(digits):
            point: Any = [number(v) for v in values] if digits > DOUBLE_DIGITS else np.array(values, float)
            scaled = scaled_matrix(equation, point)
            found = {name: numerical_rank(part, 0.0) for name, part in scaled.submatrices().items()}
            smallest = min(
                (f.singular_values[ranks[k] - 1] for k, f in found.items() if ranks[k]), default=1.0
            )
            if smallest > 10.0 ** (-digits / 2) or digits > _MOST_DIGITS:
                break
        digits *= 2
    floats = np.array([float(x) for x in point])
    matrices = {}
    for name, seen in found.items():
        full, rank = _full(equation, name), ranks[name]
        distance = _distance(seen, full) if rank == full else 0.0
        gap = gap_below(seen.singular_values, rank)
        matrices[name] = MatrixReport(rank, full, seen.singular_values, distance, gap)
    scaled_kernels = {name: _orthonormal(scaled, name, kernel) for name, kernel in kernels.items()}
    types = _defects(equation, ranks).types
    return Analysis(
        equation,
        *_configuration(equation, floats.tolist()),
        DOUBLE_DIGITS,
        True,
        None,
        matrices,
        0.0,
        scaled.length,
        null_motions(equation, scaled_kernels, scaled.units, types),
        tuple(_remarks(equation, None, floats)),
        "",
    )


def _orthonormal(scaled: Scaled, name: str, kernel: Floats) -> Floats:
    """The same space as rows over all columns of L, orthonormal in scaled rates."""
    import numpy as np

    places = scaled.columns(name)
    found = np.zeros((len(kernel), len(scaled.units)))
    found[:, places] = kernel / scaled.units[places] if len(kernel) else kernel
    return np.asarray(np.linalg.qr(found.T)[0].T)


# -- numerical ---------------------------------------------------------------------------------------


def _numerical_analysis(
    equation: VelocityEquation,
    wanted: Sequence[Target],
    digits: int,
    tolerance: float | None,
    file: str,
    near: Sequence[Any] | None = None,
) -> Analysis:
    """Ranks by singular values, of the configuration nearest to the targets; near: where alone to start."""
    import numpy as np

    with _precision(2 * digits if digits > DOUBLE_DIGITS else digits):
        located = locate(equation, wanted, digits > DOUBLE_DIGITS, near=near)
        if located is None or located.misfit > 0.5:
            nothing = "values near which no configuration was reached"
            expected = "joint values, points or variables of a configuration"
            raise MechanismError([Problem("file", nothing, expected, file=file)])
        settled = digits if not _in_doubles(located.point) else DOUBLE_DIGITS
        scaled = _scaled_at(equation, located.point)
        error = max(located.misfit, located.after, _change(equation, scaled, located), 10.0**-settled)
        # an error e of a length moves an extended leg's singular value by sqrt(e)
        threshold = tolerance or min(_MOST_THRESHOLD, 10 * error**0.5)
        parts = scaled.submatrices()
        seen = {name: numerical_rank(part, threshold, size=1.0) for name, part in parts.items()}
        configuration = _configuration(equation, located.point)
    matrices = {}
    for name, found in seen.items():
        full = _full(equation, name)
        matrices[name] = MatrixReport(
            found.rank, full, found.singular_values, _distance(found, full), found.gap
        )
    ranks = {name: found.rank for name, found in seen.items()}
    defects = _defects(equation, ranks)
    feasible = defects.is_feasible(equation.n)
    kernels = numerical_kernels(scaled, seen, ranks) if feasible else {}
    floats = np.array([float(x) for x in located.point])
    lost = () if settled == digits else (f"{digits} digits were given, {settled} could be settled",)
    return Analysis(
        equation,
        *configuration,
        settled,
        False,
        located,
        matrices,
        threshold,
        scaled.length,
        null_motions(equation, kernels, scaled.units, defects.types) if feasible else (),
        (*_remarks(equation, located, floats), *lost),
        _doubt(seen, feasible, threshold, tolerance is not None),
    )


def _scaled_at(equation: VelocityEquation, point: Sequence[Any]) -> Scaled:
    """L, scaled, at a point of floats or of mpmath numbers."""
    import numpy as np

    return scaled_matrix(equation, np.array(point, float) if _in_doubles(point) else point)


def _in_doubles(point: Sequence[Any]) -> bool:
    return all(isinstance(x, float) for x in point)


def _change(equation: VelocityEquation, scaled: Scaled, located: Located) -> float:
    """How much L changes on the way from the given values to the configuration."""
    import numpy as np

    change = scaled.matrix - _scaled_at(equation, located.given).matrix
    return float(np.linalg.norm(change.astype(np.float64)))


def _doubt(seen: Mapping[str, NumericalRank], feasible: bool, threshold: float, chosen: bool) -> str:
    """Why numerical ranks are undecided; chosen: whether the threshold was the user's own."""
    if not feasible:
        return f"the numerical ranks contradict each other at threshold {threshold:.1e}"
    unclear = [name for name, found in seen.items() if not found.is_clear]
    if unclear and not chosen:
        return f"a singular value of {', '.join(unclear)} is too near to the threshold {threshold:.1e}"
    return ""


# -- both --------------------------------------------------------------------------------------------


@contextmanager
def _precision(digits: int) -> Iterator[None]:
    """The precision of mpmath inside, where doubles do not hold so many digits."""
    if digits <= DOUBLE_DIGITS:
        yield
        return
    import mpmath

    with mpmath.workdps(digits):
        yield


def _defects(equation: VelocityEquation, r: Mapping[str, int]) -> Defects:
    return Defects.of_ranks(r["L"], r["L_I"], r["L_O"], r["L_p"], equation.N, equation.n)


def _full(equation: VelocityEquation, name: str) -> int:
    return equation.N - equation.n if name == "L_p" else equation.N


def _distance(seen: NumericalRank, full: int) -> float:
    if not full:
        return float("inf")
    return seen.singular_values[full - 1] if full <= len(seen.singular_values) else 0.0


def _configuration(
    equation: VelocityEquation, point: Sequence[Any]
) -> tuple[dict[str, Any], dict[str, tuple[Any, ...]], dict[str, Any]]:
    """The values of the variables, of the points' coordinates and of the joints."""
    values = dict(zip(equation.space.ring.names, point, strict=True))
    points = {k: tuple(p.evaluate(point) for p in v) for k, v in equation.space.points.items()}
    return values, points, _joint_values(equation, point)


def _joint_values(equation: VelocityEquation, point: Sequence[Any]) -> dict[str, Any]:
    import math

    import mpmath

    functions: Any = math if _in_doubles(point) else mpmath
    found = {}
    for name, joint in equation.values.items():
        if joint.length is not None:
            found[name] = joint.length.evaluate(point)
        elif joint.square is not None:
            found[name] = functions.sqrt(max(0.0, joint.square.evaluate(point)))
        elif joint.cosine is not None and joint.sine is not None:
            found[name] = functions.atan2(joint.sine.evaluate(point), joint.cosine.evaluate(point))
    return found


def _remarks(equation: VelocityEquation, located: Located | None, point: Floats) -> Iterator[str]:
    if located is not None:
        if located.others and not located.open:
            others = (
                f"{located.others} other configuration{'s fit' if located.others > 1 else ' fits'} as well"
            )
            yield f"{others}: give more values to tell them apart"
        if located.open:
            freedoms = f"{located.open} freedom{'s' if located.open > 1 else ''}"
            yield f"the given values leave {freedoms}: one of many configurations is shown"
        if located.misfit > 1e-2:
            yield f"no configuration is nearer to the given values than {located.misfit:.2g} of their size"
    if not is_feasible(equation, point, sizes_of_coordinates(equation)):
        yield "the configuration is outside the feasible set (limits or exclusions)"
