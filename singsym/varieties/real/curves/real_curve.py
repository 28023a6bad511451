"""Real curves: their connected components, singular points and ends, proven, with polylines for drawing.

Source: critical points meet every component (curve_critical.py); proven tubes join them into loops and edges
(curve_paths.py); singular points are analysed in curve_singular.py and curve_branches.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import networkx as nx
import numpy as np

from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.progress import Sink, report, to
from singsym.effort.verdict import Known, Premises, Verdict, weakest
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.curves.arithmetic import Array, System
from singsym.varieties.real.curves.assembly import Assembly, assemble, count_without, extended
from singsym.varieties.real.curves.critical_points import Samples, points_on_components
from singsym.varieties.real.curves.cuts import CutCurve
from singsym.varieties.real.curves.equations import CurveEquations, candidates
from singsym.varieties.real.curves.paths import Chain
from singsym.varieties.real.curves.stars import find_stars
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points

_DRAWS = 4
"""So many centres and directions are drawn until a curve is proven: near special ones that takes too long."""


@dataclass(frozen=True, eq=False)
class CurveComponent:
    """A connected component of a real curve that is more than a point.

    closed: whether it is compact; ends: how many of its branches run off to infinity.
    singular_points: where it crosses itself, has a cusp, or the like.
    polylines: one array (points, names) for each arc between singular points or ends; a loop begins and
    ends at the same point.  Vertices are within 1e-9 of the curve.
    """

    names: tuple[str, ...]
    closed: bool
    ends: int
    singular_points: tuple[RealPoint, ...]
    polylines: tuple[Array, ...] = field(repr=False)

    @property
    def polyline(self) -> Array:
        """All arcs in one array, with rows of nan between them: what plotting functions take."""
        gap = np.full((1, len(self.names)), np.nan)
        parts = [part for line in self.polylines for part in (line, gap)]
        return np.concatenate(parts[:-1])


@dataclass(frozen=True, eq=False)
class RealCurve:
    """The real points of a curve.

    components: the connected components other than isolated points, in no particular order.
    graph: a networkx multigraph: nodes are singular points, ends at infinity and one for each smooth loop;
    an edge is an arc, with attributes `polyline` and `component`.
    verdict: yes ("certified") if the topology is proven, "modular" where that no critical point is missing
    rests on random primes; else undecided with the reason, and what is there is a drawing only.
    """

    ring: Ring
    names: tuple[str, ...]
    components: tuple[CurveComponent, ...]
    isolated_points: tuple[RealPoint, ...]
    singular_points: tuple[RealPoint, ...]
    graph: nx.MultiGraph
    verdict: Verdict
    _proof: Assembly | None = field(default=None, repr=False)

    @property
    def connected_components(self) -> int:
        """How many connected components there are, isolated points included; raises if undecided."""
        if self.verdict.is_undecided:
            raise ValueError(f"the number of components is {self.verdict}")
        return len(self.components) + len(self.isolated_points)

    @property
    def loops(self) -> tuple[Chain, ...]:
        """The proven loops of a smooth bounded curve given by one equation less than variables."""
        if self._proof is None or self._proof.stars or len(self._proof.equations) != len(self.ring.names) - 1:
            raise Undecided("the curve is not proven to be smooth and bounded")
        return tuple(edge.chain for edge in self._proof.edges)

    def without(self, *exclusions: Polynomial, budget: Budget | None = None) -> Known[int]:
        """How many connected components are left when the zeros of some polynomials are removed.

        Isolated points count.  Raises `NotZeroDimensional` where a polynomial vanishes on a whole component,
        and `Undecided` where the topology or the place of a removed point is not proven.

        >>> x, y = Ring(("x", "y")).gens
        >>> real_curve([x**2 + y**2 - 1]).without(x, x - 2).value
        2
        >>> real_curve([(x**2 + y**2 - 1) * (x - 5), (x**2 + y**2 - 1) * y]).without(x - 5).value
        1
        """
        if self._proof is None:
            raise Undecided(f"the topology of the curve is {self.verdict}")
        isolated = [p for p in self.isolated_points if all(map(p.sign, exclusions))]
        premises = Premises(self.verdict.certainty)
        if not self._proof.equations:
            return premises.conclude(len(isolated))
        removed = self._zeros(exclusions, premises, budget)
        proof = premises.take(extended(self._proof, removed, current(budget)))
        return premises.conclude(count_without(proof, removed, isolated))

    def cut(self, *exclusions: Polynomial, budget: Budget | None = None) -> Known[CutCurve]:
        """The curve without the zeros of some polynomials, piece by piece; raises as `without` does.

        >>> x, y = Ring(("x", "y")).gens
        >>> len(real_curve([x**2 + y**2 - 1]).cut(x, x - y).value.pieces)
        4
        """
        if self._proof is None:
            raise Undecided(f"the topology of the curve is {self.verdict}")
        premises = Premises(self.verdict.certainty)
        if not self._proof.equations:
            return premises.conclude(CutCurve(self._proof, ()))
        removed = self._zeros(exclusions, premises, budget)
        proof = premises.take(extended(self._proof, removed, current(budget)))
        distinct: list[RealPoint] = []
        for point in removed:
            if not any(point.coincides(p) for p in distinct):
                distinct.append(point)
        return premises.conclude(CutCurve(proof, tuple(distinct)))

    def component_of(self, point: RealPoint) -> CurveComponent:
        """The component through a point of the curve; raises `Undecided` where that is not proven.

        >>> x, y = Ring(("x", "y")).gens
        >>> curve = real_curve([x**2 + y**2 - 1])
        >>> curve.component_of(real_points([x**2 + y**2 - 1, y]).value[0]).closed
        True
        """
        if self._proof is None:
            raise Undecided(f"the topology of the curve is {self.verdict}")
        edges: list[tuple[int, int]] = [
            (key, data["component"]) for *_, key, data in self.graph.edges(keys=True, data=True)
        ]
        at = [("singular", k) for k, s in enumerate(self._proof.stars) if s.point.coincides(point)]
        near = {key for *_, key in self.graph.edges(at, keys=True)}
        here = near if at else {CutCurve(self._proof, ()).edge_of(point.box)}
        for key, component in edges:
            if key in here:
                return self.components[component]
        raise Undecided("the point is isolated")

    def _zeros(
        self, exclusions: Sequence[Polynomial], premises: Premises, budget: Budget | None
    ) -> list[RealPoint]:
        """The points of the curve at which one of some polynomials vanishes."""
        equations = self._proof.equations if self._proof else ()
        return [p for e in exclusions for p in premises.take(real_points((*equations, e), budget))]

    def __repr__(self) -> str:
        if self.verdict.is_undecided:
            return f"RealCurve({self.verdict})"
        closed = sum(c.closed for c in self.components)
        points = f", {len(self.isolated_points)} isolated points" if self.isolated_points else ""
        return f"RealCurve({len(self.components)} components, {closed} of them closed{points})"


def real_curve(
    system: Ideal | Sequence[Polynomial],
    *,
    budget: Budget | None = None,
    seed: int = 0,
    progress: Sink | None = None,
    drawing: bool = False,
) -> RealCurve:
    """The connected components of a real curve, certified, with polylines.

    system: an `Ideal` or polynomials of one ring; the relations of its constants are added, and points with a
    conjugate of a constant do not count.  Multiple components are made reduced first.
    drawing: skip the proof of the arcs; the verdict is then undecided.
    Raises `ValueError` naming the dimension where the system is not a curve.  What cannot be proven, or not
    within the budget, comes out with an undecided verdict.

    >>> x, y = Ring(("x", "y")).gens
    >>> real_curve([x**3 - x - y**2])
    RealCurve(2 components, 1 of them closed)
    """
    generators = system.generators if isinstance(system, Ideal) else tuple(system)
    if not generators:
        raise ValueError("a curve is expected, not the whole space: no equations were given")
    ring: Ring = generators[0].ring
    budget = current(budget)
    with to(progress):
        for draw in range(_DRAWS):
            try:
                found = _solved(ring, generators, budget, seed + draw, drawing)
            except Undecided as reason:
                found = _undecided(ring, str(reason))
            if drawing or not found.verdict.is_undecided or budget.remaining() == 0.0:
                break
    return found


def _solved(
    ring: Ring, generators: tuple[Polynomial, ...], budget: Budget, seed: int, drawing: bool
) -> RealCurve:
    reason = "no critical points could be found"
    for known in candidates(ring, generators, budget):
        choice = known.value
        if not choice.equations:
            return _result(ring, Known(Assembly.empty()), known, drawing)
        samples = points_on_components(choice.equations, seed, budget)
        if samples is None:
            reason = "the critical points are not isolated: the equations are not reduced, or not of a curve"
            continue
        topology = _topology(choice.equations, samples, seed, budget, drawing)
        return _result(ring, topology, known, drawing)
    raise Undecided(reason)


def _topology(
    equations: tuple[Polynomial, ...], known: Known[Samples], seed: int, budget: Budget, drawing: bool
) -> Known[Assembly]:
    system, premises = System(equations[0].ring, equations), Premises()
    samples = premises.take(known)
    report("curve", f"{len(samples.points)} critical points, {len(samples.ends)} ends")
    stars, samples = premises.take(find_stars(system, equations, samples, seed, budget))
    return premises.conclude(assemble(system, equations, samples, stars, budget, prove=not drawing))


def _result(ring: Ring, topology: Known[Assembly], chosen: Known[CurveEquations], drawing: bool) -> RealCurve:
    """The topology in the terms of the user, isolated points of the system itself included."""
    proof, choice = topology.value, chosen.value
    constants = {c.name for c in ring.constants}
    kept = [i for i, name in enumerate(ring.names) if name not in constants]
    names = tuple(ring.names[i] for i in kept)
    graph = nx.MultiGraph()
    for k, star in enumerate(proof.stars):
        graph.add_node(("singular", k), point=star.point)
    for k, edge in enumerate(proof.edges):
        graph.add_edge(*edge.ends, key=k, polyline=edge.chain.points[:, kept])
    components: list[CurveComponent] = []
    isolated: list[RealPoint] = []
    for nodes in nx.connected_components(graph):
        arcs = list(graph.subgraph(nodes).edges(data=True))
        points = tuple(proof.stars[k].point for kind, k in sorted(nodes) if kind == "singular")
        if not arcs:
            isolated.extend(points)
            continue
        ends = sum(kind == "end" for kind, _ in nodes)
        for *_, data in arcs:
            data["component"] = len(components)
        lines = tuple(data["polyline"] for *_, data in arcs)
        components.append(CurveComponent(names, not ends, ends, points, lines))
    certainty = weakest("certified", topology.certainty, chosen.certainty)
    verdict = Verdict.yes(certainty, reason="every arc is covered by proven tubes")
    if drawing:
        verdict = Verdict.undecided("drawn only: the arcs were tracked, but not proven")
    singular = tuple(s.point for s in proof.stars)
    isolated.extend(choice.points)
    return RealCurve(
        ring,
        names,
        tuple(components),
        tuple(isolated),
        singular,
        graph,
        verdict,
        None if drawing else proof,
    )


def _undecided(ring: Ring, reason: str) -> RealCurve:
    constants = {c.name for c in ring.constants}
    names = tuple(name for name in ring.names if name not in constants)
    return RealCurve(ring, names, (), (), (), nx.MultiGraph(), Verdict.undecided(reason))
