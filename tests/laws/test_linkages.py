"""Laws on random planar linkages with integer lengths: the exact classes against closed-form geometry.

Source: the definitions of section 2.2 of Zlatanov, Fenton, Benhabib (1998); see `linkage`.
"""

from __future__ import annotations

import importlib.util
import sys
from collections import Counter
from collections.abc import Sequence
from math import atan2, pi
from pathlib import Path

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from singsym.classes.classify import classify
from singsym.classes.result import Classification, Configuration
from singsym.mechanism import Mechanism, load, loads

_spec = importlib.util.spec_from_file_location("linkage", Path(__file__).with_name("linkage.py"))
assert _spec is not None
assert _spec.loader is not None
linkage = importlib.util.module_from_spec(_spec)
sys.modules["linkage"] = linkage
_spec.loader.exec_module(linkage)

Points = dict[str, tuple[float, float]]
lengths = st.integers(1, 6)
few = settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)


def pins(w: Configuration, names: str) -> Points:
    return {name: (float(w.points[f"{name}.x"]), float(w.points[f"{name}.y"])) for name in names}


def agree(
    result: Classification,
    found: dict[frozenset[str], int],
    everywhere: set[frozenset[str]],
) -> None:
    """The classes of a classification against singular configurations counted by types, and generic ones.

    everywhere: the types seen at generic configurations, which belong to classes of positive dimension.
    """
    assert not result.undecided
    exact = {frozenset(c.types.names): c for c in result.classes if c.verdict.is_yes}
    assert set(exact) == (set(found) | everywhere) - {frozenset()}
    for kinds, c in exact.items():
        assert (c.dimension == 0) == (kinds not in everywhere)
        if c.dimension == 0:
            assert c.points == found[kinds]


def four_bar(g: int, a: int, b: int, c: int, output: str) -> Mechanism:
    text = f"""
name = "random"
inputs = ["A"]
output = {{ rate = "{output}" }}
[links]
ground = {{ points = {{ A = [0, 0], D = [{g}, 0] }} }}
AB = {a}
BC = {b}
CD = {c}
[joints]
A = "R"
B = "R"
C = "R"
D = "R"
"""
    return loads(text)


def longest_fits(sides: Sequence[int]) -> bool:
    return 2 * max(sides) < sum(sides)


@few
@given(st.tuples(lengths, lengths, lengths, lengths).filter(longest_fits), st.sampled_from("ABCD"))
def test_four_bars(sides: tuple[int, int, int, int], output: str) -> None:
    g, a, b, c = sides
    bar = linkage.FourBar(g, a, b, c)
    result = classify(four_bar(g, a, b, c, output), cache=False)

    def kinds(at: Points) -> frozenset[str]:
        L = linkage.velocity_matrix(at, ["ABCD"], "ABCD", ["A"], [output])
        return linkage.types(L, 1)

    generic = [p for angle in linkage.turns(90) for p in (*bar.at_crank(angle), *bar.at_follower(angle))]
    everywhere = {kinds(p) for p in generic}
    special = bar.critical()
    if output in "BC":
        special += coupler_critical(bar, output)
    counted = Counter(map(kinds, linkage.distinct(special)))
    agree(result, counted, everywhere)
    for cl in result.classes:
        for w in cl.witnesses:
            assert kinds(pins(w, "ABCD")) == frozenset(cl.types.names)


def coupler_critical(bar: linkage.FourBar, output: str) -> list[Points]:
    """Where the relative rate at B (at C) stands still: A, C, D (A, B, D) in line."""
    found = []
    if output == "B":
        for angle in (0.0, pi):
            found += bar.at_follower(angle)
    else:
        for angle in (0.0, pi):
            found += bar.at_crank(angle)
    return found


@pytest.mark.slow
@settings(few, max_examples=6)
@given(
    st.tuples(lengths, lengths, lengths, lengths).filter(longest_fits),
    st.tuples(lengths, lengths, lengths, lengths).filter(longest_fits),
)
def test_two_four_bars_in_series(first: tuple[int, int, int, int], second: tuple[int, int, int, int]) -> None:
    """Six-bars: the follower DC of one carries the crank DE of the other, E on the line DC."""
    one = linkage.FourBar(*first)
    two = linkage.FourBar(*second, A=one.D)
    mechanism = loads(f"""
name = "random"
inputs = ["A"]
output = {{ rate = "G" }}
[links]
ground = {{ points = {{ A = [0, 0], D = [{first[0]}, 0], G = [{first[0] + second[0]}, 0] }} }}
AB = {first[1]}
BC = {first[2]}
rocker = {{ points = {{ D = [0, 0], C = [{first[3]}, 0], E = [{second[1]}, 0] }} }}
EF = {second[2]}
FG = {second[3]}
[joints]
A = "R"
B = "R"
C = "R"
D = "R"
E = "R"
F = "R"
G = "R"
""")

    def kinds(at: Points) -> frozenset[str]:
        L = linkage.velocity_matrix(at, ["ABCD", "DEFG"], "ABCDEFG", ["A"], ["G"])
        return linkage.types(L, 1)

    def rocker(p: Points, end: str, base: str) -> float:
        return float(atan2(p[end][1] - p[base][1], p[end][0] - p[base][0]))

    def joined(p: Points, q: Points) -> Points:
        return {**p, "E": q["B"], "F": q["C"], "G": q["D"]}

    special, generic = [], []
    for p in one.critical():
        special += [joined(p, q) for q in two.at_crank(rocker(p, "C", "D"))]
    for q in two.critical():
        special += [joined(p, q) for p in one.at_follower(rocker(q, "B", "A"))]
    for angle in linkage.turns(60):
        for p in one.at_crank(angle) + one.at_follower(angle):
            generic += [joined(p, q) for q in two.at_crank(rocker(p, "C", "D"))]
        for q in two.at_follower(angle):
            generic += [joined(p, q) for p in one.at_follower(rocker(q, "B", "A"))]
    # an empty configuration space takes its proof of emptiness minutes
    assume(generic or special)
    result = classify(mechanism, cache=False)
    agree(result, Counter(map(kinds, linkage.distinct(special))), {kinds(p) for p in generic})


@pytest.mark.slow
@settings(few, max_examples=3)
@given(st.tuples(*[st.integers(1, 3)] * 5).filter(longest_fits))
def test_five_bars_against_dense_sampling(sides: tuple[int, ...]) -> None:
    """Two cranks turned over a grid: where a signed area changes sign, a class is there and declared."""
    l1, l2, l3, l4, d = sides
    still, dead = frozenset({"RI", "IO"}), frozenset({"RO", "II"})
    seen: set[frozenset[str]] = set()
    changed: set[int] = set()
    for E in linkage.turns(90):
        D = linkage.on_circle((float(d), 0.0), l4, E)
        before: list[tuple[bool, bool]] | None = None
        for A in linkage.turns(90):
            B = linkage.on_circle((0.0, 0.0), l1, A)
            ends = linkage.circles(B, l2, D, l3)
            now = [(area((0.0, 0.0), B, C) > 0, area((float(d), 0.0), D, C) > 0) for C in ends]
            if before is not None and len(now) != len(before):
                seen.add(dead)
            elif before is not None and now != before:
                seen.add(still)
                changed |= {i for p, q in zip(before, now, strict=True) for i in (0, 1) if p[i] != q[i]}
            before = now
    # a locus without real points takes its proof minutes
    assume(changed == {0, 1} and dead in seen)
    result = classify(load("five-bar").with_parameters(l1=l1, l2=l2, l3=l3, l4=l4, d=d), cache=False)
    assert not result.undecided
    occurring = {frozenset(c.types.names) for c in result.classes if c.verdict.is_yes}
    assert seen <= occurring
    for cl in result.classes:
        for w in cl.witnesses:
            L = linkage.end_point_matrix(pins(w, "ABCDE"))
            assert linkage.types(L, 2) == frozenset(cl.types.names)


def area(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
