"""All real solutions of a module of four unknowns: a crank with a dyad over it that one more circle holds.

Source: the coupler curve of a four-bar and a circle meet in six points; Hunt, Kinematic Geometry of
Mechanisms (1978), ch. 7.  Two lines through the corner of a dyad give it by Cramer's rule, which leaves one
polynomial in the half angle of the crank.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import combinations

from flint import arb, arb_poly, fmpq, fmpq_poly

from singsym.effort.budget import Undecided
from singsym.polynomials import Equations, Polynomial
from singsym.polynomials.block_form import Module
from singsym.polynomials.ranges import fraction, root_above
from singsym.varieties.real.modules.assemblies import is_circle, real_roots_of, value_at
from singsym.varieties.real.points.intervals import ball

Balls = Mapping[str, arb]
_TURN = (fmpq(20, 29), fmpq(21, 29))
"""Cosine and sine of the angle from which the crank's half angle is measured: not that of a stretched one."""


@dataclass(frozen=True)
class Triad:
    """A crank (x, y) on a circle of rational centre and radius, and (u, v) on two lines and a circle.

    lines: coefficients of u, v, 1 of each, in the crank and the parents.
    closing: A and B, by powers of x - m: the closing polynomial is A + (y - n) B on the crank's circle.
    """

    crank: tuple[str, str]
    corner: tuple[str, str]
    centre: tuple[Fraction, Fraction]
    radius: Fraction
    lines: tuple[Equations, Equations]
    closing: tuple[Equations, Equations]

    def solutions(self, known: Balls) -> Iterator[dict[str, arb]]:
        """All over these values of the parents; raises `Undecided` where balls do not tell.

        Lemma: at a solution the corner is on both lines, and the closing polynomial vanishes, whether they
        are one or not; where it vanishes and the lines are not parallel there is just one solution.
        """
        polynomial = self._in_half_angle(known)
        for root in real_roots_of(polynomial):
            t = _refined(arb_poly(polynomial), root)
            scale, turn = 1 + t * t, tuple(map(_arb, _TURN))
            cosine, sine = (1 - t * t) / scale, 2 * t / scale
            m, n, r = map(ball, (*self.centre, self.radius))
            values = {
                self.crank[0]: m + r * (turn[0] * cosine - turn[1] * sine),
                self.crank[1]: n + r * (turn[1] * cosine + turn[0] * sine),
            }
            (a, b, c), (d, e, f) = ([value_at(p, {**known, **values}) for p in line] for line in self.lines)
            divisor = a * e - b * d
            if divisor.contains(0):
                raise Undecided("whether two lines of a triad are parallel is not seen")
            yield {
                **values,
                self.corner[0]: (b * f - c * e) / divisor,
                self.corner[1]: (c * d - a * f) / divisor,
            }

    def _in_half_angle(self, known: Balls) -> list[arb]:
        """The coefficients of the closing polynomial in the tangent of half the crank's angle."""
        plain, with_sine = self.closing
        degree = max(len(plain) - 1, len(with_sine))
        (cos, sin), square = _TURN, fmpq_poly([1, 0, 1])
        across = fmpq_poly([cos, -2 * sin, -cos])
        along = fmpq_poly([sin, 2 * cos, -sin])
        r = fmpq(self.radius.numerator, self.radius.denominator)
        total = [arb(0)] * (2 * degree + 1)
        for half, coefficients in enumerate((plain, with_sine)):
            for i, p in enumerate(coefficients):
                form = (r * across) ** i * (r * along) ** half * square ** (degree - i - half)
                value = value_at(p, known)
                for k, coefficient in enumerate(form.coeffs()):
                    total[k] += value * _arb(coefficient)
        return total


@lru_cache(maxsize=1024)
def triad(module: Module) -> Triad | None:
    """A module of four unknowns as a triad, where it is one."""
    if len(module.unknowns) != 4:
        return None
    for circle in module.equations:
        others = tuple(p for p in module.equations if p is not circle)
        for x, y in combinations(module.unknowns, 2):
            corner = [name for name in module.unknowns if name not in (x, y)]
            if {*circle.variables} == {x, y} and is_circle(circle, (x, y)):
                return _over(circle, (x, y), (corner[0], corner[1]), others)
    return None


def _over(
    circle: Polynomial, crank: tuple[str, str], corner: tuple[str, str], others: Equations
) -> Triad | None:
    (x, y), (u, v) = crank, corner
    if not all(is_circle(p, corner) for p in others):
        return None
    conic, *two = sorted(others, key=len)
    lead = conic.coefficient(u, 2)
    lines = tuple(_line(p * lead - conic * p.coefficient(u, 2), u, v) for p in two)
    a, b, c, d = (fraction(circle.coefficient(x, i).coefficient(y, j).constant) for i, j in _PLACES)
    m, n = -b / (2 * a), -c / (2 * a)
    square = m * m + n * n - d / a
    radius = root_above(square) if square > 0 else Fraction(0)
    if not radius or radius * radius != square:
        return None
    (a1, b1, c1), (a2, b2, c2) = lines
    scale, top, side = a1 * b2 - a2 * b1, b1 * c2 - b2 * c1, c1 * a2 - c2 * a1
    along, across, rest = _line(conic, u, v)
    closing = lead * (top * top + side * side) + (along * top + across * side + rest * scale) * scale
    return Triad(
        crank, corner, (m, n), radius, (lines[0], lines[1]), _on_circle(closing, crank, (m, n), square)
    )


_PLACES = ((2, 0), (1, 0), (0, 1), (0, 0))


def _line(p: Polynomial, u: str, v: str) -> Equations:
    """The coefficients of u, v, 1."""
    one = p.coefficient(u, 0)
    return p.coefficient(u, 1), one.coefficient(v, 1), one.coefficient(v, 0)


def _on_circle(
    p: Polynomial, crank: tuple[str, str], centre: tuple[Fraction, Fraction], square: Fraction
) -> tuple[Equations, Equations]:
    """A and B, by powers of x - m, such that p = A + (y - n) B where (x - m)^2 + (y - n)^2 is that square."""
    x, y = map(p.ring.gen, crank)
    moved = p.substitute({crank[0]: x + centre[0], crank[1]: y + centre[1]})
    halves = [p.ring.zero, p.ring.zero]
    for k in range(moved.degree(crank[1]) + 1):
        halves[k % 2] += moved.coefficient(crank[1], k) * (square - x**2) ** (k // 2)
    plain, with_sine = (
        tuple(h.coefficient(crank[0], i) for i in range(h.degree(crank[0]) + 1)) for h in halves
    )
    return plain, with_sine


def _refined(polynomial: arb_poly, root: arb) -> arb:
    """A ball that holds the same root, as small as coefficients and precision allow (Newton)."""
    slopes = polynomial.derivative()
    while True:
        slope, middle = slopes(root), arb(root.mid())
        if slope.contains(0):
            raise Undecided("whether two solutions of a triad are one is not seen")
        nearer = middle - polynomial(middle) / slope
        if not nearer.rad() < root.rad() / 2:
            return root
        root = nearer


def _arb(x: fmpq) -> arb:
    return arb(x.p) / arb(x.q)
