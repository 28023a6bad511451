"""What every part of a mechanism file's reader needs: typed access that collects problems.

Source: singsym's own; TOML is https://toml.io.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from difflib import get_close_matches
from itertools import product
from numbers import Number
from typing import Any
from unicodedata import category

import sympy

from singsym.mechanism.expressions import RESERVED, DecimalText, expression, is_angle
from singsym.mechanism.model import Parameter, Space, Vector
from singsym.mechanism.problems import MechanismError, Problem, shorten

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")

LONGEST_NAME = 60
"""Letters in a name of a link, joint, point, axis or parameter."""
NOT_ALGEBRAIC = "a number made of rationals, roots and sin, cos of rational multiples of pi"


def kind_of(value: Any) -> str:
    """A value with the name of its TOML type, for messages."""
    if value is None:
        return "nothing"
    kinds: tuple[tuple[type, str], ...] = (
        (bool, "boolean"),
        (DecimalText, "number"),
        (str, "text"),
        (Mapping, "table"),
        (Sequence, "list"),
        (Number, "number"),
    )
    kind = next((name for kind, name in kinds if isinstance(value, kind)), type(value).__name__)
    return f"the {kind} {shorten(value)!r}" if kind == "text" else f"the {kind} {shorten(value)}"


def _is_text(character: str) -> bool:
    """Whether a character is no control character: printable, a line's end, a tab, a space of any width."""
    return character.isprintable() or character in "\n\r\t" or category(character) == "Zs"


class Reader:
    """Reads values of a file and keeps every problem met, so that one run reports them all."""

    def __init__(self, file: str = "") -> None:
        self.file = file
        self.problems: list[Problem] = []
        self.parameters: frozenset[str] = frozenset()
        self.ranges: tuple[Parameter, ...] = ()
        self.space = Space.PLANAR

    def report(self, place: str, found: str, expected: str, advice: str = "") -> None:
        """Note a problem at a place of the file."""
        self.problems.append(Problem(place, found, expected, advice, self.file))

    @property
    def size(self) -> int:
        """The number of coordinates of a point."""
        return 2 if self.space is Space.PLANAR else 3

    def table(
        self, value: Any, place: str, keys: Collection[str] | None = None, expected: str = "a table"
    ) -> dict[str, Any]:
        """A table, with no other keys than these where they are given."""
        if not isinstance(value, Mapping):
            self.report(place, kind_of(value), expected)
            return {}
        if keys is not None:
            for key in value:
                if key not in keys:
                    close = get_close_matches(str(key), keys, 1)
                    advice = f"did you mean {close[0]!r}?" if close else ""
                    self.report(place, f"the key {shorten(key)!r}", f"keys among {', '.join(keys)}", advice)
        return {str(k): v for k, v in value.items()}

    def unused(self, given: Collection[str], keys: Collection[str], place: str, by: str) -> None:
        """Report those keys that are given where nothing uses them."""
        for key in keys:
            if key in given:
                self.report(f"{place}.{key}", f"the key {key!r}", f"no such key with {by}", "leave it out")

    def text(self, value: Any, place: str) -> str:
        """Printable text; anything else is a problem."""
        if isinstance(value, str) and all(map(_is_text, value)):
            return str(value)
        found = f"a control character in {shorten(value)!r}" if isinstance(value, str) else kind_of(value)
        self.report(place, found, "text in quotes")
        return ""

    def name(self, value: Any, place: str) -> str:
        """A name of a link, joint, point, axis or parameter."""
        text = self.text(value, place)
        if isinstance(value, str) and (
            not _NAME.fullmatch(text) or text in RESERVED or len(text) > LONGEST_NAME
        ):
            expected = "a name of letters, digits and _, starting with a letter, other than "
            self.report(place, f"the name {shorten(text)!r}", expected + ", ".join(RESERVED))
        return text

    def items(self, value: Any, place: str) -> list[Any]:
        """A list; anything else is a problem, and empty."""
        if isinstance(value, (list, tuple)):
            return list(value)
        self.report(place, kind_of(value), "a list in square brackets")
        return []

    def texts(self, value: Any, place: str) -> list[str]:
        """A list of texts."""
        return [self.text(v, f"{place}[{i}]") for i, v in enumerate(self.items(value, place))]

    def names(self, value: Any, place: str) -> list[str]:
        """A list of names."""
        return [self.name(v, f"{place}[{i}]") for i, v in enumerate(self.items(value, place))]

    def expression(self, value: Any, place: str) -> sympy.Expr:
        """An expression in the parameters; a symbol that passes all later tests where it cannot be read."""
        try:
            return expression(value, self.parameters, place=place, file=self.file)
        except MechanismError as error:
            self.problems.extend(error.problems)
            return sympy.Symbol("unreadable")

    def length(self, value: Any, place: str) -> sympy.Expr:
        """An expression that is positive for all values of the parameters in their ranges."""
        read = self.expression(value, place)
        values = {sympy.Symbol(p.name): p.value for p in self.ranges if p.value is not None}
        settled = read
        for _ in values:
            settled = settled.xreplace(values)
        if settled.is_number:
            if not settled.is_positive:
                found = str(read) if read == settled else f"{read} = {settled}"
                self.report(place, found, "a positive length")
        elif negative := next((c for c in self._corners(settled) if settled.xreplace(c).is_negative), None):
            where = ", ".join(f"{name} near {end}" for name, end in negative.items())
            advice = f"narrow the range of {', '.join(map(str, negative))}"
            self.report(place, f"{read}, negative for {where}", "a positive length", advice)
        return read

    def _corners(self, value: sympy.Expr) -> Iterator[dict[sympy.Symbol, sympy.Expr]]:
        """Ends of the ranges of a few parameters in an expression, far numbers where a range has no end."""
        named = {sympy.Symbol(p.name): p for p in self.ranges}
        symbols = sorted(value.free_symbols, key=str)
        if len(symbols) > 6 or not all(s in named for s in symbols):
            return
        far = sympy.Integer(10) ** 9
        lows = [-far if (low := named[s].low) is None else low for s in symbols]
        highs = [far if (high := named[s].high) is None else high for s in symbols]
        if all(end.is_number for end in (*lows, *highs)):
            yield from (
                dict(zip(symbols, corner, strict=True)) for corner in product(*zip(lows, highs, strict=True))
            )

    def angle(self, value: Any, place: str) -> sympy.Expr:
        """An angle in radians: a rational multiple of pi, or a bare rational, which is in degrees."""
        read = self.expression(value, place)
        if read.is_Rational:
            read = read * sympy.pi / 180
        if read.is_number and not is_angle(read):
            self.report(place, shorten(value), "an angle such as 40 deg, pi/6 or 40 (degrees)")
            return sympy.Integer(0)
        return read

    def vector(self, value: Any, place: str) -> Vector:
        """Coordinates: a list of two (planar) or three expressions."""
        if not isinstance(value, (list, tuple)) or len(value) != self.size:
            wanted = "[x, y]" if self.size == 2 else "[x, y, z]"
            self.report(
                place, kind_of(value), f"{self.size} coordinates {wanted} in a {self.space} mechanism"
            )
            return (sympy.Integer(0),) * self.size
        return tuple(self.expression(v, f"{place}[{i}]") for i, v in enumerate(value))

    def vectors(self, value: Any, place: str) -> dict[str, Vector]:
        """Named points or axes."""
        named = self.table(value, place)
        return {self.name(k, place): self.vector(v, f"{place}.{k}") for k, v in named.items()}
