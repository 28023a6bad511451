"""The graph of a real curve: stars, ends and critical points as marks, proven chains as edges and loops.

Source: curve_paths.py; a mark lies on exactly one chain, decided by tubes, so that no component counts twice.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import networkx as nx
import numpy as np

from singsym.effort.budget import Budget, Undecided
from singsym.effort.progress import report
from singsym.effort.verdict import Known, Premises
from singsym.polynomials import Polynomial
from singsym.varieties.real.curves.arithmetic import Array, Balls, System
from singsym.varieties.real.curves.critical_points import Samples, as_balls, with_ends
from singsym.varieties.real.curves.paths import Chain, chains, contained, pair_tracks, prove_chains
from singsym.varieties.real.curves.singular_points import Star
from singsym.varieties.real.curves.stars import is_regular
from singsym.varieties.real.curves.tracking import Marks, kernels
from singsym.varieties.real.points.exact_point import RealPoint

#: how much the Jacobian may change over a step of tracking: tried in turn
_BENDS = (0.6, 0.25, 0.08)
Node = tuple[str, int]


@dataclass(frozen=True, eq=False)
class Edge:
    """An arc between two nodes: ("singular", k), ("end", k), or twice ("loop", k) for a smooth loop."""

    ends: tuple[Node, Node]
    chain: Chain


@dataclass(frozen=True, eq=False)
class Assembly:
    """The stars of a curve and the edges between them; `samples` are what it was built from."""

    equations: tuple[Polynomial, ...]
    stars: tuple[Star, ...]
    edges: tuple[Edge, ...]
    samples: Samples | None = None

    @classmethod
    def empty(cls) -> Assembly:
        """Without a point."""
        return cls((), (), ())


@dataclass(frozen=True, eq=False)
class _Marked:
    """Marks for tracking: smooth points first, then gates, then ends; `balls` bound the exact points.

    vague: gates that are not exact points but balls; nodes: the graph nodes of gates and ends.
    repeated: further enclosures of smooth points, already among the marks.
    """

    marks: Marks
    balls: Balls
    smooth: int
    vague: np.ndarray
    nodes: tuple[Node, ...]
    repeated: Balls


def assemble(
    system: System,
    equations: tuple[Polynomial, ...],
    samples: Samples,
    stars: Sequence[Star],
    budget: Budget,
    prove: bool,
) -> Assembly:
    """The graph of the curve; raises `Undecided` where tracking or the proof fails."""
    marked = _marked(system, samples, stars)
    lanes = np.arange(len(marked.marks.owner))
    reason = ""
    for bend in _BENDS:
        budget.check("tracking of a curve")
        tracks = pair_tracks(system, marked.marks, lanes, bend)
        if isinstance(tracks, str):
            reason = tracks
            continue
        found = chains(marked.marks, tracks)
        report("curve", "chains of arcs", done=len(found))
        if prove and found:
            proven = prove_chains(system, found, budget)
            reason = proven if isinstance(proven, str) else _misplaced(marked, proven)
            if reason or isinstance(proven, str):
                continue
            found = proven
        return Assembly(equations, tuple(stars), tuple(_edges(marked, found)), samples)
    raise Undecided(reason)


def _marked(system: System, samples: Samples, stars: Sequence[Star]) -> _Marked:
    size = len(system.ring.names)
    points = _smooth_points(system, samples, stars)
    distinct, repeated = _distinct(points)
    ends = as_balls(samples.ends, size)
    parts = [distinct, *(s.gates for s in stars), ends]
    balls = Balls(np.concatenate([b.mid for b in parts]), np.concatenate([b.rad for b in parts]))
    vague = [np.zeros(len(distinct.mid), dtype=bool)]
    vague += [np.full(s.degree, not s.exact) for s in stars]
    vague.append(np.zeros(len(ends.mid), dtype=bool))
    nodes = [("singular", k) for k, s in enumerate(stars) for _ in range(s.degree)]
    nodes += [("end", k) for k in range(len(ends.mid))]
    count = len(distinct.mid)
    along = kernels(system, distinct.mid) if count else distinct.mid
    inward = _downward(system, samples.objective, ends)
    directions = np.concatenate([along, -along, *(s.outward for s in stars), inward])
    owner = np.concatenate([np.arange(count), np.arange(count), np.arange(count, len(balls.mid))])
    marks = Marks(balls.mid, owner.astype(int), directions)
    return _Marked(marks, balls, count, np.concatenate(vague), tuple(nodes), repeated)


def _smooth_points(system: System, samples: Samples, stars: Sequence[Star]) -> Balls:
    """The samples outside all stars; raises `Undecided` where one is neither proven smooth nor in a star."""
    points = samples.points
    balls = as_balls((*points, *samples.boxed), len(system.ring.names))
    inside = np.zeros(len(balls.mid), dtype=bool)
    for star in stars:
        if star.chart is not None:
            inside |= star.chart.holds(balls) if len(balls.mid) else inside
    regular = is_regular(system, balls)
    for k in map(int, np.flatnonzero(~regular & ~inside)):
        exact = points[k] if k < len(points) else None
        if exact is None or not any(s.chart is None and s.point.coincides(exact) for s in stars):
            raise Undecided(f"the curve is too close to singular at {balls.mid[k]}")
    keep = regular & ~inside
    return Balls(balls.mid[keep], balls.rad[keep])


def _distinct(points: Balls) -> tuple[Balls, Balls]:
    """One of each group of points closer than rounding, and the others."""
    size = 1 + np.abs(points.mid).max(initial=0.0)
    kept: list[int] = []
    repeated: list[int] = []
    for k, point in enumerate(points.mid):
        near = kept and np.linalg.norm(points.mid[kept] - point, axis=1).min() < 1e-8 * size
        (repeated if near else kept).append(k)
    return tuple(Balls(points.mid[rows], points.rad[rows]) for rows in (kept, repeated))  # type: ignore[return-value]


def _downward(system: System, objective: Polynomial, ends: Balls) -> np.ndarray:
    """Unit tangents at the ends along which the objective decreases."""
    if not len(ends.mid):
        return ends.mid
    along = kernels(system, ends.mid)
    gradient = System(objective.ring, (objective,)).jacobian(ends.mid)[:, 0, :]
    return np.asarray(-along * np.sign((along * gradient).sum(axis=1))[:, None])


def _misplaced(marked: _Marked, found: Sequence[Chain]) -> str:
    """Why the proven chains are not surely distinct and complete; empty if they are."""
    member = np.zeros((len(marked.balls.mid), len(found)), dtype=bool)
    for j, chain in enumerate(found):
        member[list(chain.marks), j] = True
    inside, outside = contained(found, marked.balls)
    for k in np.flatnonzero(marked.vague):
        j = int(np.flatnonzero(member[k])[0])
        tubes = found[j].tubes
        if tubes is not None:
            inside[k, j] = max(tubes.error[0], tubes.error[-1]) < marked.balls.rad[k].max()
    if (member.sum(axis=1) != 1).any():
        return "a starting point lies on several arcs"
    if not (inside | ~member).all():
        return "a starting point is not proven to lie on its arc"
    if not (outside | member).all():
        return "two arcs cannot be told apart"
    again, _ = contained(found, marked.repeated)
    if not again.any(axis=1).all():
        return "two critical points cannot be told apart"
    return ""


def _edges(marked: _Marked, found: Sequence[Chain]) -> list[Edge]:
    edges = []
    for k, chain in enumerate(found):
        if chain.closed:
            edges.append(Edge((("loop", k), ("loop", k)), chain))
        else:
            first, last = (marked.nodes[m - marked.smooth] for m in (chain.marks[0], chain.marks[-1]))
            edges.append(Edge((first, last), chain))
    return edges


def extended(proof: Assembly, points: Sequence[RealPoint], budget: Budget) -> Known[Assembly]:
    """The same curve, followed further towards its ends where some of these points are beyond them."""
    samples = proof.samples
    if samples is None or samples.level is None:
        return Known(proof)
    inside = samples.objective - samples.level
    if all(point.sign(inside) < 0 for point in points):
        return Known(proof)
    known, premises = Known((*samples.points, *points)), Premises()
    further = premises.take(with_ends(proof.equations, samples.objective, known, budget))
    system = System(proof.equations[0].ring, proof.equations)
    own = replace(further, points=samples.points)
    return premises.conclude(assemble(system, proof.equations, own, proof.stars, budget, True))


def count_without(proof: Assembly, removed: Sequence[RealPoint], isolated: Sequence[RealPoint]) -> int:
    """How many components are left without some points of the curve; `isolated` ones count where kept."""
    distinct: list[RealPoint] = []
    for point in removed:
        if not any(point.coincides(p) for p in distinct):
            distinct.append(point)
    gone: set[Node] = set()
    cuts = [0] * len(proof.edges)
    for point in distinct:
        vertex = next((k for k, s in enumerate(proof.stars) if s.point.coincides(point)), None)
        if vertex is not None:
            gone.add(("singular", vertex))
        else:
            cuts[_edge_of(proof, point)] += 1
    graph = nx.Graph()
    graph.add_nodes_from(("singular", k) for k in range(len(proof.stars)) if ("singular", k) not in gone)
    for k, (edge, count) in enumerate(zip(proof.edges, cuts, strict=True)):
        pieces = [(f"piece {k}", i) for i in range(count + 1)]
        graph.add_nodes_from(pieces)
        for piece, end in ((pieces[0], edge.ends[0]), (pieces[-1], edge.ends[1])):
            if end not in gone and end[0] != "end":
                graph.add_edge(piece, end)
    starred = {id(s.point) for s in proof.stars}
    apart = [p for p in isolated if id(p) not in starred and not any(p.coincides(q) for q in distinct)]
    return int(nx.number_connected_components(graph)) + len(apart)


def _edge_of(proof: Assembly, point: RealPoint) -> int:
    """The edge on which a smooth point of the curve lies; raises `Undecided` where that is not clear."""
    ball = as_balls([point], len(point.ring.names))
    inside, _ = contained([e.chain for e in proof.edges], ball)
    if inside.sum() == 1:
        return int(np.flatnonzero(inside[0])[0])
    for k, star in enumerate(proof.stars):
        if star.chart is not None and star.chart.holds(ball)[0]:
            for gate, signs in zip(star.gates.mid, star.chart.signs(star.gates), strict=True):
                if star.chart.in_quadrants(ball, signs[None]).all():
                    return _edge_at(proof, ("singular", k), gate)
    raise Undecided(f"the arc of {point!r} is not proven")


def _edge_at(proof: Assembly, node: Node, gate: Array) -> int:
    """The edge that begins or ends at a gate of a node."""
    return next(
        j
        for j, edge in enumerate(proof.edges)
        for end, vertex in zip(edge.ends, edge.chain.points[[0, -1]], strict=True)
        if end == node and (vertex == gate).all()
    )
