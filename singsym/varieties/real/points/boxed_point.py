"""Real points known by a box that is proven to hold exactly one solution of a square system.

Source: Krawczyk, Computing 4 (1969) 187-201.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from flint import arb, arb_mat

from singsym.effort.budget import Undecided
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.points.enclosed_point import EnclosedPoint
from singsym.varieties.real.points.intervals import (
    at_precision,
    ball,
    evaluate,
    exact_bounds,
    jacobian,
    krawczyk,
    sign_on_box,
)

_MOST_BITS = 4096


@dataclass(frozen=True, repr=False)
class BoxPoint(EnclosedPoint):
    """The only solution of `equations` in a box, with some coordinates at rationals.

    middles: rationals for all names, in order; unknowns: the names that the equations determine; the box of
    these is middle +- radius.  Signs are decided where they are not zero, and for what is known to vanish:
    the equations, and further polynomials, `zeros`.
    """

    equations: tuple[Polynomial, ...]
    unknowns: tuple[str, ...]
    middles: tuple[Fraction, ...]
    radius_bound: Fraction
    bits: int = 64
    zeros: tuple[Polynomial, ...] = ()

    @cached_property
    def box(self) -> tuple[arb, ...]:
        """Balls that hold the coordinates, in the order of the ring's names."""
        with at_precision(self.bits + 64):
            widths = [self.radius_bound if n in self.unknowns else Fraction(0) for n in self.ring.names]
            return tuple(ball(m) + arb(0, ball(w).upper()) for m, w in zip(self.middles, widths, strict=True))

    def reflect(self, names: Collection[str]) -> BoxPoint:
        """The point with the signs of these coordinates changed, a solution of the equations so changed."""
        equations, zeros = (tuple(p.reflect(names) for p in group) for group in (self.equations, self.zeros))
        pairs = zip(self.ring.names, self.middles, strict=True)
        middles = tuple(-m if n in names else m for n, m in pairs)
        return replace(self, equations=equations, zeros=zeros, middles=middles)

    def rename(self, names: Mapping[str, str]) -> BoxPoint:
        """The point with the coordinates of these names under those that they become, a permutation."""
        equations, zeros = (tuple(p.rename(names) for p in group) for group in (self.equations, self.zeros))
        own = dict(zip(self.ring.names, self.middles, strict=True))
        turned = own | {names[n]: own[n] for n in names}
        unknown = {names.get(n, n) for n in self.unknowns}
        return replace(
            self,
            equations=equations,
            unknowns=tuple(n for n in self.ring.names if n in unknown),
            middles=tuple(turned[n] for n in self.ring.names),
            zeros=zeros,
        )

    def refine(self, bits: int) -> BoxPoint:
        """The same point in a box of radius 2^-bits; raises `Undecided` where it cannot be had."""
        if bits <= self.bits:
            return self
        if bits not in self._finer:
            finer = _sharpened(self.ring, self.equations, self.unknowns, self.middles, bits)
            self._finer[bits] = None if finer is None else replace(finer, zeros=self.zeros)
        found = self._finer[bits]
        if found is None:
            raise Undecided(f"the Krawczyk test fails at {bits} bits")
        return found

    @cached_property
    def _finer(self) -> dict[int, BoxPoint | None]:
        return {}

    @property
    def radius(self) -> float:
        """A bound of the distance of each coordinate from its middle."""
        return float(self.radius_bound)

    @cached_property
    def floats(self) -> tuple[float, ...]:
        """The coordinates in double precision."""
        return tuple(float(m) for m in self.middles)

    def decimals(self, digits: int = 12) -> dict[str, str]:
        """The coordinates by name to so many digits."""
        point = self.refine(int(3.33 * digits) + 16)
        return {
            n: str(b.str(digits, radius=False, more=True))
            for n, b in zip(self.ring.names, point.box, strict=True)
        }

    def sign(self, polynomial: Polynomial) -> int:
        """The sign at the point; raises `Undecided` where it seems to be zero and no equation says so."""
        if polynomial.is_zero or self.is_known_zero(polynomial):
            return 0
        bits = self.bits
        while bits <= _MOST_BITS:
            box = self.refine(bits).box
            with at_precision(bits + 64):
                sign = sign_on_box(polynomial, box)
            if sign:
                return sign
            bits *= 2
        raise Undecided(f"the sign of {polynomial} at a boxed point: zero up to {_MOST_BITS} bits")

    def is_known_zero(self, polynomial: Polynomial) -> bool:
        """Whether a polynomial is one of those known to vanish here, up to a rational factor."""
        return polynomial.primitive() in self._vanishing

    @cached_property
    def _vanishing(self) -> frozenset[Polynomial]:
        return self._normal | {p.primitive() for p in self.zeros}

    def coincides(self, other: BoxPoint) -> bool:
        """Whether both are the same point, for solutions of the same equations.

        Raises `Undecided` where the boxes of different equations' solutions cannot be told apart.
        """
        for bits in (64, 256, 1024):
            one, two = self.refine(bits), other.refine(bits)
            if not all(a.overlaps(b) for a, b in zip(one.box, two.box, strict=True)):
                return False
            wider = self if self.radius_bound >= other.radius_bound else other
            finer = two if wider is self else one
            inside = all(a.contains(b) for a, b in zip(wider.box, finer.box, strict=True))
            if inside and self._normal == other._normal:
                return True
        raise Undecided("whether two boxed points are one")

    @property
    def _normal(self) -> frozenset[Polynomial]:
        return frozenset(p.primitive() for p in self.equations)


def boxed_point(
    ring: Ring,
    equations: Sequence[Polynomial],
    values: Mapping[str, Fraction],
    near: Sequence[float | Fraction],
) -> BoxPoint | None:
    """A solution near a numerical one, with these coordinates at rationals, by a Krawczyk test, or `None`.

    As many equations as names without a value are expected.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> boxed_point(R, [x**2 + y**2 - 2], {"x": Fraction(1)}, (1.0, 0.9))
    BoxPoint(x=1.00000, y=1.00000)
    """
    unknowns = tuple(n for n in ring.names if n not in values)
    middles = tuple(values.get(n, Fraction(x)) for n, x in zip(ring.names, near, strict=True))
    return _sharpened(ring, tuple(equations), unknowns, middles, 64)


def box_around(equations: Sequence[Polynomial], balls: Mapping[str, arb]) -> BoxPoint:
    """The solution that is known by balls, in a box of its own that holds them.

    equations: as many as their ring has names.  Raises `Undecided` where the Krawczyk test does not show it.

    >>> R = Ring(("x",))
    >>> (x,) = R.gens
    >>> box_around([x**2 - 4], {"x": ball(2)})
    BoxPoint(x=2.00000)
    """
    ring = equations[0].ring
    known = [balls[name] for name in ring.names]
    if len(equations) == len(known) and all(value.is_finite() for value in known):
        point = boxed_point(ring, equations, {}, [sum(exact_bounds(value)) / 2 for value in known])
        if point is not None and all(b.contains(a) for a, b in zip(known, point.box, strict=True)):
            return point
    raise Undecided("the Krawczyk test fails at a point that is known by balls")


def _sharpened(
    ring: Ring,
    equations: tuple[Polynomial, ...],
    unknowns: tuple[str, ...],
    middles: tuple[Fraction, ...],
    bits: int,
) -> BoxPoint | None:
    """Newton steps at high precision, then the Krawczyk test on a small box."""
    places = [ring.index(n) for n in unknowns]
    derivatives = jacobian(equations, unknowns)
    with at_precision(bits + 64):
        point = [ball(m) for m in middles]
        # the next step would be shorter than the square of this one, up to a factor
        negligible = arb(2) ** (-(bits // 2) - 16)
        for _ in range(bits.bit_length() + 8):
            step = _newton_step(equations, derivatives, point)
            if step is None:
                return None
            for i, k in enumerate(places):
                point[k] = arb((point[k] - step[i, 0]).mid())
            if all(abs(step[i, 0]) < negligible for i in range(len(places))):
                break
        radius = Fraction(1, 2**bits)
        if krawczyk(equations, unknowns, point, radius) is None:
            return None
        new = tuple(exact_bounds(point[k])[0] if k in places else middles[k] for k in range(len(ring.names)))
    return BoxPoint(ring, equations, unknowns, new, radius, bits)


def _newton_step(
    equations: Sequence[Polynomial], derivatives: Sequence[Sequence[Polynomial]], point: Sequence[arb]
) -> arb_mat | None:
    """What is to be taken from the unknowns; None where the Jacobian matrix may be singular."""
    slopes = arb_mat([[evaluate(d, point) if d else arb(0) for d in row] for row in derivatives])
    values = arb_mat([[evaluate(f, point)] for f in equations])
    try:
        return slopes.solve(values)
    except ZeroDivisionError:
        return None
