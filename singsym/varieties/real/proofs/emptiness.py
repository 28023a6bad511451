"""Whether a system of polynomial equations, exclusions and inequalities has a real solution.

Cheap certificates first, then a search for a witness, then points on every connected component.
Source: Basu, Pollack, Roy, Algorithms in Real Algebraic Geometry (2006), ch. 12-13.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from flint import fmpz_poly

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.chance import BY_PRIMES
from singsym.effort.verdict import Known, Premises, Verdict, weakest
from singsym.polynomials import Polynomial
from singsym.polynomials.sums_of_squares import sum_of_squares
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.purity import pure_or_whole
from singsym.varieties.real.numerical.sampling import numerical_points
from singsym.varieties.real.points.certified_point import Witness, find_witness
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.points.roots import has_real_root
from singsym.varieties.real.proofs.critical_points import component_samples
from singsym.varieties.real.proofs.positive_combinations import forced_to_vanish
from singsym.varieties.real.proofs.real_consequences import real_consequences
from singsym.varieties.real.system import RealSystem

CONTRADICTED = "sums of squares bound the variables, and an equation or a condition fails within the bounds"
POSITIVE = "a combination of the equations is a sum of squares and a positive number"


def is_empty_over_reals(
    system: RealSystem, budget: Budget | None = None, *, seed: int = 0, tries: int = 25
) -> Verdict:
    """Whether the system has no real solution; "no" comes with a `Witness`, "undecided" with a reason.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> is_empty_over_reals(RealSystem(R, (x**2 + y**2 + 1,))).answer
    <Answer.YES: 'yes'>
    >>> is_empty_over_reals(RealSystem(R, (x**2 + y**2 - 1,), positive=(x - y,))).answer
    <Answer.NO: 'no'>
    """
    try:
        with current(budget).part() as limited:
            verdict = _decided(system, limited, seed, tries)
    except Undecided as reason:
        return Verdict.undecided(str(reason))
    if verdict.is_yes and verdict.certainty == "modular":
        return replace(verdict, engine="msolve", reason=f"{verdict.reason} ({BY_PRIMES})")
    return verdict


def _decided(system: RealSystem, budget: Budget, seed: int, tries: int) -> Verdict:
    equations, premises = system.closed_equations, Premises()
    forced = premises.take(real_consequences(system, equations))
    if forced is None:
        return Verdict.yes(premises.certainty, reason=CONTRADICTED)
    equations = (*equations, *forced)
    squared = forced_to_vanish(equations)
    if any(root.is_constant for root in squared):
        return Verdict.yes(premises.certainty, reason=POSITIVE)
    equations = (*equations, *squared)
    pieces = premises.take(
        decompose(equations, system.nonzero, ring=system.ring, excluded=system.exclusions, budget=budget)
    )
    components = tuple(c for c in pieces if not premises.take(is_excluded(c, system)))
    if not components:
        return Verdict.yes(premises.certainty, reason="there is no complex solution")
    reasons, doubts = [], []
    for component in premises.take(pure_or_whole(components, equations, system.ring)):
        try:
            verdict = _component_verdict(component, system, equations, budget, seed, tries)
        except Undecided as doubt:
            doubts.append(str(doubt))
            continue
        if verdict.is_no:
            return verdict
        premises.rest_on(verdict.certainty)
        reasons.append(verdict.reason)
    if doubts:
        return Verdict.undecided("; ".join(dict.fromkeys(doubts)))
    return Verdict.yes(premises.certainty, reason="; ".join(dict.fromkeys(reasons)))


def is_excluded(component: Component, system: RealSystem) -> Known[bool]:
    """Whether all polynomials of one of the exclusions vanish on a component."""
    premises = Premises()
    return premises.conclude(
        any(all(premises.take(component.vanishes(g)) for g in group) for group in system.exclusions)
    )


def _component_verdict(
    component: Component,
    system: RealSystem,
    equations: Sequence[Polynomial],
    budget: Budget,
    seed: int,
    tries: int,
) -> Verdict:
    piece, premises = replace(system, equations=component.generators), Premises()
    if component.dimension == 0:
        return _from_points(real_points(component.ideal, budget), piece)
    if premises.take(_no_real_coordinate(component)):
        return Verdict.yes(premises.certainty, reason="a polynomial in one variable has no real root")
    if premises.take(_contradiction(component, system)):
        return Verdict.yes(premises.certainty, reason="a condition contradicts sums of squares")
    forced = premises.take(real_consequences(system, component.generators, equations))
    if forced is None:
        return Verdict.yes(premises.certainty, reason=CONTRADICTED)
    if not all(premises.take(component.vanishes(f)) for f in forced):
        smaller = replace(system, equations=(*component.generators, *forced))
        return _resting_on(premises, _decided(smaller, budget, seed, tries))
    found = None
    with attempt("the search for a real point", patience.POINT_SEARCH.work, part_of=budget) as own:
        found = find_witness(piece, seed=seed, tries=tries, dimension=component.dimension, budget=own)
    if found is not None:
        return Verdict.no(found.certainty, witness=found)
    return _resting_on(premises, _by_samples(component, piece, equations, budget))


def _resting_on(premises: Premises, verdict: Verdict) -> Verdict:
    """A verdict of which a yes rests on further premises; a point shows by itself that the answer is no."""
    if not verdict.is_yes:
        return verdict
    return replace(verdict, certainty=weakest(premises.certainty, verdict.certainty))


def _from_points(points: Known[tuple[RealPoint, ...]], system: RealSystem) -> Verdict:
    for p in points.value:
        if system.admits(p):
            return Verdict.no(witness=Witness(p))
    return Verdict.yes(points.certainty, reason="finitely many complex solutions, none real and admitted")


# -- cheap certificates --------------------------------------------------------------------------------


def _contradiction(component: Component, system: RealSystem) -> Known[bool]:
    """Whether a polynomial required positive is, on the component, minus a sum of squares (or the like)."""
    premises = Premises()
    for p in (*system.positive, *system.nonnegative):
        for form in (p, premises.take(component.ideal.normal_form(p))):
            squares = sum_of_squares(form) if form else (-1, ())
            if squares is None or squares[0] > 0:
                continue
            if p in system.positive or any(r.is_constant for r in squares[1]):
                return premises.conclude(True)
    return premises.conclude(False)


def _no_real_coordinate(component: Component) -> Known[bool]:
    basis = component.ideal.groebner_basis()
    for f in basis.value:
        if len(f.variables) == 1:
            k = f.ring.index(f.variables[0])
            coefficients = [0] * (f.total_degree + 1)
            for m, c in f.integer().terms():
                coefficients[int(m[k])] = int(c)
            if not has_real_root(fmpz_poly(coefficients)):
                return Known(True, basis.certainty)
    return Known(False, basis.certainty)


# -- points on every component ---------------------------------------------------------------------------


def _by_samples(
    component: Component, system: RealSystem, equations: Sequence[Polynomial], budget: Budget
) -> Verdict:
    """Points of the closed set, then of its open part where all conditions hold strictly, then of borders.

    The closed set is only sampled where it seems to have no point, or is crossed by no border.
    """
    closed, premises = RealSystem(system.ring, component.generators), Premises()
    borders = None
    if numerical_points(closed, 1):
        borders = premises.take(_crossed(component, system, budget))
    if not borders:
        points = premises.take(component_samples(component, equations, budget))
        if not points:
            return Verdict.yes(premises.certainty, reason="no real point is nearest to a generic one")
        admitted = _admitted(points, system)
        if admitted is not None:
            return Verdict.no(witness=Witness(admitted))
        if borders is None:
            borders = premises.take(_crossed(component, system, budget))
    if not borders:
        reason = "a condition fails on every connected component, which it does not cross"
        return Verdict.yes(premises.certainty, reason=reason)
    points = premises.take(component_samples(component, equations, budget, nonzero=borders))
    admitted = _admitted(points, system)
    if admitted is not None:
        return Verdict.no(witness=Witness(admitted))
    for p in set(system.nonnegative) & set(borders):
        others = tuple(q for q in system.nonnegative if q != p)
        border = replace(system, equations=(*component.generators, p), nonnegative=others)
        verdict = is_empty_over_reals(border, budget)
        if verdict.is_undecided:
            raise Undecided(verdict.reason)
        if verdict.is_no:
            return verdict
        premises.rest_on(verdict.certainty)
    reason = "a condition fails on every connected component between its borders"
    return Verdict.yes(premises.certainty, reason=reason)


def _admitted(points: Sequence[RealPoint], system: RealSystem) -> RealPoint | None:
    return next((p for p in points if system.admits(p) and not any(map(p.sign, system.equations))), None)


def border_polynomials(component: Component, system: RealSystem) -> Known[list[Polynomial]]:
    """Polynomials that do not vanish where the conditions hold strictly; not those zero on all of a piece."""
    premises = Premises()
    conditions = (*system.positive, *system.nonnegative)
    found = [p for p in conditions if p in system.positive or not premises.take(component.vanishes(p))]
    for group in system.exclusions:
        found.append(group[0] if len(group) == 1 else sum((g * g for g in group), start=system.ring.zero))
    return premises.conclude(found)


def _crossed(component: Component, system: RealSystem, budget: Budget) -> Known[list[Polynomial]]:
    """The borders that may have real points on a piece."""
    premises = Premises()
    borders = premises.take(border_polynomials(component, system))
    return premises.conclude([p for p in borders if not premises.grants(_is_apart(component, p, budget))])


def _is_apart(component: Component, border: Polynomial, budget: Budget) -> Verdict:
    """Whether a border has no real points on a piece."""
    system = RealSystem(component.ideal.ring, (*component.generators, border))
    with attempt("real points where a condition changes", patience.POINT_SEARCH.work, part_of=budget) as own:
        return _decided(system, own, 0, 5)
    return Verdict.undecided("that a condition does not change on a piece was not proven in time")
