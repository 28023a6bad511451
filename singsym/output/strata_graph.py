"""The graph of strata: which class lies in the closure of which.

Source: the sets {4}-{6} of section 3.2 of Zlatanov, Fenton, Benhabib (1998) and their intersections;
closures are Zariski closures, decided by radical membership; those of the regular configurations by the lemma
of `_near_regular`.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import prod
from typing import Any

import networkx

from singsym.classes.result import Classification, Piece
from singsym.effort.budget import Budget, Undecided
from singsym.elimination.ideal import Ideal
from singsym.output.figures.layers import Arrow, Box, box_width, draw_layers, row_height
from singsym.output.figures.style import INK, LINK, PLATFORM, Picture, entitle, paper
from singsym.polynomials import Polynomial
from singsym.varieties.real.dimension.extent import union

MANY = 16
"""With more pieces than this the nodes are whole classes; more products than this are not looked at."""

_Key = tuple[int, tuple[str, ...]]
_REGULAR: _Key = (0, ())


def strata_graph(classification: Classification, seconds: float = 10.0) -> networkx.DiGraph:
    """Strata as nodes, an edge from each to those in whose closure it lies, transitively reduced.

    Node attributes: `number` of the class (0: regular), `label`, `dimension` (where it is open the least that
    it can be, which the label says), `points`.  Edge attribute `whole`: False where only a part lies in the
    closure.  Comparisons that take more than `seconds` together, or need a dimension that is open, leave
    their edges out; the graph's attribute `undecided` counts them.

    >>> from singsym.classes.classify import classify
    >>> from singsym.mechanism import load
    >>> graph = strata_graph(classify(load("slider-crank"), cache=False))
    >>> sorted(graph.nodes(data="number"))
    [((0, ()), 0), ((1, ('By',)), 1)]
    """
    groups = _groups(classification)
    graph = networkx.DiGraph(undecided=0)
    space = classification.configuration_space
    usual = [p.extent for p in space if p.verdict.is_yes and not p.defects.types]
    if usual:
        attributes = {"dimension": union(usual).at_least, "points": None}
        graph.add_node(_REGULAR, number=0, label="regular", **attributes)
    budget = Budget(seconds)
    extents = {key: union(p.extent for p in pieces) for key, (_, pieces) in groups.items()}
    for key, (label, pieces) in groups.items():
        extent = extents[key]
        if extent.dimension is None:
            label = f"{label}\ndimension {extent}"
        points = sum(p.points or 0 for p in pieces) if extent.dimension == 0 else None
        graph.add_node(key, number=key[0], label=label, dimension=extent.at_least, points=points)
        if usual and _near_regular(classification, pieces, budget):
            graph.add_edge(key, _REGULAR, whole=True)
        elif usual:
            graph.graph["undecided"] += 1
    for small, (_, inner) in groups.items():
        for large, (_, outer) in groups.items():
            if graph.nodes[small]["dimension"] < graph.nodes[large]["dimension"]:
                try:
                    lying = [_inside(p, outer, budget) for p in inner]
                except Undecided:
                    graph.graph["undecided"] += 1
                    continue
                if any(lying):
                    graph.add_edge(small, large, whole=all(lying))
            elif small != large and extents[large].dimension is None:
                graph.graph["undecided"] += 1
    reduced = networkx.transitive_reduction(graph)
    for node, data in graph.nodes(data=True):
        reduced.nodes[node].update(data)
    for a, b in reduced.edges:
        reduced.edges[a, b].update(graph.edges[a, b])
    reduced.graph.update(graph.graph)
    return reduced


def _near_regular(classification: Classification, pieces: Sequence[Piece], budget: Budget) -> bool:
    """Whether pieces of a class are proven to lie in the closure of the regular configurations.

    Lemma.  Where rank L = N, and L has N rows, the configuration space is a manifold of dimension n, and of n
    and the number of parameters and mountings with these as variables.  If all singular configurations
    together have a smaller dimension, they have no inner points, so that there are regular configurations
    near each of rank L = N: feasible ones where that is not at the end of a range.
    """
    mechanism, space = classification.mechanism, classification.equation.space
    usual = classification.equation.n + space.varying
    bounds = [c.extent.at_most for c in classification.classes]
    if mechanism is None or mechanism.translating or any(m is None or m >= usual for m in bounds):
        return False
    if (
        any(p.defects.delta for p in pieces)
        or len(classification.equation.L.rows) != classification.equation.N
    ):
        return False
    try:
        ends = (Ideal(space.ring, (*p.basis, end)) for p in pieces for end in space.nonnegative)
        known = (ideal.is_unit(budget) for ideal in ends)
        return all(unit.value and unit.is_proven for unit in known)
    except Undecided:
        return False


def _groups(classification: Classification) -> dict[_Key, tuple[str, list[Piece]]]:
    """Pieces by class and by the factors that vanish on them; by class alone where there are many."""
    words = {locus.factor: locus.words for locus in classification.loci if locus.words}
    by_path: dict[_Key, tuple[str, list[Piece]]] = {}
    by_class: dict[_Key, tuple[str, list[Piece]]] = {}
    for result in classification.classes:
        number, name = result.singularity_class.number, result.singularity_class.name
        for piece in result.pieces:
            lines = [words.get(p, _short(str(p))) for p in piece.path]
            label = "\n".join([f"{number} ({name})", *lines])
            by_path.setdefault((number, tuple(map(str, piece.path))), (label, []))[1].append(piece)
            by_class.setdefault((number, ()), (f"{number} ({name})", []))[1].append(piece)
    return by_path if len(by_path) <= MANY else by_class


def _short(text: str) -> str:
    return f"{text} = 0" if len(text) <= 24 else f"{text[:20]}… = 0"


def _inside(small: Piece, large: Sequence[Piece], budget: Budget) -> bool:
    """Whether the zeros of one ideal are seen to be among those of others together.

    They are where each product vanishes of one generator of each of the others.
    """
    inner = Ideal(small.basis[0].ring, small.basis)

    def vanishes(polynomial: Polynomial) -> bool:
        return inner.radical_contains(polynomial, budget).value

    left = [[g for g in piece.basis if not vanishes(g)] for piece in large]
    if not all(left):
        return True
    return prod(map(len, left)) <= MANY and all(
        vanishes(prod(choice, start=small.basis[0].ring.one)) for choice in product(*left)
    )


def plot_strata(
    classification: Classification, graph: networkx.DiGraph | None = None, *, axes: Any = None
) -> Picture:
    """The graph of strata, one row for each dimension, edges up into the closures.

    axes: of matplotlib, to draw on; None: those of a new figure.
    """
    alone = axes is None
    graph = strata_graph(classification) if graph is None else graph
    rows: dict[int, list[Any]] = {}
    for node, dimension in graph.nodes(data="dimension"):
        rows.setdefault(dimension, []).append(node)
    order = sorted(rows, reverse=True)
    boxes = {node: _box(data) for node, data in graph.nodes(data=True)}
    widest = max(len(row) for row in rows.values())
    axes = paper(axes, max(5.0, box_width(boxes.values()) * widest), 0.8 + 1.5 * len(order))
    arrows = [Arrow(*edge) for edge in graph.edges(data="whole")]
    draw_layers(axes, [rows[dimension] for dimension in order], boxes, arrows)
    for row, dimension in enumerate(order):
        style = {"ha": "right", "va": "center", "fontsize": 9, "color": INK}
        axes.text(-0.55, row_height(row), f"dim {dimension}", **style)
    axes.set(xlim=(-1.1, widest + 0.1))
    title = "Strata, with arrows into the closures that hold them"
    entitle(axes, title, alone=alone)
    lines = [f"{_one_line(graph, a)} lies in the closure of {_one_line(graph, b)}" for a, b in graph.edges]
    return Picture(axes.figure, title, "; ".join(lines))


def _box(data: dict[str, Any]) -> Box:
    count = f"\n{data['points']} points" if data["points"] else ""
    return Box(f"{data['label']}{count}", LINK if data["number"] else PLATFORM)


def _one_line(graph: networkx.DiGraph, node: Any) -> str:
    return str(graph.nodes[node]["label"]).replace("\n", ": ", 1).replace("\n", " and ")
