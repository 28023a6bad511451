"""All real points of a square system, module by module.

Source: the block triangular form; first modules by exact algebra in their own rings, the others in balls, and
a Krawczyk test of the whole system for each point at the end.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from math import prod

from flint import arb

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Known, Premises
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.elimination.memo import remember
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.polynomials.block_form import BlockForm, Module, block_form
from singsym.varieties.real.modules.assemblies import assemblies, is_simple
from singsym.varieties.real.modules.lifted_curve import is_tower, points_on_tower
from singsym.varieties.real.points.boxed_point import BoxPoint, boxed_point
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.points.intervals import at_precision, exact_bounds

PRECISIONS = (256, 1024)
"""Bits of the balls of a first module, tried in turn where something is not seen."""

MOST_SOLUTIONS = 1000
"""A first module with a larger bound of Bezout is not solved by algebra where it is a tower."""


def module_points(equations: Equations) -> Known[tuple[BoxPoint, ...]]:
    """All real points of equations that come apart into modules, each certified; none has a multiplicity.

    The certainty is that of there being no others.

    Lemma: the real points of all equations are those of the first modules with, over each, the assemblies of
    the next module, and so on; equations that are left over hold at them or not.
    Raises `Undecided` where a module is neither first nor simple, or where balls leave a number open, as they
    do at points with a multiplicity.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> [p.decimals(4)["z"] for p in module_points((x**2 - 3, y * x - 1, y**2 + z**2 - 1)).value]
    ['-0.8165', '0.8165', '-0.8165', '0.8165']
    """
    key = (equations[0].ring, equations)
    return remember("points by modules", key, lambda: _points(equations))


def comes_apart(equations: Equations) -> bool:
    """Whether no module needs all variables at once.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> comes_apart((x**2 - 2, y - x)), comes_apart((x**2 - y, y**2 + x))
    (True, False)
    """
    whole = len(equations[0].ring.names)
    return all(len(m.unknowns) < whole for m in block_form(equations).modules)


def _points(equations: Equations) -> Known[tuple[BoxPoint, ...]]:
    ring = equations[0].ring
    form = block_form(equations)
    if sum(len(m.unknowns) for m in form.modules) < len(ring.names):
        raise Undecided("there are fewer equations than unknowns")
    hard = [m for m in form.modules if not _is_first(m, ring) and not is_simple(m)]
    if hard:
        raise Undecided(f"a module with unknowns {', '.join(hard[0].unknowns)} is not simple")
    premises = Premises()
    first = {m: premises.take(_exact(m, ring)) for m in form.modules if _is_first(m, ring)}
    failure = Undecided("no precision was tried")
    for bits in PRECISIONS:
        try:
            with at_precision(bits):
                return premises.conclude(tuple(_certified(form, ring, first, bits)))
        except Undecided as reason:
            current().check("points by modules")
            failure = reason
    raise failure


def _is_first(module: Module, ring: Ring) -> bool:
    """Whether a module stands by itself, fixed numbers aside."""
    return set(module.parents) <= {c.name for c in ring.constants}


def _exact(module: Module, ring: Ring) -> Known[tuple[BoxPoint, ...]]:
    """All real points of a first module, with the fixed numbers in it, in boxes that are quick to refine."""
    names = {*module.unknowns, *module.parents}
    own = ring.with_names(tuple(n for n in ring.names if n in names))
    equations = tuple(dict.fromkeys((*map(own.convert, module.equations), *own.relations)))
    if prod(p.total_degree for p in equations) > MOST_SOLUTIONS and is_tower(equations):
        return Known(points_on_tower(equations, current()))
    with attempt("the points of a module by algebra", patience.FIRST_MODULE.work):
        try:
            points = real_points(equations)
            return points.map(lambda found: tuple(_boxed(point, equations) for point in found))
        except NotZeroDimensional as reason:
            raise Undecided(f"a module by itself: {reason}") from None
    return Known(points_on_tower(equations, current()))


def _boxed(point: RealPoint, equations: Equations) -> BoxPoint:
    found = boxed_point(point.ring, equations, {}, point.floats)
    if found is None or not all(b.contains(a) for a, b in zip(point.refine(96).box, found.box, strict=True)):
        raise Undecided("the Krawczyk test fails at a point of a first module")
    return found


def _certified(
    form: BlockForm, ring: Ring, first: Mapping[Module, Sequence[BoxPoint]], bits: int
) -> Iterator[BoxPoint]:
    equations = tuple(p for m in form.modules for p in m.equations)
    for values in _values(form.modules, first, bits):
        current().check("points by modules")
        balls = [values[name] for name in ring.names]
        if not _may_hold(form.left_over, balls):
            continue
        middles = [sum(exact_bounds(b)) / 2 for b in balls]
        point = boxed_point(ring, equations, {}, middles)
        if point is None or not all(b.contains(a) for a, b in zip(balls, point.box, strict=True)):
            raise Undecided("the Krawczyk test fails at a point found by modules")
        if all(point.sign(p) == 0 for p in form.left_over):
            yield point


def _may_hold(equations: Sequence[Polynomial], balls: Sequence[arb]) -> bool:
    return all(p.evaluate(list(balls)).contains(0) for p in equations)


def _values(
    modules: Sequence[Module], first: Mapping[Module, Sequence[BoxPoint]], bits: int
) -> Iterator[dict[str, arb]]:
    """The values of all unknowns at all points, in balls."""
    starts = [_balls(points, bits) for points in first.values()]
    later = [m for m in modules if m not in first]
    for combination in product(*starts):
        # fixed numbers have the same values in all modules
        yield from _extended(later, {name: ball for part in combination for name, ball in part.items()})


def _balls(points: Sequence[BoxPoint], bits: int) -> list[dict[str, arb]]:
    return [dict(zip(p.ring.names, p.refine(bits).box, strict=True)) for p in points]


def _extended(modules: Sequence[Module], known: dict[str, arb]) -> Iterator[dict[str, arb]]:
    if not modules:
        yield known
        return
    for found in assemblies(modules[0], known):
        yield from _extended(modules[1:], {**known, **found})
