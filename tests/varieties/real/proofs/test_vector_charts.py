"""Vectors instead of unit vectors and lengths: the new system has the images of the old one's points."""

from __future__ import annotations

from math import cos, sin

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from singsym.effort.budget import Budget
from singsym.effort.chaos import chaos
from singsym.effort.verdict import Answer
from singsym.elimination import engines
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.proofs.emptiness import is_empty_over_reals
from singsym.varieties.real.proofs.vector_charts import Cartesian
from singsym.varieties.real.system import RealSystem

R = Ring(("c", "s", "q", "w", "z"))
c, s, q, w, z = R.gens
LEG = (c**2 + s**2 - 1, q**2 + w**2 - 1)
ANGLES = st.floats(-3, 3)


@given(ANGLES, ANGLES)
def test_points_of_a_leg_go_to_points_of_a_sphere(turn: float, lift: float) -> None:
    """The end of a leg of length 1, turned and lifted: (q c, q s, w); z stands in a condition on it."""
    system = RealSystem(R, (*LEG, q * c + 2 * q * s - 3 * z), exclusions=((q,),))
    chart = Cartesian.of(system)
    point = {"c": cos(turn) * cos(lift), "s": sin(turn) * cos(lift), "q": 0.0, "w": sin(lift)}
    point["z"] = (point["c"] + 2 * point["s"]) / 3
    image = [point[name] for name in R.names]
    assert "q" not in {n for p in chart.system.equations for n in p.variables}
    assert all(abs(p.evaluate(image)) < 1e-9 for p in chart.system.equations)


def test_a_length_that_is_needed_stays() -> None:
    """z - q changes with the sign of the length, so both signs are different conditions."""
    chart = Cartesian.of(RealSystem(R, (*LEG, q * c + q * s - z - q), exclusions=((q,),)))
    assert any("q" in p.variables for p in chart.system.equations)


def test_an_exclusion_that_knows_the_sign_is_not_the_same_for_both() -> None:
    equations = (*LEG, q * c + 2 * q * s - 3 * z)
    assert Cartesian.of(RealSystem(R, equations, exclusions=((q,), (z,)))).faithful
    assert not Cartesian.of(RealSystem(R, equations, exclusions=((q,), (z - q, w)))).faithful


@pytest.mark.parametrize(("height", "empty"), [(2, True), (1, False)])
def test_the_trimmed_system_has_a_point_if_the_given_one_has(height: int, empty: bool) -> None:
    """w = height / 2 on the unit sphere without its poles: no point for height 2, a circle for 1."""
    chart = Cartesian.of(RealSystem(R, (*LEG, 2 * w - height), exclusions=((q,),)))
    assert chart.is_empty().is_yes == empty
    assert is_empty_over_reals(chart.trimmed).is_yes == empty


def test_an_exclusion_of_several_polynomials_is_kept_where_only_it_leaves_out_points() -> None:
    """x = 0 and y = z are a line, all of which is excluded, though not by one polynomial."""
    x, y, z = Ring(("x", "y", "z")).gens
    line = (x, y - z)
    group = tuple(f * (z**4 + k * z**2 + 1) for f in line for k in (1, 2, 3))
    system = RealSystem(x.ring, (x + x * z**2, y - z + x * y), exclusions=((z**2 + 5,), group))
    trimmed = Cartesian.of(system).trimmed
    assert trimmed.exclusions == (group,)
    assert is_empty_over_reals(trimmed, tries=0).is_yes


def katsura_and_one_more(more: int) -> RealSystem:
    """Katsura's equations, hard to solve over Q, and more * u = 1.

    They are sum x_l x_(m-l) = x_m for m = 0, ..., 6 (x_-k = x_k, and zero beyond x_7) and
    x_0 + 2 (x_1 + ... + x_7) = 1: with x_0 = 1 and the others 0 they all hold,
    so that (1, 0, ..., 0, 1 / more) is a solution.
    """
    ring = Ring((*(f"x{i}" for i in range(8)), "u"))

    def at(i: int) -> Polynomial:
        return ring.gens[abs(i)] if abs(i) < 8 else ring.zero

    rows = [sum((at(k) * at(m - k) for k in range(-7, 8)), start=ring.zero) - at(m) for m in range(7)]
    rows.append(at(0) + 2 * sum(map(at, range(1, 8)), start=ring.zero) - 1)
    return RealSystem(ring, (*rows, more * ring.gen("u") - 1))


@pytest.mark.engines
@pytest.mark.skipif(not engines.has("msolve"), reason="FLINT takes no primes")
def test_a_solution_that_a_prime_does_not_see() -> None:
    """Modulo the prime 2^31 - 1 there is none."""
    system = katsura_and_one_more(2**31 - 1)
    point = [fmpq(1), *[fmpq(0)] * 7, fmpq(1, 2**31 - 1)]
    assert not any(e.evaluate(point) for e in system.equations)
    with Budget(60):
        assert not Cartesian.of(system).is_empty(0.2).is_yes


@pytest.mark.engines
@pytest.mark.skipif(not engines.has("msolve"), reason="FLINT takes no primes")
def test_without_time_for_a_proof_several_primes_say_it_or_nobody() -> None:
    """c^2 s is 2 and 3 at once nowhere."""
    system = RealSystem(R, (c**2 * s - 2, c**2 * s - 3))
    quick = Cartesian.of(system).is_empty(0.0)
    assert (quick.answer, quick.certainty) == (Answer.YES, "modular")
    with chaos(1, 1.0):
        assert Cartesian.of(system).is_empty(0.0).is_undecided
    patient = Cartesian.of(system).is_empty()
    assert (patient.answer, patient.certainty) == (Answer.YES, "proven")
