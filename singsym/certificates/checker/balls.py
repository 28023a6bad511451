"""Polynomials at balls, and what Newton's method needs of their gradients there.

Source: arb, ball arithmetic (https://flintlib.org); Krawczyk (1969).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import arb, arb_mat, fmpq_mpoly

from singsym.certificates.checker.polynomials import Rejected, repeated


class Compiled:
    """A polynomial to be evaluated at balls, again and again."""

    def __init__(self, f: fmpq_mpoly) -> None:
        self.terms = [(arb(c), repeated(exponents)) for exponents, c in f.terms()]

    def at(self, values: Sequence[Any]) -> Any:
        """The value at a point, of balls or of polynomials over these.

        Powers are products, as a power of a ball that holds zero would be none.
        """
        total = values[0] * 0 if values else arb(0)
        for term, places in self.terms:
            for i in places:
                term = term * values[i]
            total = total + term
        return total


def is_off_zero(f: fmpq_mpoly, values: Sequence[arb]) -> bool:
    """Whether a polynomial vanishes nowhere in a box."""
    return not Compiled(f).at(values).contains(0)


def preconditioned(jacobian: arb_mat) -> tuple[arb_mat, arb_mat]:
    """Y near the inverse of a square matrix J of balls, and Y J - 1; raises `Rejected` where none is seen."""
    try:
        inverse = jacobian.mid().inv().mid()
    except ZeroDivisionError:
        raise Rejected("the equations are dependent in the middle of a box") from None
    size = range(jacobian.nrows())
    return inverse, inverse * jacobian - arb_mat([[arb(int(i == j)) for j in size] for i in size])
