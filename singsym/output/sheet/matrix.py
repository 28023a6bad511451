"""Matrices of the velocity equation in LaTeX, at the size of the text: what is too wide comes in parts.

Source: (6), (7) and (9) of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING

from singsym.kinematics.nonzero import Certifier
from singsym.output.document import escaped
from singsym.output.sheet.blocks import Blocks, Heading, blocks, factor_latex, value_latex

if TYPE_CHECKING:
    from singsym.conditions.conditions import Conditions
    from singsym.kinematics.velocity import VelocityEquation
    from singsym.mechanism.model import Mechanism
    from singsym.output.sheet.blocks import Recognise
    from singsym.polynomials import Polynomial, PolynomialMatrix

WIDEST = 33.0
"""An array may be so wide, in em: the line of a plain article has 34 at 10 pt."""

LONGEST = 6
"""What a name stands for is left out where an entry has more terms, unless all is asked for."""


def matrix_latex(
    equation: VelocityEquation,
    mechanism: Mechanism | None = None,
    recognise: Recognise | None = None,
    *,
    expand: bool = False,
) -> list[str]:
    """L with labels: its arrays, then what the names in it stand for; entries in short forms, equal on loops.

    mechanism: for the name of the output's point; recognise: a formula for an entry by itself, or "".

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> print(matrix_latex(velocity_equation(load("fourbar")))[0].splitlines()[2])
    L & T & \\underline{\\mathrm{A}} & \\mathrm{B} & \\mathrm{C} & \\mathrm{D} \\\\
    """
    shorten = Certifier(equation.space).shorten
    found = blocks(replace(equation, matrix=equation.matrix.map(shorten)), mechanism, recognise)
    heads = [_head(heading) for heading in found.columns]
    widths = [_width(head, *(row[j] for row in found.cells)) for j, head in enumerate(heads)]
    parts = [
        _array(found, heads, slice(low, high)) for low, high in _cuts(widths, WIDEST - _width(*found.rows))
    ]
    long = [name for name, value in found.names.items() if not expand and _terms(value) > LONGEST]
    said = [f"${value_latex(name, value)}$" for name, value in found.names.items() if name not in long]
    if any(name.startswith(r"\tilde") for name in found.names):
        said.append(r"$\tilde{b}\,w = b \times w$")
    parts += ["with " + ",\n".join(said) + "."] if said else []
    return [*parts, f"Cut here as they are long: ${', '.join(long)}$."] if long else parts


def _terms(value: PolynomialMatrix) -> int:
    """Terms of the longest entry."""
    return max(len(e) for row in value.rows for e in row)


def _width(*formulas: str) -> float:
    """About how wide a column is, in em; not less than it is.

    >>> round(_width("-m_{A1}", "0"), 2)
    3.06
    """
    return max(map(_formula_width, formulas), default=0.0) + 0.6


def _formula_width(formula: str) -> float:
    bare = re.sub(r"\\[a-zA-Z]+|\\.|[, ]", "", formula)
    raised = "".join(re.findall(r"[_^]\{+([^}]*)\}", bare))
    level = re.sub(r"[_^]\{+[^}]*\}|[{}]", "", bare)
    return 0.75 * len(level) + 0.48 * len(raised)


def _cuts(widths: Sequence[float], widest: float) -> list[tuple[int, int]]:
    """First and last columns of parts that are not too wide, as few and as equal as can be.

    >>> _cuts([3, 3, 3, 3, 9], 10)
    [(0, 2), (2, 4), (4, 5)]
    """

    def parts(limit: float) -> list[tuple[int, int]]:
        found, low, total = [], 0, 0.0
        for place, width in enumerate(widths):
            if place > low and total + width > limit:
                found.append((low, place))
                low, total = place, 0.0
            total += width
        return [*found, (low, len(widths))]

    fewest = parts(widest)
    limits = [sum(widths[low:high]) for low, high in combinations(range(len(widths) + 1), 2)]
    return next((cut for x in sorted(limits) if len(cut := parts(x)) == len(fewest)), fewest)


def _head(heading: Heading) -> str:
    """What stands over columns: inputs underlined, T in turns and translations where it is in parts."""
    name, _, part = heading.label.partition(".")
    if heading.role == "output":
        index = {"": "", "w": r"_{\omega}", "v": "_{v}"}.get(part, rf"_{{\mathrm{{{escaped(part)}}}}}")
        return f"{name}{index}"
    upright = rf"\mathrm{{{escaped(heading.label)}}}"
    return rf"\underline{{{upright}}}" if heading.role == "input" else upright


def _array(found: Blocks, heads: Sequence[str], part: slice) -> str:
    """One array with some of the columns, the output's apart from the joints by a line."""
    shown = found.columns[part]
    joints = next((j for j, heading in enumerate(shown) if heading.role != "output"), len(shown))
    layout = f"r|{'c' * joints}{'|' if 0 < joints < len(shown) else ''}{'c' * (len(shown) - joints)}"
    rows = zip(found.rows, found.cells, strict=True)
    body = " \\\\\n".join(rf"\text{{{escaped(label)}}} & {' & '.join(cells[part])}" for label, cells in rows)
    return (
        f"{{\\arraycolsep=3pt \\def\\arraystretch{{1.2}}\n\\[\\begin{{array}}{{{layout}}}\n"
        f"L & {' & '.join(heads[part])} \\\\\n\\hline\n\\rule{{0pt}}{{2.6ex}}{body}\n\\end{{array}}\\]}}"
    )


def reduced_latex(
    found: Conditions, mechanism: Mechanism | None = None, *, expand: bool = False
) -> list[str]:
    """L after the reduction; an entry by itself that is a determinant of named points is written as that."""

    def recognise(entry: Polynomial) -> str:
        name = found.names.recognise(entry)
        known_to_a_sign = name is not None and name.quantity.text.startswith("±")
        if name is None or known_to_a_sign or name.radicand != 1 or not name.scale.is_constant:
            return ""
        return f"{factor_latex(1 / name.scale.constant)}{name.quantity.latex}"

    return matrix_latex(found.reduction.equation, mechanism, recognise, expand=expand)
