"""What is given of a configuration: joint values, points, variables.

Source: singsym's own format, in TOML (https://toml.io).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import sympy

from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.fileformat import read_text, tables
from singsym.mechanism.problems import MechanismError, Problem
from singsym.mechanism.reader import Reader
from singsym.polynomials import Polynomial

DOUBLE_DIGITS = 16
"""What is written with at most one digit more is taken as a double."""


@dataclass(frozen=True)
class Given:
    """Values by column label (angles in radians), by point (None: coordinate not given), by variable."""

    joints: Mapping[str, sympy.Expr] = field(default_factory=dict)
    points: Mapping[str, tuple[sympy.Expr | None, ...]] = field(default_factory=dict)
    variables: Mapping[str, sympy.Expr] = field(default_factory=dict)

    @classmethod
    def from_toml(cls, text: str, file: str = "") -> Given:
        """From the tables `joints`, `points`, `variables` of a file; raises `MechanismError`.

        Numbers and text as in mechanism files; angles such as "30 deg" or "pi/6", a bare number in radians.

        >>> Given.from_toml('[joints]\\nA = "30 deg"').joints
        {'A': pi/6}
        """
        return cls.of(tables(text, file), file)

    @classmethod
    def from_file(cls, path: str | Path) -> Given:
        """The same from a file; raises `MechanismError`, and `OSError` where it is not there."""
        return cls.from_toml(read_text(path), str(path))

    @classmethod
    def of(cls, data: Mapping[str, Any], file: str = "") -> Given:
        """The same from a dict of the three tables."""
        reader = Reader(file)
        read = reader.table(data, "file", ("joints", "points", "variables"))
        joints = reader.table(read.get("joints", {}), "joints")
        points = reader.table(read.get("points", {}), "points")
        variables = reader.table(read.get("variables", {}), "variables")
        found = cls(
            {k: reader.expression(v, f"joints.{k}") for k, v in joints.items()},
            {
                k: tuple(reader.expression(x, f"points.{k}") for x in reader.items(v, f"points.{k}"))
                for k, v in points.items()
            },
            {k: reader.expression(v, f"variables.{k}") for k, v in variables.items()},
        )
        if not (joints or points or variables):
            reader.report("file", "no values", "values in [joints], [points] or [variables]")
        if reader.problems:
            raise MechanismError(reader.problems)
        return found

    @property
    def digits(self) -> int:
        """To how many digits the configuration is given: the fewest of values with more than a double's.

        Numbers with fewer digits may be meant exactly, as 0.3 or 1/2 are.

        >>> Given.of({"joints": {"A": "0.3", "B": "1.14159265358979323846264338328"}}).digits
        30
        """
        points = (x for place in self.points.values() for x in place if x is not None)
        values = (*self.joints.values(), *points, *self.variables.values())
        written = [_digits(number) for value in values for number in value.atoms(sympy.Rational)]
        return min((d for d in written if d > DOUBLE_DIGITS + 1), default=DOUBLE_DIGITS)


def _digits(number: sympy.Rational) -> int:
    """The significant digits of a number, or of as many degrees; 0 for a fraction that is no decimal."""
    if number.q % 3 == 0:
        number = number * 180
    below, places = int(number.q), 0
    for prime in (2, 5):
        power = 0
        while below % prime == 0:
            below, power = below // prime, power + 1
        places = max(places, power)
    return len(str(abs(int(number * 10**places))).strip("0")) if below == 1 else 0


@dataclass(frozen=True)
class Target:
    """That polynomial = value * scale."""

    label: str
    polynomial: Polynomial
    scale: Polynomial
    value: sympy.Expr


def targets(given: Given, equation: VelocityEquation, file: str = "") -> tuple[Target, ...]:
    """What is given, as equations in the variables; raises `MechanismError` for unknown names."""
    space = equation.space
    one = space.ring.one
    found: list[Target] = []
    problems: list[Problem] = []

    def unknown(place: str, name: str, known: Sequence[str]) -> None:
        problems.append(Problem(place, name, f"one of {', '.join(known) or 'none'}", file=file))

    for name, value in given.variables.items():
        if name in space.ring.names:
            found.append(Target(name, space.ring.gen(name), one, value))
        else:
            unknown("variables", name, (*space.variables, *space.parameters))
    for name, place in given.points.items():
        coordinates = space.points.get(name, ())
        if len(place) != len(coordinates):
            if coordinates:
                expected = f"{len(coordinates)} coordinates"
                problems.append(Problem(f"points.{name}", f"{len(place)}", expected, file=file))
            else:
                unknown("points", name, tuple(space.points))
            continue
        for axis, p, v in zip("xyz", coordinates, place, strict=False):
            if v is not None:
                found.append(Target(f"{name}.{axis}", p, one, v))
    for name, value in given.joints.items():
        if name in equation.values:
            found += _joint_targets(name, equation, value)
        else:
            unknown("joints", name, tuple(equation.values))
    if problems:
        raise MechanismError(problems)
    return tuple(found)


def _joint_targets(name: str, equation: VelocityEquation, value: sympy.Expr) -> Iterator[Target]:
    joint, one = equation.values[name], equation.space.ring.one
    if joint.length is not None:
        yield Target(name, joint.length, one, value)
    elif joint.square is not None:
        yield Target(name, joint.square, one, value**2)
    elif joint.cosine is not None and joint.sine is not None:
        scale = joint.scale if joint.scale is not None else one
        yield Target(f"cos({name})", joint.cosine, scale, sympy.cos(value))
        yield Target(f"sin({name})", joint.sine, scale, sympy.sin(value))
