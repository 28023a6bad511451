"""Where in the space of parameters a class exists: borders, cells and their tables.

Source: borders as in `designs.borders`; cells as in `designs.line` and `designs.plane`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

import sympy

from singsym.classes.classify import Limits
from singsym.classes.running.runner import running
from singsym.designs.borders import Borders, borders
from singsym.designs.families import Family, family
from singsym.designs.line import Root, roots, samples
from singsym.designs.plane import Arc, Place, Plane, signs
from singsym.designs.real_borders import real_borders
from singsym.designs.result import Cell, Design
from singsym.designs.sampling import at_samples
from singsym.effort import patience
from singsym.effort.budget import Budget
from singsym.effort.progress import Sink, to
from singsym.elimination.ideal import Ideal
from singsym.mechanism.model import Mechanism
from singsym.mechanism.problems import MechanismError, Problem
from singsym.polynomials import Polynomial, Ring

_SEARCH, _BORDERS = 0.3, 0.3
"""Of the clock for the strata, and of what is left then for the borders."""


def design(
    mechanism: Mechanism,
    parameters: Sequence[str],
    *,
    formulation: str = "auto",
    workers: int = 1,
    executor: Executor | None = None,
    limits: Limits | None = None,
    cache: bool = True,
    progress: Sink | None = None,
) -> Design:
    """The values of one or two parameters at which the table of classes changes, and the cells between them.

    parameters: names; their values are taken away, their ranges are kept, all others need a value.
    Each cell has the classification at an exact sample; `Design.is_constant` says of which classes it is
    proven to be that of the whole cell.  limits: of each classification, `seconds` also of each branch of
    the search; `clock` of everything, a good half of it for the samples.  workers, executor, cache, progress:
    as for `classify`.
    Raises `MechanismError` for parameters that are not there, none or more than two, or others without a
    value, and for a mechanism that cannot be placed.

    >>> from singsym.mechanism import load
    >>> found = design(load("fourbar"), ["a"], cache=False)
    >>> [(cell.where, [entry[:4] for entry in cell.entries]) for cell in found.cells[:2]]
    [('0 < a < 5/2', [(1, 'yes', 0, 4)]), ('5/2 < a < 7/2', [(1, 'yes', 0, 2), (2, 'yes', 0, 2)])]
    """
    limits, names = limits or Limits(), tuple(dict.fromkeys(parameters))
    symbolic = mechanism.with_parameters(**dict.fromkeys(names))
    _check(symbolic, names)
    whole = Budget(limits.clock)
    with to(progress):
        with running(workers, executor, limits.clock, cache) as runner:
            searched = Budget(_share(limits.clock, _SEARCH), work=limits.total)
            found = family(symbolic, formulation, runner, seconds=limits.seconds, budget=searched)
            with Budget(_share(whole.time_left(), _BORDERS)):
                border = real_borders(found, borders(found, limits.part(patience.BORDER.work)))
        parts = _line(found, border) if len(names) == 1 else _plane(found, border, (names[0], names[1]))
        samples_in = [cell.sample for cell in (*parts.cells, *parts.values) if not cell.reason]
        rest = replace(limits, clock=whole.time_left())
        tables = iter(at_samples(symbolic, samples_in, formulation, rest, workers, executor, cache))

    def filled(cell: Cell) -> Cell:
        if cell.reason:
            return cell
        table = next(tables)
        return replace(cell, classification=table.classification, reason=table.reason)

    dividing = tuple(part for part in border.parts if part.polynomial in parts.dividing)
    return Design(
        symbolic,
        names,
        border,
        dividing,
        tuple(map(filled, parts.cells)),
        tuple(map(filled, parts.values)),
        parts.plane,
    )


def _share(clock: float | None, part: float) -> float | None:
    return None if clock is None else clock * part


def _check(mechanism: Mechanism, names: tuple[str, ...]) -> None:
    if not 1 <= len(names) <= 2:
        found = ", ".join(names) or "none"
        expected = "one or two parameters; of more, samples: --values, or singsym.sweep"
        raise MechanismError([Problem("parameters", found, expected, file=mechanism.origin)])
    others = [p.name for p in mechanism.parameters if p.value is None and p.name not in names]
    if others:
        expected = "a value, as it is not one of those to be varied"
        raise MechanismError(
            [Problem(f"parameters.{name}", "no value", expected, file=mechanism.origin) for name in others]
        )


@dataclass(frozen=True)
class _Parts:
    """Cells without their tables, and which factors of the border divide them."""

    cells: tuple[Cell, ...]
    values: tuple[Cell, ...]
    dividing: frozenset[Polynomial]
    plane: Plane | None = None


def _edges(found: Family) -> list[Polynomial]:
    """Polynomials in the parameters that vanish where a range ends."""
    relations = found.space.ring.relations
    edges = []
    for p in found.domain:
        projected = Ideal(found.space.ring, (*relations, p)).eliminate(found.others).value
        edges += [found.base.convert(g) for g in projected.generators if g]
    return edges


def _inside(found: Family, sample: dict[str, Fraction]) -> bool:
    """Whether values of the parameters are in their ranges."""
    return all(bool(p.substitute(sample).to_sympy() > 0) for p in found.domain)


def _line(found: Family, border: Borders) -> _Parts:
    (name,) = found.parameters
    edges = _edges(found)
    ends = roots([*(part.polynomial for part in border.parts), *edges], name)
    inner = samples(ends)
    within = [_inside(found, {name: x}) for x in inner]
    cells = []
    for k, x in enumerate(inner):
        if within[k]:
            low = ends[k - 1] if k else None
            high = ends[k] if k < len(ends) else None
            cells.append(Cell({name: sympy.Rational(x)}, _interval(name, low, high), None))
    borders_inside = [ends[k] for k, (a, b) in enumerate(pairwise(within)) if a and b]
    constants = bool(found.space.ring.constants)
    values = tuple(_value(name, root, constants) for root in borders_inside)
    return _Parts(tuple(cells), values, frozenset(root.polynomial for root in borders_inside))


def _interval(name: str, low: Root | None, high: Root | None) -> str:
    left = f"{_shown(low)} < " if low else ""
    right = f" < {_shown(high)}" if high else ""
    return f"{left}{name}{right}"


def _shown(root: Root) -> str:
    return str(root.value) if root.degree <= 2 else f"{float(root):.6g}"


def _value(name: str, root: Root, constants: bool) -> Cell:
    """A value of the border; constants: whether other dimensions are irrational."""
    shown = f"{name} = {_shown(root)}"
    where, about = shown if root.degree <= 2 else f"{shown}...", float(root)
    value = root.value
    if value is None or (constants and root.degree > 2):
        reason = f"it is a root of degree {root.degree}, which is not put in"
        return Cell({}, where, None, reason, about=about)
    return Cell({name: value}, where, None, about=about)


def _plane(found: Family, border: Borders, names: tuple[str, str]) -> _Parts:
    own = [part.polynomial for part in border.parts]
    factors = [f for p in _edges(found) for f, _ in p.factors()]
    plane = Plane(names, tuple(dict.fromkeys((*own, *factors))))
    chosen: list[tuple[tuple[tuple[int, int], ...], dict[str, Fraction]]] = []
    for places in plane.components:
        points = (dict(zip(names, plane.sample(place), strict=True)) for place in places)
        sample = min(points, key=_length)
        if _inside(found, sample):
            chosen.append((places, sample))
    found_signs = [signs(own, sample) for _, sample in chosen]
    dividing = [k for k in range(len(own)) if len({row[k] for row in found_signs}) > 1]
    cells = tuple(
        Cell(
            {name: sympy.Rational(x) for name, x in sample.items()},
            f"cell {number}",
            None,
            signs=tuple(row[k] for k in dividing),
            places=places,
        )
        for number, ((places, sample), row) in enumerate(zip(chosen, found_signs, strict=True), 1)
    )
    numbers = {place: number for number, (places, _) in enumerate(chosen, 1) for place in places}
    values = tuple(_arcs(plane, frozenset(own[k] for k in dividing), numbers, found.space.ring))
    return _Parts(cells, values, frozenset(own[k] for k in dividing), plane)


def _arcs(
    plane: Plane, dividing: frozenset[Polynomial], numbers: Mapping[Place, int], ring: Ring
) -> Iterator[Cell]:
    """A point of each factor of the border between any two cells, the simplest ones."""
    simplest: dict[tuple[Polynomial, tuple[int, ...]], Arc] = {}
    for arc in plane.arcs():
        if arc.curve in dividing and all(side in numbers for side in arc.sides):
            between = tuple(sorted({numbers[side] for side in arc.sides}))
            known = simplest.setdefault((arc.curve, between), arc)
            if _plainness(arc) < _plainness(known):
                simplest[arc.curve, between] = arc
    for (curve, between), arc in simplest.items():
        listed = (
            f"between cells {between[0]} and {between[1]}" if len(between) > 1 else f"in cell {between[0]}"
        )
        where, x, y = f"{curve} = 0 {listed}", *arc.point
        if x is None or y is None or (ring.constants and arc.degree > 2):
            reason = f"its simplest point is a root of degree {arc.degree}, which is not put in"
            yield Cell({}, where, None, reason)
        else:
            yield Cell(dict(zip(plane.names, (x, y), strict=True)), where, None)


def _plainness(arc: Arc) -> tuple[int, int]:
    """Points of low degree with short numbers first."""
    return arc.degree, sum(len(str(x)) for x in arc.point)


def _length(sample: dict[str, Any]) -> tuple[int, Fraction]:
    """Short samples first."""
    return sum(x.denominator for x in sample.values()), sum(map(abs, sample.values()), Fraction(0))
