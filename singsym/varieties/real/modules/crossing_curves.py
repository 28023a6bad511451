"""Curves of dyads over circles that cross, where a dyad turns freely: rhombi, of which two corners can meet.

Source: coverings of curves, see coverings.py; singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import prod

import networkx as nx

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, Undecided
from singsym.elimination.ideal import Ideal
from singsym.elimination.linear_substitution import Substitution
from singsym.polynomials import Equations, Polynomial
from singsym.polynomials.block_form import SolvingOrder
from singsym.varieties.decomposition import decompose
from singsym.varieties.disjoint_parts import MOST_VARIABLES
from singsym.varieties.real.modules.assemblies import dyad, value_at
from singsym.varieties.real.modules.coverings import Covering, coverings, is_arc_in, vanishes
from singsym.varieties.real.modules.curve_point import BITS, Balls, CurvePoint
from singsym.varieties.real.modules.module_points import points_of, without_given
from singsym.varieties.real.modules.towers import Tower, towers
from singsym.varieties.real.points.intervals import at_precision
from singsym.varieties.splitting import irreducible_factors, used_ring

Node = tuple[int, int, int]
"""A point of a covering: the number of the part, of the covering, of the point."""


def crossing_parts(over: Tower) -> tuple[tuple[Equations, Equations], ...]:
    """What a first dyad that may turn freely makes of a curve: the parts, each by its core and by the whole.

    The core are the circle, the dyad and what this needs, in few variables.  Raises `Undecided` where no dyad
    may turn freely, or the core is not proven to come apart into curves.
    """
    whole = (over.circle, *(p for m in (*over.foundation, *over.dyads) for p in m.equations))
    for module in over.dyads:
        below = SolvingOrder(over.dyads, (), ()).ancestors(module)
        core = (over.circle, *(p for m in (*below, module) for p in m.equations))
        form = dyad(module)
        assert form is not None
        ring = used_ring(over.circle.ring, core)
        own, line = (tuple(map(ring.convert, group)) for group in (core, form.line.values()))
        if len(ring.names) > MOST_VARIABLES:
            break
        if Ideal(ring, (*own, *line)).is_unit().value:
            continue
        with attempt("a curve that comes apart", patience.APART.work):
            found = decompose(own, ring=ring)
            curves = found.certainty == "proven" and all(c.prime and c.dimension == 1 for c in found.value)
            if curves and len(found.value) > 1:
                parts = [tuple(map(over.circle.ring.convert, c.generators)) for c in found.value]
                return tuple((part, (*part, *(p for p in whole if p not in core))) for part in parts)
        break
    raise Undecided("no dyad of a curve is seen to turn freely over a core that comes apart")


@dataclass(frozen=True)
class _Part:
    """One of several curves.

    core: what tells it from the others; equations: in the variables that are left when those are out that
    `given` gives; curves: its coverings, in which it crosses the others at points.
    """

    core: Equations
    equations: Equations
    given: Sequence[Substitution]
    curves: tuple[Covering, ...]

    @classmethod
    def of(cls, core: Equations, equations: Equations, others: Sequence[Equations], budget: Budget) -> _Part:
        """The part that one core makes of a curve, with the cores of the others."""
        left, given = without_given(equations)
        if not left:
            raise Undecided("one of several curves that cross is no curve")
        part = cls(core, left, given, ())
        crossings = prod(irreducible_factors(map(part.off, others)) or (), start=left[0].ring.one)
        for over in towers(left):
            if {*over.base_ring.names} >= {*crossings.variables}:
                return cls(core, left, given, coverings(over, points_of, budget, crossings).value)
        raise Undecided("one of several curves that cross is not seen to cross the others over a circle")

    def inside(self, group: Equations) -> Equations:
        """Polynomials on the part in the variables that are left."""
        for step in self.given:
            group = step.apply(group)
        return tuple(map(self.equations[0].ring.convert, group))

    def off(self, other: Equations) -> Polynomial:
        """One of the polynomials of another core that is not zero on all of this part."""
        found = [p for p in self.inside(other) if not vanishes(p, self.equations).value]
        if not found:
            raise Undecided("two curves that cross are not seen to be two")
        return min(found, key=lambda p: (len(p.variables), len(p)))

    def balls(self, point: CurvePoint, bits: int) -> Balls:
        """Of all coordinates of a point."""
        with at_precision(bits + 64):
            known = dict(point.balls(bits))
            for step in reversed(self.given):
                known[step.name] = value_at(step.value, known)
        return known

    def shared(self, other: Equations) -> Iterator[tuple[int, int]]:
        """Its points where all polynomials of another core vanish: the numbers of covering and point."""
        group = self.inside(other)
        for c, curve in enumerate(self.curves):
            for k, point in enumerate(curve.points):
                if not any(point.sign(point.ring.convert(p)) for p in group):
                    yield c, k


def components_of_crossing(
    parts: Sequence[tuple[Equations, Equations]], exclusions: Sequence[Equations], budget: Budget
) -> int:
    """The components of curves together that are in no exclusion; each by its core and by the whole.

    Lemma: two of them share the points at which both cores vanish, which are among those where arcs of either
    end; as sets they are the same in both, so that balls of which each meets just one of the other tell which
    are one.  Arcs in an exclusion are left out; a point where no arc ends is a component of its own.
    """
    cores = [core for core, _ in parts]
    found = [
        _Part.of(core, equations, [c for c in cores if c is not core], budget) for core, equations in parts
    ]
    same = nx.Graph()
    same.add_nodes_from(_nodes(found))
    for (i, one), (j, two) in combinations(enumerate(found), 2):
        for (c, k), (d, m) in _pairs(one, two):
            same.add_edge((i, c, k), (j, d, m))
    place = {node: n for n, group in enumerate(nx.connected_components(same)) for node in group}
    graph, ends = nx.Graph(), set[int]()
    for i, part in enumerate(found):
        groups = [part.inside(group) for group in exclusions]
        for c, curve in enumerate(part.curves):
            for arc in curve.arcs:
                start, end = (place[i, c, k] for k in arc.ends)
                ends |= {start, end}
                if not any(is_arc_in(curve.middle(arc), group, part.equations) for group in groups):
                    graph.add_edge(start, end)
    alone = {place[node]: node for node in place if place[node] not in ends}
    kept = sum(not _is_in(found, node, exclusions) for node in alone.values())
    return int(nx.number_connected_components(graph)) + kept


def _nodes(parts: Sequence[_Part]) -> Iterator[Node]:
    for i, part in enumerate(parts):
        for c, curve in enumerate(part.curves):
            yield from ((i, c, k) for k in range(len(curve.points)))


def _is_in(parts: Sequence[_Part], node: Node, exclusions: Sequence[Equations]) -> bool:
    i, c, k = node
    point = parts[i].curves[c].points[k]
    groups = (parts[i].inside(group) for group in exclusions)
    return any(not any(point.sign(point.ring.convert(p)) for p in group) for group in groups)


def _pairs(one: _Part, two: _Part) -> Iterator[tuple[tuple[int, int], tuple[int, int]]]:
    """The points that two parts share, by the numbers that they have in either."""
    first, second = list(one.shared(two.core)), list(two.shared(one.core))
    for bits in BITS:
        balls = [two.balls(two.curves[c].points[k], bits) for c, k in second]
        met = []
        for c, k in first:
            own = one.balls(one.curves[c].points[k], bits)
            met.append([m for m, known in enumerate(balls) if all(own[n].overlaps(known[n]) for n in own)])
        if sorted(m for found in met for m in found) == list(range(len(second))) and all(
            len(found) == 1 for found in met
        ):
            yield from ((place, second[m]) for place, (m,) in zip(first, met, strict=True))
            return
    raise Undecided("at which points two curves cross is not seen")
