"""Dimension, degree and vector space dimension of a monomial ideal.

Source: D. Bayer, M. Stillman, Computation of Hilbert functions, J. Symb. Comput. 14 (1992) 31-50.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import comb

from singsym.polynomials import Exponents


def divides(divisor: Exponents, monomial: Exponents) -> bool:
    """Whether a monomial is a multiple of another one, both given by their exponents."""
    return all(a <= b for a, b in zip(divisor, monomial, strict=True))


def minimal(monomials: Iterable[Exponents]) -> tuple[Exponents, ...]:
    """The minimal generators, sorted.

    >>> minimal([(1, 1), (2, 1), (0, 3)])
    ((1, 1), (0, 3))
    """
    kept: list[Exponents] = []
    for m in sorted(set(monomials), key=lambda e: (sum(e), e)):
        if not any(divides(k, m) for k in kept):
            kept.append(m)
    return tuple(kept)


def independent_sets_dimension(monomials: Sequence[Exponents], variables: int) -> int:
    """The Krull dimension of the quotient by these monomials; -1 for the unit ideal.

    It is the largest number of variables of which no monomial is a product.

    >>> independent_sets_dimension([(1, 1, 0), (0, 0, 2)], 3)
    1
    """
    supports = {frozenset(i for i, e in enumerate(m) if e) for m in monomials}
    if frozenset() in supports:
        return -1
    minimal_supports = [s for s in supports if not any(t < s for t in supports)]
    return variables - _smallest_cover(sorted(minimal_supports, key=len), variables)


def _smallest_cover(supports: Sequence[frozenset[int]], limit: int) -> int:
    """The least number of variables that meets every support (more than `limit` is not told apart)."""
    if not supports:
        return 0
    if limit <= 0:
        return 1
    best, seen = limit + 1, set[int]()
    for variable in sorted(supports[0]):
        rest = [s - seen for s in supports if variable not in s]
        seen.add(variable)
        if all(rest):
            best = min(best, 1 + _smallest_cover(sorted(rest, key=len), min(limit, best) - 1))
    return best


def hilbert_numerator(monomials: Sequence[Exponents]) -> tuple[int, ...]:
    """K(t), lowest power first, in the Hilbert series K(t) / (1 - t)^n of the quotient.

    >>> hilbert_numerator([(2, 0), (1, 1)])
    (1, 0, -2, 1)
    """
    generators = minimal(monomials)
    numerator = [1]
    pivot = _pivot(generators)
    if pivot is None:
        for m in generators:
            numerator = _add(numerator, numerator, -1, sum(m))
    else:
        variable, power = pivot
        degree_one = tuple(power if i == variable else 0 for i in range(len(generators[0])))
        colon = [(*m[:variable], max(0, m[variable] - power), *m[variable + 1 :]) for m in generators]
        numerator = _add(
            list(hilbert_numerator([*generators, degree_one])), list(hilbert_numerator(colon)), 1, power
        )
    while len(numerator) > 1 and not numerator[-1]:
        numerator.pop()
    return tuple(numerator)


def _pivot(generators: Sequence[Exponents]) -> tuple[int, int] | None:
    """A variable in most generators and a middle power of it; `None` when they are pairwise coprime."""
    if not generators:
        return None
    powers = [sorted(m[i] for m in generators if m[i]) for i in range(len(generators[0]))]
    variable = max(range(len(powers)), key=lambda i: len(powers[i]))
    if len(powers[variable]) < 2:
        return None
    # the pivot power must not be a generator itself, else the recursion would stand still
    pure = [m[variable] for m in generators if m[variable] == sum(m)]
    power = powers[variable][len(powers[variable]) // 2]
    return variable, min(power, pure[0] - 1) if pure else power


def _add(first: list[int], second: list[int], sign: int, shift: int) -> list[int]:
    total = first + [0] * (len(second) + shift - len(first))
    for i, c in enumerate(second):
        total[i + shift] += sign * c
    return total


def degree(monomials: Sequence[Exponents], variables: int) -> int:
    """The degree (multiplicity in the top dimension) of the quotient; 0 for the unit ideal.

    >>> degree([(2, 0, 0), (1, 1, 0)], 3)
    1
    """
    codimension = variables - independent_sets_dimension(monomials, variables)
    if codimension > variables:
        return 0
    # K(t) = (1-t)^c Q(t) with Q(1) the degree: divide by taking the c-th Taylor coefficient at 1
    numerator = hilbert_numerator(monomials)
    value = sum(c * comb(k, codimension) for k, c in enumerate(numerator))
    return value if codimension % 2 == 0 else -value
