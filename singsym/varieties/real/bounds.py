"""Bounds on the real solutions of equations that are sums of squares less a constant, such as link lengths.

Source: Benhamou, Granvilliers, Handbook of Constraint Programming (2006), ch. 16 (interval propagation).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt

from flint import arb, fmpq

from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.intervals import at_precision, ball, evaluate
from singsym.varieties.real.squares import squares_less_constant

_ROUNDS = 6
_FINENESS = 2**32
Interval = tuple[Fraction, Fraction]


def solution_bounds(ring: Ring, equations: Sequence[Polynomial]) -> dict[str, Interval] | None:
    """Rational intervals, by name, that hold all real solutions; `None` where there is none.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> solution_bounds(R, [x**2 - 4, (x - y) ** 2 - 1])["y"]
    (Fraction(-3, 1), Fraction(3, 1))
    """
    forms: list[tuple[dict[str, Fraction], Fraction, Fraction]] = []
    for f in equations:
        found = squares_less_constant(f)
        if found is None:
            continue
        if found[2] < 0:
            return None
        for d, root in found[1]:
            if root.total_degree == 1:
                weights = {n: _fraction(root.coefficient(n, 1).constant) for n in root.variables}
                forms.append((weights, _fraction(root.constant), _root_above(_fraction(found[2] / d))))
    bounds: dict[str, Interval] = {c.name: (c.low, c.high) for c in ring.constants}
    for _ in range(_ROUNDS):
        for weights, constant, limit in forms:
            _narrow(bounds, weights, constant, limit)
    return None if any(low > high for low, high in bounds.values()) else bounds


def sign_within(polynomial: Polynomial, bounds: dict[str, Interval]) -> int:
    """The sign of a polynomial wherever the variables keep their bounds; 0 where these do not tell it."""
    if not set(polynomial.variables) <= set(bounds):
        return 0
    with at_precision(64):
        box = []
        for name in polynomial.ring.names:
            low, high = bounds.get(name, (Fraction(0), Fraction(0)))
            box.append(ball(low).union(ball(high)))
        value: arb = evaluate(polynomial, box)
    return int(value > 0) - int(value < 0)


def extreme_values(polynomial: Polynomial, bounds: dict[str, Interval]) -> tuple[Polynomial, ...]:
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
    terms = [(ring.from_dict({m: c}), *_term_range(ring.names, m, c, bounds)) for m, c in polynomial.terms()]
    for side in (1, 2):
        if sum((term[side] for term in terms), start=Fraction(0)):
            continue
        equations: list[Polynomial] = []
        for term, *ends in terms:
            value = ends[side - 1]
            if not term.is_constant:
                equations.append(term - _rational(value))
            if value:
                largest = {n: max(map(abs, bounds[n])) for n in term.variables}
                equations += [ring.gen(n) ** 2 - _rational(end**2) for n, end in largest.items()]
        return tuple(p for p in dict.fromkeys(equations) if p)
    return ()


def _term_range(
    names: Sequence[str], exponents: Sequence[int], coefficient: fmpq, bounds: dict[str, Interval]
) -> Interval:
    """Bounds of a term that are exact where the bounds of its variables are symmetric about 0."""
    low = high = _fraction(coefficient)
    for name, e in zip(names, map(int, exponents), strict=True):
        if e:
            ends = sorted(end**e for end in bounds[name])
            if e % 2 == 0 and bounds[name][0] < 0 < bounds[name][1]:
                ends[0] = Fraction(0)
            products = [a * b for a in (low, high) for b in ends]
            low, high = min(products), max(products)
    return low, high


def _narrow(
    bounds: dict[str, Interval], weights: dict[str, Fraction], constant: Fraction, limit: Fraction
) -> None:
    """Use |sum of weights x + constant| <= limit on each variable whose companions are bounded."""
    for name, weight in weights.items():
        others = [n for n in weights if n != name]
        if not all(n in bounds for n in others):
            continue
        ends = [sorted((weights[n] * bounds[n][0], weights[n] * bounds[n][1])) for n in others]
        low = -limit - constant - sum((e[1] for e in ends), start=Fraction(0))
        high = limit - constant - sum((e[0] for e in ends), start=Fraction(0))
        low, high = sorted((low / weight, high / weight))
        before = bounds.get(name, (low, high))
        bounds[name] = (max(low, before[0]), min(high, before[1]))


def _root_above(square: Fraction) -> Fraction:
    """A rational not below the square root, exact for squares of rationals."""
    p, q = square.numerator, square.denominator
    if isqrt(p) ** 2 == p and isqrt(q) ** 2 == q:
        return Fraction(isqrt(p), isqrt(q))
    return Fraction(isqrt(p * _FINENESS**2 // q) + 1, _FINENESS)


def _rational(number: Fraction) -> fmpq:
    return fmpq(number.numerator, number.denominator)


def _fraction(number: fmpq) -> Fraction:
    return Fraction(int(number.p), int(number.q))
