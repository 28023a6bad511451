"""What must hold of a mechanism before anything is computed from it.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.1 (as many inputs and outputs as the mobility n).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from difflib import get_close_matches

import networkx
import sympy

from singsym.mechanism.choices import balance, is_redundant
from singsym.mechanism.couplings import check_couplings, is_sliding
from singsym.mechanism.expressions import expression, is_angle
from singsym.mechanism.model import (
    Joint,
    JointKind,
    JointRate,
    Mechanism,
    Output,
    Space,
    Twist,
    Vector,
)
from singsym.mechanism.outputs import TWISTS, coordinates
from singsym.mechanism.problems import MechanismError, Problem, shorten
from singsym.mechanism.reader import NOT_ALGEBRAIC

_KINDS = {
    Space.PLANAR: (JointKind.R, JointKind.P),
    Space.SPHERICAL: (JointKind.R,),
    Space.SPATIAL: tuple(JointKind),
}
MAX_JOINTS = 500
_PINNED = (JointKind.R, JointKind.U, JointKind.S)

Finding = tuple[str, str, str, str]


def check(mechanism: Mechanism, redundant: bool = False) -> tuple[Problem, ...]:
    """Every problem that shows without kinematics; an empty tuple where there is none.

    redundant: serial chains may have more inputs than output components, as `conditions` alone allows.

    >>> from singsym.mechanism import load
    >>> check(load("fourbar"))
    ()
    """
    found = [*_names(mechanism), *_joints(mechanism), *_parameters(mechanism)]
    if not found:
        # What follows looks names up and puts parameters in, so it needs those to be right.
        found = [
            *_graph(mechanism),
            *_shared_points(mechanism),
            *_inputs(mechanism),
            *_outputs(mechanism, redundant),
            *check_couplings(mechanism),
        ]
        found += [*_dimensions(mechanism.resolved), *_exclusions(mechanism), *_translating(mechanism)]
        if not found:
            found = [*_axes(mechanism.resolved), *_loops(mechanism.resolved)]
    return tuple(Problem(*f, file=mechanism.origin) for f in found)


def _listed(names: Iterable[str]) -> str:
    every = list(names)
    return (", ".join(every) if len(every) <= 24 else f"{', '.join(every[:24])}, ...") or "none"


def _suggest(name: str, names: Iterable[str]) -> str:
    close = get_close_matches(name, list(names), 1)
    return f"did you mean {close[0]!r}?" if close else ""


def _names(mechanism: Mechanism) -> Iterator[Finding]:
    groups = {
        "links": [link.name for link in mechanism.links],
        "joints": [joint.name for joint in mechanism.joints],
        "parameters": [parameter.name for parameter in mechanism.parameters],
    }
    for place, names in groups.items():
        for name, count in Counter(names).items():
            if count > 1:
                yield f"{place}.{name}", f"{count} {place} of this name", "each name once", ""
    if not groups["links"]:
        yield "links", "no links", "a table [links], and [joints] between them", "see `singsym new`"
    elif mechanism.ground not in groups["links"]:
        advice = 'name the fixed link "ground", or say ground = "NAME"'
        expected = f"a link among {_listed(groups['links'])}"
        yield "ground", f"no link {mechanism.ground!r}", expected, advice
    if not 0 < len(mechanism.joints) <= MAX_JOINTS:
        yield "joints", f"{len(mechanism.joints)} joints", f"from 1 to {MAX_JOINTS}", ""


def _joints(mechanism: Mechanism) -> Iterator[Finding]:
    links = {link.name: link for link in mechanism.links}
    for joint in mechanism.joints:
        place = f"joints.{joint.name}"
        unknown = [name for name in (joint.first, joint.second) if name not in links]
        for name in unknown:
            yield place, f"the unknown link {name!r}", f"a link among {_listed(links)}", _suggest(name, links)
        if joint.first == joint.second:
            yield place, f"the link {joint.first!r} twice", "two links", ""
        allowed = _KINDS[mechanism.space]
        if joint.kind not in allowed:
            expected = f"one of {' '.join(allowed)} in a {mechanism.space} mechanism"
            yield place, f"a joint of type {joint.kind}", expected, ""
        if unknown:
            continue
        for name, point in zip((joint.first, joint.second), joint.at, strict=True):
            known = links[name].points
            if point not in known:
                expected = f"a point of it: {_listed(known)}"
                yield f"{place}.at", f"no point {point!r} in link {name!r}", expected, _suggest(point, known)
        yield from _joint_axes(joint, mechanism)


def _joint_axes(joint: Joint, mechanism: Mechanism) -> Iterator[Finding]:
    needed = joint.kind is JointKind.P or (
        mechanism.space is not Space.PLANAR and joint.kind is not JointKind.S
    )
    if needed and joint.axes is None:
        yield f"joints.{joint.name}", "no axis", f"the axis of a joint {joint.kind}", 'write axis = "NAME"'
    for key, pair in (("axis", joint.axes), ("reference", joint.reference)):
        for name, axis in zip((joint.first, joint.second), pair or (), strict=bool(pair)):
            known = mechanism.link(name).axes
            if axis not in known:
                place, found = f"joints.{joint.name}.{key}", f"no axis {axis!r} in link {name!r}"
                unit = ", ".join(["1", "0", "0"][: 2 if mechanism.space is Space.PLANAR else 3])
                advice = _suggest(axis, known) or f"give the link axes = {{ {shorten(axis)} = [{unit}] }}"
                yield place, found, f"an axis of it: {_listed(known)}", advice


def _parameters(mechanism: Mechanism) -> Iterator[Finding]:
    advice = "give it a value, or a range to keep it symbolic"
    for p in mechanism.parameters:
        if p.value is None and p.low is None and p.high is None:
            yield f"parameters.{p.name}", "neither value nor range", "value or between = [low, high]", advice
    try:
        values, resolved = mechanism.values, mechanism.resolved
    except MechanismError as error:
        yield from ((e.place, e.found, e.expected, e.advice) for e in error.problems)
        return
    names = {p.name for p in mechanism.parameters}
    for p in mechanism.parameters:
        place = f"parameters.{p.name}"
        value = sympy.Symbol(p.name).xreplace(values)
        low, high = (None if b is None else expression(b, names).xreplace(values) for b in (p.low, p.high))
        below = low is not None and (value - low).is_positive is False
        above = high is not None and (high - value).is_positive is False
        if p.value is not None and (below or above):
            bounds = (f"{word} {b}" for word, b in (("above", low), ("below", high)) if b is not None)
            yield place, f"the value {value}", f"a value {' and '.join(bounds)}", ""
        elif p.value is None and low is not None and high is not None and (high - low).is_positive is False:
            yield place, f"the range from {low} to {high}", "the lower bound first", ""
    symbols = {sympy.Symbol(p.name) for p in resolved.parameters}
    depends = networkx.DiGraph()
    for p in resolved.parameters:
        for bound in (p.low, p.high):
            if bound is not None:
                depends.add_edges_from((p.name, str(s)) for s in bound.free_symbols)
                if fault := _fault(bound, symbols):
                    yield f"parameters.{p.name}.between", *fault
    if not networkx.is_directed_acyclic_graph(depends):
        found = " -> ".join(edge[0] for edge in networkx.find_cycle(depends))
        yield "parameters", f"ranges in a circle: {found}", "ranges that do not depend on each other so", ""


def _fault(value: sympy.Expr, symbols: set[sympy.Symbol]) -> tuple[str, str, str] | None:
    """Why an expression cannot enter the algebra: unknown names, not real and algebraic, no polynomial."""
    unknown = sorted(str(s) for s in value.free_symbols - symbols)
    if unknown:
        return f"the unknown name {unknown[0]!r}", f"a parameter among {_listed(map(str, symbols))}", ""
    if value.has(sympy.pi) and not value.is_algebraic and not _algebraic_parts(value):
        return shorten(value), NOT_ALGEBRAIC, "use pi and deg inside sin and cos"
    circular = (f for f in value.atoms(sympy.sin, sympy.cos) if f.args[0].is_number)
    if wrong := next((f for f in circular if not is_angle(f.args[0])), None):
        return shorten(wrong), NOT_ALGEBRAIC, "write degrees as 40 deg"
    if value.has(sympy.zoo, sympy.nan):
        return "a division by zero", "a number", "see the values of its parameters"
    if value.has(sympy.oo, sympy.Float) or value.is_real is False:
        return shorten(value), NOT_ALGEBRAIC, ""
    if symbols and not value.is_polynomial(*symbols):
        names = _listed(sorted(map(str, value.free_symbols)))
        advice = "give that parameter a value, or introduce another parameter for the quotient or root"
        return shorten(value), f"a polynomial in {names}, which stays symbolic", advice
    return None


def _algebraic_parts(value: sympy.Expr) -> bool:
    """Whether pi stands only inside sine and cosine."""
    if value.func in (sympy.sin, sympy.cos):
        return bool(value.is_number)
    return value is not sympy.pi and all(_algebraic_parts(a) for a in value.args)


def _dimensions(mechanism: Mechanism) -> Iterator[Finding]:
    symbols = {sympy.Symbol(p.name) for p in mechanism.parameters}
    size = 2 if mechanism.space is Space.PLANAR else 3
    for link in mechanism.links:
        for key, named in (("points", link.points), ("axes", link.axes)):
            for name, vector in named.items():
                place = f"links.{link.name}.{key}.{name}"
                if len(vector) != size:
                    yield place, f"{len(vector)} coordinates", f"{size} in a {mechanism.space} mechanism", ""
                for value in vector:
                    if fault := _fault(value, symbols):
                        yield place, *fault
    for joint in mechanism.joints:
        if joint.pitch is not None and (fault := _fault(joint.pitch, symbols)):
            yield f"joints.{joint.name}.pitch", *fault
    for place, values in _bounds(mechanism):
        for value in values:
            if value is not None and (fault := _fault(value, symbols | _quantities(value))):
                yield place, *fault


def _bounds(mechanism: Mechanism) -> Iterator[tuple[str, tuple[sympy.Expr | None, ...]]]:
    """Expressions of limits, exclusions and couplings, with their places."""
    for limit in mechanism.limits:
        yield f"limits.{limit.expression}", (limit.expression, limit.low, limit.high)
    for exclusion in mechanism.exclusions:
        yield f"exclusions.{exclusion.words}", (exclusion.expression,)
    for coupling in mechanism.couplings:
        if coupling.lift is not None or is_sliding(mechanism, coupling):
            yield f"couplings.{coupling.name}.constant", (coupling.constant,)
            yield f"couplings.{coupling.name}.lift", (coupling.lift,)


def _quantities(value: sympy.Expr) -> set[sympy.Symbol]:
    """Coordinates and joint quantities: names with a dot or a parenthesis."""
    return {s for s in value.free_symbols if "." in s.name or "(" in s.name}


def _vanishes(value: sympy.Expr) -> bool:
    """Whether an expression is zero: by expansion, else to 60 digits (dimensions typed in a file)."""
    expanded = sympy.expand(value)
    if expanded.is_number and not expanded.is_Rational:
        return bool(abs(sympy.N(expanded, 80)) < sympy.Float("1e-60"))
    return bool(expanded == 0)


def _dot(a: Vector, b: Vector) -> sympy.Expr:
    return sympy.Add(*(x * y for x, y in zip(a, b, strict=True)))


def _axes(mechanism: Mechanism) -> Iterator[Finding]:
    for link in mechanism.links:
        for name, vector in link.axes.items():
            place, found = f"links.{link.name}.axes.{name}", f"[{', '.join(map(str, vector))}]"
            square = _dot(vector, vector)
            if all(_vanishes(x) for x in vector):
                yield place, f"the zero vector {found}", "a unit vector", ""
            elif not _vanishes(square - 1):
                advice = "divide it by its length, as [3/5, 4/5]"
                yield place, f"{found}, of squared length {sympy.expand(square)}", "a unit vector", advice
    for joint in mechanism.joints:
        if joint.reference is None or joint.axes is None:
            continue
        for name, axis, zero in zip((joint.first, joint.second), joint.axes, joint.reference, strict=True):
            axes = mechanism.link(name).axes
            if not _vanishes(_dot(axes[axis], axes[zero])):
                place, found = f"joints.{joint.name}.reference", f"{zero!r} in link {name!r}"
                yield place, found, f"a direction at right angles to {axis!r}", ""


def _graph(mechanism: Mechanism) -> Iterator[Finding]:
    reached = networkx.node_connected_component(mechanism.graph, mechanism.ground)
    apart = [link.name for link in mechanism.links if link.name not in reached]
    for name in apart:
        lonely = mechanism.graph.degree(name) == 0
        found = "no joint at this link" if lonely else "no chain of joints to the ground"
        yield f"links.{name}", found, f"joints that connect it to {mechanism.ground!r}", ""


def _shared_points(mechanism: Mechanism) -> Iterator[Finding]:
    """The same name in two links must be the same point of space, held together by R, U or S joints."""
    held = networkx.Graph()
    held.add_nodes_from((link.name, point) for link in mechanism.links for point in link.points)
    held.add_edges_from(
        ((j.first, j.at[0]), (j.second, j.at[1])) for j in mechanism.joints if j.kind in _PINNED
    )
    group = {node: i for i, nodes in enumerate(networkx.connected_components(held)) for node in nodes}
    seen: dict[str, tuple[str, str]] = {}
    for node in held:
        link, point = node
        first = seen.setdefault(point, node)
        if group[first] != group[node]:
            found = (
                f"the point {point!r}, which link {first[0]!r} has too, with no R, U or S joint between them"
            )
            advice = f'rename one of them; a joint takes both names as at = ["{point}", "OTHER"]'
            yield f"links.{link}.points", found, "one name for one point of space", advice


def _inputs(mechanism: Mechanism) -> Iterator[Finding]:
    columns = mechanism.columns
    for label, count in Counter(mechanism.inputs).items():
        if label not in columns:
            expected = f"a joint freedom among {_listed(columns)}"
            yield "inputs", f"the unknown {label!r}", expected, _suggest(label, columns)
        if count > 1:
            yield "inputs", f"{label!r} {count} times", "each freedom once", ""
    if not mechanism.inputs:
        yield "inputs", "no inputs", "as many as the mobility", 'write inputs = ["A"]'
    elif len(mechanism.inputs) != mechanism.n:
        expected = f"{mechanism.n}, the mobility stated"
        yield "inputs", f"{len(mechanism.inputs)} inputs", expected, "change inputs or mobility"


def _translating(mechanism: Mechanism) -> Iterator[Finding]:
    moving = [link.name for link in mechanism.links if link.name != mechanism.ground]
    for name in mechanism.translating:
        if name not in moving:
            yield "translating", repr(name), f"links among {_listed(moving)}", _suggest(name, moving)


def _outputs(mechanism: Mechanism, redundant: bool) -> Iterator[Finding]:
    if not mechanism.outputs:
        yield "output", "no output", f"{mechanism.n} components", 'write output = { velocity = "POINT" }'
        return
    for output in mechanism.outputs:
        yield from _output(output, mechanism)
    count = mechanism.output_size
    if mechanism.n and count != mechanism.n and not (redundant and is_redundant(mechanism)):
        found = f"{count} output component{'s' * (count != 1)}"
        yield "output", found, f"{mechanism.n}, as many as inputs", balance(mechanism)


def _output(output: Output, mechanism: Mechanism) -> Iterator[Finding]:
    if isinstance(output, JointRate):
        if output.column not in mechanism.columns:
            expected = f"a joint freedom among {_listed(mechanism.columns)}"
            yield "output.rate", repr(output.column), expected, _suggest(output.column, mechanism.columns)
        return
    links = {link.name: link for link in mechanism.links}
    if output.link not in links:
        yield "output", f"the unknown link {output.link!r}", f"a link among {_listed(links)}", ""
    elif output.point not in links[output.link].points:
        known = _listed(links[output.link].points)
        yield "output", f"no point {output.point!r} in link {output.link!r}", f"a point of it: {known}", ""
    known_components = TWISTS[mechanism.space] if isinstance(output, Twist) else coordinates(mechanism.space)
    for component in output.components:
        if component not in known_components:
            yield "output.components", repr(component), f"components among {_listed(known_components)}", ""
    if len(set(output.components)) < len(output.components):
        yield "output.components", _listed(output.components), "each component once", ""


def _exclusions(mechanism: Mechanism) -> Iterator[Finding]:
    points = {point for link in mechanism.links for point in link.points}
    for exclusion in mechanism.exclusions:
        place = f"exclusions.{exclusion.words}"
        if exclusion.kind not in ("coincide", "zero"):
            yield place, exclusion.kind, "coincide or zero", ""
        for point in exclusion.points:
            if point not in points:
                expected = f"a point among {_listed(sorted(points))}"
                yield place, f"the unknown point {point!r}", expected, _suggest(point, points)
        if exclusion.kind == "coincide" and len(set(exclusion.points)) != 2:
            yield place, _listed(exclusion.points), "two points", ""


def _loops(mechanism: Mechanism) -> Iterator[Finding]:
    """A closed polygon of links needs its longest side no longer than the others together."""
    for polygon in _polygons(mechanism):
        sides = {}
        for name, ends in polygon.items():
            points = mechanism.link(name).points
            difference = tuple(x - y for x, y in zip(*(points[end] for end in ends), strict=True))
            sides[name] = sympy.sqrt(sympy.expand(_dot(difference, difference)))
        if any(side.free_symbols for side in sides.values()):
            continue
        longest = max(sides, key=lambda name: sympy.N(sides[name]))
        excess = sides[longest] - sympy.Add(*(s for name, s in sides.items() if name != longest))
        if sympy.N(excess, 30) > sympy.Float("1e-20"):
            found = ", ".join(f"{name} {_short(side)}" for name, side in sorted(sides.items()))
            expected = "lengths of which none exceeds the sum of the others"
            yield "links", f"the loop {found}", expected, f"{longest} is too long for the loop to close"


def _polygons(mechanism: Mechanism) -> list[dict[str, tuple[str, str]]]:
    """The shortest loop of R, U, S joints through each joint: link -> the two points where it is joined."""
    graph = networkx.Graph()
    for joint in mechanism.joints:
        if joint.kind in _PINNED:
            graph.add_edge(("link", joint.first), ("joint", joint.name))
            graph.add_edge(("link", joint.second), ("joint", joint.name))
    polygons: dict[frozenset[str], dict[str, tuple[str, str]]] = {}
    joints = {joint.name: joint for joint in mechanism.joints}
    for joint in mechanism.joints:
        node = ("joint", joint.name)
        if node not in graph:
            continue
        rest = networkx.restricted_view(graph, [node], [])
        try:
            path = networkx.shortest_path(rest, ("link", joint.first), ("link", joint.second))
        except networkx.NetworkXNoPath:
            continue
        cycle = [joint.name, *(name for kind, name in path if kind == "joint"), joint.name]
        names = [name for kind, name in path if kind == "link"]
        polygons[frozenset(cycle)] = {
            name: (_end(joints[cycle[i]], name), _end(joints[cycle[i + 1]], name))
            for i, name in enumerate(names)
        }
    return list(polygons.values())


def _end(joint: Joint, link: str) -> str:
    """The joint's point in this link."""
    return joint.at[0] if joint.first == link else joint.at[1]


def _short(value: sympy.Expr) -> str:
    """A length in a message: exact where that is short."""
    text = str(value)
    return text if len(text) <= 12 else str(sympy.N(value, 6))
