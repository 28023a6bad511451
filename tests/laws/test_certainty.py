"""What rests on a Groebner basis is no more certain than it: every answer that does says so."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from singsym.classes.realisation.certified_configuration import Names
from singsym.classes.solve import LocusTask, solve_locus
from singsym.classes.strata.occurrence import samples_of
from singsym.effort.verdict import Certainty, Known
from singsym.elimination import engines
from singsym.elimination.ideal import Ideal, intersection
from singsym.elimination.memo import forget
from singsym.polynomials import Ring
from singsym.varieties.constructible import ConstructibleSet
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.irreducibility import analyse
from singsym.varieties.real.dimension.hyperplane_cuts import dimension_by_cuts, stripped
from singsym.varieties.real.dimension.real_dimension import component_dimension, real_dimension
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.proofs.critical_points import sample_points
from singsym.varieties.real.proofs.emptiness import is_empty_over_reals, is_excluded
from singsym.varieties.real.proofs.extrema_on_tori import extreme_zeros
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y", "z"))
x, y, z = R.gens
CURVE = (x**2 + y**2 - z**2 - 1, x * y - z**2 + 2)
"""Two quadrics that share no factor, in no variable linear: a basis takes an engine."""
POINTS = (*CURVE, x**2 - 2 * y**2 + z)
NOTHING = (*CURVE, x**2 + y**2 + z**2 + 1)
"""The first and the last say that x^2 + y^2 = 0."""
ideal, other = Ideal(R, CURVE), Ideal(R, (x * y - 1, y * z - x**2))
circles = Ring(("c", "s", "p", "q"))
c, s, p, q = circles.gens


def piece() -> Component:
    """The curve as one piece that is not proven prime."""
    return Component(ideal, False, 1, "unmixed")


def points() -> Known[tuple[RealPoint, ...]]:
    """By the basis, which is there already; by themselves they would be found without an engine."""
    Ideal(R, POINTS).groebner_basis()
    return real_points(POINTS)


QUESTIONS: dict[str, Callable[[], Certainty]] = {
    "basis": lambda: ideal.groebner_basis().certainty,
    "leading monomials": lambda: ideal.leading_monomials().certainty,
    "normal form": lambda: ideal.normal_form(x**3).certainty,
    "membership": lambda: ideal.contains(x**3).certainty,
    "membership in the radical": lambda: ideal.radical_contains(x).certainty,
    "equality": lambda: ideal.equals(other).certainty,
    "unit": lambda: ideal.is_unit().certainty,
    "unit, as a verdict": lambda: ideal.unit_verdict().certainty,
    "dimension": lambda: ideal.dimension.certainty,
    "finiteness": lambda: ideal.is_zero_dimensional.certainty,
    "degree": lambda: ideal.degree.certainty,
    "number of zeros": lambda: Ideal(R, POINTS).vector_space_dimension.certainty,
    "intersection": lambda: intersection(R, (ideal, other)).certainty,
    "elimination": lambda: ideal.eliminate({"x"}).certainty,
    "saturation": lambda: ideal.saturate(x).certainty,
    "quotient": lambda: ideal.quotient(x * y).certainty,
    "decomposition": lambda: decompose(CURVE, ring=R).certainty,
    "splitting": lambda: analyse(ideal).certainty,
    "emptiness of a cell": lambda: ConstructibleSet.zeros(R, *NOTHING, z * x - y**2 + 5).is_empty().certainty,
    "closure": lambda: (ConstructibleSet.zeros(R, *CURVE) - ConstructibleSet.zeros(R, x)).closure().certainty,
    "dimension of a set": lambda: ConstructibleSet.zeros(R, *CURVE).dimension.certainty,
    "projection": lambda: ConstructibleSet.zeros(R, *CURVE).project(["x"]).exact.certainty,
    "points": lambda: points().certainty,
    "points on components": lambda: sample_points(R, CURVE).certainty,
    "exclusion": lambda: is_excluded(piece(), RealSystem(R, (), exclusions=((x, y),))).certainty,
    "emptiness": lambda: is_empty_over_reals(RealSystem(R, (*CURVE, x**4 + y**4 - z))).certainty,
    "dimension by cuts": lambda: dimension_by_cuts(RealSystem(R, CURVE)).certainty,
    "what is left off exclusions": lambda: stripped(ideal, [x]).certainty,
    "real dimension": lambda: real_dimension(RealSystem(R, CURVE)).certainty,
    "real dimension of a piece": lambda: component_dimension(piece(), RealSystem(R, (), ((x, y),))).certainty,
    "extreme values": lambda: extreme_zeros(c * p + s * q - 1, (("c", "s"), ("p", "q"))).certainty,
    "samples": lambda: samples_of(piece(), RealSystem(R, (), exclusions=((x, y),))).certainty,
    "a condition": lambda: solve_locus(LocusTask((), CURVE, RealSystem(R, ()), Names())).certainty,
}


@pytest.fixture(params=["proven", "modular"])
def known(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[Certainty]:
    """How all Groebner bases are known that an engine computes."""
    ask = engines.ask
    monkeypatch.setattr(engines, "ask", lambda *task: replace(ask(*task), certainty=request.param))
    forget()
    with engines.use("flint"):
        yield request.param
    forget()


@pytest.mark.parametrize("question", QUESTIONS)
def test_an_answer_is_as_certain_as_the_bases_under_it(question: str, known: Certainty) -> None:
    assert QUESTIONS[question]() == known
