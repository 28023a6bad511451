"""Exact real points: rational functions of one isolated real root, refined at will, with decided signs.

Source: Rouillier (1999), see parametrization.py; roots as in roots.py.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from flint import arb, fmpz_poly

from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.points.enclosed_point import EnclosedPoint
from singsym.varieties.real.points.intervals import at_precision, evaluate, exact_bounds
from singsym.varieties.real.points.parametrization import Parametrization
from singsym.varieties.real.points.roots import real_roots, refined_root


@dataclass(frozen=True, repr=False)
class RealPoint(EnclosedPoint):
    """A real point with coordinates n(t) / denominator(t), n of `numerators`, at a real root t of `minimal`.

    minimal is irreducible over Q, so the point is a real point of a maximal ideal of Q[names]; [low, high]
    holds one root of it.  Coefficient tuples start with the constant term.  `bits` says how small the box is:
    radius below 2^-bits times the size of the coordinate (or 1).  Compared by value: the same point from
    another system is another object, see `coincides`.
    """

    minimal: tuple[int, ...]
    denominator: tuple[int, ...]
    numerators: tuple[tuple[int, ...], ...]
    low: Fraction
    high: Fraction
    bits: int = 64

    # -- numbers ---------------------------------------------------------------------------------

    @cached_property
    def box(self) -> tuple[arb, ...]:
        """Balls that hold the coordinates, in the order of the ring's names."""
        return _coordinates(self, self.bits)

    def reflect(self, names: Collection[str]) -> RealPoint:
        """The point with the signs of these coordinates changed."""
        changed = tuple(
            tuple(-c for c in numerator) if name in names else numerator
            for name, numerator in zip(self.ring.names, self.numerators, strict=True)
        )
        return replace(self, numerators=changed)

    def rename(self, names: Mapping[str, str]) -> RealPoint:
        """The point with the coordinates of these names under those that they become, a permutation."""
        own = dict(zip(self.ring.names, self.numerators, strict=True))
        turned = own | {names[n]: own[n] for n in names}
        return replace(self, numerators=tuple(turned[n] for n in self.ring.names))

    def refine(self, bits: int) -> RealPoint:
        """The same point with boxes of relative radius below 2^-bits."""
        if bits <= self.bits:
            return self
        root = refined_root(fmpz_poly(list(self.minimal)), self.low, self.high, bits)
        low, high = exact_bounds(root)
        return RealPoint(
            self.ring,
            self.minimal,
            self.denominator,
            self.numerators,
            max(low, self.low),
            min(high, self.high),
            bits,
        )

    @property
    def radius(self) -> float:
        """The largest radius of the box."""
        return max((float(b.rad()) for b in self.box), default=0.0)

    @cached_property
    def floats(self) -> tuple[float, ...]:
        """The coordinates rounded to floats, for drawing and for starting numerics."""
        return tuple(float(b.mid()) for b in self.box)

    def rational(self, name: str) -> Fraction | None:
        """The coordinate where it is rational over its own definition, else `None`."""
        if len(self.minimal) != 2:
            numerator = self.numerators[self.ring.index(name)]
            if any(numerator):
                return None
            return Fraction(0)
        root = Fraction(-self.minimal[0], self.minimal[1])
        return _value(self.numerators[self.ring.index(name)], root) / _value(self.denominator, root)

    def decimals(self, digits: int = 12) -> dict[str, str]:
        """The coordinates by name, each with so many digits, all of them right up to one unit in the last.

        >>> R = Ring(("x",))
        >>> RealPoint(R, (-2, 0, 1), (1,), ((0, 1),), Fraction(1), Fraction(2)).decimals(5)
        {'x': '1.4142'}
        """
        point = self.refine(int(3.33 * digits) + 16)
        with at_precision(point.bits + 64):
            return {
                name: _decimal(b, self.rational(name), digits)
                for name, b in zip(self.ring.names, point.box, strict=True)
            }

    # -- exact decisions ---------------------------------------------------------------------------

    def sign(self, polynomial: Polynomial) -> int:
        """The sign -1, 0 or 1 of a polynomial of the ring at this point, decided exactly.

        >>> R = Ring(("x",))
        >>> p = RealPoint(R, (-2, 0, 1), (1,), ((0, 1),), Fraction(1), Fraction(2))
        >>> [p.sign(f) for f in (R.gens[0] - 2, R.gens[0] ** 4 - 4, R.gens[0])]
        [-1, 0, 1]
        """
        polynomial = self.ring.convert(polynomial)
        sign = self._interval_sign(polynomial, 64)
        if sign:
            return sign
        if self._vanishes(polynomial):
            return 0
        bits = 128
        while not sign:
            sign = self._interval_sign(polynomial, bits)
            bits *= 2
        return sign

    def _interval_sign(self, polynomial: Polynomial, bits: int) -> int:
        box = self.refine(bits).box
        with at_precision(bits + 64):
            value = evaluate(polynomial, box)
        return int(value > 0) - int(value < 0)

    def _vanishes(self, polynomial: Polynomial) -> bool:
        """Whether it is zero here: then, `minimal` being irreducible, at all conjugates as well."""
        if polynomial.is_zero:
            return True
        if self.parametrization.vanishes_modulo(polynomial) is False:
            return False
        return self.parametrization.vanishes(polynomial)

    @property
    def parametrization(self) -> Parametrization:
        """This point and its conjugates."""
        return Parametrization(
            self.ring,
            fmpz_poly(list(self.minimal)),
            fmpz_poly(list(self.denominator)),
            tuple(fmpz_poly(list(n)) for n in self.numerators),
        )

    @property
    def degree(self) -> int:
        """The degree of the field that the coordinates lie in, over Q."""
        return len(self.minimal) - 1

    def coincides(self, other: RealPoint) -> bool:
        """Whether both are the same point of the same ring, decided exactly."""
        if self.ring.names != other.ring.names:
            raise ValueError(f"points of different rings, {self.ring!r} and {other.ring!r}")
        if self == other:
            return True
        if not all(a.overlaps(b) for a, b in zip(self.box, other.box, strict=True)):
            return False
        return all(_equal_coordinates(self, other, i) for i in range(len(self.ring.names)))


def real_points_of(parametrization: Parametrization, bits: int = 64) -> list[RealPoint]:
    """All real points of a parametrised set, each with its own irreducible factor, in increasing order."""
    found: list[RealPoint] = []
    for factor, _ in parametrization.minimal.factor()[1]:
        if factor.degree() < 1:
            continue
        denominator, numerators = _modulo_factor(parametrization, factor)
        coefficients = tuple(int(c) for c in factor.coeffs())
        for low, high in real_roots(factor):
            point = RealPoint(parametrization.ring, coefficients, denominator, numerators, low, high, 0)
            found.append(point.refine(bits))
    return sorted(found, key=lambda p: (p.floats, p.low))


def _modulo_factor(
    parametrization: Parametrization, factor: fmpz_poly
) -> tuple[tuple[int, ...], tuple[tuple[int, ...], ...]]:
    """Denominator and numerators modulo a factor of the minimal polynomial, times one common integer."""
    polynomials = [parametrization.denominator, *parametrization.numerators]
    if factor.degree() == parametrization.minimal.degree():
        rows = [[int(c) for c in p.coeffs()] for p in polynomials]
    else:
        lead = int(factor.leading_coefficient())
        excess = max(0, max(p.degree() for p in polynomials) - factor.degree() + 1)
        # lead^excess p mod factor is integral (pseudo-division), with one multiplier for all
        rows = [[int(c) for c in _pseudo_remainder(p * lead**excess, factor).coeffs()] for p in polynomials]
    return tuple(rows[0]), tuple(tuple(r) for r in rows[1:])


def _pseudo_remainder(dividend: fmpz_poly, divisor: fmpz_poly) -> fmpz_poly:
    remainder = dividend
    lead, degree = divisor.leading_coefficient(), divisor.degree()
    while remainder.degree() >= degree:
        shift = remainder.degree() - degree
        quotient = remainder.leading_coefficient() // lead
        remainder = remainder - divisor.left_shift(shift) * quotient
    return remainder


def _value(coefficients: Sequence[int], x: Fraction) -> Fraction:
    total = Fraction(0)
    for c in reversed(coefficients):
        total = total * x + c
    return total


def _coordinates(point: RealPoint, bits: int) -> tuple[arb, ...]:
    minimal = fmpz_poly(list(point.minimal))
    denominator = fmpz_poly(list(point.denominator))
    numerators = [fmpz_poly(list(n)) for n in point.numerators]
    working = bits + 32
    while True:
        root = refined_root(minimal, point.low, point.high, working)
        with at_precision(2 * working + 64):
            below = denominator(root)
            if not below.contains(0):
                values = tuple(n(root) / below for n in numerators)
                if all(v.rad() <= abs(v.mid()).max(arb(1)) * arb(2) ** -bits for v in values):
                    return values
        working *= 2


def _equal_coordinates(one: RealPoint, two: RealPoint, i: int) -> bool:
    bits = 64
    with at_precision(256):
        if not one.refine(bits).box[i].overlaps(two.refine(bits).box[i]):
            return False
    first, second = (_coordinate_polynomial(p, i) for p in (one, two))
    if first != second:
        return False
    roots = real_roots(first)
    if len(roots) == 1:
        return True
    while True:
        # two conjugates further apart than the boxes are long are told apart by disjoint balls
        with at_precision(2 * bits + 64):
            balls = [refined_root(first, low, high, bits) for low, high in roots]
            a, b = one.refine(bits).box[i], two.refine(bits).box[i]
            near_a = [k for k, r in enumerate(balls) if r.overlaps(a)]
            near_b = [k for k, r in enumerate(balls) if r.overlaps(b)]
        if len(near_a) == len(near_b) == 1:
            return near_a == near_b
        bits *= 2


def _coordinate_polynomial(point: RealPoint, i: int) -> fmpz_poly:
    """The minimal polynomial over Z of one coordinate: the squarefree part of Res_t(minimal, D x - N)."""
    ring = Ring(("t", "x"))
    t, x = ring.gens

    def lift(coefficients: Sequence[int]) -> Polynomial:
        return sum((t**k * c for k, c in enumerate(coefficients)), start=ring.zero)

    below, above = lift(point.denominator), lift(point.numerators[i])
    resultant = Polynomial(ring, lift(point.minimal).value.resultant((x * below - above).value, "t"))
    part = resultant.squarefree_part()
    coefficients = [0] * (part.degree("x") + 1)
    for (_, e), c in part.integer().terms():
        coefficients[e] = int(c)
    return fmpz_poly(coefficients)


def _decimal(ball: arb, rational: Fraction | None, digits: int) -> str:
    if rational is not None and rational.denominator == 1 and abs(rational) < 10**digits:
        return str(rational)
    return str(ball.str(digits, radius=False, more=True))
