"""A classification as its user holds it: single classes, rows, text that reads back, configurations."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest

from singsym.classes.classify import Limits, classify, classify_equation
from singsym.classes.result import Classification
from singsym.classes.running.json_codec import decode, encode
from singsym.classes.taxonomy.types import SingularityType
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Mechanism, define, library, load

T = SingularityType


@pytest.fixture(scope="module")
def slider_crank() -> Classification:
    return classify(load("slider-crank"), cache=False)


# -- single classes ----------------------------------------------------------------------------------


@pytest.mark.parametrize("key", [2, "RO, II", "II RO", T.RO | T.II])
def test_a_class_by_its_number_its_words_and_its_types(
    slider_crank: Classification, key: int | str | SingularityType
) -> None:
    """Table 1: class 2 is (RO, II)."""
    assert slider_crank[key] is slider_crank.classes[1]


@pytest.mark.parametrize("key", [0, 22, -1, "RI", "nonsense", "", T(0), None])
def test_what_is_no_class(slider_crank: Classification, key: int) -> None:
    """(RI) alone is none of the 21: k_O > p and k_O <= delta give delta > p, and so IIM."""
    with pytest.raises(KeyError, match="number from 1 to 21"):
        slider_crank[key]


def test_iteration_goes_through_the_classes(slider_crank: Classification) -> None:
    assert [c.singularity_class.number for c in slider_crank] == list(range(1, 22))


# -- rows and plain data -------------------------------------------------------------------------------


def test_rows_are_plain_and_alike(slider_crank: Classification) -> None:
    """Crank and rod in line, stretched and folded: two dead centres."""
    rows = slider_crank.table()
    assert len({tuple(row) for row in rows}) == 1
    first = {k: rows[0][k] for k in ("class", "types", "verdict", "dimension", "points", "witnesses")}
    assert first == {
        "class": 1,
        "types": "RI, IO",
        "verdict": "yes",
        "dimension": 0,
        "points": 2,
        "witnesses": 2,
    }
    assert {row["verdict"] for row in rows[1:]} == {"no"}
    assert json.loads(json.dumps(rows)) == rows


def test_configurations_as_numbers(slider_crank: Classification) -> None:
    """The rod is three times as long as the crank: the slider is at 1 + 3 and at 3 - 1, in floats too."""
    found = slider_crank[1].witnesses
    assert sorted(w.floats()["C.x"] for w in found) == pytest.approx([2, 4], abs=1e-15)
    for w in found:
        assert w.floats().keys() == w.decimals().keys()
        assert all(abs(Fraction(x) - Fraction(w.floats()[n])) < 1e-15 for n, x in w.decimals().items())
    written = slider_crank.to_dict()["classes"][0]
    assert written["witness_numbers"] == [w.floats() for w in found]
    assert [float(w["C.x"]) for w in written["witnesses"]] == [w["C.x"] for w in written["witness_numbers"]]


# -- text and back -------------------------------------------------------------------------------------


def two_roots() -> Mechanism:
    """An arm whose lengths are numbers of a field of degree 4."""
    links = {"ground": {"points": {"A": [0, 0]}}, "AB": "sqrt(2)", "BC": "sqrt(3)/2"}
    return define(
        name="arm", inputs=["A", "B"], output={"velocity": "C"}, links=links, joints={"A": "R", "B": "R"}
    )


@pytest.mark.parametrize(
    "mechanism",
    [
        load("slider-crank"),
        load("2r").with_parameters(l1="3/2", l2=None),
        load("change-point"),
        two_roots(),
    ],
    ids=lambda m: m.name,
)
def test_text_reads_back_as_the_same(mechanism: Mechanism) -> None:
    found = classify(mechanism, cache=False)
    again = Classification.from_json(found.to_json())
    assert again == found
    assert (again.seconds, again.seed) == (found.seconds, found.seed)
    assert again.equation.values == found.equation.values
    assert again.to_json() == found.to_json()
    assert again.to_dict() == found.to_dict()


def test_equations_without_a_mechanism_read_back_too() -> None:
    found = classify_equation(None, velocity_equation(load("slider-crank")), cache=False)
    assert Classification.from_json(found.to_json()) == found


def test_what_is_undecided_reads_back_too() -> None:
    found = classify(load("fourbar"), cache=False, limits=Limits(clock=1e-9))
    assert found.undecided
    assert Classification.from_json(found.to_json()) == found


@pytest.mark.parametrize("text", ["", "{", "null", "[]", '{"format": "other"}', "Infinity", '"abc"'])
def test_foreign_text_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="no classification"):
        Classification.from_json(text)


def test_what_people_read_is_not_read_back(slider_crank: Classification) -> None:
    with pytest.raises(ValueError, match="no classification"):
        Classification.from_json(json.dumps(slider_crank.to_dict()))


def test_another_version_and_damage_are_told_apart(slider_crank: Classification) -> None:
    data = json.loads(slider_crank.to_json())
    with pytest.raises(ValueError, match=r"of singsym 9\.9, whose results have other parts"):
        Classification.from_json(json.dumps({**data, "version": "9.9", "shape": "0"}))
    with pytest.raises(ValueError, match="damaged"):
        Classification.from_json(json.dumps({**data, "value": 10**6}))
    with pytest.raises(ValueError, match="damaged"):
        Classification.from_json(json.dumps({**data, "shared": data["shared"][:-1]}))


def test_all_mechanisms_of_the_library_can_be_written() -> None:
    for mechanism in map(load, library.names()):
        written = json.loads(json.dumps(encode(mechanism, Mechanism)))
        assert decode(written, Mechanism) == mechanism
