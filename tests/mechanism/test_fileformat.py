"""Files to mechanisms and back."""

import pickle
from dataclasses import replace
from pathlib import Path

import pytest
import sympy

from singsym.mechanism import (
    JointKind,
    JointRate,
    MechanismError,
    PointVelocity,
    Twist,
    define,
    dumps,
    load,
    loads,
)
from singsym.mechanism.expressions import parse
from singsym.mechanism.library import names
from singsym.mechanism.library.starter import starter
from singsym.mechanism.writer import spell

CASES = Path(__file__).parent.parent / "cases"

FOURBAR = """
inputs = ["A"]
output = { rate = "D" }
[links]
ground = { points = { A = [0, 0], D = [4, 0] } }
AB = 1
BC = 3.5
CD = 3
[joints]
A = "R"
B = "R"
C = "R"
D = "R"
"""


@pytest.mark.parametrize("name", names())
def test_library_round_trip(name: str) -> None:
    mechanism = load(name)
    assert mechanism.name == name
    assert mechanism.source
    assert loads(dumps(mechanism), origin=mechanism.origin) == mechanism
    assert pickle.loads(pickle.dumps(mechanism)) == mechanism


def test_paper_2dof() -> None:
    # Section 3.3: N = 8, n = 2; C is one pin with three links.
    m = load("zlatanov-2dof")
    assert (m.N, m.n) == (8, 2)
    assert m.columns == ("A", "B", "C1", "C2", "D", "E", "F", "G")
    assert [(j.first, j.second) for j in m.joints if j.name in ("C1", "C2")] == [("BC", "CD"), ("CD", "CG")]
    assert m.link("CG").points["G"] == (sympy.Rational(3, 2), 0)
    assert m.outputs == (PointVelocity("CG", "G", ("x", "y")),)


def test_paper_hybrid() -> None:
    # Section 5: L is 18 x 24.
    m = load("zlatanov-hybrid")
    assert (m.N, m.n) == (18, 6)
    assert [j.kind for j in m.joints[:4]] == [JointKind.R, JointKind.R, JointKind.R, JointKind.S]
    (a,) = m.resolved.parameters
    assert (a.name, a.low, a.high) == ("a", 2 / sympy.sqrt(3), 2)
    assert [e.points for e in m.exclusions] == [("A", "A0"), ("B", "B0"), ("C", "C0")]
    fixed = m.with_parameters(a="3/2").resolved
    assert fixed.parameters == ()
    assert fixed.links == load("zlatanov-hybrid-3-2").resolved.links


def test_decimals_and_shorthand() -> None:
    m = loads(FOURBAR, "four.toml")
    assert m.name == "four"
    assert m.link("BC").points == {"B": (0, 0), "C": (sympy.Rational(7, 2), 0)}
    assert m.joint("C").at == ("C", "C")
    assert m.outputs == (JointRate("D"),)


def test_python_has_the_same_keys() -> None:
    links = {"ground": {"points": {"A": [0, 0], "D": [4, 0]}}, "AB": 1, "BC": sympy.Rational(7, 2), "CD": 3.0}
    m = define(
        name="four", inputs=["A"], output={"rate": "D"}, links=links, joints=dict.fromkeys("ABCD", "R")
    )
    assert m == replace(loads(FOURBAR, "four.toml"), origin="")


def test_triangle_by_sides() -> None:
    # Innocenti, Parenti-Castelli's platform, placed by the law of cosines.
    points = load("3rpr").link("platform").points
    distance = {
        pair: sum((x - y) ** 2 for x, y in zip(points[pair[0]], points[pair[1]], strict=True))
        for pair in (("B1", "B2"), ("B2", "B3"), ("B3", "B1"))
    }
    assert [sympy.expand(d) for d in distance.values()] == [
        sympy.Rational(s) ** 2 for s in ("17.04", "16.54", "20.84")
    ]
    assert points["B3"][1].is_positive


def test_limits_and_exclusions() -> None:
    more = """
    [limits]
    "angle(A)" = [-60, 60]
    "B.x" = { min = 0 }
    [exclusions]
    "flat" = { zero = "B.y" }
    """
    m = loads(FOURBAR + more)
    angle, coordinate = m.limits
    # |A| <= 60 degrees exactly where cos(A) >= 1/2.
    assert (angle.expression, angle.low, angle.high) == (sympy.Symbol("cos(A)"), sympy.Rational(1, 2), None)
    assert (coordinate.expression, coordinate.low) == (sympy.Symbol("B.x"), 0)
    assert m.exclusions[0].expression == sympy.Symbol("B.y")
    assert loads(dumps(m)) == m


def test_outputs_of_every_kind() -> None:
    text = FOURBAR.replace('inputs = ["A"]', 'inputs = ["A", "B", "C"]').replace(
        '{ rate = "D" }',
        """[
            { twist = "BC", at = "C", components = ["w"] },
            { velocity = "B", components = ["y"] },
            { rate = "D" },
        ]""",
    )
    assert loads(text).outputs == (
        Twist("BC", "C", ("w",)),
        PointVelocity("AB", "B", ("y",)),
        JointRate("D"),
    )


def test_circular_parameters() -> None:
    with pytest.raises(MechanismError, match="circle"):
        loads(FOURBAR + '[parameters]\na = "b"\nb = "a"\n')


@pytest.mark.parametrize("rule", ["p{0}*p{0} + p{0} + 1", "sqrt(p{0} + 1)"])
@pytest.mark.parametrize("start", ["3", "{ above = 0 }"])
def test_parameters_that_grow_without_bound(start: str, rule: str) -> None:
    lines = "".join(f'p{i} = "{rule.format(i - 1)}"\n' for i in range(1, 200))
    with pytest.raises(MechanismError, match="at most"):
        loads(FOURBAR + f"[parameters]\np0 = {start}\n{lines}")


def test_parameter_that_is_missing_or_symbolic() -> None:
    m = load("2r")
    with pytest.raises(MechanismError, match="l1, l2"):
        m.with_parameters(l3=1)
    assert [p.name for p in m.with_parameters(l1=None).resolved.parameters] == ["l1"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("inputs = [", "no TOML"),
        ('{"joints": [{"id": "A"}]}', "found JSON; expected TOML; `singsym new NAME`"),
        ("a = " + "[" * 5_000_000 + "]" * 5_000_000, "at most 1000000"),
        ("a = " + "[" * 400_000, "nested too deep"),
        ("a = " + "9" * 5000, "a number too long"),
        ("x = nan", "keys among"),
        ("inputs = 3\nspace = 4\nmobility = true", "space"),
        (FOURBAR.replace("AB = 1", "AB = nan"), "links.AB.length"),
        (FOURBAR.replace("AB = 1", "AB = 0"), "a positive length"),
        (FOURBAR.replace("AB = 1", 'AB = "1/"'), "column 3"),
        (FOURBAR.replace("AB = 1", "AB = { lenght = 1 }"), "did you mean 'length'"),
        (FOURBAR.replace("AB = 1", "crank = 1"), "two points"),
        (FOURBAR.replace("[4, 0]", "[4, 0, 0]"), "2 coordinates"),
        (FOURBAR.replace('B = "R"', 'B = "X"'), "R P H C U S E"),
        (FOURBAR.replace('B = "R"', 'Q = "R"'), "two or more links"),
        (FOURBAR.replace('{ rate = "D" }', '{ speed = "D" }'), "did you mean|one of"),
        (FOURBAR + '[limits]\n"angle(A)" = [0, 400]', "full turn"),
        (FOURBAR + '[limits]\n"cos(Q)" = [0, 1]', "Q"),
        (FOURBAR + "[parameters]\na = {}", "no value and no range"),
        (FOURBAR + "[dh]\nrows = []", "dh alone"),
    ],
)
def test_refused(text: str, said: str) -> None:
    with pytest.raises(MechanismError, match=said) as caught:
        loads(text, "four.toml")
    assert all(problem.file == "four.toml" for problem in caught.value.problems)
    assert all(len(str(problem)) < 600 for problem in caught.value.problems)


def test_all_problems_are_reported_at_once() -> None:
    text = FOURBAR.replace("AB = 1", 'AB = "1/"').replace("CD = 3", 'CD = "z"')
    with pytest.raises(MechanismError) as caught:
        loads(text)
    assert len(caught.value.problems) == 2


def test_files(tmp_path: Path) -> None:
    path = tmp_path / "four.toml"
    path.write_text(FOURBAR, encoding="utf-8")
    assert load(path).name == "four"
    path.write_bytes(b"name = \xff")
    with pytest.raises(MechanismError, match="UTF-8"):
        load(path)
    path.write_bytes(b"[" * 10_000_000)
    with pytest.raises(MechanismError, match="more than 1000000 bytes"):
        load(path)
    with pytest.raises(FileNotFoundError, match="did you mean zlatanov-2dof"):
        load("zlatanov-2-dof")
    with pytest.raises(FileNotFoundError, match="singsym list"):
        load("no-such-mechanism")


def test_starter_checks_and_its_comments_are_true() -> None:
    text = starter("mine")
    assert loads(text).name == "mine"
    for line in text.splitlines():
        assert len(line) <= 120
    with pytest.raises(ValueError, match="expected letters"):
        starter("../x")


def test_roots_of_roots_are_written_as_they_are_read() -> None:
    nested = load(CASES / "nested-root.toml")
    # The fourth root of 2 is a length of the file; what is written spells the same numbers.
    assert nested.link("BC").points["C"][0] ** 4 == 2
    assert loads(dumps(nested), origin=nested.origin) == nested
    for text in (
        "sqrt(sqrt(2))^3",
        "1/sqrt(sqrt(2/3))",
        "sqrt(sqrt(1 + sqrt(2)))^5",
        "sqrt(5 - sqrt(sqrt(3)))",
    ):
        assert parse(spell(parse(text))) == parse(text)


def test_numbers_too_long_for_floats_are_refused() -> None:
    with pytest.raises(MechanismError, match=r"D\[1\]: found a number too long to use"):
        load(CASES / "huge-integer.toml")


def test_whole_numbers_have_the_size_limit_of_expressions() -> None:
    """400 digits are more than 340 binary ones, 5000 more than Python reads; no mobility is larger than N."""
    digits = "1" * 400
    for text, words in (
        (FOURBAR.replace("AB = 1", f"AB = {digits}"), "links.AB.length: found a number too long to use"),
        (FOURBAR.replace("AB = 1", "AB = " + digits * 20), "found a number too long to use"),
        (f"mobility = {digits}\n{FOURBAR}", "expected a whole number from 1 to 1500"),
        (f'{FOURBAR}[limits]\n"cos(A)" = [-{digits}, 1]\n', "found a number too long to use"),
    ):
        with pytest.raises(MechanismError, match=words) as caught:
            loads(text)
        assert len(str(caught.value)) < 1500


def test_spaces_of_any_width_are_text_and_can_be_written_again() -> None:
    named = loads(f'title = "a\u00a0b\u2009c"\n{FOURBAR}')
    assert named.title == "a\u00a0b\u2009c"
    assert loads(dumps(named)) == named
    with pytest.raises(MechanismError, match="control character"):
        loads(f'title = "a\u202eb"\n{FOURBAR}')


@pytest.mark.parametrize("key", ["{0}", '"{0}"', "{0}.{0}", "x.'{0}'.y"])
def test_long_names_are_looked_at_once(key: str) -> None:
    """What finds keys of many parts takes steps in proportion to the text: it ends, for 60 000 letters."""
    with pytest.raises(MechanismError) as caught:
        loads(f"{key.format('a' * 60000)} = 1\n{FOURBAR}")
    assert len(str(caught.value)) < 3000
    assert len(loads(f'title = "{"a" * 60000}"\n{FOURBAR}').title) == 60000


def test_keys_of_many_parts_are_refused() -> None:
    for key in ("a." * 50 + "a", "'a.b' . " * 60 + "a", '"a" .' * 50 + "b"):
        with pytest.raises(MechanismError, match="keys of fewer than 50 parts"):
            loads(f"{key} = 1\n{FOURBAR}")


@pytest.mark.parametrize("bare", ["7/2", "sqrt(2)", "2*pi", "cos(40 deg)"])
def test_an_expression_without_quotes_gets_a_hint(bare: str) -> None:
    with pytest.raises(MechanismError) as caught:
        loads(FOURBAR.replace("AB = 1", f"AB = {bare}  # that long"))
    assert f'put expressions in quotes, as "{bare}"' in str(caught.value)
