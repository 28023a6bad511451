"""Ideals on FLINT alone: laws, special cases and textbook examples."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.effort.budget import Budget, BudgetExceeded
from singsym.elimination import engines, memo
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring

R = Ring(("x", "y", "z"))
x, y, z = R.gens


@pytest.fixture(autouse=True)
def _flint_alone() -> Iterator[None]:
    with engines.use("flint"):
        yield


def ideal(*generators: Polynomial) -> Ideal:
    return Ideal(R, generators)


def test_cox_little_oshea_2_8_example_1() -> None:
    """xz - y^2, x^3 - z^2 (chapter 2, section 8): f = -4x^2y^2z^2 + y^6 + 3z^5 is in the ideal."""
    i = ideal(x * z - y**2, x**3 - z**2)
    assert i.contains(-4 * x**2 * y**2 * z**2 + y**6 + 3 * z**5).value
    assert not i.contains(x * y - 5 * z**2 + x).value


def test_normal_form_is_exact() -> None:
    i = ideal(3 * x**2 - 2 * y, 5 * x * y - z, 7 * y**2 - x)
    p = Fraction(2, 11) * x**3 * y + y**4 / 3 - z + 1
    remainder = i.normal_form(p).value
    assert i.contains(p - remainder).value
    assert remainder.primitive() == i.reduce(p).value
    assert i.normal_form(remainder).value == remainder
    assert ideal().normal_form(p).value == p
    assert ideal(R.one).normal_form(p).value.is_zero
    assert i.normal_form(R.zero).value.is_zero


def test_unit_and_zero_ideals() -> None:
    unit, zero = ideal(R.one), ideal()
    assert unit.is_unit().value
    assert unit.dimension.value == -1
    assert unit.degree.value == 0
    assert unit.vector_space_dimension.value == 0
    assert not unit.is_zero_dimensional.value
    assert unit.minimal_primes().value == ()
    assert unit.radical().value.is_unit().value
    assert zero.dimension.value == 3
    assert zero.minimal_primes().value == (zero,)
    assert zero.contains(R.zero).value
    assert not zero.contains(x).value
    assert zero.saturate(x).value.equals(zero).value
    assert unit.saturate(x).value.is_unit().value
    assert zero.saturate(R.zero).value.is_unit().value
    assert (unit * zero).equals(zero).value
    assert (unit + zero).equals(unit).value
    assert ideal(R.constant(3), x).equals(unit).value
    with pytest.raises(ValueError, match="infinitely many"):
        _ = zero.vector_space_dimension


def test_non_reduced_and_embedded() -> None:
    double = ideal((x - y) ** 2)
    assert double.radical_contains(x - y).value
    assert not double.contains(x - y).value
    embedded = ideal(x**2, x * y)
    assert embedded.saturate(y).value.equals(ideal(x)).value
    assert embedded.quotient(x).value.equals(ideal(x, y)).value
    assert double.radical().value.equals(ideal(x - y)).value


def test_radical_membership_needs_no_elimination() -> None:
    curve = ideal(y - x**2, z - x**3)
    assert curve.radical_contains(x * z - y**2).value
    assert curve.radical_contains(ideal(x * z - y**2, y**3 - z**2)).value
    assert not curve.radical_contains(x).value
    assert curve.radical_contains(R.zero).value


def test_elimination_of_nonlinear_variables() -> None:
    ring = Ring(("s", "t", "a", "b", "c"))
    s, t, a, b, c = ring.gens
    surface = Ideal(ring, (a - s**2, b - s * t, c - t**2)).eliminate(("s", "t")).value
    assert surface.generators == (b**2 - a * c,)
    # the tangent surface of the twisted cubic (Cox, Little, O'Shea, 3.3)
    tangents = (
        Ideal(ring, (a - s - t, b - s**2 - 2 * s * t, c - s**3 - 3 * s**2 * t)).eliminate(("s", "t")).value
    )
    expected = 4 * a**3 * c - 3 * a**2 * b**2 - 6 * a * b * c + 4 * b**3 + c**2
    assert tangents.equals(Ideal(ring, (expected,))).value
    assert surface.restrict(Ring(("a", "b", "c"))).dimension.value == 2


def test_rings_do_not_mix() -> None:
    other = Ring(("x", "y"))
    with pytest.raises(ValueError, match="convert"):
        ideal(x).contains(other.gens[0])
    with pytest.raises(ValueError, match="convert"):
        Ideal(other, (x,))
    with pytest.raises(KeyError):
        ideal(x).eliminate({"w"})


def test_minimal_primes_without_an_engine() -> None:
    assert {p.generators for p in ideal(x**2 * y * (x**2 + 1)).minimal_primes().value} == {
        (x,),
        (y,),
        (x**2 + 1,),
    }
    lines = ideal(z - x * y, z**2 - 4 * x * y).minimal_primes().value
    assert {p.groebner_basis().value for p in lines} == {(z, x), (z, y), (z - 4, x * y - 4)}
    with pytest.raises(engines.EngineUnavailable, match="install"):
        ideal(x**2 - 2, y**2 - 2, z**2 - x * y).minimal_primes()


def test_frozen_hashable_picklable() -> None:
    i = ideal(x**2 - y, z)
    assert pickle.loads(pickle.dumps(i)) == i
    assert hash(i) == hash(pickle.loads(pickle.dumps(i)))
    assert i != ideal(z, x**2 - y)
    assert i.equals(ideal(z, x**2 - y + z)).value
    with pytest.raises(AttributeError):
        i.ring = R  # type: ignore[misc]


def test_results_are_remembered_by_content(monkeypatch: pytest.MonkeyPatch) -> None:
    first = ideal(x**2 - y, y**2 - x).groebner_basis().value
    monkeypatch.setattr(engines.registry, "ask", None)
    assert ideal(2 * (y**2 - x), x**2 - y).groebner_basis().value == first


def test_no_budget_left() -> None:
    with pytest.raises(BudgetExceeded):
        ideal(x**2 - y, y**2 - z).groebner_basis(Budget(0))
    with Budget(0), pytest.raises(BudgetExceeded):
        _ = ideal(x**2 - y, y**2 - 3 * z).dimension
    assert ideal(x**2 - y * z, y**2 - 5 * z).unit_verdict(Budget(0)).is_undecided
    assert ideal(x * y - 1, y).unit_verdict().is_yes


small = st.integers(-2, 2)
polynomials = st.lists(
    st.tuples(small, st.sampled_from([R.one, x, y, z, x * y, y * z, x**2])), max_size=3
).map(lambda terms: sum((c * m for c, m in terms), start=R.zero))
ideals = st.lists(polynomials, max_size=2).map(lambda generators: Ideal(R, generators))


@settings(max_examples=40, deadline=None)
@given(ideals, ideals, polynomials)
def test_laws(i: Ideal, j: Ideal, g: Polynomial) -> None:
    meet = i.intersect(j).value
    assert i.contains(meet).value
    assert j.contains(meet).value
    assert meet.contains(i * j).value
    assert (i + j).contains(i).value
    assert (i + j).contains(j).value
    colon, saturation = i.quotient(g).value, i.saturate(g).value
    assert colon.contains(i).value
    assert saturation.contains(colon).value
    assert i.contains(Ideal(R, (g,)) * colon).value
    assert saturation.is_unit().value == i.radical_contains(g).value
    assert meet.dimension.value == max(i.dimension.value, j.dimension.value)
    rest = i.eliminate({"x"}).value
    assert i.contains(rest).value
    assert all(p.degree("x") <= 0 for p in rest.generators)
    memo.forget()
