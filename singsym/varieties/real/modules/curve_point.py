"""Points of curves by balls that are computed when they are wanted, and exactly where balls do not tell.

Source: F. Johansson, Arb (2017), see enclosed_point.py; rational parametrisations, see exact_point.py.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from flint import arb

from singsym.effort.budget import Undecided
from singsym.effort.verdict import Premises
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.polynomials.block_form import Module, block_form
from singsym.varieties.real.modules.assemblies import value_at
from singsym.varieties.real.points.enclosed_point import EnclosedPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.points.intervals import at_precision
from singsym.varieties.splitting import used_ring

Balls = Mapping[str, arb]
BITS = (64, 256, 1024)
"""Bits of the balls of a point, tried in turn where something is not seen."""


@dataclass(frozen=True, eq=False)
class CurvePoint:
    """A point of a curve by balls as small as wanted.

    equations: what it is one of finitely many solutions of; locate: balls of its coordinates, for so many
    bits; premises: what rests on its being one of those that were found.
    """

    ring: Ring
    equations: Equations
    locate: Callable[[int], Balls]
    premises: Premises
    _known: dict[int, Balls] = field(default_factory=dict)

    def balls(self, bits: int) -> Balls:
        """Balls that hold the coordinates, by name."""
        if bits not in self._known:
            with at_precision(bits + 64):
                self._known[bits] = self.locate(bits)
        return self._known[bits]

    def located(self) -> CurvePoint:
        """The same point; raises `Undecided` where there are no balls of it, as where a dyad turns freely."""
        for bits in BITS[:-1]:
            with suppress(Undecided):
                self.balls(bits)
                return self
        self.balls(BITS[-1])
        return self

    def sign(self, polynomial: Polynomial) -> int:
        """The sign at the point: exact algebra is asked where balls do not tell it from zero."""
        sign = self.seen_sign(polynomial)
        return self._exact_sign(polynomial) if sign is None else sign

    def seen_sign(self, polynomial: Polynomial) -> int | None:
        """The sign, where balls tell it or the polynomial is one of the point's equations."""
        if polynomial.is_zero or polynomial.primitive() in {p.primitive() for p in self.equations}:
            return 0
        for bits in BITS:
            known = self.balls(bits)
            with at_precision(bits + 64):
                value = value_at(polynomial, known)
                if value > 0 or value < 0:
                    return 1 if value > 0 else -1
        return None

    def _exact_sign(self, polynomial: Polynomial) -> int:
        form = block_form(tuple(dict.fromkeys((*self.ring.relations, *self.equations))))
        equations = tuple(p for m in form.determining(polynomial.variables) for p in m.equations)
        own = used_ring(self.ring, equations)
        found = self.premises.take(real_points(tuple(map(own.convert, equations))))
        for bits in BITS:
            known = self.balls(bits)
            near = [
                p
                for p in found
                if all(known[n].overlaps(b) for n, b in zip(own.names, p.refine(bits).box, strict=True))
            ]
            if len(near) == 1:
                return near[0].sign(own.convert(polynomial))
        raise Undecided(f"the sign of {polynomial.short_text()} at a point of a curve")

    @staticmethod
    def of(point: EnclosedPoint, equations: Equations, premises: Premises | None = None) -> CurvePoint:
        """A point that was found."""
        return CurvePoint(point.ring, equations, balls_of(point), premises or Premises())

    def beside(self, other: CurvePoint | None, ring: Ring) -> CurvePoint:
        """The point in more coordinates, those of another point."""
        if other is None:
            return self
        equations = tuple(map(ring.convert, (*self.equations, *other.equations)))
        return CurvePoint(ring, equations, lambda b: {**other.balls(b), **self.balls(b)}, self.premises)

    def over(self, module: Module, ring: Ring, values: Callable[[Balls], Balls]) -> CurvePoint:
        """The point with the values of a module's unknowns."""
        equations = tuple(map(ring.convert, (*self.equations, *module.equations)))
        return CurvePoint(ring, equations, lambda bits: _and(self.balls(bits), values), self.premises)


def _and(known: Balls, values: Callable[[Balls], Balls]) -> Balls:
    return {**known, **values(known)}


def balls_of(point: EnclosedPoint) -> Callable[[int], Balls]:
    """Balls of its coordinates by name, for so many bits."""
    return lambda bits: dict(zip(point.ring.names, point.refine(bits).box, strict=True))
