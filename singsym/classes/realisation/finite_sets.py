"""The points of strata that are finitely many, over C or only over R.

Source: the ways of `varieties.real.points` and `varieties.real.modules`; singsym's own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import replace
from functools import partial

from singsym.classes.realisation.dimension_bounds import points_off_exclusions
from singsym.classes.strata.branches import Found
from singsym.classes.strata.reflections import IDENTITY
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Known, weakest
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Equations
from singsym.varieties.real.modules.isolated_points import tangencies
from singsym.varieties.real.modules.module_points import comes_apart, module_points
from singsym.varieties.real.points.boxed_point import BoxPoint
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.system import RealSystem

CertifiedPoints = tuple[RealPoint | BoxPoint, ...]


def finitely_many(system: RealSystem, found: Found) -> Known[CertifiedPoints] | None:
    """All points of a set: by modules, exactly, or off the exclusions where there are too many on them.

    None where they are not found, or cannot be told from those of an image.
    """
    equations, images = system.closed_equations, found.images
    ways: list[tuple[Callable[[], Known[CertifiedPoints]], float]] = [
        (partial(real_points, Ideal(system.ring, equations)), 1 / 3)
    ]
    if equations and comes_apart(equations):
        ways.insert(0, (partial(module_points, equations), 1 / 2))
    if system.exclusions:
        ways.append((partial(points_off_exclusions, system), 1 / 3))
    for zeros, share in ways:
        with suppress(NotZeroDimensional), attempt("finitely many points", share=share):
            points = zeros().map(lambda own: admitted(own, system, found.stratum.elsewhere))
            boxed = [p for p in points.value if isinstance(p, BoxPoint)]
            mirrored = [p.reflect(r) for r in images if r != IDENTITY for p in boxed]
            [p.coincides(q) for p in mirrored for q in boxed]
            return points
    return None


def admitted(
    solutions: Iterable[RealPoint | BoxPoint], system: RealSystem, elsewhere: tuple[Equations, ...]
) -> CertifiedPoints:
    """The solutions of the equations that are points of the set, and not elsewhere."""
    return tuple(p for p in solutions if system.admits(p) and not _lies_in(p, elsewhere))


def isolated_points(system: RealSystem, found: Found) -> Known[CertifiedPoints] | None:
    """All points of a set that is of a larger dimension over C alone; None where that is not seen."""
    touched = tangencies(system.closed_equations)
    if touched is None or not touched.value:
        return None
    if any(p.is_constant for p in touched.value):
        return Known((), touched.certainty)
    points = finitely_many(replace(system, equations=(*system.equations, *touched.value)), found)
    return None if points is None else Known(points.value, weakest(points.certainty, touched.certainty))


def _lies_in(point: RealPoint | BoxPoint, loci: tuple[Equations, ...]) -> bool:
    return any(all(point.sign(p) == 0 for p in locus) for locus in loci)
