"""All points of a finite set, as the leaf `points` has them.

Source: rational univariate representations, `varieties.real.points.parametrization`.
"""

from __future__ import annotations

from typing import Any

from flint import fmpq, fmpq_mat, fmpq_mpoly, fmpq_poly

from singsym.certificates.checker.polynomials import remainder
from singsym.certificates.checker.sets import RealSet
from singsym.effort.budget import Undecided
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.points.finite_sets import parametrized

HIGHEST_POWER = 8


def points_leaf(at: RealSet) -> dict[str, Any]:
    """form, minimal, coordinates and power of a finite set; its equations hold a Groebner basis.

    Raises `Undecided` where its points are not found in time.
    """
    ring = Ring(at.variables)
    found = parametrized([Polynomial(ring, e) for e in at.equations if e]).value
    minimal = fmpq_poly(found.minimal)
    slope = minimal.derivative()
    _, inverse, _ = fmpq_poly(found.denominator).xgcd(minimal)
    coordinates = [(fmpq_poly(n) * (inverse * slope % minimal)) % minimal for n in found.numerators]
    form = _form(coordinates, minimal, at)
    data = {
        "form": str(form),
        "minimal": _texts(minimal),
        "coordinates": {name: _texts(r) for name, r in zip(at.variables, coordinates, strict=True)},
    }
    return data | {"power": _power(at, form, minimal, coordinates)}


def _texts(f: fmpq_poly) -> list[str]:
    return [str(c) for c in f.coeffs()]


def _form(coordinates: list[fmpq_poly], minimal: fmpq_poly, at: RealSet) -> fmpq_mpoly:
    """The linear form that is the root at its point: a solution of linear equations."""
    size, slope = minimal.degree(), minimal.derivative()
    target = fmpq_poly([0, 1]) * slope % minimal
    columns = [*coordinates, slope]
    matrix = fmpq_mat(size, len(columns) + 1, [f[k] for k in range(size) for f in (*columns, target)])
    reduced, rank = matrix.rref()
    weights = [fmpq(0)] * len(columns)
    for i in range(rank):
        pivot = next(j for j in range(len(columns) + 1) if reduced[i, j])
        if pivot == len(columns):
            raise Undecided("the points of a finite set are not told apart by a linear form")
        weights[pivot] = reduced[i, len(columns)]
    gens = at.context.gens()
    return sum((g * w for g, w in zip(gens, weights, strict=False)), start=at.context.constant(weights[-1]))


def _power(at: RealSet, form: fmpq_mpoly, minimal: fmpq_poly, coordinates: list[fmpq_poly]) -> int:
    """To which power what vanishes at the points has remainder zero."""
    powers = [at.context.constant(1)]
    for _ in range(minimal.degree()):
        powers.append(remainder(powers[-1] * form, at.equations))

    def put(f: fmpq_poly) -> fmpq_mpoly:
        pairs = zip(powers, f.coeffs(), strict=False)
        return remainder(sum((p * c for p, c in pairs), start=at.context.constant(0)), at.equations)

    gens, below = at.context.gens(), put(minimal.derivative())
    vanishing = [put(minimal)]
    vanishing += [remainder(g * below - put(r), at.equations) for g, r in zip(gens, coordinates, strict=True)]
    left, power = list(vanishing), 1
    while any(left):
        if power == HIGHEST_POWER:
            raise Undecided("a finite set has points of high multiplicity")
        power += 1
        left = [remainder(a * b, at.equations) for a, b in zip(left, vanishing, strict=True)]
    return power
