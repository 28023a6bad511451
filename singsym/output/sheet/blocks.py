r"""L in blocks with labels: a screw, a moment, an identity or zero for each joint and group of rows.

Source: (6), (7) and (9) of Zlatanov, Fenton, Benhabib (1998) print L so.  What a name stands for follows the
matrix; a block that is a multiple of another one of its joint is written with the name of that, and b with a
tilde is the matrix of the cross product with b.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from flint import fmpq

from singsym.kinematics.loops import loops
from singsym.kinematics.velocity import output_path
from singsym.polynomials import Polynomial, PolynomialMatrix
from singsym.polynomials.latex import polynomial_latex

if TYPE_CHECKING:
    from singsym.kinematics.velocity import Role, VelocityEquation
    from singsym.mechanism.model import Mechanism

SHORT = 2
"""An entry that stands alone is written out up to so many terms."""

ALL = sys.maxsize

_CROSS = r"\tilde{b}"

Recognise = Callable[[Polynomial], str]


@dataclass(frozen=True)
class Heading:
    """The columns of one joint, or of the output."""

    label: str
    role: Role
    places: tuple[int, ...]


@dataclass(frozen=True)
class Blocks:
    """L as it is printed: labels of groups of rows and of columns, formulas of cells, and what names are."""

    rows: tuple[str, ...]
    columns: tuple[Heading, ...]
    cells: tuple[tuple[str, ...], ...]
    names: dict[str, PolynomialMatrix]


def blocks(
    equation: VelocityEquation, mechanism: Mechanism | None = None, recognise: Recognise | None = None
) -> Blocks:
    """The velocity equation in blocks.

    mechanism: for the output's point, which moments are named after, and for how loops pass joints.
    recognise: a formula for an entry by itself, or "".

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> mechanism = load("zlatanov-2dof")
    >>> for row in blocks(velocity_equation(mechanism), mechanism).cells:
    ...     print(" ".join(row))
    I 0 0 0 0 0 -m_{EG} m_{FG} 0
    0 S_{A} S_{B} S_{C1} 0 -S_{D} 0 0 0
    0 0 0 0 S_{C2} S_{D} -S_{E} S_{F} S_{G}
    """
    rows = _row_groups(equation)
    columns = _headings(equation, len(rows.get("output", ())))
    names = _Names(mechanism, recognise)
    cells = tuple(
        tuple(
            names.cell(group, heading, equation.matrix.select(places, heading.places), equation)
            for heading in columns
        )
        for group, places in rows.items()
    )
    labels = tuple(group.replace("no idle spin at", "spin of") for group in rows)
    return Blocks(labels, columns, cells, names.values)


def _row_groups(equation: VelocityEquation) -> dict[str, tuple[int, ...]]:
    """Rows of the output and of each loop together, others one by one."""
    found: dict[str, list[int]] = {}
    for i, row in enumerate(equation.rows):
        group = "output" if row.startswith("output ") else row
        group = row.rpartition(" ")[0] if row.startswith("loop ") else group
        found.setdefault(group, []).append(i)
    return {group: tuple(places) for group, places in found.items()}


def _headings(equation: VelocityEquation, output_rows: int) -> tuple[Heading, ...]:
    """Columns of one joint and role together; turns and translations of T apart where rows are missing.

    Where only L is given, without rows of an output, each column stands by itself.
    """
    outputs = sum(column.role == "output" for column in equation.columns)
    found: dict[tuple[str, Role], list[int]] = {}
    for j, column in enumerate(equation.columns):
        joint, _, part = column.label.partition(".")
        if not output_rows:
            joint = column.label
        elif column.role == "output" and part[:1] in ("w", "v") and outputs != output_rows:
            joint = f"{joint}.{part[0]}"
        found.setdefault((joint, column.role), []).append(j)
    return tuple(Heading(label, role, tuple(places)) for (label, role), places in found.items())


@dataclass
class _Names:
    """The names that were given, with what they stand for."""

    mechanism: Mechanism | None
    recognise: Recognise | None
    values: dict[str, PolynomialMatrix] = field(default_factory=dict)
    known: dict[Heading, list[str]] = field(default_factory=dict)

    @property
    def point(self) -> str:
        """The point of the only output."""
        outputs = self.mechanism.outputs if self.mechanism else ()
        return str(getattr(outputs[0], "point", "")) if len(outputs) == 1 else ""

    @cached_property
    def backwards(self) -> frozenset[tuple[str, str]]:
        """Loops, and the way to the output, with joints that they pass from the second link to the first."""
        if self.mechanism is None:
            return frozenset()
        ways = {f"loop {k}": loop for k, loop in enumerate(loops(self.mechanism), 1)}
        if len(self.mechanism.outputs) == 1:
            ways["output"] = output_path(self.mechanism, self.mechanism.outputs[0])
        return frozenset(
            (group, joint.name) for group, way in ways.items() for joint, sign in way if sign < 0
        )

    def cell(self, group: str, heading: Heading, block: PolynomialMatrix, equation: VelocityEquation) -> str:
        """A block as a formula."""
        size = block.shape[0]
        if not any(map(any, block.rows)):
            return "0"
        unit = PolynomialMatrix.of(block.ring, [[int(i == j) for j in range(size)] for i in range(size)])
        if (multiple := _ratio(block, unit)) is not None and (size > 1 or abs(multiple) == 1):
            return f"{factor_latex(multiple)}{'I' if size > 1 else '1'}"
        if block.shape == (1, 1):
            entry = block[0, 0]
            said = self.recognise(entry) if self.recognise and len(entry) > 1 else ""
            if said or len(entry) <= SHORT:
                return said or polynomial_latex(entry)
        for name in self.known.get(heading, ()):
            if (ratio := _ratio(block, self.values[name])) is not None:
                return f"{factor_latex(ratio)}{name}"
        return self._named(group, heading, block, equation)

    def _named(
        self, group: str, heading: Heading, block: PolynomialMatrix, equation: VelocityEquation
    ) -> str:
        """A new name; an output's block has the sign with which the joint moves the output."""
        components = [row.rpartition(" ")[2] for row in equation.rows if row.startswith(f"{group} ")]
        # the output's rows have T less what the joints contribute
        turned = (group == "output" and len(components) > 1) != ((group, heading.label) in self.backwards)
        lead = "-" if turned else ""
        value = block.map(lambda e: -e) if lead else block
        subscript = heading.label.replace("_", r"\_").replace(".", "")
        if _cross_vector(value) is not None:
            base = f"{_CROSS}_{{{self._count(_CROSS) + 1}}}"
        elif value.shape == (1, 1):
            base = rf"\ell_{{{self._count('ell') + 1}}}"
        elif value.shape[0] == 1:
            base = f"d_{{{subscript}}}"
        elif not any(c.startswith("w") for c in components):
            at = self.point.replace("_", r"\_") if group == "output" else ""
            comma = "," if at and len(subscript) > 1 else ""
            base = f"m_{{{subscript}{comma}{at}}}"
        else:
            base = f"S_{{{subscript}}}{'^{T}' if group == 'output' else ''}"
        name, count = base, 1
        while name in self.values:
            count += 1
            name = f"{base}^{{({count})}}"
        self.values[name] = value
        self.known.setdefault(heading, []).append(name)
        return f"{lead}{name}"

    def _count(self, part: str) -> int:
        return sum(part in name for name in self.values)


def _ratio(block: PolynomialMatrix, other: PolynomialMatrix) -> fmpq | None:
    """The number that makes one block of the other; None where there is none."""
    if block.shape != other.shape:
        return None
    pairs = [
        (a, b)
        for own, known in zip(block.rows, other.rows, strict=True)
        for a, b in zip(own, known, strict=True)
    ]
    first = next(((a, b) for a, b in pairs if a and b), None)
    if first is None:
        return None
    ratio: fmpq = first[0].leading_term[1] / first[1].leading_term[1]
    return ratio if all(a == b * ratio for a, b in pairs) else None


def factor_latex(ratio: fmpq) -> str:
    """A number before a name.

    >>> [factor_latex(fmpq(*pair)) for pair in ((1, 1), (-1, 1), (-2, 1), (1, 2))]
    ['', '-', '-2', '\\\\tfrac{1}{2}']
    """
    if abs(ratio) == 1:
        return "" if ratio > 0 else "-"
    size = str(abs(ratio.p)) if ratio.q == 1 else rf"\tfrac{{{abs(ratio.p)}}}{{{ratio.q}}}"
    return f"{'-' if ratio < 0 else ''}{size}"


def _cross_vector(block: PolynomialMatrix) -> tuple[Polynomial, ...] | None:
    """The vector b of a matrix that is w -> b x w; None for other matrices."""
    if block.shape != (3, 3):
        return None
    if any(block[i, j] != -block[j, i] for i in range(3) for j in range(i + 1)):
        return None
    return (block[2, 1], block[0, 2], block[1, 0])


def value_latex(name: str, value: PolynomialMatrix) -> str:
    """What a name stands for: columns as tuples, turns before a semicolon and translations after it."""
    vector = _cross_vector(value)
    if vector is not None:
        return rf"{name.replace(_CROSS, 'b')} = {_tuple(vector)}"
    if value.shape == (1, 1):
        return f"{name} = {polynomial_latex(value[0, 0], ALL)}"
    if value.shape[0] == 1:
        return f"{name} = {_tuple(value.rows[0])}"
    columns = [_tuple(column) for column in value.T.rows]
    return f"{name} = {columns[0]}" if len(columns) == 1 else f"{name} = [{', '.join(columns)}]"


def _tuple(entries: tuple[Polynomial, ...]) -> str:
    said = [polynomial_latex(e, ALL) for e in entries]
    halves = (said[:3], said[3:]) if len(said) == 6 else (said,)
    return f"({'; '.join(', '.join(half) for half in halves)})"
