"""Bounds of a real dimension from above, where one is known from below: the order in which they are tried.

Source: singsym's own; what is exact comes before what rests on primes, and fewer equations before all.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from singsym.classes.realisation.dimension_bounds import bound_above, is_bounded
from singsym.classes.realisation.local_coordinates import are_missed
from singsym.classes.strata.occurrence import restricted
from singsym.classes.strata.patches import Patch, unsplit
from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Known
from singsym.kinematics.placement import JointValue
from singsym.polynomials import Equations
from singsym.polynomials.unit_circles import Pair
from singsym.varieties.real.dimension.fewer_equations import fewer_equations
from singsym.varieties.real.dimension.independent_coordinates import are_dependent
from singsym.varieties.real.modules.dimension import dimension_bound, is_dimension_at_most
from singsym.varieties.real.proofs.vector_charts import Cartesian
from singsym.varieties.real.system import RealSystem


def upper_bound(
    system: RealSystem,
    dimension: int,
    feasible: RealSystem,
    circles: Iterable[Pair] = (),
    coordinates: Sequence[JointValue] = (),
) -> Known[int] | None:
    """A bound of the dimension of a set in the feasible one, where `dimension` is seen to be one; else None.

    circles: variables that are cosine and sine of an angle; coordinates: local ones of the space wherever
    the set has a larger dimension (see `local_coordinates`).

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> anywhere = RealSystem(x.ring, ())
    >>> points = replace(anywhere, equations=(z, x * y - z, x**3 + y**5 + 7 * x - y + z - 1))
    >>> upper_bound(points, 1, anywhere)
    Known(value=1, certainty='proven')
    """
    few: Equations | None = None
    if not coordinates:
        few = fewer_equations(replace(feasible, equations=system.closed_equations), dimension)
    some = None if few is None else replace(feasible, equations=few)
    if some is not None and (found := _proven(some, dimension)) is not None:
        return found
    if (found := _proven(system, dimension, dyads=True)) is not None:
        return found
    if coordinates:
        with attempt("a bound of a dimension", patience.BOUND_BY_JOINTS.work):
            missed = are_missed(system.closed_equations, coordinates)
            if missed.is_yes:
                return Known(dimension, missed.certainty)
    for part in (system,) if some is None else (some, system):
        with attempt("a bound of a dimension", patience.BOUND_BY_VALUES.work):
            dependent = are_dependent(part, dimension, circles)
            if dependent.is_yes:
                return Known(dimension, dependent.certainty)
    chart, beside = charted(system, unsplit(system.closed_equations, system.ring))
    return bound_above(chart.system, dimension, beside)


def _proven(system: RealSystem, dimension: int, *, dyads: bool = False) -> Known[int] | None:
    """A bound by exact algebra, as variables are eliminated; dyads: also off dyads, which may take long."""
    by_modules = dimension_bound(system.closed_equations)
    if by_modules is not None and by_modules.value <= dimension:
        return by_modules
    if dyads:
        over_core = is_dimension_at_most(system.closed_equations, system.nonzero, dimension)
        if over_core.value:
            return Known(dimension, over_core.certainty)
    chart, beside = charted(system, unsplit(system.closed_equations, system.ring))
    return Known(dimension) if is_bounded(chart.system, dimension, beside) else None


def charted(system: RealSystem, patch: Patch) -> tuple[Cartesian, int]:
    """A set on a patch in few variables, and how many of the ring's it leaves free there."""
    chart = Cartesian.of(restricted(system, patch))
    return chart, len(patch.solved) + chart.left_out
