"""Boxes that lie along a sheet, and polynomials and ranks on them by forms of second order.

Source: Taylor forms, Neumaier, Interval Methods for Systems of Equations (1990), 2.4, with the part that is
linear in parameters kept as such: Comba, Stolfi, Affine arithmetic and its applications to computer graphics,
SIBGRAPI (1993) 9-18; regular matrices: `varieties.real.points.intervals.is_dominant`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import combinations_with_replacement

import numpy as np
from flint import arb, arb_mat

from singsym.polynomials import Polynomial
from singsym.varieties.real.points.intervals import Box, evaluate, is_dominant, pivots


@dataclass(frozen=True)
class TiltedBox:
    """The points centre + tilt t + r, where the parameters t are in `spans` and r is in `rest`.

    centre: (coordinates,), exact; tilt: (coordinates, parameters), exact; spans: balls around 0;
    rest: balls that hold 0, one a coordinate; squared: of so many parameters, the first, products are kept in
    forms, those of the others are bounded.
    """

    centre: Box
    tilt: arb_mat
    spans: Box
    rest: Box
    squared: int

    @cached_property
    def hull(self) -> Box:
        """Balls that hold all of it."""
        return tuple(c + a + r for c, a, r in zip(self.centre, self._along, self.rest, strict=True))

    @cached_property
    def _wide(self) -> tuple[int, ...]:
        """The parameters that are not points."""
        return tuple(k for k, span in enumerate(self.spans) if span.rad() > 0)

    @cached_property
    def _pairs(self) -> list[tuple[int, int, arb, bool]]:
        """Any two of these, by their places among them, their product, and whether it is kept."""
        found = []
        for one, other in combinations_with_replacement(range(len(self._wide)), 2):
            first, second = self._wide[one], self._wide[other]
            most = (self.spans[first].abs_upper() * self.spans[second].abs_upper()).upper()
            product = arb(0).union(most) if one == other else arb(0, most)
            found.append((one, other, product, second < self.squared))
        return found

    @cached_property
    def _along(self) -> Box:
        rows = range(len(self.rest))
        return tuple(sum((self.tilt[i, k] * self.spans[k] for k in self._wide), arb(0)) for i in rows)

    @cached_property
    def monomials(self) -> Box:
        """What the coefficients of `form` belong to: 1, 1 for what is left, each t, each product of two."""
        spans = (self.spans[k] for k in self._wide)
        return (arb(1), arb(1), *spans, *(product for *_, product, kept in self._pairs if kept))

    def form(self, polynomial: Polynomial) -> list[arb]:
        """Coefficients of `monomials` whose sum holds the values; of one sum the same t is meant in all.

        By Taylor's theorem: values and slopes at the centre, second derivatives on the hull, which is convex
        and holds the centre.  Last coefficients that are zero may be left out.
        """
        places, slopes, seconds = _derivatives(polynomial)
        found = [evaluate(polynomial, self.centre)]
        if not places:
            return found
        first = [evaluate(s, self.centre) for s in slopes]
        rest = sum((s * self.rest[i] for s, i in zip(first, places, strict=True)), arb(0))
        own = arb_mat([[self.tilt[i, k] for k in self._wide] for i in places]) if self._wide else None
        linear = [] if own is None else (arb_mat([first]) * own).entries()
        if not seconds:
            return [*found, rest, *linear]
        bends = [[evaluate(p, self.hull) for p in row] for row in seconds]
        size = range(len(places))
        bent = arb_mat([[bends[max(i, j)][min(i, j)] for j in size] for i in size])
        by_rest = bent * arb_mat([[self.rest[i]] for i in places])
        for i, place in enumerate(places):
            rest += by_rest[i, 0] * (self._along[place] + self.rest[place] / 2)
        if own is None:
            return [*found, rest]
        square = own.transpose() * (bent * own)
        products = []
        for one, other, product, kept in self._pairs:
            part = square[one, one] / 2 if one == other else (square[one, other] + square[other, one]) / 2
            if kept:
                products.append(part)
            else:
                rest += part * product
        return [*found, rest, *linear, *products]

    def combined(self, left: arb_mat, forms: Sequence[Sequence[Sequence[arb]]], right: arb_mat) -> arb_mat:
        """A ball matrix that holds left F right, of a matrix F of polynomials given by their forms."""
        total, zero = arb_mat(left.nrows(), right.ncols()), arb(0)
        longest = max((len(entry) for row in forms for entry in row), default=0)
        for k, monomial in enumerate(self.monomials[:longest]):
            part = [[entry[k] if k < len(entry) else zero for entry in row] for row in forms]
            total += left * arb_mat(part) * right * monomial
        return total

    def value(self, polynomial: Polynomial) -> arb:
        """A ball that holds the values of a polynomial."""
        return sum((c * m for c, m in zip(self.form(polynomial), self.monomials, strict=False)), arb(0))

    def has_full_rank(self, matrix: Sequence[Sequence[Polynomial]]) -> bool:
        """Whether it is proven that a matrix has as large a rank as its size allows at each point.

        A square part is preconditioned by its singular vectors and values at the centre.
        """
        if not matrix or not matrix[0]:
            return True
        middle = [[float(evaluate(e, self.centre)) for e in row] for row in matrix]
        most = min(len(middle), len(middle[0]))
        rows, columns = pivots(middle, most, 0.0) if len(middle) != len(middle[0]) else (range(most),) * 2
        if len(rows) < most or not np.isfinite(middle).all():
            return False
        left, values, right = np.linalg.svd(np.array([[middle[i][j] for j in columns] for i in rows]))
        if not values[-1] > 0:
            return False
        before, after = arb_mat((left / values).T.tolist()), arb_mat(right.T.tolist())
        forms = [[self.form(matrix[i][j]) for j in columns] for i in rows]
        return is_dominant(self.combined(before, forms, after))


@lru_cache(maxsize=4096)
def _derivatives(
    polynomial: Polynomial,
) -> tuple[tuple[int, ...], tuple[Polynomial, ...], tuple[tuple[Polynomial, ...], ...]]:
    """The places of the variables, the slopes, and of second derivatives the lower triangle, unless zero."""
    names = polynomial.variables
    slopes = tuple(polynomial.derivative(name) for name in names)
    seconds = tuple(tuple(s.derivative(n) for n in names[: i + 1]) for i, s in enumerate(slopes))
    curved = polynomial.total_degree > 1
    return tuple(polynomial.ring.index(name) for name in names), slopes, seconds if curved else ()
