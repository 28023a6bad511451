"""Linkages put together dyad by dyad over a fine grid of the crank angle, knowing only circles and lines.

Points are complex numbers.  `counts` says where the output rests (class 1: it changes its direction) and
where an assembly ends (class 2; two of them meet there).
"""

from __future__ import annotations

import numpy as np

from singsym.classes.classify import Limits, classify
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.mechanism import Mechanism

STEPS = 200_001
SIDES = (1, -1)
Complex = np.ndarray
Branch = tuple[np.ndarray, np.ndarray]
"""The output at each step, and whether it is assembled there."""


def crank(radius: float, start: float = 1e-5) -> Complex:
    """The crank pin once round the origin, and one step more."""
    return radius * np.exp(1j * (np.linspace(0, 2 * np.pi, STEPS) + start))


def fixed(place: complex) -> Complex:
    """A pivot."""
    return np.full(STEPS, complex(place))


def dyad(a: Complex, b: Complex, p: float, q: float, side: int) -> tuple[Complex, np.ndarray]:
    """The points at distances p of a and q of b on one side, and where there are any."""
    way = b - a
    along = (p * p - q * q + abs(way) ** 2) / (2 * abs(way))
    square = p * p - along**2
    off = np.sqrt(np.maximum(square, 0))
    return a + way / abs(way) * (along + 1j * side * off), square > 0


def slider(a: Complex, p: float, start: complex, way: complex, side: int) -> Branch:
    """How far along a line from its start the point at distance p of a is, and where there is any."""
    seen = (a - start) / way
    square = p * p - seen.imag**2
    return seen.real + side * np.sqrt(np.maximum(square, 0)), square > 0


def carried(a: Complex, b: Complex, start: complex, end: complex, point: complex) -> Complex:
    """Where a point of a link is, of which two are at a and b; all three as the link has them."""
    return a + (b - a) * (point - start) / (end - start)


def turns(values: np.ndarray, there: np.ndarray) -> int:
    """How often values change their direction inside an assembly."""
    rate, inside = np.diff(values), there[1:] & there[:-1]
    return int(((rate[1:] * rate[:-1] < 0) & inside[1:] & inside[:-1]).sum())


def counts(branches: list[Branch]) -> dict[T, int]:
    """Rests of the output and ends of assemblies."""
    rests = sum(turns(output, there) for output, there in branches)
    ends = sum(int((there[1:] != there[:-1]).sum()) for _, there in branches)
    return occurring(rests, ends // 2)


def occurring(rests: int, stops: int) -> dict[T, int]:
    """Configurations by types, of those types that there are."""
    found = {T.RI | T.IO: rests, T.RO | T.II: stops}
    return {types: count for types, count in found.items() if count}


def found_by_singsym(mechanism: Mechanism) -> dict[T, int | None]:
    """Configurations by types as `classify` counts them; all classes are decided."""
    result = classify(mechanism, cache=False, limits=Limits(total=120))
    assert not result.undecided
    return {c.types: c.points for c in result.classes if c.verdict.is_yes}
