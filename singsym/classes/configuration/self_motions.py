"""Self-motions through a configuration: whether a null motion is finite, the inputs or outputs at rest.

Source: the fibre of the inputs, or outputs, as functions of the configuration: to second order as Connelly,
Whiteley, SIAM J. Discrete Math. 9 (1996) 453-491, else its components through the point.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from singsym.classes.classify import Limits
from singsym.classes.configuration.at import at_equation
from singsym.classes.configuration.exact_configuration import ExactPoint, exact_values
from singsym.classes.configuration.given_values import Given, targets
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Certainty, Known, Premises
from singsym.kinematics.placement import JointValue
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism.model import Mechanism
from singsym.polynomials import Equations
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.purity import PurePiece
from singsym.varieties.real.curves.real_curve import CurveComponent, real_curve
from singsym.varieties.real.dimension.real_dimension import local_dimension
from singsym.varieties.real.points.exact_point import RealPoint


@dataclass(frozen=True)
class SelfMotion:
    """What is possible from a configuration while the inputs, or the outputs, keep their values.

    held: "inputs" or "outputs".
    null_motions: how many independent ones there are, exact; None where the configuration is not exact.
    dimension: of the configurations with the same values near this one, as a real set: 0, it is the only one,
        and null motions are infinitesimal; 1, they form a curve.  None where undecided, as `reason` says.
    certainty: of the dimension.
    curve: where the dimension is 1, all of the connected curve of such configurations through this one, with
        polylines; limits and exclusions are not looked at, so that a motion may end before; None where it was
        not proven, as `untraced` says.
    equation, point: where the variables of the curve are named, and their values in the configuration, in
        floats.
    """

    held: str
    null_motions: int | None
    dimension: int | None
    certainty: Certainty
    reason: str = ""
    curve: Known[CurveComponent] | None = None
    untraced: str = ""
    equation: VelocityEquation | None = field(default=None, repr=False, compare=False)
    point: Mapping[str, float] = field(default_factory=dict, repr=False, compare=False)

    def __str__(self) -> str:
        """In words."""
        rest = f"the {self.held} at rest"
        if self.dimension is None:
            return f"undecided, with {rest}: {self.reason}"
        if not self.null_motions:
            return f"none with {rest}: there is no null motion"
        if self.dimension == 0:
            return f"none with {rest}: null motions are infinitesimal only, the configuration is isolated"
        size = "a curve" if self.dimension == 1 else f"a set of dimension {self.dimension}"
        return f"finite with {rest}: {size} of configurations through this one"


def self_motions(
    mechanism: Mechanism, given: Given | Mapping[str, Any], *, formulation: str = "auto", file: str = ""
) -> tuple[SelfMotion, SelfMotion]:
    """With the inputs at rest, and with the outputs at rest, from the configuration with these values.

    given: as for `at`; the answer needs values that satisfy the loop equations exactly.  The mechanism may be
    redundant.  Limits and exclusions are not looked at.  Raises `MechanismError` as `at` does.

    >>> from singsym.mechanism import load
    >>> flat = {"points": {"B": ["3/2", "sqrt(7)/2"], "D": ["3/2", "sqrt(7)/2"], "C": ["9/2", "sqrt(7)/2"]}}
    >>> mine = load("five-bar").with_parameters(d=3)
    >>> [(m.held, m.null_motions, m.dimension) for m in self_motions(mine, flat)]
    [('inputs', 1, 1), ('outputs', 0, 0)]
    """
    return self_motions_equation(velocity_equation(mechanism, formulation), given, file=file)


def self_motions_equation(
    equation: VelocityEquation, given: Given | Mapping[str, Any], *, file: str = ""
) -> tuple[SelfMotion, SelfMotion]:
    """The same for a velocity equation."""
    read = given if isinstance(given, Given) else Given.of(given, file)
    values = exact_values(equation, targets(read, equation, file))
    point = None if values is None else ExactPoint.of(equation, values)
    if values is None or point is None:
        at_equation(equation, read, file=file)
        reason = "the values are not exactly those of a configuration; write them as 30 deg or sqrt(3)/2"
        inputs, outputs = (SelfMotion(h, None, None, "undecided", reason) for h in ("inputs", "outputs"))
        return inputs, outputs
    driven = [(c.label, equation.values.get(c.label)) for c in equation.columns if c.role == "input"]
    place = {name: float(value) for name, value in values.items()}
    inputs, outputs = _fibre(point, "inputs", driven), _fibre(point, "outputs", equation.outputs)
    return replace(inputs, equation=equation, point=place), replace(outputs, equation=equation, point=place)


def _fibre(point: ExactPoint, held: str, values: Sequence[tuple[str, JointValue | None]]) -> SelfMotion:
    """The dimension at a point of the configurations with its values."""
    equation, ring = point.equation, point.real_point.ring
    unknown = [label for label, value in values if value is None]
    if unknown or not values:
        which = ", ".join(unknown) or f"the {held}"
        return SelfMotion(held, None, None, "undecided", f"there is no coordinate for {which}")
    names = equation.space.variables
    loops = [ring.convert(e) for e in equation.space.equations if {*e.variables} & {*names}]
    fixed = [_kept(point, value) for _, value in values if value is not None]
    null_motions, dimension = second_order(point, (*loops, *(own[0] for own in fixed)), names)
    equations = tuple(dict.fromkeys((*loops, *ring.relations, *(e for own in fixed for e in own))))
    if dimension is not None:
        return _traced(SelfMotion(held, null_motions, dimension, "proven"), point.real_point, equations)
    premises, seen = Premises(), [0]
    try:
        with current().part(Limits().seconds, Limits().memory_mb):
            found = premises.take(decompose(equations, ring=ring))
            here = [c for c in found if not any(point.real_point.sign(g) for g in c.generators)]
            seen += [_smooth_dimension(point.real_point, component) for component in here]
    except Undecided as reason:
        return SelfMotion(held, null_motions, None, "undecided", str(reason))
    sized = SelfMotion(held, null_motions, max(seen), premises.certainty)
    return _traced(sized, point.real_point, equations)


def _traced(found: SelfMotion, point: RealPoint, equations: Equations) -> SelfMotion:
    """With the curve of configurations, where they form one."""
    if found.dimension != 1:
        return found
    try:
        with current().part(Limits().seconds, Limits().memory_mb):
            curve = real_curve(equations)
            if curve.verdict.is_undecided:
                return replace(found, untraced=curve.verdict.reason)
            return replace(found, curve=Known(curve.component_of(point), curve.verdict.certainty))
    except (Undecided, ValueError) as reason:
        return replace(found, untraced=str(reason))


def _smooth_dimension(point: RealPoint, component: Component) -> int:
    """The real dimension of a component at a smooth point of it; raises `Undecided` at others."""
    if component.dimension == 0:
        return 0
    found = local_dimension(point, PurePiece.of(component))
    if found is None:
        size = f"of dimension {component.dimension} over the complex numbers"
        raise Undecided(f"a set {size} is not seen to be smooth in the configuration")
    return found


def second_order(point: ExactPoint, equations: Equations, names: Sequence[str]) -> tuple[int, int | None]:
    """The number of null motions of equations at a zero, and the dimension of the zeros there, or None.

    names: of the variables.  Lemma: let the slopes of the equations, times coefficients w, have the sum zero,
    and Q be the same sum of second derivatives, on the null motions.  Where Q is definite the zero is
    isolated; where w is the only one and Q is regular, the zeros are those of Q in some coordinates (Morse).
    """
    slopes = [[point.number(p.derivative(n)) for n in names] for p in equations]
    motions, weights = point.null_space(slopes), point.null_space(list(zip(*slopes, strict=True)))
    if not motions or not weights:
        return len(motions), len(motions)
    for weight in weights:
        form = [[point.numbers.zero] * len(names) for _ in names]
        for w, p in zip(weight, equations, strict=True):
            for i, n in enumerate(names if w else ()):
                for j, m in enumerate(names):
                    form[i][j] += w * point.number(p.derivative(n).derivative(m))
        half = point.product(motions, form)
        signs = _signs(point, point.product(half, list(zip(*motions, strict=True))))
        if signs is not None and len({*signs}) == 1:
            return len(motions), 0
        if signs is not None and len(weights) == 1:
            return len(motions), len(motions) - 1
    return len(motions), None


def _signs(point: ExactPoint, form: Sequence[Sequence[Any]]) -> list[int] | None:
    """Signs of the squares that a regular form is a sum of, both where it is indefinite; None if not seen."""
    rows, found = [list(row) for row in form], []
    for k, row in enumerate(rows):
        sign = point.sign(row[k])
        if not sign:
            return [1, -1] if k == len(rows) - 2 and row[k + 1] else None
        found.append(sign)
        for other in rows[k + 1 :]:
            factor = other[k] / row[k]
            other[:] = [a - factor * b for a, b in zip(other, row, strict=True)]
    return found


def _kept(point: ExactPoint, value: JointValue) -> Equations:
    """What says that a value is the one that it has at a point; the first says so near the point.

    An angle has the same cosine and sine; near by, the same direction.
    """
    wide = point.real_point.ring
    if value.cosine is None or value.sine is None:
        side = value.square if value.length is None else value.length
        return () if side is None else (wide.convert(side) - point.value(side),)
    scale = value.scale if value.scale is not None else point.equation.space.ring.one
    cosine, sine, size = map(wide.convert, (value.cosine, value.sine, scale))
    there, here = point.value(value.cosine), point.value(value.sine)
    own = point.value(scale)
    return (cosine * here - sine * there, cosine * own - size * there, sine * own - size * here)
