"""Real roots of one polynomial over Z: isolating intervals by Descartes' rule of signs, and their refinement.

Source: Collins, Akritas, Polynomial real root isolation using Descartes' rule of signs, SYMSAC 1976, 272-275;
interval Newton steps by Arb (https://arblib.org).
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

from flint import arb, fmpq, fmpz, fmpz_poly

from singsym.effort.budget import current
from singsym.varieties.real.points.intervals import at_precision, ball

_SHIFT = fmpz_poly([1, 1])


def real_roots(squarefree: fmpz_poly) -> list[tuple[Fraction, Fraction]]:
    """Disjoint rational intervals in increasing order, each with one real root and all of them covered.

    A root is inside its interval, or is both ends of it.  Raises `BudgetExceeded`, also where the
    polynomial is not squarefree.

    >>> real_roots(fmpz_poly([0, -2, 0, 1]))
    [(Fraction(-2, 1), Fraction(-1, 1)), (Fraction(0, 1), Fraction(0, 1)), (Fraction(1, 1), Fraction(2, 1))]
    """
    if squarefree.degree() == 1:
        root = Fraction(-int(squarefree[0]), int(squarefree[1]))
        return [(root, root)]
    reach = _bound(squarefree)
    found = [(Fraction(0), Fraction(0))] if squarefree[0] == 0 else []
    for side in (1, -1):
        scale = Fraction(side * 2**reach)
        for low, high in _inside(squarefree(fmpz_poly([0, side * fmpz(2) ** reach]))):
            ends = sorted((low * scale, high * scale))
            found.append((ends[0], ends[1]))
    return sorted(found)


def _bound(polynomial: fmpz_poly) -> int:
    """An exponent e >= 0 with all roots below 2^e in absolute value (Fujiwara's bound)."""
    coefficients = [abs(c).bit_length() for c in map(int, polynomial.coeffs())]
    lead = coefficients.pop()
    excess = (-((lead - 1 - bits) // k) for k, bits in enumerate(reversed(coefficients), start=1) if bits)
    return max(0, *(e + 1 for e in excess), 0)


def _inside(polynomial: fmpz_poly) -> list[tuple[Fraction, Fraction]]:
    """The roots in (0, 1); an interval is halved as long as one of its ends is another root."""
    found = []
    waiting = [(polynomial, 0, 0)]
    while waiting:
        current().check("the isolation of real roots")
        p, depth, place = waiting.pop()
        count = _variations(fmpz_poly(p.coeffs()[::-1])(_SHIFT))
        if not count:
            continue
        if count == 1 and p[0] != 0 and p(1) != 0:
            found.append((Fraction(place, 2**depth), Fraction(place + 1, 2**depth)))
            continue
        degree = p.degree()
        left = fmpz_poly([c << (degree - i) for i, c in enumerate(p.coeffs())])
        right = left(_SHIFT)
        if right[0] == 0:
            middle = Fraction(2 * place + 1, 2 ** (depth + 1))
            found.append((middle, middle))
        waiting += [(left, depth + 1, 2 * place), (right, depth + 1, 2 * place + 1)]
    return found


def _variations(polynomial: fmpz_poly) -> int:
    """The sign changes in the coefficients, zeros left out."""
    signs = [c > 0 for c in polynomial.coeffs() if c]
    return sum(a != b for a, b in pairwise(signs))


def has_real_root(polynomial: fmpz_poly) -> bool:
    """Whether a polynomial over Z in one variable, not zero, has a real root.

    >>> has_real_root(fmpz_poly([1, 0, 1])), has_real_root(fmpz_poly([1, 2, 1]))
    (False, True)
    """
    return polynomial.degree() > 0 and bool(real_roots(polynomial // polynomial.gcd(polynomial.derivative())))


def refined_root(polynomial: fmpz_poly, low: Fraction, high: Fraction, bits: int) -> arb:
    """A ball of relative radius below 2^-bits around the only root in an interval of `real_roots`.

    Relative to the root, or to 2^-bits where that is larger.
    """
    precision = bits + 32
    derivative = polynomial.derivative()
    while True:
        with at_precision(precision + 32 + polynomial.height_bits() // 8):
            if low == high:
                return ball(low)
            interval = ball(low).union(ball(high))
            for _ in range(4 + precision.bit_length()):
                if interval.rad() <= abs(interval.mid()).max(arb(2) ** -bits) * arb(2) ** -bits:
                    return interval
                middle = arb(interval.mid())
                slope = derivative(interval)
                if slope.contains(0):
                    current().check("the refinement of a real root")
                    low, high = halved(polynomial, low, high)
                    interval = ball(low).union(ball(high))
                    continue
                step = middle - polynomial(middle) / slope
                if not step.overlaps(interval):
                    raise ArithmeticError(f"no root of the polynomial between {low} and {high}")
                interval = step.intersection(interval)
        precision *= 2


def halved(polynomial: fmpz_poly, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """The half of an interval of `real_roots` that holds the root, or the root as both ends."""
    middle = (low + high) / 2
    at_low, at_middle = (polynomial(fmpq(x.numerator, x.denominator)) for x in (low, middle))
    if at_middle == 0:
        return middle, middle
    return (middle, high) if (at_low > 0) == (at_middle > 0) else (low, middle)
