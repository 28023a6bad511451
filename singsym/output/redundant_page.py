"""The conditions of a redundant serial chain, as text, LaTeX and plain data.

Source: singsym's own.
"""

from __future__ import annotations

from typing import Any

from singsym.conditions.redundant import RedundantChain
from singsym.mechanism import Mechanism
from singsym.output.conditions_latex import listed_latex
from singsym.output.conditions_page import conditions_text
from singsym.output.latex import mechanism_latex
from singsym.output.page import Page
from singsym.output.plain_data import condition_data, equation_data
from singsym.output.text import matrix_page


def redundant_page(found: RedundantChain, *, expand: bool = False) -> Page:
    """L, what holds in every configuration, and where IO holds; expand: all terms of polynomials."""
    equation = found.equation
    columns = [c.label for c in equation.columns]
    return (
        f"N = {equation.N}, n = {equation.n}",
        *matrix_page("L", equation.L, equation.rows, columns),
        str(found),
        conditions_text([found.condition], expand=expand),
    )


def redundant_latex(mechanism: Mechanism, found: RedundantChain, *, expand: bool = False) -> str:
    """The mechanism with its velocity equation, and the condition; expand: all terms of polynomials."""
    conditions = (r"\section*{Conditions}", f"{found}.", listed_latex([found.condition], expand=expand))
    return "\n\n".join([mechanism_latex(mechanism, found.equation), *conditions])


def redundant_data(name: str, found: RedundantChain) -> dict[str, Any]:
    """The velocity equation, the types that hold everywhere and nowhere, and the condition for IO."""
    return {
        "mechanism": name,
        **equation_data(found.equation),
        "redundant": True,
        "everywhere": ["RI"],
        "nowhere": ["RO", "RPM", "II", "IIM"],
        "conditions": [condition_data(found.condition)],
    }
