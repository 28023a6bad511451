"""Squares that add up to zero on a set, as the rule `squares` has them.

Source: a barrier method for linear matrix inequalities (Boyd, Vandenberghe, *Convex Optimization*, 11.4);
what it finds in floating point is rounded, and proves nothing before it is decomposed into squares exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy
from flint import fmpq
from numpy.typing import NDArray

from singsym.certificates.checker.polynomials import remainder
from singsym.certificates.checker.sets import RealSet
from singsym.elimination.monomial_ideals import minimal
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.sums_of_squares import squares_less_constant
from singsym.varieties.real.proofs.real_consequences import combined

Floats = NDArray[numpy.float64]

MOST = 24
"""So many polynomials, and as many variables, are combined at most."""
MOST_BITS = 300
"""Longer numerators and denominators are not put into floating point."""
ROUNDS, STEPS = 28, 6
"""The weight of the bound is doubled so often, and Newton's method has so many steps each time."""
LEAST = 1e-4
"""Sums in which no coefficient is so large are seen as zero."""
DENOMINATORS = (1, 2, 4, 8, 32, 2**10)
"""Coefficients are rounded to fractions with no larger denominators, the largest one to 1."""


def vanishing_squares(at: RealSet) -> list[list[str]]:
    """Weights and polynomials whose squares add up to zero on a set, where not all vanish there anyway."""
    ring = Ring(at.variables)
    given, others = ([Polynomial(ring, g) for g in group if g] for group in (at.generators, at.equations))
    # the last ones are a Groebner basis, of which those that are needed tell what is solved for
    led = {f.value.monomial(0): f for f in others}
    positive = positive_combination([led[m] for m in minimal(led)])
    for f in dict.fromkeys((*combined(given), *others, *filter(None, [positive]))):
        _, squares, less = squares_less_constant(f) or (0, (), fmpq(1))
        terms = [*squares, *([(-less, ring.one)] if less < 0 else [])]
        if less <= 0 and any(remainder(root.value, at.equations) for _, root in terms):
            return [[str(weight), str(root)] for weight, root in terms]
    return []


def positive_combination(polynomials: Sequence[Polynomial]) -> Polynomial | None:
    """A rational combination that is a sum of squares and a number that is not negative, if one is seen.

    >>> x, y = Ring(("x", "y")).gens
    >>> positive_combination([x**2 - y, y**2 + x + 1])
    x^2 + y^2 + x - y + 1
    >>> positive_combination([x**2 + y**2 - 4, x**2 + y**2 - 6 * x + 8])
    3/2*x^2 + 3/2*y^2 - 6*x + 6
    >>> positive_combination([x**2 - y, y**2 + x])
    >>> positive_combination([x**2 + 1 - 10**400 * y])
    """
    own = [f for f in polynomials if f and f.total_degree <= 2 and _is_short(f)]
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
            return total
    return None


def _is_short(f: Polynomial) -> bool:
    return all(max(c.p.bit_length(), c.q.bit_length()) <= MOST_BITS for _, c in f.terms())


def _gram(f: Polynomial) -> Floats:
    """The symmetric matrix of a quadratic polynomial, its constant last."""
    size = len(f.ring.names)
    form = numpy.zeros((size + 1, size + 1))
    for exponents, coefficient in f.terms():
        places = [i for i, e in enumerate(exponents) for _ in range(int(e))]
        i, j = (*places, size, size)[:2]
        form[i, j] += float(coefficient.p) / float(coefficient.q) / 2
        form[j, i] += float(coefficient.p) / float(coefficient.q) / 2
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
