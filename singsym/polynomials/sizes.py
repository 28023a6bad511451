"""How large the variables of polynomial equations are, roughly, from the coefficients alone.

Source: Morgan, Solving Polynomial Systems Using Continuation (1987), chapter 5: scaling by least squares on
the logarithms of the coefficients.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import log, prod

from singsym.polynomials.polynomial import Polynomial
from singsym.polynomials.ring import Ring
from singsym.polynomials.terms import MANY, largest_coefficient, terms_at


def variable_sizes(ring: Ring, polynomials: Iterable[Polynomial]) -> tuple[float, ...]:
    """Sizes of the ring's variables for which the terms of each polynomial are as equal as they can be.

    Those of algebraic constants are their values, about; where the polynomials leave a choice, sizes are near
    1.  In a unit of length that is k times smaller the sizes of lengths are k times larger.

    >>> R = Ring(("x", "y", "c"))
    >>> x, y, c = R.gens
    >>> [round(size) for size in variable_sizes(R, [x**2 + y**2 - 10**6, x - 1000 * c])]
    [1000, 1000, 1]
    """
    import numpy as np

    fixed = {
        ring.index(c.name): log(max(abs(c.low + c.high) / 2, c.high / 2, -c.low / 2)) for c in ring.constants
    }
    rows, sides = [], []
    for polynomial in polynomials:
        terms = polynomial.terms()
        exponents = np.array([m for m, _ in terms], dtype=np.float64).reshape(len(terms), len(ring.names))
        logs = np.array([log(abs(int(c.p))) - log(int(c.q)) for _, c in terms])
        if len(terms) > 1:
            rows.append((exponents - exponents.mean(axis=0)) / len(terms) ** 0.5)
            sides.append((logs.mean() - logs) / len(terms) ** 0.5)
    found = np.zeros(len(ring.names))
    found[list(fixed)] = list(fixed.values())
    free = [i for i in range(len(ring.names)) if i not in fixed]
    if rows and free:
        matrix, side = np.concatenate(rows), np.concatenate(sides)
        side = side - matrix @ found
        part = matrix[:, free]
        found[free] = np.linalg.lstsq(part.T @ part, part.T @ side, rcond=1e-9)[0]
    return tuple(float(size) for size in np.exp(found))


def largest_term(polynomial: Polynomial, sizes: Sequence[float]) -> float:
    """The absolute value of the largest term where the variables have these sizes; 0 without terms.

    >>> x, y = Ring(("x", "y")).gens
    >>> largest_term(3 * x**2 - 100 * y, (10.0, 1.0))
    300.0
    """
    if all(size == 1.0 for size in sizes):
        return largest_coefficient(polynomial)
    if len(polynomial) >= MANY:
        return float(abs(terms_at(polynomial, sizes)).max())
    coefficients = (abs(int(c.p)) / int(c.q) for c in polynomial.value.coeffs())
    monomials = (
        prod(s**e for s, e in zip(sizes, map(int, m), strict=True) if e) for m in polynomial.value.monoms()
    )
    return max((c * m for c, m in zip(coefficients, monomials, strict=True)), default=0.0)
