"""A real dimension between two bounds: from below at a certified point, from above for the whole set.

Lemma 1.  Where all equations have independent gradients at a real point, the real zeros are a manifold near
it, of dimension the number of variables less that of equations.
Lemma 2.  A subset given by more equations, and of a larger dimension, bounds the dimension from below.
Lemma 3.  The real dimension is not above the complex one of the equations, nor what `elimination_towers`
proves.
Source: Bochnak, Coste, Roy, Real Algebraic Geometry (1998), 2.8 and 3.3.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from singsym.classes.strata.patches import patches, unsplit
from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import current
from singsym.effort.verdict import Known, Verdict
from singsym.elimination.elimination_orders import without_zeros_of
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import remember
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.dimension.elimination_towers import is_dimension_at_most
from singsym.varieties.real.dimension.hyperplane_cuts import seems_at_most
from singsym.varieties.real.dimension.real_dimension import independent
from singsym.varieties.real.numerical.sampling import is_large, numerical_points
from singsym.varieties.real.points.certified_point import Witness, find_witness
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.proofs.critical_points import dropped
from singsym.varieties.real.system import RealSystem

POINTS = 40
"""So many numerical points are looked at for parts of a larger dimension."""
LARGEST_DENOMINATOR = 360
_CONSTANT, _NEAR = 1e-6, 1e-7


def off_borders(system: RealSystem) -> RealSystem:
    """The part of a set where no inequality is an equality, but for those that are so on all of it.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> half = off_borders(RealSystem(x.ring, (y,), nonnegative=(x - 1, y)))
    >>> half.positive, half.nonnegative
    ((x - 1,), ())
    """
    restrict = unsplit(system.closed_equations, system.ring).restrict
    strict = tuple(p for p in system.nonnegative if restrict(p))
    return replace(system, positive=(*system.positive, *strict), nonnegative=())


def bound_above(system: RealSystem, dimension: int, beside: int = 0) -> Known[int] | None:
    """A bound of the real dimension where `dimension` is one, as far as is seen in time; else None.

    beside: how many of the ring's variables are in no equation and do not count.
    Certainty "modular": it rests on random hyperplanes that meet no zero modulo random primes.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y", "z"))
    >>> x, y, z = R.gens
    >>> axes = RealSystem(R, (x * y, x * z))
    >>> bound_above(axes, 1), bound_above(axes, 2)
    (None, Known(value=2, certainty='proven'))
    """
    ring, equations = system.ring, system.closed_equations
    seems: Verdict | None = None
    with attempt("a bound of a dimension", patience.BOUND_BY_HYPERPLANES.work):
        seems = seems_at_most(ring, equations, dimension + beside)
        if not seems.is_yes and system.exclusions:
            seems = seems_at_most(*_off_exclusions(system), dimension + beside)
    if seems is not None and not seems.is_yes:
        return None
    with attempt("a proof of a bound", patience.BOUND_PROOF.work):
        found = Ideal(ring, equations).dimension
        if found.value - beside <= dimension and (found.is_proven or seems is None):
            return Known(dimension, found.certainty)
    return None if seems is None else Known(dimension, seems.certainty)


def is_bounded(system: RealSystem, dimension: int, beside: int = 0) -> bool:
    """Whether a bound is proven by eliminating variables in turn, which is quick where it comes to an end."""
    with attempt("a bound of a dimension", patience.BOUND_BY_TOWERS.work):
        given = system.ring, system.closed_equations, tuple(system.nonzero), dimension + beside
        return remember("a bound by elimination", given, lambda: is_dimension_at_most(*given))
    return False


def points_off_exclusions(system: RealSystem) -> Known[tuple[RealPoint, ...]]:
    """All real zeros of the equations off the exclusions, where there are finitely many complex ones.

    Raises `NotZeroDimensional` where there are not.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> points_off_exclusions(RealSystem(R, (x * y, y**2 - y), exclusions=((y,),))).value
    (RealPoint(x=0, y=1),)
    """
    ring, equations = _off_exclusions(system)
    points = real_points(Ideal(ring, equations))
    return points.map(lambda found: tuple(dropped(point, system.ring) for point in found))


def _off_exclusions(system: RealSystem) -> tuple[Ring, tuple[Polynomial, ...]]:
    """The equations with a variable for the inverse of each exclusion's sum of squares (Rabinowitsch)."""
    return without_zeros_of(system.ring, system.closed_equations, *system.exclusion_polynomials)


def larger_parts(system: RealSystem, dimension: int) -> Iterator[tuple[int, Witness]]:
    """Certified points at which a set has a larger dimension, guessed from numerical ones; maybe none.

    At a numerical point with more independent tangents some coordinates may be constant along all of them;
    with these at the rationals that they seem to have, the set is smaller and simpler (lemma 2).

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y", "z"))
    >>> x, y, z = R.gens
    >>> [d for d, _ in larger_parts(RealSystem(R, (x * y, x * z)), 1)]
    [2]
    """
    import numpy as np

    from singsym.polynomials.compiled_map import CompiledMap

    ring, equations = system.ring, system.closed_equations
    compiled = CompiledMap.balanced(equations, ring)
    fixed = {c.name for c in ring.constants}
    tried: set[tuple[Polynomial, ...]] = set()
    for point in numerical_points(system, POINTS):
        current().check("parts of a larger dimension")
        slopes = compiled.jacobian(np.array(point))
        rank = numerical_rank(slopes, 1e-7).rank
        if len(ring.names) - rank <= dimension:
            continue
        _, _, right = np.linalg.svd(slopes, full_matrices=True)
        moving = np.abs(right[rank:]).max(axis=0)
        values = {
            name: Fraction(x).limit_denominator(LARGEST_DENOMINATOR)
            for name, x, speed in zip(ring.names, point, moving, strict=True)
            if speed < _CONSTANT and name not in fixed
        }
        held = {name: v for name, v in values.items() if abs(float(v) - point[ring.index(name)]) < _NEAR}
        if not held:
            continue
        for smaller in _held(system, held, point):
            size = len(ring.names) - len(smaller)
            if smaller in tried or size <= dimension:
                continue
            tried.add(smaller)
            witness = find_witness(replace(system, equations=smaller), tries=8, dimension=size, near=[point])
            if witness is not None and independent(smaller, witness.point):
                dimension = size
                yield size, witness


def _held(
    system: RealSystem, values: dict[str, Fraction], point: tuple[float, ...]
) -> Iterator[tuple[Polynomial, ...]]:
    """The equations with some coordinates at rationals, taken apart; the parts on which a point is."""
    ring = system.ring
    held = [ring.gen(name) * v.denominator - v.numerator for name, v in values.items()]
    for patch in patches((*system.closed_equations, *held), system.nonzero, ring):
        if not any(is_large(p, (point,)) for p in patch.generators):
            yield patch.generators
