"""Five-bars in series: two angles go in, and two moving ones are handed on from loop to loop.

By hand: with angles a, d of the cranks and p, q of the rods, the first loop is 2 e(a) + 3 e(p) = 3 + 2 e(d)
+ 4 e(q) in complex numbers.  Its derivative gives p', q' from a', d' where sin(p - q) is not zero, and the
other way round where sin(a - d) is not.  The same holds of the loops that follow, each with the arms of the
rods before it as cranks.  So (4) is the product of the sin(p_i - q_i), zero with B_i, C_i and D_i in a line;
and (5) that of sin(a - d) and of the sines between the arms at C_i.
"""

from __future__ import annotations

import numpy as np
import pytest

from singsym.classes.classify import Limits, classify
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.conditions.conditions import conditions
from singsym.kinematics.velocity import velocity_equation
from singsym.polynomials.compiled_map import CompiledMap
from tests.classes.chains import five_bars

Complex = np.ndarray
RODS = (3.0, 4.0)
ARMS = (4 + 2j) / 3, (5 - 1j) / 4
"""From the start of a rod to its arm's end, over the way to its end."""


def joined(b: Complex, d: Complex, side: Complex) -> Complex:
    """The ends of two rods from these points, on these sides; not a number where they do not meet."""
    p, q = RODS
    way = d - b
    along = (p * p - q * q + abs(way) ** 2) / (2 * abs(way))
    return np.asarray(b + way / abs(way) * (along + 1j * side * np.sqrt(p * p - along**2)))


def sine(v: Complex, w: Complex) -> Complex:
    """That of the angle between two plane vectors."""
    return np.asarray((v.conjugate() * w).imag / (abs(v) * abs(w)))


@np.errstate(invalid="ignore")
def drawn(loops: int, number: int = 400) -> tuple[dict[str, Complex], list[Complex], list[Complex]]:
    """Configurations as points and turned links, and the sines of which (4) and (5) are products."""
    random = np.random.default_rng(loops)
    angles = random.uniform(0, 2 * np.pi, (2, number))
    b, d = 2 * np.exp(1j * angles[0]), 3 + 2 * np.exp(1j * angles[1])
    found: dict[str, Complex] = {}
    outputs, inputs = [], [sine(b, d - 3)]
    for i in range(1, loops + 1):
        c = joined(b, d, random.choice([-1.0, 1.0], number))
        found |= {f"B{i}": b, f"C{i}": c, f"D{i}": d}
        found |= {f"rodB{i}": (c - b) / abs(c - b), f"rodD{i}": (c - d) / abs(c - d)}
        outputs.append(sine(c - b, c - d))
        b, d = b + (c - b) * ARMS[0], d + (c - d) * ARMS[1]
        if i < loops:
            inputs.append(sine(b - c, d - c))
    whole = np.isfinite(outputs[-1])
    take = [[v[whole] for v in values] for values in (outputs, inputs)]
    return {name: v[whole] for name, v in found.items()}, take[0], take[1]


@pytest.mark.parametrize("loops", [1, 2, 3, 4])
def test_conditions(loops: int) -> None:
    """At configurations drawn at random each factor is one of the sines by hand, up to a number."""
    equation = velocity_equation(five_bars(loops))
    points, outputs, inputs = drawn(loops)
    assert len(outputs[0]) > 10
    values = np.array([coordinate(name, points) for name in equation.space.ring.names]).T
    closed = CompiledMap(equation.space.equations, equation.space.ring).values(values)
    assert np.abs(closed).max() < 1e-9
    found = conditions(equation)
    for label, sines in (("4", outputs), ("5", inputs)):
        polynomials = [f.polynomial for f in found[label].factors]
        factors = CompiledMap(polynomials, equation.space.ring).values(values).T
        assert len(factors) == loops
        for by_hand in sines:
            ratios = [f / by_hand for f in factors]
            assert sum(bool(np.ptp(r) < 1e-6 * abs(r[0])) for r in ratios) == 1


def coordinate(name: str, points: dict[str, Complex]) -> Complex:
    """The values of a variable: B1x, or the cosine or sine of a link's angle, as c_rodB1."""
    if name.startswith(("c_", "s_")):
        turned = points[name[2:]]
        return turned.real if name.startswith("c_") else turned.imag
    return points[name[:-1]].real if name.endswith("x") else points[name[:-1]].imag


def test_classes_of_one_loop() -> None:
    """By hand; flat loops are (A, B, C, D, E) = (0, 2, 5, 1, 3) and (0, -2, 1, 5, 3) on the line of the base.

    Cranks in parallel: equal ones, with BD = 3, are two closed curves; opposite ones, with BD from 1 to 7,
    are two curves that meet in both flat loops.  Rods in a line: stretched with BD = 7, its largest, in one
    flat loop; folded with BD = 1, where 2 e(d) - 2 e(a) = e(t) - 3 has two solutions for each t, which are
    one where t = pi: in the other flat loop.
    """
    result = classify(five_bars(1), cache=False, limits=Limits(total=120))
    assert not result.undecided
    found = {c.types: (c.dimension, c.components) for c in result.classes if c.verdict.is_yes}
    assert found == {T.RI | T.IO: (1, 3), T.RO | T.II: (1, 1), T.RI | T.RO | T.IIM: (0, 2)}


@pytest.mark.engines
def test_classes_of_two_loops(monkeypatch: pytest.MonkeyPatch) -> None:
    """The types of one loop, and points with cranks in parallel and the rods of the second loop in a line.

    Those are counted by a scan.  Over each of the two flat first loops, with the ends of the arms 3 and
    sqrt(5) apart, the second closes in two ways.  Connected components are not counted: that takes minutes.
    """
    monkeypatch.setattr("singsym.classes.classify.MOST_FREEDOMS", 1)
    result = classify(five_bars(2), cache=False, limits=Limits(total=120))
    assert not any(c.verdict.is_undecided for c in result.classes)
    found = {c.types: (c.dimension, c.points) for c in result.classes if c.verdict.is_yes}
    assert found == {
        T.RI | T.IO: (1, None),
        T.RO | T.II: (1, None),
        T.RI | T.RO | T.II | T.IO: (0, scanned_points()),
        T.RI | T.RO | T.IIM: (0, 4),
    }


def scanned_points(steps: int = 100_001) -> int:
    """How often the arms' ends are as far apart as the rods' lengths differ, with cranks in parallel."""
    crank = np.exp(1j * (np.linspace(0, 2 * np.pi, steps) + 1e-5))
    found = 0
    for b, d in ((2 * crank, 3 + 2 * crank), (2 * crank, 3 - 2 * crank)):
        for side in (1, -1):
            c = joined(b, d, np.array(side))
            apart = abs(b + (c - b) * ARMS[0] - d - (c - d) * ARMS[1])
            assert apart.max() < sum(RODS)
            found += int(np.abs(np.diff(np.sign(apart - (RODS[1] - RODS[0])))).sum()) // 2
    return found
