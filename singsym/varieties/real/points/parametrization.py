"""The points of a zero-dimensional set as rational functions of the roots of one polynomial, proven exactly.

Source: Rouillier, Appl. Algebra Eng. Commun. Comput. 9 (1999) 433-461 (rational univariate representation).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isqrt, lcm

from flint import fmpz, fmpz_mat, fmpz_poly, nmod_mat, nmod_poly
from flint.utils.flint_exceptions import DomainError

from singsym.effort.chance import random, random_primes, sparing_prime
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.points.quotient_algebra import Algebra

Check = Callable[[], None]


@dataclass(frozen=True)
class Parametrization:
    """All points of a finite set: coordinate i is numerators[i] / denominator at the roots of minimal.

    minimal is squarefree; all three are polynomials over Z, constant coefficient first.
    """

    ring: Ring
    minimal: fmpz_poly
    denominator: fmpz_poly
    numerators: tuple[fmpz_poly, ...]

    def image(self, polynomial: Polynomial, check: Check = lambda: None) -> fmpz_poly:
        """A multiple of `polynomial` at the points, by a power of the denominator and a nonzero integer."""
        degree = polynomial.total_degree
        terms = {
            (*map(int, exponents), degree - int(sum(exponents))): fmpz(coefficient)
            for exponents, coefficient in polynomial.integer().terms()
        }
        return _value(terms, (*self.numerators, self.denominator), check)

    def vanishes(self, polynomial: Polynomial, check: Check = lambda: None) -> bool:
        """Whether `polynomial` is zero at every root of `minimal`: an exact division.

        >>> t = fmpz_poly([-2, 0, 1])
        >>> R = Ring(("x",))
        >>> Parametrization(R, t, fmpz_poly([1]), (fmpz_poly([0, 1]),)).vanishes(R.gens[0] ** 2 - 2)
        True
        """
        return polynomial.is_zero or divides(self.minimal, self.image(polynomial, check))

    def cost_of(self, polynomial: Polynomial) -> float:
        """About how many bits of arithmetic `vanishes` takes."""
        degree = polynomial.total_degree
        sizes = (self.minimal, self.denominator, *self.numerators)
        height = max(p.height_bits() for p in sizes)
        return float(len(polynomial) * degree**3 * self.minimal.degree() * height)

    def modulo(self, prime: int) -> tuple[nmod_poly, list[nmod_poly]] | None:
        """The minimal polynomial and the coordinates modulo it and a prime; None where that is unlucky."""
        minimal, below = nmod_poly(self.minimal, prime), nmod_poly(self.denominator, prime)
        if minimal.degree() < self.minimal.degree() or minimal.gcd(below).degree() > 0:
            return None
        # at degree 0 there is no root, and all is zero there
        inverse = below.xgcd(minimal)[1] if minimal.degree() > 0 else nmod_poly([], prime)
        return minimal, [nmod_poly(n, prime) * inverse % minimal for n in self.numerators]

    def vanishes_modulo(self, polynomial: Polynomial, prime: int | None = None) -> bool | None:
        """The same modulo a prime below 2^63; `False` proves that it does not vanish, `None` says nothing."""
        prime = prime or sparing_prime()
        coordinates = self.modulo(prime)
        if coordinates is None:
            return None
        minimal, values = coordinates
        powers: list[list[nmod_poly]] = [[nmod_poly([1], prime)] for _ in values]
        total = nmod_poly([], prime)
        for exponents, coefficient in polynomial.integer().terms():
            term = nmod_poly([int(coefficient) % prime], prime)
            for i, e in enumerate(exponents):
                while len(powers[i]) <= e:
                    powers[i].append(powers[i][-1] * values[i] % minimal)
                if e:
                    term = term * powers[i][e] % minimal
            total = total + term
        return not total % minimal


def _value(terms: dict[tuple[int, ...], fmpz], at: Sequence[fmpz_poly], check: Check) -> fmpz_poly:
    """The value of a polynomial, by factoring out what most of its terms have in common (Horner's rule)."""
    check()
    counts = [sum(1 for exponents in terms if exponents[i]) for i in range(len(at))]
    most = max(counts, default=0)
    if most == 0:
        return fmpz_poly([sum(terms.values(), fmpz(0))])
    i = counts.index(most)
    divided = {(*e[:i], e[i] - 1, *e[i + 1 :]): c for e, c in terms.items() if e[i]}
    rest = {e: c for e, c in terms.items() if not e[i]}
    value = _value(divided, at, check) * at[i]
    return value + _value(rest, at, check) if rest else value


def divides(divisor: fmpz_poly, dividend: fmpz_poly) -> bool:
    """Whether a primitive integer polynomial divides another one over Q (then over Z, by Gauss's lemma)."""
    lead, prime = divisor.leading_coefficient(), sparing_prime()
    if lead % prime != 0 and nmod_poly(dividend, prime) % nmod_poly(divisor, prime):
        return False
    try:
        dividend / divisor
    except DomainError:
        return False
    return True


# -- from the quotient algebra, modulo primes ----------------------------------------------------------


def parametrize(
    algebra: Algebra, equations: Sequence[Polynomial], *, seed: int = 1, check: Check = lambda: None
) -> Parametrization | None:
    """The points of an algebra by the roots of one polynomial, proven by substitution into `equations`.

    Works modulo primes and reconstructs; the candidate is accepted when every equation vanishes on it and a
    linear form takes as many values as the algebra's dimension: then no point is missing and none is wrong.
    `None` where no linear form of several drawn takes so many values: the algebra is probably not reduced.
    """
    if algebra.dimension == 0:
        return Parametrization(
            algebra.ring, fmpz_poly([1]), fmpz_poly([1]), (fmpz_poly([]),) * len(algebra.matrices)
        )
    drawing = random("linear forms", seed)
    for width in (2, 5, 30, 1000):
        weights = [drawing.randint(-width, width) for _ in algebra.matrices]
        if _image(_integral(algebra, weights), sparing_prime()) is not None:
            return _reconstructed(algebra, weights, equations, check)
    return None


@dataclass(frozen=True)
class _Integral:
    """A linear form's matrix, 1, and the variables times 1, each with its denominator cleared."""

    form: tuple[fmpz_mat, fmpz]
    one: tuple[fmpz_mat, fmpz]
    variables: tuple[tuple[fmpz_mat, fmpz], ...]


def _integral(algebra: Algebra, weights: Sequence[int]) -> _Integral:
    form = algebra.matrices[0] * weights[0]
    for w, m in zip(weights[1:], algebra.matrices[1:], strict=True):
        form = form + m * w
    variables = tuple((m * algebra.one).numer_denom() for m in algebra.matrices)
    return _Integral(form.numer_denom(), algebra.one.numer_denom(), variables)


def _image(data: _Integral, prime: int) -> list[nmod_poly] | None:
    """Minimal polynomial of the form and the variables' numerators over its derivative, modulo a prime.

    `None` where the form does not generate the algebra modulo the prime, or not with a squarefree polynomial.
    """
    if any(d % prime == 0 for _, d in (data.form, data.one, *data.variables)):
        return None

    def modular(pair: tuple[fmpz_mat, fmpz]) -> nmod_mat:
        return nmod_mat(pair[0], prime) * pow(int(pair[1]), -1, prime)

    form, vector = modular(data.form), modular(data.one)
    count = int(form.nrows())
    columns = []
    for _ in range(count):
        columns.append([int(e) for e in vector.entries()])
        vector = form * vector
    krylov = nmod_mat(count, count, [columns[j][i] for i in range(count) for j in range(count)], prime)
    targets = [[int(e) for e in v.entries()] for v in (vector, *map(modular, data.variables))]
    width = len(targets)
    right = nmod_mat(count, width, [targets[j][i] for i in range(count) for j in range(width)], prime)
    try:
        solved = krylov.solve(right)
    except ZeroDivisionError:
        return None
    table = [[int(solved[i, j]) for i in range(count)] for j in range(width)]
    minimal = nmod_poly([*(-c % prime for c in table[0]), 1], prime)
    derivative = minimal.derivative()
    if minimal.gcd(derivative).degree() > 0:
        return None
    return [minimal, *(nmod_poly(row, prime) * derivative % minimal for row in table[1:])]


def _reconstructed(
    algebra: Algebra, weights: Sequence[int], equations: Sequence[Polynomial], check: Check
) -> Parametrization | None:
    data = _integral(algebra, weights)
    count = algebra.dimension
    modulus, residues = 1, [0] * (count * (len(weights) + 1) + 1)
    used, trial = 0, 1
    previous: Parametrization | None = None
    for prime in random_primes("reconstruction", bits=62):
        check()
        image = _image(data, prime)
        if image is None:
            continue
        flat = [int(c) for k, p in enumerate(image) for c in _padded(p, count + (k == 0))]
        inverse = pow(modulus, -1, prime)
        residues = [r + modulus * ((f - r) * inverse % prime) for r, f in zip(residues, flat, strict=True)]
        modulus *= prime
        used += 1
        if used >= trial:
            trial = used + max(1, used // 3)
            candidate = _candidate(algebra.ring, residues, modulus, count)
            if candidate is not None and _proven(candidate, weights, equations, check):
                return candidate
            if candidate is not None and candidate == previous:
                raise ArithmeticError("the quotient algebra does not belong to the equations: a wrong basis")
            previous = candidate
    return None


def _padded(polynomial: nmod_poly, length: int) -> list[int]:
    coefficients = [int(c) for c in polynomial.coeffs()]
    return coefficients + [0] * (length - len(coefficients))


def _candidate(ring: Ring, residues: Sequence[int], modulus: int, count: int) -> Parametrization | None:
    rationals = reconstruct(residues, modulus)
    if rationals is None:
        return None
    numbers, _ = rationals
    multiple = fmpz_poly(numbers[: count + 1])
    content = multiple.content()
    minimal = fmpz_poly([c // content for c in multiple.coeffs()])
    numerators = [fmpz_poly(numbers[k : k + count]) for k in range(count + 1, len(numbers), count)]
    # x_i = (N_i/d) / (m/d)' with the common denominator d cancelled
    parts = [multiple.derivative(), *numerators]
    shared = fmpz(0)
    for p in parts:
        shared = shared.gcd(p.content())
    parts = [fmpz_poly([c // shared for c in p.coeffs()]) for p in parts]
    return Parametrization(ring, minimal, parts[0], tuple(parts[1:]))


def _proven(
    candidate: Parametrization, weights: Sequence[int], equations: Sequence[Polynomial], check: Check
) -> bool:
    """Whether the equations hold at all roots and the linear form of the coordinates is the root itself."""
    minimal = candidate.minimal
    if minimal.degree() > 0 and minimal.gcd(minimal.derivative()).degree() > 0:
        return False
    form = fmpz_poly([0, 1]) * candidate.denominator * -1
    for w, n in zip(weights, candidate.numerators, strict=True):
        form = form + n * w
    return divides(minimal, form) and all(candidate.vanishes(f, check) for f in equations)


def reconstruct(residues: Sequence[int], modulus: int) -> tuple[list[int], int] | None:
    """Integers and one common denominator that are the residues modulo `modulus`, as small as it decides.

    >>> reconstruct([(2 * pow(3, -1, 10007)) % 10007, 5], 10007)
    ([2, 15], 3)
    """
    bound = isqrt(modulus // 2)
    fractions: list[tuple[int, int]] = []
    denominator = 1
    for r in residues:
        value = r * denominator % modulus
        if value > modulus - bound:
            value -= modulus
        if abs(value) <= bound:
            fractions.append((value, denominator))
            continue
        a, b, s, t = modulus, value, 0, 1
        while b > bound:
            q = a // b
            a, b, s, t = b, a - q * b, t, s - q * t
        if abs(t) > bound or denominator * abs(t) > modulus:
            return None
        denominator *= abs(t)
        fractions.append((b if t > 0 else -b, denominator))
    common = lcm(*(d for _, d in fractions)) if fractions else 1
    return [n * (common // d) for n, d in fractions], common
