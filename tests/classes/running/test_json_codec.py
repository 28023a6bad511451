"""Values as JSON: they come back equal, and nothing comes back that the type hints do not name."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, get_type_hints

import pytest
from flint import fmpq, fmpz
from hypothesis import given
from hypothesis import strategies as st

from singsym.classes.realisation.alike import AlikeTask, realise_alike
from singsym.classes.realisation.certified_configuration import Names
from singsym.classes.realisation.curve_components import CurveTask, count
from singsym.classes.realisation.realisation import RealTask
from singsym.classes.running.json_codec import Mismatch, codec, decode, encode
from singsym.classes.solve import LocusTask, solve_locus
from singsym.classes.strata.branches import Branch, Explored, explore
from singsym.classes.strata.ranks import RankProblem
from singsym.classes.taxonomy.types import Defects, SingularityType
from singsym.conditions.conditions import conditions
from singsym.effort.verdict import Verdict
from singsym.elimination.ideal import Ideal
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.polynomials.ring import AlgebraicConstant
from singsym.varieties.decomposition import Component
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.system import RealSystem

ROOT = AlgebraicConstant("sqrt3", (-3, 0, 1), Fraction(1), Fraction(2), r"\sqrt{3}", "sqrt(3)")
RING = Ring(("x", "y", "sqrt3"), constants=(ROOT,))
X, Y, _ = RING.gens


@dataclass(frozen=True)
class Pair:
    """A record with a union of records."""

    first: Fraction | Defects | None
    second: Mapping[str, tuple[Polynomial, ...]]


def again(value: Any, hint: Any) -> Any:
    """The value by way of its text."""
    return decode(json.loads(json.dumps(encode(value, hint))), hint)


rationals = st.builds(Fraction, st.integers(-(10**40), 10**40), st.integers(1, 10**40))
polynomials = st.dictionaries(st.tuples(*[st.integers(0, 5)] * 3), rationals, max_size=6).map(
    lambda terms: RING.from_dict({m: c for m, c in terms.items() if c})
)
types = st.integers(0, 63).map(SingularityType)
defects = st.builds(Defects, *[st.integers(0, 9)] * 4)
pairs = st.builds(
    Pair, st.none() | rationals | defects, st.dictionaries(st.text(), st.tuples(polynomials, polynomials))
)


@given(rationals, polynomials, types, st.floats(allow_nan=False), pairs)
def test_values_come_back_equal(
    number: Fraction, polynomial: Polynomial, flags: SingularityType, real: float, pair: Pair
) -> None:
    hint = tuple[Fraction, Polynomial, SingularityType, float, Pair]
    value = number, polynomial, flags, real, pair
    assert again(value, hint) == value
    assert encode(again(value, hint), hint) == encode(value, hint)


@given(st.integers())
def test_numbers_of_any_length(n: int) -> None:
    big = n * 16**5000 + 1
    assert again((n, big, fmpz(big), fmpq(n, 7)), tuple[int, int, fmpz, fmpq]) == (n, big, big, fmpq(n, 7))


def test_what_is_not_compared_comes_back_too() -> None:
    component = Component(Ideal(RING, (X, Y)), True, 0, purity="Cohen-Macaulay")
    found = again(component, Component)
    assert found == component
    assert found.purity == "Cohen-Macaulay"
    assert found.ideal.ring.constants[0].latex == r"\sqrt{3}"


def test_equal_parts_are_written_once_and_read_as_one_object() -> None:
    other = Ring(RING.names, RING.order, RING.constants)
    value = (X + Y, other.gens[0] + other.gens[1], other.gens[1])
    written = encode(value, tuple[Polynomial, ...])
    assert written["value"][0] == written["value"][1]
    one, two, three = again(value, tuple[Polynomial, ...])
    assert one is two
    assert one.ring is three.ring


# -- results of real tasks ---------------------------------------------------------------------------


def tasks(name: str) -> Any:
    """Tasks of a mechanism with their functions: its search, each of its loci, and the curves of those."""
    found = conditions(velocity_equation(load(name)))
    space = found.equation.space
    feasible = RealSystem(space.ring, (), space.exclusions, space.positive, space.nonnegative)
    names = Names(space.points, found.equation.values)
    matrices = {m: found.matrix(m) for m in ("L", "L_I", "L_O", "L_p")}
    problem = RankProblem(matrices, found.reduction.constant, found.equation.N, found.equation.n)
    root = Branch(problem, feasible, space.equations, seconds=20)
    yield explore, root
    explored = explore(root)
    yield from ((explore, branch) for branch in explored.following[:2])
    alone = (AlikeTask(RealTask(part, feasible, names, 20)) for part in explored.found[:3])
    yield from ((realise_alike, task) for task in alone)
    for path in found["4"].polynomials:
        yield solve_locus, LocusTask(path, space.equations, feasible, names, 20)
        yield count, CurveTask(((*space.equations, *path),), ((),), 20)


@pytest.mark.parametrize("name", ["slider-crank", "sarrus", "scara", "spherical-5r"])
def test_real_results_come_back_equal(name: str) -> None:
    for function, task in tasks(name):
        hints = get_type_hints(function)
        result, hint = function(task), hints["return"]
        assert again(result, hint) == result
        assert encode(again(result, hint), hint) == encode(result, hint)
        assert again(task, hints[next(iter(hints))]) == task


def test_points_are_exact_data() -> None:
    point = RealPoint(RING, (-2, 0, 1), (1,), ((0, 1), (1, 1), (0,)), Fraction(1), Fraction(2))
    found = again(point, RealPoint)
    assert found == point
    assert found.sign(X**2 - 2) == 0


# -- what is refused ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "hint"),
    [
        (True, int),
        (1, bool),
        ("1", int),
        (1, str),
        ([1], tuple[int, ...]),
        ((1, 2, 3), tuple[int, int]),
        (1.5, Fraction),
        (RING, Polynomial),
        ((1, 1, 0, 0), Defects),
        (2, SingularityType),
        (Verdict.yes(witness=RING), Verdict),
        ("perhaps", get_type_hints(Verdict)["certainty"]),
        ({1: "a"}, Mapping[str, str]),
    ],
)
def test_values_of_another_type_are_not_written(value: Any, hint: Any) -> None:
    with pytest.raises(Mismatch):
        encode(value, hint)


@pytest.mark.parametrize("hint", [object, list[int], type, Exception, callable, set[int], Ring("x").gens])
def test_types_without_codec(hint: Any) -> None:
    with pytest.raises(TypeError):
        codec(hint)


PLAIN = [
    ({"value": 1}, int),
    ({"shared": {}, "value": 1}, int),
    ({"shared": [], "value": 1, "more": 2}, int),
    ([], int),
    ({"shared": [], "value": 1.0}, int),
    ({"shared": [], "value": "0x10"}, int),
    ({"shared": [], "value": " 0x1_0000000000000000"}, int),
    ({"shared": [], "value": 64}, SingularityType),
    ({"shared": [], "value": -1}, SingularityType),
    ({"shared": [], "value": True}, SingularityType),
    ({"shared": [], "value": "ab"}, tuple[str, ...]),
    ({"shared": [], "value": [["a", 1], ["a", 2]]}, Mapping[str, int]),
    ({"shared": [], "value": [2, 1]}, int | str | None),
    ({"shared": [], "value": [-1, "a"]}, int | str | None),
    ({"shared": [], "value": 0}, Fraction),
    ({"shared": [[1, 2]], "value": -1}, Fraction),
    ({"shared": [[1, 2]], "value": True}, Fraction),
    ({"shared": [[1, 0]], "value": 0}, Fraction),
    ({"shared": [[2, 4]], "value": 0}, Fraction),
    ({"shared": [[0, 0, 0, 0]], "value": 0}, Ring),
    ({"shared": [[0, 0, 0, 0, 0]], "value": 0}, Defects),
    ({"shared": [1], "value": 0}, fmpq),
    ({"shared": ["2/4"], "value": 0}, fmpq),
    ({"shared": [["x"], "degrevlex", []], "value": 0}, Ring),
    ({"shared": [[["x"], "degrevlex", []], [0, "1", "1"]], "value": 0}, Polynomial),
    ({"shared": [[0, "", ""]], "value": 0}, Polynomial),
    ({"shared": [[1, "", ""], [["x"], "degrevlex", []]], "value": 0}, Polynomial),
    *(
        ({"shared": [[["x"], order, []], [0, exponents, coefficients]], "value": 1}, Polynomial)
        for order, exponents, coefficients in (
            ("wrong", "1", "1"),
            ("degrevlex", "1 1", "1"),
            ("degrevlex", "-1", "1"),
            ("degrevlex", "1_0", "1"),
            ("degrevlex", "1", "0"),
            ("degrevlex", "1", "2/4"),
            ("degrevlex", "1", "1/0"),
            ("degrevlex", "1", "x"),
            ("degrevlex", "1 1", "1 2"),
            ("degrevlex", "0 1", "1 1"),
        )
    ),
]


@pytest.mark.parametrize(("data", "hint"), PLAIN)
def test_data_of_another_form_are_not_read(data: Any, hint: Any) -> None:
    with pytest.raises((ValueError, TypeError, KeyError, ZeroDivisionError, OverflowError)):
        decode(data, hint)


def places(data: Any) -> Any:
    """Each list of some data with each of its places."""
    if isinstance(data, list):
        for i, part in enumerate(data):
            yield data, i
            yield from places(part)


def test_a_wrong_part_anywhere_is_seen() -> None:
    """Of a result with matrices, polynomials, verdicts: no part can be made an object of its own."""
    stratum = Component(Ideal(RING, (X * Y - 1, X)), True, 0)
    value = Explored(undecided=("why",)), stratum, PolynomialMatrix(RING, ((X, Y),)), Verdict.yes()
    hint = tuple[Explored, Component, PolynomialMatrix, Verdict]
    data = json.loads(json.dumps(encode(value, hint)))
    assert decode(data, hint) == value
    for part, i in [*places(data["shared"]), *places(data["value"])]:
        kept, part[i] = part[i], {"__reduce__": "os.system"}
        with pytest.raises((ValueError, TypeError)):
            decode(data, hint)
        part[i] = kept
