"""The conditions of a mechanism as a page of text.

Source: (4), (5) and (i)-(viii) of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from singsym.output.page import Page
from singsym.output.text import LONGEST, matrix_page

if TYPE_CHECKING:
    from singsym.conditions.conditions import Condition, Conditions


def conditions_page(conditions: Conditions) -> Page:
    """L, the reduction's record, and (4), (5), (i)-(viii) with their factors."""
    equation, reduction = conditions.equation, conditions.reduction
    reduced = reduction.equation
    columns = [c.label for c in equation.columns]
    return (
        f"N = {equation.N}, n = {equation.n}",
        *matrix_page("L", equation.L, equation.rows, columns),
        "\n".join(["Reduction (section 4.2):", *(f"  {line}" for line in reduction.lines)]),
        *matrix_page("L, reduced", reduced.L, reduced.rows, [c.label for c in reduced.columns]),
        *(condition_text(c) for c in conditions),
    )


def condition_text(condition: Condition) -> str:
    """One condition with what it amounts to."""
    lines = [f"({condition.label}) {condition.statement}: {condition.types}"]
    if condition.everywhere:
        lines.append("  in every configuration")
    elif condition.alternatives is not None and not condition.alternatives:
        lines.append("  in no configuration")
    elif condition.alternatives is None and condition.comparison is None:
        lines.append("  left as a rank: no determinant or list of minors is short enough")
    for place, alternative in enumerate(condition.alternatives or ()):
        lead = "  if " if place == 0 else "  or "
        for factor in alternative:
            words = f"  ({factor.words})" if factor.words else ""
            lines.append(f"{lead}{factor.text(LONGEST)} = 0{words}")
            lead = "     and "
    lines += [f"  without the factor {unit}" for unit in condition.units]
    return "\n".join(lines)
