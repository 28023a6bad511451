"""Linkages of several loops with one input, against a scan of the crank angle that knows only circles.

The scan goes round the crank once in small steps, puts each dyad together in both ways, and counts where the
output rests (class 1: it changes its direction) and where an assembly ends (class 2; two of them meet there).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from singsym.classes.classify import Limits, classify
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.mechanism import Mechanism, load
from tests.classes.chains import four_bars

STEPS = 200_001
Complex = np.ndarray


def dyad(a: Complex, b: Complex, p: float, q: float, side: int) -> tuple[Complex, np.ndarray]:
    """The points at distances p of a and q of b on one side, and where there are any."""
    way = b - a
    along = (p * p - q * q + abs(way) ** 2) / (2 * abs(way))
    square = p * p - along**2
    off = np.sqrt(np.maximum(square, 0))
    return a + way / abs(way) * (along + 1j * side * off), square > 0


def counts(branches: list[tuple[np.ndarray, np.ndarray]]) -> dict[T, int]:
    """Rests of the output and ends of assemblies, of branches (output, where it is assembled)."""
    rests = ends = 0
    for output, there in branches:
        rate = np.diff(output)
        inside = there[1:] & there[:-1]
        rests += int(((rate[1:] * rate[:-1] < 0) & inside[1:] & inside[:-1]).sum())
        ends += int((there[1:] != there[:-1]).sum())
    found = {T.RI | T.IO: rests, T.RO | T.II: ends // 2}
    return {types: count for types, count in found.items() if count}


def found_by_singsym(mechanism: Mechanism) -> dict[T, int | None]:
    result = classify(mechanism, cache=False, limits=Limits(total=120))
    assert not result.undecided
    return {c.types: c.points for c in result.classes if c.verdict.is_yes}


def scanned_chain(loops: int) -> dict[T, int]:
    crank = 2 * np.exp(1j * (np.linspace(0, 2 * np.pi, STEPS) + 1e-5))
    ends = [(crank, np.ones(STEPS, dtype=bool))]
    for i in range(1, loops + 1):
        pivot = np.full(STEPS, 4 * i + 1j * (i % 2))
        tips = [(*dyad(b, pivot, 4, 3, side), there) for b, there in ends for side in (1, -1)]
        ends = [((pivot + (tip - pivot) / 3 * (1 + 2j)), own & there) for tip, own, there in tips]
    return counts([(np.unwrap(np.angle(b - pivot)), there) for b, there in ends])


@pytest.mark.parametrize("loops", [2, 3, 4])
def test_four_bars_in_series(loops: int) -> None:
    """14, 34 and 76 rests by the scan, and no end."""
    assert found_by_singsym(four_bars(loops)) == scanned_chain(loops)


def scanned_jansen() -> dict[T, int]:
    """Lengths as usually published: 15, 50, 41.5, 55.8, 40.1, 61.9, 39.3, 39.4, 36.7, 49, 65.7, 38, 7.8."""
    crank = 15 * np.exp(1j * (np.linspace(0, 2 * np.pi, STEPS) + 1e-7))
    base = np.full(STEPS, -38 - 7.8j)
    branches = []
    for one in (1, -1):
        knee, first = dyad(crank, base, 50, 41.5, one)
        top, _ = dyad(base, knee, 40.1, 55.8, 1)
        for two in (1, -1):
            ankle, second = dyad(crank, base, 61.9, 39.3, two)
            for three in (1, -1):
                heel, third = dyad(top, ankle, 39.4, 36.7, three)
                foot, _ = dyad(ankle, heel, 65.7, 49, 1)
                branches.append((foot.real, first & second & third))
    return counts(branches)


@pytest.mark.slow
def test_a_walking_leg() -> None:
    """Jansen's, the foot's horizontal velocity as output: 24 rests and 4 ends by the scan."""
    leg = load(Path(__file__).parents[1] / "cases" / "jansen-leg.toml")
    assert found_by_singsym(leg) == scanned_jansen()
