"""The grammar against exact values worked out by hand, and against hostile text."""

from fractions import Fraction

import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from singsym.mechanism import MechanismError
from singsym.mechanism.expressions import Quantities, expression, parse

l, a = sympy.symbols("l a")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("15.91", sympy.Rational(1591, 100)),
        ("-2^2", sympy.Integer(-4)),
        ("2^-1 + 1/3", sympy.Rational(5, 6)),
        ("2*-3", sympy.Integer(-6)),
        ("1 - 2 - 3", sympy.Integer(-4)),
        ("12/2/3", sympy.Integer(2)),
        ("2^3^2", sympy.Integer(512)),
        ("sqrt(3)/2*l", sympy.sqrt(3) / 2 * l),
        ("(l + a)**2", (l + a) ** 2),
        ("sin(30 deg)", sympy.Rational(1, 2)),
        ("cos(60°)", sympy.Rational(1, 2)),
        ("cos(pi/4)", sympy.sqrt(2) / 2),
        (" 1e-3\n", sympy.Rational(1, 1000)),
    ],
)
def test_values(text: str, value: sympy.Expr) -> None:
    assert parse(text, {"l", "a"}) == value


def test_sine_of_degrees_is_the_root_of_its_polynomial() -> None:
    # Chebyshev: 64 s^6 - 96 s^4 + 36 s^2 - 3 = 0 for s = sin 40 deg.
    s = parse("sin(40 deg)")
    assert s.is_algebraic
    assert abs(sympy.N(64 * s**6 - 96 * s**4 + 36 * s**2 - 3, 40)) < 1e-30


def test_numbers_of_python() -> None:
    assert expression(Fraction(2, 3)) == sympy.Rational(2, 3)
    assert expression(0.1) == sympy.Rational(1, 10)
    assert expression(l / 2) == l / 2
    for wrong in (True, None, float("nan"), float("inf"), [1], {}):
        with pytest.raises(MechanismError):
            expression(wrong)


@pytest.mark.parametrize(
    "text",
    [
        "", "2*", "1 2", ")", "(1", "NaN", "inf", "α", "٣", "x", "__import__('os')", "1/0", "0^-1",
        "sqrt(-1)", "1/(sqrt(2)*sqrt(3) - sqrt(6))", "sin(1)", "tan(pi)", "9^9^9", "1e400",
        "1e-99999999999", "((l+1)^64)^64", "(2^64)^64^2", "l^(1/2)", "(" * 500 + "1", "(" * 5_000_000,
        "2^" * 900 + "2", "[1]", "l.x", "\0", "sin", "9" * 101,
    ],
)  # fmt: skip
def test_refused_with_place_and_column(text: str) -> None:
    with pytest.raises(MechanismError) as caught:
        parse(text, {"l"}, place="links.AB.length", file="four.toml")
    (problem,) = caught.value.problems
    assert problem.file == "four.toml"
    assert problem.place.startswith("links.AB.length, column ")
    assert problem.found
    assert problem.expected
    assert len(str(problem)) < 400


def test_column_is_that_of_the_fault() -> None:
    with pytest.raises(MechanismError, match=r"column 5: found the unknown name 'b'"):
        parse("2 * b", {"l"})


def test_quantities() -> None:
    known = Quantities(angles={"A", "U.angle1"}, slides={"P"}, points={"B"}, coordinates=("x", "y"))
    read = parse("cos(A)*B.x + length(P)^2 - sin(U.angle1) + cos(pi/3)", {"l"}, quantities=known)
    symbol = sympy.Symbol
    assert read == symbol("cos(A)") * symbol("B.x") + symbol("length(P)") ** 2 - symbol(
        "sin(U.angle1)"
    ) + sympy.Rational(1, 2)
    for wrong in ("B.z", "length(A)", "angle(P)", "cos(P)"):
        with pytest.raises(MechanismError):
            parse(wrong, {"l"}, quantities=known)


def read_or_refuse(text: str) -> None:
    """Nothing but `MechanismError` may come out, or an expression."""
    try:
        value = parse(text, {"l"})
    except MechanismError:
        return
    assert isinstance(value, sympy.Expr)


@given(st.text(max_size=40))
def test_any_text_is_read_or_refused(text: str) -> None:
    read_or_refuse(text)


@given(st.text(alphabet="0123456789.+-*/^()l eE", max_size=25))
def test_arithmetic_text_is_read_or_refused(text: str) -> None:
    read_or_refuse(text)


@given(st.integers(-(10**6), 10**6), st.integers(0, 6))
def test_decimals_are_exact(mantissa: int, places: int) -> None:
    text = f"{mantissa / 10**places:.{places}f}"
    assert expression(parse(text)) == sympy.Rational(text)
