"""Matrices of the velocity equation in LaTeX, at the size of the text: what is too wide comes in parts.

Source: (6), (7) and (9) of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from singsym.output.document import escaped
from singsym.output.sheet.blocks import Heading, blocks, factor_latex, value_latex

if TYPE_CHECKING:
    from singsym.conditions.conditions import Conditions
    from singsym.kinematics.velocity import VelocityEquation
    from singsym.mechanism.model import Mechanism
    from singsym.output.sheet.blocks import Recognise
    from singsym.polynomials import Polynomial

WIDEST = 29.0
"""An array may be so wide, in em: the line of a plain article has 34 at 10 pt."""

LONGEST = 6
"""Entries with more terms are cut, unless all is asked for."""


def matrix_latex(
    equation: VelocityEquation,
    mechanism: Mechanism | None = None,
    recognise: Recognise | None = None,
    *,
    expand: bool = False,
) -> list[str]:
    """L with labels, its arrays and then what the names in it stand for.

    mechanism: for the name of the output's point; recognise: a formula for an entry by itself, or "".

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> print(matrix_latex(velocity_equation(load("fourbar")))[0].splitlines()[2])
    L & \\mathrm{T} & \\underline{\\mathrm{A}} & \\mathrm{B} & \\mathrm{C} & \\mathrm{D} \\\\
    """
    point = getattr(mechanism.outputs[0], "point", "") if mechanism and len(mechanism.outputs) == 1 else ""
    found = blocks(equation, point, recognise)
    widths = [_width(h.label, *(row[j] for row in found.cells)) for j, h in enumerate(found.columns)]
    parts = [
        _array(found.rows, found.columns[low:high], [row[low:high] for row in found.cells])
        for low, high in _cuts(widths, WIDEST - _width(*found.rows))
    ]
    longest = sys.maxsize if expand else LONGEST
    said = [f"${value_latex(name, value, longest)}$" for name, value in found.names.items()]
    if any(name.startswith(r"\tilde") for name in found.names):
        said.append(r"$\tilde{b}\,w = b \times w$")
    return [*parts, *(["with " + ",\n".join(said) + "."] if said else [])]


def _width(*formulas: str) -> float:
    """About how wide a column is, in em."""
    plain = (re.sub(r"\\[a-zA-Z]+|[{}_^\\, ]", "", formula) for formula in formulas)
    return 0.5 * max(map(len, plain), default=0) + 0.8


def _cuts(widths: Sequence[float], widest: float) -> list[tuple[int, int]]:
    """First and last columns of parts that are not too wide.

    >>> _cuts([3, 3, 3, 9], 7)
    [(0, 2), (2, 3), (3, 4)]
    """
    found, low, total = [], 0, 0.0
    for place, width in enumerate(widths):
        if place > low and total + width > widest:
            found.append((low, place))
            low, total = place, 0.0
        total += width
    return [*found, (low, len(widths))]


def _array(rows: Sequence[str], columns: Sequence[Heading], cells: Sequence[Sequence[str]]) -> str:
    """One array: roles of columns apart by lines, inputs underlined."""
    layout, before = "", ""
    for heading in columns:
        layout += ("|" if heading.role == "output" or before in ("", "output") else "") + "c"
        before = heading.role
    mark = {"input": r"\underline{\mathrm{%s}}"}
    heads = [mark.get(h.role, r"\mathrm{%s}") % escaped(h.label) for h in columns]
    body = " \\\\\n".join(
        f"\\text{{{escaped(label)}}} & {' & '.join(row)}" for label, row in zip(rows, cells, strict=True)
    )
    return (
        f"{{\\arraycolsep=3pt\n\\[\\begin{{array}}{{r{layout}}}\n"
        f"L & {' & '.join(heads)} \\\\\n\\hline\n\\rule{{0pt}}{{2.6ex}}{body}\n\\end{{array}}\\]}}"
    )


def reduced_latex(found: Conditions, mechanism: Mechanism | None = None, *, expand: bool = False) -> list[str]:
    """L after the reduction; an entry by itself that is a determinant of named points is written as that."""

    def recognise(entry: Polynomial) -> str:
        name = found.names.recognise(entry)
        if name is None or name.radicand != 1 or not name.scale.is_constant:
            return ""
        return f"{factor_latex(1 / name.scale.constant)}{name.quantity.latex}"

    return matrix_latex(found.reduction.equation, mechanism, recognise, expand=expand)
