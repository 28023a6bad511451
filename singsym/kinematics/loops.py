"""Independent loops of a mechanism and the way to its output, with the sign of every joint.

Source: Davies, Mech. Mach. Theory 16 (1981) 171-183 (Kirchhoff's circulation law for mechanisms).
"""

from __future__ import annotations

from collections.abc import Sequence

import networkx

from singsym.mechanism.model import Joint, Mechanism

SignedJoint = tuple[Joint, int]
"""A joint and +1 where the way goes from its first link to its second, else -1."""


def _bipartite(mechanism: Mechanism) -> networkx.Graph:
    """Links and joints as nodes: a simple graph also where several joints connect the same two links."""
    graph = networkx.Graph()
    graph.add_nodes_from(("link", link.name) for link in mechanism.links)
    for joint in mechanism.joints:
        graph.add_edge(("link", joint.first), ("joint", joint.name))
        graph.add_edge(("joint", joint.name), ("link", joint.second))
    return graph


def _signed(mechanism: Mechanism, nodes: Sequence[tuple[str, str]]) -> tuple[SignedJoint, ...]:
    found = []
    for i, (kind, name) in enumerate(nodes):
        if kind != "joint":
            continue
        joint = mechanism.joint(name)
        before = nodes[i - 1][1]
        found.append((joint, 1 if before == joint.first else -1))
    return tuple(found)


def loops(mechanism: Mechanism) -> tuple[tuple[SignedJoint, ...], ...]:
    """A shortest cycle basis, each loop starting at the link that comes first in the mechanism.

    >>> from singsym.mechanism import load
    >>> [[joint.name for joint, _ in loop] for loop in loops(load("fourbar"))]
    [['A', 'B', 'C', 'D']]
    """
    graph = _bipartite(mechanism)
    order = {("link", link.name): i for i, link in enumerate(mechanism.links)}
    positions = {joint.name: i for i, joint in enumerate(mechanism.joints)}
    found = []
    for nodes in networkx.minimum_cycle_basis(graph):
        ring = [node for edge in networkx.find_cycle(graph.subgraph(nodes)) for node in edge[:1]]
        start = min((n for n in ring if n[0] == "link"), key=order.__getitem__)
        i = ring.index(start)
        ring = [*ring[i:], *ring[:i]]
        if positions[ring[-1][1]] < positions[ring[1][1]]:
            ring = [ring[0], *reversed(ring[1:])]
        found.append(_signed(mechanism, ring))
    return tuple(sorted(found, key=lambda loop: [positions[joint.name] for joint, _ in loop]))


def path(mechanism: Mechanism, link: str) -> tuple[SignedJoint, ...]:
    """The shortest way from the ground to a link.

    >>> from singsym.mechanism import load
    >>> [(joint.name, sign) for joint, sign in path(load("2r"), "BC")]
    [('A', 1), ('B', 1)]
    """
    nodes = networkx.shortest_path(_bipartite(mechanism), ("link", mechanism.ground), ("link", link))
    return _signed(mechanism, nodes)
