"""A design as a page, as rows of plain data, and its border in LaTeX.

Source: what is printed is as `singsym.designs` says.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

import sympy

from singsym.classes.gathering import gathered
from singsym.classes.taxonomy.types import SingularityType, feasible_classes
from singsym.designs.borders import BorderPart
from singsym.designs.result import Cell, Design, Entry
from singsym.designs.sampling import Sampled, class_rows
from singsym.effort.verdict import described
from singsym.output.page import Block, Grid, Page
from singsym.output.pieces import counted
from singsym.polynomials.latex import polynomial_latex

_AT_SAMPLES = "there the table holds at the sample; it is not proven constant."
_MOST_LISTED = 6
"""Types in a sentence; more are counted."""


def design_page(found: Design) -> Page:
    """The border, the cells with their tables, and what is proven of them."""
    names = ", ".join(found.parameters)
    blocks: list[Block] = [f"{found.mechanism.name}: the classes over {names}"]
    if found.dividing:
        blocks.append(_borders(found))
    else:
        blocks.append("No border divides the ranges.")
    headers = ("where", "sample", "classes that occur")
    blocks.append(Grid(headers, tuple(map(_row, found.cells)), "Cells, each with its table at a sample"))
    if found.plane is not None and found.dividing:
        blocks.append(_signs(found))
    if found.values:
        blocks.append(Grid(headers, tuple(map(_row, found.values)), "On the border"))
    if found.plane is not None and found.dividing:
        points = "each table is that of the one point given; " if found.values else ""
        blocks.append(
            f"On the border {points}nothing is said of its other points, nor of where borders cross."
        )
    blocks.append(proof_text(found))
    questions = gathered(found.open_questions())
    if questions:
        blocks.append(Grid(("open", "why"), questions))
    return tuple(blocks)


def _borders(found: Design) -> Grid:
    rows = tuple((f"{part.polynomial} = 0", _reasons(part)) for part in found.dividing)
    return Grid(("border", "where, for some of a class, ..."), rows, "Borders that divide the ranges")


def _reasons(part: BorderPart) -> str:
    by_reason: dict[str, list[str]] = {}
    for types, reason in part.reasons:
        by_reason.setdefault(reason, []).append(f"({types})")
    return "; ".join(f"{' '.join(dict.fromkeys(own))} {reason}" for reason, own in by_reason.items())


def _row(cell: Cell) -> tuple[str, str, str]:
    return cell.where, sample_text(cell), cell.reason or table_text(cell.entries)


def _signs(found: Design) -> Grid:
    """Which side of each border a cell is on."""
    headers = ("cell", *(str(part.polynomial) for part in found.dividing))
    rows = tuple((c.where, *("+" if sign > 0 else "-" for sign in c.signs)) for c in found.cells)
    return Grid(headers, rows, "Sides of the borders")


def sample_text(cell: Cell) -> str:
    """The values of the parameters."""
    return ", ".join(f"{name} = {_number(name, value)}" for name, value in cell.sample.items())


def _number(name: str, value: sympy.Expr) -> str:
    """A number; of one that is given by a polynomial that too."""
    if not isinstance(value, sympy.CRootOf):
        return str(value)
    polynomial = value.poly.as_expr(sympy.Symbol(name))
    return f"{float(value):.6g}..., a root of {str(polynomial).replace('**', '^')}"


def table_text(entries: Sequence[Entry]) -> str:
    """A table of classes in a few words.

    >>> table_text([(1, "yes", 0, 4, 4), (2, "yes", 1, None, 3)])
    '1 (RI, IO): 4 points; 2 (RO, II): a curve, 3 components'
    """
    return "; ".join(map(_entry_text, entries)) or "no singularity"


def _entry_text(entry: Entry) -> str:
    number, answer, dimension, points, components = entry
    if not number:
        return "no configuration"
    name = f"{number} ({_types(number)})"
    if answer != "yes":
        return f"{name}: {answer}"
    if dimension == 0:
        return f"{name}: {counted('?' if points is None else points, 'point')}"
    if dimension == 1:
        count = "" if components is None else f", {counted(components, 'component')}"
        return f"{name}: a curve{count}"
    return f"{name}: {'of unknown dimension' if dimension is None else f'dimension {dimension}'}"


def _types(number: int) -> SingularityType:
    return next(c.types for c in feasible_classes(3) if c.number == number)


def proof_text(found: Design) -> str:
    """What is proven of the cells, and what is only seen at their samples."""
    known = described(found.borders.certainty)
    said = (
        f"Over each cell the class table is constant ({known}): which classes occur, their dimensions, and"
        " the numbers of points and of components of curves, each locus counted by itself, are those at the"
        " sample."
    )
    doubtful = dict.fromkeys(types for types, _ in found.doubts)
    if all(kind.types in doubtful for kind in feasible_classes(3)):
        return "No class is proven to be constant over the cells: a table holds at its sample."
    if len(doubtful) > _MOST_LISTED:
        said += f" Not of {len(doubtful)} classes, which are open below: {_AT_SAMPLES}"
    elif doubtful:
        listed = ", ".join(
            f"({types})" if types else "whether there are configurations" for types in doubtful
        )
        said += f" Not of {listed}: {_AT_SAMPLES}"
    return said


def border_latex(found: Design) -> str:
    r"""The border as a product of its factors, those that divide the ranges.

    Nothing where no border does.
    """
    factors = (rf"\left({polynomial_latex(part.polynomial)}\right)" for part in found.dividing)
    product = r"\,".join(factors)
    return rf"{product} = 0" if product else ""


def design_rows(found: Design) -> list[dict[str, Any]]:
    """A row for each class that occurs in a cell or on a value of the border.

    `where`, the parameters, `constant`: whether the row is proven for all of the cell; then as for `sweep`.
    """
    rows = []
    for cell in (*found.cells, *found.values):
        own = {name: str(cell.sample.get(name, "")) for name in found.parameters}
        for row in class_rows(own, Sampled(cell.classification, cell.reason)):
            known = bool(cell.sample) and cell.classification is not None
            constant = known and not found.is_sample_only(cell)
            if row["types"] is not None:
                constant = constant and found.is_constant(SingularityType.named(row["types"]))
            elif found.doubts:
                constant = False
            rows.append({"where": cell.where, **own, "constant": constant, **row})
    return rows


def design_data(found: Design) -> dict[str, Any]:
    """Everything as plain data."""
    return {
        "mechanism": found.mechanism.name,
        "parameters": list(found.parameters),
        "certainty": described(found.borders.certainty),
        "borders": [
            {
                "factor": str(part.polynomial),
                "latex": polynomial_latex(part.polynomial),
                "divides": part in found.dividing,
                "reason": [f"{types}: {reason}" for types, reason in part.reasons],
            }
            for part in found.borders.parts
        ],
        "cells": design_rows(found),
        "open": [{"what": what, "reason": reason} for what, reason in found.open_questions()],
    }


def design_html(found: Design) -> str:
    """The same as the page, for notebooks."""
    parts = []
    for block in design_page(found):
        if isinstance(block, str):
            parts.append(f"<p>{escape(block)}</p>")
        else:
            head = "".join(f"<th>{escape(h)}</th>" for h in block.headers)
            body = "".join(
                "<tr>" + "".join(f"<td>{escape(x)}</td>" for x in row) + "</tr>" for row in block.rows
            )
            title = f"<caption>{escape(block.title)}</caption>" if block.title else ""
            parts.append(f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>")
    return "".join(parts)


def sweep_page(name: str, rows: Sequence[Mapping[str, Any]]) -> Page:
    """The rows of a sweep as a table, and what it does not say."""
    headers = tuple(rows[0]) if rows else ()
    cells = tuple(tuple("" if value is None else str(value) for value in row.values()) for row in rows)
    note = "These are samples: nothing is said of other values."
    return (f"{name}: the classes at chosen values", Grid(headers, cells), note)


def csv_text(rows: Iterable[Mapping[str, Any]]) -> str:
    """Rows as comma-separated values with a header.

    >>> csv_text([{"a": "1/2", "points": None}])
    'a,points\\r\\n1/2,\\r\\n'
    """
    import csv
    import io

    listed, stream = list(rows), io.StringIO()
    if listed:
        writer = csv.DictWriter(stream, fieldnames=list(listed[0]))
        writer.writeheader()
        writer.writerows(listed)
    return stream.getvalue()
