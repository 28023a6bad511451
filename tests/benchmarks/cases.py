"""The mechanisms of the benchmarks: series of loops, and well-known ones."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from singsym.mechanism import Mechanism, load
from tests.classes.chains import four_bars

_JANSEN = Path(__file__).parents[1] / "cases" / "jansen-leg.toml"

QUICK: dict[str, Callable[[], Mechanism]] = {
    "fourbar": partial(load, "fourbar"),
    "four-bars-2": partial(four_bars, 2),
    "zlatanov-2dof": partial(load, "zlatanov-2dof"),
    "five-bar": partial(load, "five-bar"),
}
LONG: dict[str, Callable[[], Mechanism]] = {
    "four-bars-3": partial(four_bars, 3),
    "four-bars-4": partial(four_bars, 4),
    "jansen-leg": partial(load, _JANSEN),
    "stephenson-six-bar": partial(load, "stephenson-six-bar"),
    "3rrr": partial(load, "3rrr"),
}
CASES = QUICK | LONG


def mechanism(name: str) -> Mechanism:
    """A case by its name, or a mechanism of the library."""
    return CASES[name]() if name in CASES else load(name)
