"""Mechanisms drawn at random, general ones and degenerate ones: equal lengths, kites, exact sums, no offsets.

Source: textbook architectures; the dimensions are drawn.
"""

from __future__ import annotations

import cmath
from collections.abc import Mapping, Sequence
from random import Random

from singsym.mechanism import Mechanism, define

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]


def lengths(random: Random, count: int) -> list[int]:
    """Side lengths of a polygon that closes: any, equal in pairs, all equal, or one that may lie flat."""
    while True:
        kind = random.choice(["any", "any", "rhombus", "kite", "parallelogram", "flat", "stretched"])
        found = [random.randint(1, 6) for _ in range(count)]
        if kind == "rhombus":
            found = [found[0]] * count
        elif kind == "kite":
            found = sorted(found[: count // 2] * 2 + found[: count % 2])
        elif kind == "parallelogram":
            found = (found[: (count + 1) // 2] * 2)[:count]
        elif kind == "flat":
            found[0] = found[-1] + sum(found[1:-1]) - 2 * found[1]
        elif kind == "stretched":
            found[0] = sum(found[1:])
        if min(found) > 0 and 2 * max(found) <= sum(found):
            return found


def table(
    name: str,
    links: Mapping[str, object],
    joints: Mapping[str, object] | Sequence[str],
    inputs: Sequence[str],
    output: object,
    space: str = "planar",
    **more: object,
) -> Mechanism:
    """A mechanism from the parts of its file; joints that are only named are of type R."""
    kinds = joints if isinstance(joints, Mapping) else dict.fromkeys(joints, "R")
    data = {"name": name, "space": space, "inputs": list(inputs), "output": output}
    return define(**data, links=dict(links), joints=dict(kinds), **more)


def four_bar(random: Random) -> Mechanism:
    g, a, b, c = lengths(random, 4)
    links = {"ground": {"points": {"A": [0, 0], "D": [g, 0]}}, "AB": a, "BC": b, "CD": c}
    return table("four-bar", links, "ABCD", [random.choice("AB")], {"rate": random.choice("DC")})


def slider_crank(random: Random) -> Mechanism:
    """Crank AB, rod BC, slider at C along the x-axis or beside it; often r = l, without an offset."""
    r, l = random.randint(1, 3), random.randint(1, 4)
    offset = random.choice([0, 0, 1, 2, r + l])
    links = {
        "ground": {"points": {"A": [0, 0], "O": [0, offset]}, "axes": {"x": [1, 0]}},
        "AB": r,
        "BC": l,
        "block": {"points": {"C": [0, 0]}, "axes": {"x": [1, 0]}},
    }
    slide = {"type": "P", "links": ["ground", "block"], "at": ["O", "C"], "axis": "x"}
    given, shown = random.choice([("A", "P"), ("P", "A")])
    return table("slider-crank", links, {"A": "R", "B": "R", "C": "R", "P": slide}, [given], {"rate": shown})


def five_bar(random: Random) -> Mechanism:
    g, a, b, c, d = lengths(random, 5)
    links = {"ground": {"points": {"A": [0, 0], "E": [g, 0]}}, "AB": a, "BC": b, "CD": c, "DE": d}
    return table("five-bar", links, "ABCDE", ["A", "E"], {"velocity": "C"})


def six_bar(random: Random) -> Mechanism:
    """A four-bar linkage whose rocker, or coupler, drives a second loop."""
    g, a, b, c = lengths(random, 4)
    h, d, e, f = lengths(random, 4)
    if random.random() < 0.5:
        ground = {"points": {"A": [0, 0], "D": [g, 0], "G": [g + h, 0]}}
        links = {
            "ground": ground,
            "AB": a,
            "BC": b,
            "rocker": {"points": {"D": [0, 0], "C": [c, 0], "E": [0, d]}},
        }
    else:
        ground = {"points": {"A": [0, 0], "D": [g, 0], "G": [h, random.randint(-3, 3)]}}
        links = {
            "ground": ground,
            "AB": a,
            "CD": c,
            "coupler": {"points": {"B": [0, 0], "C": [b, 0], "E": [1, d]}},
        }
    return table("six-bar", {**links, "EF": e, "FG": f}, "ABCDEFG", ["A"], {"rate": "G"})


def spherical_four_bar(random: Random) -> Mechanism:
    arcs = [30 * min(x, 5) for x in lengths(random, 4)]
    links: dict[str, object] = {
        name: f"{arc} deg" for name, arc in zip(("AB", "BC", "CD"), arcs[1:], strict=True)
    }
    links["ground"] = {"arc": f"{arcs[0]} deg", "axes": ["A", "D"]}
    return table("spherical four-bar", links, "ABCD", ["A"], {"rate": random.choice("BD")}, "spherical")


def three_legs(random: Random, congruent: bool) -> tuple[dict[str, object], dict[str, list[int]]]:
    """Ground and platform with three feet each: the same triangle, part of a unit square, or another."""
    feet = random.choice([SQUARE[:3], [[0, 0], [2, 0], [1, 2]], [[0, 0], [3, 0], [1, 0]]])
    other = feet if congruent else [[0, 0], [1, 0], [random.randint(0, 1), random.randint(1, 2)]]
    ground = {f"A{i}": x for i, x in enumerate(feet, 1)}
    return {"ground": {"points": ground}}, {f"C{i}": x for i, x in enumerate(other, 1)}


def three_rrr(random: Random) -> Mechanism:
    """Legs of two bars each, equal lengths as often as not."""
    links, platform = three_legs(random, random.random() < 0.7)
    bar, rod = random.randint(1, 2), random.randint(1, 2)
    for i in "123":
        links |= {f"A{i}B{i}": bar, f"B{i}C{i}": rod}
    links["platform"] = {"points": platform}
    joints = [f"{x}{i}" for x in "ABC" for i in "123"]
    return table("3-RRR", links, joints, ["A1", "A2", "A3"], {"twist": "platform", "at": "C1"})


def three_rpr(random: Random) -> Mechanism:
    """Legs of a length that is not 0."""
    links, platform = three_legs(random, random.random() < 0.7)
    joints: dict[str, object] = {}
    for i in "123":
        links[f"low{i}"] = {"points": {f"A{i}": [0, 0]}, "axes": {f"u{i}": [1, 0]}}
        links[f"high{i}"] = {"points": {f"C{i}": [0, 0]}, "axes": {f"u{i}": [1, 0]}}
        slide = {"type": "P", "links": [f"low{i}", f"high{i}"], "at": [f"A{i}", f"C{i}"], "axis": f"u{i}"}
        joints |= {f"A{i}": "R", f"P{i}": slide, f"C{i}": "R"}
    links["platform"] = {"points": platform}
    apart = {f"leg {i}": {"coincide": [f"A{i}", f"C{i}"]} for i in "123"}
    output = {"twist": "platform", "at": "C1"}
    return table("3-RPR", links, joints, ["P1", "P2", "P3"], output, exclusions=apart)


def dyads(random: Random, loops: int = 2) -> Mechanism:
    """One or two cranks and dyads on them, one loop after the other, that close at some crank angles."""
    while True:
        built = _dyads(random, loops)
        if built is not None:
            return built


def _dyads(random: Random, loops: int) -> Mechanism | None:
    pivots = {"A": [0, 0]}
    if random.random() < 1 / 3:
        pivots["B"] = [random.randint(1, 6), random.choice([0, 0, random.randint(1, 3)])]
    inputs = list(pivots)
    at = {name: complex(*x) for name, x in pivots.items()}
    bars: dict[str, int] = {}
    free = []
    for pivot, tip in zip(inputs, "PQ", strict=False):
        bars[f"{pivot}{tip}"] = random.randint(1, 5)
        at[tip] = at[pivot] + cmath.rect(bars[f"{pivot}{tip}"], random.uniform(-3.1, 3.1))
        free.append(tip)
    for number in range(1, random.randint(1, loops) + 1):
        new = f"C{number}"
        left, right = free[-1] if number > 1 else "P", f"G{number}"
        if number == 1 and "Q" in free:
            right = "Q"
        else:
            pivots[right] = [random.randint(1, 7), random.randint(-2, 3)]
            at[right] = complex(*pivots[right])
        far, l, r = abs(at[right] - at[left]), random.randint(1, 7), random.randint(1, 7)
        if not max(abs(l - r), 1e-9) < far < l + r:
            return None
        along = (far**2 + l**2 - r**2) / (2 * far)
        across = random.choice([1j, -1j]) * (l**2 - along**2) ** 0.5
        at[new] = at[left] + (at[right] - at[left]) / far * (along + across)
        bars |= {f"{left}{new}": l, f"{new}{right}": r}
        free.append(new)
    output: dict[str, object] = {"velocity": free[-1]}
    grounded = [name for name in pivots if name.startswith("G")]
    if len(inputs) == 1:
        sided = {"velocity": free[-1], "components": [random.choice("xy")]}
        output = random.choice([{"rate": grounded[-1]}, sided])
    ends = [end for bar in bars for end in at if bar.startswith(end) or bar.endswith(end)]
    joints = [name for name in at if name in pivots or ends.count(name) > 1]
    return table("linkage", {"ground": {"points": pivots}, **bars}, joints, inputs, output)


KINDS = {
    "four-bar": four_bar,
    "slider-crank": slider_crank,
    "five-bar": five_bar,
    "six-bar": six_bar,
    "spherical four-bar": spherical_four_bar,
    "3-RRR": three_rrr,
    "3-RPR": three_rpr,
    "dyads": dyads,
}
