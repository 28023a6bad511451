"""A box of the inputs around a configuration in which no singularity is, as large as it can be proven.

Source: the Krawczyk test over boxes of inputs as in `singsym.motion.enclosures`; boxes are put together as in
paving, Jaulin, Kieffer, Didrit, Walter, Applied Interval Analysis (2001), ch. 3.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb

from singsym.classes.configuration.at import Analysis
from singsym.effort import patience, progress
from singsym.effort.budget import current
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.enclosures import BITS, Enclosure
from singsym.motion.regions.borders import borders, input_space, point_of
from singsym.motion.regions.free_motion import OUTSIDE, FreeMotions
from singsym.polynomials.compiled_map import Floats
from singsym.varieties.real.points.intervals import at_precision

TESTS = 400
"""Krawczyk tests of boxes of the inputs, by default."""
_FIRST, _SMALLEST = 0.5, 1e-7
"""Half the width of the first box that is tried, and of the last, in radians or lengths over their unit."""
_PARTS = 16
"""Tests for one part that is put on."""
_GROWTH, _SHARE = 1.25, 0.25
"""All sides are moved by so much at once, while this takes less than that share of all tests."""
_THIN = 0.02
"""Parts that are thinner than so much of the box are not put on."""


@dataclass(frozen=True)
class FreeBox:
    """Values of the inputs between which no singularity is, on the sheet of one configuration.

    inputs: lowest and highest value by label, in radians and lengths; certified: while each input stays
    between its two, wherever the inputs go, the mechanism meets no singularity, no limit and no exclusion.
    clear: how far away the nearest face is, in radians, lengths over `length`.
    variables: between which values the variables stay, by name; boxes: how many the proof has; tests: how
    many were tried.
    """

    centre: Mapping[str, float]
    inputs: Mapping[str, tuple[float, float]]
    clear: float
    length: float
    variables: Mapping[str, tuple[float, float]]
    boxes: int
    tests: int


def free_box(found: Analysis, *, tests: int = TESTS) -> FreeBox:
    """A proven box around a configuration that `at` has examined, for any mobility.

    It is grown on all sides at once, then side by side, as far as the proof goes: a larger one may be free as
    well.  tests: so many boxes are tried, where these come to an end in time; more make it larger.  Raises
    `MechanismError` where the configuration is not proven to be regular and within limits, or the inputs'
    values are not known.

    >>> from singsym.classes.configuration.at import at
    >>> from singsym.mechanism import load
    >>> crank = free_box(at(load("slider-crank"), {"joints": {"A": "60 deg", "P": "(1 + sqrt(33)) / 2"}}))
    >>> low, high = crank.inputs["A"]
    >>> 0 < low < 0.1 and 3 < high < 3.14159
    True
    """
    space = input_space(found.equation, found.length)
    motions = FreeMotions(borders(found.equation), space)
    point = point_of(found)
    place = motions.place(point)
    if place is None:
        raise MechanismError([Problem("configuration", OUTSIDE, "a regular configuration within limits")])
    with current().part(patience.FREE_BOX.work):
        return _Paving(motions, point, tests).grown(found.length)


@dataclass(frozen=True)
class _Cell:
    """A box of the inputs over which there is one sheet, free of borders."""

    low: Floats
    high: Floats
    sheet: Enclosure

    def has(self, values: Floats) -> bool:
        """Whether values are between its sides."""
        return bool((self.low <= values).all() and (values <= self.high).all())


class _Paving:
    """Cells that make up a box."""

    def __init__(self, motions: FreeMotions, point: Floats, tests: int) -> None:
        self.motions, self.left, self.all, self.tried = motions, tests, tests, 0
        self.space, self.point = motions.space, point
        self.units = np.array(self.space.units)
        self.centre = self.space.at(point)[0]
        self.cells: list[_Cell] = []
        self.low = self.high = self.centre

    def grown(self, length: float) -> FreeBox:
        """The largest box that is found, side by side."""
        radius = _FIRST
        while radius > _SMALLEST and self.left:
            found = self._cell(self.centre - radius, self.centre + radius, self.point)
            if found is not None:
                self.cells, self.low, self.high = [found], found.low, found.high
                break
            radius /= 1.6
        radius = self._all_sides(radius)
        thickness = np.full((2, len(self.centre)), radius)
        moving = [(side, k) for k in range(len(self.centre)) for side in (0, 1)] if self.cells else []
        while moving and self.left:
            moving = [way for way in moving if self._moved(way, thickness)]
            progress.report("free box", f"{len(self.cells)} boxes", self.all - self.left, self.all)
        return self._result(length)

    def _all_sides(self, radius: float) -> float:
        """Move all sides outwards by the same, as far as few tests prove it; where they are then."""
        share = int(_SHARE * self.all)
        while self.cells and self.left > share:
            wider = _GROWTH * radius
            if 2 * (wider - radius) > min(map(self._room, range(len(self.centre)))):
                break
            low, high = self.centre - wider, self.centre + wider
            found = self._proven(low, high, self.point, self.left - share)
            if found is None:
                break
            self.cells, self.low, self.high, radius = found, low, high, wider
            progress.report("free box", f"{len(found)} boxes", self.all - self.left, self.all)
        return radius

    def _moved(self, way: tuple[int, int], thickness: Floats) -> bool:
        """Move one side outwards, or make its next step smaller; whether it may move again."""
        side, k = way
        step = min(float(thickness[way]), self._room(k))
        if step < _THIN * (self.high[k] - self.low[k]) or not self.left:
            return False
        low, high = self.low.copy(), self.high.copy()
        if side:
            low[k], high[k] = self.high[k], self.high[k] + step
        else:
            low[k], high[k] = self.low[k] - step, self.low[k]
        face = (low + high) / 2
        face[k] = self.high[k] if side else self.low[k]
        start = self._near(face, self.point)
        found = self._proven(low, high, start, max(0, self.left - _PARTS))
        if found is None or not self._agree(face, start, self.cells, found):
            thickness[way] = step / 2
            return True
        self.cells += found
        self.low, self.high = np.minimum(self.low, low), np.maximum(self.high, high)
        thickness[way] = 1.5 * step
        return True

    def _room(self, k: int) -> float:
        """How much wider the box may become: an angle turns once at most."""
        if self.space.values[k].cosine is None:
            return float("inf")
        return 2 * np.pi - float(self.high[k] - self.low[k])

    def _proven(self, low: Floats, high: Floats, near: Floats, least: int) -> list[_Cell] | None:
        """A box, in parts where need be; near: a configuration over it; least: tests that are to be left.

        Lemma: the sheets over two convex boxes with a common face are continuous there; where they agree at
        one point of it they agree on all of it, for the implicit function is unique.
        """
        if self.left <= least:
            return None
        whole = self._cell(low, high, near)
        if whole is not None:
            return [whole]
        k = self._steepest(low, high, near)
        middle = (low[k] + high[k]) / 2
        first, second = high.copy(), low.copy()
        first[k] = second[k] = middle
        one = self._proven(low, first, near, least)
        two = None if one is None else self._proven(second, high, near, least)
        if one is None or two is None:
            return None
        face = (low + high) / 2
        return [*one, *two] if self._agree(face, self._near(face, near), one, two) else None

    def _steepest(self, low: Floats, high: Floats, near: Floats) -> int:
        """The input by whose range the variables change most."""
        middle = (low + high) / 2
        slopes = self.motions.sheet.slopes(self._values(middle, middle), self._near(middle, near))
        widths = (high - low) * self.units
        return int(np.argmax(widths if slopes is None else widths * np.linalg.norm(slopes, axis=0)))

    def _cell(self, low: Floats, high: Floats, near: Floats) -> _Cell | None:
        if current().remaining() == 0.0:
            self.left = 0
            return None
        self.left, self.tried = self.left - 1, self.tried + 1
        point = self._near((low + high) / 2, near)
        if not np.isfinite(point).all():
            return None
        sheet = self._sheet(low, high, point)
        off = sheet is not None and self.motions.borders.are_off(sheet)
        return _Cell(low, high, sheet) if sheet is not None and off else None

    def _sheet(self, low: Floats, high: Floats, point: Floats) -> Enclosure | None:
        return self.motions.sheet.over(self._values(low, high), point)

    def _values(self, low: Floats, high: Floats) -> dict[str, arb]:
        with at_precision(BITS):
            ends = zip(self.space.labels, low.tolist(), high.tolist(), self.space.units, strict=True)
            return {label: arb(a).union(arb(b)) * arb(unit) for label, a, b, unit in ends}

    def _near(self, values: Floats, point: Floats) -> Floats:
        """The configuration over some values that Newton's method reaches, in a few steps on the way."""
        start = self.space.at(point)[0]
        change = self.space.difference(values, start)
        for share in (0.25, 0.5, 0.75, 1.0):
            point = self.motions.onto(start + share * change, point)
        return point

    def _agree(self, at: Floats, near: Floats, one: Sequence[_Cell], two: Sequence[_Cell]) -> bool:
        """Whether two sets of cells have the same configuration over values that are in both."""
        if not np.isfinite(near).all():
            return False
        found = self._sheet(at, at, near)
        own = [next((c for c in cells if c.has(at)), None) for cells in (one, two)]
        return found is not None and all(
            cell is not None and cell.sheet.has_configuration(found) for cell in own
        )

    def _result(self, length: float) -> FreeBox:
        if not self.cells:
            found, expected = f"no box was proven to be free in {self.tried} tests", "more tests"
            raise MechanismError([Problem("free box", found, expected)])
        labels, names = self.space.labels, self.motions.borders.equation.space.ring.names
        low, high = self.low * self.units, self.high * self.units
        boxes = [cell.sheet.box for cell in self.cells]
        ranges = {
            name: (min(float(b[k].lower()) for b in boxes), max(float(b[k].upper()) for b in boxes))
            for k, name in enumerate(names)
        }
        clear = min(float((self.centre - self.low).min()), float((self.high - self.centre).min()))
        return FreeBox(
            dict(zip(labels, (self.centre * self.units).tolist(), strict=True)),
            dict(zip(labels, zip(low.tolist(), high.tolist(), strict=True), strict=True)),
            clear,
            length,
            ranges,
            len(self.cells),
            self.tried,
        )
