"""Equations in block triangular form: small square systems that are solved one after the other.

Source: Dulmage, Mendelsohn, Coverings of bipartite graphs, Canad. J. Math. 10 (1958) 517-534; Pothen, Fan,
Computing the block triangular form of a sparse matrix, ACM Trans. Math. Softw. 16 (1990) 303-324.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import networkx as nx

from singsym.polynomials.polynomial import Polynomial


@dataclass(frozen=True)
class Module:
    """As many equations as unknowns, which cannot be solved in smaller steps.

    parents: the other variables of the equations; they are unknowns of earlier modules, or given.
    """

    equations: tuple[Polynomial, ...]
    unknowns: tuple[str, ...]
    parents: tuple[str, ...]


@dataclass(frozen=True)
class SolvingOrder:
    """Modules in an order in which they can be solved, and the equations that are left over.

    free: the unknowns that no equation was left to determine.
    """

    modules: tuple[Module, ...]
    left_over: tuple[Polynomial, ...]
    free: tuple[str, ...]

    def ancestors(self, module: Module) -> tuple[Module, ...]:
        """The modules that have to be solved before this one, in order."""
        return self.determining(module.parents)

    def determining(self, names: Collection[str]) -> tuple[Module, ...]:
        """The modules that determine these variables, and all that they need, in order.

        >>> from singsym.polynomials import Ring
        >>> x, y, z = Ring(("x", "y", "z")).gens
        >>> [m.unknowns for m in block_form((y * z - 1, x**2 - 2, x + y - 3)).determining(("y",))]
        [('x',), ('y',)]
        """
        needed = set(names)
        found: list[Module] = []
        for module in reversed(self.modules):
            if needed & set(module.unknowns):
                needed |= set(module.parents)
                found.append(module)
        return tuple(reversed(found))


def block_form(equations: Sequence[Polynomial], given: Collection[str] = ()) -> SolvingOrder:
    """The modules of equations in all their variables but the given ones.

    Where a choice is, equations that come first are matched first; those that find no unknown of their own
    are left over.  Modules that could trade places come in the order of their first equations.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> [m.unknowns for m in block_form((y * z - 1, x**2 - 2, x + y - 3)).modules]
    [('x',), ('y',), ('z',)]
    >>> block_form((x + y + z, x - y), given=("z",)).modules[0].unknowns
    ('x', 'y')
    """
    names = {k: [n for n in p.variables if n not in given] for k, p in enumerate(equations)}
    blocks = square_blocks(names)
    matched = {k: name for block in blocks for k, name in block.items()}
    left_over = tuple(p for k, p in enumerate(equations) if k not in matched)
    everything = dict.fromkeys(name for own in names.values() for name in own)
    free = tuple(name for name in everything if name not in matched.values())
    return SolvingOrder(tuple(_module(equations, list(b), b) for b in blocks), left_over, free)


def square_blocks(names: Mapping[int, Sequence[str]]) -> tuple[dict[int, str], ...]:
    """The blocks of an incidence, in an order in which they can be solved: rows and the unknown of each.

    names: the unknowns in each row.  Rows that come first are matched first; those that find no unknown of
    their own are in no block.

    >>> square_blocks({0: ("y", "z"), 1: ("x",), 2: ("x", "y", "z"), 3: ("x",)})
    ({1: 'x'}, {0: 'z', 2: 'y'})
    """
    owner = _matching(names)
    unknown_of = {k: name for name, k in owner.items()}
    needs = ((owner[name], k) for k in unknown_of for name in names[k] if name in owner)
    return tuple({k: unknown_of[k] for k in own} for own in ordered_components(unknown_of, needs))


def independent_parts(equations: Sequence[Polynomial]) -> tuple[tuple[Polynomial, ...], ...]:
    """Equations in parts that have only fixed numbers in common, in the order of their first ones.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> independent_parts((x**2 - y, z**2 - 2, y - 1))
    ((x^2 - y, y - 1), (z^2 - 2,))
    """
    graph: Any = nx.Graph()
    graph.add_nodes_from(range(len(equations)))
    for k, p in enumerate(equations):
        constants = {c.name for c in p.ring.constants}
        graph.add_edges_from((k, name) for name in p.variables if name not in constants)
    parts = (sorted(n for n in part if isinstance(n, int)) for part in nx.connected_components(graph))
    return tuple(tuple(equations[k] for k in part) for part in sorted(p for p in parts if p))


def ordered_components(nodes: Iterable[int], edges: Iterable[tuple[int, int]]) -> list[list[int]]:
    """The strongly connected components of a graph, each sorted, and each before those that it leads to.

    Where a choice is, the component with the smallest node comes first.

    >>> ordered_components([0, 1, 2, 3], [(3, 2), (2, 3), (3, 0)])
    [[1], [2, 3], [0]]
    """
    graph: Any = nx.DiGraph()
    graph.add_nodes_from(nodes)
    graph.add_edges_from(edges)
    condensed: Any = nx.condensation(graph)
    members = {c: sorted(data["members"]) for c, data in condensed.nodes(data=True)}
    order = nx.lexicographical_topological_sort(condensed, key=lambda c: members[c][0])
    return [members[c] for c in order]


def with_last_modules(
    equations: Sequence[Polynomial], size: int
) -> tuple[tuple[Polynomial, ...], tuple[Module, ...]]:
    """Equations without modules that come last, of so many unknowns each, and these in order.

    A module comes last where its unknowns are in no other equation.  The equations that are left may have
    more unknowns than they determine.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> with_last_modules((x**2 + y**2 - 1, x * y - 2, z - x - y), 1)[0]
    (x^2 + y^2 - 1, x*y - 2)
    """
    left, found = list(equations), list[Module]()
    while (last := _last_module(left, size)) is not None:
        left = [p for p in left if p not in last.equations]
        found.append(last)
    return tuple(left), tuple(reversed(found))


def _last_module(equations: Sequence[Polynomial], size: int) -> Module | None:
    places: dict[str, tuple[int, ...]] = {}
    for k, p in enumerate(equations):
        for name in p.variables:
            places[name] = (*places.get(name, ()), k)
    for own in places.values():
        unknowns = [other for other, there in places.items() if set(there) <= set(own)]
        if len(own) == len(unknowns) == size and len(own) < len(equations):
            return _module(equations, list(own), dict(zip(own, unknowns, strict=True)))
    return None


def _matching(names: Mapping[int, Sequence[str]]) -> dict[str, int]:
    """An equation for each of as many unknowns as possible, by augmenting paths (Kuhn)."""
    owner: dict[str, int] = {}

    def augment(k: int, seen: set[str]) -> bool:
        for name in names[k]:
            if name in seen:
                continue
            seen.add(name)
            if name not in owner or augment(owner[name], seen):
                owner[name] = k
                return True
        return False

    for k in names:
        augment(k, set())
    return owner


def _module(equations: Sequence[Polynomial], members: list[int], unknown_of: dict[int, str]) -> Module:
    own = tuple(equations[k] for k in members)
    ring = own[0].ring
    unknowns = sorted((unknown_of[k] for k in members), key=ring.index)
    used = {name for p in own for name in p.variables}
    return Module(own, tuple(unknowns), tuple(n for n in ring.names if n in used and n not in unknowns))
