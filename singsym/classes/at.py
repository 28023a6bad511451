"""One configuration: its four ranks, defects, types, class and null motions.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.2 (types by null motions) and 2.3 (types by ranks).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import sympy

from singsym.classes.given import Given, Located, exact_values, is_feasible, locate, size, targets
from singsym.classes.motions import Motion, null_motions
from singsym.classes.types import Defects, SingularityClass, SingularityType, class_of
from singsym.kinematics.sampling import numerical_matrix
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism.model import Mechanism
from singsym.mechanism.outputs import SLIDING
from singsym.mechanism.problems import MechanismError, Problem
from singsym.polynomials import PolynomialMatrix

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

NAMES = ("L", "L_I", "L_O", "L_p")
_LEAST, _MOST = 1e-8, 1e-3


@dataclass(frozen=True)
class MatrixReport:
    """A matrix at a configuration: its rank, the full rank, singular values and the gap below the rank.

    distance: the smallest singular value of those that a regular configuration has, over the largest.
    """

    rank: int
    full: int
    singular_values: tuple[float, ...]
    distance: float
    gap: float


@dataclass(frozen=True)
class Analysis:
    """What is known of one configuration.

    values, points, joints: the configuration examined, in floats; exact: whether ranks are exact.
    located: how the given values were brought onto the loops, None where they were exact.
    threshold: singular values below this fraction of the largest count as zero (not used where exact).
    length: the characteristic length by which lengths were divided.
    """

    equation: VelocityEquation
    values: Mapping[str, float]
    points: Mapping[str, tuple[float, ...]]
    joints: Mapping[str, float]
    exact: bool
    located: Located | None
    matrices: Mapping[str, MatrixReport]
    threshold: float
    length: float
    motions: tuple[Motion, ...]
    remarks: tuple[str, ...] = field(default=())

    @property
    def ranks(self) -> dict[str, int]:
        """The four ranks."""
        return {name: report.rank for name, report in self.matrices.items()}

    @property
    def defects(self) -> Defects:
        """(delta, p, k_I, k_O)."""
        r = self.ranks
        return Defects.of_ranks(r["L"], r["L_I"], r["L_O"], r["L_p"], self.equation.N, self.equation.n)

    @property
    def types(self) -> SingularityType:
        """The types of the configuration; none where it is regular."""
        return self.defects.types

    @property
    def singularity_class(self) -> SingularityClass | None:
        """Its class; None where it is regular, or where numerical ranks contradict each other."""
        return class_of(self.types) if self.defects.is_feasible(self.equation.n) else None


def at(
    mechanism: Mechanism,
    given: Given | Mapping[str, Any],
    *,
    formulation: str = "auto",
    tolerance: float | None = None,
    file: str = "",
) -> Analysis:
    """Examine the configuration of a mechanism with these joint values, points or variables.

    given: a `Given`, or a dict of dicts as {"points": {"B": [0.6, 0.8]}}.  Exact where the values satisfy the
    loop equations exactly, else the configuration nearest to them, with numerical ranks.
    Raises `MechanismError` for names that are not there, or where no configuration is near.

    >>> from singsym.mechanism import load
    >>> found = at(load("slider-crank"), {"points": {"B": [0, 1], "C": ["sqrt(8)", 0]}})
    >>> found.exact, str(found.types)
    (True, 'regular')
    """
    equation = velocity_equation(mechanism, formulation)
    slides = {
        f"{joint.name}.{freedom}" if freedom else joint.name
        for joint in mechanism.joints
        for freedom in SLIDING.get(joint.kind.value, ())
    }
    return at_equation(equation, given, tolerance=tolerance, slides=slides, file=file)


def at_equation(
    equation: VelocityEquation,
    given: Given | Mapping[str, Any],
    *,
    tolerance: float | None = None,
    slides: set[str] | frozenset[str] = frozenset(),
    file: str = "",
) -> Analysis:
    """The same for a velocity equation; slides: labels of the joint columns whose rates are lengths."""
    import numpy as np

    read = given if isinstance(given, Given) else Given.of(given, file)
    wanted = targets(read, equation, file)
    exact = exact_values(equation, wanted)
    ranks = None if exact is None else exact_ranks(equation, exact)
    located = None
    if exact is not None and ranks is not None:
        point = np.array([float(exact[name]) for name in equation.space.ring.names])
    else:
        located = locate(equation, wanted)
        if located is None or located.misfit > 0.5 * size(equation):
            found = "values near which no configuration was reached"
            expected = "joint values, points or variables of a configuration"
            raise MechanismError([Problem("file", found, expected, file=file)])
        point = np.array(located.point)
    residual = 0.0 if located is None else max(located.before, located.after, located.misfit)
    # an error e of a length moves an extended leg's singular value by sqrt(e)
    threshold = tolerance or min(_MOST, max(_LEAST, 10 * residual**0.5))
    length = _characteristic_length(equation, point)
    scaled = _scaled(equation, point, length, slides)
    matrices = {
        name: _report(matrix, threshold, None if ranks is None else ranks[name], _full(equation, name))
        for name, matrix in _submatrices(equation, scaled.matrix).items()
    }
    analysis = Analysis(
        equation,
        dict(zip(equation.space.ring.names, map(float, point), strict=True)),
        {k: tuple(_value(p, point) for p in v) for k, v in equation.space.points.items()},
        _joint_values(equation, point),
        ranks is not None,
        located,
        matrices,
        threshold,
        length,
        (),
        tuple(_remarks(equation, located, point)),
    )
    motions = null_motions(equation, scaled.matrix, scaled.columns, analysis.ranks, analysis.types)
    return _with_motions(analysis, motions)


def _with_motions(analysis: Analysis, motions: tuple[Motion, ...]) -> Analysis:
    remarks = list(analysis.remarks)
    if not analysis.defects.is_feasible(analysis.equation.n):
        said = f"the numerical ranks contradict each other at threshold {analysis.threshold:.1e}"
        remarks.append(f"{said}: give more digits")
    return replace(analysis, motions=motions, remarks=tuple(remarks))


# -- exact -------------------------------------------------------------------------------------------


def exact_ranks(equation: VelocityEquation, values: Mapping[str, sympy.Expr]) -> dict[str, int] | None:
    """The four ranks over the number field of the values; None where the loops do not close exactly."""
    from sympy.polys.constructor import construct_domain
    from sympy.polys.matrices import DomainMatrix

    given = [values[name] for name in equation.space.ring.names]
    if not given or not all(v.is_algebraic for v in given):
        return None
    domain, elements = construct_domain(given, extension=True)
    if not (domain.is_ZZ or domain.is_QQ or domain.is_Algebraic):
        return None
    field_ = domain.get_field()
    point = [field_.convert_from(e, domain) for e in elements]
    if any(e.evaluate(point) for e in equation.space.equations):
        return None

    def rank(matrix: PolynomialMatrix) -> int:
        if 0 in matrix.shape:
            return 0
        rows = [[field_.convert(e) for e in row] for row in matrix.evaluate(point)]
        return int(DomainMatrix(rows, matrix.shape, field_).rank())

    return {name: rank(getattr(equation, name)) for name in NAMES}


# -- numerical ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Scaled:
    """L with lengths divided by a characteristic length and joint columns of norm 1.

    columns: what each column was multiplied by, so that rates = scaled rates * columns.
    """

    matrix: Floats
    columns: Floats


def _scaled(
    equation: VelocityEquation, point: Floats, length: float, slides: set[str] | frozenset[str]
) -> _Scaled:
    import numpy as np

    matrix = numerical_matrix(equation.matrix, point)
    kinds = {c.label: c.label in slides or _slides(equation, c.label) for c in equation.columns}
    outputs = [c for c in equation.columns if c.role == "output"]
    for place, column in enumerate(outputs):
        last = column.label.partition(".")[2]
        kinds[column.label] = kinds.get(last, last in ("vx", "vy", "vz", "x", "y", "z"))
        if place < len(equation.rows) and equation.rows[place].startswith("output"):
            matrix[place] /= length if kinds[column.label] else 1.0
    for i, row in enumerate(equation.rows):
        if row.endswith((" vx", " vy", " vz")) and not row.startswith("output"):
            matrix[i] /= length
    scale = np.array([length if kinds[c.label] else 1.0 for c in equation.columns])
    matrix = matrix * scale
    norms = np.linalg.norm(matrix, axis=0)
    norms[: len(outputs)] = 1.0
    norms = np.where(norms > 0, norms, 1.0)
    return _Scaled(matrix / norms, scale / norms)


def _slides(equation: VelocityEquation, label: str) -> bool:
    value = equation.values.get(label)
    return value is not None and (value.length is not None or value.square is not None)


def _submatrices(equation: VelocityEquation, matrix: Floats) -> dict[str, Floats]:
    dropped = {"L": (), "L_I": ("input",), "L_O": ("output",), "L_p": ("input", "output")}
    return {
        name: matrix[:, [j for j, c in enumerate(equation.columns) if c.role not in roles]]
        for name, roles in dropped.items()
    }


def _full(equation: VelocityEquation, name: str) -> int:
    return equation.N - equation.n if name == "L_p" else equation.N


def _report(matrix: Floats, threshold: float, exact: int | None, full: int) -> MatrixReport:
    import numpy as np

    values = np.linalg.svd(matrix, compute_uv=False) if matrix.size else np.zeros(0)
    largest = float(values[0]) if len(values) else 1.0
    rank = int((values > threshold * largest).sum()) if exact is None else exact
    below = float(values[rank]) if rank < len(values) else 0.0
    gap = float("inf") if rank == 0 or below <= 1e-300 else float(values[rank - 1]) / below
    distance = float(values[full - 1]) / (largest or 1.0) if 0 < full <= len(values) else 0.0
    return MatrixReport(rank, full, tuple(map(float, values)), distance, gap)


def _characteristic_length(equation: VelocityEquation, point: Floats) -> float:
    """The root mean square distance of the named points from their centre; 1 without points."""
    import numpy as np

    places = np.array([[_value(p, point) for p in v] for v in equation.space.points.values()])
    if len(places) < 2:
        return 1.0
    spread = float(np.sqrt(((places - places.mean(axis=0)) ** 2).sum(axis=1).mean()))
    return spread if spread > 1e-9 else 1.0


def _value(polynomial: Any, point: Sequence[float] | Floats) -> float:
    return float(polynomial.evaluate(list(map(float, point))))


def _joint_values(equation: VelocityEquation, point: Floats) -> dict[str, float]:
    import math

    found = {}
    for name, joint in equation.values.items():
        if joint.length is not None:
            found[name] = _value(joint.length, point)
        elif joint.square is not None:
            found[name] = math.sqrt(max(0.0, _value(joint.square, point)))
        elif joint.cosine is not None and joint.sine is not None:
            found[name] = math.atan2(_value(joint.sine, point), _value(joint.cosine, point))
    return found


def _remarks(equation: VelocityEquation, located: Located | None, point: Floats) -> list[str]:
    said = []
    if located is not None:
        if located.others and not located.open:
            others = (
                f"{located.others} other configuration{'s fit' if located.others > 1 else ' fits'} as well"
            )
            said.append(f"{others}: give more values to tell them apart")
        if located.open:
            freedoms = f"{located.open} freedom{'s' if located.open > 1 else ''}"
            said.append(f"the given values leave {freedoms}: one of many configurations is shown")
        if located.misfit > 1e-2 * size(equation):
            said.append(f"no configuration is nearer than {located.misfit:.2g} to the given values")
    if not is_feasible(equation, point):
        said.append("the configuration is outside the feasible set (limits or exclusions)")
    return said
