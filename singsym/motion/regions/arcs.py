"""The regions of a mechanism of one degree of freedom: arcs of the configuration curve, all of them, proven.

Of two degrees of freedom the arcs of a slice are found in the same way.

Source: certified curves as in `singsym.varieties.real.curves`, cut at all exact zeros of the borders.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from singsym.effort import patience
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Certainty, Verdict
from singsym.motion.enclosures import Enclosure
from singsym.motion.regions.borders import Border
from singsym.motion.regions.free_motion import FreeMotions, Place
from singsym.motion.regions.result import Region, Regions
from singsym.motion.regions.slices import Slice
from singsym.polynomials.compiled_map import Floats
from singsym.varieties.real.curves.cuts import CurvePiece, CutCurve
from singsym.varieties.real.curves.real_curve import real_curve
from singsym.varieties.real.system import RealSystem

_SHARES = (0.5, 0.3, 0.7, 0.1, 0.9)
"""Where on an arc a configuration of it is taken, the first that is proven."""


@dataclass(frozen=True, eq=False)
class Arcs:
    """A curve of configurations without the zeros of all borders; raises `Undecided` where it is not proven.

    curve: all configurations for n = 1, a slice of them for n = 2.
    Lemma: inside a region no border's polynomial vanishes, so for n = 1 a region is a connected part of the
    curve without their zeros, on which limits are positive; and each such part is one.
    """

    motions: FreeMotions
    curve: Slice

    @classmethod
    def of(cls, motions: FreeMotions) -> Arcs:
        """Those of a mechanism with n = 1."""
        return cls(motions, Slice.whole(motions.borders.equation.space))

    @cached_property
    def _cut(self) -> tuple[CutCurve, Certainty]:
        borders = self.motions.borders
        if borders.unwritten:
            raise Undecided(f"condition ({borders.unwritten[0]}) is not written out as one equation")
        squares = RealSystem(self.curve.space.ring, (), exclusions=borders.holes).exclusion_polynomials
        ends = map(self.curve.restricted, (*(b.polynomial for b in borders.all), *squares))
        budget = current().part(patience.ARCS.work)
        curve = real_curve(self.curve.equations, budget=budget)
        cut = curve.cut(*(p for p in ends if not p.is_constant), budget=budget)
        return cut.value, cut.certainty

    @property
    def certainty(self) -> Certainty:
        """How the arcs are known."""
        return self._cut[1]

    def number(self, place: Place) -> int:
        """On which arc a configuration is."""
        return self._number(place.near)

    def _number(self, near: Enclosure) -> int:
        """The same of an enclosure around a configuration, of which one is on the curve."""
        label = self.curve.label
        if label and not self.curve.is_at(near.value(self.motions.space.labels.index(label))):
            raise Undecided("a configuration is not on the slice")
        return self._cut[0].piece_of(tuple(near.box[k] for k in self.curve.places))

    def places(self) -> Iterator[Place]:
        """A configuration of each arc within limits; raises `Undecided` where one of them is not proven."""
        for _, point, _ in self._within():
            place = self.motions.place(point)
            if place is None:
                raise Undecided("a configuration of one of the arcs was not proven to be off borders")
            yield place

    def regions(self) -> Iterator[Region]:
        """The arcs within limits; raises `Undecided` where no configuration of one is proven."""
        for piece, point, signs in self._within():
            yield self._region(point, signs, piece, self._cut[0])

    def _within(self) -> Iterator[tuple[CurvePiece, Floats, tuple[int, ...]]]:
        """The arcs within limits, with a configuration of each and the signs of the borders there."""
        limits = [k for k, b in enumerate(self.motions.borders.all) if b.condition == "limit"]
        for number, piece in enumerate(self._cut[0].pieces):
            point, signs = self._inside(number, piece)
            if all(signs[k] > 0 for k in limits):
                yield piece, point, signs

    def _inside(self, number: int, piece: CurvePiece) -> tuple[Floats, tuple[int, ...]]:
        """A configuration of an arc, and the signs of the borders there."""
        for share in _SHARES if len(piece.line) else ():
            point = self._on_curve(piece.line, share)
            near = self.motions.near(point)
            signs = () if near is None else self.motions.borders.signs(near)
            if near is None or not all(signs):
                continue
            try:
                if self._number(near) == number:
                    return point, signs
            except Undecided:
                continue
        raise Undecided("no configuration of one of the arcs was proven")

    def _on_curve(self, line: Floats, share: float) -> Floats:
        """A configuration next to a place on a polyline, by Newton's method."""
        places = np.arange(len(line), dtype=float)
        at = share * places[-1]
        near = self.curve.lifted(np.array([np.interp(at, places, column) for column in line.T]))
        inputs, space = self.motions.space.at(near)[0], self.motions.space
        if self.curve.label:
            number = space.labels.index(self.curve.label)
            inputs[number] = self.curve.value / space.units[number]
        return self.motions.onto(inputs, near)

    def _region(self, point: Floats, signs: tuple[int, ...], piece: CurvePiece, cut: CutCurve) -> Region:
        ends = [cut.removed[k] for k in piece.points]
        return Region(
            *self.motions.named(point),
            signs,
            tuple(b for b in self.motions.borders.all if any(p.sign(b.polynomial) == 0 for p in ends)),
            piece.line,
            np.zeros((0, 1), dtype=int),
        )


def arcs(motions: FreeMotions) -> Regions:
    """The regions of a mechanism with n = 1."""
    borders: tuple[Border, ...] = motions.borders.all
    found = Arcs.of(motions)
    try:
        regions = sorted(found.regions(), key=lambda r: -_length(r.points))
        verdict = Verdict.yes(
            found.certainty, reason="all arcs of the configuration curve between its borders"
        )
    except Undecided as reason:
        regions, verdict = [], Verdict.undecided(str(reason))
    return Regions(motions.borders.equation, borders, tuple(regions), verdict)


def _length(line: Floats) -> float:
    return float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
