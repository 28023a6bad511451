"""What is open, not looked for, or resting on random primes is said in every form of the output.

The expected texts follow from what is put into a result by hand: a number that the result does not know must
be a "?" or "at least", with its reason, wherever it is shown.
"""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache

import pytest
import sympy

from singsym.classes.classify import classify
from singsym.classes.conclusions import NOT_COUNTED, remarks_of
from singsym.classes.result import Classification, ClassResult, Locus, counts
from singsym.classes.solve import solve
from singsym.classes.taxonomy.types import SingularityType
from singsym.conditions.conditions import Conditions, conditions
from singsym.effort.chance import use_seed
from singsym.effort.verdict import Verdict
from singsym.kinematics import SymbolicSpace, from_sympy
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import define, load
from singsym.output.html.gallery import card
from singsym.output.html.report import report
from singsym.output.latex import classification_latex
from singsym.output.page import plain
from singsym.output.pieces import parts_of
from singsym.output.plain_data import classification_data, solution_data
from singsym.output.strata_graph import strata_graph
from singsym.output.text import classification_page, solution_page
from singsym.varieties.real.dimension.extent import Extent

LATE = "the clock stood still"
OPEN = Extent(1, None, open=LATE)
FORMS = ("text", "latex", "report", "gallery", "json", "notebook")


@cache
def dead_centres() -> Classification:
    """A slider-crank: two points in class 1, on the second locus."""
    with use_seed(271828):
        return classify(load("slider-crank"), cache=False)


def shown(result: Classification, form: str) -> str:
    if form == "text":
        return plain(classification_page(result))
    if form == "latex":
        return classification_latex(result)
    if form == "report":
        return report(result)
    if form == "gallery":
        return card(result).body
    return json.dumps(classification_data(result)) if form == "json" else result._repr_html_()


def shown_as_open(found: Classification, form: str) -> str:
    """What is shown of a result with an open question, whose reason is told."""
    assert found.undecided
    text = shown(found, form)
    assert LATE in text
    return text


def with_class(**changes: object) -> Classification:
    """The slider-crank with another class 1."""
    result = dead_centres()
    first, *others = result.classes
    return replace(result, classes=(replace(first, **changes), *others))  # type: ignore[arg-type]


def with_locus(**changes: object) -> Classification:
    """The slider-crank with its second locus alone, changed."""
    result = dead_centres()
    return replace(result, loci=(replace(result.loci[1], **changes),))  # type: ignore[arg-type]


# -- dimensions and numbers ----------------------------------------------------------------------------


@pytest.mark.parametrize("form", FORMS)
def test_an_open_dimension_of_a_class(form: str) -> None:
    text = shown_as_open(with_class(extent=OPEN, points=None, components=None), form)
    assert "dimension of class 1" in text
    assert ('"at_least": 1' if form == "json" else "at least 1") in text


@pytest.mark.parametrize("form", ["text", "latex", "report", "json"])
def test_an_open_dimension_of_a_locus(form: str) -> None:
    text = shown_as_open(with_locus(extent=OPEN, points=None, components=None), form)
    assert "dimension of locus 1" in text


@pytest.mark.parametrize("form", FORMS)
def test_a_number_of_points_that_is_open(form: str) -> None:
    text = shown_as_open(with_class(points=None, components=None, open=LATE), form)
    assert "number of points of class 1" in text


@pytest.mark.parametrize("form", FORMS)
def test_parts_of_a_class_that_may_have_no_point(form: str) -> None:
    """Its locus is said with the class, and once that this is open, although its numbers are known."""
    first = dead_centres()[SingularityType.RI | SingularityType.IO].pieces[0]
    part = replace(first, verdict=Verdict.undecided(LATE), witnesses=())
    found = with_class(unsure=(part, part))
    assert list(found.open_questions()) == [("occurrence of parts of class 1", LATE)]
    text = shown_as_open(found, form)
    assert "occurrence of parts of class 1" in text
    if form in ("text", "latex", "report"):
        assert "perhaps also" in text


def test_a_number_that_is_missing_without_a_word_is_open() -> None:
    assert list(with_class(points=None).open_questions()) == [
        ("number of points of class 1", "it was not counted")
    ]
    assert with_locus(extent=Extent(1, 1), points=None, components=None).undecided
    assert not dead_centres().undecided


@pytest.mark.parametrize(
    ("changes", "expected", "parts"),
    [
        ({}, ("2", "2"), "2 points"),
        ({"points": None, "components": None}, ("?", "?"), "? points"),
        ({"extent": Extent(1, 1), "points": None, "components": 1}, ("", "1"), "1 component"),
        ({"extent": Extent(1, 1), "points": None, "components": None}, ("", "?"), "? components"),
        (
            {"extent": Extent(1, 1), "points": None, "components": None, "remark": NOT_COUNTED},
            ("", "not counted"),
            "not counted",
        ),
        ({"extent": Extent(2, None), "points": None, "components": None}, ("", ""), ""),
        (
            {"verdict": Verdict.undecided(LATE), "extent": Extent(), "points": None, "components": None},
            ("?", "?"),
            "?",
        ),
        (
            {"verdict": Verdict.no(), "extent": Extent(-1, -1), "points": None, "components": None},
            ("", ""),
            "",
        ),
    ],
)
def test_numbers_in_tables(changes: dict[str, object], expected: tuple[str, str], parts: str) -> None:
    found: ClassResult | Locus = with_class(**changes).classes[0]
    assert counts(found) == expected
    assert parts_of(found) == parts


@pytest.mark.parametrize("form", FORMS)
def test_what_was_not_looked_for_is_no_open_question(form: str) -> None:
    found = with_class(extent=Extent(1, 1), points=None, components=None, remark=NOT_COUNTED)
    assert not found.undecided
    text = shown(found, form)
    for part in ("components of curves are counted for n", "not counted"):
        assert part in text or form == "json"
    assert "class 1: components" in text


@pytest.mark.parametrize("form", FORMS)
def test_all_pieces_of_the_space(form: str) -> None:
    result = dead_centres()
    (whole,) = result.configuration_space
    found = replace(result, configuration_space=(whole, replace(whole, extent=OPEN, remark="the other one")))
    text = shown(found, form)
    assert "dimension of the configuration space, piece 2" in text
    if form in ("text", "latex", "report", "json"):
        assert "the other one" in text


@pytest.mark.parametrize("form", ["text", "report"])
def test_a_space_of_which_nothing_is_known(form: str) -> None:
    found = replace(with_class(verdict=Verdict.undecided(LATE)), configuration_space=())
    assert ("the configuration space", "no piece of it is known") in found.open_questions()
    assert "no piece of it is known" in shown(found, form)


# -- how things are known ------------------------------------------------------------------------------


@pytest.mark.parametrize("form", ["text", "latex", "report"])
def test_modular_says_how_many_primes(form: str) -> None:
    result = dead_centres()
    empty = next(c for c in result.classes if c.steps and c.verdict.is_no)
    changed = replace(empty, verdict=Verdict.no("modular"))
    found = replace(result, classes=tuple(changed if c is empty else c for c in result.classes))
    assert "modular, 3 primes" in shown(found, form)
    assert "modular" not in shown(result, form)
    assert "proven empty" in card(result).body
    assert "proven empty" not in card(found).body


@pytest.mark.parametrize("form", ["text", "latex", "report", "json"])
def test_the_seed(form: str) -> None:
    assert dead_centres().seed == 271828
    assert "271828" in shown(dead_centres(), form)


@pytest.mark.parametrize("form", FORMS)
def test_a_bound_that_rests_on_primes(form: str) -> None:
    found = with_locus(extent=Extent(0, 0, "modular"))
    assert "locus 1: that it is no larger rests on random primes" in shown(found, form)


# -- conditions without a list of factors --------------------------------------------------------------


def idle_input() -> Conditions:
    """L = (0, -s) for (T, A): L_I = (0) is singular everywhere, L_O = (-s) where s = 0."""
    c, s = sympy.symbols("c s")
    columns = [("T", "output"), ("A", "input")]
    return conditions(from_sympy(sympy.Matrix([[0, -s]]), columns, SymbolicSpace([c**2 + s**2 - 1])))


def test_a_condition_that_holds_everywhere_or_nowhere() -> None:
    """An open chain: with the inputs locked nothing moves, wherever it is."""
    assert remarks_of(idle_input()) == ("(4) holds in every configuration",)
    assert remarks_of(conditions(velocity_equation(load("2r")))) == ("(4) holds in no configuration",)
    assert dead_centres().remarks == ()


def test_a_condition_that_is_not_written_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same where determinants are too long: L_I = (0) has rank 0 < N = 1 at all configurations."""
    found = idle_input()
    monkeypatch.setattr(Conditions, "_determinant", lambda self, name: None)
    inputs, outputs = remarks_of(found)
    assert inputs.startswith("(4) is not written out in factors; numerically rank L_I = 0 < N = 1 at all 12 ")
    assert inputs.endswith("it seems to hold everywhere")
    assert outputs == "(5) is not written out in factors"


@pytest.mark.parametrize("form", FORMS)
def test_remarks_are_printed(form: str) -> None:
    found = replace(dead_centres(), remarks=("(4) holds in every configuration",))
    assert "(4) holds in every configuration" in shown(found, form)


# -- solution sets and strata --------------------------------------------------------------------------


def test_a_solution_set_with_an_open_dimension() -> None:
    """A piece of dimension 1 or more beside one of dimension 0, and the other way round."""
    (dead,) = solve(load("slider-crank"), "5", cache=False)
    assert not dead.undecided
    first, *others = dead.pieces
    found = replace(dead, pieces=(replace(first, extent=OPEN, points=None), *others))
    assert found.undecided
    assert found.dimension is None
    data = solution_data("", [found])["solutions"][0]
    assert (data["dimension"], data["at_least"], data["dimension_reason"]) == (None, 1, LATE)
    assert "at least 1" in plain(solution_page("", [found]))
    bounded = replace(found, pieces=(found.pieces[0], replace(first, extent=Extent(2, 2))))
    larger = replace(bounded, pieces=(*bounded.pieces[1:], replace(first, extent=Extent(1, 2, open=LATE))))
    assert (larger.dimension, larger.undecided) == (2, False)
    uncounted = replace(dead, pieces=(replace(first, points=None), *others))
    assert uncounted.undecided


def test_the_graph_claims_no_closure_that_is_not_proven() -> None:
    """A rhombus: its flat configurations have rank L < N, and whole branches of the space cross there.

    Parallelograms and antiparallelograms share them: nothing that holds on manifolds is said of these;
    the dead centres of a slider-crank are isolated points of a smooth curve.
    """
    smooth = strata_graph(dead_centres())
    assert list(smooth.edges.data("whole")) == [((1, ("By",)), (0, ()), True)]
    assert smooth.graph["undecided"] == 0
    rhombus = define(
        name="rhombus",
        inputs=["A"],
        output={"rate": "D"},
        links={"ground": {"points": {"A": [0, 0], "D": [1, 0]}}, "AB": 1, "BC": 1, "CD": 1},
        joints={"A": "R", "B": "R", "C": "R", "D": "R"},
    )
    found = strata_graph(classify(rhombus, cache=False))
    singular = [node for node, number in found.nodes.data("number") if number]
    assert singular
    assert found.graph["undecided"] > 0
    assert not [edge for edge in found.edges if edge[1] == (0, ())]


def test_the_dimension_of_a_stratum_is_said_to_be_open() -> None:
    result = dead_centres()
    first, *others = result.classes
    pieces = tuple(replace(p, extent=OPEN, points=None) for p in first.pieces)
    graph = strata_graph(replace(result, classes=(replace(first, extent=OPEN, pieces=pieces), *others)))
    (label,) = (text for node, text in graph.nodes.data("label") if node[0] == 1)
    assert label.endswith("dimension at least 1")
    assert graph.graph["undecided"] == 1
