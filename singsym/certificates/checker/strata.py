"""A leaf on which the types are constant: a point of it, and its dimension from below and from above.

Source: Krawczyk (1969); Neumaier, Interval Methods for Systems of Equations (1990), theorem 5.1.8, for the
box; implicit functions from below; from above Cox, Little, O'Shea, *Ideals, Varieties, and Algorithms*, 9.3:
a variety is not larger than that of any leading monomials of polynomials of its ideal.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from flint import arb, arb_mat, ctx, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from singsym.certificates.checker.balls import Compiled, is_off_zero, preconditioned
from singsym.certificates.checker.polynomials import Rejected, polynomial, rational, remainder, ring
from singsym.certificates.checker.rules import derive
from singsym.certificates.checker.sets import RealSet, chosen, listed, named

BITS = 200
Values = Mapping[str, fmpq]
INVERSE = "inverse__"
"""The name of the variable that is the inverse of a polynomial."""
SCALE = "scale__"
"""The name of the variable that makes polynomials homogeneous."""


def dimension_above(at: RealSet) -> int:
    """A bound of the dimension, by the leading monomials of the equations; -1 where one is constant."""
    leading = (f.monomial(0) for f in at.equations if f)
    supports = sorted({frozenset(i for i, e in enumerate(m) if e) for m in leading}, key=len)

    @cache
    def largest(names: frozenset[int]) -> int:
        """The most of some variables such that no monomial is in these alone."""
        inside = next((support for support in supports if support <= names), None)
        return len(names) if inside is None else max((largest(names - {i}) for i in inside), default=-1)

    return largest(frozenset(range(len(at.variables))))


def dimension_within(at: RealSet, data: Mapping[str, Any]) -> int:
    """A bound of the dimension, one less than the number of `forms`; raises `Rejected`.

    steps, equations: as of `derive`, from linear forms and the equations made homogeneous, to polynomials led
    by a power of each variable: no common zero in projective space, where a larger set would meet all.
    """
    forms = [polynomial(text, at.context) for text in listed(data, "forms", str)]
    if any(f.total_degree() != 1 for f in forms):
        raise Rejected("forms: expected polynomials of degree 1")
    larger = ring([*at.context.names(), SCALE])
    start = tuple(homogeneous(f, larger) for f in (*at.equations, *forms) if f)
    (derived,) = derive(replace(at, context=larger, equations=start), data)
    leading = [[i for i, e in enumerate(f.monomial(0)) if e] for f in derived.equations if f]
    if not all([i] in leading for i in range(len(larger.names()))):
        raise Rejected("dimension: expected polynomials that are led by a power of each variable")
    return len(forms) - 1


def homogeneous(f: fmpq_mpoly, larger: fmpq_mpoly_ctx) -> fmpq_mpoly:
    """A polynomial times a power of the last variable in each term."""
    return larger.from_dict({(*m, int(f.total_degree()) - sum(m)): c for m, c in f.terms()})


def dimension_below(at: RealSet, point: Mapping[str, Any]) -> int:
    """That of the set near a point of it, of which a box is proven to hold one; raises `Rejected`.

    fixed: variables with their rational values; centre: the others with numbers near; radius: of the box.
    square: the places of as many equations, from which the others follow near the point, see `implied`.
    Where the box has a point, the gradients of the square system are independent, so that its zeros are a
    manifold there, and the inequalities are strict.
    """
    fixed = {name: rational(value) for name, value in named(point, "fixed").items()}
    centre = {name: rational(value) for name, value in named(point, "centre").items()}
    if set(fixed) & set(centre) or {*fixed, *centre} != set(at.variables):
        raise Rejected(f"point: expected a value for each of {list(at.variables)}")
    square = listed(point, "square")
    equations = chosen(at.equations, square, "equation")
    if len(set(square)) != len(square) or len(equations) != len(centre):
        raise Rejected("point: expected as many different equations as variables that are not fixed")
    with ctx.workprec(BITS):
        box = _box(at, equations, fixed, centre, rational(point.get("radius", "")))
        if not all(is_off_zero(unit, box) for unit in at.units):
            raise Rejected("a unit may vanish in the box")
        if not all(Compiled(p).at(box) > 0 for p in at.inequalities):
            raise Rejected("an inequality is not seen to be strict in the box")
        if not is_off_zero(implied(at, point), box):
            raise Rejected("local: it may vanish in the box")
    return len(fixed)


def _box(at: RealSet, equations: list[fmpq_mpoly], fixed: Values, centre: Values, radius: fmpq) -> list[arb]:
    """The values of all variables in a box in which the equations have exactly one zero."""
    if radius <= 0:
        raise Rejected("radius: expected a positive number")
    names, unknowns = at.context.names(), list(centre)
    middle = [arb(centre[n]) if n in centre else arb(fixed.get(n, fmpq(0))) for n in names]
    wide = arb(0, arb(radius).upper())
    box = [m + wide if n in centre else m for n, m in zip(names, middle, strict=True)]
    if not unknowns:
        return box
    places = [names.index(n) for n in unknowns]
    jacobian = arb_mat([[Compiled(e.derivative(i)).at(box) for i in places] for e in equations])
    inverse, defect = preconditioned(jacobian)
    moved = inverse * arb_mat([[Compiled(e).at(middle)] for e in equations])
    moved = moved + defect * arb_mat([[wide] for _ in unknowns])
    if not all(abs(moved[i, 0]) < arb(radius) for i in range(len(unknowns))):
        raise Rejected("the Newton operator does not map the box into itself")
    return box


def implied(at: RealSet, point: Mapping[str, Any]) -> fmpq_mpoly:
    """A polynomial off whose zeros all equations vanish where those of `square` do; raises `Rejected`.

    implied: the polynomial `local`; steps and equations as of `derive`, from the square system with one more
    variable, the inverse of that polynomial.  Nothing where the square system has all generators.
    """
    own, data = chosen(at.equations, listed(point, "square"), "equation"), named(point, "implied", {})
    others = [g for g in at.generators if g and g not in own]
    if not others:
        return at.context.constant(1)
    local = polynomial(data.get("local", ""), at.context)
    larger = ring([INVERSE, *at.context.names()])
    one = larger.constant(1)

    def raised(f: fmpq_mpoly) -> fmpq_mpoly:
        return f.project_to_context(larger)

    start = [*map(raised, own), one - larger.gens()[0] * raised(local)]
    derived = derive(replace(at, context=larger, equations=tuple(start)), data)[0]
    if any(remainder(raised(g), derived.equations) for g in others):
        raise Rejected("a generator is not seen to vanish at the point")
    return local
