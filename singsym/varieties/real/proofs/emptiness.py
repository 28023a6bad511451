"""Whether a system of polynomial equations, exclusions and inequalities has a real solution.

Cheap certificates first, then a search for a witness, then points on every connected component.
Source: Basu, Pollack, Roy, Algorithms in Real Algebraic Geometry (2006), ch. 12-13.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from flint import fmpz_poly

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.chance import BY_PRIMES
from singsym.effort.verdict import Verdict, certainties
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
from singsym.varieties.real.proofs.real_consequences import real_consequences
from singsym.varieties.real.system import RealSystem

CONTRADICTED = "sums of squares bound the variables, and an equation or a condition fails within the bounds"


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
        with current(budget).part() as limited, certainties() as seen:
            verdict = _decided(system, limited, seed, tries)
    except Undecided as reason:
        return Verdict.undecided(str(reason))
    if verdict.is_yes and "modular" in seen:
        return replace(
            verdict, certainty="modular", engine="msolve", reason=f"{verdict.reason} ({BY_PRIMES})"
        )
    return verdict


def _decided(system: RealSystem, budget: Budget, seed: int, tries: int) -> Verdict:
    equations = system.closed_equations
    forced = real_consequences(system, equations)
    if forced is None:
        return Verdict.yes(reason=CONTRADICTED)
    equations = (*equations, *forced)
    pieces = decompose(equations, system.nonzero, ring=system.ring, budget=budget)
    components = tuple(c for c in pieces if not is_excluded(c, system))
    if not components:
        return Verdict.yes(reason="there is no complex solution")
    reasons, doubts = [], []
    for component in pure_or_whole(components, equations, system.ring):
        try:
            verdict = _component_verdict(component, system, equations, budget, seed, tries)
        except Undecided as doubt:
            doubts.append(str(doubt))
            continue
        if verdict.is_no:
            return verdict
        reasons.append(verdict.reason)
    if doubts:
        return Verdict.undecided("; ".join(dict.fromkeys(doubts)))
    return Verdict.yes(reason="; ".join(dict.fromkeys(reasons)))


def is_excluded(component: Component, system: RealSystem) -> bool:
    """Whether all polynomials of one of the exclusions vanish on a component."""
    return any(all(component.vanishes(g) for g in group) for group in system.exclusions)


def _component_verdict(
    component: Component,
    system: RealSystem,
    equations: Sequence[Polynomial],
    budget: Budget,
    seed: int,
    tries: int,
) -> Verdict:
    piece = replace(system, equations=component.generators)
    if component.dimension == 0:
        return _from_points(real_points(component.ideal, budget), piece, "finitely many complex solutions")
    if _no_real_coordinate(component):
        return Verdict.yes(reason="a polynomial in one variable has no real root")
    if _contradiction(component, system):
        return Verdict.yes(reason="a condition contradicts sums of squares")
    forced = real_consequences(system, component.generators, equations)
    if forced is None:
        return Verdict.yes(reason=CONTRADICTED)
    if not all(component.vanishes(f) for f in forced):
        return _decided(replace(system, equations=(*component.generators, *forced)), budget, seed, tries)
    found = None
    with attempt("the search for a real point", patience.POINT_SEARCH.work, part_of=budget) as own:
        found = find_witness(piece, seed=seed, tries=tries, dimension=component.dimension, budget=own)
    if found is not None:
        return Verdict.no(found.certainty, witness=found)
    return _by_samples(component, piece, equations, budget)


def _from_points(points: Sequence[RealPoint], system: RealSystem, what: str) -> Verdict:
    for p in points:
        if system.admits(p):
            return Verdict.no(witness=Witness(p))
    return Verdict.yes(reason=f"{what}, none real and admitted")


# -- cheap certificates --------------------------------------------------------------------------------


def _contradiction(component: Component, system: RealSystem) -> bool:
    """Whether a polynomial required positive is, on the component, minus a sum of squares (or the like)."""
    for p in (*system.positive, *system.nonnegative):
        for form in (p, component.ideal.normal_form(p)):
            squares = sum_of_squares(form) if form else (-1, ())
            if squares is None or squares[0] > 0:
                continue
            if p in system.positive or any(r.is_constant for r in squares[1]):
                return True
    return False


def _no_real_coordinate(component: Component) -> bool:
    for f in component.ideal.groebner_basis():
        if len(f.variables) == 1:
            k = f.ring.index(f.variables[0])
            coefficients = [0] * (f.total_degree + 1)
            for m, c in f.integer().terms():
                coefficients[int(m[k])] = int(c)
            if not has_real_root(fmpz_poly(coefficients)):
                return True
    return False


# -- points on every component ---------------------------------------------------------------------------


def _by_samples(
    component: Component, system: RealSystem, equations: Sequence[Polynomial], budget: Budget
) -> Verdict:
    """Points of the closed set, then of its open part where all conditions hold strictly, then of borders.

    The closed set is only sampled where it seems to have no point, or is crossed by no border.
    """
    closed = RealSystem(system.ring, component.generators)
    borders = _crossed(component, system, budget) if numerical_points(closed, 1) else None
    if not borders:
        points = component_samples(component, equations, budget)
        if not points:
            return Verdict.yes(reason="no real point is nearest to a generic one")
        admitted = _admitted(points, system)
        if admitted is not None:
            return Verdict.no(witness=Witness(admitted))
        if borders is None:
            borders = _crossed(component, system, budget)
    if not borders:
        return Verdict.yes(reason="a condition fails on every connected component, which it does not cross")
    admitted = _admitted(component_samples(component, equations, budget, nonzero=borders), system)
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
    return Verdict.yes(reason="a condition fails on every connected component between its borders")


def _admitted(points: Sequence[RealPoint], system: RealSystem) -> RealPoint | None:
    return next((p for p in points if system.admits(p) and not any(map(p.sign, system.equations))), None)


def border_polynomials(component: Component, system: RealSystem) -> Iterator[Polynomial]:
    """Polynomials that do not vanish where the conditions hold strictly; not those zero on all of a piece."""
    for p in (*system.positive, *system.nonnegative):
        if p in system.positive or not component.vanishes(p):
            yield p
    for group in system.exclusions:
        yield group[0] if len(group) == 1 else sum((g * g for g in group), start=system.ring.zero)


def _crossed(component: Component, system: RealSystem, budget: Budget) -> list[Polynomial]:
    return [p for p in border_polynomials(component, system) if _is_crossed(component, p, budget)]


def _is_crossed(component: Component, border: Polynomial, budget: Budget) -> bool:
    """Whether a border may have real points on a piece."""
    system = RealSystem(component.ideal.ring, (*component.generators, border))
    with attempt("real points where a condition changes", patience.POINT_SEARCH.work, part_of=budget) as own:
        return not _decided(system, own, 0, 5).is_yes
    return True
