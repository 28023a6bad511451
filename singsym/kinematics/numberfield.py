"""One real number field for all irrational numbers of a mechanism, with few generators.

Source: Gauss sums and real cyclotomic fields: Washington, Introduction to Cyclotomic Fields, chapters 2-4.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache, cached_property
from math import isqrt, lcm
from typing import Any

import sympy
from flint import fmpq, fmpq_mat

from singsym.polynomials import AlgebraicConstant, Polynomial, Ring

_FINENESS = 2**24
"""Constants are told apart from their conjugates by intervals about as narrow as its inverse."""


class Atoms:
    """Irrational numbers met while reading expressions: square roots, cosines of rational angles, others."""

    def __init__(self) -> None:
        self.squarefree: set[int] = set()
        self.order = 1
        self.others: dict[sympy.Expr, None] = {}

    def root(self, base: Any, index: int) -> None:
        """Note base^(1/index); the base is a number, positive if the index is even."""
        if base.is_negative:
            raise ValueError(f"the root of {base} is not real")
        if index == 2 and base.is_Rational:
            self.squarefree.add(_squarefree(int(base.p * base.q))[0])
        else:
            self.others[base ** sympy.Rational(1, index)] = None

    def angle(self, e: Any) -> None:
        """Note sin, cos or tan of a rational multiple of pi."""
        self.order = lcm(self.order, *(_turn(f).denominator for f in _cosines(e)))


@dataclass(frozen=True)
class NumberField:
    """A real number field Q(constants): the constants' minimal polynomials are together a maximal ideal.

    images: the numbers met, as polynomials in the constants.
    """

    constants: tuple[AlgebraicConstant, ...] = ()
    order: int = 1
    images: Mapping[sympy.Expr, Polynomial] = field(default_factory=dict)

    @cached_property
    def ring(self) -> Ring:
        """The ring of the constants alone."""
        return Ring(tuple(c.name for c in self.constants), constants=self.constants)

    def image(self, number: Any) -> Polynomial:
        """A root, sine or cosine that was met; raises `ValueError` for one that was not."""
        if number in self.images:
            return self.images[number]
        if isinstance(number, (sympy.sin, sympy.cos)):
            turn = _turn(_cosines(number)[0])
            if self.order % turn.denominator == 0 and self.order > 1:
                return _chebyshev(self.ring, self.ring.gens[0], int(turn * self.order))
        if number.is_Pow and number.exp.is_Rational and number.base.is_Rational and number.exp.q == 2:
            free, factor = _squarefree(int(number.base.p * number.base.q))
            root = sympy.sqrt(free)
            if root in self.images:
                return self.images[root] * Fraction(factor, int(number.base.q))
            generators = [-c.minimal[0] for c in self.constants if c.name == f"sqrt{-c.minimal[0]}"]
            found = _express(free, generators, self.order)
            if found is not None:
                return _composed(self, found) * Fraction(factor, int(number.base.q))
        raise ValueError(f"the number {number} was not announced: pass it to Dimensions.of as extra")

    def inverse(self, polynomial: Polynomial) -> Polynomial:
        """1/p for a nonzero element, by linear algebra over Q."""
        polynomial = self.ring.reduced(polynomial)
        if polynomial.is_zero:
            raise ZeroDivisionError("division by a number that is zero")
        if polynomial.is_constant:
            return self.ring.constant(1 / polynomial.constant)
        degrees = [range(len(c.minimal) - 1) for c in self.constants]
        basis = list(itertools.product(*degrees))
        place = {m: i for i, m in enumerate(basis)}
        matrix = fmpq_mat(len(basis), len(basis))
        for j, m in enumerate(basis):
            for exponents, c in self.ring.reduced(polynomial * self.ring.from_dict({m: 1})).terms():
                matrix[place[tuple(int(e) for e in exponents)], j] = c
        one = fmpq_mat(len(basis), 1)
        one[place[(0,) * len(self.constants)], 0] = fmpq(1)
        solution = matrix.solve(one)
        return self.ring.from_dict({m: solution[i, 0] for i, m in enumerate(basis) if solution[i, 0] != 0})


def number_field(atoms: Atoms) -> NumberField:
    """The field that holds all these numbers.

    The square roots are reduced to a basis of their products; those inside the field of the cosines are
    expressed there.  Anything else (cube roots, nested roots) goes over a primitive element.

    >>> atoms = Atoms()
    >>> for n in (2, 3, 6): atoms.root(sympy.Integer(n), 2)
    >>> F = number_field(atoms)
    >>> F.constants, F.image(sympy.sqrt(6))
    ((sqrt2, sqrt3), sqrt2*sqrt3)
    """
    if atoms.others:
        return _primitive(atoms)
    order = _useful(atoms.order)
    generators: list[int] = []
    expressed: dict[int, tuple[int, tuple[int, ...], Fraction]] = {}
    for d in sorted(atoms.squarefree - {1}):
        found = _express(d, generators, order)
        if found is None:
            generators.append(d)
            found = (1, (d,), Fraction(1))
        expressed[d] = found
    constants = [] if order == 1 else [_cosine_constant(order)]
    constants += [
        AlgebraicConstant(
            f"sqrt{d}",
            (-d, 0, 1),
            Fraction(isqrt(d * _FINENESS**2), _FINENESS),
            Fraction(isqrt(d * _FINENESS**2) + 1, _FINENESS),
            rf"\sqrt{{{d}}}",
            f"sqrt({d})",
        )
        for d in generators
    ]
    empty = NumberField(tuple(constants), order)
    images = {}
    for d, found in expressed.items():
        images[sympy.sqrt(d)] = _composed(empty, found)
    return NumberField(tuple(constants), order, images)


def _squarefree(n: int) -> tuple[int, int]:
    """(d, k) with n = d k^2 and d squarefree."""
    d, k = 1, 1
    for prime, power in sympy.factorint(n).items():
        d *= prime ** (power % 2)
        k *= prime ** (power // 2)
    return int(d), int(k)


def _express(d: int, generators: list[int], order: int) -> tuple[int, tuple[int, ...], Fraction] | None:
    """sqrt(d) as ratio * sqrt(inside) * product of generators, `inside` a root in the field of cosines."""
    for size in range(len(generators) + 1):
        for chosen in itertools.combinations(generators, size):
            product = d
            for g in chosen:
                product *= g
            inside, _ = _squarefree(product)
            if inside == 1 or order % _conductor(inside) == 0:
                whole = inside
                for g in chosen:
                    whole *= g
                return inside, chosen, Fraction(1, isqrt(whole // d))
    return None


def _composed(numbers: NumberField, found: tuple[int, tuple[int, ...], Fraction]) -> Polynomial:
    """The root that `_express` has found, as a polynomial in the constants."""
    inside, factors, ratio = found
    image = numbers.ring.constant(ratio)
    for g in factors:
        image = image * numbers.ring.gen(f"sqrt{g}")
    if inside > 1:
        image = image * _gauss_sum(numbers.ring, numbers.constants[0].name, inside, numbers.order)
    return numbers.ring.reduced(image)


def _conductor(d: int) -> int:
    """The least m with sqrt(d) among the m-th roots of unity's sums, d > 1 squarefree."""
    return d if d % 4 == 1 else 4 * d


def _useful(order: int) -> int:
    """Q(cos 2 pi/m) is Q for m = 1, 2, 3, 4, 6."""
    return 1 if order in (1, 2, 3, 4, 6) else order


def _cosines(e: Any) -> list[Any]:
    """The angles whose cosines give e: cos x itself, sin x = cos(pi/2 - x), tan x both."""
    x = e.args[0]
    if isinstance(e, sympy.cos):
        return [x]
    if isinstance(e, sympy.sin):
        return [sympy.pi / 2 - x]
    return [sympy.pi / 2 - x, x]


def _turn(angle: Any) -> Fraction:
    """An angle as a fraction of a full turn, between 0 and 1."""
    turn = sympy.expand(angle / (2 * sympy.pi))
    if not turn.is_Rational:
        raise ValueError(f"sin and cos need a rational multiple of pi, not {angle}")
    return Fraction(int(turn.p), int(turn.q)) % 1


def _gauss_sum(ring: Ring, name: str, d: int, order: int) -> Polynomial:
    """sqrt(d) in the field of cosines: sqrt(D) = sum of (D/k) cos(2 pi k/D) for the discriminant D."""
    conductor = _conductor(d)
    total = ring.zero
    for k in range(1, conductor):
        sign = int(sympy.kronecker_symbol(conductor, k))
        if sign:
            total = total + _chebyshev(ring, ring.gen(name), k * (order // conductor)) * sign
    return total if conductor == d else total / 2


@cache
def _cosine_constant(order: int) -> AlgebraicConstant:
    """cos(2 pi/m), the largest root of its minimal polynomial below 1."""
    number = sympy.cos(2 * sympy.pi / order)
    name = f"cos{360 // order}deg" if 360 % order == 0 else f"cos2pi{order}"
    return _isolated(name, number, sympy.minimal_polynomial(number, sympy.Symbol("x"), polys=True))


def _isolated(name: str, number: Any, minimal: Any) -> AlgebraicConstant:
    """An algebraic constant from its minimal polynomial and an expression that evaluates to it."""
    coefficients = tuple(int(c) for c in reversed(minimal.all_coeffs()))
    value = Fraction(str(sympy.N(number, 60)))
    width = Fraction(1, 4)
    while minimal.count_roots(sympy.Rational(value - width), sympy.Rational(value + width)) != 1:
        width /= 4
    width = max(min(width / 4, Fraction(1, _FINENESS)), Fraction(1, 10**50))
    low = Fraction(int((value - width) * 10**50) - 1, 10**50).limit_denominator(10**6)
    high = Fraction(int((value + width) * 10**50) + 1, 10**50).limit_denominator(10**6)
    if not low < value < high or minimal.count_roots(sympy.Rational(low), sympy.Rational(high)) != 1:
        low, high = value - width, value + width
    return AlgebraicConstant(name, coefficients, low, high, sympy.latex(number), str(number))


def _primitive(atoms: Atoms) -> NumberField:
    """Q(theta) with theta an integer combination of all numbers met (SymPy's primitive element)."""
    numbers = [*atoms.others, *(sympy.sqrt(d) for d in sorted(atoms.squarefree - {1}))]
    order = _useful(atoms.order)
    if order > 1:
        numbers.insert(0, sympy.cos(2 * sympy.pi / order))
    x = sympy.Symbol("x")
    minimal, weights, forms = sympy.primitive_element(numbers, x, ex=True, polys=True)
    theta = sympy.Add(*(w * n for w, n in zip(weights, numbers, strict=True)))
    constant = _isolated("theta", theta, minimal.clear_denoms(convert=True)[1])
    ring = Ring(("theta",), constants=(constant,))
    images = {}
    for number, form in zip(numbers, forms, strict=True):
        coefficients = [Fraction(int(c.numerator), int(c.denominator)) for c in map(sympy.Rational, form)]
        images[number] = ring.from_dict({(i,): c for i, c in enumerate(reversed(coefficients))})
    if order > 1:
        for k in range(order):
            angle = sympy.cos(2 * sympy.pi * k / order)
            images.setdefault(angle, _chebyshev(ring, images[numbers[0]], k))
    return NumberField((constant,), 1, images)


def _chebyshev(ring: Ring, x: Polynomial, k: int) -> Polynomial:
    """cos(k t) as a polynomial in x = cos(t): Chebyshev's T_k, reduced."""
    before, now = ring.one, x
    for _ in range(k):
        following = ring.reduced(x * now * 2 - before)
        before, now = now, following
    return before
