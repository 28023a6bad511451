"""Mechanisms, conditions and classifications in LaTeX, for amsmath and booktabs.

Source: the layouts of Tables 1 and 2 of Zlatanov, Fenton, Benhabib (1998).  Formulas that may be long are
set in the line, where TeX breaks them after operators.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from singsym.conditions.named_lengths import NamedLengths
from singsym.output.conditions_latex import listed_latex, values_latex
from singsym.output.conditions_page import reduction_lines
from singsym.output.document import escaped
from singsym.output.pieces import (
    alike,
    extent_of,
    filled,
    grouped,
    loop_equations,
    moving,
    named_polynomials,
    varying,
)
from singsym.output.sheet.matrix import matrix_latex, reduced_latex
from singsym.output.sheet.steps import locus_latex, named_latex, steps_latex, where_latex
from singsym.polynomials.latex import polynomial_latex, symbol_latex

if TYPE_CHECKING:
    from singsym.classes.result import Classification, ClassResult, Configuration, Locus, SpacePiece
    from singsym.classes.solve import Solution
    from singsym.classes.taxonomy.types import Table
    from singsym.conditions.conditions import Conditions
    from singsym.kinematics.velocity import VelocityEquation
    from singsym.mechanism.model import Mechanism
    from singsym.polynomials import Polynomial

# -- the mechanism -----------------------------------------------------------------------------------


def mechanism_latex(mechanism: Mechanism, equation: VelocityEquation) -> str:
    """What the mechanism is, its loop equations and L."""
    return "\n\n".join([_description(mechanism), *_loops(equation), *_velocity(equation, mechanism)])


def _description(mechanism: Mechanism) -> str:
    from singsym.output.text import coupling_text, output_text

    parts = [f"{mechanism.description.strip()}" if mechanism.description else ""]
    inputs = ", ".join(mechanism.inputs)
    outputs = "; ".join(output_text(o) for o in mechanism.outputs)
    parts.append(f"Inputs: {inputs}. Output: {outputs}.")
    parts += [f"Coupled: {coupling_text(c)}." for c in mechanism.couplings]
    if mechanism.source:
        parts.append(f"Source: {mechanism.source}.")
    return "\n\n".join(escaped(part) for part in parts if part)


def _loops(equation: VelocityEquation) -> list[str]:
    space = equation.space
    names = ", ".join(f"${polynomial_latex(space.ring.gen(v))}$" for v in space.variables)
    lines = [r"\section*{Configuration space}", f"Variables: {names}."]
    if loops := loop_equations(equation):
        equations = ",\n".join(f"${polynomial_latex(e)} = 0$" for e in loops)
        lines.append(f"Loop equations: {equations}.")
    feasible = [f"${polynomial_latex(p)} > 0$" for p in space.positive]
    feasible += [f"${polynomial_latex(p)} \\ge 0$" for p in space.nonnegative]
    feasible += [
        f"$({', '.join(polynomial_latex(p, 6) for p in group)}) \\ne 0$" for group in space.exclusions
    ]
    if feasible:
        lines.append(f"Feasible: {', '.join(feasible)}.")
    return lines


def _velocity(equation: VelocityEquation, mechanism: Mechanism | None, expand: bool = False) -> list[str]:
    text = (
        f"Velocity equation $L\\,m = 0$ with $N = {equation.N}$, $n = {equation.n}$; inputs are underlined."
    )
    return [r"\section*{Velocity equation}", text, *matrix_latex(equation, mechanism, expand=expand)]


# -- conditions --------------------------------------------------------------------------------------


def conditions_latex(
    conditions: Conditions,
    mechanism: Mechanism | None = None,
    lengths: NamedLengths | None = None,
    *,
    expand: bool = False,
) -> str:
    """The loop equations, L, the reduction with its record, and (4), (5), (i)-(viii).

    lengths: those that keep their names in the conditions; expand: all terms of polynomials in these.
    """
    equation, reduction = conditions.equation, conditions.reduction
    parts = [_description(mechanism)] if mechanism is not None else []
    parts += [*_loops(equation), *_velocity(equation, mechanism, expand)]
    parts += [r"\section*{Reduction}", *reduction_latex(conditions, expand=expand)]
    if reduction.record:
        parts += reduced_latex(conditions, mechanism, expand=expand)
    parts += [r"\section*{Conditions}", listed_latex(conditions, lengths, expand=expand)]
    return "\n\n".join(parts)


def reduction_latex(conditions: Conditions, *, expand: bool = False) -> list[str]:
    """The record of the reduction: which passive velocities went, and why that is allowed.

    expand: each by itself, with its pivot.
    """
    reduction = conditions.reduction
    items = []
    if expand:
        for step in reduction.record:
            which = ", ".join(step.columns)
            rows = escaped(", ".join(step.rows))
            by = f"by row {rows}, pivot" if len(step.rows) == 1 else f"from rows {rows}, sum of squares"
            reason = "" if step.pivot.is_constant else f": {escaped(step.reason)}"
            items.append(f"\\item {escaped(which)} {by} ${polynomial_latex(step.pivot, 8)}${reason}")
    else:
        items = [f"\\item {escaped(line)}" for line in reduction_lines(reduction)]
    size = r" \times ".join(map(str, reduction.equation.matrix.shape))
    last = f"Every rank is that of the reduced matrix (${size}$) plus {reduction.constant}."
    if not items:
        return ["No passive velocity can be eliminated."]
    return ["\\begin{itemize}\n" + "\n".join(items) + "\n\\end{itemize}", last]


# -- classes -----------------------------------------------------------------------------------------


def classes_latex(table: Table, n: int) -> str:
    """Table 1 for mobility n, with the numbers of the classes."""
    heads = " & ".join(escaped(str(c)) for c in table.columns)
    rows = " \\\\\n".join(
        f"{row} & " + " & ".join("" if c is None else str(c.number) for c in cells)
        for row, cells in zip(table.rows, table.cells, strict=True)
    )
    count = sum(c is not None for cells in table.cells for c in cells)
    more = " or more" if n >= 3 else ""
    head = f"The {count} classes of singular configurations for $n = {n}${more}; no number: impossible."
    return (
        f"{head}\n\n\\begin{{center}}\\begin{{tabular}}{{l{'c' * len(table.columns)}}}\n"
        f"\\toprule\n & {heads} \\\\\n\\midrule\n{rows} \\\\\n\\bottomrule\n"
        "\\end{tabular}\\end{center}"
    )


def classification_latex(result: Classification) -> str:
    """The mechanism, L, the reduction, the conditions, and the classes in the layout of Table 2."""
    from singsym.classes.gathering import gathered
    from singsym.conditions.conditions import conditions

    found = conditions(result.equation, result.reduction)
    names = named_polynomials(result)
    parts = [conditions_latex(found, result.mechanism, result.lengths)]
    if result.configuration_space:
        parts += [r"\section*{Pieces of the configuration space}", _space(result.configuration_space)]
    if result.loci:
        parts += [r"\section*{Singularity set}", _loci(result.loci, result.lengths, names)]
    parts += [r"\section*{Classes}", _itemized(result.summary), *_class_table(result)]
    if result.parameters_note:
        parts.append(f"Here {escaped(result.parameters_note)}.")
    parts += [_class(c, result, names) for c in result.classes if c.verdict.is_yes]
    parts += [r"\section*{Steps}", steps_latex(result)]
    if names:
        parts.append(named_latex(names))
    questions = [f"{what}: {reason}" for what, reason in gathered(result.open_questions())]
    for head, lines in (("Remarks", result.notes()), ("Open", questions)):
        if lines:
            parts.append(f"\\subsection*{{{head}}}\n{_itemized(lines)}")
    parts.append(f"Engines: {escaped(', '.join(result.engines))}; seed {result.seed}.")
    return "\n\n".join(parts)


def _itemized(lines: Iterable[str]) -> str:
    items = "\n".join(f"\\item {escaped(line)}" for line in lines)
    return f"\\begin{{itemize}}\n{items}\n\\end{{itemize}}"


def _space(pieces: Sequence[SpacePiece]) -> str:
    rows = [(str(x.extent), x.smooth, escaped(x.remark)) for x in pieces]
    wide = r">{\raggedright\arraybackslash}p{.6\linewidth}"
    return _table(("l", "l", wide), ("dimension", "smooth", "remark"), rows)


def _loci(loci: Sequence[Locus], lengths: NamedLengths, names: Mapping[Polynomial, str]) -> str:
    from singsym.classes.result import counts

    headers = ("", "", "locus", "dimension", "points", "components")
    rows = [
        (str(i), f"({x.condition})", locus_latex(x, lengths, names), str(x.extent), *counts(x))
        for i, x in enumerate(loci, 1)
    ]
    wide = r">{\raggedright\arraybackslash}p{.5\linewidth}"
    return _table(("r", "l", wide, "c", "c", "c"), headers, rows)


def _table(layout: Sequence[str], headers: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table by booktabs without its empty columns."""
    kept = filled(headers, rows)
    columns = "".join(layout[j] for j in kept)
    head, *lines = (" & ".join(row[j] for j in kept) for row in (headers, *rows))
    body = " \\\\\n".join(lines)
    return (
        f"\\begin{{center}}\\begin{{tabular}}{{@{{}}{columns}@{{}}}}\n\\toprule\n"
        f"{head} \\\\\n\\midrule\n{body} \\\\\n\\bottomrule\n\\end{{tabular}}\\end{{center}}"
    )


def _class_table(result: Classification) -> list[str]:
    """The classes that occur or are open, and those that are empty on a line."""
    from singsym.classes.result import counts
    from singsym.classes.summary import empty_text, known_by, shown_classes

    headers = ("class", "types", "there?", "known by", "dimension", "points", "components", "step")
    some_open = any(c.verdict.is_undecided for c in shown_classes(result))
    rows = [
        (
            str(c.singularity_class.number),
            str(c.types),
            str(c.verdict.answer) if some_open else "",
            known_by(result, c.singularity_class.number),
            extent_of(c),
            *counts(c),
            ", ".join(c.steps),
        )
        for c in shown_classes(result)
    ]
    table = _table(("r", "l", "l", "l", "c", "c", "c", "l"), headers, rows) if rows else ""
    empty = empty_text(result)
    types = dict.fromkeys(line for c in shown_classes(result) for line in c.types.explained)
    parts = (table, f"{escaped(empty)}." if empty else "", _itemized(types) if types else "")
    return [part for part in parts if part]


def _class(result: ClassResult, whole: Classification, names: Mapping[Polynomial, str]) -> str:
    """A class that occurs: equations of its pieces, and one configuration."""
    head = f"\\subsection*{{Class {result.singularity_class.number}\\quad ({result.types})}}"
    items = []
    for group in grouped(result.pieces, whole.loci, whole.lengths):
        counts = f", {group.points} points" if group.points is not None else ""
        items.append(rf"\item {where_latex(group, names)}: dimension {group.extent}{counts}")
    items += [
        rf"\item perhaps also {where_latex(group, names)}"
        for group in grouped(result.unsure, whole.loci, whole.lengths)
    ]
    listed = "\\begin{itemize}\n" + "\n".join(items) + "\n\\end{itemize}"
    shown = [f"For instance {_configuration(w, whole.equation)}." for w in result.witnesses[:1]]
    return "\n".join([head, listed, *shown])


def _equations(path: Sequence[Polynomial]) -> str:
    return r" = 0,\; ".join(polynomial_latex(p, 8) for p in path) + " = 0" if path else r"\text{everywhere}"


def _configuration(found: Configuration, equation: VelocityEquation) -> str:
    """Moving points with their coordinates, else the variables."""
    places: dict[str, list[str]] = {}
    for name, value in moving(found.points, equation).items():
        places.setdefault(name.rpartition(".")[0], []).append(_number(value))
    if places:
        return ", ".join(f"${_point(name)} = ({', '.join(place)})$" for name, place in places.items())
    values = varying(found.coordinates, equation).items()
    return ", ".join(f"${symbol_latex(name)} = {_number(value)}$" for name, value in values)


def _number(value: str | float) -> str:
    """Six decimals; what is zero but for rounding is 0."""
    number = float(value)
    return "0" if abs(number) < 1e-14 else f"{number:.6f}".rstrip("0").rstrip(".")


def _point(name: str) -> str:
    return symbol_latex(name) if len(name) > 1 else name


def solution_latex(solutions: Sequence[Solution], lengths: NamedLengths | None = None) -> str:
    """The solution sets of conditions: equations, dimensions, counts and a configuration of each piece.

    lengths: those that have names.
    """
    written = lengths or NamedLengths()
    values = written.occurring_in(p for s in solutions for piece in s.pieces for p in piece.path)
    parts = [values_latex(values)] if values else []
    for solution in solutions:
        head = rf"\section*{{Condition ({solution.condition.label})}}"
        parts += [head, f"${solution.condition.latex_statement}$ ({solution.condition.types})."]
        items = []
        for piece, *rest in alike(solution.pieces):
            many = 1 + len(rest)
            counts = f", {many} parts" if rest else ""
            counts += f", {many * piece.points} points" if piece.points is not None else ""
            witnesses = [w for p in (piece, *rest) for w in p.witnesses[:1]][:2]
            shown = [f" For instance {_configuration(w, solution.equation)}." for w in witnesses]
            where = _equations([written.shown(p) for p in piece.path])
            items.append(rf"\item ${where}$, dimension {piece.extent}{counts}." + "".join(shown))
        if items:
            parts.append("\\begin{itemize}\n" + "\n".join(items) + "\n\\end{itemize}")
        elif not solution.undecided:
            parts.append("No feasible configuration.")
        parts += [f"Undecided: {escaped(doubt)}." for doubt in solution.doubts]
    return "\n\n".join(parts)
