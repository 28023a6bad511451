"""Whether parts of a configuration space have real points: numerical ones to guess from, or a proof of none.

Source: singsym's own order of the proofs in `varieties.real`, the cheap ones first.
"""

from __future__ import annotations

from dataclasses import replace

from singsym.classes.strata.patches import Patch
from singsym.effort import patience
from singsym.effort.attempts import attempt, cut_short
from singsym.effort.budget import Budget, current
from singsym.effort.verdict import Known, Premises, Verdict
from singsym.elimination import engines
from singsym.elimination.memo import remember
from singsym.varieties.decomposition import Component
from singsym.varieties.real.modules.no_assembly import has_no_assembly
from singsym.varieties.real.numerical.sampling import Points, numerical_points
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.proofs.emptiness import is_empty_over_reals, is_excluded
from singsym.varieties.real.proofs.vector_charts import Cartesian
from singsym.varieties.real.system import RealSystem


def restricted(system: RealSystem, patch: Patch) -> RealSystem:
    """A set on a patch, in the variables that are not solved for.

    Exclusions come without zeros and equations; an empty one leaves nothing.
    """
    restrict = patch.restrict
    known = {p.primitive() for p in patch.rest if p}
    groups = (map(restrict, group) for group in system.exclusions)
    return RealSystem(
        system.ring,
        patch.rest,
        tuple(tuple(g for g in group if g and g.primitive() not in known) for group in groups),
        tuple(map(restrict, system.positive)),
        tuple(map(restrict, system.nonnegative)),
    )


def points_on(system: RealSystem, patch: Patch, count: int = 3) -> Points:
    """Numerical points of a set on a patch, in all variables."""
    return numerical_points(replace(system, equations=patch.generators), count)


def is_proven_empty(
    system: RealSystem, seconds: float = patience.EMPTINESS.seconds, *, modular: bool = True
) -> Verdict:
    """Whether there is no real point: yes where that is shown in so many seconds, else undecided.

    modular: whether an answer that rests on primes will do: with patience only where there is no better one.
    """
    hasty = engines.proof_patience() == 1
    longer = engines.proof_patience() if modular else 1.0
    chart = Cartesian.of(system)

    def no_assembly() -> Verdict:
        return has_no_assembly(system.closed_equations)

    def no_complex_point() -> Verdict:
        most = min(seconds, patience.HASTY_EMPTINESS.work) if hasty else seconds
        with attempt("a proof that there is no complex point", most * longer):
            return chart.is_empty(patience.QUICK_EMPTINESS.work if modular and hasty else None)
        return Verdict.undecided("that there is no complex point was not shown in time")

    def no_real_point() -> Verdict:
        trimmed, limited = chart.trimmed, current().part(seconds * longer)
        return remember("no real point", trimmed, lambda: _has_no_real_point(trimmed, limited), limited)

    doubtful = Verdict.undecided("that there is no real point was not shown in time")
    for proof in (no_assembly, no_complex_point, no_real_point):
        answer = proof()
        if answer.is_yes and ((modular and hasty) or answer.certainty == "proven"):
            return answer
        if answer.is_yes and modular:
            doubtful = answer
    return doubtful


def _has_no_real_point(system: RealSystem, budget: Budget) -> Verdict:
    """Whether a set is proven empty; branches that are split further often leave the same set to ask for."""
    verdict = is_empty_over_reals(system, budget, tries=0)
    if verdict.is_undecided:
        cut_short("a proof that there is no real point")
    return verdict


def samples_of(component: Component, feasible: RealSystem) -> Known[Points | None]:
    """Real points of a component, numerical ones that only guide; None where it is shown to have none."""
    premises = Premises()
    if premises.take(is_excluded(component, feasible)):
        return premises.conclude(None)
    if component.dimension == 0:
        points = [p for p in premises.take(real_points(component.ideal)) if feasible.admits(p)]
        return premises.conclude(tuple(p.floats for p in points) or None)
    system = replace(feasible, equations=component.generators)
    found = numerical_points(system)
    if not found and premises.grants(is_empty_over_reals(system, tries=0)):
        return premises.conclude(None)
    return premises.conclude(found)
