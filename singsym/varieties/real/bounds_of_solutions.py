"""Bounds on the real solutions of equations: of sums of squares less a constant, such as link lengths.

Source: Benhamou, Granvilliers, Handbook of Constraint Programming (2006), ch. 16 (interval propagation).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import inf, prod

from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.ranges import (
    EVERYTHING,
    Bound,
    Interval,
    fraction,
    meet,
    polynomial_range,
    root_above,
    rounded_out,
    term_ranges,
)
from singsym.polynomials.sums_of_squares import squares_less_constant

_ROUNDS = 6


def solution_bounds(ring: Ring, equations: Sequence[Polynomial]) -> dict[str, Interval] | None:
    """Rational intervals, by name, that hold all real solutions; `None` where there is none.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> solution_bounds(R, [x**2 - 4, (x - y) ** 2 - 1])["y"]
    (Fraction(-3, 1), Fraction(3, 1))
    """
    forms: list[tuple[Polynomial, Fraction]] = []
    for f in equations:
        if 0 < f.total_degree <= 2:
            forms.append((f, Fraction(0)))
        found = squares_less_constant(f)
        if found is None:
            continue
        if found[2] < 0:
            return None
        linear = ((d, root) for d, root in found[1] if root.total_degree == 1)
        forms += [(root, root_above(fraction(found[2] / d))) for d, root in linear]
    bounds: dict[str, Interval] = {c.name: (c.low, c.high) for c in ring.constants}
    for _ in range(_ROUNDS):
        before = dict(bounds)
        for form, limit in forms:
            _narrow(bounds, form, limit)
        if any(low > high for low, high in bounds.values()):
            return None
        if bounds == before:
            break
    return {name: (low, high) for name, (low, high) in bounds.items() if -inf < low and high < inf}


def _narrow(bounds: dict[str, Interval], form: Polynomial, limit: Fraction) -> None:
    """Use |form| <= limit on each variable that is in one term only, alone and at most squared."""
    terms = {tuple(map(int, m)): ends for m, ends in term_ranges(form, bounds)}
    for name in form.variables:
        k = form.ring.index(name)
        own = [m for m in terms if m[k]]
        if len(own) > 1 or sum(own[0]) != own[0][k] or own[0][k] > 2:
            continue
        lows, highs = zip(*(ends for m, ends in terms.items() if m not in own), (0, 0), strict=True)
        ends = (-limit - sum(highs), limit - sum(lows))
        slope = fraction(form.coefficient(name, own[0][k]).constant)
        low, high = sorted(end / slope for end in ends)
        if own[0][k] == 2:
            low, high = _roots_of(high)
        bounds[name] = meet(bounds.get(name, EVERYTHING), rounded_out((low, high)))


def _roots_of(most: Bound) -> Interval:
    """Where a square is not above a bound; an empty interval where the bound is negative."""
    if most < 0:
        return Fraction(1), Fraction(-1)
    root = inf if most == inf else root_above(Fraction(most))
    return -root, root


def sign_within(polynomial: Polynomial, bounds: Mapping[str, Interval]) -> int:
    """The sign of a polynomial wherever the variables keep their bounds; 0 where these do not tell it."""
    low, high = polynomial_range(polynomial, bounds)
    return int(low > 0) - int(high < 0)


def extreme_values(polynomial: Polynomial, bounds: Mapping[str, Interval]) -> tuple[Polynomial, ...]:
    """What vanishes with a polynomial that is zero within the bounds only where all its terms are extreme.

    Lemma: a sum of terms has its largest value only where each term has; a monomial has its largest absolute
    value, not zero, only where all its variables have.

    >>> x, y = Ring(("x", "y")).gens
    >>> one = (Fraction(-1), Fraction(1))
    >>> extreme_values(x * y - 1, {"x": one, "y": one})
    (x*y - 1, x^2 - 1, y^2 - 1)
    """
    if not set(polynomial.variables) <= set(bounds):
        return ()
    ring = polynomial.ring
    terms = list(term_ranges(polynomial, bounds))
    coefficients = [c for _, c in polynomial.terms()]
    for side in (0, 1):
        if sum(ends[side] for _, ends in terms):
            continue
        equations: list[Polynomial] = []
        for (exponents, ends), c in zip(terms, coefficients, strict=True):
            if not any(exponents):
                continue
            value = Fraction(ends[side])
            equations.append(ring.from_dict({tuple(exponents): c}) - value)
            powers = {n: int(e) for n, e in zip(ring.names, exponents, strict=True) if e}
            largest = {n: Fraction(max(-bounds[n][0], bounds[n][1])) for n in powers}
            if value and abs(value) == abs(fraction(c)) * prod(largest[n] ** e for n, e in powers.items()):
                equations += [ring.gen(n) ** 2 - end**2 for n, end in largest.items()]
        return tuple(p for p in dict.fromkeys(equations) if p)
    return ()
