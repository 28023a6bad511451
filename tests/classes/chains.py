"""Loops in series: four-bars with one input, five-bars with two."""

from __future__ import annotations

from singsym.mechanism import Mechanism, loads


def four_bars(loops: int) -> Mechanism:
    """Four-bars in series: pivots (4 i, i mod 2), crank 2, couplers 4, rockers 3 with an arm [1, 2]."""
    points = ", ".join(f"P{i} = [{4 * i}, {i % 2}]" for i in range(loops + 1))
    lines = [f'name = "chain {loops}"', 'inputs = ["P0"]', f'output = {{ rate = "P{loops}" }}', "[links]"]
    lines += [f"ground = {{ points = {{ {points} }} }}", "P0B1 = 2", f"P{loops}C{loops} = 3"]
    for i in range(1, loops + 1):
        lines.append(f"B{i}C{i} = 4")
        if i < loops:
            lines.append(f"rocker{i} = {{ points = {{ P{i} = [0, 0], C{i} = [3, 0], B{i + 1} = [1, 2] }} }}")
    names = [*(f"P{i}" for i in range(loops + 1)), *(f"{x}{i}" for i in range(1, loops + 1) for x in "BC")]
    return loads("\n".join([*lines, "[joints]", *(f'{name} = "R"' for name in names)]))


def five_bars(loops: int) -> Mechanism:
    """Five-bars in series, each with two moving angles for the next: cranks 2 at A = (0, 0) and E = (3, 0).

    Rods BiCi = 3 and DiCi = 4, one on each side.  Those of one loop are the cranks of the next, whose base
    has no length: both turn about Ci, where they end in arms [1, 2] and [1, -1].  Outputs are the turning of
    the last two rods.
    """
    lines = [f'name = "five-bars {loops}"', 'inputs = ["A", "E"]']
    rods = (f"B{loops}C{loops}", f"C{loops}D{loops}")
    turning = ", ".join(f'{{ twist = "{rod}", components = ["w"] }}' for rod in rods)
    lines += [f"output = [{turning}]", "[links]", "ground = { points = { A = [0, 0], E = [3, 0] } }"]
    lines += ["AB1 = 2", "D1E = 2", f"{rods[0]} = 3", f"{rods[1]} = 4"]
    for i in range(1, loops):
        for side, length, x, y in (("B", 3, 4, 2), ("D", 4, 5, -1)):
            points = f"{side}{i} = [0, 0], C{i} = [{length}, 0], {side}{i + 1} = [{x}, {y}]"
            lines.append(f"rod{side}{i} = {{ points = {{ {points} }} }}")
    names = ["A", "E", *(f"{x}{i}" for i in range(1, loops + 1) for x in "BDC")]
    return loads("\n".join([*lines, "[joints]", *(f'{name} = "R"' for name in names)]))
