"""Factorisation of polynomials in cosines and sines modulo c^2 + s^2 = 1.

Source: c = u^2 - v^2, s = 2 u v with u^2 + v^2 = 1 makes a trigonometric polynomial a form in (u, v) of
the half-angle, whose factors are unique; those of even degree are trigonometric polynomials again.  No angle
is lost, as tan(theta/2) would lose pi.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from flint import fmpq

from singsym.polynomials import Polynomial
from singsym.polynomials.unit_circles import Pair

Factors = list[tuple[Polynomial, int]]


def trigonometric_factors(polynomial: Polynomial, pairs: Sequence[Pair]) -> Factors:
    """Factors whose product has the polynomial's values on the circles, up to a constant.

    pairs: cosines and sines, no variable in two of them.
    Half-angle factors of odd degree are multiplied together with others until all degrees are even.

    >>> from singsym.polynomials import Ring
    >>> c, s, d, t = Ring(("c", "s", "d", "t")).gens
    >>> product = (c * d - s * t + 2) * (s * d + c * t)
    >>> reduced = product + (c**2 + s**2 - 1) * (t - 3)
    >>> trigonometric_factors(reduced, (("c", "s"), ("d", "t")))
    [(s*d + c*t, 1), (c*d - s*t + 2, 1)]
    """
    used = [pair for pair in pairs if set(pair) & set(polynomial.variables)]
    if not used or polynomial.is_zero:
        return polynomial.factors()
    form = _form(polynomial, used)
    parts = form.factors()
    if len(parts) == 1 and parts[0][1] == 1:
        return [(polynomial.primitive(), 1)]
    squares = {(form.ring.gen(c) ** 2 + form.ring.gen(s) ** 2).primitive() for c, s in used}
    even: Factors = []
    odd: dict[tuple[int, ...], list[Polynomial]] = {}
    for factor, multiplicity in parts:
        if factor in squares:
            continue
        parity = tuple(_degree(factor, pair) % 2 for pair in used)
        if any(parity):
            odd.setdefault(parity, []).extend([factor] * multiplicity)
        else:
            even.append((factor, multiplicity))
    result = [(_trigonometric(f, used).primitive(), k) for f, k in (*even, *_joined(odd))]
    return sorted(result, key=lambda pair: (len(pair[0]), pair[0].total_degree, str(pair[0])))


def _degree(form: Polynomial, pair: Pair) -> int:
    """The degree of a form in the two variables of a pair together."""
    i, j = (form.ring.index(name) for name in pair)
    exponents = form.leading_term[0]
    return int(exponents[i] + exponents[j])


def _form(polynomial: Polynomial, pairs: Sequence[Pair]) -> Polynomial:
    """The form in the half-angles; the names of a pair now stand for (u, v)."""
    ring = polynomial.ring
    places = [(ring.index(c), ring.index(s)) for c, s in pairs]
    orders = [max(int(m[i] + m[j]) for m, _ in polynomial.terms()) for i, j in places]
    images = list(ring.gens)
    for i, j in places:
        u, v = ring.gens[i], ring.gens[j]
        images[i], images[j] = u * u - v * v, 2 * u * v
    lift = [ring.gens[i] ** 2 + ring.gens[j] ** 2 for i, j in places]
    by_deficit: dict[tuple[int, ...], dict[tuple[int, ...], fmpq]] = {}
    for exponents, c in polynomial.terms():
        present = (int(exponents[i] + exponents[j]) for i, j in places)
        deficit = tuple(order - k for order, k in zip(orders, present, strict=True))
        by_deficit.setdefault(deficit, {})[exponents] = c
    values = dict(zip(ring.names, images, strict=True))
    total = ring.zero
    for deficit, terms in by_deficit.items():
        part = ring.from_dict(terms).substitute(values)
        for power, square in zip(deficit, lift, strict=True):
            part = part * square**power
        total = total + part
    return total


def _joined(odd: dict[tuple[int, ...], list[Polynomial]]) -> Factors:
    """Products of factors of odd degree with even degree: equal parities two by two, what is left at once."""
    found: dict[Polynomial, int] = {}
    rest: Polynomial | None = None
    for factors in odd.values():
        distinct = sorted(factors, key=str)
        while len(distinct) > 1:
            first = distinct.pop(0)
            place = next((k for k, other in enumerate(distinct) if other != first), 0)
            product = first * distinct.pop(place)
            found[product] = found.get(product, 0) + 1
        for left in distinct:
            rest = left if rest is None else rest * left
    if rest is not None:
        found[rest] = found.get(rest, 0) + 1
    return list(found.items())


def _trigonometric(form: Polynomial, pairs: Sequence[Pair]) -> Polynomial:
    """The trigonometric polynomial of a form of even degree in each half-angle: 2 u^2 = 1 + c, 2 u v = s."""
    ring = form.ring
    total = ring.zero
    places = [(ring.index(c), ring.index(s)) for c, s in pairs]

    @cache
    def moved(place: tuple[int, int], a: int, b: int) -> Polynomial:
        c, s = (ring.gens[k] for k in place)
        even: Polynomial = (c + 1) ** (a // 2) * (1 - c) ** (b // 2) / 2 ** ((a + b) // 2)
        return even * s if a % 2 else even

    for exponents, coefficient in form.terms():
        rest = list(exponents)
        term = ring.one
        for place in places:
            term = term * moved(place, *(int(exponents[k]) for k in place))
            for k in place:
                rest[k] = 0
        total = total + term * ring.from_dict({tuple(rest): coefficient})
    return total
