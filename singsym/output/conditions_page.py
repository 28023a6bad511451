"""The conditions of a mechanism as a page of text.

Source: (4), (5) and (i)-(viii) of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from singsym.conditions.named_lengths import NamedLengths, values_text
from singsym.output.citations import FEW, Citations, Entry, cited, is_short
from singsym.output.page import Block, Page
from singsym.output.text import matrix_page

if TYPE_CHECKING:
    from singsym.conditions.conditions import Condition, Conditions
    from singsym.conditions.factor import Factor
    from singsym.kinematics.reduction import Reduction

MOST, HEAD, WIDEST = 8, 4, 120
"""Of polynomials with more terms or letters than these the first few are printed, unless all is asked for."""


def conditions_page(
    conditions: Conditions, lengths: NamedLengths | None = None, *, expand: bool = False
) -> Page:
    """The reduction's record, and (4), (5), (i)-(viii) with their factors.

    lengths: those that keep their names; expand: L before and after the reduction too, and all terms.
    """
    equation, reduction = conditions.equation, conditions.reduction
    reduced = reduction.equation
    blocks: list[Block] = [f"N = {equation.N}, n = {equation.n}"]
    if expand:
        blocks += matrix_page("L", equation.L, equation.rows, [c.label for c in equation.columns])
    if expand or reduction.record:
        blocks.append(_reduction_text(reduction, expand))
    if expand:
        blocks += matrix_page("L, reduced", reduced.L, reduced.rows, [c.label for c in reduced.columns])
    return (*blocks, conditions_text(conditions, lengths, expand=expand))


def _reduction_text(reduction: Reduction, expand: bool) -> str:
    """The passive velocities that were eliminated; expand: each with its pivot, constant ones too."""
    head = "Reduction (section 4.2)"
    if expand:
        return "\n".join([head, *(f"  {line}" for line in reduction.lines)])
    return "\n".join([f"{head}, {'; '.join(reduction_lines(reduction))}", f"  {reduction.lines[-1]}"])


def reduction_lines(reduction: Reduction) -> list[str]:
    """The columns that went by constant pivots, and those that went by others."""
    constant, varied = (
        joined_columns(c for step in reduction.record if step.pivot.is_constant is kind for c in step.columns)
        for kind in (True, False)
    )
    said = [f"by constant pivots {constant}"] if constant else []
    return [*said, f"by others that vanish nowhere {varied}"] if varied else said


def joined_columns(columns: Iterable[str]) -> str:
    """Columns in their order, those of one joint together.

    >>> joined_columns(("A.x", "A.y", "B", "C.angle", "C.slide"))
    'A.xy, B, C.angle, C.slide'
    """
    joints: dict[str, list[str]] = {}
    for joint, _, part in (column.partition(".") for column in columns):
        joints.setdefault(joint, []).append(part)
    said = []
    for joint, parts in joints.items():
        letters = all(len(part) <= 1 for part in parts)
        own = ["".join(parts)] if letters else parts
        said += [f"{joint}.{part}" if part else joint for part in own]
    return ", ".join(said)


def conditions_text(
    conditions: Iterable[Condition], lengths: NamedLengths | None = None, *, expand: bool = False
) -> str:
    """Conditions with what they amount to; a polynomial is printed once and cited after."""
    listed = tuple(conditions)
    written = lengths or NamedLengths()
    found = cited(listed, expand)
    lines = [line for entry in found.entries for line in _entry(entry, found, written, expand)]
    if values := written.occurring_in_factors(f for c in listed for f in c.all_factors):
        lines.append(f"with {values_text(values)}")
    text = "\n".join(lines)
    if not expand and ("more terms" in text or any(entry.left_out for entry in found.entries)):
        lines.append("What is cut here, --expand prints")
    return "\n".join(lines)


def _entry(entry: Entry, found: Citations, written: NamedLengths, expand: bool) -> list[str]:
    """One condition with its alternatives."""
    condition = entry.condition
    head = f"({condition.label}) {condition.statement}: {condition.types}"
    if entry.same_as:
        off = f" off ({entry.off}); on it the ranks decide" if entry.off else ""
        return [f"{head}; as ({entry.same_as}){off}"]
    if entry.nowhere:
        head += "; in no configuration"
    elif condition.everywhere:
        head += "; in every configuration"
    elif condition.bracket is not None:
        return [head, f"  if {condition.bracket.text} = 0  ({condition.bracket.words})"]
    elif condition.alternatives is None and condition.comparison is None and condition.equilibrium is None:
        head += "; left as a rank: no determinant or list of minors is short enough"
    lines = [head]
    if condition.equilibrium and not (entry.nowhere or condition.everywhere):
        lines.append(f"  if {condition.equilibrium.words}{'; that is,' if entry.alternatives else ''}")
    for place, alternative in enumerate(entry.alternatives):
        said = [
            f"{_full(f, found, written, expand)} = 0{_words(f, written)}" for f, full in alternative if full
        ]
        said = said or [_cited([f for f, _ in alternative], found, written)]
        lines.append(f"  {'or' if place else 'if'} {said[0]}")
    if entry.left_out:
        lines.append(f"  {'or ' if entry.alternatives else ''}{entry.more}")
    below = [f for f in entry.below if expand or not f.words]
    lines += [f"  where {_full(f, found, written, expand)}{_words(f, written)}" for f in below]
    if expand or len(condition.units) <= FEW:
        return lines + [
            f"  without the factor {unit.text(None if expand else MOST)}" for unit in condition.units
        ]
    left_out = f"{len(condition.units)} factors that vanish nowhere in the feasible set"
    return [*lines, f"  without {left_out}: --expand prints them"]


def _full(factor: Factor, found: Citations, written: NamedLengths, expand: bool) -> str:
    """A factor with its polynomial, after the name that it is cited by."""
    number = found.numbers.get(factor.polynomial)
    shown = written.factor(factor)
    text = shown.text()
    if not expand and (len(shown.polynomial) > MOST or len(text) > WIDEST):
        shorter = (shown.text(terms) for terms in range(HEAD, 0, -1))
        text = next((cut for cut in shorter if len(cut) <= WIDEST), shown.text(1))
    return f"{f'f{number} = ' if number else ''}{text}"


def _words(factor: Factor, written: NamedLengths) -> str:
    return f"  ({words})" if (words := written.factor(factor).explained) else ""


def _cited(factors: list[Factor], found: Citations, written: NamedLengths) -> str:
    """Factors that vanish together, by their words, by short polynomials and by names."""
    said = [f.words for f in factors if f.words]
    equal = [f"{written.factor(f).polynomial.short_text(None)}" for f in factors if is_short(f)]
    equal += [f"f{number}" for number in found.numbers_of(factors)]
    return " and ".join([*said, *([" = ".join([*equal, "0"])] if equal else [])])
