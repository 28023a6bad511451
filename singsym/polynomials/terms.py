"""The terms of one polynomial in doubles, all at once: those of determinants are thousands.

Source: powers of each variable in a table, and an array of places in it (as in NumPy's "advanced indexing").
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

from singsym.polynomials.polynomial import Polynomial

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

MANY = 60
"""Fewer terms are sooner taken one by one (measured)."""


def terms_at(polynomial: Polynomial, point: Sequence[float]) -> Floats:
    """The value of each term, the leading one first.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> terms_at(3 * x**2 - y / 2, (2.0, 4.0))
    array([12., -2.])
    """
    import numpy as np

    found, exponents = _arrays(polynomial)
    found = found.copy()
    powers = np.array(point)[:, None] ** np.arange(exponents.max(initial=0) + 1)
    for own, places in zip(powers, exponents, strict=True):
        if places.any():
            found *= own[places]
    return found


def value_at(polynomial: Polynomial, point: Sequence[float]) -> float:
    """The value in doubles, as `Polynomial.evaluate` would give it but for rounding."""
    if len(polynomial) < MANY:
        return float(polynomial.evaluate(point))
    return float(terms_at(polynomial, point).sum())


@lru_cache(maxsize=64)
def _arrays(polynomial: Polynomial) -> tuple[Floats, NDArray[np.intp]]:
    """The coefficients, and for each variable its exponents."""
    import numpy as np

    terms = polynomial.terms()
    coefficients = np.array([int(c.p) / int(c.q) for _, c in terms], dtype=np.float64)
    exponents = np.array([m for m, _ in terms], dtype=np.intp).reshape(len(terms), len(polynomial.ring.names))
    return coefficients, np.ascontiguousarray(exponents.T)


@lru_cache(maxsize=2**10)
def largest_coefficient(polynomial: Polynomial) -> float:
    """The absolute value of the largest coefficient; 0 without terms.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> largest_coefficient(3 * x - 7 * y / 2)
    3.5
    """
    return max((abs(int(c.p)) / int(c.q) for c in polynomial.value.coeffs()), default=0.0)
