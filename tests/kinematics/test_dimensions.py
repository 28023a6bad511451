"""Numbers of a mechanism in its ring: every image must have the value of what it stands for."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.kinematics.dimensions import Dimensions, VariableNames, dimensions
from singsym.mechanism import load
from singsym.mechanism.model import Parameter
from singsym.polynomials import Ring

PI = sympy.pi


def value(polynomial: object, ring: Ring, places: int = 40) -> sympy.Expr:
    """The value of a polynomial in constants, to many places and by SymPy's own roots."""
    return sympy.N(polynomial.to_sympy(), places)  # type: ignore[arg-type]


def images(*numbers: sympy.Expr) -> tuple[tuple[str, ...], list[sympy.Expr]]:
    """The names of the constants that these numbers bring, and the errors of their images."""
    found = Dimensions.of_expressions(numbers)
    ring = found.base
    errors = [abs(value(found.polynomial(ring, n), ring) - sympy.N(n, 40)) for n in numbers]
    return tuple(c.name for c in found.constants), errors


@pytest.mark.parametrize(
    ("numbers", "names"),
    [
        ([sympy.sqrt(6)], ("sqrt6",)),
        ([sympy.sqrt(n) for n in (2, 3, 6)], ("sqrt2", "sqrt3")),
        ([sympy.sqrt(n) for n in (6, 10, 15)], ("sqrt6", "sqrt10")),
        ([sympy.sqrt(sympy.Rational(8, 3)), sympy.sqrt(54)], ("sqrt6",)),
        ([sympy.cos(2 * PI / 9)], ("cos40deg",)),
        ([sympy.cos(2 * PI / 9), sympy.sin(2 * PI / 9), sympy.sqrt(3)], ("cos10deg",)),
        ([sympy.sin(2 * PI / 9), sympy.cos(5 * PI / 12), sympy.sqrt(2)], ("cos10deg", "sqrt2")),
        ([sympy.cos(PI / 7), sympy.sqrt(7)], ("cos2pi14", "sqrt7")),
        ([sympy.tan(PI / 9)], ("cos10deg",)),
        ([1 / (1 + sympy.sqrt(2)), 1 / sympy.sqrt(5)], ("sqrt2", "sqrt5")),
        ([sympy.sqrt(2 + sympy.sqrt(2))], ("theta",)),
        ([sympy.cbrt(2), sympy.sqrt(3)], ("theta",)),
    ],
)
def test_few_generators_and_right_values(numbers: list[sympy.Expr], names: tuple[str, ...]) -> None:
    found, errors = images(*numbers)
    assert found == names
    assert max(errors) < sympy.Float("1e-35")


@given(st.lists(st.integers(1, 60), min_size=1, max_size=4), st.integers(1, 3))
@settings(max_examples=30, deadline=None)
def test_square_roots_multiply_as_numbers_do(radicands: list[int], power: int) -> None:
    expression = sympy.Add(*(sympy.sqrt(n) for n in radicands)) ** power
    found = Dimensions.of_expressions([expression])
    image = found.polynomial(found.base, expression)
    assert found.is_zero(expression - sympy.expand(expression))
    assert abs(value(image, found.base) - sympy.N(expression, 40)) < sympy.Float("1e-30")
    assert max(image.degrees, default=0) <= 1


def test_constants_are_isolated() -> None:
    for constant in Dimensions.of_expressions([sympy.cos(2 * PI / 36), sympy.sqrt(2)]).constants:
        roots = [
            r
            for r in sympy.Poly(list(reversed(constant.minimal)), sympy.Symbol("x")).real_roots()
            if constant.low < Fraction(str(sympy.N(r, 30))) < constant.high
        ]
        assert len(roots) == 1


def test_fixed_parameters_go_and_ranges_stay() -> None:
    a, b, l = sympy.symbols("a b l")
    found = Dimensions.of_expressions(
        [2 * l / sympy.sqrt(3), b],
        [Parameter("l", sympy.Integer(3)), Parameter("b", 2 * l), Parameter("a", None, l, 2 * b)],
    )
    ring = found.ring(("x",))
    assert ring.names == ("x", "a", "sqrt3")
    assert found.polynomial(ring, b) == 6
    assert found.positive(ring) == (ring.gen("a") - 3, 12 - ring.gen("a"))
    assert found.polynomial(ring, 2 * l / sympy.sqrt(3)) == ring.gen("sqrt3") * 2
    assert found.is_positive(a)
    assert not found.is_positive(a - 4)


def test_roots_and_inverses_of_parameters_get_names() -> None:
    a = sympy.Symbol("a")
    found = Dimensions.of_expressions([1 / sympy.sqrt(a**2 - 1)], [Parameter("a", None, sympy.Integer(1))])
    ring = found.ring(())
    assert found.parameters == ("a", "root1", "inverse1")
    A, root, inverse = ring.gens
    assert found.relations(ring) == (root**2 - A**2 + 1, inverse * root - 1)
    assert found.polynomial(ring, 1 / sympy.sqrt(a**2 - 1)) == inverse
    assert found.nonnegative(ring) == (root,)


def test_what_is_refused() -> None:
    with pytest.raises(ValueError, match="not exact"):
        Dimensions.of_expressions([sympy.Float(0.1)])
    with pytest.raises(ValueError, match="not built from"):
        Dimensions.of_expressions([sympy.exp(1)])
    with pytest.raises(ValueError, match="not real"):
        Dimensions.of_expressions([sympy.sqrt(-2, evaluate=False)])
    a, b = sympy.symbols("a b")
    with pytest.raises(ValueError, match="circle"):
        Dimensions.of_expressions([], [Parameter("a", b), Parameter("b", a)])
    found = Dimensions.of_expressions([])
    with pytest.raises(ValueError, match="neither a parameter"):
        found.polynomial(found.base, sympy.Symbol("z"))
    with pytest.raises(ValueError, match="used twice"):
        Dimensions.of_expressions([sympy.sqrt(2)]).ring(("sqrt2",))


def test_names_differ_from_those_of_the_dimensions() -> None:
    assert dimensions(load("2r"), ("x",)).ring.names[0] == "x"
    names = VariableNames({"Bx"})
    assert [names.new("Bx"), names.new("1")] == ["Bx_", "v1"]
