"""Division by several polynomials and S-polynomials over Z, which FLINT has and its type stubs do not.

Source: FLINT's `fmpz_mpoly_reduction_primitive_part` and `fmpz_mpoly_spoly`.
"""

from __future__ import annotations

from typing import Any, cast

from flint import fmpz_mpoly, fmpz_mpoly_vec


def remainder(polynomial: fmpz_mpoly, divisors: fmpz_mpoly_vec) -> fmpz_mpoly:
    """The primitive part of the remainder, in which no term is divisible by a leading monomial."""
    return cast(fmpz_mpoly, cast(Any, polynomial).reduction_primitive_part(divisors))


def s_polynomial(first: fmpz_mpoly, second: fmpz_mpoly) -> fmpz_mpoly:
    """The combination in which the leading terms cancel."""
    return cast(fmpz_mpoly, cast(Any, first).spoly(second))
