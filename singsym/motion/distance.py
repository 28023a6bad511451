"""How far a configuration is from the nearest singularity of each type, in joint space and in the output.

Source: the nearest points are constrained least squares, Nocedal, Wright, Numerical Optimization (2006),
chapter 18; bounds from above are certified points, bounds from below the Krawczyk test over a box of inputs.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import arb

from singsym.classes.configuration.at import Analysis
from singsym.classes.configuration.locate import sizes_of_coordinates
from singsym.classes.taxonomy.types import Defects, SingularityType
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.arithmetic import Arithmetic
from singsym.motion.coordinates import Coordinates, joint_space, output_space
from singsym.motion.drives import driven_system
from singsym.motion.enclosures import (
    BITS,
    Sheet,
    certified_defects,
    is_surely_regular,
    point_on,
)
from singsym.motion.loci import SingularLocus, determinant_factors, singular_loci, unwritten
from singsym.motion.newton import Newton
from singsym.motion.numeric import NumericLinkage, numeric_equation
from singsym.polynomials.compiled_map import CompiledMap, Floats
from singsym.polynomials.gauss_newton import Restricted, gauss_newton
from singsym.varieties.real.points.intervals import at_precision

_SPREADS = (0.0, *(0.1, 0.3, 1.0) * 5)
"""Of the starts about the configuration, over the sizes of the variables."""
_DESCENTS = 5
_STEPS = 120
_SHORTER, _SMALL = 1e-12, 1e-9
_LINE = 60
"""Steps on the straight line to a singularity, by which it is seen to be on the same sheet."""
_BISECTIONS = 40
_SHARPER = 5


@dataclass(frozen=True)
class NearSingularity:
    """A singular configuration, and how far away it is.

    types: certified where `types_certified`, else by numerical ranks.
    distance: in the units of `SingularityDistance`; certified: a proven bound from above, for a singular
    configuration is in so near a place; else found numerically.
    away: the direction in which the distance grows fastest, a unit vector by label.
    """

    types: SingularityType
    types_certified: bool
    words: str
    distance: float
    certified: bool
    values: Mapping[str, float]
    points: Mapping[str, tuple[float, ...]]
    joints: Mapping[str, float]
    away: Mapping[str, float]


@dataclass(frozen=True)
class SingularityDistance:
    """Distances from one configuration.

    joint: for each type that was found the nearest singularity, by the values of the inputs: radians, and
    lengths over `length`; output: the same by the output's coordinates, in the mechanism's unit and radians;
    empty where the output has none, as rotations of a link.
    clear: proven: no singularity is reached while the inputs keep nearer than this; None where no proof was
    found.
    condition_numbers: of L_I, L_O and L_p in pure numbers, lengths over `length`: largest over smallest
    singular value, infinite where the rank is low.
    remarks: what was not looked at.
    """

    joint: Mapping[str, NearSingularity]
    output: Mapping[str, NearSingularity]
    clear: float | None
    length: float
    condition_numbers: Mapping[str, float]
    remarks: tuple[str, ...]


def singularity_distance(found: Analysis, *, seed: int = 0) -> SingularityDistance:
    """The distances of a configuration that `at` has examined.

    The nearest singularities are looked for numerically, among those that a straight line of the inputs, or
    of the outputs, reaches on the configuration's own sheet; a nearer one may be missed, but none is nearer
    than `clear`.  Joint limits are not regarded.  Raises `MechanismError` where the conditions are not
    written out or the values of the inputs are not known.

    >>> from singsym.classes.configuration.at import at
    >>> from singsym.mechanism import load
    >>> crank = load("slider-crank")
    >>> given = {"joints": {"A": "60 deg", "P": "(1 + sqrt(33)) / 2"}}
    >>> there = singularity_distance(at(crank, given))
    >>> round(there.joint["RI"].distance, 6), there.joint["RI"].certified, there.clear > 0.1
    (1.047198, True, True)
    """
    equation = found.equation
    joint = joint_space(equation, found.length)
    loci = tuple(singular_loci(equation))
    if joint is None or not loci:
        given = "inputs without known values" if joint is None else "conditions that are not written out"
        expected = "inputs whose values are coordinates, and conditions as polynomials"
        raise MechanismError([Problem("distance", given, expected)])
    output = output_space(equation)
    point = np.array([float(found.values[name]) for name in equation.space.ring.names])
    nearest = {}
    for name, space in (("joint", joint), ("output", output)):
        nearest[name] = {} if space is None else _nearest(equation, space, loci, point, seed)
    remarks = [
        f"condition ({label}) is not written out: its singularities are not looked for here"
        for label in unwritten(equation)
    ]
    if output is None:
        remarks.append("the output has rotations of a link: no distances in the output")
    numbers = {
        name: _condition(m.singular_values, m.full) for name, m in found.matrices.items() if name != "L"
    }
    most = min((near.distance for near in nearest["joint"].values()), default=np.pi / 2)
    clear = clear_radius(equation, joint, point, most)
    return SingularityDistance(
        nearest["joint"], nearest["output"], clear, found.length, numbers, tuple(remarks)
    )


def _condition(values: Sequence[float], full: int) -> float:
    if not full or len(values) < full:
        return float("inf") if full else 1.0
    return values[0] / values[full - 1] if values[full - 1] else float("inf")


# -- from below --------------------------------------------------------------------------------------


def clear_radius(equation: VelocityEquation, joint: Coordinates, point: Floats, most: float) -> float | None:
    """A proven bound: no singularity on the sheet of a configuration while the inputs keep nearer than this.

    joint: the space of the inputs; point: the configuration, regular, as near as doubles are; most: where to
    begin.  None where no box is proven.
    """
    sheet = Sheet(equation, driven_system(equation, joint.labels))
    conditions = determinant_factors(equation)
    middle = joint.at(point)[0] * np.array(joint.units)

    def proven(radius: float) -> bool:
        with at_precision(BITS):
            values = {
                label: arb(x, radius * unit)
                for label, x, unit in zip(joint.labels, middle.tolist(), joint.units, strict=True)
            }
        found = sheet.over(values, point)
        return found is not None and is_surely_regular(equation, conditions, found)

    low, high = 0.0, most
    radius = most
    for _ in range(_BISECTIONS):
        if proven(radius):
            low = radius
            break
        high, radius = radius, radius / 1.6
    else:
        return None
    for _ in range(_SHARPER):
        radius = (low + high) / 2
        low, high = (radius, high) if proven(radius) else (low, radius)
    return low


# -- from above --------------------------------------------------------------------------------------


def _nearest(
    equation: VelocityEquation,
    space: Coordinates,
    loci: Sequence[SingularLocus],
    point: Floats,
    seed: int,
) -> dict[str, NearSingularity]:
    """By type, the nearest singularity found on any locus."""
    search = _Search(equation, space, point)
    found: dict[str, NearSingularity] = {}
    for locus in loci:
        for end in search.ends(locus, seed):
            near = search.described(locus, end)
            for kind in near.types.names:
                if kind not in found or near.distance < found[kind].distance:
                    found[kind] = near
            break
    return {kind: found[kind] for kind in (t.name or "" for t in SingularityType) if kind in found}


class _Search:
    """Nearest points of loci to one configuration in one space."""

    def __init__(self, equation: VelocityEquation, space: Coordinates, point: Floats) -> None:
        self.equation, self.space, self.point = equation, space, point
        self.here = space.at(point)[0]
        self.sizes = sizes_of_coordinates(equation)
        ring = equation.space.ring
        fixed = {ring.index(c.name) for c in ring.constants}
        self.free = [k for k in range(len(ring.names)) if k not in fixed]

    def ends(self, locus: SingularLocus, seed: int) -> Iterator[Floats]:
        """Points of a locus where the distance is least, reached on a straight line; nearest first."""
        system = self._system(locus)
        random = np.random.default_rng(seed)
        landed = []
        for spread in _SPREADS:
            start = self.point.copy()
            start[self.free] += spread * random.normal(size=len(self.free)) * self.sizes[self.free]
            end = self._projected(system, start)
            if end is not None:
                landed.append((self.distance(end), end))
        landed.sort(key=lambda pair: pair[0])
        ends: list[Floats] = []
        for _, start in landed[:_DESCENTS]:
            end = self._descended(system, start)
            if all(np.abs((end - other) / self.sizes).max() > 1e-5 for other in ends):
                ends.append(end)
        for end in sorted(ends, key=self.distance):
            if self._is_reached(system, end):
                yield end

    def distance(self, point: Floats) -> float:
        """From the configuration, in the space's units."""
        return float(np.linalg.norm(self._change(point)))

    def _change(self, point: Floats) -> Floats:
        return self.space.difference(self.space.at(point)[0], self.here)

    def _system(self, locus: SingularLocus) -> CompiledMap:
        ring = self.equation.space.ring
        equations = (*self.equation.space.equations, *locus.polynomials)
        return CompiledMap.balanced(equations, ring, self.sizes.tolist())

    def _projected(self, system: CompiledMap, start: Floats) -> Floats | None:
        restricted = Restricted(system, start, self.free)
        found = gauss_newton(restricted, start[self.free], cut=_SMALL)
        return None if found is None else restricted.filled(found)

    def _descended(self, system: CompiledMap, point: Floats) -> Floats:
        """Where the distance does not fall any more on the locus, by Gauss-Newton steps along it."""
        length = 1.0
        for _ in range(_STEPS):
            along = self._tangents(system, point)
            if not along.shape[1]:
                break
            change = self._change(point)
            slopes = (self.space.at(point)[1] * self.sizes)[:, self.free] @ along
            step = along @ np.linalg.lstsq(slopes, -change, rcond=_SMALL)[0]
            trial = point.copy()
            trial[self.free] += min(1.0, length / (np.linalg.norm(step) or 1.0)) * (
                step * self.sizes[self.free]
            )
            landed = self._projected(system, trial)
            if landed is not None and self.distance(landed) < self.distance(point):
                gain = self.distance(point) - self.distance(landed)
                point, length = landed, min(1.0, 2 * length)
                if gain < _SHORTER * self.distance(point):
                    break
            else:
                length = min(length, float(np.linalg.norm(step))) / 4
                if length < _SMALL:
                    break
        return point

    def _tangents(self, system: CompiledMap, point: Floats) -> Floats:
        """An orthonormal basis, in variables over their sizes, of what leads along the locus."""
        slopes = (system.jacobian(point) * self.sizes)[:, self.free]
        _, values, right = np.linalg.svd(slopes)
        rank = int((values > 1e-7 * values.max(initial=0.0)).sum())
        return np.asarray(right[rank:].T)

    def _is_reached(self, system: CompiledMap, end: Floats) -> bool:
        """Whether the straight line of the values leads there on the sheet of the configuration.

        It is followed nearly to the end, where the sheet may fold; the locus next to that point is the end.
        """
        own = dict(zip(self.space.labels, self.space.values, strict=True))
        driven = driven_system(self.equation, self.space.labels, own)
        newton = Newton(driven, Arithmetic())
        units, change, point = np.array(self.space.units), self._change(end), self.point
        for share in np.linspace(0, 1, _LINE)[1:-1]:
            values = (self.here + share * change) * units
            given = {label: np.array(x) for label, x in zip(self.space.labels, values, strict=True)}
            point = newton.onto(given, point)
            if not np.isfinite(point).all():
                return False
        landed = self._projected(system, point)
        if landed is None:
            return False
        back = self._descended(system, landed)
        return abs(self.distance(back) - self.distance(end)) < 1e-4 * self.distance(end) + _SMALL

    @cached_property
    def _numbers(self) -> NumericLinkage:
        return numeric_equation(self.equation)

    def described(self, locus: SingularLocus, end: Floats) -> NearSingularity:
        """What is known of a singular configuration."""
        boxed = point_on(self.equation, locus.polynomials, end)
        distance, defects = self.distance(end), None
        if boxed is not None:
            with at_precision(BITS):
                from_above = self.space.farthest(boxed.box, self.here)
            if np.isfinite(from_above):
                distance = float(np.nextafter(from_above, np.inf))
            else:
                boxed = None
        if boxed is not None:
            defects = certified_defects(self.equation, boxed.box, locus.bounds)
        types = (defects or self._seen(end)).types
        change = self._change(end)
        length = float(np.linalg.norm(change)) or 1.0
        linkage = self._numbers
        return NearSingularity(
            types,
            defects is not None,
            locus.words,
            distance,
            boxed is not None,
            dict(zip(linkage.names, end.tolist(), strict=True)),
            {name: tuple(place.tolist()) for name, place in linkage.points(end).items()},
            {name: float(value) for name, value in linkage.joints(end).items()},
            dict(zip(self.space.labels, (-change / length).tolist(), strict=True)),
        )

    def _seen(self, end: Floats) -> Defects:
        """By numerical ranks."""
        ranks = {name: int(rank) for name, rank in self._numbers.ranks(end, 1e-6).items()}
        equation = self.equation
        return Defects.of_ranks(ranks["L"], ranks["L_I"], ranks["L_O"], ranks["L_p"], equation.N, equation.n)
