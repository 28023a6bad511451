"""What one mechanism costs, in a process of its own: counts, and work as multiples of other work there.

Source of the reference: the system of Katsura (1987), a benchmark of Groebner bases; here of seven unknowns,
by FLINT alone.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Any

from flint import fmpz_mpoly_ctx, fmpz_mpoly_vec

from singsym.classes.classify import classify
from singsym.conditions.conditions import conditions
from singsym.effort import chance
from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.processor_time import worked
from singsym.elimination import engines
from singsym.elimination.engines import registry
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.elimination.memo import forget
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import Mechanism, load
from singsym.polynomials import Equations
from singsym.varieties.decomposition import decompose
from singsym.varieties.real.modules.module_points import module_points
from singsym.varieties.real.points.finite_sets import real_points
from tests.benchmarks.counting import counted

SEED = 1
LIMIT = 20.0
"""Seconds of work that a side of a comparison may take."""


@dataclass(frozen=True)
class Measured:
    """counts: see `counting`; work: of the classification, in references; undecided: whether it is open.

    compared: for each engine that can do the same sub-problem, the work of singsym over that of the engine;
    with "<" where the engine, with ">" where singsym did not end within the limit.
    """

    counts: dict[str, int]
    work: float
    undecided: bool
    compared: dict[str, str] = field(default_factory=dict)


def measure(mechanism: Mechanism) -> Measured:
    """Classify a mechanism, and solve its loci with and without singsym; the seed is always the same.

    Another mechanism is classified before, so that modules are imported.
    """
    reference = min(_work(katsura) for _ in range(3))
    with chance.use_seed(SEED):
        classify(load("slider-crank"), cache=False)
        forget()
        with counted() as counts:
            start = worked()
            result = classify(mechanism, cache=False)
            work = worked() - start
        return Measured(dict(counts), work / reference, result.undecided, _compared(mechanism))


def _work(task: Callable[[], object]) -> float:
    """The seconds of work of a task; infinite where it does not end within the limit."""
    forget()
    start = worked()
    try:
        with Budget(work=LIMIT):
            task()
    except Undecided:
        return inf
    return worked() - start


def katsura(size: int = 6) -> Any:
    """The reference: the Groebner basis of Katsura's system, whatever else the machine does."""
    context: Any = fmpz_mpoly_ctx.get([f"u{i}" for i in range(size + 1)], "degrevlex")
    places = range(-size, size + 1)
    u = {i: context.gens()[abs(i)] for i in places}
    equations = [sum(u.values()) - 1]
    equations += [sum(u[i] * u[m - i] for i in places if m - i in u) - u[m] for m in range(size)]
    return fmpz_mpoly_vec(equations, context).buchberger_naive()


# -- sub-problems --------------------------------------------------------------------------------------


def _compared(mechanism: Mechanism) -> dict[str, str]:
    """Points of the loci by msolve for n = 1, unless they are curves; else their components by Singular.

    msolve stops before it isolates the roots, and nothing of an engine's answer is checked.
    """
    equation = velocity_equation(mechanism)
    loci = _loci(equation)
    name = "msolve" if equation.n == 1 else "singular"
    if not loci or not engines.has(name):
        return {}
    own, other = (_points, _parametrizations) if equation.n == 1 else (_components, _minimal_primes)
    try:
        return {name: _ratio(_work(lambda: own(loci)), _work(lambda: other(loci)))}
    except NotZeroDimensional:
        return {}


def _ratio(own: float, other: float) -> str:
    if own == other == inf:
        return "both open"
    if other == inf:
        return f"< {own / LIMIT:.2g}"
    return f"> {LIMIT / other:.2g}" if own == inf else f"{own / other:.2g}"


def _loci(equation: VelocityEquation) -> list[Equations]:
    """The equations of the zeros of each factor of (4) and (5) on the configuration space."""
    found = conditions(equation)
    factors = dict.fromkeys(f.polynomial for label in ("4", "5") for f in found[label].factors)
    return [(*equation.space.equations, factor) for factor in factors]


def _points(loci: Sequence[Equations]) -> None:
    for locus in loci:
        try:
            module_points(locus)
        except Undecided:
            real_points(locus)


def _parametrizations(loci: Sequence[Equations]) -> None:
    for locus in loci:
        registry.msolve.parametrization(locus, locus[0].ring)


def _components(loci: Sequence[Equations]) -> None:
    for locus in loci:
        decompose(locus, ring=locus[0].ring)


def _minimal_primes(loci: Sequence[Equations]) -> None:
    for locus in loci:
        registry.singular.run(engines.Task("minimal_primes", locus[0].ring, locus), current())
