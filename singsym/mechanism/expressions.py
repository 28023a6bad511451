"""The small grammar of a mechanism file's expressions, to exact SymPy expressions.

Source: singsym's own grammar; exact numbers by SymPy (https://docs.sympy.org).

    sum     = product (("+" | "-") product)*
    product = signed (("*" | "/") signed)*
    signed  = ("+" | "-") signed | power
    power   = atom [("^" | "**") signed]            the exponent a whole number
    atom    = (number | name | pi | "(" sum ")" | ("sqrt" | "sin" | "cos") "(" sum ")") ["deg" | "°"]

In limits and exclusions also coordinates `A.x` of points, and cos(A), sin(A), angle(A), length(P) of joints.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from fractions import Fraction
from numbers import Rational
from typing import Any

import sympy

from singsym.mechanism.problems import MechanismError, Problem, shorten

MAX_LENGTH = 2000
MAX_DEPTH = 30
MAX_EXPONENT = 64
MAX_BITS = 340
"""Numbers of 100 digits; their cubes are still floats."""
LONG_NUMBER = "a number too long to use", f"at most {MAX_BITS} binary digits"
FUNCTIONS = ("sqrt", "sin", "cos")
RESERVED = (*FUNCTIONS, "angle", "length", "pi", "deg")

_TOKEN = re.compile(
    r"[ \t\r\n]*(?:(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z0-9_]*(?:\.[A-Za-z][A-Za-z0-9_]*)?)"
    r"|(?P<operator>\*\*|[-+*/^()°]))"
)


class DecimalText(str):
    """A decimal as a file spells it, kept as text so that no digit is lost."""


@dataclass(frozen=True)
class Quantities:
    """What an expression may speak of beyond parameters: joint freedoms, and coordinates of points."""

    angles: Collection[str] = ()
    slides: Collection[str] = ()
    points: Collection[str] = ()
    coordinates: tuple[str, ...] = ("x", "y", "z")


def decimal(text: str) -> sympy.Rational:
    """The exact rational that a decimal spells; raises `ValueError` beyond 100 digits or e+-100.

    >>> decimal("15.91"), decimal("1.5e-3")
    (1591/100, 3/2000)
    """
    digits, _, exponent = text.lower().partition("e")
    if len(digits) > 100 or len(exponent) > 4 or abs(int(exponent or 0)) > 100:
        raise ValueError(f"the number {shorten(text)} is out of range")
    value = Fraction(text)
    return sympy.Rational(value.numerator, value.denominator)


def parse(
    text: str,
    names: Collection[str] = (),
    *,
    quantities: Quantities | None = None,
    place: str = "",
    file: str = "",
) -> sympy.Expr:
    """The exact expression that `text` spells, in the given names of parameters.

    Raises `MechanismError` with the place, the column, what was found and what was expected.

    >>> parse("2/sqrt(3)*l + 0.25", {"l"})
    2*sqrt(3)*l/3 + 1/4
    >>> parse("sin(40 deg)^2 + cos(40 deg)^2 - cos(pi/3)")
    -1/2 + sin(2*pi/9)**2 + cos(2*pi/9)**2
    """
    return _Parser(text, names, quantities, place, file).read()


def expression(value: Any, names: Collection[str] = (), *, place: str = "", file: str = "") -> sympy.Expr:
    """A dimension given as a number, a Fraction, text in the grammar or a SymPy expression.

    A Python float, like a decimal in a file, is the exact rational that it is printed as.

    >>> expression(0.1), expression(Fraction(2, 3)), expression("3/2")
    (1/10, 2/3, 3/2)
    """
    expected = "a number, or text such as 3/2, sqrt(3)/2 or 2*l"
    if isinstance(value, sympy.Expr):
        return value
    if isinstance(value, bool) or not isinstance(value, (str, Rational, float)):
        kind = {"bool": "true or false", "list": "a list", "dict": "a table"}.get(type(value).__name__)
        raise MechanismError([Problem(place, kind or shorten(value), expected, file=file)])
    if isinstance(value, str) and not isinstance(value, DecimalText):
        return parse(value, names, place=place, file=file)
    if isinstance(value, Rational):
        number = sympy.Rational(int(value.numerator), int(value.denominator))
        if fault := oversize(number):
            raise MechanismError([Problem(place, *fault, file=file)])
        return number
    try:
        return decimal(str(value).replace("_", ""))
    except ValueError:
        raise MechanismError([Problem(place, shorten(value), expected, file=file)]) from None


def is_angle(value: sympy.Expr) -> bool:
    """Whether a number is a rational multiple of pi, of denominator at most 360."""
    ratio = value / sympy.pi
    return bool(ratio.is_Rational) and ratio.q <= 360


def oversize(value: sympy.Expr) -> tuple[str, str] | None:
    """What is too large in an expression for exact work, and the bound; None where nothing is.

    >>> oversize(sympy.Integer(2) ** 500)
    ('a number too long to use', 'at most 340 binary digits')
    """
    if _depth(value) > 2 * MAX_DEPTH:
        return "nesting too deep", f"at most {2 * MAX_DEPTH} levels"
    rationals = value.atoms(sympy.Rational)
    if any(max(abs(int(r.p)).bit_length(), int(r.q).bit_length()) > MAX_BITS for r in rationals):
        return LONG_NUMBER
    if _degree(value) > MAX_EXPONENT:
        return f"a power of degree {_degree(value)}", f"at most {MAX_EXPONENT}"
    if value.count_ops() > MAX_LENGTH:
        return f"an expression of {value.count_ops()} operations", f"at most {MAX_LENGTH}"
    return None


class _Parser:
    """Recursive descent over the tokens of one expression."""

    def __init__(
        self, text: str, names: Collection[str], quantities: Quantities | None, place: str, file: str
    ) -> None:
        self.text, self.names, self.quantities = text, names, quantities
        self.place, self.file = place, file
        self.tokens: list[tuple[str, str, int]] = []
        self.next = 0
        self.depth = 0

    def fail(self, column: int, found: str, expected: str, advice: str = "") -> MechanismError:
        where = f"{self.place}, column {column + 1}" if self.place else f"column {column + 1}"
        quoted = f"{found} in {shorten(self.text)!r}"
        return MechanismError([Problem(where, quoted, expected, advice, self.file)])

    def read(self) -> sympy.Expr:
        if len(self.text) > MAX_LENGTH:
            found = f"{len(self.text)} characters"
            raise self.fail(0, found, f"at most {MAX_LENGTH}", "name its parts as parameters")
        position = 0
        end = len(self.text.rstrip(" \t\r\n"))
        while position < end:
            match = _TOKEN.match(self.text, position)
            if match is None:
                position += len(self.text[position:end]) - len(self.text[position:end].lstrip(" \t\r\n"))
                expected = "a number, a name, + - * / ^ ( ) or deg"
                raise self.fail(position, repr(self.text[position]), expected)
            kind = str(match.lastgroup)
            self.tokens.append((kind, match[kind], match.start(kind)))
            position = match.end()
        value = self.sum()
        if self.next < len(self.tokens):
            raise self.fail(self.column, repr(self.peek), "an operator or the end")
        return value

    @property
    def peek(self) -> str:
        return self.tokens[self.next][1] if self.next < len(self.tokens) else ""

    @property
    def column(self) -> int:
        return self.tokens[self.next][2] if self.next < len(self.tokens) else len(self.text)

    def take(self, *operators: str) -> str:
        """The next token if it is one of these, else nothing."""
        token = self.peek
        if token and token in operators:
            self.next += 1
            return token
        return ""

    def expect(self, operator: str) -> None:
        if not self.take(operator):
            raise self.fail(self.column, repr(self.peek) if self.peek else "the end", repr(operator))

    def checked(self, value: sympy.Expr, column: int) -> sympy.Expr:
        """The value, if it is real and of sensible size."""
        if value.has(sympy.zoo, sympy.nan, sympy.oo) or (value.is_number and value.is_real is False):
            raise self.fail(column, f"the value {value}", "a real number")
        if fault := oversize(value):
            raise self.fail(column, *fault)
        return value

    def sum(self) -> sympy.Expr:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self.fail(self.column, "nesting too deep", f"at most {MAX_DEPTH} levels")
        value = self.product()
        while operator := self.take("+", "-"):
            right = self.product()
            value = value + right if operator == "+" else value - right
        self.depth -= 1
        return value

    def product(self) -> sympy.Expr:
        value = self.signed()
        while operator := self.take("*", "/"):
            column = self.column
            right = self.signed()
            if operator == "/":
                if right.is_zero or (right.is_number and abs(sympy.N(right, 60)) < 1e-40):
                    raise self.fail(column, "a divisor that is zero", "a divisor other than zero")
                right = 1 / right
            value = self.checked(value * right, column)
        return value

    def signed(self) -> sympy.Expr:
        signs = 0
        while operator := self.take("+", "-"):
            signs += operator == "-"
        value = self.power()
        return -value if signs % 2 else value

    def power(self) -> sympy.Expr:
        column = self.column
        base = self.atom()
        if not self.take("^", "**"):
            return base
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self.fail(column, "nesting too deep", f"at most {MAX_DEPTH} levels")
        place = self.column
        exponent = self.signed()
        self.depth -= 1
        if not exponent.is_Integer or abs(exponent) > MAX_EXPONENT:
            advice = "for a root write sqrt(...)"
            raise self.fail(place, "this exponent", f"a whole number up to {MAX_EXPONENT}", advice)
        if base.is_zero and exponent < 0:
            raise self.fail(column, "a negative power of zero", "a base other than zero")
        return self.checked(base**exponent, column)

    def atom(self) -> sympy.Expr:
        column = self.column
        if self.take("("):
            value = self.sum()
            self.expect(")")
        elif self.next == len(self.tokens):
            raise self.fail(column, "the end", "a number, a name or '('")
        else:
            kind, token, _ = self.tokens[self.next]
            if kind == "operator":
                raise self.fail(column, repr(token), "a number, a name or '('")
            self.next += 1
            value = self.number(token, column) if kind == "number" else self.named(token, column)
        while self.take("deg", "°"):
            value = value * sympy.pi / 180
        return value

    def number(self, token: str, column: int) -> sympy.Expr:
        try:
            return decimal(token)
        except ValueError as error:
            raise self.fail(column, str(error), "at most 100 digits and exponents to 100") from None

    def named(self, token: str, column: int) -> sympy.Expr:
        if self.peek == "(":
            return self.function(token, column)
        if token == "pi":
            return sympy.pi
        if token in self.names:
            return sympy.Symbol(token)
        point, _, coordinate = token.partition(".")
        if self.quantities is not None and point in self.quantities.points:
            if coordinate in self.quantities.coordinates:
                return sympy.Symbol(token)
            wanted = " or ".join(f"{point}.{c}" for c in self.quantities.coordinates)
            raise self.fail(column, repr(token), wanted)
        known = ", ".join(sorted(self.names)) or "there are none"
        advice = f"write [parameters] {token} = ..." if "." not in token else ""
        raise self.fail(column, f"the unknown name {token!r}", f"a parameter ({known})", advice)

    def function(self, token: str, column: int) -> sympy.Expr:
        joint = self.joint_quantity(token)
        if joint is not None:
            return joint
        if token not in FUNCTIONS:
            raise self.fail(column, f"the function {token!r}", "sqrt, sin or cos")
        self.expect("(")
        argument = self.sum()
        self.expect(")")
        if token == "sqrt":
            return self.checked(sympy.sqrt(argument), column)
        if argument.is_number and not is_angle(argument):
            advice = "write degrees as 40 deg"
            raise self.fail(column, f"{token} of {shorten(argument)}", "a rational multiple of pi", advice)
        return sympy.sin(argument) if token == "sin" else sympy.cos(argument)

    def joint_quantity(self, token: str) -> sympy.Expr | None:
        """cos(A), sin(A), angle(A), length(P) as a symbol, where A is a freedom of a joint."""
        if self.quantities is None or token not in ("cos", "sin", "angle", "length"):
            return None
        known = self.quantities.slides if token == "length" else self.quantities.angles
        inside = [t for _, t, _ in self.tokens[self.next : self.next + 3]]
        if len(inside) == 3 and inside[1] in known and inside[2] == ")":
            self.next += 3
            return sympy.Symbol(f"{token}({inside[1]})")
        if token in ("angle", "length"):
            wanted = ", ".join(sorted(known)) or "there is none"
            kind = "a slide" if token == "length" else "an angle"
            self.next += 1
            raise self.fail(self.column, repr(self.peek), f"a joint freedom that is {kind}: {wanted}")
        return None


def _depth(value: sympy.Basic) -> int:
    return 1 + max((_depth(a) for a in value.args), default=0)


def _degree(value: sympy.Expr) -> int:
    """A bound on the total degree in all names, without expanding."""
    if value.is_Symbol:
        return 1
    if value.is_Pow and value.exp.is_Integer:
        return _degree(value.base) * abs(int(value.exp))
    degrees = [_degree(a) for a in value.args if isinstance(a, sympy.Expr)]
    if value.is_Mul:
        return sum(degrees)
    return max(degrees, default=0)
