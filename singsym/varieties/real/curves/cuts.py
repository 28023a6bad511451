"""A real curve cut at some of its points: what is left, piece by piece, and on which piece a point lies.

Source: a proven arc goes through its tubes in order, and in each there is one point of it for each length
along the tube; so points on it are in the order of their tubes, and in one tube of these lengths.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, cmp_to_key

import networkx as nx
import numpy as np

from singsym.effort.budget import Undecided
from singsym.varieties.real.curves.arithmetic import Array, Balls
from singsym.varieties.real.curves.assembly import Assembly, Node
from singsym.varieties.real.curves.critical_points import as_balls
from singsym.varieties.real.curves.tubes import MARGIN, location
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.intervals import Box, exact_bounds

_ROUNDED = 1e-12
"""More than the error of a length along a tube, over that of the tube."""


@dataclass(frozen=True, eq=False)
class _Spot:
    """Where on an edge a point is: lengths along the tubes that surely hold it, and those that surely do not.

    cut: the number of the removed point; -1 for another.
    """

    along: dict[int, tuple[float, float]]
    outside: np.ndarray
    cut: int

    def order(self, other: _Spot) -> int:
        """-1 where it is before the other; raises `Undecided` where that is not clear."""
        for row in self.along.keys() & other.along.keys():
            (low, high), (least, most) = self.along[row], other.along[row]
            if high < least or most < low:
                return -1 if high < least else 1
        for row in self.along:
            for another in other.along:
                if row != another and self.outside[another] and other.outside[row]:
                    return -1 if row < another else 1
        raise Undecided("the order of two points of a curve is not proven")


@dataclass(frozen=True, eq=False)
class CurvePiece:
    """A connected part of a curve between points that were removed; points: of these, the numbers.

    line: vertices near it, in order where it is one arc, (points, names of the ring).
    """

    points: tuple[int, ...]
    line: Array


@dataclass(frozen=True, eq=False)
class CutCurve:
    """What is left of a curve without some points, each once.

    removed: the points.
    """

    proof: Assembly
    removed: tuple[RealPoint, ...]

    @cached_property
    def _stars(self) -> dict[int, int]:
        """The removed points that are nodes, by the numbers of these."""
        pairs = ((k, j) for k in range(len(self.proof.stars)) for j in range(len(self.removed)))
        return {k: j for k, j in pairs if self.proof.stars[k].point.coincides(self.removed[j])}

    @cached_property
    def _cuts(self) -> list[list[_Spot]]:
        """On each edge the removed points in order."""
        found: list[list[_Spot]] = [[] for _ in self.proof.edges]
        for number, point in enumerate(self.removed):
            if number not in self._stars.values():
                edge, spot = self._spot(as_balls([point], len(point.ring.names)), number)
                found[edge].append(spot)
        return [sorted(own, key=cmp_to_key(_Spot.order)) for own in found]

    @cached_property
    def _graph(self) -> nx.Graph:
        graph = nx.Graph()
        gone = {("singular", k) for k in self._stars}
        for k, (edge, cuts) in enumerate(zip(self.proof.edges, self._cuts, strict=True)):
            parts: list[Node] = [(f"part {k}", i) for i in range(len(cuts) + 1)]
            graph.add_nodes_from(parts)
            for part, end in ((parts[0], edge.ends[0]), (parts[-1], edge.ends[1])):
                if end not in gone and end[0] != "end":
                    graph.add_edge(part, end)
        return graph

    @cached_property
    def _groups(self) -> list[set[Node]]:
        return [set(nodes) for nodes in nx.connected_components(self._graph)]

    @cached_property
    def pieces(self) -> tuple[CurvePiece, ...]:
        """The pieces that are more than a point."""
        return tuple(self._piece(nodes) for nodes in self._groups)

    def piece_of(self, box: Box) -> int:
        """The number of the piece that a point of the curve in a box lies on.

        Raises `Undecided` where that is not proven: the point may be too near to a removed one.
        """
        edge, spot = self._spot(_around(box), -1)
        before = sum(cut.order(spot) < 0 for cut in self._cuts[edge])
        return next(k for k, nodes in enumerate(self._groups) if (f"part {edge}", before) in nodes)

    def edge_of(self, box: Box) -> int:
        """The number of the edge that a point of the curve in a box lies on, raising as `piece_of` does."""
        return self._spot(_around(box), -1)[0]

    def _spot(self, ball: Balls, number: int) -> tuple[int, _Spot]:
        """The edge that a point lies on, and where."""
        found = []
        for k, edge in enumerate(self.proof.edges):
            tubes = edge.chain.tubes
            if tubes is None:
                continue
            inside, outside = location(tubes, ball)
            rows = np.flatnonzero(inside[0])
            if len(rows):
                squares = (tubes.step[rows] ** 2).sum(axis=1)
                along = ((ball.mid - tubes.center[rows]) * tubes.step[rows]).sum(axis=1) / squares
                slack = ball.rad.max() / np.sqrt(squares) + _ROUNDED
                ends = zip(rows.tolist(), (along - slack).tolist(), (along + slack).tolist(), strict=True)
                spot = _Spot({r: (a, b) for r, a, b in ends}, outside[0], number)
                found.append((k, _at_seam(spot, len(tubes)) if edge.chain.closed else spot))
        if len(found) != 1:
            raise Undecided("the arc of a point of a curve is not proven: it may be near a singular point")
        return found[0]

    def _piece(self, nodes: set[Node]) -> CurvePiece:
        points = [self._stars[k] for _, k in self._ends_of(nodes) if k in self._stars]
        lines = []
        for k, (edge, cuts) in enumerate(zip(self.proof.edges, self._cuts, strict=True)):
            parts = [i for i in range(len(cuts) + 1) if (f"part {k}", i) in nodes]
            places = [-np.inf, *(_position(cut) for cut in cuts), np.inf]
            if edge.chain.closed and len(parts) == 2 and parts[0] == 0:
                parts.reverse()
            for i in parts:
                points += [cuts[j].cut for j in (i - 1, i) if 0 <= j < len(cuts)]
                rows = np.arange(len(edge.chain.points), dtype=float)
                kept = edge.chain.points[(rows > places[i]) & (rows < places[i + 1])]
                ends = [
                    np.array([self.removed[cuts[j].cut].floats]) for j in (i - 1, i) if 0 <= j < len(cuts)
                ]
                first = ends[:1] if i > 0 else []
                lines += [*first, kept, *(ends[-1:] if i < len(cuts) else [])]
        line = np.concatenate(lines) if lines else np.zeros((0, 0))
        return CurvePiece(tuple(dict.fromkeys(points)), line)

    def _ends_of(self, nodes: set[Node]) -> Sequence[Node]:
        """The removed nodes at the ends of the edges of a piece."""
        found = []
        for k, (edge, cuts) in enumerate(zip(self.proof.edges, self._cuts, strict=True)):
            found += [edge.ends[0]] if (f"part {k}", 0) in nodes else []
            found += [edge.ends[1]] if (f"part {k}", len(cuts)) in nodes else []
        return [end for end in found if end[0] == "singular"]


def _around(box: Box) -> Balls:
    """A ball that holds a box, around its middle in doubles.

    >>> from flint import arb
    >>> third = _around((arb(1) / 3,))
    >>> abs(Fraction(1, 3) - Fraction(third.mid.item())) < Fraction(third.rad.item())
    True
    """
    middle = np.array([[float(b.mid()) for b in box]])
    exact = map(Fraction, middle[0].tolist())
    widths = [max(abs(e - m) for e in exact_bounds(b)) for b, m in zip(box, exact, strict=True)]
    radius = float(max(widths)) * (1 + 1e-12) * np.sqrt(len(box)) + 1e-300
    return Balls(middle, np.full_like(middle, radius))


def _at_seam(spot: _Spot, count: int) -> _Spot:
    """A point of a loop where its last tube meets the first: as a point of the first, which begins the order.

    Raises `Undecided` where it is near the seam and not in both.
    """
    first, last = spot.along.get(0), spot.along.get(count - 1)
    near = (first is not None and first[0] < MARGIN - 0.5) or (last is not None and last[1] > 0.5 - MARGIN)
    if not near:
        return spot
    if first is None or last is None:
        raise Undecided("a point of a curve is too near to where a loop of tubes closes")
    outside = spot.outside.copy()
    outside[count - 1] = True
    return _Spot({row: ends for row, ends in spot.along.items() if row != count - 1}, outside, spot.cut)


def _position(spot: _Spot) -> float:
    """About how many vertices of the edge's polyline are before it."""
    row, (low, high) = min(spot.along.items(), key=lambda pair: abs(pair[1][0] + pair[1][1]))
    return float(np.clip(row + 0.5 + (low + high) / 2, row - MARGIN, row + 1 + MARGIN))
