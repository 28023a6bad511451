"""Independent loops of a mechanism and the way to its output, with the sign of every joint.

Source: Davies, Mech. Mach. Theory 16 (1981) 171-183 (Kirchhoff's circulation law for mechanisms).
"""

from __future__ import annotations

from collections.abc import Sequence

import networkx

from singsym.mechanism.model import Joint, JointKind, Mechanism

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
    """A shortest way from the ground to a link, of several the one through most inputs.

    Raises `ValueError` for a link that is not attached.

    >>> from singsym.mechanism import load
    >>> [(joint.name, sign) for joint, sign in path(load("2r"), "BC")]
    [('A', 1), ('B', 1)]
    """
    graph = _bipartite(mechanism)
    start, end = ("link", mechanism.ground), ("link", link)
    if end not in graph or not networkx.has_path(graph, start, end):
        raise ValueError(f"link {link!r} is not attached to the ground by joints")
    ways = [_signed(mechanism, nodes) for nodes in networkx.all_shortest_paths(graph, start, end)]
    return min(ways, key=lambda way: _rank(mechanism, way))


def point_path(mechanism: Mechanism, link: str, point: str) -> tuple[SignedJoint, ...]:
    """The best way to any of the links that are pinned together at a point: it has one velocity.

    >>> from singsym.mechanism import load
    >>> [joint.name for joint, _ in point_path(load("zlatanov-2dof"), "CG", "G")]
    ['E', 'F']
    """
    pins = networkx.Graph()
    pins.add_node((link, point))
    for joint in mechanism.joints:
        if joint.kind in (JointKind.R, JointKind.U, JointKind.S):
            pins.add_edge((joint.first, joint.at[0]), (joint.second, joint.at[1]))
    owners = sorted({owner for owner, _ in networkx.node_connected_component(pins, (link, point))})
    return min((path(mechanism, owner) for owner in owners), key=lambda way: _rank(mechanism, way))


def _rank(mechanism: Mechanism, way: Sequence[SignedJoint]) -> tuple[int, int, list[int]]:
    """Short ways first, then those through many inputs, then by the order of joints."""
    active = sum(c in mechanism.inputs for joint, _ in way for c in joint.columns)
    order = {joint.name: i for i, joint in enumerate(mechanism.joints)}
    return len(way), -active, [order[joint.name] for joint, _ in way]
