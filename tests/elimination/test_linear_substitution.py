"""Variables that equations give: the value makes the equation zero, and the other equations lose it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from singsym.elimination.linear_substitution import (
    connected,
    shortest_substitution,
    solved_variable,
    substitute_solved,
)
from singsym.polynomials import Polynomial, Ring

R = Ring(("x", "y", "z"))
x, y, z = R.gens
monomial = st.tuples(*[st.integers(0, 2)] * 3)
polynomial = st.dictionaries(monomial, st.integers(-3, 3), max_size=5).map(R.from_dict)


@given(polynomial)
def test_the_value_makes_the_equation_zero(p: Polynomial) -> None:
    found = solved_variable(p)
    if found is None:
        # no variable has a single term, which is a number times itself
        for i in range(3):
            own = [m for m, _ in p.terms() if m[i]]
            assert len(own) != 1 or sum(own[0]) > 1
    else:
        assert found.name not in found.value.variables
        assert found.apply([p]) == (R.zero,)
        assert found.equation == p.primitive()


def test_only_variables_that_are_asked_for() -> None:
    assert solved_variable(x + y + z, ["y"]) == solved_variable(y + z + x, {"y"})
    assert solved_variable(x + y * z, ["y", "z"]) is None


def test_the_simplest_equation_is_taken() -> None:
    found = shortest_substitution([x + y**2, 2 * z - 3 * y])
    assert found is not None
    assert (found.name, found.value) == ("y", z * 2 / 3)


@pytest.mark.parametrize("bounded", [True, False])
def test_everything_that_is_given_goes(bounded: bool) -> None:
    """x = y^2 and y = z + 1 leave x z - 1 as (z + 1)^2 z - 1."""
    rest, made = substitute_solved([x - y**2, y - z - 1, x * z - 1], bounded=bounded)
    assert rest == [(z + 1) ** 2 * z - 1]
    assert {step.name for step in made} == {"x", "y"}


def test_what_makes_much_longer_is_not_done() -> None:
    long = (x + 1) ** 30 - z**2
    value = y**9 + sum((y**k * z for k in range(9)), start=R.zero)
    rest, made = substitute_solved([x - value, long])
    assert (rest, made) == ([x - value, long], [])
    assert [step.name for step in substitute_solved([x - y, long])[1]] == ["x"]


def test_groups_that_share_nothing() -> None:
    assert sorted(map(len, connected([x * y, y - 1, z**2, R.one]))) == [1, 1, 2]
