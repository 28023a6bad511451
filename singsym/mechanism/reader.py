"""What every part of a mechanism file's reader needs: typed access that collects problems.

Source: singsym's own; TOML is https://toml.io.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from difflib import get_close_matches
from typing import Any

import sympy

from singsym.mechanism.expressions import RESERVED, expression, is_angle
from singsym.mechanism.model import Space, Vector
from singsym.mechanism.problems import MechanismError, Problem, shorten

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")

NOT_ALGEBRAIC = "a number made of rationals, roots and sin, cos of rational multiples of pi"


def kind_of(value: Any) -> str:
    """A value with the name of its TOML type, for messages."""
    kinds = ((bool, "boolean"), (Mapping, "table"), (str, "text"), (Sequence, "list"))
    kind = next((name for kind, name in kinds if isinstance(value, kind)), "number")
    return f"the {kind} {shorten(value)!r}" if kind == "text" else f"the {kind} {shorten(value)}"


class Reader:
    """Reads values of a file and keeps every problem met, so that one run reports them all."""

    def __init__(self, file: str = "") -> None:
        self.file = file
        self.problems: list[Problem] = []
        self.parameters: frozenset[str] = frozenset()
        self.space = Space.PLANAR

    def report(self, place: str, found: str, expected: str, advice: str = "") -> None:
        self.problems.append(Problem(place, found, expected, advice, self.file))

    @property
    def size(self) -> int:
        """The number of coordinates of a point."""
        return 2 if self.space is Space.PLANAR else 3

    def table(self, value: Any, place: str, keys: Collection[str] | None = None) -> dict[str, Any]:
        """A table, with no other keys than these where they are given."""
        if not isinstance(value, Mapping):
            self.report(place, kind_of(value), "a table")
            return {}
        if keys is not None:
            for key in value:
                if key not in keys:
                    close = get_close_matches(str(key), keys, 1)
                    advice = f"did you mean {close[0]!r}?" if close else ""
                    self.report(place, f"the key {shorten(key)!r}", f"keys among {', '.join(keys)}", advice)
        return {str(k): v for k, v in value.items()}

    def text(self, value: Any, place: str) -> str:
        if isinstance(value, str):
            return str(value)
        self.report(place, kind_of(value), "text in quotes")
        return ""

    def name(self, value: Any, place: str) -> str:
        """A name of a link, joint, point, axis or parameter."""
        text = self.text(value, place)
        if isinstance(value, str) and (not _NAME.fullmatch(text) or text in RESERVED or len(text) > 60):
            expected = "a name of letters, digits and _, starting with a letter, other than "
            self.report(place, f"the name {shorten(text)!r}", expected + ", ".join(RESERVED))
        return text

    def items(self, value: Any, place: str) -> list[Any]:
        if isinstance(value, (list, tuple)):
            return list(value)
        self.report(place, kind_of(value), "a list in square brackets")
        return []

    def texts(self, value: Any, place: str) -> list[str]:
        return [self.text(v, f"{place}[{i}]") for i, v in enumerate(self.items(value, place))]

    def names(self, value: Any, place: str) -> list[str]:
        return [self.name(v, f"{place}[{i}]") for i, v in enumerate(self.items(value, place))]

    def expression(self, value: Any, place: str) -> sympy.Expr:
        """An expression in the parameters; a symbol that passes all later tests where it cannot be read."""
        try:
            return expression(value, self.parameters, place=place, file=self.file)
        except MechanismError as error:
            self.problems.extend(error.problems)
            return sympy.Symbol("unreadable")

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
