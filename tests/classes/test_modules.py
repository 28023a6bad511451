"""Linkages of several loops with one input, against a scan of the crank angle that knows only circles."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from singsym.classes.taxonomy.types import SingularityType as T
from singsym.mechanism import load
from tests.classes.chains import four_bars
from tests.classes.crank_scan import STEPS, counts, crank, dyad, fixed, found_by_singsym


def scanned_chain(loops: int) -> dict[T, int]:
    ends = [(crank(2), np.ones(STEPS, dtype=bool))]
    for i in range(1, loops + 1):
        pivot = fixed(4 * i + 1j * (i % 2))
        tips = [(*dyad(b, pivot, 4, 3, side), there) for b, there in ends for side in (1, -1)]
        ends = [((pivot + (tip - pivot) / 3 * (1 + 2j)), own & there) for tip, own, there in tips]
    return counts([(np.unwrap(np.angle(b - pivot)), there) for b, there in ends])


@pytest.mark.parametrize("loops", [2, 3, 4])
def test_four_bars_in_series(loops: int) -> None:
    """14, 34 and 76 rests by the scan, and no end."""
    assert found_by_singsym(four_bars(loops)) == scanned_chain(loops)


def scanned_jansen() -> dict[T, int]:
    """Lengths as usually published: 15, 50, 41.5, 55.8, 40.1, 61.9, 39.3, 39.4, 36.7, 49, 65.7, 38, 7.8."""
    pin, base = crank(15, 1e-7), fixed(-38 - 7.8j)
    branches = []
    for one in (1, -1):
        knee, first = dyad(pin, base, 50, 41.5, one)
        top, _ = dyad(base, knee, 40.1, 55.8, 1)
        for two in (1, -1):
            ankle, second = dyad(pin, base, 61.9, 39.3, two)
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
