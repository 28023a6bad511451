"""Combinations of quadratic equations that are sums of squares: these vanish, or there is no real point.

Source: a barrier method for linear matrix inequalities (Boyd, Vandenberghe, *Convex Optimization*, 11.4);
what it finds in floating point is rounded, and proves nothing before it is decomposed into squares exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy
from flint import fmpq
from numpy.typing import NDArray

from singsym.polynomials import Polynomial
from singsym.polynomials.sums_of_squares import squares_less_constant, sum_of_squares

Floats = NDArray[numpy.float64]

MOST = 24
"""So many polynomials, and as many variables, are combined at most."""
ROUNDS, STEPS = 28, 6
"""The weight of the bound is doubled so often, and Newton's method has so many steps each time."""
LEAST = 1e-4
"""Sums in which no coefficient is so large are seen as zero."""
DENOMINATORS = (1, 2, 4, 8, 32, 2**10)
"""Coefficients are rounded to fractions with no larger denominators, the largest one to 1."""


def is_positive_combination_seen(polynomials: Sequence[Polynomial]) -> bool:
    """Whether a combination is seen to be positive everywhere: the polynomials have no common real zero.

    >>> from singsym.polynomials import Ring
    >>> c, s, d = Ring(("c", "s", "d")).gens
    >>> is_positive_combination_seen([c**2 + s**2 - 1, (d - 3 * s) ** 2 - 9 * s**2 + 27 * c + 45])
    True
    """
    return any(root.is_constant for root in forced_to_vanish(polynomials))


def forced_to_vanish(polynomials: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
    """What vanishes at all common real zeros, as a combination is a sum of the squares; none if none is seen.

    A number among them says that there is no real zero.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> forced_to_vanish([x**2 + y**2 - 4, x**2 + y**2 - 6 * x + 8])
    (x - 2, y)
    """
    combination = positive_combination(polynomials)
    found = None if combination is None else sum_of_squares(combination)
    return () if found is None else found[1]


def positive_combination(polynomials: Sequence[Polynomial]) -> Polynomial | None:
    """A rational combination that is a sum of squares and a number that is not negative, if one is seen.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> positive_combination([x**2 - y, y**2 + x + 1])
    x^2 + y^2 + x - y + 1
    >>> positive_combination([x**2 + y**2 - 4, x**2 + y**2 - 6 * x + 8])
    x^2 + y^2 - 4*x + 4
    >>> positive_combination([x**2 - y, y**2 + x])
    """
    own = [f / max(abs(c) for _, c in f.terms()) for f in polynomials if f and f.total_degree <= 2]
    if not own or max(len(own), len(own[0].ring.names)) > MOST:
        return None
    try:
        weights = _weights(numpy.array([_gram(f) for f in own]))
    except numpy.linalg.LinAlgError:
        return None
    if not numpy.abs(weights).max() >= LEAST:
        return None
    weights = weights / numpy.abs(weights).max()
    for most in DENOMINATORS:
        rounded = [Fraction(float(w)).limit_denominator(most) for w in weights]
        pairs = zip(own, rounded, strict=True)
        total = sum((f * fmpq(w.numerator, w.denominator) for f, w in pairs), start=own[0].ring.zero)
        found = squares_less_constant(total)
        if found is not None and found[0] > 0 and found[2] <= 0:
            return total.primitive()
    return None


def _gram(f: Polynomial) -> Floats:
    """The symmetric matrix of a quadratic polynomial, its constant last."""
    size = len(f.ring.names)
    form = numpy.zeros((size + 1, size + 1))
    for exponents, coefficient in f.terms():
        places = [i for i, e in enumerate(exponents) for _ in range(int(e))]
        i, j = (*places, size, size)[:2]
        half = float(Fraction(int(coefficient.p), int(coefficient.q)) / 2)
        form[i, j] += half
        form[j, i] += half
    return form


def _weights(forms: Floats) -> Floats:
    """Coefficients of a sum of symmetric matrices with a least eigenvalue as large as can be, or positive.

    The sum plus s times the identity is kept positive definite, the coefficients in a ball, and s is lowered.
    """
    count, size, _ = forms.shape
    norms = numpy.linalg.norm(forms, axis=(1, 2))
    directions = numpy.concatenate([forms / norms[:, None, None], numpy.eye(size)[None]])
    at = numpy.append(numpy.zeros(count), 1.0)
    ball = numpy.diag(numpy.append(numpy.ones(count), 0.0))
    goal = numpy.append(numpy.zeros(count), 1.0)
    for weight in 2.0 ** numpy.arange(ROUNDS):
        for _ in range(STEPS):
            matrix = numpy.einsum("k,kij->ij", at, directions)
            moved = numpy.linalg.solve(matrix, directions)
            left = 1.0 - at @ ball @ at
            slope = weight * goal - numpy.einsum("kii->k", moved) + 2 * (ball @ at) / left
            curvature = numpy.einsum("kij,lji->kl", moved, moved)
            curvature += 2 * ball / left + 4 * numpy.outer(ball @ at, ball @ at) / left**2
            step = -numpy.linalg.lstsq(curvature, slope, rcond=None)[0]
            if not numpy.isfinite(step).all():
                raise numpy.linalg.LinAlgError("no step of Newton's method")
            while not _is_inside(at + step, directions, ball):
                step = step / 2
            at = at + step
        if at[-1] < 0:
            break
    weights: Floats = at[:-1] / norms
    return weights


def _is_inside(at: Floats, directions: Floats, ball: Floats) -> bool:
    inside = at @ ball @ at < 1.0
    return bool(inside and numpy.linalg.eigvalsh(numpy.einsum("k,kij->ij", at, directions))[0] > 0)
