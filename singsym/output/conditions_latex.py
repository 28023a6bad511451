"""The conditions of a mechanism in LaTeX.

Source: (4), (5) and (i)-(viii) of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING

from singsym.conditions.named_lengths import NamedLengths, in_decimals
from singsym.output.citations import FEW, Citations, Entry, cited, is_short
from singsym.output.document import escaped
from singsym.polynomials.latex import polynomial_latex, symbol_latex

if TYPE_CHECKING:
    from singsym.conditions.conditions import Condition
    from singsym.conditions.factor import Factor

LONGEST = 12
"""Polynomials with more terms are cut, with the number of terms left out, unless all is asked for."""


def listed_latex(
    conditions: Iterable[Condition], lengths: NamedLengths | None = None, *, expand: bool = False
) -> str:
    """Conditions with what they amount to; a polynomial is printed once and cited after.

    lengths: those that keep their names; expand: all terms of polynomials.
    """
    listed = tuple(conditions)
    written = lengths or NamedLengths()
    found = cited(listed, expand)
    parts = [_entry(entry, found, written, expand) for entry in found.entries]
    if values := written.occurring_in_factors(f for c in listed for f in c.all_factors):
        parts.append(values_latex(values))
    return "\n\n".join(parts)


def values_latex(values: Mapping[str, Fraction]) -> str:
    """Lengths by name, each with its value, as a sentence."""
    said = (f"${symbol_latex(name)} = {in_decimals(value)}$" for name, value in values.items())
    return f"Here {', '.join(said)}."


def _entry(entry: Entry, found: Citations, written: NamedLengths, expand: bool) -> str:
    """One condition with its factors, each with its name and in words where it has them."""
    condition, longest = entry.condition, sys.maxsize if expand else LONGEST
    head = rf"\textbf{{({condition.label})}}\enspace ${condition.latex_statement}$ \quad ({condition.types})"
    if entry.same_as:
        off = rf" where ({entry.off}) does not hold; where it does, the ranks decide" if entry.off else ""
        return f"{head}, as ({entry.same_as}){off}."
    if entry.nowhere:
        return f"{head}, in no configuration.{_units(condition, expand)}"
    if condition.everywhere:
        return f"{head}, in every configuration."
    if condition.bracket is not None:
        return rf"{head}: ${condition.bracket.latex} = 0$, {escaped(condition.bracket.words)}."
    items = [rf"\item[if] {escaped(condition.equilibrium.words)}"] if condition.equilibrium else []
    for place, alternative in enumerate(entry.alternatives):
        said = [
            f"${_full(f, found, written, longest)} = 0${_words(f, written)}"
            for f, full in alternative
            if full
        ]
        said = said or [_cited([f for f, _ in alternative], found, written)]
        lead = "or" if place else "i.e." if condition.equilibrium else "if"
        items.append(rf"\item[{lead}] {said[0]}")
    if entry.left_out:
        items.append(rf"\item[{'or' if entry.alternatives else 'i.e.'}] {entry.more}")
    items += [rf"\item[where] ${_full(f, found, written, longest)}${_words(f, written)}" for f in entry.below]
    if not items:
        return f"{head}."
    listed = "\n".join(items)
    return f"{head}\n\\begin{{itemize}}\n{listed}\n\\end{{itemize}}{_units(condition, expand)}"


def _units(condition: Condition, expand: bool) -> str:
    """The factors that were taken away; a few, unless all is asked for."""
    if not expand and len(condition.units) > FEW:
        return f"\n{len(condition.units)} factors that vanish nowhere in the feasible set are left out."
    said = [
        f"${polynomial_latex(u.polynomial, sys.maxsize if expand else 6)}$ ({escaped(u.reason)})"
        for u in condition.units
    ]
    return f"\nFactors without a feasible zero are left out: {'; '.join(said)}." if said else ""


def _full(factor: Factor, found: Citations, written: NamedLengths, longest: int) -> str:
    """A factor with its polynomial, after the name that it is cited by."""
    number = found.numbers.get(factor.polynomial)
    name = f"f_{{{number}}} = " if number else ""
    return f"{name}{written.factor(factor).latex(longest)}"


def _words(factor: Factor, written: NamedLengths) -> str:
    return f", {escaped(words)}" if (words := written.factor(factor).explained) else ""


def _cited(factors: list[Factor], found: Citations, written: NamedLengths) -> str:
    """Factors that vanish together, by their words, by short polynomials and by names."""
    said = [escaped(f.words) for f in factors if f.words]
    equal = [polynomial_latex(written.factor(f).polynomial) for f in factors if is_short(f)]
    equal += [f"f_{{{number}}}" for number in found.numbers_of(factors)]
    return r" \emph{and} ".join([*said, *([f"${' = '.join([*equal, '0'])}$"] if equal else [])])
